/* Tests strengths that depend on the strain rate: interpolation in the table and onset stretches against closed forms,
 * the step in which bonds of uniformly strained bodies begin to soften, the measured mean rate, and rebuilt rows. */
#include "data/softening_states.h"
#include "kernels/kernels.h"

#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "tests/support/sets.h"
#include "tests/support/soft_body.h"

#define ONSET 1e-4
#define CRITICAL 3e-4

static const struct strength_rate table = {
    .points = 2, .rate = {1, 1000}, .factor = {1, 1.4}, .onset = {1, 1.5}}; /* onsets as if computed */

/* Checks the interpolation in a table of strain rates: linear in the logarithm of the rate between points, constant
 * outside. */
static void test_table(void **state)
{
    (void)state;
    assert_exact(strength_rate_table_interpolate_in_log_rate(&table, table.factor, 0), 1);
    assert_exact(strength_rate_table_interpolate_in_log_rate(&table, table.factor, 1), 1);
    assert_close(strength_rate_table_interpolate_in_log_rate(&table, table.factor, 10), 1 + 0.4 / 3, 1e-14);
    assert_close(strength_rate_table_interpolate_in_log_rate(&table, table.factor, 100), 1 + 0.8 / 3, 1e-14);
    assert_exact(strength_rate_table_interpolate_in_log_rate(&table, table.factor, 1000), 1.4);
    assert_exact(strength_rate_table_interpolate_in_log_rate(&table, table.factor, 1e9), 1.4);
}

/* Checks that with the onset stretch computed for each rate, the peak stress of uniform tension is the tensile strength
 * times the factor of the rate: E s_0 phi(kappa), phi: normalised peak stress. Also checks that kappa = (s_c/s_0)^2 is
 * reported below 1 where the strength is too large for the fracture energy. */
static void test_onsets(void **state)
{
    (void)state;
    const struct softening_model bonds = {0};
    struct material m = {.young = 70e9, .density = 2440, .poisson = 1.0 / 3, .tensile_strength = 40e6};
    material_compute_derived_constants(&m, SPACE_PLANE_STRESS);
    m.critical_stretch = 2.5 * m.tensile_strength / m.young;
    m.rate = (struct strength_rate){.points = 3, .rate = {1, 10, 100}, .factor = {1, 1.3, 2}};
    m.onset_stretch = softening_onset_stretch_from_strength(&m, SPACE_PLANE_STRESS);
    const real least = strength_rate_compute_softening_onset_factors(&m, SPACE_PLANE_STRESS, &bonds);
    const struct softening_curve curve = softening_curve_of_law(SOFTENING_LINEAR);
    for (int k = 0; k < 3; k++) {
        const real onset = m.onset_stretch * m.rate.onset[k], kappa = square(m.critical_stretch / onset);
        assert_close(m.young * onset *
                         softening_curve_normalised_peak_stresses(&curve, SPACE_PLANE_STRESS, kappa).tension,
                     m.tensile_strength * m.rate.factor[k], 1e-6);
        assert_true(kappa >= least);
    }
    m.rate.factor[2] = 3;
    assert_true(strength_rate_compute_softening_onset_factors(&m, SPACE_PLANE_STRESS, &bonds) < 1);
}

static void body_make(struct soft_body *s, enum space space, const struct strength_rate *rate, real critical)
{
    memset(s, 0, sizeof *s);
    particle_cloud_make(&s->c, &(struct cloud_plan){.space = space, .count = {11, 11, 7}, .horizon = 2.015});
    cloud_exact(&s->c);
    soft_bonds(s, SOFTENING_LINEAR, ONSET, critical);
    bonds_free(&s->c.bonds);
    for (int k = 0; k < CLOUD_MATERIALS * CLOUD_MATERIALS; k++) s->pair[k].rate = rate;
    bonds_make(&s->c.bonds, NULL, &s->c.p, &s->c.source);
}

#define GROWTH (0.004 * ONSET) /* of the strain in a step */

/* Performs a step in which the body s is strained to `strain` along x and to -0.2 times this value across. rate: strain
 * rate that is passed to the bonds [1/s]. */
static void pull(struct soft_body *s, real strain, real rate)
{
    struct particles *p = &s->c.p;
    s->c.source.limit.dt = GROWTH / rate;
    cloud_strain(&s->c, (const real[DIM_MAX][DIM_MAX]){{strain}, {0, -0.2 * strain}, {0, 0, -0.2 * strain}});
    bond_forces(bond_force_table[p->dim][PD_BOND_SOFT], &s->c.bonds, p, &s->c.source.limit, NULL);
}

/* Checks the strain at which bonds along x begin to soften, which must be the onset of the table at their rate within
 * two strain increments of 0.4 %. A bond whose fracture energy does not allow this onset begins at kappa = 1.2. */
static void test_begin(void **state)
{
    (void)state;
    const enum space spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
    const real rates[] = {0.1, 10, 1000, 1000}, expected[] = {1, 1 + 0.5 / 3, 1.5, 1.4 / sqrt(1.2)};
    for (int k = 0; k < 12; k++) {
        struct soft_body s;
        real begun = 0;
        body_make(&s, spaces[k % 3], &table, k / 3 == 3 ? 1.4 * ONSET : CRITICAL);
        for (real strain = 0.4 * ONSET; begun == 0 && strain < 2 * ONSET; strain += GROWTH) {
            pull(&s, strain, rates[k / 3]);
            for (int64_t g = 0; g < s.c.bonds.row_blocks; g++)
                if (s.c.bonds.soft.begun[g]) begun = strain / ONSET;
        }
        assert_true(begun > expected[k / 3] - 1e-3 && begun < expected[k / 3] + 0.0095);
        particle_cloud_free(&s.c);
    }
}

/* Checks the measured rate: the mean over the increase of strain from half the onset at low rates to this onset, here
 * 160 1/s for 100 and 400 1/s on half of it each, within 2 %. Later rates do not change it, rebuilt rows keep it, and
 * it is reset below half the onset. */
static void test_rate(void **state)
{
    (void)state;
    const struct strength_rate strong = {.points = 1, .rate = {1}, .factor = {2}, .onset = {2}};
    struct soft_body s;
    body_make(&s, SPACE_PLANE_STRESS, &strong, CRITICAL);
    struct bonds *b = &s.c.bonds;
    const int64_t row = b->row_of[60];
    real strain = 0.45 * ONSET;
    for (; strain < 0.75 * ONSET; strain += GROWTH) pull(&s, strain, 100);
    for (; strain < 1.02 * ONSET; strain += GROWTH) pull(&s, strain, 400);
    assert_close(b->soft.rate[row], 160, 0.02);
    const real before = b->soft.rate[row];
    for (; strain < 1.5 * ONSET; strain += GROWTH) pull(&s, strain, 1e4);
    struct bonds old = *b;
    bonds_make(b, &old, &s.c.p, &s.c.source);
    bonds_free(&old);
    pull(&s, strain, 1e4);
    assert_exact(b->soft.rate[b->row_of[60]], before);
    for (int k = 0; k < 2; k++) pull(&s, 0.49 * ONSET, 100);
    assert_exact(b->soft.rate[row], 0);
    assert_true(!b->soft.rates_kept);
    particle_cloud_free(&s.c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_table), cmocka_unit_test(test_onsets),
                                       cmocka_unit_test(test_begin), cmocka_unit_test(test_rate)};
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
