/* Order in which points are processed by transfers: points are sorted by cells, cells by blocks (boxes of cells), and
 * blocks by colours, whose blocks share no node. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "data/grid.h"
#include "base/team.h"
#include "data/transfer_order.h"

/* Creates the particles of c at random positions in the cells -20 .. 20 around node 0 of the grid g, which is created
 * too, in `dim` dimensions; a tenth of them are peridynamic. */
static void scatter_points(struct particle_cloud *c, int dim, struct grid *g)
{
    static const enum space space[] = {SPACE_LINE, SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
    uint64_t seed = 5;
    real from[DIM_MAX], to[DIM_MAX];
    bool changed;
    particle_cloud_make(c, &(struct cloud_plan){.space = space[dim], .count = {600}, .horizon = 3});
    *g = (struct grid){.dim = dim, .h = 2 * CLOUD_SPACING};
    for (int d = 0; d < dim; d++) {
        g->anchor[d] = 0.37 * CLOUD_SPACING;
        from[d] = g->anchor[d] - 20 * g->h, to[d] = g->anchor[d] + 20 * g->h;
        for (int64_t i = 0; i < c->p.n; i++) c->p.x[d][i] = cloud_between(&seed, from[d], to[d]);
    }
    for (int64_t i = 0; i < c->p.n; i++) c->p.kind[i] = cloud_random(&seed) < 0.1 ? KIND_PD : KIND_MPM;
    particles_rebuild_lists_by_kind(&c->p);
    assert_int_equal(grid_extend_box(g, from, to, 1000000, &changed), OK);
    assert_true(changed);
}

/* Checks that no node is reached from two blocks of the colour `colour`, so that threads can process these blocks at
 * once. The widest support is that of the cubic spline: from one node below the cell of a point to two above its lower
 * corner. o: order of the points on the grid g. */
static void check_colour(const struct transfer_order *o, const struct particles *p, const struct grid *g, int colour)
{
    int32_t *owner = NEW("test.owner", g->n, int32_t);
    for (int32_t b = o->blocks_of[colour]; b < o->blocks_of[colour + 1]; b++)
        for (int32_t k = o->block_start[b]; k < o->block_start[b + 1]; k++)
            for (int corner = 0; corner < 1 << (2 * g->dim); corner++) {
                int64_t node = 0;
                for (int d = 0; d < g->dim; d++) {
                    int64_t cell = (int64_t)floor((p->x[d][o->particle[k]] - g->anchor[d]) / g->h) - g->first[d];
                    int64_t at = cell - 1 + (corner >> (2 * d) & 3);
                    assert_in_range(at, 0, g->count[d] - 1);
                    node += at * g->stride[d];
                }
                assert_true(owner[node] == 0 || owner[node] == b + 1);
                owner[node] = b + 1;
            }
    memory_free(owner);
}

/* Checks that the cells of a block are consecutive, that the points of a cell are in this cell and ascending, and that
 * no cell occurs twice. o: order of the points on the grid g. */
static void check_cells(const struct transfer_order *o, const struct particles *p, const struct grid *g)
{
    uint8_t *seen = NEW("test.cells", g->n, uint8_t);
    assert_int_equal(o->block_cell[0], 0);
    assert_int_equal(o->block_cell[o->blocks], o->cells);
    for (int b = 0; b < o->blocks; b++) assert_int_equal(o->cell_start[o->block_cell[b]], o->block_start[b]);
    assert_int_equal(o->cell_start[o->cells], o->n);
    for (int32_t c = 0; c < o->cells; c++) {
        int64_t place = -1;
        assert_true(o->cell_start[c] < o->cell_start[c + 1]);
        for (int32_t k = o->cell_start[c]; k < o->cell_start[c + 1]; k++) {
            int64_t at = 0;
            for (int d = 0; d < g->dim; d++)
                at += ((int64_t)floor((p->x[d][o->particle[k]] - g->anchor[d]) / g->h) - g->first[d]) * g->stride[d];
            assert_true(k == o->cell_start[c] || (at == place && o->particle[k] > o->particle[k - 1]));
            place = at;
        }
        assert_int_equal(seen[place]++, 0);
    }
    memory_free(seen);
}

static void test_transfer_order(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct particle_cloud c;
        struct grid g;
        struct transfer_order o = {0};
        scatter_points(&c, dim, &g);
        transfer_order_sort_points_by_cell(&o, &c.p, c.p.list[KIND_MPM], c.p.n_of[KIND_MPM], &g);
        assert_int_equal(o.n, c.p.n_of[KIND_MPM]);
        assert_int_equal(o.block_start[0], 0);
        assert_int_equal(o.block_start[o.blocks], o.n);
        check_cells(&o, &c.p, &g);
        uint8_t *seen = NEW("test.seen", c.p.n, uint8_t);
        for (int64_t k = 0; k < o.n; k++) {
            assert_int_equal(c.p.kind[o.particle[k]], KIND_MPM);
            assert_int_equal(seen[o.particle[k]]++, 0);
        }
        assert_int_equal(o.blocks_of[0], 0);
        assert_int_equal(o.blocks_of[COLOURS_MAX], o.blocks);
        for (int colour = 0; colour < COLOURS_MAX; colour++) check_colour(&o, &c.p, &g, colour);
        memory_free(seen);
        transfer_order_free(&o);
        grid_free(&g);
        particle_cloud_free(&c);
    }
}

