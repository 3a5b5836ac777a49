/* Tests clamped planes (`mirror: ..., tangential: held`): forces derive from an energy for every bond model, at corners
 * and for irregular particles; long runs of beams keep their energy; support forces balance the loads. */
#include <math.h>
#include <omp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "tests/support/eigen.h"
#include "engine/engine.h"
#include "base/memory.h"
#include "tests/support/near.h"
#include "base/team.h"
#include "step/report.h"
#include "probes/diagnostics.h"
#include "scene/scene_read.h"
#include "loads/mirrors.h"

/* Step of finite differences of forces [spacings]. Its second-order error is below 1e-9 of the largest entry; the
 * resolution of stretches, 2^-49, gives 1e-10. */
#define STEP 2e-5
#define SYMMETRIC 1e-8 /* relative to the largest entry; without the energy it is 0.1 */
#define NEGATIVE 1e-8  /* relative to the largest entry: round-off of zero modes, which a clamped body does not have */
/* Step of finite differences of energies [spacings]: the error is the square, 4e-8, times third derivatives of order
 * one. */
#define SLIDE 2e-4
#define GRADIENT 1e-6

#define PLANE "space: plane stress\nthickness: 1 mm\nduration: 1 us\nmethod: pd\n"
#define STEEL "material: {young: 200 GPa, poisson: 1/3, density: 7850}\n"
#define SMALL "body: {box: {from: [0, 0], to: [8 mm, 6 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n"
#define LEFT "boundary:\n  - {mirror: {axis: x, at: 0, tangential: held}}\n"
#define BELOW_FREE "  - {mirror: {axis: y, at: 0, tangential: free}}\n"
#define BELOW_HELD "  - {mirror: {axis: y, at: 0, tangential: held}}\n"
#define FREE_FIRST "boundary:\n" BELOW_FREE "  - {mirror: {axis: x, at: 0, tangential: held}}\n"
#define BLOCK                                                                                                          \
    "space: solid\nduration: 1 us\nmethod: pd\nmaterial: {young: 200 GPa, poisson: 1/4, density: 7850}\n"              \
    "body: {box: {from: [0, 0, 0], to: [4 mm, 5 mm, 4 mm]}}\nparticles: {spacing: 1 mm, horizon: 2.015}\n"

struct body {
    struct scene s;
    struct run e;
};

/* Creates in a the run of the scene `text` with the overrides with[], texts `key=value` terminated by NULL. */
static void body_make(struct body *a, const char *text, const char *const *with)
{
    enum { MOST = 8 };
    static char key[MOST][64];
    struct scene_override override[MOST];
    int n = 0;
    for (; with && with[n]; n++) {
        const char *equal = strchr(with[n], '=');
        snprintf(key[n], sizeof key[n], "%.*s", (int)(equal - with[n]), with[n]);
        override[n] = (struct scene_override){key[n], equal + 1};
    }
    memset(a, 0, sizeof *a);
    assert_ok(scene_read_text(&a->s, text, strlen(text), "clamp.yaml", override, n));
    assert_ok(run_set_up_from_scene(&a->e, &a->s, NULL));
    a->e.report->quiet = true;
}

static void body_free(struct body *a)
{
    run_free_memory(&a->e);
    scene_free(&a->s);
}

/* Computes the forces of the run by the functions that a time step calls, without breaking bonds. */
static void forces(struct run *run)
{
    loads_update_mirror_images_of_particles(&run->loads, &run->part);
    bond_forces(run->kernels.bond_force, &run->bonds, &run->part, &run->source.limit, NULL);
}

static real energy(struct run *run)
{
    forces(run);
    return run->kernels.bond_energy(&run->bonds, &run->part, NULL);
}

/* ---- stiffness --------------------------------------------------------------------------------------------------- */

