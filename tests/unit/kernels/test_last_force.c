/* Tests the last force of breaking bonds, which act until the moment at which they break. Two separating particles are
 * compared with their closed form. In bursting bodies the energy must be constant to second order in the time step, for
 * every bond model. */
#include "kernels/kernels.h"

#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "tests/support/sets.h"

/* ---- two particles ----------------------------------------------------------------------------------------------- */

enum { PHASES = 16 }; /* phases of the first step relative to its length */
#define LIMIT 0.01

/* Returns the relative speed of two particles after their bond has broken, divided by the initial speed. Exact: 1/2,
 * because the energy of the bond at its limit is 3/4 of the kinetic energy of the elongation V/omega sin(omega t).
 * rule: force in the step in which a bond breaks; step: time step times omega/2; phase: position of the start in a
 * step, 0 to 1. *fracture: receives the fracture energy over that of the limit. */
static real parted(enum last_force rule, real step, real phase, real *fracture)
{
    struct particle_cloud c;
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_LINE, .count = {2}, .horizon = 1});
    for (int k = 0; k < CLOUD_MATERIALS * CLOUD_MATERIALS; k++) c.limit[k] = LIMIT;
    cloud_bonds(&c);
    struct particles *p = &c.p;
    const real stiffness =
        c.bonds.stiffness * c.bonds.w[bond_copy_on_write_and_return_array_index(&c.bonds, 0, 0, 0)] / CLOUD_SPACING;
    const real omega = sqrt(2 * stiffness / p->mass[0]), dt = step * 2 / omega;
    const real speed = omega * LIMIT * CLOUD_SPACING / sqrt(0.75), start = (phase - 1) * dt;
    const struct bond_limit limit = {
        .critical_stretch = c.limit, .materials = CLOUD_MATERIALS, .last_force = rule, .dt = dt};
    p->x[0][1] += speed / omega * sin(omega * start);
    p->v[0][0] = 0, p->v[0][1] = speed * cos(omega * (start - 0.5 * dt));
    for (real t = start; t < 3 / omega; t += dt) {
        bond_force_table[1][PD_BOND](&c.bonds, p, &limit, NULL);
        for (int i = 0; i < 2; i++) p->v[0][i] += dt * p->f[0][i] / p->mass[i], p->x[0][i] += dt * p->v[0][i];
    }
    const real end = p->v[0][1] - p->v[0][0], energy = 0.5 * stiffness * square(LIMIT * CLOUD_SPACING);
    assert_int_equal(c.bonds.broken[0] + c.bonds.broken[1], 2);
    *fracture = bonds_fracture_energy(&c.bonds) / energy;
    particle_cloud_free(&c);
    return end / speed;
}

/* Returns the largest magnitude of the error of the speed over all phases, for the rule `rule` and the time step `step`
 * (parted). */
static real parted_error(enum last_force rule, real step)
{
    real largest = 0;
    for (int k = 0; k < PHASES; k++) {
        real fracture;
        const real error = parted(rule, step, (k + 0.5) / PHASES, &fracture) - 0.5;
        largest = real_max(largest, fabs(error));
        if (rule == LAST_FORCE_MOMENT) assert_near(fracture, 1, 1e-12); /* linear in time between two positions */
    }
    return largest;
}

/* Checks the order of accuracy of breaking: with LAST_FORCE_MOMENT half the time step reduces the largest error over
 * all phases by more than a factor of 3.2 (second order: 4). With LAST_FORCE_HALF the factor is less than 3, because
 * the error depends on the phase. */
static void test_two_particles(void **state)
{
    (void)state;
    real largest[2];
    for (int k = 0; k < 2; k++) largest[k] = parted_error(LAST_FORCE_MOMENT, 0.1 / (1 + k));
    assert_true(largest[1] < largest[0] / 3.2 && largest[0] < 0.02);
    for (int k = 0; k < 2; k++) largest[k] = parted_error(LAST_FORCE_HALF, 0.1 / (1 + k));
    assert_true(largest[1] > largest[0] / 3 && largest[0] > 0.05);
}

/* ---- bodies that burst ------------------------------------------------------------------------------------------- */

/* A bursting body with the kernels of its model. */
struct burst {
    struct particle_cloud c;
    struct state_modulus modulus[CLOUD_MATERIALS];
    struct kernels k;
};

