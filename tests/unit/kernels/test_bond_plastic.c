/* Tests yielding bonds: one bond against the closed form of its law along a path, all lanes against a scalar
 * implementation, plastic work, equal states of both entries of a bond, and initialisation from material points. */
#include "kernels/kernels.h"

#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "tests/support/sets.h"

#define YIELD 5e-5
#define HARDENING 1.0 /* E_t = E/2 */

/* ---- one bond ---------------------------------------------------------------------------------------------------- */

/* Computes the forces of the two particles c at the stretch s. Returns the force of their only bond divided by
 * stiffness and weight [1]. */
static real pulled(struct particle_cloud *c, real s)
{
    c->p.x[0][1] = c->p.x[0][0] + (c->p.X[0][1] - c->p.X[0][0]) * (1 + s);
    bond_force_table[1][PD_BOND_PLASTIC](&c->bonds, &c->p, &c->source.limit, NULL);
    int64_t q = bond_copy_on_write_and_return_array_index(&c->bonds, 0, 0, 0);
    assert_exact(c->p.f[0][0], -c->p.f[0][1]);
    return c->p.f[0][0] / (c->bonds.stiffness * c->bonds.w[q]);
}

static void pair_make(struct particle_cloud *c)
{
    particle_cloud_make(c, &(struct cloud_plan){.space = SPACE_LINE, .count = {2}, .horizon = 1});
    c->yield[0] = YIELD, c->hardening[0] = HARDENING;
    cloud_bonds(c);
    assert_int_equal(c->bonds.columns, 1);
}

/* Compares the force of a yielding bond along a path with the bilinear law with isotropic hardening. The path: loading
 * to 3 s_y, reverse yield, on to -4 s_y, reloading to yield. Tolerance 1e-11 of the yield force: stretches of 1e-4 are
 * differences of lengths with round-off 1e-16. */
static void test_path(void **state)
{
    (void)state;
    const real slope = HARDENING / (1 + HARDENING), y = YIELD;
    const real first = y + slope * 2 * y;               /* force at 3 s_y, which is also the yield force afterwards */
    const real back = 3 * y - 2 * first;                /* stretch at reverse yield */
    const real second = first + slope * (back + 4 * y); /* magnitude of the force at -4 s_y */
    const real again = -4 * y + 2 * second;             /* stretch at the third yield */
    const real path[][2] = {{0.5 * y, 0.5 * y},
                            {y, y},
                            {2 * y, y + slope * y},
                            {3 * y, first},
                            {2 * y, first - y},
                            {3 * y, first},
                            {0, first - 3 * y},
                            {back, -first},
                            {0.5 * (back - 4 * y), -first + slope * 0.5 * (-4 * y - back)},
                            {-4 * y, -second},
                            {-2 * y, -second + 2 * y},
                            {again, second},
                            {again + y, second + slope * y}};
    struct particle_cloud c;
    real dissipated = 0;
    pair_make(&c);
    for (size_t k = 0; k < COUNT_OF(path); k++) {
        /* Stretches are multiples of 2^-49. */
        assert_near(pulled(&c, path[k][0]), path[k][1], 1e-12 * y * 10 + 0x1p-50);
        real work = bond_plastic_work(&c.bonds);
        assert_true(work >= dissipated);
        dissipated = work;
    }
    particle_cloud_free(&c);
}

/* Checks that the work done on a bond along the path of test_path equals elastic energy plus plastic work. The
 * trapezoidal rule with 40,000 steps is exact for a piecewise linear force, except for half the squared step times the
 * change of slope at three corners: 1e-9. */
