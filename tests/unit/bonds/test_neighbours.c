/* Neighbour searches and stored bonds compared with tests of all pairs of particles. A row is the list of bonds of one
 * particle; eight rows form a row block, whose columns hold one bond of each row (SELL-C layout). */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>
#include <omp.h>

#include "tests/support/cloud.h"
#include "kernels/kernels.h"
#include "tests/support/reference.h"
#include "base/team.h"

/* ---- search ------------------------------------------------------------------------------------------------------ */

/* Checks that the cells c find those particles of p within `radius` of X [m], without the particle `skip`, that a test
 * of all particles finds, in ascending order. */
static void search_equals_all_pairs(const struct particles *p, const struct cells *c, const real *X, real radius,
                                    int32_t skip)
{
    int32_t found[1000], n = cells_list_particles_near_point(c, p, X, radius, skip, found, COUNT_OF(found)),
                         expected = 0;
    assert_in_range(n, 0, COUNT_OF(found));
    for (int32_t j = 0; j < p->n; j++) {
        real r2 = 0;
        for (int d = 0; d < p->dim; d++) r2 += square(p->X[d][j] - X[d]);
        if (r2 > radius * radius || j == skip) continue;
        assert_true(expected < n);
        assert_int_equal(found[expected++], j); /* ascending, without duplicates, complete */
    }
    assert_int_equal(n, expected);
    assert_int_equal(cells_list_particles_near_point(c, p, X, radius, skip, NULL, 0), expected);
}

static void searches(const struct cloud_plan *plan, real edge, bool outlier)
{
    struct particle_cloud c;
    struct cells cells;
    uint64_t seed = 7;
    particle_cloud_make(&c, plan);
    if (outlier) /* a mostly empty box must not need a cell for every spacing */
        for (int d = 0; d < c.p.dim; d++) c.p.X[d][c.p.n - 1] = 1e3 * CLOUD_SPACING;
    cells_make_for_neighbour_search(&cells, &c.p, edge);
    for (int32_t i = 0; i < c.p.n; i++) {
        real X[DIM_MAX];
        for (int d = 0; d < c.p.dim; d++) X[d] = c.p.X[d][i];
        search_equals_all_pairs(&c.p, &cells, X, edge, i);
        for (int d = 0; d < c.p.dim; d++) X[d] = cloud_between(&seed, -5, 12) * CLOUD_SPACING;
        search_equals_all_pairs(&c.p, &cells, X, cloud_random(&seed) * edge, -1);
    }
    cells_free(&cells);
    particle_cloud_free(&c);
}

static void test_search(void **state)
{
    (void)state;
    static const struct cloud_plan plan[] = {
        {.space = SPACE_LINE, .count = {40}, .horizon = 3},
        {.space = SPACE_LINE, .count = {40}, .horizon = 3, .shake = 0.3, .seed = 1},
        {.space = SPACE_PLANE_STRESS, .count = {9, 7}, .horizon = 3},
        {.space = SPACE_PLANE_STRESS, .count = {9, 7}, .horizon = 3, .shake = 0.3, .seed = 2},
        {.space = SPACE_SOLID, .count = {5, 6, 4}, .horizon = 3},
        {.space = SPACE_SOLID, .count = {5, 6, 4}, .horizon = 3, .shake = 0.3, .seed = 3},
    };
    for (size_t k = 0; k < COUNT_OF(plan); k++)
        for (int outlier = 0; outlier < 2; outlier++) {
            searches(&plan[k], 3.015 * CLOUD_SPACING, outlier);
            searches(&plan[k], 1.5 * CLOUD_SPACING, outlier);
            searches(&plan[k], 50 * CLOUD_SPACING, outlier);
        }
}

/* ---- rows -------------------------------------------------------------------------------------------------------- */

/* Properties of a case, as bits: both kinds of particles, two bodies, two materials, a crack. */
enum { MIXED = 1, BODIES = 2, MATERIALS = 4, CRACKED = 8 };

