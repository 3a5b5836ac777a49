/* Interface damping, which acts on material points near peridynamic particles: it conserves momentum, angular momentum
 * and rigid motion, only dissipates energy, stops motion that alternates from point to point, and hardly affects long
 * waves. */
#include "coupling/interface_zone.h"

#include "tests/support/cloud.h"
#include "tests/support/near.h"

static const enum space spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};

/* Creates in `space` the body c, whose left half is peridynamic, and its interface zone (material points near
 * peridynamic particles). shake: largest random displacement of the particles from the lattice [spacings]. */
static void half_make(struct particle_cloud *c, struct interface_zone *zone, enum space space, real shake)
{
    static const int size[DIM_MAX + 1][DIM_MAX] = {{0}, {40, 0, 0}, {20, 14, 0}, {14, 8, 8}};
    struct cloud_plan plan = {.space = space, .horizon = 3, .shake = shake, .seed = 7};
    const int dim = space_dim(space);
    memcpy(plan.count, size[dim], sizeof plan.count);
    particle_cloud_make(c, &plan);
    for (int64_t i = 0; i < c->p.n; i++)
        c->p.kind[i] = c->p.X[0][i] < 0.5 * size[dim][0] * CLOUD_SPACING ? KIND_PD : KIND_MPM;
    cloud_source(c);
    interface_zone_list_damped_material_points(zone, &c->p, &c->source);
    assert_true(zone->points > 0 && zone->n > zone->points);
}

static void half_free(struct particle_cloud *c, struct interface_zone *zone)
{
    interface_zone_free(zone);
    particle_cloud_free(c);
}

/* sum: momentum, angular momentum x_a p_b - x_b p_a, and twice the kinetic energy; scale: sums of the magnitudes of
 * their terms. */
enum { SUMS = 7 };
static void sums_of(const struct particles *p, real *sum, real *scale)
{
    memset(sum, 0, SUMS * sizeof *sum);
    memset(scale, 0, SUMS * sizeof *scale);
    for (int64_t i = 0; i < p->n; i++)
        for (int a = 0; a < p->dim; a++) {
            const int b = (a + 1) % p->dim;
            const real m = p->mass[i], arm = p->x[a][i] * p->v[b][i], other = p->x[b][i] * p->v[a][i];
            const real term[3] = {m * p->v[a][i], m * (arm - other), m * square(p->v[a][i])};
            sum[a] += term[0], sum[3 + a] += term[1], sum[6] += term[2];
            scale[a] += fabs(term[0]), scale[3 + a] += m * (fabs(arm) + fabs(other)), scale[6] += term[2];
        }
}

/* Checks interface damping of random velocities on an irregular body: momentum and angular momentum are conserved to
 * the round-off of their sums (1e-14 of the terms), and the kinetic energy decreases by the recorded loss. */
static void test_kept(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(spaces); k++) {
        struct particle_cloud c;
        struct interface_zone r = {0};
        real before[SUMS], after[SUMS], scale[SUMS];
        uint64_t seed = 11;
        half_make(&c, &r, spaces[k], 0.2);
        for (int64_t i = 0; i < c.p.n; i++)
            for (int d = 0; d < c.p.dim; d++) c.p.v[d][i] = cloud_between(&seed, -1, 1);
        sums_of(&c.p, before, scale);
        for (int step = 0; step < 20; step++) {
            real energy[SUMS];
            sums_of(&c.p, energy, scale);
            const real lost = interface_zone_damp_and_return_first_half_loss(&r, &c.p, 1.0 / 16) +
                              interface_zone_second_half_of_damping_loss(&r, &c.p);
            sums_of(&c.p, after, scale);
            assert_true(after[6] < energy[6]);
            assert_near(lost, 0.5 * (energy[6] - after[6]), 1e-13 * energy[6]);
        }
        for (int s = 0; s < 6; s++) assert_near(after[s], before[s], 1e-14 * scale[s]);
        half_free(&c, &r);
    }
}

/* Checks that rigid motion is not damped, since no two particles move relative to each other along the line between
 * them. Tolerance: round-off. */
