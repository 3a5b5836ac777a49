/* Tests load steps: equilibria of elastic bodies against the static solvers, quarters between mirrors against whole
 * bodies, unconstrained fragments, trial increments without side effects, and the energy dissipated in a dynamic
 * release. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "quasistatic/load_steps.h"
#include "quasistatic/statics.h"
#include "src/quasistatic/crack_increment.h"
#include "src/quasistatic/balance.h"
#include "src/quasistatic/system.h"
#include "src/quasistatic/toughness.h"
#include "tests/support/solution.h"
#include "step/report.h"
#include "probes/diagnostics.h"
#include "contact/contact.h"

/* Strains are at most 1e-6: linear quantities are accurate to 1e-5. */
#define PLATE                                                                                                          \
    "space: plane stress\nthickness: 1 mm\nduration: 1 s\nmethod: pd\n"                                                \
    "material: {young: 20000 GPa, density: 1000}\nparticles: {spacing: 0.5 mm, horizon: 3.015}\n"
#define WHOLE PLATE "body: {box: {from: [-5 mm, -5 mm], to: [5 mm, 5 mm]}}\n"
#define CRACK "cracks:\n  - {from: [-6 mm, 0.1 mm], to: [0, 0.1 mm]}\n"
#define PULLED "boundary:\n  - {traction: [0, 1 MPa], face: y+}\n  - {traction: [0, -1 MPa], face: y-}\n"
#define FOOT "  - {fixed: all, region: {box: {from: [-inf, -inf], to: [inf, -4 mm]}}}\n"
#define HELD WHOLE CRACK "boundary:\n  - {traction: [0, 1 MPa], face: y+}\n" FOOT
#define DRIVEN                                                                                                         \
    WHOLE CRACK "boundary:\n  - {velocity: [0, 1 nm/s], region: {box: {from: [-inf, 4 mm], to: [inf, inf]}}}\n" FOOT
#define QUARTER(from, to)                                                                                              \
    PLATE "body: {box: {from: [" from ", " from "], to: [" to ", " to "]}}\n"                                          \
          "boundary:\n  - {mirror: {axis: x, at: 0}}\n  - {mirror: {axis: y, at: 0}}\n"                                \
          "  - {traction: [0, 1 MPa], face: y+}\n"
#define BLOCK                                                                                                          \
    "space: solid\nduration: 1 s\nmethod: pd\nmaterial: {young: 20000 GPa, density: 1000}\n"                           \
    "particles: {spacing: 1 mm, horizon: 2.015}\nbody: {box: {from: [0, 0, 0], to: [6 mm, 6 mm, 12 mm]}}\n"            \
    "boundary:\n  - {name: foot, fixed: all, region: {box: {from: [-inf, -inf, -inf], to: [inf, inf, 2 mm]}}}\n"       \
    "  - {traction: [1 MPa, 0, 1 MPa], face: z+}\n"

#define STATIC "solver=static", "steps.number=1"
#define EXACT "solver_tolerance=1e-7"

/* ---- work of stretching ------------------------------------------------------------------------------------------ */

/* Compares the work up to a stretch of a yielding, hardening bond of stiffness 1 with the midpoint rule over 100,000
 * steps. */
static void test_stretch_work(void **state)
{
    (void)state;
    enum { STEPS = 100000 };
    const real yield = 0.0031, hardening = 0.27, end = 0.0123;
    real work = 0;
    for (int k = 0; k < STEPS; k++) {
        const real at = (k + 0.5) * end / STEPS, beyond = fmax(0, at - yield);
        work += end / STEPS * (at - beyond + hardening / (1 + hardening) * beyond);
    }
    near_to("work", bond_normalised_work_to_elastic_stretch(end, yield, hardening), work, 1e-8);
    near_to("elastic", bond_normalised_work_to_elastic_stretch(0.9 * yield, yield, hardening),
            0.5 * 0.81 * yield * yield, 1e-12);
}

