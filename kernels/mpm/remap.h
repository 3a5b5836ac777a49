/* The second map of MUSL: points receive the change of the nodal velocities (FLIP), then their new momentum is mapped
 * back to the nodes with the same weights:  v_p += sum N dv_I,   P_I = sum m v_p N  (Zeng et al. 2022, eqs. 39, 42). */
#ifndef CLEAVE_KERNELS_REMAP
#define CLEAVE_KERNELS_REMAP

#include "kernels/kernels.h"
#include "maps.h"
#include "scatter.h"
#include "shape.h"

/* Sums of momentum [kg m/s] over the points of a cell for every node that they reach: [component][row of nodes]. */
typedef row_of_nodes remap_rows[DIM_MAX][ROWS_MAX];

/* Interpolates the change of the nodal velocities (g->force [m/s]) to the points of stencil s (node weights of a few
 * points of cell c) and adds it to their velocities in p. First half of the remapping of MUSL. momentum[dim]: receives
 * the new momentum of the points [kg m/s], one per lane; shape: shape function. */
static ALWAYS_INLINE void remap_gather_momentum(row_of_points *momentum, const struct cell_stencil *s,
                                                const struct grid *g, const struct grid_cell *c, struct particles *p,
                                                const int dim, const enum shape shape)
{
    row_of_points gain[DIM_MAX];
    for (int d = 0; d < dim; d++) gain[d] = points_broadcast(0);
    if (HAS_CORNERS(dim, shape))
        for (int d = 0; d < dim; d++) {
            row_of_points slope[DIM_MAX];
            gain[d] = cell_corners_interpolate_value_and_gradient(g, g->force[d] + c->node, s->t, slope, dim);
        }
    else
        FOR_ANY_TOUCHED(s, dim, shape)
        {
            const row_of_points weight = stencil_row_transverse_weights(s, k1, k2, dim, shape);
            for (int d = 0; d < dim; d++) {
                const real *change = g->force[d] + cell_row_first_node_index(c, g, k1, k2, dim);
                row_of_points sum = points_broadcast(0);
                FOR_NODES(dim, shape) sum += s->N[k] * change[grid_row_node_index_offset(g, k, dim, shape)];
                gain[d] += weight * sum;
            }
        }
    const row_of_points mass = points_gather_values(p->mass, s->point, dim);
    for (int d = 0; d < dim; d++) {
        const row_of_points v = points_gather_values(p->v[d], s->point, dim) + gain[d];
        points_store(p->v[d], s->point, v, dim);
        momentum[d] = mass * v;
    }
}

/* Updates the velocities of the points list[n] (n <= AT_ONCE, points processed together) of cell c by the change of the
 * nodal velocities of g, and adds their new momentum to `sum`, the nodal sums over the points of the cell. p:
 * particles; t: inputs of the transfer; shape: shape function. */
static ALWAYS_INLINE void remap_update_velocity_and_add_momentum(remap_rows sum, const struct grid *g,
                                                                 const struct grid_cell *c, struct particles *p,
                                                                 const struct transfer_data *t, const int32_t *list,
                                                                 int n, const int dim, const enum shape shape)
{
    struct cell_stencil s;
    row_of_points momentum[DIM_MAX];
    cell_stencil_compute_weights(&s, g, c, p, list, n, t->half_width, dim, shape);
    remap_gather_momentum(momentum, &s, g, c, p, dim, shape);
    stencil_transpose_weights_to_node_lanes(&s, dim, shape);
    for (int at = 0; at < n; at++) {
        const row_of_nodes N = stencil_row_weights_of_point(&s, at, g->h, dim, shape).N;
        row_of_nodes given[DIM_MAX];
        points_prefetch_mass_position_velocity_and_spin(p, t->turn, list, at, dim);
        for (int d = 0; d < dim; d++) given[d] = momentum[d][at] * N;
        FOR_TOUCHED(&s, at, dim, shape)
        {
            const real weight = stencil_point_row_transverse_weight(&s, at, k1, k2, dim, shape);
            for (int d = 0; d < dim; d++) sum[d][PATCH(dim, shape)] += weight * given[d];
        }
    }
}

/* Updates the velocities of the points list[n] of one cell by the change of the nodal velocities (g->force), and adds
 * their new momentum to the nodes of the grid (g->momentum). p: particles; t: inputs of the transfer; shape: shape
 * function. */
static ALWAYS_INLINE void remap_update_velocity_and_momentum_of_cell(const struct grid *g, struct particles *p,
                                                                     const struct transfer_data *t, const int32_t *list,
                                                                     int n, const int dim, const enum shape shape)
{
    const struct grid_cell c = cell_containing_point(g, p, list[0], dim, shape);
    remap_rows sum;
    FOR_ROWS(dim, shape)
    for (int d = 0; d < dim; d++) sum[d][PATCH(dim, shape)] = nodes_broadcast(0);
    for (int k = 0; k < n; k += AT_ONCE(dim))
        remap_update_velocity_and_add_momentum(sum, g, &c, p, t, list + k, points_count_of_next_batch(n - k, dim), dim,
                                               shape);
    FOR_ROWS(dim, shape)
    for (int d = 0; d < dim; d++)
        grid_field_add_values_of_node_row(g, g->momentum[d] + cell_row_first_node_index(&c, g, k1, k2, dim),
                                          sum[d][PATCH(dim, shape)], dim, shape);
}

#define INSTANCE(D, S)                                                                                                 \
    void remap_##D##d_##S(struct grid *g, struct particles *p, const struct transfer_data *t)                          \
    {                                                                                                                  \
        SCATTER(D, t, g, p,                                                                                            \
                remap_update_velocity_and_momentum_of_cell(&nodes, &points, &data, list, n, D, SHAPE_##S));            \
    }
MAP_VARIANTS(INSTANCE)
#undef INSTANCE

#endif
