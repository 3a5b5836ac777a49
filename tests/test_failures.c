/* floor 5: scenes in which methods fail, each with the figure at which it fails, and with what cures it (design sheet of the
 * material point method, 1.2, 1.3, 4g). */
#include <stdarg.h>
#include <setjmp.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "../bench/stability.h"
#include "memory.h"
#include "near.h"

#define BAR "space: line\nmaterial: {young: 1e4, density: 1}\nparticles: {spacing: 0.01}\noutput: {frames: 0, samples: 1}\n"

/* A scene with overrides of the form key=value, NULL at the end. */
static void scene_make(struct engine *e, struct scene *s, const char *text, const char *const *set)
{
    struct bench_overrides o = {0};
    for (; set && *set; set += 2) bench_override(&o, set[0], "%s", set[1]);
    assert_ok(bench_engine_make(e, s, "scene", text, bench_overrides_ready(&o), o.n));
}
#define SET(...) ((const char *const[]){__VA_ARGS__, NULL})

/* ---- uniform stress in a body that has been stretched -------------------------------------------------------------- */

/* Largest force on an inner node over stress and section, at the worst place of the points in their cells. */
static double residual(const char *shape, double lambda)
{
    struct engine e;
    struct scene s;
    double most = 0;
    scene_make(&e, &s, BAR "duration: 1e-3\nmethod: mpm\nbody: {box: {from: [0], to: [0.6]}}\n", SET("mpm.shape", shape));
    struct particles *p = &e.part;
    for (int place = 0; place < 64; place++) {
        real from[DIM_MAX] = {-0.1}, to[DIM_MAX] = {0.1 + 0.6 * lambda};
        bool changed;
        for (int64_t i = 0; i < p->n; i++) {
            p->x[0][i] = lambda * p->X[0][i] + (place + 0.37) / 64 * e.grid.h;
            p->stress[0][i] = 1, p->volume[i] = lambda * p->volume0[i];
            if (p->stretch[0]) p->stretch[0][i] = lambda;
        }
        assert_ok(grid_cover(&e.grid, from, to, 100000, &changed));
        transfer_order_sort(&e.order, p, p->list_free, p->n_free, &e.grid);
        grid_clear(&e.grid);
        e.kernels.p2g(&e.grid, p, &e.transfer);
        for (int64_t I = 0; I < e.grid.n; I++) {
            const double x = e.grid.anchor[0] + (double)(I + e.grid.first[0]) * e.grid.h;
            if (x > 0.15 && x < 0.6 * lambda - 0.1) most = fmax(most, fabs(e.grid.force[0][I]));
        }
    }
    bench_engine_free(&e, &s);
    return most;
}

/* The sheet's table, in units of stress times section; worst places fall between the 64 tried: 0.02. Forces where there should be
 * none tear the body: numerical fracture beyond a stretch of h/D = 2. Points that stretch along (cpgimp) put it off until they are
 * two cells wide, at 4. */
static void test_crossing(void **state)
{
    (void)state;
    static const double lambda[] = {1, 1.1, 1.5, 3, 6};
    static const struct { const char *shape; double want[4]; } row[] = {
        {"linear", {0, 0.55, 0.75, 1.5}}, {"gimp", {0, 0.055, 0.375, 1.5}}, {"quadratic", {0, 0.055, 0.19, 0.75}},
        {"cpgimp", {0, 0, 0, 0}}};
    for (size_t r = 0; r < COUNT_OF(row); r++)
        for (size_t k = 0; k < COUNT_OF(lambda); k++) {
            const double found = residual(row[r].shape, lambda[k]);
            if (k == 4) assert_true(found > 0.1);
            else assert_near(found, row[r].want[k], row[r].want[k] > 0 ? 0.02 : 1e-12);
        }
}

/* v = a X, 5 % and 20 % in 100 D/c: largest error of the stress in the middle, which the ends do not reach. Of the sheet: linear 1.8 and
 * 2.4, uGIMP 0.06 and 0.54, quadratic 0.05 and 0.39; none where points stretch along. */
static double stretched(const char *shape, double strain)
{
    struct engine e;
    struct scene s;
    char rate[32];
    double most = 0;
    snprintf(rate, sizeof rate, "%.9g", strain / (100 * 0.01 / 100));
    char text[1024];
    snprintf(text, sizeof text, BAR "duration: 0.01\ntime: {step: 1e-5}\nmethod: mpm\nbody: {box: {from: [-2.5], to: [2.5]}}\n"
             "initial: [{velocity_gradient: [[%s]]}]\n", rate);
    scene_make(&e, &s, text, SET("mpm.shape", shape));
    assert_ok(engine_run(&e));
    for (int64_t i = 0; i < e.part.n; i++)
        if (fabs(e.part.X[0][i]) < 1) most = fmax(most, fabs(e.part.stress[0][i] / (1e4 * log(1 + strain)) - 1));
    bench_engine_free(&e, &s);
    return most;
}

