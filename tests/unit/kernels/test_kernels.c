/* Tests every bond kernel in the tables against its reference implementation, and partial stresses against plain sums.
 * Transfer kernels are tested in test_transfers.c. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>
#include <omp.h>

#include "tests/support/cloud.h"
#include "tests/support/eigen.h"
#include "coupling/conversion.h"
#include "tests/support/reference.h"
#include "tests/support/same.h"
#include "tests/support/sets.h"
#include "base/team.h"

/* Tolerance relative to the largest entry. Sums of up to 200 terms with a few roundings of 1.1e-16, and stretches of
 * 1e-2, which lose two digits, give typically 2e-14; 1e-12 allows for any order of the terms. */
#define CLOSE 1e-12
/* Tolerance of sums of momenta: round-off of the sum of magnitudes. */
#define CONSERVED 1e-13

static const enum space space_of[DIM_MAX + 1] = {SPACE_LINE, SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
static const int count_of[DIM_MAX + 1][DIM_MAX] = {{0}, {45}, {12, 9}, {6, 5, 5}};

enum { REGULAR = 0, SHAKEN = 1, MIXED = 2, WAYS = 4 };

/* Creates c, a strained, irregular body of two materials in `dim` dimensions. way: flags of the case; SHAKEN: random
 * positions, MIXED: two of three particles are material points. */
static void body_make(struct particle_cloud *c, int dim, int way)
{
    struct cloud_plan plan = {.space = space_of[dim],
                              .horizon = dim == 3 ? 2.015 : 3.015,
                              .seed = 21 + (uint64_t)dim,
                              .shake = way & SHAKEN ? 0.3 : 0};
    uint64_t seed = 31;
    memcpy(plan.count, count_of[dim], sizeof plan.count);
    particle_cloud_make(c, &plan);
    struct particles *p = &c->p;
    for (int64_t i = 0; i < p->n; i++) {
        p->kind[i] = way & MIXED && cloud_random(&seed) < 0.67 ? KIND_MPM : KIND_PD;
        p->material[i] = cloud_random(&seed) < 0.3;
        p->flag[i] = cloud_random(&seed) < 0.2 ? FLAG_DRIVEN : 0;
        for (int d = 0; d < dim; d++) {
            p->x[d][i] = p->X[d][i] * (1.01 + 0.005 * d) + cloud_between(&seed, -0.02, 0.02) * CLOUD_SPACING;
            p->v[d][i] = cloud_between(&seed, -10, 10);
            p->f[d][i] = cloud_between(&seed, -1, 1);
        }
    }
    for (int m = 0; m < CLOUD_MATERIALS * CLOUD_MATERIALS; m++) c->limit[m] = m == 0 ? 0.02 : 0.025;
    cloud_bonds(c);
}

/* ---- force and breaking ------------------------------------------------------------------------------------------ */

/* Compares the forces of c with the reference implementation for the bond weights w. Forces on particles without bonds
 * must be unchanged from `before`. */
static void check_force(const struct particle_cloud *c, const struct particles *before, const real *w)
{
    const struct particles *p = &c->p;
    real *force = NEW("test.force", p->n, real), *got = NEW("test.got", p->n, real);
    for (int d = 0; d < p->dim; d++) {
        for (int64_t i = 0; i < p->n; i++) {
            bool row = c->bonds.row_of[i] >= 0;
            force[i] = row ? reference_row(p, w, c->bonds.stiffness, i).force[d] : 0;
            got[i] = row ? p->f[d][i] : 0;
            if (!row) assert_true(p->f[d][i] == before->f[d][i]);
        }
        assert_true(cloud_difference(got, force, p->n) <= CLOSE);
    }
    memory_free(force);
    memory_free(got);
}

/* Checks that a bond of row i of c is broken if and only if it is stretched beyond its limit, and checks the recorded
 * fracture energy of the row. w, after: weights of the bonds before and after the step (reference_table). Returns the
 * number of broken bonds. */
static int64_t check_breaking(const struct particle_cloud *c, const real *w, const real *after, int64_t i)
{
    const struct particles *p = &c->p;
    int64_t row = c->bonds.row_of[i], broken = 0;
    real volume = 0, energy = 0;
    bool cracked = false; /* by a bond without a driven particle */
    for (int64_t j = 0; j < p->n; j++) {
        if (isnan(w[i * p->n + j])) continue;
        struct reference_bond q = reference_bond(p, i, j);
        bool breaks = q.stretch > c->limit[p->material[i] * CLOUD_MATERIALS + p->material[j]];
        assert_true(after[i * p->n + j] == (breaks ? 0 : w[i * p->n + j]));
        if (!breaks) continue;
        broken++;
        cracked |= !(p->flag[i] & FLAG_DRIVEN) && !(p->flag[j] & FLAG_DRIVEN);
        volume += p->volume0[j];
        energy += 0.5 * 0.5 * c->bonds.stiffness * w[i * p->n + j] * square(q.stretch) * q.length;
    }
    assert_int_equal(c->bonds.broken[row], broken);
    assert_int_equal((p->flag[i] & FLAG_LOST_BOND) != 0, broken > 0);
    assert_int_equal((p->flag[i] & FLAG_CRACKED) != 0, cracked);
    assert_true(fabs(c->bonds.fracture_energy[row] - energy) <= CLOSE * energy);
    /* Volumes are in single precision: 6e-8 for each of up to ten additions. */
    if (p->kind[i] == KIND_PD) assert_true(fabs(p->damage[i] - volume / c->bonds.family_volume[row]) <= 1e-6);
    return broken;
}

/* Compares forces, energy, stress and breaking of the kernel `bond_force` with the reference implementation for a body
 * of `dim` dimensions with the flags `way`. In the first call a bond that breaks acts with half its force, which makes
 * breaking second order in time; in the second call it is absent. */
static void force_case(bond_force_fn *bond_force, int dim, int way)
{
    struct particle_cloud c;
    struct particles before;
    body_make(&c, dim, way);
    cloud_copy(&before, &c.p, 0);
    real *w = reference_table(&c.bonds, &c.p);
    int64_t directed = bond_force(&c.bonds, &c.p, &c.source.limit, NULL), expected = 0;
    real *after = reference_table(&c.bonds, &c.p), *acting = NEW("test.acting", c.p.n * c.p.n, real);
    for (int64_t q = 0; q < c.p.n * c.p.n; q++) acting[q] = 0.5 * (w[q] + after[q]);
    check_force(&c, &before, acting);
    for (int64_t i = 0; i < c.p.n; i++)
        if (c.bonds.row_of[i] >= 0) expected += check_breaking(&c, w, after, i);
    assert_true(expected > 0);
    assert_int_equal(directed, expected);
    for (int64_t i = 0; i < c.p.n; i++) /* both ends break a bond in the same call */
        for (int64_t j = 0; j < c.p.n; j++)
            if (!isnan(after[i * c.p.n + j]) && !isnan(after[j * c.p.n + i]))
                assert_true(after[i * c.p.n + j] == after[j * c.p.n + i]);
    assert_int_equal(bond_force(&c.bonds, &c.p, &c.source.limit, NULL), 0);
    check_force(&c, &before, after);
    memory_free(w);
    memory_free(after);
    memory_free(acting);
    particles_free(&before);
    particle_cloud_free(&c);
}

static void test_bond_force(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int model = PD_BOND; model <= PD_BOND_PLASTIC; model++)
            for (int way = 0; way < WAYS; way++) force_case(bond_force_table[dim][model], dim, way);
}

