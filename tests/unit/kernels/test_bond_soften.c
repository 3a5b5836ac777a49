/* Tests bonds that soften: cycles of one bond against closed forms, all lanes against a plain implementation,
 * dissipated energy, equal states of both entries of a bond, a uniformly strained neighbourhood, the force across a
 * separating line, and compression. */
#include <omp.h>

#include "kernels/kernels.h"

#include "tests/support/cloud.h"
#include "tests/support/near.h"
#include "tests/support/sets.h"
#include "tests/support/soft_body.h"
#include "tests/support/soften_reference.h"

#define ONSET 1e-3
#define CRITICAL 2e-3 /* kappa = 4 */

/* Performs a step of s without motion: starts the softening of bonds and computes forces. Returns the number of bonds
 * that break. */
static int64_t soft_forces(struct soft_body *s)
{
    struct particle_cloud *c = &s->c;
    return bond_forces(bond_force_table[c->p.dim][PD_BOND_SOFT], &c->bonds, &c->p, &c->source.limit, NULL);
}

/* ---- one bond ---------------------------------------------------------------------------------------------------- */

/* Creates s, two particles with a bond that softens by the law `law`. */
static void pair_make(struct soft_body *s, enum softening law)
{
    memset(s, 0, sizeof *s);
    omp_set_num_threads(1); /* a team for two particles would only wait */
    particle_cloud_make(&s->c, &(struct cloud_plan){.space = SPACE_LINE, .count = {2}, .horizon = 1});
    soft_bonds(s, law, ONSET, CRITICAL);
}

/* Returns the force of the only bond of s at the stretch `stretch`, divided by stiffness and weight [1], after two
 * steps at this stretch: a bond begins to soften one step after its stretch has exceeded the onset. */
static real pulled(struct soft_body *s, real stretch)
{
    struct particles *p = &s->c.p;
    p->x[0][1] = p->x[0][0] + (p->X[0][1] - p->X[0][0]) * (1 + stretch);
    soft_forces(s), soft_forces(s);
    assert_exact(p->f[0][0], -p->f[0][1]);
    return p->f[0][0] / s->c.bonds.stiffness;
}

/* Returns the force of a bond with the softening law `law` at its largest stretch k, divided by stiffness and weight
 * [1]. Linear law: end s_f = s_c^2/s_0. Law for concrete: a kink at (s_0 + 2X/9, s_0/3), X = 9/5 (s_c^2 - s_0^2)/s_0.
 * Exponential law: with 0.8 % for its approximation by chords. */
static real envelope(enum softening law, real k)
{
    const real decay = 5, reach = (square(CRITICAL) - square(ONSET)) / (2 * ONSET);
    if (law != SOFTENING_EXPONENTIAL) return soften_reference_peak(law, ONSET, CRITICAL, k);
    const real area = 1 / decay - exp(-decay) / (1 - exp(-decay)); /* of (exp(-5 x) - exp(-5))/(1 - exp(-5)) */
    const real x = (k - ONSET) * area / reach;
    return x < 1 ? ONSET * (exp(-decay * x) - exp(-decay)) / (1 - exp(-decay)) : 0;
}

/* Checks the force of a bond under loading cycles: elastic up to s_0, then the softening curve, unloading along the
 * secant to the origin with slope (1 - d) c, and full stiffness in compression. Tolerances: largest stretches are
 * stored as floats (6e-8); chords deviate from the exponential curve by 0.7 % of its height. */
static void test_cycles(void **state)
{
    (void)state;
    for (enum softening law = SOFTENING_LINEAR; law <= SOFTENING_EXPONENTIAL; law++) {
        const real peaks[] = {1.2e-3, 1.5e-3, 2e-3, 3e-3, 3.5e-3};
        const real within = law == SOFTENING_EXPONENTIAL ? 0.015 * ONSET : 1e-6 * ONSET;
        struct soft_body s;
        pair_make(&s, law);
        assert_near(pulled(&s, 0.9 * ONSET), 0.9 * ONSET, 1e-12);
        assert_near(pulled(&s, -5 * ONSET), -5 * ONSET, 1e-12);
        for (size_t k = 0; k < COUNT_OF(peaks); k++) {
            const real top = pulled(&s, peaks[k]);
            assert_near(top, envelope(law, peaks[k]), within);
            assert_close(pulled(&s, 0.5 * peaks[k]), 0.5 * top, 1e-6);
            assert_close(pulled(&s, 0.1 * peaks[k]), 0.1 * top, 1e-6);
            assert_near(pulled(&s, -0.7 * ONSET), -0.7 * ONSET, 1e-12);
            assert_close(pulled(&s, peaks[k]), top, 1e-6);
        }
        particle_cloud_free(&s.c);
    }
}