static void test_homologous(void **state)
{
    (void)state;
    static const struct { const char *shape; double at_5[2], at_20[2]; } row[] = {   /* least and most */
        {"linear", {1, 2.5}, {1, 3}}, {"gimp", {0, 0.065}, {0.3, 0.7}}, {"quadratic", {0, 0.06}, {0.2, 0.5}},
        {"cpgimp", {0, 0.001}, {0, 0.002}}};
    for (size_t k = 0; k < COUNT_OF(row); k++) {
        const double small = stretched(row[k].shape, 0.05), large = stretched(row[k].shape, 0.2);
        assert_true(small >= row[k].at_5[0] && small <= row[k].at_5[1]);
        assert_true(large >= row[k].at_20[0] && large <= row[k].at_20[1]);
    }
}

/* ---- what the grid cannot see ---------------------------------------------------------------------------------------- */

/* Two points a cell, at h/4 and 3h/4, with +-v: nodes see nothing. Share of the energy that is left after some steps. */
static double null_mode(const char *transfer, int steps)
{
    struct engine e;
    struct scene s;
    scene_make(&e, &s, BAR "duration: 1\nmethod: mpm\nbody: {box: {from: [0], to: [0.8]}}\n",
               SET("mpm.transfer", transfer, "mpm.shape", "gimp"));
    for (int64_t i = 0; i < e.part.n; i++) e.part.v[0][i] = i % 2 ? 1e-3 : -1e-3;
    const double first = watch_kinetic(&e.part);
    assert_ok(bench_engine_run(&e, steps, NULL));
    const double left = watch_kinetic(&e.part) / first;
    bench_engine_free(&e, &s);
    return left;
}

static void test_null_mode(void **state)
{
    (void)state;
    assert_true(null_mode("flip", 1000) > 0.99);
    assert_true(null_mode("apic", 1) < 0.01);        /* what is left is at the ends */
}

/* ---- places in the cells ------------------------------------------------------------------------------------------------ */

/* Points on the faces of cells, or beside them where nodes beyond the edge have a mass of 1e-9 or less, in a body that moves as it
 * is: largest stress over rho c v. Round-off of 300 s at c = 1 m/s. */
static double on_faces(const char *shape, const char *transfer, double offset)
{
    struct engine e;
    struct scene s;
    char origin[64];
    double most = 0;
    snprintf(origin, sizeof origin, "[%.17g, %.17g]", offset, offset);
    scene_make(&e, &s, "space: plane stress\nthickness: 1\nduration: 3\nmethod: mpm\nmaterial: {young: 1, density: 1}\n"
               "body: {box: {from: [0, 0], to: [12, 8]}}\nparticles: {spacing: 1}\ninitial: [{velocity: [0.03125, -0.0625]}]\n"
               "output: {frames: 0, samples: 1}\n",
               SET("mpm.shape", shape, "mpm.transfer", transfer, "mpm.origin", origin, "duration", "300"));
    assert_ok(engine_run(&e));
    for (int c = 0; c < 3; c++)
        for (int64_t i = 0; i < e.part.n; i++) most = fmax(most, fabs(e.part.stress[c][i]) / 0.07);
    bench_engine_free(&e, &s);
    return most;
}

static void test_faces(void **state)
{
    (void)state;
    static const char *const shape[] = {"linear", "gimp", "cpgimp", "quadratic", "cubic"};
    for (int k = 0; k < 5; k++)
        for (int a = k == 0 ? 1 : 0; a < 2; a++)
            for (int near = 0; near < 2; near++)
                assert_true(on_faces(shape[k], a ? "flip" : "apic", 0.5 - near * 1e-9) < 1e-12);
}

/* ---- particles that come off ---------------------------------------------------------------------------------------- */

/* A corner torn off: every family it was in has lost it, and its own is empty. Breaking is second order in the step: at a fifth of the
 * critical one bonds leave some percent of this energy too much or too little. */