struct rows_case {
    struct cloud_plan plan;
    int what;
};

static const struct rows_case rows_case[] = {
    {{.space = SPACE_LINE, .count = {37}, .horizon = 3}, 0},
    {{.space = SPACE_LINE, .count = {37}, .horizon = 3, .volume = VOLUME_RAMP}, MIXED | CRACKED},
    {{.space = SPACE_LINE, .count = {37}, .horizon = 3, .shake = 0.2, .seed = 4}, MIXED | BODIES | MATERIALS},
    {{.space = SPACE_LINE, .count = {37}, .horizon = 3, .surface = SURFACE_VOLUME}, MIXED},
    {{.space = SPACE_PLANE_STRESS, .count = {13, 11}, .horizon = 3.015}, 0},
    {{.space = SPACE_PLANE_STRESS, .count = {13, 11}, .horizon = 3.015, .volume = VOLUME_RAMP}, MIXED | CRACKED},
    {{.space = SPACE_PLANE_STRAIN, .count = {13, 11}, .horizon = 3.015, .surface = SURFACE_VOLUME}, MIXED | MATERIALS},
    {{.space = SPACE_PLANE_STRESS, .count = {13, 11}, .horizon = 3.015, .shake = 0.3, .seed = 5}, CRACKED},
    {{.space = SPACE_PLANE_STRESS,
      .count = {13, 11},
      .horizon = 3.015,
      .shake = 0.3,
      .seed = 6,
      .volume = VOLUME_CUT_RAMP,
      .surface = SURFACE_VOLUME,
      .shells = SHELLS_ISOTROPIC},
     MIXED | BODIES | MATERIALS | CRACKED},
    {{.space = SPACE_SOLID, .count = {7, 6, 5}, .horizon = 2.015}, 0},
    {{.space = SPACE_SOLID, .count = {7, 6, 5}, .horizon = 2.015, .shells = SHELLS_ISOTROPIC}, MIXED | CRACKED},
    {{.space = SPACE_SOLID,
      .count = {7, 6, 5},
      .horizon = 2.015,
      .shake = 0.3,
      .seed = 7,
      .volume = VOLUME_RAMP,
      .surface = SURFACE_VOLUME},
     MIXED | BODIES | MATERIALS | CRACKED},
};

/* Cracks in general position: no bond passes exactly through an edge. Such cases are tested in test_ground.c. */
static real crack_corner[DIM_MAX + 1][4][DIM_MAX] = {
    {{0}},
    {{17.61e-3}},
    {{-1e-3, 5.13e-3}, {6.37e-3, 5.91e-3}},
    {{-1e-3, -1e-3, 2.17e-3}, {4.1e-3, -1e-3, 2.23e-3}, {4.1e-3, 3.9e-3, 2.71e-3}, {-1e-3, 3.9e-3, 2.65e-3}},
};
static const struct crack crack[DIM_MAX + 1] = {{.n = 0},
                                                {.n = 1, .corner = crack_corner[1]},
                                                {.n = 2, .corner = crack_corner[2]},
                                                {.n = 4, .corner = crack_corner[3]}};

static void case_make(struct particle_cloud *c, const struct rows_case *k)
{
    struct particles *p = NULL;
    uint64_t seed = 11;
    particle_cloud_make(c, &k->plan);
    p = &c->p;
    for (int64_t i = 0; i < p->n; i++) {
        real x = p->X[0][i] / CLOUD_SPACING / k->plan.count[0];
        if (k->what & MIXED) p->kind[i] = x > 0.4 && cloud_random(&seed) < 0.8 ? KIND_MPM : KIND_PD;
        if (k->what & BODIES) p->body[i] = x > 0.55;
        if (k->what & MATERIALS) p->material[i] = cloud_random(&seed) < 0.3;
    }
    for (int m = 0; m < CLOUD_MATERIALS * CLOUD_MATERIALS; m++) c->limit[m] = m == 0 ? 0.01 : m == 3 ? 0.03 : 0.02;
    if (k->what & CRACKED) {
        c->source.crack = &crack[p->dim];
        c->source.cracks = 1;
    }
    cloud_bonds(c);
}