/* Checks that the work on a bond along a path with two unloadings equals elastic energy plus dissipated energy, which
 * never decreases. Over the whole path it must be s_c^2/2 divided by stiffness and length, the energy of a brittle
 * bond. Tolerance: trapezoidal rule with 2e-4 of the path, and states stored as floats. */
static void test_work(void **state)
{
    (void)state;
    for (enum softening law = SOFTENING_LINEAR; law <= SOFTENING_EXPONENTIAL; law++) {
        struct soft_body s;
        pair_make(&s, law);
        const real end = softening_breaking_stretch_of_equal_energy(&s.curve, ONSET, CRITICAL),
                   corner[] = {0, 1.4 * ONSET, -ONSET, 0.6 * end, 0, end};
        const real scale = s.c.bonds.stiffness * CLOUD_SPACING;
        real work = 0, before = 0, dissipated = 0;
        enum { STEPS = 5000 };
        for (size_t k = 1; k < COUNT_OF(corner); k++) {
            for (int step = 1; step <= STEPS; step++) {
                const real from = corner[k - 1], to = corner[k];
                const real force = pulled(&s, from + (to - from) * step / STEPS);
                work += 0.5 * (force + before) * (to - from) / STEPS * scale;
                before = force;
                const real now = bonds_fracture_energy(&s.c.bonds);
                assert_true(now >= dissipated * (1 - 1e-6)); /* floats */
                dissipated = now;
            }
            const real held = bond_energy_table[1][PD_BOND_SOFT](&s.c.bonds, &s.c.p, NULL);
            assert_near(held + dissipated, work, 2e-6 * 0.5 * square(CRITICAL) * scale);
        }
        assert_close(dissipated, 0.5 * square(CRITICAL) * scale, 2e-6);
        pulled(&s, 1.01 * end);
        assert_int_equal(s.c.bonds.broken[0] + s.c.bonds.broken[1], 2);
        assert_close(bonds_fracture_energy(&s.c.bonds), 0.5 * square(CRITICAL) * scale, 2e-6);
        assert_exact(pulled(&s, 1.02 * end), 0);
        particle_cloud_free(&s.c);
    }
}

/* Checks three large steps along the softening curve, across its kinks. The dissipated energy must be the work of the
 * mean force of each step, as in leap-frog integration, less the change of elastic energy. Tolerance: states are
 * floats. */
static void test_kinks(void **state)
{
    (void)state;
    for (enum softening law = SOFTENING_LINEAR; law <= SOFTENING_EXPONENTIAL; law++) {
        struct soft_body s;
        pair_make(&s, law);
        const real end = softening_breaking_stretch_of_equal_energy(&s.curve, ONSET, CRITICAL),
                   scale = s.c.bonds.stiffness * CLOUD_SPACING;
        real at = 1.01 * ONSET, force = pulled(&s, at);
        for (int step = 1; step <= 3; step++) {
            const real before = bonds_fracture_energy(&s.c.bonds) + 0.5 * force * at * scale, to = 0.3 * step * end;
            const real next = pulled(&s, to), after = bonds_fracture_energy(&s.c.bonds) + 0.5 * next * to * scale;
            assert_near(after - before, 0.5 * (force + next) * (to - at) * scale, 1e-6 * square(CRITICAL) * scale);
            at = to, force = next;
        }
        particle_cloud_free(&s.c);
    }
}

/* Checks a bond whose stretch goes in one step from below its onset to s_0 = 6 onsets, beyond its end, and in the next
 * step to s_1 = 7 onsets. It acts with its full force in the first step and breaks in the second without a last force.
 * The dissipated energy is c s_0^2/2 plus the work of the mean force c s_0/2 on s_1 - s_0: c s_0 s_1/2 per length. */
