/* Row blocks (the bonds of eight particles) that follow a stencil, i.e. share one list of bonds instead of storing
 * their own: which blocks do, the bonds that a stencil implies, and their rebuilding. Results of every kernel must be
 * bitwise equal to those of explicitly stored bonds. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>

#include "tests/support/cloud.h"
#include "kernels/kernels.h"

/* Creates the body c on a lattice with exact positions, as src/scene/fill.c does, and its bonds. surface: rule of the
 * weights near faces; modulus: constants of a state-based model, NULL for bond-based. */
static void exact_cloud(struct particle_cloud *c, int dim, enum surface_rule surface,
                        const struct state_modulus *modulus)
{
    static const enum space space[DIM_MAX + 1] = {SPACE_LINE, SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
    particle_cloud_make(
        c, &(struct cloud_plan){.space = space[dim], .count = {32, 14, 11}, .horizon = 3.015, .surface = surface});
    cloud_exact(c);
    c->source.modulus = modulus, c->source.rotates = true, c->source.local = true;
    for (int k = 0; k < CLOUD_MATERIALS * CLOUD_MATERIALS; k++) c->limit[k] = 0.02;
    cloud_source(c);
    c->source.yield.stretch = NULL;
    bonds_make(&c->bonds, NULL, &c->p, &c->source);
}

static void shake(struct particle_cloud *c, real most)
{
    uint64_t seed = 7;
    for (int64_t i = 0; i < c->p.n; i++)
        for (int d = 0; d < c->p.dim; d++)
            c->p.x[d][i] = c->p.X[d][i] + cloud_between(&seed, -most, most) * CLOUD_SPACING;
}

static void follow_nothing(struct bonds *b)
{
    cloud_unfold(b);
    for (int64_t g = 0; g < b->row_blocks; g++) b->stencil[g] = NULL;
}

static int64_t count_folded(const struct bonds *b)
{
    int64_t n = 0;
    for (int64_t g = 0; g < b->row_blocks; g++) n += b->implicit[g];
    return n;
}

static real apart(const struct particles *p, int64_t i, int64_t j)
{
    real r2 = 0;
    for (int d = 0; d < p->dim; d++) r2 += square(p->X[d][j] - p->X[d][i]);
    return sqrt(r2);
}

/* Returns true if row block `row_block` (the bonds of eight particles) is within a cutoff of the first or last particle
 * of the body c. Eight consecutive neighbours may then begin before the first or end after the last particle, so that
 * such blocks store their bonds. */
static bool at_an_end(const struct particle_cloud *c, int64_t row_block)
{
    return fmin(apart(&c->p, 0, row_block * LANES), apart(&c->p, c->p.n - 1, row_block * LANES + 7)) <
           c->source.family.cutoff;
}

/* Checks which row blocks follow a stencil: lines of 32 particles are four blocks each; all follow one unless they are
 * at an end of the body, and the half of them in the middle of the lines follow a whole one. */
static void test_who_follows(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int surface = SURFACE_NONE; surface <= SURFACE_VOLUME; surface++) {
            struct particle_cloud c;
            int64_t whole = 0;
            exact_cloud(&c, dim, surface, NULL);
            for (int64_t g = 0; g < c.bonds.row_blocks; g++) {
                const struct stencil *stencil = c.bonds.stencil[g];
                assert_true(stencil || at_an_end(&c, g));
                whole += stencil && stencil->whole;
            }
            if (surface == SURFACE_NONE) assert_int_equal(whole, c.bonds.row_blocks / 2);
            assert_true(whole > 0 && (dim == 1 || count_folded(&c.bonds) > whole));
            particle_cloud_free(&c);
        }
}

/* Checks that reading the rows yields the bonds that a test of all pairs of particles finds, and that row blocks that
 * follow a stencil still do so afterwards. */
static void test_what_is_stored(void **state)
{
    (void)state;
    struct particle_cloud c;
    exact_cloud(&c, 2, SURFACE_NONE, NULL);
    const struct particles *p = &c.p;
    const struct bonds *b = &c.bonds;
    const int64_t implicit = count_folded(b);
    assert_true(implicit > 0);
    for (int64_t row = 0; row < b->rows; row++) {
        struct bond_iterator it = bond_iterator_of_row(b, row);
        for (int64_t j = 0; j < p->n; j++) {
            const int32_t i = b->particle[row];
            const real r = apart(p, i, j);
            if (j == i || r > c.source.family.cutoff) continue;
            assert_true(bond_iterator_advance(&it));
            assert_int_equal(it.bond.nbr, j);
            assert_true(fabs(it.bond.inverse_length * r - 1) < 1e-15);
            assert_true(it.bond.w == 1);
        }
        assert_false(bond_iterator_advance(&it));
    }
    assert_int_equal(count_folded(b), implicit);
    cloud_unfold(&c.bonds);
    assert_int_equal(count_folded(b), 0);
    particle_cloud_free(&c);
}

