/* Checks that one linear step in the current frame is the leap-frog integration of one energy. FLIP: with forces -W u
 * on the nodal velocities (u: displacements), the step is v' = Q v - dt W u, u' = u + dt v', Q being the interface
 * damping. It is bounded (spectral radius 1) if m W is symmetric (m: masses), W >= 0 and dt^2 W <= 2 (1 + Q). Q and W
 * are measured from steps of the engine. A third step must agree with their prediction, which shows that v' alone
 * changes u. */
#include <stdarg.h>
#include <setjmp.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "../bench/common/bench.h"
#include "base/memory.h"
#include "tests/support/near.h"
#include "grid/grid_part.h"
#include "coupling/coupling_part.h"
#include "probes/diagnostics.h"

/* Initial velocity divided by the wave speed c [1]. It is small because bonds rotate: forces deviate from linear ones
 * by terms of second order, of which opposite velocities leave the third order. */
#define AMPLITUDE 1e-5
/* Tolerance of asymmetry, relative to the largest entry of a matrix. Positions span ten spacings: their round-off is
 * 1e-15 over the motion of 1e-5, a few times. */
#define SYMMETRIC 1e-8

/* ---- bodies ------------------------------------------------------------------------------------------------------ */

/* Free blocks and the peridynamic regions in them. Nodes are at irregular positions, since for particles at the kinks
 * of a shape function forces would depend on |u|. */
struct block {
    const char *space, *edge, *origin, *region;
};
static const struct block line = {"line", "24 mm", "0.13 mm", "{box: {from: 7 mm, to: 16 mm}}"},
                          half = {"plane stress", "9 mm, 7 mm", "0.13 mm, 0.37 mm",
                                  "{box: {from: [-inf, -inf], to: [4 mm, inf]}}"},
                          square_of = {"plane stress", "9 mm, 9 mm", "0.13 mm, 0.37 mm",
                                       "{box: {from: [3 mm, 3 mm], to: [6 mm, 6 mm]}}"},
                          spot = {"plane strain", "8 mm, 8 mm", "0.63 mm, 0.37 mm",
                                  "{ball: {centre: [3.5 mm, 3.5 mm], radius: 0.5 mm}}"},
                          disc = {"plane stress", "9 mm, 9 mm", "1.13 mm, 0.37 mm",
                                  "{ball: {centre: [4.5 mm, 4.5 mm], radius: 2.2 mm}}"},
                          cube = {"solid", "4 mm, 4 mm, 4 mm", "0.13 mm, 0.37 mm, 0.7 mm",
                                  "{box: {from: [-inf, -inf, -inf], to: [2 mm, inf, inf]}}"};

struct held_run {
    struct run e;
    struct scene s;
};

/* Creates the run r of the block b by `method` and performs its first step. poisson: Poisson's ratio, NULL for that of
 * bonds; more: further keys of the scene, one per line. */
static void run_make(struct held_run *r, const struct block *b, const char *method, const char *poisson,
                     const char *more)
{
    char text[2048];
    const bool flat = !strncmp(b->space, "plane", 5), bar = !strcmp(b->space, "line");
    snprintf(text, sizeof text,
             "name: block\nspace: %s\n%sduration: 1000\nmethod: %s\nmaterial: {young: 200e9, density: 7850}\n"
             "body: {box: {from: [0%s], to: [%s]}}\noutput: {frames: 0, samples: 1}\n%s%s%s%s",
             b->space, flat ? "thickness: 1 mm\n" : "", method,
             bar    ? ""
             : flat ? ", 0"
                    : ", 0, 0",
             b->edge, strcmp(method, "mpm") ? "pd: {region: " : "", strcmp(method, "mpm") ? b->region : "",
             strcmp(method, "mpm") ? "}\n" : "", more);
    struct bench_overrides o = {0};
    bench_overrides_append(&o, "time.active_set", "false");
    bench_overrides_append(&o, "mpm.frame", "current");
    bench_overrides_append(&o, "mpm.origin", "[%s]", b->origin);
    if (poisson) bench_overrides_append(&o, "material.poisson", "%s", poisson);
    assert_ok(bench_engine_make(&r->e, &r->s, "block", text, bench_overrides_as_array(&o), o.n));
    assert_ok(bench_engine_run(&r->e, 1, NULL)); /* the first step is half a step, and a sample */
}

/* ---- operators of a step ----------------------------------------------------------------------------------------- */

