/* Tests softening bonds of load steps: forces against the gradient of the potential whose stationary points are
 * equilibria, the factor of the displacements at which an energy is dissipated, the return to the last equilibrium, and
 * broken bonds. */
#include <omp.h>

#include "kernels/kernels.h"
#include "src/quasistatic/softening.h"

#include "tests/support/near.h"
#include "tests/support/sets.h"
#include "tests/support/soft_body.h"

#define ONSET 1e-3
#define CRITICAL 2e-3 /* kappa = 4 */

static void body_make(struct soft_body *s, enum space space)
{
    memset(s, 0, sizeof *s);
    omp_set_num_threads(2);
    particle_cloud_make(
        &s->c, &(struct cloud_plan){.space = space, .count = {7, 6, 5}, .horizon = 2.015, .shake = 0.2, .seed = 4});
    soft_bonds(s, space == SPACE_SOLID ? SOFTENING_BILINEAR : SOFTENING_LINEAR, ONSET, CRITICAL);
    bonds_store_max_stretches_at_last_equilibrium(&s->c.bonds, &s->c.p, &s->c.source.limit);
}

/* Stretches the body c by `strain` along x and displaces its particles at random. seed: of the random numbers. */
static void body_move(struct particle_cloud *c, uint64_t seed, real strain)
{
    for (int64_t i = 0; i < c->p.n; i++)
        for (int d = 0; d < c->p.dim; d++)
            c->p.x[d][i] =
                c->p.X[d][i] * (1 + (d == 0 ? strain : 0)) + cloud_between(&seed, -1e-3, 1e-3) * CLOUD_SPACING;
}

/* Lists the softening bonds of s in l at the current positions, and sets the largest stretch k of each to max(k_0,
 * s). */
static void follow(struct soft_body *s, struct softening_bond_list *l)
{
    bonds_open_beyond_onset(&s->c.bonds, &s->c.p, &s->c.source.limit);
    softening_bond_list_collect(l, &s->c.bonds, &s->c.p, 1);
    softening_bond_list_store_largest_stretches(l, &s->c.bonds, 1);
}

/* Returns the potential at the current positions, the sum of phi over all bonds of s [J]. Lists the bonds in l. */
static real potential(struct soft_body *s, struct softening_bond_list *l)
{
    softening_bond_list_collect(l, &s->c.bonds, &s->c.p, 1);
    softening_bond_list_store_largest_stretches(l, &s->c.bonds, 1);
    return bond_energy_table[s->c.p.dim][PD_BOND_SOFT](&s->c.bonds, &s->c.p, NULL) + bonds_fracture_energy(&s->c.bonds);
}

static void forces(struct soft_body *s)
{
    bond_forces(bond_force_table[s->c.p.dim][PD_BOND_SOFT], &s->c.bonds, &s->c.p, &bond_limit_never, NULL);
}

/* Checks that the forces of a body of which some bonds soften further, some unload and some are compressed are minus
 * the gradient of the potential. Central differences over 1e-6 spacings, a thousandth of the onset, have the error of
 * the square, 1e-6, and round-off 1e-16/1e-9 of the force. */
static void test_gradient(void **state)
{
    (void)state;
    const enum space spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    for (size_t k = 0; k < COUNT_OF(spaces); k++) {
        struct soft_body s;
        struct softening_bond_list l = {0};
        body_make(&s, spaces[k]);
        struct particles *p = &s.c.p;
        body_move(&s.c, 11, 2e-3);
        follow(&s, &l);
        bonds_store_max_stretches_at_last_equilibrium(&s.c.bonds, p, &s.c.source.limit);
        body_move(&s.c, 12, 2e-3);
        follow(&s, &l);
        forces(&s);
        real *f[DIM_MAX], most = 0, worst = 0;
        for (int d = 0; d < p->dim; d++) {
            f[d] = BARE("test.force", p->n, real);
            array_copy(f[d], p->f[d], p->n, sizeof(real));
            for (int64_t i = 0; i < p->n; i++) most = real_max(most, fabs(f[d][i]));
        }
        for (int d = 0; d < p->dim; d++)
            for (int64_t i = 0; i < p->n; i++) {
                const real at = p->x[d][i], h = 1e-6 * CLOUD_SPACING;
                p->x[d][i] = at + h;
                const real above = potential(&s, &l);
                p->x[d][i] = at - h;
                const real below = potential(&s, &l);
                p->x[d][i] = at;
                worst = real_max(worst, fabs((below - above) / (2 * h) - f[d][i]));
            }
        assert_true(most > 0 && worst < 5e-6 * most);
        assert_true(l.n > p->n); /* many bonds take part */
        for (int d = 0; d < p->dim; d++) memory_free(f[d]);
        memory_free(l.bond);
        particle_cloud_free(&s.c);
    }
}