static bool case_cut(const struct particle_cloud *c, int64_t i, int64_t j)
{
    real a[DIM_MAX], b[DIM_MAX];
    for (int d = 0; d < c->p.dim; d++) a[d] = c->p.X[d][i], b[d] = c->p.X[d][j];
    return c->source.cracks > 0 && reference_cut(c->source.crack, a, b, c->p.dim);
}

/* Returns true if the neighbourhood of particle i of c (particles within the cutoff) contains a peridynamic
 * particle. */
static bool touches_pd(const struct particle_cloud *c, int64_t i)
{
    for (int64_t j = 0; j < c->p.n; j++)
        if (c->p.kind[j] == KIND_PD && reference_bonded(&c->p, &c->source.family, i, j)) return true;
    return false;
}

static void check_bond(const struct particle_cloud *c, const real *w, const real *volume, int64_t i, int64_t j)
{
    const struct particles *p = &c->p;
    bool stored = !isnan(w[i * p->n + j]), row = c->bonds.row_of[i] >= 0;
    bool bonded = reference_bonded(p, &c->source.family, i, j) && (p->kind[i] == KIND_PD || p->kind[j] == KIND_PD);
    assert_int_equal(stored, row && bonded);
    if (!stored) return;
    if (case_cut(c, i, j)) {
        assert_true(w[i * p->n + j] == 0);
        return;
    }
    /* Tolerance: single precision rounds by at most 2^-24 = 6e-8; the engine rounds beta of ramps to 1e-9. */
    real expected = reference_weight(p, &c->source, volume, i, j),
         ramp = c->source.family.volume == VOLUME_WHOLE ? 0 : 2e-9;
    assert_true(fabs(w[i * p->n + j] - expected) <= 1e-7 * expected + ramp);
    if (c->bonds.row_of[j] >= 0) assert_memory_equal(&w[i * p->n + j], &w[j * p->n + i], sizeof(real));
}

/* Compares sums over the row of particle i of c with sums over all pairs: volume of its family, damage, and smallest
 * limit of its bonds. Tolerance 1e-6: volumes are in single precision, and sums have up to 100 terms. */
static void check_row(const struct particle_cloud *c, int64_t i)
{
    const struct particles *p = &c->p;
    int64_t row = c->bonds.row_of[i];
    real whole = 0, cut = 0, smallest = INFINITY;
    for (int64_t j = 0; j < p->n; j++) {
        if (!reference_bonded(p, &c->source.family, i, j)) continue;
        whole += p->volume0[j];
        if (case_cut(c, i, j)) cut += p->volume0[j];
        if (p->kind[i] == KIND_PD || p->kind[j] == KIND_PD)
            smallest = fmin(smallest, c->limit[p->material[i] * CLOUD_MATERIALS + p->material[j]]);
    }
    assert_true(fabs(c->bonds.family_volume[row] - whole) <= 1e-6 * whole);
    if (p->kind[i] == KIND_PD) assert_true(fabs(p->damage[i] - cut / whole) <= 1e-6);
    assert_true(c->bonds.trigger[row] <= smallest);
    assert_true(c->bonds.trigger[row] > 0.999 * smallest || c->bonds.trigger[row] == smallest); /* INFINITY: no bonds */
}

/* Checks all columns of the bonds of c: their flags agree with the eight bonds, no bond is twice in a row, lengths
 * agree with positions, and padding has no weight. */