static void test_at_once(void **state)
{
    (void)state;
    struct soft_body s;
    pair_make(&s, SOFTENING_LINEAR);
    struct particles *p = &s.c.p;
    s.c.source.limit.last_force = LAST_FORCE_MOMENT, s.c.source.limit.dt = 1e-9;
    for (int step = 0; step < 2; step++) {
        p->x[0][1] = p->x[0][0] + CLOUD_SPACING * (1 + (step ? 7 : 6) * ONSET);
        p->v[0][1] = CLOUD_SPACING * (step ? 1 : 5.5) * ONSET / 1e-9;
        assert_int_equal(soft_forces(&s), step ? 2 : 0);
        assert_true((p->f[0][0] > 0) == !step);
    }
    assert_close(bonds_fracture_energy(&s.c.bonds), 0.5 * 6 * 7 * square(ONSET) * s.c.bonds.stiffness * CLOUD_SPACING,
                 1e-9);
    particle_cloud_free(&s.c);
}

/* ---- many bonds -------------------------------------------------------------------------------------------------- */

/* Creates in `space` an irregular body s of two materials whose bonds soften by the law `law`. seed: of its
 * positions. */
static void body_make(struct soft_body *s, enum space space, enum softening law, uint64_t seed)
{
    memset(s, 0, sizeof *s);
    omp_set_num_threads(2);
    particle_cloud_make(
        &s->c, &(struct cloud_plan){.space = space, .count = {9, 7, 5}, .horizon = 2.015, .shake = 0.2, .seed = seed});
    for (int64_t i = 0; i < s->c.p.n; i++) s->c.p.material[i] = (uint8_t)(i % 2);
    soft_bonds(s, law, ONSET, CRITICAL);
    bonds_free(&s->c.bonds);
    s->c.limit[3] = 1.2 * CRITICAL;
    bonds_make(&s->c.bonds, NULL, &s->c.p, &s->c.source);
}

/* Displaces the particles of c at random by up to `size` spacings, up to stretches of 3 s_0 and, in the last steps,
 * beyond s_f. seed: state of the random numbers. */
static void shake(struct particle_cloud *c, uint64_t *seed, real size)
{
    for (int64_t i = 0; i < c->p.n; i++)
        for (int d = 0; d < c->p.dim; d++)
            c->p.x[d][i] = c->p.X[d][i] + cloud_between(seed, -size, size) * CLOUD_SPACING;
}

/* Compares forces, energy and dissipation of irregular bodies of two materials in random motion with the plain
 * implementation (support/soften_reference.h). Tolerance of forces 1e-6 of that at the onset: states are floats. */
static void test_lanes(void **state)
{
    (void)state;
    const enum space spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct soft_body s;
        uint64_t seed = 5;
        body_make(&s, spaces[dim - 1], dim == 2 ? SOFTENING_BILINEAR : SOFTENING_LINEAR, 3);
        const struct bonds *b = &s.c.bonds;
        const struct particles *p = &s.c.p;
        const int64_t n = p->n;
        struct soften_reference r = soften_reference_make(dim == 2 ? SOFTENING_BILINEAR : SOFTENING_LINEAR, n);
        real *w = reference_table(b, p);
        int64_t *block = NEW("test.block", n, int64_t), ended = 0, softened = 0;
        struct reference_row *row = NEW("test.rows", n, struct reference_row);
        for (int64_t i = 0; i < n; i++) block[i] = b->row_of[i] / LANES;
        for (int64_t q = 0; q < n * n; q++) {
            const int pair = p->material[q / n] * CLOUD_MATERIALS + p->material[q % n];
            r.onset[q] = s.pair[pair].onset, r.critical[q] = s.c.limit[pair];
        }
        for (int step = 0; step < 16; step++) {
            real energy = 0;
            shake(&s.c, &seed, 2e-4 * (step + 1));
            soften_reference_begin(&r, p, w, b->stiffness, block);
            soften_reference_step(&r, p, w, b->stiffness, block, row);
            soft_forces(&s);
            for (int64_t i = 0; i < n; i++) {
                energy += row[i].energy;
                for (int d = 0; d < dim; d++)
                    assert_near(p->f[d][i], row[i].force[d], 1e-6 * b->stiffness * ONSET * 10);
            }
            assert_close(bond_energy_table[dim][PD_BOND_SOFT](b, p, NULL), energy, 1e-6);
            assert_near(bonds_fracture_energy(b), soften_reference_fracture(&r, p, w, b->stiffness), 1e-6 * energy);
        }
        for (int64_t q = 0; q < n * n; q++) ended += r.ended[q], softened += r.most[q] > r.onset[q];

        assert_true(ended >= 2 && softened >= 20);
        soften_reference_free(&r);
        memory_free(w), memory_free(block), memory_free(row);
        particle_cloud_free(&s.c);
    }
}

/* Checks that both entries of a bond have bitwise equal states, which conservation of momentum requires, and that
 * rebuilt rows keep the states. */