/* Positions and volumes of the particles of a run at its start. */
struct places {
    real *x[DIM_MAX], *volume;
};

/* Sets the particles of r to the positions and volumes `was`, without velocity, stretch and stress. */
static void at_rest(struct held_run *r, const struct places *was)
{
    struct particles *p = &r->e.part;
    for (int64_t i = 0; i < p->n; i++) p->volume[i] = was->volume[i];
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) p->x[d][i] = was->x[d][i], p->v[d][i] = 0;
    for (int d = 0; d < p->dim && p->stretch[d]; d++)
        for (int64_t i = 0; i < p->n; i++) p->stretch[d][i] = 1;
    for (int c = 0; c < symmetric_tensor_component_count(p->dim); c++)
        for (int64_t i = 0; i < p->n; i++) p->stress[c][i] = 0;
    r->e.grid->sort_needed = true;
}

/* Matrices [n][n] of a step of n unknowns, scaled by square roots of masses: damping Q, stiffness W times dt^2, and
 * `third`, the velocities after the third step for a unit velocity of each unknown. */
struct operators {
    int n;
    real *Q, *W, *third;
};

/* Adds the current velocities of p, divided by `unit`, to column k of the n x n matrix `to`. */
static void add_column(const struct particles *p, real *to, int n, int k, real unit)
{
    for (int j = 0; j < n; j++) to[j * n + k] += p->v[j % p->dim][j / p->dim] / unit;
}

/* Measures column k of the matrices *o with the run r, from rest at the positions `was`. With interface damping, the
 * velocities after one step from a unit velocity of unknown k are column k of Q. Without it, the velocity lost in the
 * second step is column k of dt^2 W, and the velocities after the third step are stored. Called for sign = 1 and -1,
 * the sign of the unit velocity; each call adds half of the result. */
static void column(struct held_run *r, const struct places *was, int k, real sign, struct operators *o)
{
    struct particles *p = &r->e.part;
    const real share = r->e.coupling->damping_share, unit = sign * AMPLITUDE * r->e.tables.wave_speed;
    for (int damped = 1; damped >= 0; damped--) {
        at_rest(r, was);
        p->v[k % p->dim][k / p->dim] = unit;
        r->e.coupling->damping_share = damped ? share : 0;
        assert_ok(run_adapt_mesh_and_advance_one_step(&r->e));
        add_column(p, damped ? o->Q : o->W, o->n, k, 2 * unit);
    }
    assert_ok(run_adapt_mesh_and_advance_one_step(&r->e));
    add_column(p, o->W, o->n, k, -2 * unit);
    assert_ok(run_adapt_mesh_and_advance_one_step(&r->e));
    add_column(p, o->third, o->n, k, 2 * unit);
    r->e.coupling->damping_share = share;
}

/* Measures the matrices *o of the run r and scales them by the square roots of the masses, so that matrices that are
 * symmetric in the mass metric become symmetric. They must be freed. */
static void operators_make(struct held_run *r, struct operators *o)
{
    struct particles *p = &r->e.part;
    const int n = o->n = (int)p->n * p->dim;
    o->Q = NEW("test.Q", (int64_t)n * n, real), o->W = NEW("test.W", (int64_t)n * n, real);
    o->third = NEW("test.third", (int64_t)n * n, real);
    struct places was = {.volume = BARE("test.volume", p->n, real)};
    memcpy(was.volume, p->volume, (size_t)p->n * sizeof(real));
    for (int d = 0; d < p->dim; d++) {
        was.x[d] = BARE("test.x", p->n, real);
        memcpy(was.x[d], p->x[d], (size_t)p->n * sizeof(real));
    }
    for (int k = 0; k < n; k++)
        for (int sign = -1; sign <= 1; sign += 2) column(r, &was, k, sign, o);
    for (int j = 0; j < n; j++)
        for (int k = 0; k < n; k++) {
            const real scale = sqrt(p->mass[j / p->dim] / p->mass[k / p->dim]);
            o->Q[j * n + k] *= scale, o->W[j * n + k] *= scale, o->third[j * n + k] *= scale;
        }
    for (int d = 0; d < p->dim; d++) memory_free(was.x[d]);
    memory_free(was.volume);
}

/* Returns the largest entry of |A - A^T| divided by the largest entry of |A|, and replaces the n x n matrix A by its
 * symmetric part. */