static void check_columns(const struct particle_cloud *c)
{
    const struct bonds *b = &c->bonds;
    int64_t stored = 0;
    uint8_t *seen = NEW("test.seen", c->p.n * c->p.n, uint8_t);
    for (int64_t g = 0; g < b->row_blocks; g++)
        for (int64_t column = b->column[g]; column < b->column[g] + b->column_count[g]; column++)
            for (int l = 0; l < LANES; l++) {
                int64_t q = column * LANES + l, row = g * LANES + l;
                real xi[DIM_MAX];
                assert_in_range(b->nbr[q], 0, c->p.n_all + LANES - 1);
                if (b->first[column] >= 0) assert_int_equal(b->nbr[q], b->first[column] + l);
                if (b->aligned[g]) assert_int_equal(b->particle[row], b->particle[g * LANES] + l);
                if (b->inverse_length[q] == 0) assert_true(b->w[q] == 0);
                if (b->inverse_length[q] == 0) continue;
                assert_true(row < b->rows);
                assert_int_equal(seen[b->particle[row] * c->p.n + b->nbr[q]]++, 0);
                real r = reference_relative(c->p.X, c->p.dim, b->particle[row], b->nbr[q], xi);
                /* Tolerance: two roundings of root and division. Broken and cut bonds are marked by the sign. */
                assert_true(fabs(fabs(b->inverse_length[q]) * r - 1) <= 4e-16);
                assert_int_equal(b->inverse_length[q] < 0, b->w[q] == 0);
                stored++;
            }
    assert_int_equal(b->n, stored);
    memory_free(seen);
}

static void check_rows(const struct particle_cloud *c)
{
    const struct particles *p = &c->p;
    real *w = reference_table(&c->bonds, p), *volume = NULL;
    if (c->source.family.surface == SURFACE_VOLUME) {
        volume = NEW("test.volume", p->n, real);
        for (int64_t i = 0; i < p->n; i++) volume[i] = reference_neighbour_volume(p, &c->source.family, i);
        assert_true(cloud_difference(c->neighbour_volume, volume, p->n) <= 1e-9); /* the engine rounds beta to 1e-9 */
    }
    int64_t rows = 0;
    for (int64_t i = 0; i < p->n; i++) {
        bool wanted = false; /* eight consecutive particles form a block of eight rows */
        for (int64_t j = i / LANES * LANES; j < i / LANES * LANES + LANES && j < p->n; j++)
            wanted = wanted || p->kind[j] == KIND_PD || touches_pd(c, j);
        assert_int_equal(c->bonds.row_of[i] >= 0, wanted);
        if (wanted) {
            assert_int_equal(c->bonds.row_of[i], rows); /* rows are in the order of the particles */
            assert_int_equal(c->bonds.particle[rows++], i);
            check_row(c, i);
        }
        for (int64_t j = 0; j < p->n; j++) check_bond(c, w, volume, i, j);
    }
    assert_int_equal(c->bonds.rows, rows);
    for (int64_t r = rows; r < c->bonds.row_blocks * LANES; r++)
        assert_int_equal(c->bonds.particle[r], c->bonds.particle[rows - 1]);
    check_columns(c);
    memory_free(volume);
    memory_free(w);
}

static void test_rows(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(rows_case); k++) {
        struct particle_cloud c;
        case_make(&c, &rows_case[k]);
        /* The stiffness is c V V of two lattice particles, with c from the same lattice sum in another order of
         * terms. */
        real expected = reference_modulus(&c.source.family, &c.material[0]) * square(c.source.family.cell_volume);
        assert_true(fabs(c.bonds.stiffness / expected - 1) <= 1e-9); /* beta of the ramp is rounded to 1e-9 */
        check_rows(&c);
        particle_cloud_free(&c);
    }
}

/* Compares `columns` columns of the bonds b, from column `column` on, with those of the bonds `new` from column `of`
 * on. Weights may be 0 in b, for bonds broken by load. */