static void make_again(struct particle_cloud *c)
{
    bonds_free(&c->bonds);
    if (c->neighbour_volume) bonds_compute_family_volumes(c->neighbour_volume, &c->p, &c->source);
    bonds_make(&c->bonds, NULL, &c->p, &c->source);
}

/* Checks that row blocks whose data are copied from blocks with equal surroundings agree with blocks whose data are
 * computed each: bonds, triggers, volumes of neighbours and the critical step. A heavier corner particle, which affects
 * none of these data, prevents copying. */
static void test_twins(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int surface = SURFACE_NONE; surface <= SURFACE_VOLUME; surface++) {
            struct particle_cloud alike, alone;
            exact_cloud(&alike, dim, surface, NULL), exact_cloud(&alone, dim, surface, NULL);
            alone.p.mass[0] *= 2;
            make_again(&alike), make_again(&alone);
            const struct bonds *a = &alike.bonds, *b = &alone.bonds;
            assert_true(bonds_critical_time_step_if_all_peridynamic(&alike.p, &alike.source) ==
                        bonds_critical_time_step_if_all_peridynamic(&alone.p, &alone.source));
            if (surface)
                assert_memory_equal(alike.neighbour_volume, alone.neighbour_volume, (size_t)alone.p.n * sizeof(real));
            assert_memory_equal(a->trigger, b->trigger, (size_t)b->rows * sizeof *b->trigger);
            assert_memory_equal(a->family_volume, b->family_volume, (size_t)b->rows * sizeof *b->family_volume);
            assert_true(count_folded(a) == count_folded(b) && a->n == b->n && a->columns == b->columns);
            cloud_unfold(&alike.bonds), cloud_unfold(&alone.bonds);
            assert_memory_equal(a->nbr, b->nbr, (size_t)(b->columns * LANES) * sizeof *b->nbr);
            assert_memory_equal(a->inverse_length, b->inverse_length, (size_t)(b->columns * LANES) * sizeof(real));
            assert_memory_equal(a->w, b->w, (size_t)(b->columns * LANES) * sizeof(real));
            particle_cloud_free(&alike), particle_cloud_free(&alone);
        }
}

/* Results of the force, energy and stress kernels for the current positions, one after another. */
struct made {
    real *value;
    int64_t n;
};

static void made_add(struct made *m, const real *from, int64_t n)
{
    memcpy(m->value + m->n, from, (size_t)n * sizeof *from);
    m->n += n;
}

static struct made make_all(struct particle_cloud *c, enum pd_model model)
{
    struct kernels k;
    struct made m = {NEW("test.made", 2 * (DIM_MAX + SYM_MAX) * c->p.n + 4, real), 0};
    kernels_choose(&k, c->p.dim, model, SHAPE_LINEAR, TRANSFER_FLIP);
    for (int rotation = 0; rotation < 2; rotation++) { /* in the first some break */
        const real broken = (real)k.bond_force(&c->bonds, &c->p, &c->source.limit, NULL);
        const real energy = k.bond_energy(&c->bonds, &c->p, NULL);
        k.bond_stress(&c->bonds, &c->p);
        made_add(&m, &broken, 1);
        made_add(&m, &energy, 1);
        for (int d = 0; d < c->p.dim; d++) made_add(&m, c->p.f[d], c->p.n);
        for (int s = 0; s < symmetric_tensor_component_count(c->p.dim); s++) made_add(&m, c->p.stress[s], c->p.n);
    }
    return m;
}

/* Returns the number of row blocks of b whose stencil stores no weights, since all of them are 1. */
static int64_t count_units(const struct bonds *b)
{
    int64_t units = 0;
    for (int64_t g = 0; g < b->row_blocks; g++) units += b->stencil[g] && b->stencil[g]->unit;
    return units;
}

/* Checks that force, energy and stress kernels have bitwise equal results for rows that follow stencils and for stored
 * rows, also when some bonds have broken. */