/* Checks that a bond stretched exactly to its limit stays intact and one slightly beyond breaks. Powers of two make the
 * stretch exact. */
static void test_equality_keeps(void **state)
{
    (void)state;
    for (int beyond = 0; beyond < 2; beyond++) {
        struct particle_cloud c;
        particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_LINE, .count = {2}, .horizon = 1});
        c.limit[0] = 0.25;
        for (int i = 0; i < 2; i++) c.p.X[0][i] = i * 0x1p-10, c.p.x[0][i] = i * 0x1p-10 * (1.25 + beyond * 1e-6);
        cloud_bonds(&c);
        assert_int_equal(bond_force_table[1][PD_BOND](&c.bonds, &c.p, &c.source.limit, NULL), 2 * beyond);
        particle_cloud_free(&c);
    }
}

/* Checks that the forces on a body and their moments add up to zero, to CONSERVED times the sum of magnitudes. */
static void test_bond_momentum(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int model = PD_BOND; model <= PD_BOND_PLASTIC; model++)
            for (int way = 0; way < WAYS; way++) {
                struct particle_cloud c;
                real sum = 0, size = 0, moment = 0, moments = 0;
                body_make(&c, dim, way);
                struct particles *p = &c.p;
                for (int d = 0; d < dim; d++) memset(p->f[d], 0, (size_t)p->n * sizeof(real));
                bond_force_table[dim][model](&c.bonds, p, &c.source.limit, NULL);
                for (int d = 0; d < dim; d++)
                    for (int64_t i = 0; i < p->n; i++) sum += p->f[d][i], size += fabs(p->f[d][i]);
                for (int64_t i = 0; i < p->n && dim > 1; i++) {
                    moment += p->x[0][i] * p->f[1][i] - p->x[1][i] * p->f[0][i];
                    moments += fabs(p->x[0][i] * p->f[1][i]) + fabs(p->x[1][i] * p->f[0][i]);
                }
                assert_true(fabs(sum) <= CONSERVED * size && fabs(moment) <= CONSERVED * moments);
                particle_cloud_free(&c);
            }
}