static void check_row_block_like_new(const struct bonds *b, int64_t column, const struct bonds *new, int64_t of,
                                     int64_t columns)
{
    assert_memory_equal(b->first + column, new->first + of, (size_t)columns * sizeof *b->first);
    assert_memory_equal(b->nbr + column * LANES, new->nbr + of *LANES, (size_t)(columns * LANES) * sizeof *b->nbr);
    for (int64_t k = 0; k < columns * LANES; k++) {
        const int64_t q = column * LANES + k, m = of * LANES + k;
        assert_true(fabs(b->inverse_length[q]) == fabs(new->inverse_length[m]));
        assert_true(b->w[q] == new->w[m] || b->w[q] == 0);
    }
}

/* Checks that the rows of c, rebuilt from the bonds `old`, agree with rows created from scratch, except for bonds
 * broken by load. Returns the number of row blocks that existed before and have as many bonds as before. */
static int64_t check_like_new(struct particle_cloud *c, const struct bonds *old)
{
    struct bonds *b = &c->bonds;
    struct bonds new;
    struct particles p = c->p;
    int64_t taken = 0;
    p.damage = NEW("test.damage", p.n_all, real); /* set when rows are created */
    bonds_make(&new, NULL, &p, &c->source);
    cloud_unfold(b), cloud_unfold(&new);
    assert_int_equal(b->columns, new.columns);
    assert_int_equal(b->n, new.n);
    assert_memory_equal(b->column_count, new.column_count, (size_t)b->row_blocks * sizeof *b->column_count);
    assert_memory_equal(b->made, new.made, (size_t)b->row_blocks * sizeof *b->made);
    assert_memory_equal(b->trigger, new.trigger, (size_t)b->rows * sizeof *b->trigger);
    assert_memory_equal(b->family_volume, new.family_volume, (size_t)b->rows * sizeof *b->family_volume);
    for (int64_t g = 0; g < b->row_blocks; g++) {
        check_row_block_like_new(b, b->column[g], &new, new.column[g], b->column_count[g]);
        const int32_t row = old->row_of[b->particle[g * LANES]];
        taken += row >= 0 && old->made[row / LANES] == b->made[g];
    }
    bonds_free(&new);
    memory_free(p.damage);
    return taken;
}

/* Checks rows that are rebuilt after material points have become peridynamic: they agree with new rows, but bonds
 * broken by load remain broken, and the fracture energy is unchanged. */
static void test_rows_inherit(void **state)
{
    (void)state;
    int64_t taken = 0;
    for (size_t k = 0; k < COUNT_OF(rows_case); k++) {
        struct particle_cloud c;
        if (!(rows_case[k].what & MIXED)) continue;
        case_make(&c, &rows_case[k]);
        struct particles *p = &c.p;
        for (int64_t i = 0; i < p->n; i++) p->x[0][i] = p->X[0][i] * (1 + 2 * p->X[0][i]); /* strain increases with x */
        assert_true(bond_force_table[p->dim][PD_BOND](&c.bonds, p, &c.source.limit, NULL) > 0);
        real *before = reference_table(&c.bonds, p), energy = bonds_fracture_energy(&c.bonds);
        for (int64_t i = 0; i < p->n; i++)
            if (p->X[0][i] < 8e-3) p->kind[i] = KIND_PD;
        particles_rebuild_lists_by_kind(p);
        struct bonds old = c.bonds;
        bonds_make(&c.bonds, &old, p, &c.source);
        real *after = reference_table(&c.bonds, p);
        check_columns(&c);
        taken += check_like_new(&c, &old);
        for (int64_t q = 0; q < p->n * p->n; q++) /* NAN: no bond; w = 0: broken or cut */
            if (!isnan(before[q])) assert_true(before[q] == after[q]);
        assert_true(fabs(bonds_fracture_energy(&c.bonds) - energy) <= 1e-14 * energy);
        for (int64_t i = 0; i < p->n; i++)
            if (old.row_of[i] >= 0) assert_int_equal(c.bonds.broken[c.bonds.row_of[i]], old.broken[old.row_of[i]]);
        memory_free(before);
        memory_free(after);
        bonds_free(&old);
        particle_cloud_free(&c);
    }
    assert_true(taken > 0);
}