/* Returns the stiffness matrix -df/dx of the run at the reference positions, n x n for n components, to be freed. */
static real *stiffness_of(struct run *run)
{
    struct particles *p = &run->part;
    const int64_t n = p->dim * p->n;
    const real s = STEP * run->scene->spacing;
    real *K = NEW("test.stiffness", n * n, real);
    for (int64_t k = 0; k < n; k++) {
        real *x = &p->x[k / p->n][k % p->n];
        for (int sign = 1; sign >= -1; sign -= 2) {
            *x = p->X[k / p->n][k % p->n] + sign * s;
            forces(run);
            for (int64_t j = 0; j < n; j++) K[k * n + j] -= sign * p->f[j / p->n][j % p->n] / (2 * s);
        }
        *x = p->X[k / p->n][k % p->n];
    }
    return K;
}

static void check_operator(struct run *run, const char *name)
{
    const int64_t n = run->part.dim * run->part.n;
    real *K = stiffness_of(run), largest = 0, skew = 0;
    for (int64_t k = 0; k < n * n; k++) largest = real_max(largest, fabs(K[k]));
    for (int64_t k = 0; k < n; k++)
        for (int64_t j = 0; j < k; j++) {
            skew = real_max(skew, fabs(K[k * n + j] - K[j * n + k]));
            K[k * n + j] = K[j * n + k] = 0.5 * (K[k * n + j] + K[j * n + k]);
        }
    if (!(skew <= SYMMETRIC * largest))
        fail_msg("%s: the operator's odd part is %.3g of its largest entry", name, skew / largest);
    real *d = NEW("test.eigenvalue", 2 * n, real);
    eigen_symmetric(K, n, d, d + n);
    if (!(d[0] >= -NEGATIVE * largest))
        fail_msg("%s: a mode gains energy: %.3g of the largest entry", name, d[0] / largest);
    memory_free(d);
    memory_free(K);
}

/* Checks, far from the reference positions, that the bond energy of the run changes along random displacements by the
 * work of the forces. name: of the case, for messages. */
static void check_gradient(struct run *run, const char *name)
{
    struct particles *p = &run->part;
    const real h = run->scene->spacing;
    real *way = NEW("test.way", p->dim * p->n, real);
    uint64_t seed = 11;
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) p->x[d][i] = p->X[d][i] + cloud_between(&seed, -0.03, 0.03) * h;
    for (int round = 0; round < 3; round++) {
        real work = 0, size = 0, change = 0;
        forces(run);
        for (int64_t k = 0; k < p->dim * p->n; k++) {
            way[k] = cloud_between(&seed, -1, 1) * SLIDE * h;
            work -= 2 * way[k] * p->f[k / p->n][k % p->n];
            size += fabs(2 * way[k] * p->f[k / p->n][k % p->n]);
        }
        for (int sign = 1; sign >= -1; sign -= 2) {
            for (int64_t k = 0; k < p->dim * p->n; k++) p->x[k / p->n][k % p->n] += (sign > 0 ? 1 : -2) * way[k];
            change += sign * energy(run);
        }
        for (int64_t k = 0; k < p->dim * p->n; k++) p->x[k / p->n][k % p->n] += way[k];
        if (!(fabs(change - work) <= GRADIENT * size))
            fail_msg("%s: energy changes by %.9g J where forces say %.9g", name, change, work);
    }
    memory_free(way);
}