static void test_same_bits(void **state)
{
    (void)state;
    static const enum pd_model models[] = {PD_BOND, PD_BOND, PD_OSPD, PD_MOSPD};
    const struct state_modulus modulus[CLOUD_MATERIALS] = {{3e11, 4e11}, {3e11, 4e11}};
    for (int dim = 2; dim <= DIM_MAX; dim++)
        for (size_t k = 0; k < COUNT_OF(models); k++) {
            struct particle_cloud implicit, open;
            const bool weighed = k == 0, states = models[k] != PD_BOND;
            exact_cloud(&implicit, dim, weighed ? SURFACE_VOLUME : SURFACE_NONE, states ? modulus : NULL);
            exact_cloud(&open, dim, weighed ? SURFACE_VOLUME : SURFACE_NONE, states ? modulus : NULL);
            follow_nothing(&open.bonds);
            const real most = dim == 2 ? 0.013 : 0.0104; /* some blocks of eight rows stay complete */
            shake(&implicit, most), shake(&open, most);
            struct made a = make_all(&implicit, models[k]), b = make_all(&open, models[k]);
            assert_true(a.value[0] > 0);                    /* some bonds have broken, */
            assert_true(count_folded(&implicit.bonds) > 0); /* and some blocks of eight rows still follow a stencil */
            assert_true(weighed || count_units(&implicit.bonds) > 0);
            assert_null(bonds_describe_first_inconsistency(&implicit.bonds)),
                assert_null(bonds_describe_first_inconsistency(&open.bonds));
            assert_int_equal(a.n, b.n);
            assert_memory_equal(a.value, b.value, (size_t)a.n * sizeof *a.value);
            memory_free(a.value), memory_free(b.value);
            particle_cloud_free(&implicit), particle_cloud_free(&open);
        }
}

/* Checks that bonds_describe_first_inconsistency detects a violation of each invariant of bond_storage.h. */
static void test_fault(void **state)
{
    (void)state;
    struct particle_cloud c;
    exact_cloud(&c, 2, SURFACE_NONE, NULL);
    struct bonds *b = &c.bonds;
    assert_null(bonds_describe_first_inconsistency(b));
    const int64_t q = bond_copy_on_write_and_return_array_index(b, b->row_blocks / 2, 3, 4), column = q / LANES;
    assert_null(bonds_describe_first_inconsistency(b)); /* stored explicitly, it still follows its stencil */
    bond_fade(b, &c.p, b->row_blocks / 2 * LANES + 4, q, 0.5);
    assert_null(bonds_describe_first_inconsistency(b));
    b->inverse_length[q] *= -1;
    assert_string_equal(bonds_describe_first_inconsistency(b),
                        "a bond with a weight other than 0, thus intact, has no length");
    b->inverse_length[q] *= -1;
    b->common[column].intact ^= 1;
    assert_string_equal(bonds_describe_first_inconsistency(b),
                        "a bond is marked as intact but has weight 0, or is not marked and has another weight");
    b->common[column].intact ^= 1;
    b->nbr[q]++;
    assert_string_equal(bonds_describe_first_inconsistency(b), "neighbours are not consecutive");
    b->nbr[q]--;
    b->common[column].first++;
    assert_string_equal(bonds_describe_first_inconsistency(b),
                        "the first neighbour of a column of eight bonds differs from the value stored for the column");
    b->common[column].first--;
    b->reach = 0;
    assert_string_equal(bonds_describe_first_inconsistency(b),
                        "a bond joins rows that are more blocks of eight rows apart than allowed");
    b->row_of[b->particle[9]] = 3;
    assert_string_equal(bonds_describe_first_inconsistency(b), "row_of is not the inverse of `particle`");
    particle_cloud_free(&c);
}

/* Checks that a bond whose weight changes makes its row block store its bonds explicitly, and no other block. */
static void test_who_leaves(void **state)
{
    (void)state;
    struct particle_cloud c;
    exact_cloud(&c, 2, SURFACE_NONE, NULL);
    const int64_t implicit = count_folded(&c.bonds), row_block = c.bonds.row_blocks / 2,
                  q = bond_copy_on_write_and_return_array_index(&c.bonds, row_block, 3, 4);
    bond_fade(&c.bonds, &c.p, row_block * LANES + 4, q, 0);
    for (int64_t g = 0; g < c.bonds.row_blocks; g++)
        assert_true(c.bonds.stencil[g] ? g != row_block : g == row_block || at_an_end(&c, g));
    assert_int_equal(count_folded(&c.bonds), implicit - 1);
    particle_cloud_free(&c);
}

/* Checks that a row block with a changed weight, which no stencil has, remains explicit when the rows around it are
 * rebuilt. */