/* Checks rows that are rebuilt repeatedly, each time with one more peridynamic column of the body: they agree with new
 * rows, mostly use free storage, and sometimes move to larger storage. */
static void test_rows_again(void **state)
{
    (void)state;
    static const struct cloud_plan plan[] = {
        {.space = SPACE_PLANE_STRESS, .count = {16, 40}, .horizon = 3.015, .surface = SURFACE_VOLUME},
        {.space = SPACE_PLANE_STRESS, .count = {16, 40}, .horizon = 2.015, .shake = 0.3, .seed = 9},
        {.space = SPACE_SOLID, .count = {8, 6, 20}, .horizon = 2.015}};
    for (size_t k = 0; k < COUNT_OF(plan); k++) {
        int moved = 0, stayed = 0;
        struct particle_cloud c;
        particle_cloud_make(&c, &plan[k]);
        const int last = c.p.dim - 1;
        for (int64_t i = 0; i < c.p.n; i++) c.p.kind[i] = c.p.X[last][i] < 2e-3 ? KIND_PD : KIND_MPM;
        particles_rebuild_lists_by_kind(&c.p);
        cloud_source(&c);
        c.source.yield = (struct bond_yield){NULL, NULL, 0}; /* bonds that may yield always move */
        bonds_make(&c.bonds, NULL, &c.p, &c.source);
        for (int column = 3; column <= plan[k].count[last]; column++) {
            struct bonds old = c.bonds;
            const real *was = old.w;
            for (int64_t i = 0; i < c.p.n; i++)
                if (c.p.X[last][i] < column * CLOUD_SPACING) c.p.kind[i] = KIND_PD;
            particles_rebuild_lists_by_kind(&c.p);
            bonds_make(&c.bonds, &old, &c.p, &c.source);
            moved += c.bonds.w != was, stayed += c.bonds.w == was;
            assert_true(c.bonds.used <= c.bonds.room && c.bonds.used >= c.bonds.columns);
            check_like_new(&c, &old); /* expands stencils */
            check_columns(&c);
            bonds_free(&old);
        }
        assert_true(moved > 1 && stayed > 1);
        particle_cloud_free(&c);
    }
}

/* Checks that rows made from the site map of a lattice are bitwise equal to those of the neighbour search. Bonds that
 * may yield are always made by the search, which is used for the comparison. */