static real asymmetry(real *A, int n)
{
    real largest = 0, odd = 0;
    for (int j = 0; j < n; j++)
        for (int k = 0; k <= j; k++) {
            largest = real_max(largest, fabs(A[j * n + k]));
            odd = real_max(odd, fabs(A[j * n + k] - A[k * n + j]));
            A[j * n + k] = A[k * n + j] = 0.5 * (A[j * n + k] + A[k * n + j]);
        }
    return odd / largest;
}

/* Returns the largest difference between the third velocities in *o and the leap-frog prediction v3 = v2 - W (v1 + v2),
 * divided by the largest entry of W. v1 = 1 and v2 = 1 - W are the velocities after the first two steps. */
static real unpredicted(const struct operators *o)
{
    const int n = o->n;
    real largest = 0, off = 0;
    for (int j = 0; j < n; j++)
        for (int k = 0; k < n; k++) {
            real sum = (j == k) - 3 * o->W[j * n + k];
            for (int q = 0; q < n; q++) sum += o->W[j * n + q] * o->W[q * n + k];
            off = real_max(off, fabs(o->third[j * n + k] - sum));
            largest = real_max(largest, fabs(o->W[j * n + k]));
        }
    return off / largest;
}

/* Returns true if the symmetric n x n matrix A + shift 1 is positive definite, by Cholesky factorisation. */
static bool positive(const real *A, int n, real shift)
{
    real *L = NEW("test.factor", (int64_t)n * n, real);
    bool all = true;
    for (int j = 0; j < n && all; j++)
        for (int k = 0; k <= j; k++) {
            real sum = A[j * n + k] + (j == k ? shift : 0);
            for (int q = 0; q < k; q++) sum -= L[j * n + q] * L[k * n + q];
            if (j == k && !(sum > 0)) all = false;
            L[j * n + k] = j == k ? sqrt(sum) : sum / L[k * n + k];
        }
    memory_free(L);
    return all;
}

/* ---- leap-frog of one energy ------------------------------------------------------------------------------------- */

static const struct {
    const struct block *block;
    const char *more;
} one_energy[] = {
    {&line, ""},
    {&line, "coupling: handshake\nmpm: {shape: linear}\n"},
    {&line, "coupling: pm\nmpm: {shape: linear}\n"},
    {&line, "coupling: pg\n"},
    {&line, "coupling: pgg\nmpm: {cell: 1}\n"},
    {&half, ""},
    {&half, "coupling: handshake\n"},
    {&half, "mpm: {shape: quadratic}\n"},
    {&square_of, ""},
    {&square_of, "coupling: handshake\nmpm: {shape: cubic}\n"},
    {&square_of, "mpm: {shape: cpgimp, cell: 1}\n"},
    {&square_of, "coupling: pg\n"},
    {&spot, ""},
    {&spot, "particles: {irregularity: 0.4}\n"},
    {&disc, ""},
    {&disc, "mpm: {shape: linear}\n"},
    {&cube, "particles: {horizon: 2.015}\n"},
    {&cube, "coupling: handshake\nparticles: {horizon: 2.015}\nmpm: {shape: quadratic}\n"},
};

/* Checks for the block b the conditions stated at the head of this file: Q and m W symmetric, W >= 0, dt^2 W <= 2 (1 +
 * Q), and the third step as predicted. Arguments: as for run_make; `more` must not set the spacing. */
static void check_one_energy(const struct block *b, const char *method, const char *poisson, const char *more)
{
    char keys[256];
    struct held_run *r = NEW("test.run", 1, struct held_run);
    const char *const particles = strstr(more, "particles: {");
    if (particles)
        snprintf(keys, sizeof keys, "%.*sparticles: {spacing: 1 mm, %s", (int)(particles - more), more, particles + 12);
    else
        snprintf(keys, sizeof keys, "particles: {spacing: 1 mm}\n%s", more);
    run_make(r, b, method, poisson, keys);
    struct operators o;
    operators_make(r, &o);
    const int n = o.n;
    const real of_Q = asymmetry(o.Q, n), of_third = unpredicted(&o), of_W = asymmetry(o.W, n);
    if (of_Q > SYMMETRIC || of_W > SYMMETRIC || of_third > SYMMETRIC)
        print_message("%s, %s: asymmetry %.1e %.1e, third step off by %.1e\n", b->space, more, of_Q, of_W, of_third);
    assert_true(of_Q <= SYMMETRIC && of_W <= SYMMETRIC && of_third <= SYMMETRIC);
    assert_true(positive(o.W, n, n * SYMMETRIC));
    for (int64_t k = 0; k < (int64_t)n * n; k++) o.W[k] = 2 * o.Q[k] - o.W[k];
    assert_true(positive(o.W, n, 2));
    memory_free(o.Q);
    memory_free(o.W);
    memory_free(o.third);
    bench_engine_free(&r->e, &r->s);
    memory_free(r);
}