static void test_single(void **state)
{
    (void)state;
    static const char *const model[] = {"bond", "ospd", "mospd"}, *const method[] = {"pd", "adaptive"};
    for (int a = 0; a < 2; a++)
        for (int m = 0; m < 3; m++) {
            struct engine e;
            struct scene s;
            scene_make(&e, &s, "space: plane stress\nthickness: 1e-3\nduration: 2e-5\nmaterial: {young: 72e9, density: 2440, "
                       "critical_stretch: 0.01, poisson: 1/3}\nbody: {box: {from: [0, 0], to: [12e-3, 12e-3]}}\n"
                       "particles: {spacing: 1e-3}\n"
                       "initial:\n  - {velocity: [400, 300], region: {box: {from: [11e-3, 11e-3], to: [inf, inf]}}}\n"
                       "output: {frames: 0, samples: 20}\n", SET("model", model[m], "method", method[a], "time.safety", "0.2"));
            const status ran = engine_run(&e);
            int64_t i = e.part.n - 1;
            assert_int_equal(ran, OK);
            assert_true(e.watch.now.momentum_error < 1e-13);
            assert_true(isfinite(e.part.x[0][i]) && e.part.v[0][i] > 100);
            assert_true(fabs(e.watch.now.balance_error) < 0.05);
            bench_engine_free(&e, &s);
        }
}

/* ---- compression past inversion -------------------------------------------------------------------------------------------- */

/* Halves of a plate of bonds meet at +-v: pairs of neighbours that have changed sides at the end. */
static int inverted(const char *model, double speed)
{
    struct engine e;
    struct scene s;
    char text[1024];
    int pairs = 0;
    snprintf(text, sizeof text,
             "space: plane stress\nthickness: 1\nduration: 0.3\ntime: {safety: 0.2}\nmethod: pd\nmodel: %s\n"
             "material: {young: 1e4, density: 1}\nbody: {box: {from: [0, 0], to: [40, 6]}}\nparticles: {spacing: 1}\n"
             "initial:\n  - {velocity: [%g, 0]}\n"
             "  - {velocity: [%g, 0], region: {box: {from: [20, -inf], to: [inf, inf]}}}\n"
             "output: {frames: 0, samples: 10}\n", model, 100 * speed, -100 * speed);
    assert_ok(bench_engine_make(&e, &s, "halves", text, NULL, 0));
    assert_ok(engine_run(&e));
    for (int64_t i = 0; i + 1 < e.part.n; i++)
        pairs += e.part.X[0][i + 1] > e.part.X[0][i] && e.part.x[0][i + 1] < e.part.x[0][i];
    assert_true(fabs(e.watch.now.balance_error) < 0.05);
    bench_engine_free(&e, &s);
    return pairs;
}

/* A bond of no length has a finite force: at 0.2 c, a compression of 45 %, neighbours stay in their order, at 0.6 c, they have passed
 * through each other and nothing is said. Energies balance all the same. */
static void test_inversion(void **state)
{
    (void)state;
    static const char *const model[] = {"bond", "ospd", "mospd"};
    for (int m = 0; m < 3; m++) {
        assert_int_equal(inverted(model[m], 0.2), 0);
        assert_true(inverted(model[m], 0.6) > 0);
    }
}

/* ---- a coupled disc turns -------------------------------------------------------------------------------------------- */

/* At the interface APIC leaves 110 to 240 MPa of shear where the sheet has 110, and 0.4 % of the energy; the reference frame
 * 0.6 MPa and 1e-6. Radius 10 mm, edge at 100 m/s, one turn, peridynamic within 4 mm: angular momentum, energy, and largest shear [Pa]. */
static void disc(const char *frame, const char *transfer, double *momentum, double *energy, double *shear)
{
    struct engine e;
    struct scene s;
    scene_make(&e, &s, "space: plane stress\nthickness: 1e-3\nduration: 6.2831853e-4\nmethod: adaptive\n"
               "material: {young: 192e9, density: 8000}\nbody: {disc: {centre: [0, 0], radius: 10e-3}}\n"
               "particles: {spacing: 0.5e-3}\npd: {region: {disc: {centre: [0, 0], radius: 4e-3}}}\n"
               "conversion: {criteria: none}\ninitial: [{velocity_gradient: [[0, -1e4], [1e4, 0]]}]\n"
               "output: {frames: 0, samples: 2}\n",
               SET("mpm.frame", frame, "mpm.transfer", transfer));
    const struct particles *p = &e.part;
    double turn[2], kinetic[2];
    for (int k = 0; k < 2; k++) {
        if (k == 1) assert_ok(engine_run(&e));
        turn[k] = 0, kinetic[k] = 0;
        for (int64_t i = 0; i < p->n; i++) {
            turn[k] += p->mass[i] * (p->x[0][i] * p->v[1][i] - p->x[1][i] * p->v[0][i]);
            kinetic[k] += 0.5 * p->mass[i] * (square(p->v[0][i]) + square(p->v[1][i]));
        }
    }
    *momentum = turn[1] / turn[0] - 1, *energy = kinetic[1] / kinetic[0] - 1, *shear = 0;
    for (int64_t i = 0; i < p->n; i++)
        if (p->kind[i] == KIND_MPM) *shear = fmax(*shear, fabs(p->stress[2][i]));
    bench_engine_free(&e, &s);
}