/* Checks that a grid that grows keeps the positions of its nodes and the order of its points. */
static void test_transfer_order_growth(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct particle_cloud c;
        struct grid g;
        struct transfer_order small = {0}, large = {0};
        bool changed;
        scatter_points(&c, dim, &g);
        transfer_order_sort_points_by_cell(&small, &c.p, c.p.list[KIND_MPM], c.p.n_of[KIND_MPM], &g);
        real from[DIM_MAX], to[DIM_MAX], before = grid_node_position(&g, 0, -g.first[0]);
        for (int d = 0; d < dim; d++)
            from[d] = -(19 + transfer_block_edge_length_in_cells(d)) * g.h,
            to[d] = 33 * g.h; /* by one block: parity must not
                               * depend on the box */
        assert_int_equal(grid_extend_box(&g, from, to, 1000000, &changed), OK);
        assert_true(changed && grid_node_position(&g, 0, -g.first[0]) == before);
        transfer_order_sort_points_by_cell(&large, &c.p, c.p.list[KIND_MPM], c.p.n_of[KIND_MPM], &g);
        assert_int_equal(small.n, large.n);
        assert_memory_equal(small.particle, large.particle, (size_t)small.n * sizeof(int32_t));
        assert_int_equal(grid_extend_box(&g, from, to, 1000000, &changed), OK);
        assert_false(changed);
        transfer_order_free(&small);
        transfer_order_free(&large);
        grid_free(&g);
        particle_cloud_free(&c);
    }
}

/* Moves each point of p with the probability `share` to a random position in the grid g, and sets o->left for the
 * points whose cell has changed. o: order of the points; seed: state of the random numbers. */
static void move_points(const struct particles *p, const struct transfer_order *o, const struct grid *g, real share,
                        uint64_t *seed)
{
    for (int64_t k = 0; k < o->n; k++) {
        const int32_t i = o->particle[k];
        bool left = false;
        for (int d = 0; d < p->dim && cloud_random(seed) < share; d++) {
            const int64_t cell = grid_cell_index_at(g, d, p->x[d][i]);
            p->x[d][i] = cloud_between(seed, g->anchor[d] - 20 * g->h, g->anchor[d] + 20 * g->h);
            left |= cell != grid_cell_index_at(g, d, p->x[d][i]);
        }
        o->left[k] = left;
    }
}

/* Checks that sorting only the points that have left their cells results in the order that sorting all points does. */
static void test_transfer_order_left(void **state)
{
    static const real share[] = {0.01, 0, 0.2, 1, 0.05};
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct particle_cloud c;
        struct grid g;
        struct transfer_order moved = {0}, sorted = {0};
        uint64_t seed = 11;
        scatter_points(&c, dim, &g);
        const int64_t n = c.p.n_of[KIND_MPM];
        int32_t *list = NEW("test.left", n, int32_t);
        transfer_order_sort_points_by_cell(&moved, &c.p, c.p.list[KIND_MPM], n, &g);
        for (size_t k = 0; k < sizeof share / sizeof *share; k++) {
            move_points(&c.p, &moved, &g, share[k], &seed);
            const int64_t left = transfer_order_list_points_that_left_cells(&moved, list);
            transfer_order_move_points_that_left_cells(&moved, &c.p, list, left, &g);
            transfer_order_sort_points_by_cell(&sorted, &c.p, c.p.list[KIND_MPM], n, &g);
            assert_int_equal(moved.cells, sorted.cells);
            assert_memory_equal(moved.particle, sorted.particle, (size_t)n * sizeof(int32_t));
            assert_memory_equal(moved.cell_start, sorted.cell_start, (size_t)(sorted.cells + 1) * sizeof(int32_t));
            assert_memory_equal(moved.block_cell, sorted.block_cell, (size_t)(sorted.blocks + 1) * sizeof(int32_t));
            assert_int_equal(transfer_order_list_points_that_left_cells(&moved, list), 0);
        }
        memory_free(list);
        transfer_order_free(&moved);
        transfer_order_free(&sorted);
        grid_free(&g);
        particle_cloud_free(&c);
    }
}

/* Checks that the order does not depend on the number of threads, each of which sorts a part of the points. */
static void test_transfer_order_threads(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct particle_cloud c;
        struct grid g;
        struct transfer_order one = {0}, many = {0};
        scatter_points(&c, dim, &g);
        threads_set_count_and_bind_to_cores(1);
        transfer_order_sort_points_by_cell(&one, &c.p, c.p.list[KIND_MPM], c.p.n_of[KIND_MPM], &g);
        for (int threads = 2; threads <= 7; threads++) {
            threads_set_count_and_bind_to_cores(threads);
            transfer_order_sort_points_by_cell(&many, &c.p, c.p.list[KIND_MPM], c.p.n_of[KIND_MPM], &g);
            assert_int_equal(one.cells, many.cells);
            assert_memory_equal(one.particle, many.particle, (size_t)one.n * sizeof(int32_t));
            assert_memory_equal(one.cell_start, many.cell_start, (size_t)(one.cells + 1) * sizeof(int32_t));
            assert_memory_equal(one.block_start, many.block_start, (size_t)(one.blocks + 1) * sizeof(int32_t));
        }
        threads_set_count_and_bind_to_cores(2);
        transfer_order_free(&one);
        transfer_order_free(&many);
        grid_free(&g);
        particle_cloud_free(&c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_transfer_order),
        cmocka_unit_test(test_transfer_order_growth),
        cmocka_unit_test(test_transfer_order_left),
        cmocka_unit_test(test_transfer_order_threads),
    };
    threads_set_count_and_bind_to_cores(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