static void test_one_energy(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(one_energy); k++)
        check_one_energy(one_energy[k].block, "adaptive", NULL, one_energy[k].more);
}

/* Checks points with a mean dilatation per cell (kernels/mpm/dilatation.h), which prevents volumetric locking, for the
 * properties of one energy that the head of this file states. */
static void test_dilatation(void **state)
{
    (void)state;
    check_one_energy(&spot, "mpm", "0.45", "");
    check_one_energy(&spot, "mpm", "0.49", "mpm: {shape: linear}\nparticles: {irregularity: 0.4}\n");
    check_one_energy(&spot, "mpm", "0.499", "mpm: {shape: quadratic, cell: 3}\n");
    check_one_energy(&cube, "mpm", "0.49", "");
    check_one_energy(&cube, "mpm", "0.45", "mpm: {shape: cpgimp}\n");
}

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Sets random velocities of up to 1e-8 c and runs r for `steps` steps. Returns the largest kinetic energy, divided by
 * the initial one [1]; INFINITY if the run stopped. */
static real shaken(struct held_run *r, int steps)
{
    struct particles *p = &r->e.part;
    uint64_t seed = 1;
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) p->v[d][i] = 1e-8 * r->e.tables.wave_speed * bench_random(&seed);
    const real start = particles_kinetic_energy(p);
    real most = 0;
    for (int k = 0; k < steps; k++) {
        if (run_adapt_mesh_and_advance_one_step(&r->e) != OK) return INFINITY;
        if (k % 8 == 0) most = real_max(most, particles_kinetic_energy(p) / start);
    }
    return most;
}

/* Checks that with APIC the kinetic energy never exceeds the initial one in 3000 steps, also near nu = 1/2 in 3D. */
static void test_apic(void **state)
{
    (void)state;
    static const struct {
        const struct block *block;
        const char *method, *poisson, *more;
    } run[] = {
        {&cube, "mpm", "0.49", "mpm: {transfer: apic, shape: gimp}\n"},
        {&cube, "mpm", "0.499", "mpm: {transfer: apic, shape: quadratic}\n"},
        {&half, "mpm", "0.49", "mpm: {transfer: apic, shape: cubic}\n"},
        {&square_of, "adaptive", "1/3", "mpm: {transfer: apic}\n"},
        {&spot, "adaptive", "1/4", "coupling: handshake\nmpm: {transfer: apic}\n"},
        {&disc, "adaptive", "1/3", "coupling: pg\nmpm: {transfer: apic}\n"},
    };
    for (size_t k = 0; k < COUNT_OF(run); k++) {
        struct held_run *r = NEW("test.run", 1, struct held_run);
        struct block at = *run[k].block;
        char keys[256];
        snprintf(keys, sizeof keys, "particles: {spacing: 1 mm}\n%s", run[k].more);
        at.origin = at.space[0] == 's' ? "0, 0, 0" : "0, 0"; /* where the limits are lowest */
        run_make(r, &at, run[k].method, run[k].poisson, keys);
        assert_true(shaken(r, 3000) <= 1);
        bench_engine_free(&r->e, &r->s);
        memory_free(r);
    }
}

/* Checks a coupled plate over 1e4 steps at 0.8 of the critical step: the energy balance closes to 1e-5, and at the end
 * kinetic and strain energy are less than the initial energy. A step that strains points with the velocities before the
 * second map (the first map of FLIP) diverges at step 1516. */