/* ---- comparison with the static solvers -------------------------------------------------------------------------- */

/* Compares load steps with the static solver for every bond model in 2D and 3D, with loads and driven particles, within
 * 5e-6: a residual of 1e-7 and the square of strains. */
static void test_models(void **state)
{
    (void)state;
    static const char *const model[] = {"model=bond", "model=ospd", "model=mospd"};
    static const char *const scene[] = {HELD, DRIVEN, BLOCK};
    for (int m = 0; m < 3; m++)
        for (size_t k = 0; k < COUNT_OF(scene); k++) {
            struct solution a, b;
            const char *poisson = m == 0 ? "name=same" : "material.poisson=0.2";
            solution_run(&a, scene[k], STATIC, EXACT, model[m], poisson, NULL);
            solution_run(&b, scene[k], "solver=cg", EXACT, model[m], poisson, NULL);
            solution_done(&a), solution_done(&b);
            assert_true(solution_difference(&a, &b) < 5e-6);
            near_to("energy", a.e.diagnostics->now.energy.strain, a.e.diagnostics->now.external_work, 1e-6);
            assert_true(a.e.statics->balance.directions < 40);
            solution_free(&a), solution_free(&b);
        }
}

/* Compares load steps with the static solver for an irregular lattice, surface correction of bond weights, and plane
 * strain. The reaction must be the applied force. */
static void test_variants(void **state)
{
    (void)state;
    static const char *const variant[][2] = {{"particles.irregularity=0.5", "pd.surface=volume"},
                                             {"pd.surface=volume", "name=same"},
                                             {"space=plane strain", "name=same"}};
    for (size_t k = 0; k < COUNT_OF(variant); k++) {
        struct solution a, b;
        solution_run(&a, HELD, STATIC, EXACT, variant[k][0], variant[k][1], NULL);
        solution_run(&b, HELD, "solver=cg", EXACT, variant[k][0], variant[k][1], NULL);
        solution_done(&a), solution_done(&b);
        assert_true(solution_difference(&a, &b) < 5e-6);
        near_to("reaction", a.e.loads.load[1].reaction[1], -10, 1e-6);
        solution_free(&a), solution_free(&b);
    }
}

/* Compares material points in the reference frame (load steps) with the current frame (relaxation), far from free
 * faces, where the shape functions of points differ. */
static void test_points(void **state)
{
    (void)state;
    struct solution a, b;
    solution_run(&a, HELD, STATIC, EXACT, "method=mpm", "mpm.frame=reference", NULL);
    solution_run(&b, HELD, "solver=relaxation", "solver_tolerance=1e-5", "method=mpm", NULL);
    solution_done(&a), solution_done(&b);
    assert_true(solution_difference(&a, &b) < 5e-5);
    near_to("reaction", a.e.loads.load[1].reaction[1], -10, 1e-6);
    near_to("energy", a.e.diagnostics->now.energy.strain, a.e.diagnostics->now.external_work, 1e-6);
    solution_free(&a), solution_free(&b);
}

/* ---- mirrors ----------------------------------------------------------------------------------------------------- */

/* Checks that a quarter of a free body between mirrors agrees with the whole body, for particles and for material
 * points. */
static void test_quarter(void **state)
{
    (void)state;
    static const char *const method[][2] = {
        {"method=pd", "model=bond"}, {"method=pd", "model=ospd"}, {"method=mpm", "mpm.frame=reference"}};
    for (size_t k = 0; k < COUNT_OF(method); k++) {
        struct solution whole, part;
        solution_run(&whole, WHOLE PULLED, STATIC, EXACT, method[k][0], method[k][1], NULL);
        solution_run(&part, QUARTER("0", "5 mm"), STATIC, EXACT, method[k][0], method[k][1], NULL);
        solution_done(&whole), solution_done(&part);
        assert_true(solution_difference(&whole, &part) < 1e-6);
        near_to("energy", 4 * part.e.diagnostics->now.energy.strain, whole.e.diagnostics->now.energy.strain, 1e-6);
        const int64_t directions = whole.e.statics->balance.directions; /* springs to images do not constrain motion */
        assert_in_range(part.e.statics->balance.directions, 1, directions + 4);
        solution_free(&whole), solution_free(&part);
    }
}

