/* Load steps: reactions of supports against those of the static solver, beside planes of symmetry on which particles
 * lie, and against the loads; the work of loads. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/support/solution.h"

/* A quarter of a plate; the first row and column of particles lie in the planes of symmetry. */
#define QUARTER                                                                                                        \
    "space: plane stress\nthickness: 0.37 mm\nduration: 1 s\nmethod: pd\n"                                             \
    "material: {young: 20000 GPa, density: 1000}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n"                      \
    "body: {box: {from: [-0.25 mm, -0.25 mm], to: [4.25 mm, 3.25 mm]}}\n"                                              \
    "boundary:\n  - {mirror: {axis: x, at: 0}}\n  - {mirror: {axis: y, at: 0}}\n"

static void test_reactions(void **state)
{
    (void)state;
    static const char *const driven = QUARTER
        "  - {velocity: [1.3 nm/s, 3 nm/s], region: {box: {from: [-inf, 2 mm], to: [inf, inf]}}}\n";
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

/* A plate on a foot: the reaction is the traction times its face; the work of loads that grow evenly is half of their
 * last values times the displacement of the face. */
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
    near_to("energy", a.e.diagnostics.now.energy.strain, work, 1e-4);
    solution_free(&a);
}

/* Nodes beyond a plane of symmetry: what the plane and a pull give a half is its momentum. */
static void test_mirrored_nodes(void **state)
{
    (void)state;
    static const char half[] =
        "space: plane stress\nthickness: 0.37 mm\nduration: 7 us\nmethod: mpm\n"
        "mpm: {frame: reference, origin: [0.5 mm, 0]}\n" /* the plane is half-way between two nodes */
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
    assert_true(fabs(a.e.loads.impulse[0]) < 0.5 * 1.7e6 * 3e-3 * 0.37e-3 * 7e-6); /* the plane holds the half */
    solution_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_reactions), cmocka_unit_test(test_foot),
                                       cmocka_unit_test(test_mirrored_nodes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