static void test_work(void **state)
{
    (void)state;
    const real corner[] = {0, 3, -4, 6, 2};
    struct particle_cloud c;
    real work = 0, before = 0;
    pair_make(&c);
    int64_t q = bond_copy_on_write_and_return_array_index(&c.bonds, 0, 0, 0);
    const real scale = c.bonds.stiffness * c.bonds.w[q] / c.bonds.inverse_length[q];
    enum { STEPS = 10000 };
    for (size_t k = 1; k < COUNT_OF(corner); k++)
        for (int step = 1; step <= STEPS; step++) {
            const real from = corner[k - 1], to = corner[k];
            real force = pulled(&c, YIELD * (from + (to - from) * step / STEPS));
            work += 0.5 * (force + before) * YIELD * (to - from) / STEPS * scale;
            before = force;
        }
    assert_close(bond_energy_table[1][PD_BOND_PLASTIC](&c.bonds, &c.p, NULL) + bond_plastic_work(&c.bonds), work, 1e-7);
    particle_cloud_free(&c);
}

/* Checks that a bond that breaks stays in the energy balance once with its plastic work, a (s_y + H a/2) times
 * stiffness and length of the bond, where a is its accumulated plastic stretch. */
static void test_broken(void **state)
{
    (void)state;
    struct particle_cloud c;
    pair_make(&c);
    const int64_t q = bond_copy_on_write_and_return_array_index(&c.bonds, 0, 0, 0);
    const real scale = c.bonds.stiffness * c.bonds.w[q] / c.bonds.inverse_length[q], path = 2 * YIELD / (1 + HARDENING);
    pulled(&c, 3 * YIELD);
    const real work = scale * path * (YIELD + 0.5 * HARDENING * path);
    assert_close(bond_plastic_work(&c.bonds), work, 1e-9);
    c.limit[0] = 2.9 * YIELD;
    assert_int_equal(bond_break_row_block(&c.bonds, &c.p, &c.source.limit, 0), 2);
    assert_close(bond_plastic_work(&c.bonds), work, 1e-9);
    particle_cloud_free(&c);
}

/* ---- many bonds -------------------------------------------------------------------------------------------------- */

/* Plastic stretch of a bond and accumulated plastic stretch, for the scalar implementation. */
struct twin {
    real plastic, path;
};

/* Updates *t for the stretch `stretch`, the yield stretch `yield` and the hardening ratio `hardening`. Returns the
 * force divided by the stiffness [1]. */
static real twin_force(struct twin *t, real stretch, real yield, real hardening)
{
    real trial = stretch - t->plastic, over = fabs(trial) - (yield + hardening * t->path);
    if (over > 0) {
        t->plastic += copysign(over / (1 + hardening), trial);
        t->path += over / (1 + hardening);
    }
    return stretch - t->plastic;
}

static void body_make(struct particle_cloud *c, enum space space, uint64_t seed)
{
    particle_cloud_make(
        c, &(struct cloud_plan){.space = space, .count = {9, 7, 5}, .horizon = 2.015, .shake = 0.2, .seed = seed});
    for (int k = 0; k < CLOUD_MATERIALS * CLOUD_MATERIALS; k++) c->yield[k] = 1e-3 * (1 + k), c->hardening[k] = 0.5 * k;
    for (int64_t i = 0; i < c->p.n; i++) c->p.material[i] = (uint8_t)(i % 2);
    c->yield[2] = c->yield[1], c->hardening[2] = c->hardening[1];
    cloud_bonds(c);
}

static void shake(struct particle_cloud *c, uint64_t *seed)
{
    for (int64_t i = 0; i < c->p.n; i++)
        for (int d = 0; d < c->p.dim; d++)
            c->p.x[d][i] = c->p.X[d][i] + cloud_between(seed, -3e-3, 3e-3) * CLOUD_SPACING;
}

/* Computes force[dim], the force on the particle of row r of c, bond by bond with the states twin[] [N]. */
static void twin_row(const struct particle_cloud *c, struct twin *twin, int64_t r, real *force)
{
    const struct bonds *b = &c->bonds;
    const struct particles *p = &c->p;
    const int32_t i = b->particle[r];
    for (int64_t k = 0; k < b->column_count[r / LANES]; k++) {
        int64_t q = bond_read(b, r / LANES, k, (int)(r % LANES)).entry;
        if (b->w[q] == 0) continue;
        int32_t j = b->nbr[q];
        real y[DIM_MAX], Y2 = 0, y2 = 0;
        for (int d = 0; d < p->dim; d++) {
            y[d] = p->x[d][j] - p->x[d][i];
            y2 += square(y[d]), Y2 += square(p->X[d][j] - p->X[d][i]);
        }
        int pair = p->material[i] * CLOUD_MATERIALS + p->material[j];
        real f = twin_force(&twin[q], sqrt(y2 / Y2) - 1, c->yield[pair], c->hardening[pair]);
        for (int d = 0; d < p->dim; d++) force[d] += b->stiffness * b->w[q] * f * y[d] / sqrt(y2);
    }
}

