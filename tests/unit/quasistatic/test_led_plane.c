/* Tests the plane of SIF-driven cracks: factors of given displacements for thin and thick 3D bodies, areas of crack
 * faces and widths of bodies beside planes of symmetry, energy release rates of grown cracks. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "base/memory.h"
#include "engine/engine.h"
#include "fracture/sif_fields.h"
#include "src/quasistatic/sif_cracks.h"
#include "src/quasistatic/steps_record.h"
#include "step/report.h"
#include "scene/scene_read.h"

struct solution {
    struct scene s;
    struct run e;
};

/* Creates the run a of the scene `text`. Returns its only crack tip. */
static const struct sif_crack_tip *solution_begin(struct solution *a, const char *text)
{
    memset(a, 0, sizeof *a);
    if (scene_read_text(&a->s, text, strlen(text), "test.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    if (run_set_up_from_scene(&a->e, &a->s, NULL) != OK) fail_msg("%s", status_message());
    assert_true(sif_cracks_find_tips_and_test_if_any_can_grow(&a->e));
    assert_int_equal(a->e.statics->sif.n, 1);
    return &a->e.statics->sif.tip[0];
}

static void solution_free(struct solution *a)
{
    run_free_memory(&a->e);
    scene_free(&a->s);
}

/* Sets the displacements of all particles to the crack-tip field with factors K [Pa m^(1/2)] around the tip, for the
 * plane state `space`. */
static void field_set(struct run *run, const struct sif_crack_tip *tip, enum space space, const real K[MODES])
{
    struct particles *p = &run->part;
    struct material m = run->scene->material[0];
    material_compute_derived_constants(&m, space);
    const struct crack_medium medium = crack_medium_of_material(&m, space);
    const real *a = tip->along;
    for (int64_t i = 0; i < p->n; i++) {
        real X[2], u[2] = {0, 0};
        crack_tip_plane_project_particle(&run->statics->sif.plane, &run->part, i, X);
        for (int d = 0; d < 2; d++) X[d] -= tip->position[d];
        for (int mode = 0; mode < MODES; mode++) {
            struct crack_field f;
            crack_tip_unit_sif_field_at_rest(&medium, mode,
                                             (real[]){a[0] * X[0] + a[1] * X[1], a[0] * X[1] - a[1] * X[0]}, &f);
            u[0] += K[mode] * (a[0] * f.displacement[0] - a[1] * f.displacement[1]);
            u[1] += K[mode] * (a[1] * f.displacement[0] + a[0] * f.displacement[1]);
        }
        for (int d = 0; d < 3; d++)
            p->x[d][i] =
                p->X[d][i] + u[0] * run->statics->sif.plane.axis[0][d] + u[1] * run->statics->sif.plane.axis[1][d];
    }
}

/* Checks that displacements of plane stress in a plate thinner than the ring of the fit, and of plane strain in a
 * thicker one, yield the factors that were set. The other plane state would yield factors with an error of 7 %. */
static void test_plane_state(void **state)
{
    static char text[1000];
    static const int thickness[] = {4, 15}; /* the ring has a mean radius of 5 spacings */
    const real K[MODES] = {2.1e5, -0.9e5};
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct solution a;
        real found[MODES];
        snprintf(text, sizeof text,
                 "space: solid\nduration: 1 s\nmethod: pd\nsolver: static\n"
                 "steps: {number: 3, control: energy, path: hoop}\n"
                 "material: {young: 3 GPa, poisson: 1/4, density: 1180 kg/m^3, energy_release_rate: 300 J/m^2}\n"
                 "body: {box: {from: [0, -8 mm, 0], to: [18 mm, 8 mm, %d mm]}}\n"
                 "particles: {spacing: 1 mm, horizon: 3.015}\n"
                 "cracks:\n  - {polygon: [[-1 mm, 0, -1 mm], [7 mm, 0, -1 mm], [7 mm, 0, %d mm], [-1 mm, 0, %d mm]]}\n"
                 "boundary:\n  - {displacement: [0, 0.1 mm, 0], face: y+, time: {ramp: {until: 1 s}}}\n"
                 "  - {fixed: all, face: y-}\n",
                 thickness[k], thickness[k] + 1, thickness[k] + 1);
        const struct sif_crack_tip *tip = solution_begin(&a, text);
        field_set(&a.e, tip, k == 0 ? SPACE_PLANE_STRESS : SPACE_PLANE_STRAIN, K);
        assert_true(sif_tip_compute_intensity_factors(&a.e.statics->sif, &a.e.part, tip, false, found));
        for (int mode = 0; mode < MODES; mode++) /* round-off, and equations of nine terms */
            if (!(fabs(found[mode] / K[mode] - 1) < 1e-4)) fail_msg("%d mm: K %g", thickness[k], found[mode]);
        solution_free(&a);
    }
}

/* Checks the area of a crack increment: length times thickness, and half of it along a plane of symmetry, where only
 * one of both crack faces is in the body. */
static void test_face_area(void **state)
{
    static const char half[] =
        "space: plane strain\nthickness: 0.37 mm\nduration: 1 s\nmethod: pd\nsolver: static\n"
        "steps: {number: 3, control: energy}\n"
        "material: {young: 3 GPa, poisson: 1/4, density: 1180 kg/m^3, energy_release_rate: 300 J/m^2}\n"
        "body: {box: {from: [0, 0], to: [20 mm, 8 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n"
        "cracks: [{from: [-1 mm, %g mm], to: [7 mm, %g mm]}]\n"
        "boundary: [{mirror: {axis: y, at: 0}}, {traction: [0, 1 MPa], face: y+, time: {ramp: {until: 1 s}}}]\n";
    (void)state;
    for (int k = 0; k < 2; k++) {
        char text[1000];
        struct solution a;
        real ahead[2];
        snprintf(text, sizeof text, half, k ? 4.0 : 0.0, k ? 4.0 : 0.0);
        const struct sif_crack_tip *tip = solution_begin(&a, text);
        crack_tip_plane_compute_point_ahead(tip->position, 2.3e-3, tip->last, ahead);
        const real area = crack_tip_plane_crack_area(&a.e.statics->sif.plane, &a.e.part, tip->position, ahead),
                   whole = 2.3e-3 * 0.37e-3;
        if (!(fabs(area / (k ? whole : 0.5 * whole) - 1) < 1e-9)) fail_msg("crack %d: %g of its area", k, area / whole);
        solution_free(&a);
    }
}

/* Checks that in 3D a crack increment is as wide as the body along the front: 3.5 mm if a plane of symmetry across the
 * front passes through the first of four layers of particles, 4 mm if it is beside them. */
static void test_width(void **state)
{
    static const char block[] =
        "space: solid\nduration: 1 s\nmethod: pd\nsolver: static\nsteps: {number: 3, control: energy, path: hoop}\n"
        "material: {young: 3 GPa, poisson: 1/4, density: 1180 kg/m^3, energy_release_rate: 300 J/m^2}\n"
        "body: {box: {from: [0, -8 mm, %g mm], to: [18 mm, 8 mm, %g mm]}}\n"
        "particles: {spacing: 1 mm, horizon: 3.015}\n"
        "cracks:\n  - {polygon: [[-1 mm, 0, -9 mm], [7 mm, 0, -9 mm], [7 mm, 0, 9 mm], [-1 mm, 0, 9 mm]]}\n"
        "boundary:\n  - {displacement: [0, 0.1 mm, 0], face: y+, time: {ramp: {until: 1 s}}}\n"
        "  - {fixed: all, face: y-}\n  - {mirror: {axis: z, at: 0}}\n";
    (void)state;
    for (int k = 0; k < 2; k++) {
        char text[1000];
        struct solution a;
        real ahead[2];
        const real from = k ? 0 : -0.5, wide = k ? 4e-3 : 3.5e-3;
        snprintf(text, sizeof text, block, from, from + 4);
        const struct sif_crack_tip *tip = solution_begin(&a, text);
        crack_tip_plane_compute_point_ahead(tip->position, 2.3e-3, tip->last, ahead);
        const real area = crack_tip_plane_crack_area(&a.e.statics->sif.plane, &a.e.part, tip->position, ahead);
        if (!(fabs(area / (2.3e-3 * wide) - 1) < 1e-9)) fail_msg("from %g mm: %g m wide", from, area / 2.3e-3);
        solution_free(&a);
    }
}

static const char plate[] =
    "space: plane strain\nthickness: 0.37 mm\nduration: 1 s\nmethod: pd\nsolver: static\n"
    "steps: {number: 3, control: energy}\n"
    "material: {young: 3 GPa, poisson: 1/4, density: 1180 kg/m^3, energy_release_rate: 300 J/m^2}\n"
    "body: {box: {from: [0, 0], to: [20 mm, 8 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n"
    "cracks: [{from: [-1 mm, 4 mm], to: [7 mm, 4 mm]}]\n"
    "boundary: [{fixed: all, face: y-}, {traction: [0, 1 MPa], face: y+, time: {ramp: {until: 1 s}}}]\n";

/* Checks the recorded energy release rate after three increments with different rates: it is that of the last two
 * increments, and after the first one that of this increment. */
static void test_release_rate(void **state)
{
    static const real grown[] = {0, 1.3e-3, 3.4e-3, 5.1e-3}, released[] = {0, 2e-4, 7.1e-4, 9.3e-4};
    (void)state;
    struct solution a;
    solution_begin(&a, plate);
    struct sif_cracks *led = &a.e.statics->sif;
    led->path = NEW("test.path", 3, struct path_segment);
    for (int k = 0; k < 4; k++) {
        real record[20];
        if (k > 0) led->path[led->segments++] = (struct path_segment){{{grown[k - 1]}, {grown[k]}}, 0};
        a.e.statics->balance.lost = released[k];
        statics_compute_history_values(&a.e, record);
        assert_true(fabs(record[2] - released[k]) <= 1e-12 * released[k]);
        assert_true(fabs(record[3] - 0.37e-3 * grown[k]) <= 1e-12 * grown[k]);
        const int since = k > 2 ? k - 2 : 0;
        const real rate = (released[k] - released[since]) / (0.37e-3 * (grown[k] - grown[since]));
        if (k == 0)
            assert_true(isnan(record[4]));
        else if (!(fabs(record[4] / rate - 1) < 1e-12))
            fail_msg("growth %d: %g J/m^2 of %g", k, record[4], rate);
    }
    solution_free(&a);
}

/* Checks the energy release rate from damaged particles ahead of the crack, which grows by one spacing per step. The
 * rate refers to complete increments of four spacings: up to the eighth spacing to the start, beyond it to the
 * fourth. */
static void test_rate_of_damage(void **state)
{
    (void)state;
    struct solution a;
    real released[11] = {0};
    solution_begin(&a, plate);
    struct particles *p = &a.e.part;
    for (int k = 1; k < 11; k++) {
        real record[20];
        released[k] = released[k - 1] + 1.3e-5 * k * k;
        for (int64_t i = 0; i < p->n; i++)
            if (p->X[0][i] > 7e-3 && p->X[0][i] < (7 + k) * 1e-3 && fabs(p->X[1][i] - 4e-3) < 0.6e-3)
                p->damage[i] = 0.45;
        a.e.statics->balance.lost = released[k];
        statics_compute_history_values(&a.e, record);
        const int since = k > 8 ? 4 : 0;
        const real rate = (released[k] - released[since]) / (0.37e-3 * 1e-3 * (k - since));
        if (!(fabs(record[3] / (0.37e-6 * k) - 1) < 1e-9)) fail_msg("%d spacings: %g m^2", k, record[3]);
        if (!(fabs(record[4] / rate - 1) < 1e-9)) fail_msg("%d spacings: %g J/m^2 of %g", k, record[4], rate);
    }
    solution_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_plane_state), cmocka_unit_test(test_face_area),
                                       cmocka_unit_test(test_width), cmocka_unit_test(test_release_rate),
                                       cmocka_unit_test(test_rate_of_damage)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