/* ---- row blocks with common data --------------------------------------------------------------------------------- */

/* Creates c, a displaced lattice of one material in `dim` dimensions. Some bonds are beyond their limit; the weight of
 * one is halved. state: true for a state-based model. */
static void lattice_site_map_make_if_particles_fit_lattice(struct particle_cloud *c, int dim, bool state)
{
    uint64_t seed = 5;
    particle_cloud_make(c, &(struct cloud_plan){.space = space_of[dim],
                                                .count = {17, 11, 9},
                                                .horizon = dim == 3 ? 2.015 : 3.015,
                                                .surface = SURFACE_VOLUME});
    static struct state_modulus modulus;
    modulus = state_based_moduli_of_material(&c->material[0], space_of[dim], true);
    if (state) c->source.modulus = &modulus, c->source.rotates = true, c->source.local = true;
    for (int m = 0; m < CLOUD_MATERIALS * CLOUD_MATERIALS; m++) c->limit[m] = 0.02;
    cloud_bonds(c);
    for (int d = 0; d < dim; d++)
        for (int64_t i = 0; i < c->p.n; i++)
            c->p.x[d][i] = c->p.X[d][i] + cloud_between(&seed, -0.02, 0.02) * CLOUD_SPACING;
    struct bonds *b = &c->bonds;
    const int64_t row = b->row_of[c->p.n / 2],
                  q = bond_copy_on_write_and_return_array_index(b, row / LANES, 2, (int)(row % LANES));
    bond_fade(&c->bonds, &c->p, row, q, 0.5f * b->w[q]);
}

/* Computes the forces on c with the kernel `force` three times: as stored, with the flag `alike` cleared in all columns
 * of row blocks (one bond of each of eight particles), and with the lattice shell cleared as well. Returns the forces
 * [3][dim n], to be freed. kinds[3]: receive which kinds of columns exist. */
static real *forces_by_kind(struct particle_cloud *c, bond_force_fn *force, bool kinds[3])
{
    const int64_t all = c->p.dim * c->p.n;
    real *f = NEW("test.forces", 3 * all, real);
    assert_true(force(&c->bonds, &c->p, &c->source.limit, NULL) > 0);
    for (int64_t column = 0; column < c->bonds.columns; column++)
        kinds[c->bonds.common[column].alike ? 2 : c->bonds.common[column].shell ? 1 : 0] = true;
    for (int pass = 0; pass < 3; pass++) {
        for (int64_t column = 0; column < c->bonds.columns && pass > 0; column++) {
            c->bonds.common[column].alike = 0;
            if (pass == 2) c->bonds.common[column].shell = 0;
        }
        assert_int_equal(force(&c->bonds, &c->p, &c->source.limit, NULL), 0);
        for (int d = 0; d < c->p.dim; d++)
            memcpy(f + pass * all + d * c->p.n, c->p.f[d], (size_t)c->p.n * sizeof(real));
    }
    return f;
}