/* Creates a body s whose bonds soften, displaces it, and updates the largest stretches. l: empty; receives the
 * bonds. */
static void body_soften(struct soft_body *s, struct softening_bond_list *l)
{
    body_make(s, SPACE_PLANE_STRESS);
    body_move(&s->c, 11, 2e-3);
    follow(s, l);
}

/* Checks the factor of the displacements at which 0.3 of the energy is dissipated. If the largest stretches times this
 * factor are stored, the fracture energy of the bonds must be the same, within 1e-5 because they are floats. */
static void test_factor(void **state)
{
    (void)state;
    struct soft_body s;
    struct softening_bond_list l = {0};
    body_soften(&s, &l);
    const real whole = softening_bond_list_dissipated_energy(&l, 1), wanted = 0.3 * whole;
    assert_close(bonds_fracture_energy(&s.c.bonds), whole, 1e-6);
    const real factor = softening_bond_list_stretch_factor_at_energy(&l, wanted, 1);
    assert_true(factor > 0 && factor < 1);
    assert_close(softening_bond_list_dissipated_energy(&l, factor), wanted, 1e-9);
    softening_bond_list_store_largest_stretches(&l, &s.c.bonds, factor);
    assert_close(bonds_fracture_energy(&s.c.bonds), wanted, 1e-5);
    memory_free(l.bond);
    particle_cloud_free(&s.c);
}

/* Checks that a trial that is undone restores energy and forces bitwise. Forces are those of the stored largest
 * stretches, so that computing them dissipates nothing. */
static void test_undo(void **state)
{
    (void)state;
    struct soft_body s;
    struct softening_bond_list l = {0};
    body_soften(&s, &l);
    bonds_store_max_stretches_at_last_equilibrium(&s.c.bonds, &s.c.p, &s.c.source.limit);
    const real spent = bonds_fracture_energy(&s.c.bonds);
    forces(&s);
    const real force = s.c.p.f[0][0];
    body_move(&s.c, 12, 4e-3);
    forces(&s);
    assert_exact(bonds_fracture_energy(&s.c.bonds), spent);
    follow(&s, &l);
    assert_true(bonds_fracture_energy(&s.c.bonds) > 1.1 * spent);
    bonds_restore_max_stretches_at_last_equilibrium(&s.c.bonds);
    assert_exact(bonds_fracture_energy(&s.c.bonds), spent);
    body_move(&s.c, 11, 2e-3);
    forces(&s);
    assert_exact(s.c.p.f[0][0], force);
    memory_free(l.bond);
    particle_cloud_free(&s.c);
}

/* Checks that a bond stretched beyond its end breaks in both rows, and that its whole energy s_c^2/2 becomes fracture
 * energy. */
static void test_end(void **state)
{
    (void)state;
    struct soft_body s;
    struct softening_bond_list l = {0};
    memset(&s, 0, sizeof s);
    particle_cloud_make(&s.c, &(struct cloud_plan){.space = SPACE_LINE, .count = {2}, .horizon = 1});
    soft_bonds(&s, SOFTENING_LINEAR, ONSET, CRITICAL);
    bonds_store_max_stretches_at_last_equilibrium(&s.c.bonds, &s.c.p, &s.c.source.limit);
    s.c.p.x[0][1] += 5 * ONSET * CLOUD_SPACING;
    follow(&s, &l);
    forces(&s);
    assert_exact(s.c.p.f[0][0], 0);
    assert_int_equal(bonds_end_softened(&s.c.bonds, &s.c.p), 2);
    assert_close(bonds_fracture_energy(&s.c.bonds), 0.5 * square(CRITICAL) * s.c.bonds.stiffness * CLOUD_SPACING, 1e-6);
    memory_free(l.bond);
    particle_cloud_free(&s.c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gradient), cmocka_unit_test(test_factor),
                                       cmocka_unit_test(test_undo), cmocka_unit_test(test_end)};
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