static void test_ends(void **state)
{
    (void)state;
    struct soft_body s;
    uint64_t seed = 9;
    int64_t checked = 0;
    body_make(&s, SPACE_PLANE_STRESS, SOFTENING_LINEAR, 4);
    struct bonds *b = &s.c.bonds;
    for (int step = 0; step < 9; step++) {
        shake(&s.c, &seed, 3e-4 * (step + 1));
        soft_forces(&s);
        if (step != 4) continue;
        const real before = bonds_fracture_energy(b);
        struct bonds old = *b;
        bonds_make(b, &old, &s.c.p, &s.c.source);
        bonds_free(&old);
        assert_exact(bonds_fracture_energy(b), before);
    }
    for (int64_t r = 0; r < b->rows; r++)
        for (int64_t k = 0; k < b->column_count[r / LANES]; k++) {
            const struct bond bond = bond_read(b, r / LANES, k, (int)(r % LANES));
            if (bond.w == 0 || !bond_is_softening(b, r / LANES, bond.entry)) continue;
            const int64_t other = b->row_of[bond.nbr];
            for (struct bond_iterator it = bond_iterator_of_row(b, other); bond_iterator_advance(&it);) {
                if (it.bond.nbr != b->particle[r]) continue;
                assert_true(bond_is_softening(b, other / LANES, it.bond.entry));
                assert_exact(b->soft.most[it.bond.entry], b->soft.most[bond.entry]);
                checked += b->soft.most[bond.entry] > b->soft.onset[bond.entry];
            }
        }
    assert_true(checked > 100);
    particle_cloud_free(&s.c);
}

/* ---- a uniformly strained neighbourhood -------------------------------------------------------------------------- */

#define SMALL 1e-5 /* onset, so that the sum is linear in it */

/* Returns the stress along x of a full neighbourhood f on a lattice under the strains `axial` (along x) and `lateral`,
 * and stores the lateral stress in *across: sigma = 1/2 c sum V f(s) r n n over its bonds with linear softening f. c:
 * micro-modulus. */
static real lattice_stress(const struct family *f, real c, real axial, real lateral, real *across)
{
    const int dim = space_dim(f->space), reach = (int)ceil(f->cutoff / f->spacing);
    real sum = 0;
    *across = 0;
    for (int z = dim > 2 ? -reach : 0; z <= (dim > 2 ? reach : 0); z++)
        for (int y = -reach; y <= reach; y++)
            for (int x = -reach; x <= reach; x++) {
                const real xi[DIM_MAX] = {x * f->spacing, y * f->spacing, z * f->spacing}, r = sqrt(dot(xi, xi, 3));
                if (r == 0 || r > f->cutoff) continue;
                const real w = family_bond_weight(f, xi, r), along = square(xi[0] / r),
                           s = axial * along + lateral * (1 - along);
                const real t = s <= SMALL ? s : soften_reference_peak(SOFTENING_LINEAR, SMALL, 2 * SMALL, s);
                sum += 0.5 * c * f->cell_volume * w * t * r * along;
                *across += 0.5 * c * f->cell_volume * w * t * r * (1 - along) / (dim - 1);
            }
    return sum;
}

/* Compares the stress of the central particle of a block in uniaxial tension with the sum of lattice_stress, within
 * 1e-3, in small steps with the lateral strain at which this sum has no lateral stress. Compares its peak with E s_0
 * phi within the anisotropy of a lattice, 5 %. phi(kappa = 4) = 1.096 in 2D and 1.281 in 3D by an independent
 * quadrature over directions. */
