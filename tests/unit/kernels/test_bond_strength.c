/* Tests strength surfaces that start the softening of bonds: the ratio of stress to strength under uniform strain, at
 * faces, beside a pre-crack and rotated; averages over neighbourhoods against plain sums; the start of softening;
 * scattered strength. */
#include <omp.h>

#include "bonds/strength_surfaces.h"
#include "kernels/kernels.h"

#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "tests/support/sets.h"

#define CRITICAL 1e-3

/* A body of a material with a strength surface. */
struct surface_body {
    struct particle_cloud c;
    struct softening_curve curve;
    struct softening_pair pair[CLOUD_MATERIALS * CLOUD_MATERIALS];
    struct crack crack;
};

/* Creates in `space` the body s with bonds and random positions within `shake` spacings of a lattice. means: number of
 * times that strains are averaged over neighbourhoods; cracked: true to cut it beyond its first third by a crack. */
static void body_make(struct surface_body *s, enum space space, real shake, int means, bool cracked)
{
    memset(s, 0, sizeof *s);
    omp_set_num_threads(2);
    particle_cloud_make(
        &s->c, &(struct cloud_plan){.space = space, .count = {11, 9, 7}, .horizon = 2.5, .shake = shake, .seed = 4});
    s->curve = softening_curve_of_law(SOFTENING_LINEAR);
    for (int m = 0; m < CLOUD_MATERIALS; m++) {
        struct material *k = &s->c.material[m];
        k->tensile_strength = 0.4 * CRITICAL * k->young;
        material_set_strength_surface(
            k, space, strength_surface_from_compressive_strength(k->tensile_strength, 10 * k->tensile_strength));
        k->surface_means = means;
    }
    cloud_source(&s->c);
    for (int k = 0; k < CLOUD_MATERIALS * CLOUD_MATERIALS; k++)
        s->pair[k] = (struct softening_pair){.onset = CRITICAL / sqrt(2), .surface = true}, s->c.limit[k] = CRITICAL;
    struct bond_source *source = &s->c.source;
    source->yield.stretch = NULL;
    source->limit.softening = s->pair, source->limit.curve = &s->curve;
    source->limit.last_force = LAST_FORCE_NONE;
    static real corner[][DIM_MAX] = {{3.1 * CLOUD_SPACING, -CLOUD_SPACING}, {3.1 * CLOUD_SPACING, 4.6 * CLOUD_SPACING}};
    s->crack = (struct crack){.n = 2, .corner = corner};
    if (cracked) source->crack = &s->crack, source->cracks = 1;
    bonds_make(&s->c.bonds, NULL, &s->c.p, source);
}

/* Computes the forces of the softening bonds of s. */
static void soft_forces(struct surface_body *s)
{
    struct particle_cloud *c = &s->c;
    bond_forces(bond_force_table[c->p.dim][PD_BOND_SOFT], &c->bonds, &c->p, &c->source.limit, NULL);
}

/* Sets the positions of s to x = Q (1 + strain) X with the rotation Q by `turn` in the plane xy [rad]. */
static void strain_and_turn(struct surface_body *s, const real strain[DIM_MAX][DIM_MAX], real turn)
{
    struct particles *p = &s->c.p;
    cloud_strain(&s->c, strain);
    for (int64_t i = 0; i < p->n; i++) {
        const real x = p->x[0][i], y = p->x[1][i];
        p->x[0][i] = cos(turn) * x - sin(turn) * y, p->x[1][i] = sin(turn) * x + cos(turn) * y;
    }
}

/* Compares the ratio of stress to strength under uniform strain with that of the stress by Hooke's law, at every
 * particle: inside, at faces, edges and corners, beside a pre-crack, with irregular positions and volumes, after a
 * large rotation, with and without averaging. Tolerance 1e-10: round-off of stretches of 1e-4. */
