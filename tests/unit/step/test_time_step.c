/* Tests the time step: integer multiples for coarse cells, light particles of lists, bulk damping, safety factor of the
 * scene, steps of frames. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/engine.h"
#include "scene/scene_read.h"
#include "tests/support/folder.h"
#include "tests/support/near.h"
#include "step/report.h"

static void put(const char *path, const char *text)
{
    FILE *to = fopen(path, "w");
    assert_non_null(to);
    fputs(text, to);
    assert_int_equal(fclose(to), 0);
}

/* Returns the clock of the scene s before its first step, and releases the scene. */
static struct run_clock clock_made(struct scene *s)
{
    static struct run e;
    memset(&e, 0, sizeof e);
    if (run_set_up_from_scene(&e, s, NULL) != OK) fail_msg("%s", status_message());
    const struct run_clock clock = e.clock;
    run_free_memory(&e);
    scene_free(s);
    return clock;
}

static struct run_clock clock_of(const char *text)
{
    struct scene s;
    if (scene_read_text(&s, text, strlen(text), "test.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    return clock_made(&s);
}

static struct run_clock clock_of_file(const char *path)
{
    struct scene s;
    if (scene_read(&s, path, NULL, 0) != OK) fail_msg("%s", status_message());
    return clock_made(&s);
}

#define PLATE                                                                                                          \
    "space: plane stress\nthickness: 0.37 mm\nmaterial: {young: 3 GPa, poisson: 1/3, density: 1180}\n"                 \
    "body: {box: {from: [0, 0], to: [64 mm, 64 mm]}}\nparticles: {spacing: 1 mm}\n"

/* Checks cells of level 3, which move every eighth step: the number of steps is a multiple of eight, and the run ends
 * at its duration. */
static void mesh_levels_divide_the_steps(void **state)
{
    (void)state;
    for (int us = 11; us < 16; us++) {
        char text[600];
        snprintf(text, sizeof text, PLATE "duration: %d us\nmethod: mpm\nmpm: {frame: reference, levels: 3}\n", us);
        const struct run_clock clock = clock_of(text);
        assert_int_equal(clock.stride, 8);
        assert_int_equal(clock.steps % 8, 0);
        assert_close(clock.dt * (real)clock.steps, us * 1e-6, 1e-12);
        assert_true(clock.dt <= clock.dt_critical);
    }
}

/* Checks that a particle with a quarter of the mass at equal stiffness halves the critical time step. */
static void light_particles_take_short_steps(void **state)
{
    (void)state;
    real critical[2];
    for (int light = 0; light < 2; light++) {
        FILE *file = fopen("plate.csv", "w");
        assert_non_null(file);
        fputs("x [mm],y [mm],mass [g]\n", file);
        const real mass = 1180 * 0.37e-9 * 1e3;
        for (int k = 0; k < 144; k++)
            fprintf(file, "%d,%d,%.17g\n", k % 12, k / 12, k == 77 && light ? 0.25 * mass : mass);
        fclose(file);
        put("plate.yaml", "space: plane stress\nthickness: 0.37 mm\nduration: 10 us\nmethod: mpm\n"
                          "material: {young: 3 GPa, poisson: 1/3, density: 1180}\nmpm: {frame: current}\n"
                          "bodies: [{particles: plate.csv}]\nparticles: {spacing: 1 mm}\n");
        critical[light] = clock_of_file("plate.yaml").dt_critical;
    }
    remove("plate.csv"), remove("plate.yaml");
    assert_close(critical[1], 0.5 * critical[0], 1e-9);
}

/* Checks that masses of a list are compared with the density of their own material: the critical time step is that of a
 * filled body. */
static void masses_are_of_their_material(void **state)
{
    (void)state;
    real critical[2];
    FILE *file = fopen("block.csv", "w");
    assert_non_null(file);
    fputs("x [mm],y [mm],mass [g]\n", file);
    for (int k = 0; k < 36; k++) fprintf(file, "%g,%g,%.17g\n", k % 6 + 0.5, k / 6 + 0.5, 1180 * 0.37e-9 * 1e3);
    fclose(file);
    for (int listed = 0; listed < 2; listed++) {
        char text[900];
        snprintf(text, sizeof text,
                 "space: plane stress\nthickness: 0.37 mm\nduration: 10 us\nmethod: mpm\nmpm: {frame: current}\n"
                 "materials:\n  - {name: heavy, young: 7 GPa, poisson: 1/3, density: 3540}\n"
                 "  - {name: light, young: 3 GPa, poisson: 1/3, density: 1180}\n"
                 "bodies:\n  - {name: base, material: heavy, shape: {box: {from: [0, -4 mm], to: [6 mm, 0]}}}\n"
                 "  - {name: block, material: light, %s}\nparticles: {spacing: 1 mm}\n",
                 listed ? "particles: block.csv" : "shape: {box: {from: [0, 0], to: [6 mm, 6 mm]}}");
        put("block.yaml", text);
        critical[listed] = clock_of_file("block.yaml").dt_critical;
    }
    remove("block.csv"), remove("block.yaml");
    assert_close(critical[1], critical[0], 1e-12);
}

/* Checks that the critical time step of bonds that do not exist yet is independent of the order of materials. One is
 * stiff and heavy, the other soft and light, so that neither stiffness nor density alone decides. */
static void lattices_of_all_materials(void **state)
{
    (void)state;
    static const char *const row[] = {"  - {name: stiff, young: 9 GPa, poisson: 1/3, density: 7070}\n",
                                      "  - {name: soft, young: 1 GPa, poisson: 1/3, density: 1180}\n"};
    static const char *const model[] = {"", "model: ospd\n", "model: mospd\n"};
    for (int k = 0; k < 3; k++) {
        real critical[2];
        for (int turned = 0; turned < 2; turned++) {
            char text[900];
            snprintf(text, sizeof text,
                     "space: plane stress\nthickness: 0.37 mm\nduration: 10 us\nmethod: adaptive\n%smaterials:\n%s%s"
                     "bodies:\n  - {name: plate, material: stiff, shape: {box: {from: [0, 0], to: [12 mm, 12 mm]}},\n"
                     "     parts: [{region: {box: {from: [0, 0], to: [7 mm, 12 mm]}}, material: soft}]}\n"
                     "particles: {spacing: 1 mm, horizon: 2}\nconversion: {stress: 9 MPa}\n",
                     model[k], row[turned], row[!turned]);
            critical[turned] = clock_of(text).dt_critical;
        }
        assert_close(critical[1], critical[0], 1e-12);
    }
}

/* Checks that the time step is the requested fraction of the critical one, and at most half the time constant of
 * damping. */
static void safety_and_damping(void **state)
{
    (void)state;
    const struct run_clock plain = clock_of(PLATE "duration: 1 ms\nmethod: mpm\ntime: {safety: 0.37}\n");
    assert_true(plain.dt <= 0.37 * plain.dt_critical && plain.dt > 0.36 * plain.dt_critical);
    const struct run_clock damped = clock_of(PLATE "duration: 0.1 ms\nmethod: mpm\ndamping: 7e6 1/s\n");
    assert_true(damped.dt <= (1 + 1e-9) * 0.5 / 7e6 && damped.dt > 0.49 / 7e6);
}

/* Checks that the least compressible material shortens the step by the root of (5/3)/(1 + c12/c11), c12/c11 = nu/(1 -
 * nu) in plane strain. The other material has the fastest waves. */
static void incompressible_parts_take_short_steps(void **state)
{
    (void)state;
    for (int linear = 0; linear < 2; linear++) {
        real critical[2];
        for (int parts = 0; parts < 2; parts++) {
            char text[700];
            snprintf(text, sizeof text,
                     "space: plane strain\nthickness: 0.37 mm\nduration: 10 us\nmethod: mpm\nmpm: {frame: current, "
                     "shape: %s}\n"
                     "materials:\n  - {name: stiff, young: 3 GPa, poisson: 1/4, density: 1180}\n%s"
                     "bodies:\n  - {name: plate, material: stiff, shape: {box: {from: [0, 0], to: [12 mm, 12 mm]}}%s}\n"
                     "particles: {spacing: 1 mm}\n",
                     linear ? "linear" : "gimp",
                     parts ? "  - {name: rubber, young: 0.1 GPa, poisson: 0.47, density: 1430}\n" : "",
                     parts ? ", parts: [{region: {box: {from: [3 mm, 3 mm], to: [7 mm, 9 mm]}}, material: rubber}]"
                           : "");
            critical[parts] = clock_of(text).dt_critical;
        }
        /* points on nodes limit linear shapes at any Poisson's ratio */
        assert_close(critical[1], critical[0] * (linear ? 1 : sqrt(5. / 3 / (1 + 0.47 / 0.53))), 1e-12);
    }
}

/* Checks that frames are written at the steps nearest to their times: 0.7, 2.3 and 8.6 steps of 20 ns. */
static void frames_are_nearest(void **state)
{
    (void)state;
    static const char text[] = PLATE "duration: 0.2 us\ntime: {step: 20 ns}\nmethod: pd\n"
                                     "output: {times: [14 ns, 46 ns, 172 ns]}\n";
    static const int64_t nearest[] = {0, 1, 2, 9};
    struct scene s;
    static struct run e;
    if (scene_read_text(&s, text, strlen(text), "test.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    if (run_set_up_from_scene(&e, &s, NULL) != OK) fail_msg("%s", status_message());
    for (int k = 1; k <= 3; k++) assert_int_equal(report_step_number_of_frame(e.scene, &e.clock, k), nearest[k]);
    run_free_memory(&e);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(mesh_levels_divide_the_steps),
                                       cmocka_unit_test(light_particles_take_short_steps),
                                       cmocka_unit_test(masses_are_of_their_material),
                                       cmocka_unit_test(lattices_of_all_materials),
                                       cmocka_unit_test(incompressible_parts_take_short_steps),
                                       cmocka_unit_test(safety_and_damping),
                                       cmocka_unit_test(frames_are_nearest)};
    return cmocka_run_group_tests(tests, folder_enter, folder_leave);
}