static void test_rows_of_lattice(void **state)
{
    (void)state;
    static const struct cloud_plan plan[] = {
        {.space = SPACE_LINE, .count = {50}, .horizon = 3},
        {.space = SPACE_PLANE_STRESS, .count = {32, 9}, .horizon = 3.015},
        {.space = SPACE_PLANE_STRESS, .count = {29, 9}, .horizon = 3.015, .surface = SURFACE_VOLUME},
        {.space = SPACE_PLANE_STRESS,
         .count = {30, 12},
         .horizon = 3,
         .volume = VOLUME_RAMP,
         .shells = SHELLS_ISOTROPIC},
        {.space = SPACE_SOLID, .count = {16, 7, 8}, .horizon = 3.015, .surface = SURFACE_VOLUME},
        {.space = SPACE_SOLID, .count = {11, 6, 5}, .horizon = 2, .influence = INFLUENCE_GAUSSIAN},
    };
    for (size_t k = 0; k < 2 * COUNT_OF(plan); k++) {
        struct particle_cloud c;
        struct bonds searched;
        particle_cloud_make(&c, &plan[k % COUNT_OF(plan)]);
        if (k >= COUNT_OF(plan)) cloud_exact(&c); /* then most rows follow stencils, if there is one material */
        for (int64_t i = 0; i < c.p.n && k < COUNT_OF(plan); i++) c.p.material[i] = i % 3 == 0;
        for (int64_t i = 2 * c.p.n / 3; i < c.p.n && k % 2; i++) c.p.kind[i] = KIND_MPM;
        for (int m = 0; m < CLOUD_MATERIALS * CLOUD_MATERIALS; m++) c.limit[m] = 0.01 + 0.001 * m;
        cloud_bonds(&c);
        searched = c.bonds;
        assert_non_null(c.source.yield.stretch);
        c.source.yield = (struct bond_yield){NULL, NULL, 0};
        if (c.neighbour_volume) {
            real *volume = NEW("test.volume", c.p.n_all, real);
            bonds_compute_family_volumes(volume, &c.p, &c.source);
            assert_memory_equal(volume, c.neighbour_volume, (size_t)c.p.n * sizeof *volume);
            memory_free(volume);
        }
        bonds_make(&c.bonds, NULL, &c.p, &c.source);
        const real step = bonds_critical_time_step_of_existing_bonds(&c.bonds, &c.p);
        if (c.p.n_of[KIND_PD] == c.p.n)
            assert_true(step == bonds_critical_time_step_if_all_peridynamic(&c.p, &c.source));
        struct bond_source states = c.source; /* bonds between equal materials agree with states, others are stiffer */
        states.modulus = (const struct state_modulus[CLOUD_MATERIALS]){{0, 0}};
        const real of_states = bonds_critical_time_step_if_all_peridynamic(&c.p, &states),
                   of_bonds = bonds_critical_time_step_if_all_peridynamic(&c.p, &c.source);
        if (k >= COUNT_OF(plan))
            assert_true(fabs(of_states - of_bonds) <= 1e-12 * of_bonds);
        else
            assert_true(of_states < of_bonds);
        struct bonds *b = &c.bonds;
        cloud_unfold(b), cloud_unfold(&searched);
        const size_t columns = (size_t)b->columns, entries = columns * LANES, rows = (size_t)b->rows;
        assert_int_equal(b->columns, searched.columns);
        assert_int_equal(b->n, searched.n);
        assert_memory_equal(b->nbr, searched.nbr, entries * sizeof *b->nbr);
        assert_memory_equal(b->inverse_length, searched.inverse_length, entries * sizeof *b->inverse_length);
        assert_memory_equal(b->w, searched.w, entries * sizeof *b->w);
        assert_memory_equal(b->first, searched.first, columns * sizeof *b->first);
        assert_memory_equal(b->common, searched.common, columns * sizeof *b->common);
        assert_memory_equal(b->trigger, searched.trigger, rows * sizeof *b->trigger);
        assert_memory_equal(b->family_volume, searched.family_volume, rows * sizeof *b->family_volume);
        assert_memory_equal(b->broken_volume, searched.broken_volume, rows * sizeof *b->broken_volume);
        assert_memory_equal(b->aligned, searched.aligned, (size_t)b->row_blocks * sizeof *b->aligned);
        bonds_free(&searched);
        particle_cloud_free(&c);
    }
}

static void test_rows_threads(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(rows_case); k++) {
        struct particle_cloud c[2];
        for (int t = 0; t < 2; t++) {
            omp_set_num_threads(t + 1);
            case_make(&c[t], &rows_case[k]);
        }
        size_t entries = (size_t)c[0].bonds.columns * LANES;
        assert_int_equal(c[0].bonds.columns, c[1].bonds.columns);
        assert_memory_equal(c[0].bonds.nbr, c[1].bonds.nbr, entries * sizeof(int32_t));
        assert_memory_equal(c[0].bonds.w, c[1].bonds.w, entries * sizeof(real));
        assert_memory_equal(c[0].bonds.inverse_length, c[1].bonds.inverse_length, entries * sizeof(real));
        for (int t = 0; t < 2; t++) particle_cloud_free(&c[t]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_search),          cmocka_unit_test(test_rows),
        cmocka_unit_test(test_rows_inherit),    cmocka_unit_test(test_rows_again),
        cmocka_unit_test(test_rows_of_lattice), cmocka_unit_test(test_rows_threads),
    };
    threads_set_count_and_bind_to_cores(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