static void test_disc(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        double momentum, energy, shear;
        disc(k ? "reference" : "current", "apic", &momentum, &energy, &shear);
        if (k == 0) assert_true(fabs(momentum) < 1e-4 && fabs(energy) < 6e-3 && shear > 50e6 && shear < 400e6);
        else assert_true(fabs(momentum) < 1e-5 && fabs(energy) < 1e-5 && shear < 15e6);
    }
}

/* ---- long runs -------------------------------------------------------------------------------------------------------- */

static double energy_of(struct engine *e)
{
    const double kinetic = watch_kinetic(&e->part);
    return kinetic + e->kernels.bond_energy(&e->bonds, &e->part) + watch_strain(&e->part, e->scene->material, &e->partial);
}

/* A million steps of a free vibrating plate. */
static void test_million(void **state)
{
    (void)state;
    struct engine e;
    struct scene s;
    const int team = omp_get_max_threads();
    omp_set_num_threads(1);
    scene_make(&e, &s, "space: plane stress\nthickness: 1e-3\nduration: 1\nmethod: pd\nmaterial: {young: 72e9, density: 2440}\n"
               "body: {box: {from: [0, 0], to: [5e-3, 4e-3]}}\nparticles: {spacing: 1e-3}\n"
               "initial: [{velocity_gradient: [[300, 100], [0, -200]], centre: [2.5e-3, 2e-3]}]\noutput: {frames: 0, samples: 1}\n", NULL);
    assert_ok(bench_engine_run(&e, 1, NULL));
    double mean[2] = {0};
    for (int k = 0; k < 1000000; k++) {
        assert_ok(engine_step(&e));
        if (k < 20000) mean[0] += energy_of(&e) / 20000;
        if (k >= 980000) mean[1] += energy_of(&e) / 20000;
    }
    assert_true(fabs(mean[1] / mean[0] - 1) < 1e-3);     /* measured: 1e-6 */
    bench_engine_free(&e, &s);
    omp_set_num_threads(team);
}

/* A bar of 64 spacings in its first free mode, ten periods: share of its energy that is left. Peaks fall between samples: 1e-3. APIC
 * loses 0.08 % with GIMP, 0.3 % with quadratic shapes. */
static double vibration(const char *method, const char *transfer, const char *shape, const char *frame)
{
    struct engine e;
    struct scene s;
    scene_make(&e, &s, BAR "duration: 0.128\nbody: {box: {from: [0], to: [0.64]}}\n",
               SET("method", method, "mpm.transfer", transfer, "mpm.shape", shape, "mpm.frame", frame));
    for (int64_t i = 0; i < e.part.n; i++) e.part.v[0][i] = 0.01 * cos(3.14159265358979 * e.part.X[0][i] / 0.64);
    struct grid *g = &e.mesh.grid;
    for (int64_t I = 0; e.mesh.points > 0 && I < g->n; I++)
        g->velocity[0][I] = 0.01 * cos(3.14159265358979 * (g->anchor[0] + (double)(I + g->first[0]) * g->h) / 0.64);
    assert_ok(bench_engine_run(&e, 1, NULL));
    double first = 0, last = 0;
    const int64_t period = e.steps / 10;
    while (e.step < e.steps - 1) {
        assert_ok(engine_step(&e));
        const double kinetic = watch_kinetic(&e.part) + mesh_kinetic(&e.mesh);
        if (e.step < period) first = fmax(first, kinetic);
        if (e.step >= e.steps - period) last = fmax(last, kinetic);
    }
    bench_engine_free(&e, &s);
    return last / first;
}

static void test_dissipation(void **state)
{
    (void)state;
    static const struct { const char *method, *transfer, *shape, *frame; double low, high; } row[] = {
        {"pd", "flip", "gimp", "current", 0.999, 1.001}, {"mpm", "flip", "gimp", "current", 0.999, 1.001},
        {"mpm", "flip", "gimp", "reference", 0.999, 1.001}, {"mpm", "apic", "gimp", "current", 0.9985, 0.9995},
        {"mpm", "apic", "quadratic", "current", 0.996, 0.998}};
    for (size_t k = 0; k < COUNT_OF(row); k++) {
        const double left = vibration(row[k].method, row[k].transfer, row[k].shape, row[k].frame);
        assert_true(left > row[k].low && left < row[k].high);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crossing), cmocka_unit_test(test_homologous), cmocka_unit_test(test_null_mode), cmocka_unit_test(test_faces),
        cmocka_unit_test(test_single), cmocka_unit_test(test_inversion),
        cmocka_unit_test(test_disc), cmocka_unit_test(test_dissipation), cmocka_unit_test(test_million)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