static const struct {
    const char *name, *text, *with[6];
} body_case[] = {
    {"bonds", PLANE STEEL SMALL LEFT, {NULL}},
    {"bonds, plain surface", PLANE STEEL SMALL LEFT, {"pd.surface=none"}},
    {"bonds, isotropic", PLANE STEEL SMALL LEFT, {"pd.weights=isotropic", "particles.horizon=2.015"}},
    {"bonds, plane strain", PLANE STEEL SMALL LEFT, {"space=plane strain", "material.poisson=0.25"}},
    {"bonds, ramp", PLANE STEEL SMALL LEFT, {"pd.volume=ramp"}},
    {"bonds, scattered", PLANE STEEL SMALL LEFT, {"particles.irregularity=0.4"}},
    {"bonds, clamp and symmetry", PLANE STEEL SMALL LEFT BELOW_FREE, {NULL}},
    {"bonds, symmetry and clamp", PLANE STEEL SMALL FREE_FIRST, {NULL}},
    {"bonds, two clamps", PLANE STEEL SMALL LEFT BELOW_HELD, {NULL}},
    {"bonds, cracked", PLANE STEEL SMALL "cracks: [{from: [-1 mm, 3 mm], to: [3 mm, 3 mm]}]\n" LEFT, {NULL}},
    {"ospd", PLANE STEEL SMALL LEFT, {"model=ospd", "material.poisson=0.3"}},
    {"ospd, nu 0.45", PLANE STEEL SMALL LEFT, {"model=ospd", "material.poisson=0.45", "space=plane strain"}},
    {"ospd, bulk, scattered",
     PLANE STEEL SMALL LEFT,
     {"model=ospd", "pd.normalisation=bulk", "particles.irregularity=0.4"}},
    {"ospd, clamp and symmetry", PLANE STEEL SMALL LEFT BELOW_FREE, {"model=ospd"}},
    {"mospd", PLANE STEEL SMALL LEFT, {"model=mospd", "material.poisson=0.2"}},
    {"mospd, nu 0.45", PLANE STEEL SMALL LEFT, {"model=mospd", "material.poisson=0.45", "space=plane strain"}},
    {"mospd, local, horizon 1.5",
     PLANE STEEL SMALL LEFT,
     {"model=mospd", "pd.normalisation=local", "particles.horizon=1.5"}},
    {"mospd, scattered", PLANE STEEL SMALL LEFT, {"model=mospd", "particles.irregularity=0.4"}},
    {"mospd, symmetry and clamp", PLANE STEEL SMALL FREE_FIRST, {"model=mospd"}},
    {"mospd, two clamps", PLANE STEEL SMALL LEFT BELOW_HELD, {"model=mospd"}},
    {"block", BLOCK LEFT, {NULL}},
    {"block, ospd, corner", BLOCK LEFT BELOW_FREE, {"model=ospd"}},
    {"block, mospd", BLOCK LEFT, {"model=mospd", "material.poisson=0.4"}},
    {"block, mospd, three planes",
     BLOCK LEFT BELOW_FREE "  - {mirror: {axis: z, at: 0, tangential: held}}\n",
     {"model=mospd"}},
};

static void test_energy(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(body_case); k++) {
        struct body a;
        body_make(&a, body_case[k].text, body_case[k].with);
        assert_true(a.e.bonds.clamped.n > 0);
        check_operator(&a.e, body_case[k].name);
        check_gradient(&a.e, body_case[k].name);
        body_free(&a);
    }
}

/* Checks bonds that have yielded, each by an amount that depends on the position of its midpoint. The force must be
 * that of the elastic stretch, both from the bond sweep and from the images at clamped planes, which prevent all
 * motion. A bond across the plane of symmetry y = 0 and its image have equal plastic stretch. The yield stress is too
 * high for further yielding. */
static void test_yielded(void **state)
{
    (void)state;
    static const char *const with[] = {"material.yield_stress=50 TPa", NULL};
    struct body a;
    body_make(&a, PLANE STEEL SMALL LEFT BELOW_FREE, with);
    const struct particles *p = &a.e.part;
    struct bonds *b = &a.e.bonds;
    assert_true(b->clamped.n > 0 && b->plastic_stretch);
    for (int64_t row = 0; row < b->rows; row++)
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
            const int32_t i = b->particle[row], j = it.bond.nbr;
            const real x = p->X[0][i] + p->X[0][j], y = p->X[1][i] + p->X[1][j];
            b->plastic_stretch[it.bond.entry] = 0.02 * sin(700 * x) * cos(500 * y);
        }
    check_gradient(&a.e, "bonds that have yielded");
    body_free(&a);
}

/* ---- threads ----------------------------------------------------------------------------------------------------- */

