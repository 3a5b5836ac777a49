/* Tests softening bonds of state-based models: forces against differences of the potential, equal states of both
 * entries of a bond, rebuilt rows, the peak stress of uniform tension, the fracture energy of two separating halves of
 * a lattice, and neighbourhoods under pressure. */
#include <omp.h>

#include "base/polar.h"
#include "bonds/softening_work.h"
#include "kernels/kernels.h"

#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "tests/support/sets.h"
#include "tests/support/soft_body.h"

#define ONSET 1e-3
#define CRITICAL 1.5e-3

/* A body with a state-based model. */
struct state_body {
    struct soft_body s;
    struct state_modulus modulus[CLOUD_MATERIALS];
    enum pd_model model;
};

static void body_make(struct state_body *a, const struct cloud_plan *plan, enum pd_model model, real poisson,
                      real onset, real critical)
{
    struct particle_cloud *c = &a->s.c;
    memset(a, 0, sizeof *a);
    omp_set_num_threads(2);
    particle_cloud_make(c, plan);
    a->model = model;
    for (int m = 0; m < CLOUD_MATERIALS; m++) {
        c->material[m].poisson = poisson;
        material_compute_derived_constants(&c->material[m], plan->space);
        a->modulus[m] = state_based_moduli_of_material(&c->material[m], plan->space, model == PD_MOSPD);
    }
    c->source.modulus = a->modulus, c->source.rotates = model == PD_MOSPD, c->source.local = plan->shake > 0;
    if (plan->shake == 0) cloud_exact(c);
    soft_bonds(&a->s, SOFTENING_LINEAR, onset, critical);
}

static int64_t forces(struct state_body *a)
{
    struct particle_cloud *c = &a->s.c;
    return bond_forces(state_force_table[c->p.dim][a->model], &c->bonds, &c->p, &c->source.limit, NULL);
}

/* Displaces the particles of c at random by up to `size` spacings, in addition to a uniform expansion by `dilatation`
 * along each axis. seed: state of the random numbers. */
static void shake(struct particle_cloud *c, uint64_t *seed, real size, real dilatation)
{
    for (int64_t i = 0; i < c->p.n; i++)
        for (int d = 0; d < c->p.dim; d++)
            c->p.x[d][i] = (1 + dilatation) * c->p.X[d][i] + cloud_between(seed, -size, size) * CLOUD_SPACING;
}

/* ---- potential --------------------------------------------------------------------------------------------------- */

/* Returns the weights of all undamaged bonds of b as an array of n x n, to be freed. Element [i n + j] is the bond from
 * particle i to j; 0: no bond. */
static real *weights_of(const struct bonds *b, int64_t n)
{
    real *w = NEW("test.w", n * n, real);
    for (int64_t r = 0; r < b->rows; r++)
        for (struct bond_iterator it = bond_iterator_of_row(b, r); bond_iterator_advance(&it);)
            w[b->particle[r] * n + it.bond.nbr] = it.bond.w;
    return w;
}

/* Returns 1 - d, the fraction of stiffness of `bond` of row `row` that linear softening leaves at its largest stretch;
 * 0 beyond its end. */
static real kept_of(const struct bonds *b, int64_t row, const struct bond *bond)
{
    const int64_t q = bond->entry;
    if (bond->w == 0) return 0;
    if (!bond_is_softening(b, row / LANES, q)) return 1;
    const real k = b->soft.most[q], onset = b->soft.onset[q], end = b->soft.end[q];
    return onset * (end - k) / ((end - onset) * k);
}

/* Returns the potential of the neighbourhood of row `row` of a (the bonds of one particle) at the current positions
 * [J], by the formulas of state_soften.c. w: weights without damage (weights_of). */
static real row_potential(const struct state_body *a, const real *w, int64_t row)
{
    const struct bonds *b = &a->s.c.bonds;
    const struct particles *p = &a->s.c.p;
    const int64_t i = b->particle[row];
    const int dim = p->dim;
    real Q = 0, S = 0, e2 = 0, moment[9] = {0}, R[9];
    for (int pass = 0; pass < 2; pass++) {
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
            const int64_t j = it.bond.nbr;
            const real full = w[i * p->n + j], q = full * kept_of(b, row, &it.bond);
            real xi[DIM_MAX], y[DIM_MAX];
            for (int d = 0; d < dim; d++) xi[d] = p->X[d][j] - p->X[d][i], y[d] = p->x[d][j] - p->x[d][i];
            const real r = sqrt(dot(xi, xi, dim)), e = sqrt(dot(y, y, dim)) - r;
            if (pass == 0) Q += full * r * r, S += q * r * e;
            for (int d = 0; d < dim && pass == 0; d++)
                for (int c = 0; c < dim; c++) moment[d * dim + c] += q * y[d] * xi[c];
            if (pass == 0) continue;
            for (int d = 0; d < dim && a->model == PD_MOSPD; d++) {
                real eta = y[d];
                for (int c = 0; c < dim; c++) eta -= R[d * dim + c] * xi[c];
                e2 += q * eta * eta;
            }
            if (a->model == PD_OSPD) e2 += q * e * e;
        }
        if (pass == 0) polar_rotation(moment, R, dim);
    }
    const struct state_modulus *m = &a->modulus[p->material[i]];
    return Q > 0 ? 0.5 * p->volume0[i] / Q * (m->A * S * S / Q + m->B * e2) : 0;
}