/* Checks that the forces of all kinds of columns are bitwise equal. Only state-based models without the lattice lengths
 * may differ, by the round-off of positions of 17 spacings summed over a neighbourhood, within CLOSE. */
static void test_column_kinds(void **unused)
{
    (void)unused;
    bool kinds[3] = {false};
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int model = PD_BOND; model <= PD_MOSPD; model++) {
            const bool state = model >= PD_OSPD;
            struct particle_cloud c;
            if (model == PD_BOND_PLASTIC || (dim == 1 && state)) continue;
            lattice_site_map_make_if_particles_fit_lattice(&c, dim, state);
            const size_t bytes = (size_t)(dim * c.p.n) * sizeof(real);
            real *f = forces_by_kind(&c, state ? state_force_table[dim][model] : bond_force_table[dim][model], kinds);
            assert_memory_equal(f, f + dim * c.p.n, bytes);
            if (state)
                assert_true(cloud_difference(f, f + 2 * dim * c.p.n, dim * c.p.n) <= CLOSE);
            else
                assert_memory_equal(f, f + 2 * dim * c.p.n, bytes);
            memory_free(f);
            particle_cloud_free(&c);
        }
    assert_true(kinds[0] && kinds[1] && kinds[2]);
}

/* ---- energy and stress ------------------------------------------------------------------------------------------- */

/* Compares the energy of bonds with the reference implementation, for all models, dimensions and kinds of bodies. */
static void test_bond_energy(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int model = PD_BOND; model <= PD_BOND_PLASTIC; model++)
            for (int way = 0; way < WAYS; way++) {
                struct particle_cloud c;
                real expected = 0;
                body_make(&c, dim, way);
                real *w = reference_table(&c.bonds, &c.p);
                for (int64_t i = 0; i < c.p.n; i++) expected += reference_row(&c.p, w, c.bonds.stiffness, i).energy;
                real energy = bond_energy_table[dim][model](&c.bonds, &c.p, NULL);
                assert_true(expected > 0 && fabs(energy - expected) <= CLOSE * expected);
                memory_free(w);
                particle_cloud_free(&c);
            }
}

static void test_bond_stress(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int model = PD_BOND; model <= PD_BOND_PLASTIC; model++)
            for (int way = 0; way < WAYS; way++) {
                struct particle_cloud c;
                body_make(&c, dim, way);
                real *w = reference_table(&c.bonds, &c.p), *stress = NEW("test.stress", c.p.n, real);
                for (int s = 0; s < symmetric_tensor_component_count(dim); s++) /* material points keep their own */
                    for (int64_t i = 0; i < c.p.n; i++) c.p.stress[s][i] = 1e6 * (real)(i + s);
                bond_stress_table[dim][model](&c.bonds, &c.p);
                for (int a = 0; a < dim; a++)
                    for (int b = a; b < dim; b++) {
                        int s = reference_symmetric(dim, a, b);
                        for (int64_t i = 0; i < c.p.n; i++)
                            stress[i] = c.p.kind[i] == KIND_PD
                                            ? reference_row(&c.p, w, c.bonds.stiffness, i).stress[a][b]
                                            : 1e6 * (real)(i + s);
                        assert_true(cloud_difference(c.p.stress[s], stress, c.p.n) <= CLOSE);
                    }
                memory_free(stress);
                memory_free(w);
                particle_cloud_free(&c);
            }
}

/* ---- motion ------------------------------------------------------------------------------------------------------ */

/* Compares positions and velocities after a step with a plain leap-frog step in all dimensions and kinds of bodies,
 * within two roundings of each. */