/* A wall with enough bonds for several threads. */
#define WALL                                                                                                           \
    "space: solid\nduration: 1 us\nmethod: pd\nmodel: mospd\nmaterial: {young: 200 GPa, poisson: 1/4, density: "       \
    "7850}\n"                                                                                                          \
    "body: {box: {from: [0, 0, 0], to: [3 mm, 16 mm, 16 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n" LEFT

static void test_threads(void **state)
{
    (void)state;
    struct body a;
    const int before = omp_get_max_threads();
    uint64_t seed = 3;
    body_make(&a, WALL, NULL);
    struct particles *p = &a.e.part;
    real *f = NEW("test.forces", p->dim * p->n, real);
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) p->x[d][i] += cloud_between(&seed, -1e-5, 1e-5);
    for (int threads = 1; threads <= 3; threads++) {
        omp_set_num_threads(threads);
        forces(&a.e);
        for (int d = 0; d < p->dim; d++) {
            if (threads == 1)
                memcpy(f + d * p->n, p->f[d], (size_t)p->n * sizeof *f);
            else
                assert_memory_equal(f + d * p->n, p->f[d], (size_t)p->n * sizeof *f);
        }
    }
    omp_set_num_threads(before);
    assert_true(a.e.bonds.clamped.n > 8000);
    memory_free(f);
    body_free(&a);
}

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Runs e to the end. Returns the largest magnitude of the relative error of the energy balance [1]. */
static real run(struct run *e)
{
    real most = 0;
    assert_ok(report_open_history_and_write_first_frame(e));
    while (e->clock.step < e->clock.steps) {
        assert_ok(run_adapt_mesh_and_advance_one_step(e));
        assert_ok(report_write_outputs_due_after_step(e));
        most = real_max(most, fabs(e->diagnostics->now.balance_error));
    }
    assert_true(e->diagnostics->now.momentum_error < 1e-11); /* round-off of 1e5 steps; supports are included */
    return most;
}

#define BEAM                                                                                                           \
    "space: plane stress\nthickness: 1 mm\nduration: 9 ms\nmethod: pd\n" STEEL                                         \
    "body: {box: {from: [0, 0], to: [20 mm, 4 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n" LEFT                \
    "  - body_force: [0, 1e4]\n    time: {step: {until: 0.2 ms}}\n"

/* Checks beams that vibrate after a load is removed, over at least 25,000 steps: the error of the energy balance, 6e-8
 * measured, stays below 1e-6. Forces at the clamp that do not derive from an energy would stop the first three runs
 * after 3e3 to 3e4 steps. */
static void test_long(void **state)
{
    (void)state;
    static const char *const with[][4] = {{NULL},
                                          {"pd.weights=isotropic", "particles.horizon=2.015"},
                                          {"model=ospd", "material.poisson=0.3"},
                                          {"model=mospd", "material.poisson=0.3"}};
    for (size_t k = 0; k < COUNT_OF(with); k++) {
        struct body a;
        body_make(&a, BEAM, with[k]);
        assert_true(a.e.clock.steps >= 25000);
        const real most = run(&a.e);
        printf("beam of case %d: %lld steps, energy balance %.2g\n", (int)k, (long long)a.e.clock.steps, most);
        assert_true(most < 1e-6);
        body_free(&a);
    }
}

/* Material points beside bonds at the clamp, in the reference frame. The plane is on nodes, or midway between two,
 * where nodes outside move as mirror images. */
#define COUPLED                                                                                                        \
    "space: plane stress\nthickness: 1 mm\nduration: 2 ms\nmethod: adaptive\n" STEEL                                   \
    "body: {box: {from: [0, 0], to: [40 mm, 12 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n"                    \
    "pd: {region: {box: {from: [-inf, -inf], to: [16 mm, 6 mm]}}}\n" LEFT                                              \
    "  - body_force: [0, 1e4]\n    time: {step: {until: 0.2 ms}}\n"