/* Compares the forces of yielding bonds of irregular bodies with the scalar implementation over twelve steps. Tolerance
 * 1e-11: stretches of 1e-3 from lengths with round-off 1e-16 are accurate to 1e-13, times ten bonds and twelve
 * steps. */
static void test_lanes(void **state)
{
    (void)state;
    const enum space spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct particle_cloud c;
        uint64_t seed = 5;
        body_make(&c, spaces[dim - 1], 3);
        struct twin *twin = NEW("test.twin", c.bonds.columns * LANES, struct twin);
        for (int step = 0; step < 12; step++) {
            shake(&c, &seed);
            bond_force_table[dim][PD_BOND_PLASTIC](&c.bonds, &c.p, &c.source.limit, NULL);
            for (int64_t r = 0; r < c.bonds.rows; r++) {
                real force[DIM_MAX] = {0};
                twin_row(&c, twin, r, force);
                for (int d = 0; d < dim; d++)
                    assert_near(c.p.f[d][c.bonds.particle[r]], force[d], 1e-11 * c.bonds.stiffness * 1e-3 * 10);
            }
        }
        assert_true(bond_plastic_work(&c.bonds) > 0);
        memory_free(twin);
        particle_cloud_free(&c);
    }
}

/* Checks that both entries of a bond have bitwise equal states, which conservation of momentum requires. */
static void test_ends(void **state)
{
    (void)state;
    struct particle_cloud c;
    uint64_t seed = 9;
    int64_t checked = 0;
    body_make(&c, SPACE_PLANE_STRESS, 4);
    const struct bonds *b = &c.bonds;
    for (int step = 0; step < 5; step++) {
        shake(&c, &seed);
        bond_force_table[2][PD_BOND_PLASTIC](&c.bonds, &c.p, &c.source.limit, NULL);
    }
    for (int64_t r = 0; r < b->rows; r++)
        for (int64_t k = 0; k < b->column_count[r / LANES]; k++) {
            int64_t q = bond_read(b, r / LANES, k, (int)(r % LANES)).entry, other = b->row_of[b->nbr[q]];
            if (b->w[q] == 0) continue;
            for (int64_t m = 0; m < b->column_count[other / LANES]; m++) {
                int64_t o = bond_read(b, other / LANES, m, (int)(other % LANES)).entry;
                if (b->w[o] == 0 || b->nbr[o] != b->particle[r]) continue;
                assert_exact(b->plastic_stretch[o], b->plastic_stretch[q]);
                assert_exact(b->plastic_path[o], b->plastic_path[q]);
                checked += b->plastic_path[q] > 0;
            }
        }
    assert_true(checked > 100);
    particle_cloud_free(&c);
}

/* ---- initialisation from material points ------------------------------------------------------------------------- */

/* Checks a bar of material points that have yielded under uniform strain and become peridynamic particles: every bond
 * must carry the stress of the points. */