static void burst_make(struct burst *b, int dim, enum pd_model model, bool local)
{
    const enum space space = dim == 2 ? SPACE_PLANE_STRAIN : SPACE_SOLID;
    struct cloud_plan plan = {.space = space, .count = {12, 11}, .horizon = 3.015, .shake = 0.2, .seed = 5};
    uint64_t seed = 9;
    if (dim == 3) plan.count[0] = plan.count[1] = plan.count[2] = 6, plan.horizon = 2.015;
    particle_cloud_make(&b->c, &plan);
    for (int m = 0; m < CLOUD_MATERIALS; m++) {
        if (model >= PD_OSPD)
            b->c.material[m].poisson = 0.2, material_compute_derived_constants(&b->c.material[m], space);
        b->modulus[m] = state_based_moduli_of_material(&b->c.material[m], space, model == PD_MOSPD);
    }
    if (model >= PD_OSPD)
        b->c.source.modulus = b->modulus, b->c.source.rotates = model == PD_MOSPD, b->c.source.local = local;
    for (int k = 0; k < CLOUD_MATERIALS * CLOUD_MATERIALS; k++) b->c.limit[k] = LIMIT;
    cloud_bonds(&b->c);
    kernels_choose(&b->k, dim, model, SHAPE_LINEAR, TRANSFER_FLIP);
    struct particles *p = &b->c.p; /* separates along x, faster to the right */
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < dim; d++)
            p->v[d][i] = (d == 0 ? 4e6 * square(p->X[0][i]) : 0) + cloud_between(&seed, -2, 2);
}

static real burst_kinetic(const struct burst *b, real *const *before)
{
    const struct particles *p = &b->c.p;
    real energy = 0;
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < p->dim; d++) energy += 0.5 * p->mass[i] * before[d][i] * p->v[d][i];
    return energy;
}

/* Returns the energy that a bursting body of `dim` dimensions has lost after `duration` with steps of `dt` [s], divided
 * by its fracture energy. model: bond model; local: true if neighbourhoods are normalised by their intact bonds. */
static real burst_lost(int dim, enum pd_model model, bool local, real dt, real duration)
{
    struct burst b;
    burst_make(&b, dim, model, local);
    struct particles *p = &b.c.p;
    const struct bond_limit limit = {
        .critical_stretch = b.c.limit, .materials = CLOUD_MATERIALS, .last_force = LAST_FORCE_MOMENT, .dt = dt};
    const real start = burst_kinetic(&b, p->v);
    real *before[DIM_MAX] = {0}, kinetic = start;
    int64_t broken = 0;
    for (int d = 0; d < dim; d++) before[d] = NEW("test.v", p->n, real);
    const int steps = (int)(duration / dt);
    for (int n = 0; n < steps; n++) { /* no bond breaks in the last step: a sample */
        broken += b.k.bond_force(&b.c.bonds, p, n < steps - 1 ? &limit : &bond_limit_never, NULL);
        for (int d = 0; d < dim; d++) memcpy(before[d], p->v[d], (size_t)p->n * sizeof(real));
        for (int d = 0; d < dim; d++)
            for (int64_t i = 0; i < p->n; i++) p->v[d][i] += (n == 0 ? 0.5 : 1) * dt * p->f[d][i] / p->mass[i];
        kinetic = burst_kinetic(&b, before);
        for (int d = 0; d < dim && n < steps - 1; d++)
            for (int64_t i = 0; i < p->n; i++) p->x[d][i] += dt * p->v[d][i];
    }
    const real elastic = b.k.bond_energy(&b.c.bonds, p, NULL), fracture = bonds_fracture_energy(&b.c.bonds);
    assert_true(broken > b.c.bonds.n / 40 && broken < b.c.bonds.n && fracture > 0.02 * start);
    for (int d = 0; d < dim; d++) memory_free(before[d]);
    particle_cloud_free(&b.c);
    return (kinetic + elastic + fracture - start) / fracture;
}

/* Returns the root mean square of the energy loss (burst_lost) over five runs with steps of 0.9 to 1.1 times `step`
 * [1e-7 s]. dim, model, local: as in burst_lost. */
static real burst_error(int dim, enum pd_model model, bool local, real step)
{
    enum { RUNS = 5 };
    real sum = 0;
    for (int r = 0; r < RUNS; r++) {
        const real dt = step * (0.9 + 0.05 * r) * 1e-7; /* spacing over wave speed: about 2e-7 s */
        sum += square(burst_lost(dim, model, local, dt, 6e-6));
    }
    return sqrt(sum / RUNS);
}

/* Checks the order of the energy error of bursting bodies: a quarter of the step must reduce the error at least to a
 * fifth. Second order gives a sixteenth; measured 12 to 20, and 5.5 for ospd local in 2D, whose coarse error is small
 * by chance. Half forces in the last step are of first order, a factor of 4. */
static void test_bursts(void **state)
{
    (void)state;
    static const struct {
        enum pd_model model;
        bool local;
    } law[] = {{PD_BOND, false}, {PD_OSPD, false}, {PD_OSPD, true}, {PD_MOSPD, false}, {PD_MOSPD, true}};
    for (int dim = 2; dim <= DIM_MAX; dim++)
        for (size_t k = 0; k < COUNT_OF(law); k++) {
            const real coarse = burst_error(dim, law[k].model, law[k].local, 0.5);
            const real fine = burst_error(dim, law[k].model, law[k].local, 0.125);
            assert_true(coarse < 0.004 && fine < 2e-4 && fine < coarse / 5);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_two_particles), cmocka_unit_test(test_bursts)};
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