static void test_pd_move(void **state)
{
    (void)state;
    const real dt = 3e-8, dt_velocity = 1.5e-8;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int way = 0; way < WAYS; way++) {
            struct particle_cloud c;
            struct particles old;
            body_make(&c, dim, way);
            cloud_copy(&old, &c.p, 0);
            const struct pd_motion motion = {dt, dt_velocity, INFINITY, NULL, false};
            assert_false(pd_move_table[dim](&c.p, c.p.list[KIND_PD], c.p.n_of[KIND_PD], &motion));
            for (int d = 0; d < dim; d++) {
                for (int64_t i = 0; i < old.n; i++) {
                    if (old.kind[i] != KIND_PD) continue;
                    old.v[d][i] += dt_velocity * old.f[d][i] / old.mass[i];
                    old.x[d][i] += dt * old.v[d][i];
                }
                /* Two roundings of each. */
                assert_true(cloud_difference(c.p.v[d], old.v[d], old.n) <= 1e-15);
                assert_true(cloud_difference(c.p.x[d], old.x[d], old.n) <= 1e-15);
            }
            particles_free(&old);
            particle_cloud_free(&c);
        }
}

/* ---- threads ----------------------------------------------------------------------------------------------------- */

/* Checks that energy, forces, stresses and motion on one thread and on two are bitwise equal. */
static void test_bond_threads(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int model = PD_BOND; model <= PD_BOND_PLASTIC; model++)
            for (int way = 0; way < WAYS; way++) {
                struct particle_cloud c[2];
                real energy[2];
                for (int t = 0; t < 2; t++) {
                    omp_set_num_threads(t + 1);
                    body_make(&c[t], dim, way);
                    energy[t] = bond_energy_table[dim][model](&c[t].bonds, &c[t].p, NULL);
                    bond_force_table[dim][model](&c[t].bonds, &c[t].p, &c[t].source.limit, NULL);
                    bond_stress_table[dim][model](&c[t].bonds, &c[t].p);
                    pd_move_table[dim](&c[t].p, c[t].p.list[KIND_PD], c[t].p.n_of[KIND_PD],
                                       &(struct pd_motion){1e-8, 1e-8, INFINITY, NULL, false});
                }
                assert_memory_equal(&energy[0], &energy[1], sizeof(real));
                assert_same_particles(&c[0].p, &c[1].p, 0);
                for (int t = 0; t < 2; t++) particle_cloud_free(&c[t]);
            }
}

/* ---- partial stress ---------------------------------------------------------------------------------------------- */

/* Returns the smallest eigenvalue of (1 - M) C, the stiffness that is left to a point of material m [Pa]. M[n][n]:
 * matrix of the partial stress over the n symmetric components. */
static real least_kept(const struct material *m, int dim, const real *M)
{
    const int n = symmetric_tensor_component_count(dim);
    real kept[SYM_MAX * SYM_MAX], value[SYM_MAX], scratch[SYM_MAX], least = INFINITY;
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            kept[a * n + b] = 0;
            for (int k = 0; k < n; k++) {
                const real C = k < dim && b < dim ? (k == b ? m->c11 : m->c12) : k == b ? 2 * m->shear : 0;
                kept[a * n + b] += ((a == k) - M[a * n + k]) * C * (a < dim ? 1 : M_SQRT2) / (b < dim ? 1 : M_SQRT2);
            }
        }
    eigen_symmetric(kept, n, value, scratch);
    for (int a = 0; a < n; a++) least = fmin(least, value[a]);
    return least;
}

/* Compares the matrix M of point q of c in `partial` with the reference, T : C^-1 sigma for unit stresses. w: weights
 * of the bonds (reference_table). Returns false if the bonds alone would carry more than the whole stress. */
static bool check_partial(const struct particle_cloud *c, const struct partial_stress *partial, const real *w,
                          int64_t q)
{
    const struct particles *p = &c->p;
    const int n = symmetric_tensor_component_count(p->dim);
    real T[DIM_MAX][DIM_MAX][DIM_MAX][DIM_MAX], expected[SYM_MAX * SYM_MAX], got[SYM_MAX * SYM_MAX] = {0}, largest = 0;
    reference_partial(p, w, c->bonds.stiffness, c->source.family.section, q, T);
    for (int b = 0; b < n; b++) {
        real sigma[SYM_MAX] = {0}, grid_coupled[SYM_MAX];
        sigma[b] = 1;
        reference_carried(&c->material[p->material[q]], p->dim, T, sigma, grid_coupled);
        for (int a = 0; a < n; a++) {
            expected[a * n + b] = p->kind[q] == KIND_MPM ? grid_coupled[a] : 0;
            largest = fmax(largest, fabs(expected[a * n + b]));
            if (partial->index[q] >= 0) got[a * n + b] = partial->matrix[(partial->index[q] * n + a) * n + b];
        }
    }
    assert_int_equal(partial->index[q] >= 0, largest > 0);
    const struct material *m = &c->material[p->material[q]];
    if (least_kept(m, p->dim, expected) < 0) { /* bonds would carry more than the stress: limited to the whole */
        assert_true(least_kept(m, p->dim, got) >= -CLOSE * m->c11);
        return false;
    }
    /* The length inside the cell of a bond that only touches its corner has an absolute error of 1e-16. */
    for (int k = 0; k < n * n; k++) assert_true(fabs(got[k] - expected[k]) <= CLOSE * fmax(largest, 1e-3));
    return true;
}