static real potential(const struct state_body *a, const real *w)
{
    real sum = 0;
    for (int64_t r = 0; r < a->s.c.bonds.rows; r++) sum += row_potential(a, w, r);
    return sum;
}

/* Checks that the forces on irregular bodies with damaged and ended bonds are minus the gradient of the potential at
 * constant damage. Central differences over 1e-6 spacings have a round-off error of 1e-10 of the largest force; weights
 * are floats (1e-7): tolerance 1e-6. */
static void test_gradient(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        struct state_body a;
        uint64_t seed = 7;
        body_make(&a,
                  &(struct cloud_plan){.space = k % 2 ? SPACE_SOLID : SPACE_PLANE_STRESS,
                                       .count = {7, 6, k % 2 ? 5 : 0},
                                       .horizon = 2.015,
                                       .shake = 0.1,
                                       .seed = 3},
                  k < 2 ? PD_OSPD : PD_MOSPD, 0.22, ONSET, CRITICAL);
        struct particles *p = &a.s.c.p;
        struct bonds *b = &a.s.c.bonds;
        real *w = weights_of(b, p->n), largest = 0;
        int64_t ended = 0;
        for (int step = 0; step < 10; step++) shake(&a.s.c, &seed, 2e-4 * (step + 1), 1e-4 * step), ended += forces(&a);
        forces(&a);
        const real energy = potential(&a, w);
        assert_close(state_energy_table[p->dim][a.model](b, p, NULL), energy, 1e-6);
        for (int64_t i = 0; i < p->n; i++)
            for (int d = 0; d < p->dim; d++) largest = real_max(largest, fabs(p->f[d][i]));
        for (int64_t i = 0; i < p->n; i += 5)
            for (int d = 0; d < p->dim; d++) {
                const real x = p->x[d][i], h = 1e-6 * CLOUD_SPACING;
                p->x[d][i] = x + h;
                const real up = potential(&a, w);
                p->x[d][i] = x - h;
                const real down = potential(&a, w);
                p->x[d][i] = x;
                assert_near(p->f[d][i], (down - up) / (2 * h), 1e-6 * largest);
            }
        assert_true(ended > 4);
        memory_free(w);
        particle_cloud_free(&a.s.c);
    }
}

/* Checks that both entries of a bond have bitwise equal states and weights, which conservation of momentum requires.
 * Rebuilt rows must keep states, weights and potential. */
static void test_ends(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct state_body a;
        uint64_t seed = 11;
        int64_t checked = 0;
        body_make(&a,
                  &(struct cloud_plan){
                      .space = SPACE_PLANE_STRESS, .count = {9, 7}, .horizon = 2.015, .shake = 0.1, .seed = 4},
                  k ? PD_MOSPD : PD_OSPD, 0.22, ONSET, CRITICAL);
        struct bonds *b = &a.s.c.bonds;
        for (int step = 0; step < 9; step++) {
            shake(&a.s.c, &seed, 3e-4 * (step + 1), 0);
            forces(&a);
            if (step != 5) continue;
            const real before = state_energy_table[2][a.model](b, &a.s.c.p, NULL);
            struct bonds old = *b;
            bonds_make(b, &old, &a.s.c.p, &a.s.c.source);
            bonds_free(&old);
            state_precompute_table[2][a.model](b, &a.s.c.p);
            assert_close(state_energy_table[2][a.model](b, &a.s.c.p, NULL), before, 1e-12);
        }
        for (int64_t r = 0; r < b->rows; r++)
            for (struct bond_iterator it = bond_iterator_of_row(b, r); bond_iterator_advance(&it);) {
                if (it.bond.w == 0 || !bond_is_softening(b, r / LANES, it.bond.entry)) continue;
                const int64_t other = b->row_of[it.bond.nbr];
                for (struct bond_iterator back = bond_iterator_of_row(b, other); bond_iterator_advance(&back);) {
                    if (back.bond.nbr != b->particle[r]) continue;
                    assert_exact(back.bond.w, it.bond.w);
                    assert_exact(b->soft.most[back.bond.entry], b->soft.most[it.bond.entry]);
                    checked += b->soft.most[it.bond.entry] > b->soft.onset[it.bond.entry];
                }
            }
        assert_true(checked > 50);
        particle_cloud_free(&a.s.c);
    }
}

/* ---- strength and energy ----------------------------------------------------------------------------------------- */

#define SMALL 1e-5 /* onset, so that sums are linear in it */
enum { SIDE = 13 };

/* Compares the peak stress of a block of SIDE particles per edge in uniaxial tension with E s_0 phi, within the
 * anisotropy of a lattice, 5 %. The strain increases in small steps; the lateral strain is iterated until the central
 * particle has no lateral stress. All neighbourhoods that affect the central particle are complete. */
