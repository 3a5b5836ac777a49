/* Tests supports. Load steps: reactions against the static solver, beside planes of symmetry through particles, and
 * against loads; work of loads. In time: nodes on and beyond planes, increasing velocities, bodies that enter the
 * region of a support. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/support/solution.h"
#include "step/report.h"
#include "probes/diagnostics.h"
#include "grid/grid_part.h"
#include "step/step.h"

/* A quarter of a plate; the first row and the first column of particles are in the planes of symmetry. */
#define QUARTER                                                                                                        \
    "space: plane stress\nthickness: 0.37 mm\nduration: 1 s\nmethod: pd\n"                                             \
    "material: {young: 20000 GPa, density: 1000}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n"                      \
    "body: {box: {from: [-0.25 mm, -0.25 mm], to: [4.25 mm, 3.25 mm]}}\n"                                              \
    "boundary:\n  - {mirror: {axis: x, at: 0}}\n  - {mirror: {axis: y, at: 0}}\n"

static void test_reactions(void **state)
{
    (void)state;
    static const char *const driven =
        QUARTER "  - {velocity: [1.3 nm/s, 3 nm/s], region: {box: {from: [-inf, 2 mm], to: [inf, inf]}}}\n";
    struct solution a, b;
    solution_run(&a, driven, "solver=static", "steps.number=2", "solver_tolerance=1e-8", NULL);
    solution_run(&b, driven, "solver=cg", "solver_tolerance=1e-8", NULL);
    const struct load *one = &a.e.loads.load[2], *other = &b.e.loads.load[2];
    for (int d = 0; d < 2; d++) {
        near_to("reaction", one->reaction[d], other->reaction[d], 1e-4);
        near_to("displacement", one->displacement[d], other->displacement[d], 1e-6);
    }
    solution_free(&a), solution_free(&b);
}

/* Checks that particles in a clamped plane do not move, and that the others agree with the static solver within
 * 1e-5. */
static void test_clamped_plane(void **state)
{
    (void)state;
    static const char plane[] = "boundary=[{mirror: {axis: x, at: 0, tangential: held}}, "
                                "{traction: [0.7 MPa, 1.3 MPa], face: x+, time: {ramp: {until: 1 s}}}]";
    struct solution a, b;
    solution_run(&a, QUARTER, plane, "solver=static", "steps.number=2", "solver_tolerance=1e-8", NULL);
    solution_run(&b, QUARTER, plane, "solver=cg", "solver_tolerance=1e-8", NULL);
    solution_done(&a), solution_done(&b);
    assert_true(solution_difference(&a, &b) < 1e-5);
    for (int64_t i = 0; i < a.e.part.n; i++)
        if (fabs(a.e.part.X[0][i]) < 1e-9)
            for (int d = 0; d < 2; d++) assert_true(fabs(a.e.part.x[d][i] - a.e.part.X[d][i]) < 1e-16);
    solution_free(&a), solution_free(&b);
}

/* Checks a plate on a fixed layer: the reaction is the traction times the area of its face. The work of linearly
 * increasing loads is half of the final loads times the displacement of the face. */
static void test_foot(void **state)
{
    (void)state;
    static const char foot[] =
        "space: plane stress\nthickness: 0.37 mm\nduration: 1 s\nmethod: pd\n"
        "material: {young: 20000 GPa, density: 1000}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n"
        "body: {box: {from: [-3 mm, -5 mm], to: [3 mm, 5 mm]}}\nboundary:\n"
        "  - {traction: [0.4 MPa, 1.7 MPa], face: y+, time: {ramp: {until: 1 s}}}\n"
        "  - {fixed: all, region: {box: {from: [-inf, -inf], to: [inf, -4 mm]}}}\n";
    struct solution a;
    solution_run(&a, foot, "solver=static", "steps.number=3", "solver_tolerance=1e-8", NULL);
    const real face = 6e-3 * 0.37e-3, pull[] = {0.4e6 * face, 1.7e6 * face};
    for (int d = 0; d < 2; d++) {
        near_to("load", a.e.loads.load[0].reaction[d], pull[d], 1e-9);
        near_to("foot", a.e.loads.load[1].reaction[d], -pull[d], 1e-5);
    }
    real work = 0;
    for (int d = 0; d < 2; d++) work += 0.5 * pull[d] * a.e.loads.load[0].displacement[d];
    near_to("work", a.e.loads.work, work, 1e-4);
    near_to("energy", a.e.diagnostics->now.energy.strain, work, 1e-4);
    solution_free(&a);
}