static void check_partials(const struct particle_cloud *c, const struct partial_stress *partial, int whole[2])
{
    real *w = reference_table(&c->bonds, &c->p);
    for (int64_t q = 0; q < c->p.n; q++) whole[check_partial(c, partial, w, q)]++;
    memory_free(w);
}

/* Compares partial stresses (the stress of points that bonds carry) with the reference, computed for all points at once
 * and updated after more particles have become peridynamic. */
static void test_partial_stress(void **state)
{
    (void)state;
    int whole[2] = {0}; /* numbers of points whose bonds would carry more than the whole stress, and of others */
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int way = 0; way < WAYS; way++) {
            struct particle_cloud c;
            struct partial_stress partial = {0};
            body_make(&c, dim, way | MIXED);
            for (int64_t i = 0; i < c.p.n; i++) c.p.kind[i] = c.p.X[0][i] < 2.2e-3 ? KIND_PD : KIND_MPM;
            particles_rebuild_lists_by_kind(&c.p);
            bonds_free(&c.bonds);
            bonds_make(&c.bonds, NULL, &c.p, &c.source);
            if (way & MIXED) /* broken bonds carry nothing */
                bond_force_table[dim][PD_BOND](&c.bonds, &c.p, &c.source.limit, NULL);
            partial_stress_compute_from_bonds(&partial, &c.p, &c.bonds, &c.source, NULL, 0);
            check_partials(&c, &partial, whole);

            int32_t changed[] = {(int32_t)c.p.n - 2, (int32_t)c.p.n - 1};
            struct bonds old = c.bonds;
            for (size_t k = 0; k < COUNT_OF(changed); k++) c.p.kind[changed[k]] = KIND_PD;
            particles_rebuild_lists_by_kind(&c.p);
            bonds_make(&c.bonds, &old, &c.p, &c.source);
            bonds_free(&old);
            partial_stress_compute_from_bonds(&partial, &c.p, &c.bonds, &c.source, changed, COUNT_OF(changed));
            check_partials(&c, &partial, whole);
            partial_stress_free(&partial);
            particle_cloud_free(&c);
        }
    assert_true(whole[false] > 10 && whole[true] > 100);
}

/* Compares partial stresses with the reference for a single peridynamic particle at a corner, whose neighbourhood is an
 * eighth of a complete one. */
static void test_partial_stress_corner(void **state)
{
    (void)state;
    struct particle_cloud c;
    struct partial_stress partial = {0};
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_SOLID, .count = {8, 8, 8}, .horizon = 3.015});
    for (int64_t i = 1; i < c.p.n; i++) c.p.kind[i] = KIND_MPM;
    cloud_bonds(&c);
    int whole[2] = {0};
    partial_stress_compute_from_bonds(&partial, &c.p, &c.bonds, &c.source, NULL, 0);
    check_partials(&c, &partial, whole);
    assert_int_equal(whole[false], 0);
    partial_stress_free(&partial);
    particle_cloud_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bond_force),     cmocka_unit_test(test_equality_keeps),
        cmocka_unit_test(test_bond_momentum),  cmocka_unit_test(test_column_kinds),
        cmocka_unit_test(test_bond_energy),    cmocka_unit_test(test_bond_stress),
        cmocka_unit_test(test_pd_move),        cmocka_unit_test(test_bond_threads),
        cmocka_unit_test(test_partial_stress), cmocka_unit_test(test_partial_stress_corner),
    };
    threads_set_count_and_bind_to_cores(2);
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