static void test_strength(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        struct state_body a;
        const enum space space = k % 2 ? SPACE_SOLID : SPACE_PLANE_STRESS;
        const struct softening_curve curve = softening_curve_of_law(SOFTENING_LINEAR);
        const struct cloud_plan plan = {
            .space = space, .count = {SIDE, SIDE, k % 2 ? SIDE : 0}, .horizon = 3.015, .shells = SHELLS_ISOTROPIC};
        body_make(&a, &plan, k < 2 ? PD_OSPD : PD_MOSPD, 0.22, SMALL, 2 * SMALL);
        struct particles *p = &a.s.c.p;
        const struct material *m = &a.s.c.material[0];
        const struct softening_model model = {a.modulus[0].A / m->young, a.modulus[0].B / m->young, k >= 2};
        const int64_t middle = p->n / 2;
        real lateral = -0.22 * 0.9 * SMALL, peak = 0;
        for (real strain = 0.9 * SMALL; strain < 2 * SMALL; strain += 0.04 * SMALL) {
            for (int n = 0; n < 4; n++) { /* lateral strain: elastic correction of the stress that is left */
                cloud_strain(&a.s.c, (const real[DIM_MAX][DIM_MAX]){{strain}, {0, lateral}, {0, 0, lateral}});
                forces(&a), forces(&a);
                bond_stress_fn *stress = state_stress_table[p->dim][a.model];
                stress(&a.s.c.bonds, p);
                lateral -= p->stress[1][middle] / (p->dim == 2 ? m->c11 : m->c11 + m->c12);
            }
            peak = real_max(peak, p->stress[0][middle]);
        }
        assert_close(
            peak, m->young * SMALL * softening_model_normalised_peak_stresses(&curve, space, 4, &model).tension, 0.05);
        particle_cloud_free(&a.s.c);
    }
}

/* Compares the work per area of the forces on the upper half of the middle column, while two halves of a lattice move
 * apart, with family_fracture_energy_of_softening_bonds, within 2e-3 (finite steps). The energy that the rows of this
 * column have dissipated must agree within 1 %, because both ends share the dissipation of a bond. */
static void test_separation(void **state)
{
    (void)state;
    enum { WIDE = 15, HIGH = 14, OPENINGS = 600 };
    for (int k = 0; k < 2; k++) {
        struct state_body a;
        body_make(&a, &(struct cloud_plan){.space = SPACE_PLANE_STRAIN, .count = {WIDE, HIGH}, .horizon = 3.015},
                  k ? PD_MOSPD : PD_OSPD, 0.3, SMALL, 1.6 * SMALL);
        struct particles *p = &a.s.c.p;
        struct bonds *b = &a.s.c.bonds;
        const struct softening_range range = softening_range_from_onset(&a.s.curve, SMALL, 1.6 * SMALL);
        const real last = 9.2 * CLOUD_SPACING * range.end, area = CLOUD_SPACING * a.s.c.source.family.section;
        real work = 0, before = 0, spent = 0;
        for (int step = 1; step <= OPENINGS; step++) {
            const real opening = last * step / OPENINGS;
            real force = 0;
            for (int64_t i = 0; i < p->n; i++) p->x[1][i] = p->X[1][i] + (i / WIDE < HIGH / 2 ? 0 : opening);
            forces(&a), forces(&a);
            for (int y = HIGH / 2; y < HIGH; y++) force -= p->f[1][y * WIDE + WIDE / 2];
            work += 0.5 * (before + force) * last / OPENINGS;
            before = force;
        }
        for (int y = 0; y < HIGH; y++) spent += b->fracture_energy[b->row_of[y * WIDE + WIDE / 2]];
        const real expected =
            family_fracture_energy_of_softening_bonds(&a.s.c.source.family, &a.modulus[0], k == 1, &a.s.curve, range);
        assert_close(work / area, expected, 2e-3);
        assert_close(spent / area, expected, 1e-2);
        assert_near(before, 0, 1e-9 * a.s.c.material[0].young * area);
        particle_cloud_free(&a.s.c);
    }
}

/* Checks neighbourhoods under pressure some of whose bonds are stretched: the dissipated energy never decreases from
 * step to step. */
static void test_pressure(void **state)
{
    (void)state;
    struct state_body a;
    uint64_t seed = 5;
    body_make(
        &a,
        &(struct cloud_plan){.space = SPACE_PLANE_STRAIN, .count = {9, 9}, .horizon = 2.015, .shake = 0.1, .seed = 2},
        PD_OSPD, 0.45, ONSET, CRITICAL);
    real before = 0;
    for (int step = 0; step < 40; step++) {
        shake(&a.s.c, &seed, 2e-3, -5e-4 + 2e-5 * step);
        forces(&a);
        const real now = bonds_fracture_energy(&a.s.c.bonds);
        assert_true(now >= before);
        before = now;
    }
    assert_true(before > 0);
    particle_cloud_free(&a.s.c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gradient), cmocka_unit_test(test_ends),
                                       cmocka_unit_test(test_strength), cmocka_unit_test(test_separation),
                                       cmocka_unit_test(test_pressure)};
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