static void test_taken_over(void **state)
{
    (void)state;
    struct particle_cloud c;
    const real strain = 3e-4, E = 200e9, stress = E * (YIELD + 0.5 * (strain - YIELD));
    particle_cloud_make(
        &c, &(struct cloud_plan){.space = SPACE_LINE, .count = {24}, .horizon = 3, .optional = WITH_PLASTIC});
    c.yield[0] = YIELD, c.hardening[0] = HARDENING;
    for (int64_t i = 0; i < c.p.n; i++) {
        c.p.kind[i] = KIND_MPM;
        c.p.x[0][i] = c.p.X[0][i] * (1 + strain);
        c.p.stress[0][i] = stress;
        c.p.plastic_strain[i] = strain - stress / E;
    }
    cloud_source(&c);
    bonds_make(&c.bonds, NULL, &c.p, &c.source);
    for (int64_t i = 0; i < c.p.n; i++) c.p.kind[i] = KIND_PD;
    particles_rebuild_lists_by_kind(&c.p);
    struct bonds old = c.bonds;
    bonds_make(&c.bonds, &old, &c.p, &c.source);
    bonds_free(&old);
    bond_force_table[1][PD_BOND_PLASTIC](&c.bonds, &c.p, &c.source.limit, NULL);
    bond_stress_table[1][PD_BOND_PLASTIC](&c.bonds, &c.p);
    for (int64_t i = 4; i < 20; i++) { /* complete families: round-off of stretches of 1e-4 */
        assert_close(c.p.stress[0][i], stress * (1 + strain), 1e-11); /* the virial uses current lengths */
        assert_near(c.p.f[0][i], 0, 1e-11 * stress * 4e-6);
    }
    particle_cloud_free(&c);
}

/* Checks in 2D the plastic state of bonds between converted points with different stresses and plastic strains. The
 * plastic stretch of a bond is its stretch minus the mean elastic strain of both points along it, by Hooke's law of
 * plane stress. Its accumulated plastic stretch is the mean plastic strain of both points. */
static void test_taken_over_in_the_plane(void **state)
{
    (void)state;
    struct particle_cloud c;
    const real E = 200e9, nu = 1.0 / 3;
    uint64_t seed = 7;
    particle_cloud_make(
        &c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {6, 5}, .horizon = 2, .optional = WITH_PLASTIC});
    c.yield[0] = YIELD, c.hardening[0] = HARDENING;
    for (int64_t i = 0; i < c.p.n; i++) {
        for (int d = 0; d < 2; d++) c.p.x[d][i] += cloud_between(&seed, -1e-3, 1e-3) * CLOUD_SPACING;
        for (int k = 0; k < 3; k++) c.p.stress[k][i] = cloud_between(&seed, -2e7, 5e7);
        c.p.plastic_strain[i] = cloud_between(&seed, 1e-4, 3e-4);
    }
    cloud_source(&c);
    bonds_make(&c.bonds, NULL, &c.p, &c.source);
    for (int64_t r = 0; r < c.bonds.rows; r++)
        for (struct bond_iterator it = bond_iterator_of_row(&c.bonds, r); bond_iterator_advance(&it);) {
            const int32_t ends[2] = {c.bonds.particle[r], it.bond.nbr};
            real y[2], elastic = 0, path = 0;
            for (int d = 0; d < 2; d++) y[d] = c.p.x[d][ends[1]] - c.p.x[d][ends[0]];
            const real length = hypot(y[0], y[1]), n = y[0] / length, m = y[1] / length;
            for (int k = 0; k < 2; k++) {
                const real xx = c.p.stress[0][ends[k]], yy = c.p.stress[1][ends[k]], xy = c.p.stress[2][ends[k]];
                elastic += 0.5 / E * (n * n * (xx - nu * yy) + m * m * (yy - nu * xx) + 2 * n * m * (1 + nu) * xy);
                path += 0.5 * c.p.plastic_strain[ends[k]];
            }
            assert_near(c.bonds.plastic_stretch[it.bond.entry], length * it.bond.inverse_length - 1 - elastic, 1e-14);
            assert_close(c.bonds.plastic_path[it.bond.entry], path, 1e-12);
        }
    particle_cloud_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_path),
                                       cmocka_unit_test(test_work),
                                       cmocka_unit_test(test_broken),
                                       cmocka_unit_test(test_lanes),
                                       cmocka_unit_test(test_ends),
                                       cmocka_unit_test(test_taken_over),
                                       cmocka_unit_test(test_taken_over_in_the_plane)};
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
