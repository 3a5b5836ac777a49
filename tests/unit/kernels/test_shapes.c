/* Tests every shape function through the kernels that scatter with it: partition of unity and exact gradients of linear
 * fields, at any position and width, in one, two and three dimensions. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "data/grid.h"
#include "kernels/kernels.h"
#include "tests/support/near.h"
#include "base/team.h"

/* Some points on a small grid with node distance 1, so that errors are those of weights and slopes [m]. */
struct points {
    struct particles p;
    struct grid g;
    struct transfer_order order;
    struct partial_stress partial;
    struct transfer_data t;
};

enum { POINTS = 40, PLACES = 50 };

static void points_make(struct points *s, int dim)
{
    bool changed;
    memset(s, 0, sizeof *s);
    particles_make(&s->p, dim, POINTS, WITH_STRETCH | WITH_GRADIENT);
    s->g = (struct grid){.dim = dim, .h = 1, .anchor = {0.3, -0.2, 0.1}};
    assert_int_equal(grid_extend_box(&s->g, (real[]){-4, -4, -4}, (real[]){4, 4, 4}, 100000, &changed), OK);
    s->t = (struct transfer_data){.order = &s->order, .partial = &s->partial};
    for (int64_t i = 0; i < POINTS; i++) s->p.volume[i] = 1;
    particles_rebuild_lists_by_kind(&s->p);
}

/* Places the points of s between -4 and 4, every fourth on a node or in the middle of a cell, with widths of up to two
 * cells. seed: state of the random numbers. */
static void points_place(struct points *s, uint64_t *seed)
{
    for (int64_t i = 0; i < POINTS; i++)
        for (int d = 0; d < s->p.dim; d++) {
            real place = cloud_between(seed, -4, 4);
            s->p.x[d][i] = i % 4 ? place : s->g.anchor[d] + 0.5 * floor(2 * place + 1);
            s->p.stretch[d][i] = cloud_between(seed, 0.1, 4);
        }
    transfer_order_sort_points_by_cell(&s->order, &s->p, s->p.list[KIND_MPM], POINTS, &s->g);
}

static void points_free(struct points *s)
{
    transfer_order_free(&s->order);
    grid_free(&s->g);
    particles_free(&s->p);
}

/* Returns the sum over the nodes of g of `field` times 1 (axis -1) or times the position of the node along `axis`
 * [m]. */
static real moment(const struct grid *g, const real *field, int axis)
{
    real sum = 0;
    for (int64_t I = 0; I < g->n; I++)
        sum += field[I] * (axis < 0 ? 1 : grid_node_position(g, axis, I / g->stride[axis] % g->count[axis]));
    return sum;
}

/* Checks sum N = 1 and sum N x_I = x for the shape functions `shape` at the points of s by scattering a single value.
 * Tolerance 1e-14: sums of up to 64 terms of at most 10. */
static void check_weights(struct points *s, enum shape shape)
{
    const int dim = s->p.dim;
    real *field = NEW("test.field", s->g.n, real);
    for (int32_t i = 0; i < POINTS; i++) {
        memset(field, 0, (size_t)s->g.n * sizeof *field);
        spread_table[dim][shape](&s->g, &s->p, s->t.half_width, &i, 1, (real[]){1}, field);
        assert_near(moment(&s->g, field, -1), 1, 1e-13);
        for (int d = 0; d < dim; d++) assert_near(moment(&s->g, field, d), s->p.x[d][i], 1e-13);
    }
    memory_free(field);
}

/* Checks sum dN = 0 and sum dN/dx_b x_Ia = delta_ab for `shape` and `transfer` by the nodal forces of a point of s of
 * unit volume under a unit stress of each component. Tolerance: slopes are means over at least a twentieth of a cell,
 * which increases round-off by a factor of 20. */
static void check_slopes(struct points *s, enum shape shape, enum transfer transfer)
{
    static const int component[DIM_MAX + 1][DIM_MAX][DIM_MAX] = {
        {{0}}, {{0}}, {{0, 2}, {2, 1}}, {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
    const int dim = s->p.dim;
    for (int64_t i = 0; i < POINTS; i++)
        for (int c = 0; c < symmetric_tensor_component_count(dim); c++) {
            s->p.stress[c][i] = 1;
            grid_clear(&s->g);
            p2g_table[dim][shape][transfer](&s->g, &s->p, &s->t);
            s->p.stress[c][i] = 0;
            for (int a = 0; a < dim; a++) {
                assert_near(moment(&s->g, s->g.force[a], -1), 0, 1e-12);
                for (int b = 0; b < dim; b++)
                    assert_near(moment(&s->g, s->g.force[a], b), -(component[dim][a][b] == c), 1e-12);
            }
        }
}

static void test_complete(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct points s;
        points_make(&s, dim);
        for (int k = 0; k < (dim == 1 ? PLACES : dim == 2 ? PLACES / 5 : 1); k++) {
            points_place(&s, &seed);
            for (int shape = 0; shape < SHAPES; shape++) {
                s.t.half_width = shape == SHAPE_QUADRATIC ? 0.5 : 0.25;
                check_weights(&s, (enum shape)shape);
                check_slopes(&s, (enum shape)shape, k % 2 ? TRANSFER_APIC : TRANSFER_FLIP);
            }
        }
        points_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_complete)};
    threads_set_count_and_bind_to_cores(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