static void test_plate(void **state)
{
    (void)state;
    struct held_run *r = NEW("test.run", 1, struct held_run);
    struct bench_overrides o = {0};
    bench_overrides_append(&o, "time.safety", "0.8");
    assert_ok(bench_engine_make(
        &r->e, &r->s, "plate",
        "name: plate\nspace: plane stress\nthickness: 1 mm\nduration: 5 ms\nmethod: adaptive\nmpm: {frame: current}\n"
        "material: {young: 200 GPa, poisson: 1/3, density: 7850}\nbody: {box: {from: [0, 0], to: [20 mm, 20 mm]}}\n"
        "particles: {spacing: 1 mm, horizon: 3.015}\npd: {region: {box: {from: [5 mm, 5 mm], to: [15 mm, 15 mm]}}}\n"
        "initial: [{velocity_gradient: [10, 3, 0, -7]}]\noutput: {frames: 0, samples: 40}\n",
        bench_overrides_as_array(&o), o.n));
    const real start = particles_kinetic_energy(&r->e.part);
    assert_ok(bench_engine_run(&r->e, 1, NULL)); /* creates the record of samples */
    while (r->e.clock.step < 10000) {
        assert_ok(run_adapt_mesh_and_advance_one_step(&r->e));
        if (r->e.clock.step < 1000) continue; /* the first step of the record is extrapolated */
        if (!(fabs(r->e.diagnostics->now.balance_error) < 1e-5))
            print_message("step %d: %g\n", (int)r->e.clock.step, r->e.diagnostics->now.balance_error);
        /* Weights change with strains of 2e-5 and rotations of 0.4 degrees. */
        assert_true(fabs(r->e.diagnostics->now.balance_error) < 1e-5);
    }
    const struct energy *u = &r->e.diagnostics->now.energy;
    assert_true(u->kinetic + u->strain < start);
    bench_engine_free(&r->e, &r->s);
    memory_free(r);
}

/* Checks that bodies that rotate rigidly by two revolutions keep their energy: bonds and points agree on the unstrained
 * state, in 2D and about an oblique axis in 3D. Tolerance 3e-4: centrifugal stretches of at most (w r/c)^2 = 1e-4,
 * which vibrate (w: angular velocity), and quadrature errors of points that change cells. First-order strains would
 * make a body of points grow by pi times the angle of 0.0016 per step in a revolution, and gain 13 to 32 % of its
 * energy. */
static void test_turning(void **state)
{
    (void)state;
    static const char plane[] =
        "space: plane stress\nthickness: 1 mm\nduration: 2.51327 ms\n"
        "body: {disc: {centre: [0, 0], radius: 10 mm}}\npd: {region: {disc: {centre: [0, 0], radius: 4 mm}}}\n"
        "particles: {spacing: 1 mm}\ninitial: [{velocity_gradient: [[0, -5000], [5000, 0]]}]\n";
    static const char solid[] =
        "space: solid\nduration: 2.51327 ms\n"
        "body: {ball: {centre: [0, 0, 0], radius: 5 mm}}\npd: {region: {ball: {centre: [0, 0, 0], radius: 2 mm}}}\n"
        "particles: {spacing: 1 mm, horizon: 2.015}\n"
        "initial: [{velocity_gradient: [[0, -3000, 2400], [3000, 0, -3200], [-2400, 3200, 0]]}]\n";
    static const struct {
        const char *text, *model, *coupling;
    } ball[] = {{plane, "bond", "partial stress"},
                {plane, "mospd", "partial stress"},
                {plane, "ospd", "handshake"},
                {solid, "bond", "partial stress"},
                {solid, "mospd", "handshake"}};
    for (size_t k = 0; k < COUNT_OF(ball); k++) {
        struct held_run *r = NEW("test.run", 1, struct held_run);
        char text[1024];
        snprintf(text, sizeof text,
                 "name: disc\nmethod: adaptive\nmodel: %s\ncoupling: %s\nmpm: {frame: current, transfer: apic}\n"
                 "material: {young: 72e9, density: 7850}\nconversion: {criteria: none}\n"
                 "output: {frames: 0, samples: 40}\n%s",
                 ball[k].model, ball[k].coupling, ball[k].text);
        assert_ok(bench_engine_make(&r->e, &r->s, "disc", text, NULL, 0));
        assert_ok(run_advance_to_end_time(&r->e));
        const real off = r->e.diagnostics->now.balance_error;
        if (!(fabs(off) < 3e-4)) fail_msg("%s, %s, %dD: balance %.2e", ball[k].model, ball[k].coupling, r->s.dim, off);
        bench_engine_free(&r->e, &r->s);
        memory_free(r);
    }
}

int main(void)
{
    omp_set_num_threads(1); /* bodies of a hundred particles */
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_one_energy), cmocka_unit_test(test_dilatation),
                                       cmocka_unit_test(test_apic), cmocka_unit_test(test_plate),
                                       cmocka_unit_test(test_turning)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