/* Checks nodes beyond a plane of symmetry: the impulse of the plane and of a load on half a body is its momentum. */
static void test_mirrored_nodes(void **state)
{
    (void)state;
    static const char half[] =
        "space: plane stress\nthickness: 0.37 mm\nduration: 7 us\nmethod: mpm\n"
        "mpm: {frame: reference, origin: [0.5 mm, 0]}\n" /* the plane is midway between two nodes */
        "material: {young: 3 GPa, density: 1180}\nparticles: {spacing: 0.5 mm}\n"
        "body: {box: {from: [0, 0], to: [4 mm, 3 mm]}}\nboundary:\n  - {mirror: {axis: x, at: 0}}\n"
        "  - {traction: [1.7 MPa, 0.4 MPa], face: x+}\n";
    struct solution a;
    solution_run(&a, half, NULL);
    solution_done(&a);
    const struct particles *p = &a.e.part;
    for (int d = 0; d < 2; d++) {
        real momentum = 0;
        for (int64_t i = 0; i < p->n; i++) momentum += p->mass[i] * p->v[d][i];
        near_to("momentum", a.e.loads.impulse[d], momentum, 1e-6);
    }
    assert_true(fabs(a.e.loads.impulse[0]) <
                0.5 * 1.7e6 * 3e-3 * 0.37e-3 * 7e-6); /* the plane reduces the impulse by more than half */
    solution_free(&a);
}

#define BLOCK                                                                                                          \
    "space: plane strain\nthickness: 0.37 m\nduration: 1.3 ms\nmethod: mpm\n"                                          \
    "material: {young: 1 MPa, poisson: 1/4, density: 1180}\nbody: {box: {from: [0, 0], to: [30 mm, 50 mm]}}\n"         \
    "particles: {spacing: 5 mm}\n"

/* Checks that a block driven with the velocity V t/T has moved by V T/2 at T in every frame, and that the impulse of
 * its support is m V. */
static void test_ramp(void **state)
{
    (void)state;
    static const char *const frames[][3] = {{"method=pd", NULL},
                                            {"method=mpm", "mpm.frame=reference", NULL},
                                            {"mpm.frame=current", "mpm.transfer=apic", NULL},
                                            {"mpm.frame=current", "mpm.transfer=flip", NULL}};
    const real way[] = {0.5 * 3 * 1.3e-3, -0.5 * 0.7 * 1.3e-3}, mass = 30e-3 * 50e-3 * 0.37 * 1180;
    const real momentum[] = {3 * mass, -0.7 * mass};
    for (size_t k = 0; k < COUNT_OF(frames); k++) {
        struct solution a;
        solution_run(&a, BLOCK, "boundary=[{velocity: [3 m/s, -0.7 m/s], time: {ramp: {until: 1.3 ms}}}]", frames[k][0],
                     frames[k][1], NULL);
        solution_done(&a);
        run_update_particle_motion_and_stress(&a.e);
        for (int64_t i = 0; i < a.e.part.n; i++)
            for (int d = 0; d < 2; d++) near_to("way", a.e.part.x[d][i] - a.e.part.X[d][i], way[d], 1e-9);
        for (int d = 0; d < 2; d++) /* velocities are those of half a step before the end */
            near_to("impulse", a.e.loads.impulse[d], momentum[d] * (1 - 0.5 / (real)a.e.clock.steps), 1e-4);
        solution_free(&a);
    }
}

/* Checks that a block whose lower part is driven by a ramp moves as one that is driven by the equivalent formula. */
static void test_ramp_below(void **state)
{
    (void)state;
    static const char *const frames[][3] = {{"method=pd", NULL},
                                            {"method=mpm", "mpm.frame=reference", NULL},
                                            {"mpm.frame=current", "mpm.transfer=apic", NULL},
                                            {"mpm.frame=current", "mpm.transfer=flip", NULL}};
    static const char foot[] = "boundary=[{%s, region: {box: {from: [-inf, -inf], to: [inf, 21 mm]}}}]";
    char ramp[200], formula[200];
    snprintf(ramp, sizeof ramp, foot, "velocity: [3 m/s, -0.7 m/s], time: {ramp: {until: 1.3 ms}}");
    snprintf(formula, sizeof formula, foot, "velocity: [3 m/s*t/(1.3 ms), -0.7 m/s*t/(1.3 ms)]");
    for (size_t k = 0; k < COUNT_OF(frames); k++) {
        struct solution a, b;
        solution_run(&a, BLOCK, ramp, "duration=1 ms", frames[k][0], frames[k][1], NULL), solution_done(&a);
        solution_run(&b, BLOCK, formula, "duration=1 ms", frames[k][0], frames[k][1], NULL), solution_done(&b);
        run_update_particle_motion_and_stress(&a.e), run_update_particle_motion_and_stress(&b.e);
        assert_true(solution_difference(&a, &b) < 1e-9);
        solution_free(&a), solution_free(&b);
    }
}