static void test_rigid(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(spaces); k++) {
        struct particle_cloud c;
        struct interface_zone r = {0};
        half_make(&c, &r, spaces[k], 0.2);
        const int dim = c.p.dim;
        for (int64_t i = 0; i < c.p.n; i++) {
            const real *x[DIM_MAX] = {c.p.x[0], c.p.x[1], c.p.x[2]};
            for (int d = 0; d < dim; d++) c.p.v[d][i] = 3 + d;
            if (dim > 1) c.p.v[0][i] -= 500 * x[1][i], c.p.v[1][i] += 500 * x[0][i];
            if (dim > 2) c.p.v[1][i] -= 300 * x[2][i], c.p.v[2][i] += 300 * x[1][i];
        }
        struct particles was;
        cloud_copy(&was, &c.p, 0);
        for (int step = 0; step < 10; step++) interface_zone_damp_and_return_first_half_loss(&r, &c.p, 1.0 / 16);
        for (int d = 0; d < dim; d++) assert_true(cloud_difference(c.p.v[d], was.v[d], c.p.n) < 1e-13);
        particles_free(&was);
        half_free(&c, &r);
    }
}

/* Checks the damping of waves in a bar against the closed form. With complete neighbourhoods and the coefficient 1/16,
 * one step reduces sin(q i) by (2 - 2 cos q)^2/16; motion that alternates from point to point (q = pi) stops. Points
 * outside the zone are not changed. */
static void test_waves(void **state)
{
    (void)state;
    const real pi = 3.14159265358979323846;
    const real wave_number[] = {3.14159265358979323846, 1.0, 0.2};
    for (size_t k = 0; k < COUNT_OF(wave_number); k++) {
        struct particle_cloud c;
        struct interface_zone r = {0};
        half_make(&c, &r, SPACE_LINE, 0);
        const int32_t middle = 21; /* the zone is points 20 .. 23; its inner points have complete neighbourhoods */
        const real q = wave_number[k], phase = q < pi ? -q * middle + 0.5 * pi : 0.5 * pi - pi * middle;
        assert_int_equal(r.points, 4);
        for (int64_t i = 0; i < c.p.n; i++) c.p.v[0][i] = sin(q * (real)i + phase);
        interface_zone_damp_and_return_first_half_loss(&r, &c.p, 1.0 / 16);
        assert_near(c.p.v[0][middle], 1 - square(2 - 2 * cos(q)) / 16, 1e-12);
        assert_exact(c.p.v[0][30], sin(q * 30 + phase));
        half_free(&c, &r);
    }
}

/* Checks the damping of two halves above each other that separate: it acts across their boundary, but not if a crack is
 * there or they are two bodies. */
static void test_parted(void **state)
{
    (void)state;
    real corner[2][DIM_MAX] = {{-CLOUD_SPACING, 6 * CLOUD_SPACING}, {21 * CLOUD_SPACING, 6 * CLOUD_SPACING}};
    const struct crack crack = {.n = 2, .corner = corner};
    for (int parted = 0; parted < 3; parted++) {
        struct particle_cloud c;
        struct interface_zone r = {0};
        real change = 0;
        half_make(&c, &r, SPACE_PLANE_STRESS, 0);
        if (parted == 1) c.source.crack = &crack, c.source.cracks = 1;
        for (int64_t i = 0; i < c.p.n; i++) {
            const bool above = c.p.X[1][i] > 6 * CLOUD_SPACING;
            if (parted == 2) c.p.body[i] = above;
            c.p.v[0][i] = above ? 0.4 : -0.3, c.p.v[1][i] = above ? 0.7 : -1.3;
        }
        interface_zone_list_damped_material_points(&r, &c.p, &c.source);
        interface_zone_damp_and_return_first_half_loss(&r, &c.p, 1.0 / 16);
        for (int64_t i = 0; i < c.p.n; i++)
            change = real_max(change, fabs(c.p.v[1][i] - (c.p.X[1][i] > 6 * CLOUD_SPACING ? 0.7 : -1.3)));
        assert_true(parted ? change < 1e-15 : change > 0.1);
        half_free(&c, &r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_kept), cmocka_unit_test(test_rigid),
                                       cmocka_unit_test(test_waves), cmocka_unit_test(test_parted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