static void test_family(void **state)
{
    (void)state;
    const enum space spaces[] = {SPACE_PLANE_STRESS, SPACE_SOLID};
    for (int k = 0; k < 2; k++) {
        struct soft_body s = {0};
        const real phi = k == 0 ? 1.096 : 1.281;
        real peak = 0, expected_peak = 0;
        particle_cloud_make(
            &s.c, &(struct cloud_plan){
                      .space = spaces[k], .count = {11, 11, 11}, .horizon = 3.015, .shells = SHELLS_ISOTROPIC});
        cloud_exact(&s.c);
        soft_bonds(&s, SOFTENING_LINEAR, SMALL, 2 * SMALL);
        const int dim = s.c.p.dim;
        const int64_t middle = s.c.p.n / 2;
        const real c = family_micro_modulus(&s.c.source.family, &s.c.material[0]);
        for (real strain = 0.9 * SMALL; strain < 2 * SMALL; strain += 0.01 * SMALL) {
            real low = -strain, high = 0, across;
            for (int n = 0; n < 50; n++) {
                const real half = 0.5 * (low + high);
                lattice_stress(&s.c.source.family, c, strain, half, &across);
                *(across > 0 ? &high : &low) = half;
            }
            const real expected = lattice_stress(&s.c.source.family, c, strain, low, &across);
            cloud_strain(&s.c, (const real[DIM_MAX][DIM_MAX]){{strain}, {0, low}, {0, 0, low}});
            soft_forces(&s);
            soft_forces(&s);
            bond_stress_table[dim][PD_BOND_SOFT](&s.c.bonds, &s.c.p);
            assert_close(s.c.p.stress[0][middle], expected, 1e-3);
            peak = real_max(peak, s.c.p.stress[0][middle]), expected_peak = real_max(expected_peak, expected);
        }
        assert_close(peak, expected_peak, 1e-3);
        assert_close(peak, s.c.material[0].young * SMALL * phi, 0.05);
        particle_cloud_free(&s.c);
    }
}

/* ---- a line torn apart ------------------------------------------------------------------------------------------- */

/* Compares the force across a line whose halves move apart by w with the closed form for large kappa, E s_0 (1 -
 * w/w_c)^2, w_c = s_f delta with the horizon delta. Bonds of n spacings cross a point n times; their sum differs from
 * the integral by 1/m for a horizon of m = 60 spacings. */
static void test_line(void **state)
{
    (void)state;
    enum { HORIZON = 60 };
    const real onset = 1e-6, critical = 1e-4, end = square(critical) / onset; /* kappa = 1e4 */
    struct soft_body s = {0};
    particle_cloud_make(&s.c, &(struct cloud_plan){.space = SPACE_LINE, .count = {128}, .horizon = HORIZON});
    soft_bonds(&s, SOFTENING_LINEAR, onset, critical);
    struct particles *p = &s.c.p;
    const real strength = s.c.material[0].young * s.c.source.family.section * onset;
    for (int k = 1; k <= 10; k++) {
        const real w = 0.1 * k * end * HORIZON * CLOUD_SPACING;
        real force = 0;
        for (int64_t i = 0; i < p->n; i++) p->x[0][i] = p->X[0][i] + (i < p->n / 2 ? 0 : w);
        s.c.source.limit.last_force = LAST_FORCE_NONE;
        soft_forces(&s), soft_forces(&s);
        for (int64_t i = 0; i < p->n / 2; i++) force += p->f[0][i];
        assert_near(force / strength, square(1 - 0.1 * k), 1.0 / HORIZON);
    }
    particle_cloud_free(&s.c);
}

/* ---- compression ------------------------------------------------------------------------------------------------- */

/* Checks that no bond softens or breaks under uniaxial compression to twenty times the strength, although lateral bonds
 * are stretched beyond their end of softening. The same stretches without the pressure do break bonds. */
static void test_compression(void **state)
{
    (void)state;
    const enum space spaces[] = {SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    for (int k = 0; k < 3; k++)
        for (int pressed = 1; pressed >= 0; pressed--) {
            struct soft_body s = {0};
            particle_cloud_make(&s.c, &(struct cloud_plan){.space = spaces[k], .count = {9, 9, 9}, .horizon = 3.015});
            cloud_exact(&s.c);
            soft_bonds(&s, SOFTENING_LINEAR, ONSET, CRITICAL);
            const real nu = k == 1 ? 1.0 / 3 : s.c.material[0].poisson, axial = -20 * ONSET;
            for (int step = 1; step <= 10; step++) {
                const real part = 0.1 * step, lateral = -nu * axial * part;
                cloud_strain(
                    &s.c, (const real[DIM_MAX][DIM_MAX]){{pressed ? axial * part : 0}, {0, lateral}, {0, 0, lateral}});
                soft_forces(&s);
            }
            soft_forces(&s);
            assert_true(-nu * axial > 1.2 * square(CRITICAL) / ONSET);
            assert_true((bonds_fracture_energy(&s.c.bonds) > 0) == !pressed);
            particle_cloud_free(&s.c);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kinks),   cmocka_unit_test(test_cycles), cmocka_unit_test(test_work),
        cmocka_unit_test(test_at_once), cmocka_unit_test(test_lanes),  cmocka_unit_test(test_ends),
        cmocka_unit_test(test_family),  cmocka_unit_test(test_line),   cmocka_unit_test(test_compression)};
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