static void test_uniform(void **state)
{
    (void)state;
    const enum space spaces[] = {SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    const real strain[DIM_MAX][DIM_MAX] = {{2e-4, -1e-4, 0.7e-4}, {-1e-4, 1e-4, 0.3e-4}, {0.7e-4, 0.3e-4, -0.5e-4}};
    for (int k = 0; k < 3; k++)
        for (int means = 0; means < 3; means++) {
            struct surface_body s;
            body_make(&s, spaces[k], 0.2, means, k == 0);
            const struct particles *p = &s.c.p;
            const struct material *m = &s.c.material[0];
            const int dim = p->dim;
            real stress[SYM_MAX], trace = 0, *share = NEW("test.share", p->n, real);
            for (int d = 0; d < dim; d++) trace += strain[d][d];
            for (int c = 0; c < symmetric_tensor_component_count(dim); c++) {
                int a, b;
                symmetric_tensor_component_axes(dim, c, &a, &b);
                stress[c] = 2 * m->shear * strain[a][b] + (a == b ? m->c12 * trace : 0);
            }
            const real expected = material_stress_to_strength_ratio(m, spaces[k], stress);
            strain_and_turn(&s, strain, 1.1);
            bonds_compute_stress_to_strength_ratios(&s.c.bonds, p, &s.c.source, share);
            for (int64_t i = 0; i < p->n; i++) assert_close(share[i], expected, 1e-9);
            assert_true(expected > 0.1);
            memory_free(share);
            particle_cloud_free(&s.c);
        }
}

/* Computes strain[3] (xx, yy, xy) of particle i of s in 2D, the least-squares strain over all particles within the
 * horizon for small rotations: the symmetric part of sum w u xi (sum w xi xi)^-1 with w = V/r, bond vector xi and
 * relative displacement u. */
static void plain_strain(const struct surface_body *s, int64_t i, real *strain)
{
    const struct particles *p = &s->c.p;
    real K[3] = {0}, M[2][2] = {{0}};
    for (int64_t j = 0; j < p->n; j++) {
        const real xi[] = {p->X[0][j] - p->X[0][i], p->X[1][j] - p->X[1][i]}, r = sqrt(dot(xi, xi, 2));
        if (j == i || r > s->c.source.family.cutoff) continue;
        const real w = p->volume0[j] / r;
        K[0] += w * xi[0] * xi[0], K[1] += w * xi[1] * xi[1], K[2] += w * xi[0] * xi[1];
        for (int a = 0; a < 2; a++)
            for (int b = 0; b < 2; b++) M[a][b] += w * (p->x[a][j] - p->x[a][i] - xi[a]) * xi[b];
    }
    const real determinant = K[0] * K[1] - K[2] * K[2];
    strain[0] = (M[0][0] * K[1] - M[0][1] * K[2]) / determinant;
    strain[1] = (M[1][1] * K[0] - M[1][0] * K[2]) / determinant;
    strain[2] = 0.5 * (M[0][1] * K[0] - M[0][0] * K[2] + M[1][0] * K[1] - M[1][1] * K[2]) / determinant;
}

/* Replaces the strains strain[][3] of all particles of s by their means over neighbourhoods. */
static void plain_mean(const struct surface_body *s, real (*strain)[3])
{
    const struct particles *p = &s->c.p;
    real(*mean)[3] = memory_new("test.mean", p->n, sizeof *mean);
    for (int64_t i = 0; i < p->n; i++) {
        int count = 0;
        for (int64_t j = 0; j < p->n; j++) {
            if (hypot(p->X[0][j] - p->X[0][i], p->X[1][j] - p->X[1][i]) > s->c.source.family.cutoff) continue;
            for (int c = 0; c < 3; c++) mean[i][c] += strain[j][c];
            count++;
        }
        for (int c = 0; c < 3; c++) mean[i][c] /= count;
    }
    memcpy(strain, mean, (size_t)p->n * sizeof *mean);
    memory_free(mean);
}

/* Compares the ratios of stress to strength under a non-uniform strain, after 0, 1 and 2 averages over neighbourhoods,
 * with plain_strain and plain_mean. Their strains neglect rotations: tolerance 1e-3, ten times the strains. */
static void test_means(void **state)
{
    (void)state;
    for (int means = 0; means < 3; means++) {
        struct surface_body s;
        body_make(&s, SPACE_PLANE_STRESS, 0.2, means, false);
        struct particles *p = &s.c.p;
        const struct material *m = &s.c.material[0];
        real *share = NEW("test.share", p->n, real), least = INFINITY, most = 0;
        real(*strain)[3] = memory_new("test.strain", p->n, sizeof *strain);
        for (int64_t i = 0; i < p->n; i++) {
            const real x = p->X[0][i] / CLOUD_SPACING, y = p->X[1][i] / CLOUD_SPACING;
            p->x[0][i] = p->X[0][i] + CLOUD_SPACING * (1e-5 * x * x + 2e-5 * y);
            p->x[1][i] = p->X[1][i] + CLOUD_SPACING * (1e-5 * y * x - 1e-5 * y * y);
        }
        for (int64_t i = 0; i < p->n; i++) plain_strain(&s, i, strain[i]);
        for (int k = 0; k < means; k++) plain_mean(&s, strain);
        bonds_compute_stress_to_strength_ratios(&s.c.bonds, p, &s.c.source, share);
        for (int64_t i = 0; i < p->n; i++) {
            const real stress[] = {m->c11 * strain[i][0] + m->c12 * strain[i][1],
                                   m->c11 * strain[i][1] + m->c12 * strain[i][0], 2 * m->shear * strain[i][2]};
            const real expected = material_stress_to_strength_ratio(m, SPACE_PLANE_STRESS, stress);
            least = real_min(least, expected), most = real_max(most, expected);
            assert_near(share[i], expected, 1e-3);
        }
        assert_true(most > least + 0.2);
        memory_free(share), memory_free(strain);
        particle_cloud_free(&s.c);
    }
}

/* Returns the fraction of the intact bonds of b that have begun to soften [1]. */
static real started(const struct bonds *b)
{
    int64_t begun = 0, all = 0;
    for (int64_t r = 0; r < b->rows; r++)
        for (struct bond_iterator it = bond_iterator_of_row(b, r); bond_iterator_advance(&it); all += it.bond.w != 0)
            begun += it.bond.w != 0 && bond_is_softening(b, r / LANES, it.bond.entry);
    return (real)begun / (real)all;
}

/* Checks proportional loading in uniaxial tension, equibiaxial tension and shear, in 2D and 3D. Below the strength
 * surface no bond begins to soften; at 1.001 of it all bonds do. The start changes forces by at most 1e-6 (states are
 * floats) and dissipates nothing. At twice the strain the dissipated energy exceeds a tenth of the elastic energy. */
static void test_start(void **state)
{
    (void)state;
    const real states[][2] = {{1, -1.0 / 3}, {1, 1}, {1, -1}};
    for (size_t run = 0; run < 2 * COUNT_OF(states); run++) {
        const size_t k = run / 2;
        struct surface_body s;
        body_make(&s, run % 2 ? SPACE_SOLID : SPACE_PLANE_STRESS, 0.1, 1, false);
        struct particles *p = &s.c.p;
        struct bonds *b = &s.c.bonds;
        real *share = NEW("test.share", p->n, real), force = 0, change = 0;
        const real unit = 1e-4;
#define STRAIN(F) ((const real[DIM_MAX][DIM_MAX]){{(F)*states[k][0]}, {0, (F)*states[k][1]}})
        cloud_strain(&s.c, STRAIN(unit));
        bonds_compute_stress_to_strength_ratios(b, p, &s.c.source, share);
        const real at = unit / share[0];
        assert_true(at < CRITICAL / sqrt(2));
        for (real part = 0.5; part < 1; part += 0.07) {
            cloud_strain(&s.c, STRAIN(part * at));
            soft_forces(&s);
            bonds_start_softening_at_strength_surface(b, p, &s.c.source);
            assert_exact(started(b), 0);
        }
        cloud_strain(&s.c, STRAIN(1.001 * at));
        soft_forces(&s);
        assert_close(bonds_largest_stress_to_strength_ratio(b, p, &s.c.source), 1.001, 1e-9);
        real *before = NEW("test.force", p->n, real);
        for (int64_t i = 0; i < p->n; i++) before[i] = p->f[0][i];
        bonds_start_softening_at_strength_surface(b, p, &s.c.source);
        assert_exact(started(b), 1);
        assert_exact(bonds_largest_stress_to_strength_ratio(b, p, &s.c.source), 0); /* none is left to start */
        assert_exact(bonds_fracture_energy(b), 0);
        soft_forces(&s);
        for (int64_t i = 0; i < p->n; i++)
            force = real_max(force, fabs(before[i])), change = real_max(change, fabs(p->f[0][i] - before[i]));
        assert_true(change < 1e-6 * force);
        assert_near(bonds_fracture_energy(b), 0, 1e-6 * bond_energy_table[p->dim][PD_BOND_SOFT](b, p, NULL));
        cloud_strain(&s.c, STRAIN(2 * at));
        soft_forces(&s);
        assert_true(bonds_fracture_energy(b) > 0.1 * bond_energy_table[p->dim][PD_BOND_SOFT](b, p, NULL));
        memory_free(share), memory_free(before);
        particle_cloud_free(&s.c);
    }
}

/* Checks that both entries of a bond have bitwise equal states after local starts of softening, also with rows rebuilt
 * in between. The end follows from the onset by s_f = s_c^2/s_0. Onsets of started bonds are between 0.3 sigma_t/E and
 * s_c/sqrt(2). */
static void test_ends(void **state)
{
    (void)state;
    struct surface_body s;
    int64_t checked = 0;
    body_make(&s, SPACE_PLANE_STRESS, 0.2, 1, false);
    struct particles *p = &s.c.p;
    struct bonds *b = &s.c.bonds;
    for (int step = 0; step < 2; step++) {
        for (int64_t i = 0; i < p->n; i++) /* strains grow with x */
            p->x[0][i] = p->X[0][i] + (1 + step) * 4.5e-5 * square(p->X[0][i]) / (2 * CLOUD_SPACING);
        soft_forces(&s);
        bonds_start_softening_at_strength_surface(b, p, &s.c.source);
        struct bonds old = *b;
        bonds_make(b, &old, p, &s.c.source);
        bonds_free(&old);
    }
    assert_true(started(b) > 0.1 && started(b) < 0.9);
    for (int64_t r = 0; r < b->rows; r++)
        for (struct bond_iterator it = bond_iterator_of_row(b, r); bond_iterator_advance(&it);) {
            if (!bond_is_softening(b, r / LANES, it.bond.entry)) continue;
            const struct bond_softening_state own = bond_softening_state_read(&b->soft, it.bond.entry);
            const int64_t other = b->row_of[it.bond.nbr];
            assert_close(own.end, square(CRITICAL) / own.onset, 1e-6);
            assert_true(own.onset <= CRITICAL / sqrt(2) * (1 + 1e-6) && own.onset >= 0.3 * 0.4 * CRITICAL * (1 - 1e-6));
            for (struct bond_iterator back = bond_iterator_of_row(b, other); bond_iterator_advance(&back);) {
                if (back.bond.nbr != b->particle[r]) continue;
                const struct bond_softening_state there = bond_softening_state_read(&b->soft, back.bond.entry);
                assert_exact(there.most, own.most);
                assert_exact(there.onset, own.onset);
                assert_exact(there.end, own.end);
                checked++;
            }
        }
    assert_true(checked > 100);
    particle_cloud_free(&s.c);
}

/* Checks scattered strength: the bonds of a particle with the random strength factor f begin to soften at the fraction
 * f of the stress on the strength surface. */
static void test_scatter(void **state)
{
    (void)state;
    struct surface_body s;
    body_make(&s, SPACE_PLANE_STRESS, 0, 0, false);
    struct particles *p = &s.c.p;
    struct bonds *b = &s.c.bonds;
    real *share = NEW("test.share", p->n, real);
    const int64_t weak = p->n / 2;
    p->strength = NEW("test.strength", p->n, real);
    for (int64_t i = 0; i < p->n; i++) p->strength[i] = i == weak ? 0.8 : 1;
    struct bonds old = *b;
    bonds_make(b, NULL, p, &s.c.source);
    bonds_free(&old);
    cloud_strain(&s.c, (const real[DIM_MAX][DIM_MAX]){{1e-4}});
    bonds_compute_stress_to_strength_ratios(b, p, &s.c.source, share);
    const real at = 1e-4 / share[0];
    for (int k = 0; k < 2; k++) {
        cloud_strain(&s.c, (const real[DIM_MAX][DIM_MAX]){{(k == 0 ? 0.79 : 0.81) * at}});
        soft_forces(&s);
        bonds_start_softening_at_strength_surface(b, p, &s.c.source);
        for (int64_t i = 0; i < p->n; i++) {
            int64_t begun = 0, bonds = 0;
            for (struct bond_iterator it = bond_iterator_of_row(b, b->row_of[i]); bond_iterator_advance(&it); bonds++)
                begun += bond_is_softening(b, b->row_of[i] / LANES, it.bond.entry);
            if (i == weak) assert_int_equal(begun, k == 0 ? 0 : bonds);
            if (i != weak) assert_true(begun <= (k == 0 ? 0 : 1));
        }
    }
    memory_free(share);
    particle_cloud_free(&s.c);
}

/* Checks that a strength surface that does not depend on pressure is reached under uniaxial compressive strain, in
 * which no bond is stretched. */
static void test_unstretched(void **state)
{
    (void)state;
    struct surface_body s;
    body_make(&s, SPACE_SOLID, 0, 1, false);
    struct bonds *b = &s.c.bonds;
    for (int m = 0; m < CLOUD_MATERIALS; m++)
        material_set_strength_surface(&s.c.material[m], SPACE_SOLID,
                                      strength_surface_from_compressive_strength(s.c.material[m].tensile_strength,
                                                                                 s.c.material[m].tensile_strength));
    struct bonds old = *b;
    bonds_make(b, NULL, &s.c.p, &s.c.source);
    bonds_free(&old);
    for (real strain = -4e-4; strain > -8e-4; strain -= 3e-4) { /* sqrt(J2) = 2 G strain/sqrt(3): at -0.5e-3 */
        cloud_strain(&s.c, (const real[DIM_MAX][DIM_MAX]){{strain}});
        soft_forces(&s);
        bonds_start_softening_at_strength_surface(b, &s.c.p, &s.c.source);
        assert_exact(started(b), strain < -5e-4 ? 1 : 0);
    }
    particle_cloud_free(&s.c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_uniform), cmocka_unit_test(test_means),
                                       cmocka_unit_test(test_start),   cmocka_unit_test(test_ends),
                                       cmocka_unit_test(test_scatter), cmocka_unit_test(test_unstretched)};
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