static void test_coupled(void **state)
{
    (void)state;
    static const char *const with[][4] = {{"mpm.frame=reference"},
                                          {"mpm.frame=reference", "mpm.origin=[1 mm, 0]"},
                                          {"mpm.frame=reference", "coupling=handshake"}};
    for (size_t k = 0; k < COUNT_OF(with); k++) {
        struct body a;
        body_make(&a, COUPLED, with[k]);
        assert_true(a.e.bonds.clamped.n > 0 && a.e.part.n_of[KIND_MPM] > 0);
        const real most = run(&a.e);
        printf("coupled, case %d: %lld steps, energy balance %.2g\n", (int)k, (long long)a.e.clock.steps, most);
        assert_true(most < 1e-6);
        body_free(&a);
    }
}

/* Checks a clamped plane through particles: these particles do not move, and the balances of energy and momentum
 * close. */
static void test_in_plane(void **state)
{
    (void)state;
    static const char beam[] = BEAM;
    const char *at = strstr(beam, "at: 0,");
    char text[sizeof beam + 16];
    snprintf(text, sizeof text, "%.*sat: 0.5 mm,%s", (int)(at - beam), beam, at + strlen("at: 0,"));
    struct body a;
    int64_t stay = 0;
    body_make(&a, text, (const char *const[]){"duration=2 ms", NULL});
    assert_true(run(&a.e) < 0.005);
    for (int64_t i = 0; i < a.e.part.n; i++) {
        const bool in_plane = fabs(a.e.part.X[0][i] - 0.5e-3) < 1e-9;
        for (int d = 0; d < 2 && in_plane; d++) assert_exact(a.e.part.x[d][i], a.e.part.X[d][i]);
        stay += in_plane;
    }
    assert_int_equal(stay, 4);
    body_free(&a);
}

#define STRIP                                                                                                          \
    "space: plane stress\nthickness: 1 mm\nduration: 20 us\nmethod: pd\n" STEEL                                        \
    "body: {box: {from: [0, 0], to: [40 mm, 4 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n"                     \
    "boundary:\n  - {mirror: {axis: x, at: 0, tangential: free}}\n"                                                    \
    "  - {mirror: {axis: y, at: 0, tangential: free}}\n  - {mirror: {axis: y, at: 4 mm, tangential: free}}\n"          \
    "  - traction: [1 MPa, 0]\n    face: x+\n    time: {pulse: {from: 0, until: 4 us}}\n"

/* Checks that a plane longitudinal wave is reflected from a clamped plane as from a plane of symmetry, because it has
 * no motion along the plane. */
static void test_reflection(void **state)
{
    (void)state;
    static const char *const model[][2] = {{"model=bond"}, {"model=ospd"}, {"model=mospd"}};
    for (size_t k = 0; k < COUNT_OF(model); k++) {
        struct body a, b;
        char clamped[sizeof STRIP];
        snprintf(clamped, sizeof clamped, "%s", STRIP);
        memcpy(strstr(clamped, "tangential: free"), "tangential: held", 16);
        body_make(&a, STRIP, model[k]), body_make(&b, clamped, model[k]);
        assert_true(a.e.bonds.clamped.n == 0 && b.e.bonds.clamped.n > 0);
        run(&a.e), run(&b.e);
        real most = 0, largest = 0;
        for (int64_t i = 0; i < a.e.part.n; i++) {
            most = real_max(most, fabs(a.e.part.x[0][i] - b.e.part.x[0][i]));
            largest = real_max(largest, fabs(a.e.part.x[0][i] - a.e.part.X[0][i]));
        }
        assert_true(largest > 1e-8 && most < 1e-9 * largest + 1e-17); /* last bits of positions */
        body_free(&a), body_free(&b);
    }
}

#define TORN                                                                                                           \
    "space: plane stress\nthickness: 1 mm\nduration: 6 us\nmethod: pd\n"                                               \
    "material: {young: 200 GPa, poisson: 1/3, density: 7850, critical_stretch: 0.004}\n"                               \
    "body: {box: {from: [0, 0], to: [20 mm, 8 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n" LEFT                \
    "initial: [{velocity: [50, 20]}]\n"