/* ---- fragments --------------------------------------------------------------------------------------------------- */

/* Checks a crack through the whole plate: the upper part, an unconstrained fragment under balanced loads, has the
 * strain of a free plate, while supports act on the lower part only. */
static void test_parted(void **state)
{
    (void)state;
    struct solution a;
    static const char parted[] =
        WHOLE "cracks:\n  - {from: [-6 mm, 0.1 mm], to: [6 mm, 0.1 mm]}\ncontact: {between: none}\nboundary:\n"
              "  - {traction: [1 MPa, 0], face: x+}\n  - {traction: [-1 MPa, 0], face: x-}\n" FOOT;
    solution_run(&a, parted, STATIC, EXACT, NULL);
    solution_done(&a);
    const real along = solution_moved(&a, 0, 4.25e-3, 2.75e-3, 0) - solution_moved(&a, 0, -4.25e-3, 2.75e-3, 0);
    near_to("strain", along / 8.5e-3, 5e-8, 0.02); /* lattice along its axes, and faces */
    const real aside = solution_moved(&a, 0, 4.25e-3, 2.75e-3, 0) + solution_moved(&a, 0, -4.25e-3, 2.75e-3, 0);
    assert_true(fabs(aside) < 1e-6 * along);
    solution_free(&a);
}

/* Checks the numbers of unconstrained fragments and of their rigid motions that mirrors and supports leave, for mirrors
 * between particles and through them, and for particles and cells. */
static void test_motions(void **state)
{
    (void)state;
    static const struct {
        const char *scene, *method, *frame;
        int pieces, motions;
    } body[] = {
        {WHOLE PULLED, "method=pd", "name=same", 1, 3},
        {WHOLE PULLED, "method=mpm", "mpm.frame=reference", 1, 3},
        {HELD, "method=pd", "name=same", 0, 0},
        {QUARTER("0", "5 mm"), "method=pd", "name=same", 0, 0},
        {QUARTER("-0.25 mm", "4.75 mm"), "method=pd", "name=same", 0, 0},
        {QUARTER("0", "5 mm"), "method=mpm", "mpm.frame=reference", 0, 0},
        {WHOLE PULLED "  - {mirror: {axis: x, at: -5 mm}}\n", "method=pd", "name=same", 1, 1},
        {WHOLE PULLED "  - {mirror: {axis: x, at: -4.75 mm}}\n", "method=pd", "name=same", 1, 1},
        {WHOLE PULLED "  - {mirror: {axis: x, at: -5 mm}}\n", "method=mpm", "mpm.frame=reference", 1, 1},
        {WHOLE PULLED "  - {mirror: {axis: x, at: -5 mm, tangential: held}}\n", "method=pd", "name=same", 0, 0},
    };
    for (size_t k = 0; k < COUNT_OF(body); k++) {
        struct solution a;
        solution_make(&a, body[k].scene, STATIC, body[k].method, body[k].frame, NULL);
        solution_done(&a);
        statics_equation_system_make(&a.e);
        assert_int_equal(a.e.statics->fragments, body[k].pieces);
        if (body[k].pieces > 0) assert_int_equal(a.e.statics->fragment[0].motions, body[k].motions);
        statics_free(a.e.statics);
        solution_free(&a);
    }
}

/* ---- trial increments -------------------------------------------------------------------------------------------- */