static void test_who_stays_out(void **state)
{
    (void)state;
    struct particle_cloud c;
    exact_cloud(&c, 2, SURFACE_NONE, NULL);
    bonds_free(&c.bonds);
    const int32_t point = (int32_t)c.p.n / 2 + 3;
    c.p.kind[point] = KIND_MPM;
    particles_rebuild_lists_by_kind(&c.p);
    bonds_make(&c.bonds, NULL, &c.p, &c.source);
    const int64_t row = c.bonds.row_of[point] + 1,
                  q = bond_copy_on_write_and_return_array_index(&c.bonds, row / LANES, 5, (int)(row % LANES));
    const int32_t j = c.bonds.nbr[q];
    bond_fade(&c.bonds, &c.p, row, q, 0.5);
    c.p.kind[point] = KIND_PD;
    struct bonds old = c.bonds;
    particles_rebuild_lists_by_kind(&c.p);
    bonds_make(&c.bonds, &old, &c.p, &c.source);
    bonds_free(&old);
    int found = 0;
    for (int64_t k = 0; k < c.bonds.column_count[row / LANES]; k++) {
        const int64_t at = bond_copy_on_write_and_return_array_index(&c.bonds, row / LANES, k, (int)(row % LANES));
        if (c.bonds.nbr[at] == j && c.bonds.w[at] == 0.5) found++;
    }
    assert_int_equal(found, 1);
    assert_true(c.bonds.changed[row / LANES]);
    assert_null(c.bonds.stencil[row / LANES]);
    particle_cloud_free(&c);
}

/* Copies the bonds of row `row` of b (the bonds of one particle), without padding, to to[256]. Returns their number. */
static int row_bonds(const struct bonds *b, int64_t row, struct bond *to)
{
    int n = 0;
    for (int64_t k = 0; k < b->column_count[row / LANES]; k++) {
        const struct bond bond = bond_read(b, row / LANES, k, (int)(row % LANES));
        if (bond.inverse_length != 0) to[n++] = bond;
    }
    return n;
}

static void assert_rows_equal(const struct bonds *a, const struct bonds *b)
{
    struct bond one[256], other[256];
    assert_int_equal(a->rows, b->rows);
    assert_int_equal(a->n, b->n);
    for (int64_t row = 0; row < a->rows; row++) {
        const int n = row_bonds(a, row, one);
        assert_int_equal(a->particle[row], b->particle[row]);
        assert_int_equal(n, row_bonds(b, row, other));
        assert_true(a->trigger[row] == b->trigger[row] && a->family_volume[row] == b->family_volume[row]);
        for (int k = 0; k < n; k++) {
            assert_int_equal(one[k].nbr, other[k].nbr);
            assert_true(one[k].w == other[k].w && one[k].inverse_length == other[k].inverse_length);
        }
    }
}

/* Makes all particles of c within `radius` [spacings] of the middle axis peridynamic, and the others material
 * points. */
static void convert_tube(struct particle_cloud *c, real radius)
{
    const struct particles *p = &c->p;
    for (int64_t i = 0; i < p->n; i++) {
        real r2 = 0;
        for (int d = 0; d < p->dim; d++) r2 += d == 2 ? 0 : square(p->X[d][i] - p->X[d][p->n / 2]);
        p->kind[i] = r2 < square(radius * CLOUD_SPACING) ? KIND_PD : KIND_MPM;
    }
    particles_rebuild_lists_by_kind(&c->p);
}

/* Checks that rows made from the site map of a lattice agree with those of the neighbour search also beside material
 * points, while a peridynamic tube grows. Bonds that may yield are always made by the search. */
static void test_beside_points(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct particle_cloud c;
        struct bonds searched;
        exact_cloud(&c, dim, SURFACE_VOLUME, NULL);
        bonds_free(&c.bonds);
        convert_tube(&c, 1.5);
        bonds_make(&c.bonds, NULL, &c.p, &c.source);
        for (real radius = 2.2; radius < 5; radius += 0.8) {
            struct bonds old = c.bonds;
            convert_tube(&c, radius);
            bonds_make(&c.bonds, &old, &c.p, &c.source);
            bonds_free(&old);
            c.source.yield = (struct bond_yield){c.yield, c.hardening, CLOUD_MATERIALS};
            bonds_make(&searched, NULL, &c.p, &c.source);
            c.source.yield.stretch = NULL;
            assert_rows_equal(&c.bonds, &searched);
            bonds_free(&searched);
        }
        assert_true(dim == 1 || count_folded(&c.bonds) > 0);
        particle_cloud_free(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_who_follows),   cmocka_unit_test(test_what_is_stored), cmocka_unit_test(test_twins),
        cmocka_unit_test(test_same_bits),     cmocka_unit_test(test_fault),          cmocka_unit_test(test_who_leaves),
        cmocka_unit_test(test_who_stays_out), cmocka_unit_test(test_beside_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