/* Checks a body that tears off its clamp: only bonds to images at the clamp break. Limits of the final error of the
 * energy balance: 1e-3 with half the critical step (6e-5 to 4.3e-4 measured), 1e-4 with an eighth (1.5e-5 to 7e-5). If
 * every breaking bond acted with half its force in its last step, the errors would be up to 5e-3 and 4.5e-4. */
static void test_torn(void **state)
{
    (void)state;
    static const char *const model[] = {"model=bond", "model=ospd", "model=mospd"};
    for (size_t k = 0; k < COUNT_OF(model); k++) {
        real error[2];
        for (int fine = 0; fine < 2; fine++) {
            struct body a;
            int64_t broken = 0;
            body_make(&a, TORN, (const char *const[]){model[k], fine ? "time.safety=0.125" : "time.safety=0.5", NULL});
            run(&a.e); /* during a sampled step, breaking bonds have only one of their two contributions */
            error[fine] = fabs(a.e.diagnostics->now.balance_error);
            for (int64_t q = 0; q < a.e.bonds.clamped.n; q++) broken += a.e.bonds.w[a.e.bonds.clamped.entry[q]] == 0;
            assert_true(broken > a.e.bonds.clamped.n / 2);
            body_free(&a);
        }
        printf("%s: energy balance of tearing %.3g, with a quarter of the step %.3g\n", model[k], error[0], error[1]);
        assert_true(error[0] < 1e-3 && error[1] < 1e-4);
    }
}

/* ---- statics ----------------------------------------------------------------------------------------------------- */

#define CANTILEVER                                                                                                     \
    "space: plane stress\nthickness: 1 mm\nduration: 1 s\nmethod: pd\nsolver: cg\nsolver_tolerance: 1e-5\n" STEEL      \
    "body: {box: {from: [0, 0], to: [50 mm, 10 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n" LEFT               \
    "  - body_force: [0, 1e4]\n"

/* Compares the tip displacement of a cantilever under its own weight b with b L^4/(8 E h^2/12) + b L^2/(2 G 5/6)
 * (Timoshenko 1921), within 2 % for ten layers of particles and every bond model. The clamp carries the weight. */
static void test_cantilever(void **state)
{
    (void)state;
    static const struct {
        const char *with[4];
        real over;
    } model[] = {
        {{"model=bond"}, 0.98}, {{"particles.horizon=2.015"}, 0.984}, {{"model=ospd"}, 0.98}, {{"model=mospd"}, 1.013}};
    const real L = 50e-3, h = 10e-3, young = 200e9, shear = young / (2 * (1 + 1.0 / 3)), b = 1e4;
    const real beam = b * L * L * L * L / (8 * young * h * h / 12) + b * L * L / (2 * shear * 5 / 6);
    for (size_t k = 0; k < COUNT_OF(model); k++) {
        struct body a;
        real tip = 0, grid_coupled = 0;
        body_make(&a, CANTILEVER, model[k].with);
        assert_ok(run_advance_to_end_time(&a.e));
        forces(&a.e);
        for (int64_t i = 0; i < a.e.part.n; i++) {
            tip = real_max(tip, a.e.part.x[1][i] - a.e.part.X[1][i]);
            grid_coupled += a.e.part.f[1][i];
        }
        printf("cantilever %s: tip %.4g of a beam's in %lld steps\n", model[k].with[0], tip / beam,
               (long long)a.e.clock.step);
        assert_close(tip, model[k].over * beam, 0.01);
        assert_close(grid_coupled, -b * L * h * 1e-3, 1e-4);
        body_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_energy),     cmocka_unit_test(test_threads),  cmocka_unit_test(test_long),
        cmocka_unit_test(test_reflection), cmocka_unit_test(test_torn),     cmocka_unit_test(test_cantilever),
        cmocka_unit_test(test_coupled),    cmocka_unit_test(test_in_plane), cmocka_unit_test(test_yielded),
    };
    threads_set_count_and_bind_to_cores(0);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