#define YIELDS                                                                                                         \
    "space: plane stress\nthickness: 1 mm\nduration: 1 s\nmethod: pd\nsolver: static\nsteps: {number: 4}\n"            \
    "material: {young: 200 GPa, density: 7850, critical_stretch: 2e-3, yield_stress: 200 MPa, yield_tangent: 20 "      \
    "GPa}\n"                                                                                                           \
    "particles: {spacing: 0.5 mm, horizon: 3.015}\n"                                                                   \
    "body: {box: {from: [-5 mm, -5 mm], to: [5 mm, 5 mm]}}\n" CRACK                                                    \
    "boundary:\n  - {velocity: [0, 12 um/s], region: {box: {from: [-inf, 4 mm], to: [inf, inf]}}}\n" FOOT

/* Copy of the state that a trial crack increment must restore. */
struct trace {
    size_t size;
    char *data;
};
static void trace_add(struct trace *t, const void *data, size_t size)
{
    t->data = realloc(t->data, t->size + size);
    memcpy(t->data + t->size, data, size);
    t->size += size;
}
static void trace_take(struct trace *t, const struct run *run)
{
    const struct bonds *b = &run->bonds;
    const real energy[] = {bonds_fracture_energy(b),
                           b->plastic_stretch ? bond_plastic_work(b) : 0,
                           run->loads.work,
                           run->loads.constraint_work,
                           run->statics->balance.lost,
                           run->damped,
                           run->loads.load[0].reaction[1],
                           run->statics->stretch_ratio};
    *t = (struct trace){0};
    trace_add(t, energy, sizeof energy);
    trace_add(t, b->broken_volume, (size_t)b->rows * sizeof *b->broken_volume);
    for (int d = 0; d < run->part.dim; d++) {
        trace_add(t, run->part.x[d], (size_t)run->part.n * sizeof(real));
        trace_add(t, run->statics->balance.u.of[d], (size_t)run->statics->balance.n * sizeof(real));
        trace_add(t, run->statics->balance.f.of[d], (size_t)run->statics->balance.n * sizeof(real));
    }
    trace_add(t, run->part.damage, (size_t)run->part.n * sizeof(real));
    trace_add(t, run->part.flag, (size_t)run->part.n);
}

/* Checks that the search for a crack increment by trial equilibria restores energies, positions, forces and damage
 * bitwise, in bodies with and without yielding bonds. */
static void test_trial(void **state)
{
    (void)state;
    static const char *const variant[][2] = {{"steps.path=bonds", "name=same"},
                                             {"steps.path=bonds", "material.yield_stress=inf"},
                                             {"model=ospd", "material.yield_stress=inf"},
                                             {"method=adaptive", "material.yield_stress=inf"}};
    for (size_t k = 0; k < COUNT_OF(variant); k++) {
        struct solution a;
        struct trace before, after;
        solution_make(&a, YIELDS, variant[k][0], variant[k][1], k == 3 ? "steps.path=bonds" : "name=same", NULL);
        solution_done(&a);
        statics_equation_system_make(&a.e);
        assert_int_equal(equilibrium_find_at_time(&a.e, 0.25), OK);
        assert_int_equal(equilibrium_find_at_time(&a.e, 0.9), OK);
        assert_int_equal(equilibrium_convert_points_to_pd_and_solve_again(&a.e, 0), OK);
        if (k == 0) assert_true(bond_plastic_work(&a.e.bonds) > 0);
        trace_take(&before, &a.e);
        assert_int_equal(crack_increment_find_by_trial_equilibria(&a.e), OK);
        assert_true(a.e.statics->next.n > 0 || a.e.statics->sif.n > 0);
        trace_take(&after, &a.e);
        assert_int_equal(before.size, after.size);
        assert_memory_equal(before.data, after.data, before.size);
        free(before.data), free(after.data);
        statics_free(a.e.statics);
        solution_free(&a);
    }
}

/* ---- release ----------------------------------------------------------------------------------------------------- */

/* Two blocks on each other, of which the lower one is fixed at its foot and the upper one is loaded on its whole
 * width. */