/* Compares half a plate, clamped at its plane x = 0 and sheared at its right side, with the whole plate, sheared in
 * opposite directions at both sides. Displacements along y are odd in x, and no others occur away from the upper and
 * lower edges. The plane is on nodes, or midway between two. With groups of rotating points (FLIP, data/turning.h) x
 * velocities differ: tolerance 2e-3 instead of 1e-9. */
static void test_shear_beside_clamps(void **state)
{
    (void)state;
    static const char half[] =
        "space: plane strain\nthickness: 0.37 mm\nduration: 3 us\nmethod: mpm\n"
        "material: {young: 3 GPa, poisson: 0.3, density: 1180}\nparticles: {spacing: 0.5 mm}\n"
        "body: {box: {from: [0, -15 mm], to: [4 mm, 15 mm]}}\nboundary:\n"
        "  - {mirror: {axis: x, at: 0, tangential: held}}\n  - {traction: [0, 1.7 MPa], face: x+}\n";
    static const char whole[] = "space: plane strain\nthickness: 0.37 mm\nduration: 3 us\nmethod: mpm\n"
                                "material: {young: 3 GPa, poisson: 0.3, density: 1180}\nparticles: {spacing: 0.5 mm}\n"
                                "body: {box: {from: [-4 mm, -15 mm], to: [4 mm, 15 mm]}}\nboundary:\n"
                                "  - {traction: [0, -1.7 MPa], face: x-}\n  - {traction: [0, 1.7 MPa], face: x+}\n";
    static const struct {
        const char *frame, *origin, *transfer;
        real apart;
    } with[] = {{"mpm.frame=reference", "mpm.origin=[0, 0]", NULL, 1e-9},
                {"mpm.frame=reference", "mpm.origin=[0.5 mm, 0]", NULL, 1e-9},
                {"mpm.frame=current", "mpm.origin=[0, 0]", "mpm.transfer=apic", 1e-9},
                {"mpm.frame=current", "mpm.origin=[0.5 mm, 0]", "mpm.transfer=apic", 1e-9},
                {"mpm.frame=current", "mpm.origin=[0, 0]", "mpm.transfer=flip", 2e-3},
                {"mpm.frame=current", "mpm.origin=[0.5 mm, 0]", "mpm.transfer=flip", 2e-3}};
    for (size_t k = 0; k < COUNT_OF(with); k++) {
        struct solution a, b;
        real most = 0, largest = 0;
        solution_run(&a, half, with[k].frame, with[k].origin, with[k].transfer, NULL), solution_done(&a);
        solution_run(&b, whole, with[k].frame, with[k].origin, with[k].transfer, NULL), solution_done(&b);
        run_update_particle_motion_and_stress(&a.e), run_update_particle_motion_and_stress(&b.e);
        for (int m = 0; m < 8; m++) {
            const real x = (m + 0.5) * 0.5e-3, y = 0.25e-3, own = solution_moved(&a, 1, x, y, 0);
            largest = real_max(largest, fabs(own));
            most = real_max(most, fabs(own - solution_moved(&b, 1, x, y, 0)));
        }
        if (!(largest > 1e-6 && most <= with[k].apart * largest))
            fail_msg("%s %s: %g of %g m", with[k].frame, with[k].origin, most, largest);
        solution_free(&a), solution_free(&b);
    }
}

/* Checks that a region that fixes a body does not fix another body that enters the region. */
static void test_others_pass(void **state)
{
    (void)state;
    static const char bars[] =
        "space: line\nsection: 0.73 cm^2\nduration: 100 us\nmethod: mpm\nmpm: {frame: current}\n"
        "material: {young: 72 GPa, poisson: 0, density: 2440}\nparticles: {spacing: 1 mm}\nbodies:\n"
        "  - {name: held, shape: {box: {from: [0], to: [20 mm]}}}\n"
        "  - {name: comes, shape: {box: {from: [60 mm], to: [80 mm]}}}\n"
        "initial: [{velocity: [-300 m/s], region: {box: {from: [50 mm], to: [90 mm]}}}]\n"
        "boundary: [{fixed: all, region: {box: {from: [-10 mm], to: [45 mm]}}}]\n";
    struct solution a;
    solution_run(&a, bars, NULL), solution_done(&a);
    for (int64_t i = 0; i < a.e.part.n; i++)
        if (a.e.part.body[i] == 1) near_to("velocity", a.e.part.v[0][i], -300, 1e-9);
    assert_true(a.e.part.n == 40 && a.e.grid->fields > 1);
    solution_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_reactions),
                                       cmocka_unit_test(test_foot),
                                       cmocka_unit_test(test_clamped_plane),
                                       cmocka_unit_test(test_mirrored_nodes),
                                       cmocka_unit_test(test_ramp),
                                       cmocka_unit_test(test_ramp_below),
                                       cmocka_unit_test(test_shear_beside_clamps),
                                       cmocka_unit_test(test_others_pass)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