#define STACK                                                                                                          \
    "space: plane stress\nthickness: 1.7 mm\nduration: 1 s\nmethod: pd\nsolver: static\nsteps: {number: 3}\n"          \
    "material: {young: 3 GPa, poisson: 1/3, density: 1180 kg/m^3}\nparticles: {spacing: 1 mm, horizon: 2.015}\n"       \
    "bodies:\n  - {name: low, shape: {box: {from: [0, 0], to: [8 mm, 4 mm]}}}\n"                                       \
    "  - {name: high, shape: {box: {from: [1 mm, 4 mm], to: [7 mm, 7 mm]}}}\n"                                         \
    "boundary:\n  - {name: foot, fixed: [x, y], region: {box: {from: [-inf, 0], to: [inf, 2 mm]}}}\n"                  \
    "  - {name: top, body: high, traction: [0, -2.3 MPa], face: y+, time: {ramp: {until: 1 s}}}\n"

/* Checks a dynamic release: an upper block that has been pushed into the lower one returns to its position. The
 * dissipated energy must be the contact energy of the push less the work against the traction on the return. */
static void test_let_go(void **state)
{
    (void)state;
    struct solution a;
    const real push = 0.02e-3, force = 0.6 * 2.3e6 * 1.7e-3 * 6e-3;
    solution_make(&a, STACK, NULL);
    solution_done(&a);
    struct particles *p = &a.e.part;
    statics_equation_system_make(&a.e);
    assert_int_equal(equilibrium_find_at_time(&a.e, 0.6), OK);
    const real rests = contact_elastic_energy(a.e.contact, p), lost = a.e.statics->balance.lost, damped = a.e.damped;
    for (int64_t i = 0; i < p->n; i++)
        if (p->X[1][i] > 4e-3) p->x[1][i] -= push;
    const real pushed = contact_elastic_energy(a.e.contact, p);
    assert_true(rests > 0 && pushed > 100 * rests);
    assert_int_equal(crack_increment_apply_by_dynamic_release(&a.e), OK);
    /* The tolerance of equilibria is 1e-5. */
    near_to("contact", contact_elastic_energy(a.e.contact, p), rests, 1e-4);
    near_to("lost", a.e.statics->balance.lost - lost, pushed - rests - force * push, 1e-5);
    near_to("damped", a.e.damped - damped, pushed - rests - force * push, 1e-5);
    statics_free(a.e.statics);
    solution_free(&a);
}

/* Checks control by opening: the distance of two positions increases by the prescribed amount in the prescribed number
 * of steps. */
static void test_opening(void **state)
{
    (void)state;
    static const char *const steps[] = {
        "steps={number: 3, control: opening, from: [-4.75 mm, 0.75 mm], to: [-4.25 mm, -0.75 mm], opening: 0.37 nm}"};
    struct solution a;
    solution_run(&a, WHOLE CRACK "boundary:\n  - {traction: [0, 1 MPa], face: y+, time: {ramp: {until: 1 s}}}\n" FOOT,
                 "solver=static", steps[0], EXACT, NULL);
    solution_done(&a);
    const struct particles *p = &a.e.part;
    const int64_t i = solution_at(&a, -4.75e-3, 0.75e-3, 0), j = solution_at(&a, -4.25e-3, -0.75e-3, 0);
    const real opened = hypot(p->x[0][i] - p->x[0][j], p->x[1][i] - p->x[1][j]) -
                        hypot(p->X[0][i] - p->X[0][j], p->X[1][i] - p->X[1][j]);
    near_to("opening", opened, 0.37e-9, 2e-4);
    assert_int_equal(a.e.clock.step, 3);
    solution_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stretch_work), cmocka_unit_test(test_models),  cmocka_unit_test(test_variants),
        cmocka_unit_test(test_points),       cmocka_unit_test(test_quarter), cmocka_unit_test(test_parted),
        cmocka_unit_test(test_motions),      cmocka_unit_test(test_trial),   cmocka_unit_test(test_opening),
        cmocka_unit_test(test_let_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
