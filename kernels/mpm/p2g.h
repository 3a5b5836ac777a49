/* Particles to grid (P2G), the first map: adds mass, momentum and force of material points to the nodes.
 * Blocks of cells are processed colour by colour (struct transfer_order), so that a node has one writer at a
 * time and a fixed order of terms (Zeng et al. 2022, eqs. 33-36, with sums over all nodes of a point):
 *
 *     m_I = sum m N,   P_I = sum m v N,   f_I = sum (N f - V sigma_given . grad N)
 *
 * with mass m, velocity v, force f and volume V of a point, the stress sigma_given that it transmits to the
 * grid, and the shape function N of node I. For APIC (Jiang et al. 2015) and for points that rotate
 * (rotating_group_velocity_gradients_of_points), v + L (x_I - x_p) replaces v. Reads about 120 bytes per point in 2D;
 * the nodes of a block stay in cache. */
#ifndef CLEAVE_KERNELS_P2G
#define CLEAVE_KERNELS_P2G

#include "kernels/kernels.h"
#include "dilatation.h"
#include "maps.h"
#include "scatter.h"
#include "shape.h"
#include "stress.h"
#include "turn.h"

/* Sums over the points of a cell for every node that they reach, [quantity][row of nodes]. Quantity 0: mass [kg], then
 * dim components of momentum [kg m/s], then dim components of force [N]. */
typedef row_of_nodes cell_sums[1 + 2 * DIM_MAX][ROWS_MAX];

/* Returns the index of the component with the axes `axis` and `other_axis` (0 to dim - 1) of a symmetric tensor among
 * its stored components, which are in the order xx, yy, zz, xy, yz, zx (in 2D xx, yy, xy). */
static ALWAYS_INLINE int symmetric_component_index(int axis, int other_axis, const int dim)
{
    return axis == other_axis ? axis : dim == 2 ? 2 : axis + other_axis == 1 ? 3 : axis + other_axis == 3 ? 4 : 5;
}

/* Adds to the nodal forces in `sum` (sums over the points of a cell) the forces by the antisymmetric part of the stress
 * of point number `point_in_stencil` of stencil s (node weights of a few points): f_a = -V sum_b skew_ab grad_b N, with
 * the volume V of the point and the shape function N. Does nothing unless the point has bonds of a state-based model
 * (partial_stress.c). p: particles; t: inputs of the transfer; row: weights and slopes of a row of nodes at this point;
 * shape: shape function. */
static ALWAYS_INLINE void
p2g_add_skew_stress_force_to_nodal_sums(cell_sums sum, const struct particles *p, const struct transfer_data *t,
                                        const struct cell_stencil *s, const struct node_row_weights *row,
                                        int point_in_stencil, const int dim, const enum shape shape)
{
    static const int first[DIM_MAX] = {0, 1, 2}, second[DIM_MAX] = {1, 2, 0};
    const int64_t i = s->point[point_in_stencil];
    real skew[DIM_MAX];
    if (dim == 1 || t->momentum_only || !point_compute_skew_stress_transmitted_to_grid(p, t->partial, i, skew, dim))
        return;
    FOR_TOUCHED(s, point_in_stencil, dim, shape)
    {
        row_of_nodes grad[DIM_MAX];
        for (int e = 0; e < dim; e++)
            grad[e] =
                e < ROW_DIMS(dim, shape)
                    ? row->D[e] * stencil_point_row_transverse_weight(s, point_in_stencil, k1, k2, dim, shape)
                    : row->N * stencil_point_row_transverse_weight_slope(s, point_in_stencil, k1, k2, e, dim, shape);
        for (int c = 0; c < dim * (dim - 1) / 2; c++) {
            const real force = skew[c] * p->volume[i];
            sum[1 + dim + first[c]][PATCH(dim, shape)] -= force * grad[second[c]];
            sum[1 + dim + second[c]][PATCH(dim, shape)] += force * grad[first[c]];
        }
    }
}

/* Stress that a few points of a cell transmit to the grid, one per lane. */
struct points_stress {
    int32_t point[POINT_NUMBERS];  /* numbers of the points (points_copy_list_indices_to_lanes) */
    row_of_points stress[SYM_MAX]; /* symmetric components [Pa] */
    row_of_points volume;          /* [m^3] */
};

/* Quantities that a few points of a cell transfer to nodes, one point per lane. */
struct points_transfer_quantities {
    row_of_points mass, v[DIM_MAX], f[DIM_MAX]; /* [kg], [m/s], [N] */
    row_of_points pull[SYM_MAX];                /* stress times volume, symmetric components [N m] */
    row_of_points slope[DIM_MAX * DIM_MAX];     /* velocity gradient by which velocities are extrapolated [1/s] */
};

/* Returns true if points extrapolate their velocity to the positions of the nodes by a velocity gradient: with APIC,
 * and if points rotate in groups (data/turning.h). t: inputs of the transfer; transfer: FLIP or APIC. */
static ALWAYS_INLINE bool points_extrapolate_velocity_to_nodes(const struct transfer_data *t, const int dim,
                                                               const enum transfer transfer)
{
    return transfer == TRANSFER_APIC || (dim > 1 && t->turn[2] && !t->momentum_only);
}

/* Loads the stresses that the n points `list` of p (n <= AT_ONCE, points processed together) transmit to the grid,
 * without the part that bonds carry, and the volumes of the points into *s. Lanes from n on repeat points of the list
 * (points_list_index_of_lane). t: inputs of the transfer; if t->momentum_only is set, the stresses are 0. */
static ALWAYS_INLINE void points_load_stress_for_transfer_to_grid(struct points_stress *s, const struct particles *p,
                                                                  const struct transfer_data *t, const int32_t *list,
                                                                  int n, const int dim)
{
    const int components = dim * (dim + 1) / 2;
    points_copy_list_indices_to_lanes(s->point, list, n, dim);
    s->volume = points_gather_values(p->volume, s->point, dim);
    for (int c = 0; c < components; c++)
        s->stress[c] = t->momentum_only ? points_broadcast(0) : points_gather_values(p->stress[c], s->point, dim);
    if (t->momentum_only || !t->partial || !t->partial->index) return;
    for (int k = 0; k < AT_ONCE(dim); k++) {
        real own[SYM_MAX];
        point_compute_stress_transmitted_to_grid(p, t->partial, s->point[k], own, dim);
        for (int c = 0; c < components; c++) s->stress[c][k] = own[c];
    }
}

/* Loads the quantities that the points of s transfer to nodes into *q: mass, velocity, force, stress times volume and,
 * if `extrapolate_velocity` is true, the velocity gradient by which velocities are extrapolated to nodes. p: particles;
 * t: inputs of the transfer; transfer: FLIP or APIC. */
static ALWAYS_INLINE void points_load_quantities_to_transfer(struct points_transfer_quantities *q,
                                                             const struct particles *p, const struct transfer_data *t,
                                                             const struct points_stress *s, const int dim,
                                                             const enum transfer transfer,
                                                             const bool extrapolate_velocity)
{
    q->mass = points_gather_values(p->mass, s->point, dim);
    for (int d = 0; d < dim; d++)
        q->v[d] = points_gather_values(p->v[d], s->point, dim), q->f[d] = points_gather_values(p->f[d], s->point, dim);
    for (int c = 0; c < dim * (dim + 1) / 2; c++) q->pull[c] = s->stress[c] * s->volume;
    if (extrapolate_velocity && transfer == TRANSFER_FLIP)
        rotating_group_velocity_gradients_of_points(t, s->point, 0.5 * t->dt, q->slope, dim);
    for (int k = 0; k < dim * dim && transfer == TRANSFER_APIC; k++)
        q->slope[k] = points_gather_values(p->gradient[k], s->point, dim);
}

/* Adds mass, momentum and force of point number `point_in_stencil` of stencil s (node weights of a few points of p) to
 * `sum`, the nodal sums over the points of its cell of grid g. q: quantities of the points
 * (points_load_quantities_to_transfer); t: inputs of the transfer, with the shape function `shape`;
 * extrapolate_velocity: true if points extrapolate their velocity to nodes by a velocity gradient. */
static ALWAYS_INLINE void p2g_add_one_point_to_nodal_sums(cell_sums sum, const struct grid *g,
                                                          const struct particles *p, const struct transfer_data *t,
                                                          const struct cell_stencil *s,
                                                          const struct points_transfer_quantities *q,
                                                          int point_in_stencil, const int dim, const enum shape shape,
                                                          const bool extrapolate_velocity)
{
    const int along = ROW_DIMS(dim, shape);
    const struct node_row_weights row = stencil_row_weights_of_point(s, point_in_stencil, g->h, dim, shape);
    const row_of_nodes mass = q->mass[point_in_stencil] * row.N;
    row_of_nodes momentum[DIM_MAX], force[DIM_MAX], pull[SYM_MAX], far[DIM_MAX];
    for (int e = 0; e < along && extrapolate_velocity; e++)
        far[e] = stencil_point_distances_to_row_nodes(s, point_in_stencil, g->h, e, dim, shape);
    for (int k = 0; k < dim * (dim + 1) / 2; k++) pull[k] = q->pull[k][point_in_stencil] * row.N;
#pragma GCC unroll 3
    for (int d = 0; d < dim; d++) {
        row_of_nodes speed = nodes_broadcast(q->v[d][point_in_stencil]);
        for (int e = 0; e < along && extrapolate_velocity; e++)
            speed += q->slope[d * dim + e][point_in_stencil] * far[e];
        momentum[d] = mass * speed;
        force[d] = q->f[d][point_in_stencil] * row.N;
        for (int e = 0; e < along; e++)
            force[d] -= q->pull[symmetric_component_index(d, e, dim)][point_in_stencil] * row.D[e];
    }
    FOR_TOUCHED(s, point_in_stencil, dim, shape)
    {
        const real weight = stencil_point_row_transverse_weight(s, point_in_stencil, k1, k2, dim, shape);
        const int k = PATCH(dim, shape);
        sum[0][k] += mass * weight;
        for (int d = 0; d < dim; d++) {
            row_of_nodes carried = momentum[d], pushed = sum[1 + dim + d][k] + force[d] * weight;
            for (int e = along; e < dim; e++) {
                if (extrapolate_velocity)
                    carried +=
                        q->slope[d * dim + e][point_in_stencil] * mass *
                        stencil_point_distance_to_row(s, point_in_stencil, g->h, e, e == 1 ? k1 : k2, dim, shape);
                pushed -= pull[symmetric_component_index(d, e, dim)] *
                          stencil_point_row_transverse_weight_slope(s, point_in_stencil, k1, k2, e, dim, shape);
            }
            sum[1 + d][k] += carried * weight;
            sum[1 + dim + d][k] = pushed;
        }
    }
    if (__builtin_expect(p->end_moment[0] != NULL, 0))
        p2g_add_skew_stress_force_to_nodal_sums(sum, p, t, s, &row, point_in_stencil, dim, shape);
}

/* Prefetches the data of p that p2g_add_batch_of_points_to_nodal_sums will read of the point list[k + ORDER_AHEAD],
 * once per cache line. t: inputs of the transfer. */
static ALWAYS_INLINE void p2g_prefetch_point(const struct particles *p, const struct transfer_data *t,
                                             const int32_t *list, int k, const int dim, const enum transfer transfer)
{
    int64_t i;
    points_prefetch_mass_position_velocity_and_spin(p, t->turn, list, k, dim);
    if (!point_ahead_starts_new_cache_line(list, k, &i)) return;
    prefetch_cache_line(p->volume + i);
    for (int d = 0; d < dim; d++) prefetch_cache_line(p->f[d] + i);
    for (int c = 0; c < dim * (dim + 1) / 2; c++) prefetch_cache_line(p->stress[c] + i);
    for (int c = 0; c < dim * dim && transfer == TRANSFER_APIC; c++) prefetch_cache_line(p->gradient[c] + i);
}

/* Replaces the mean normal stress of each of the points list[n] of p in a cell, n <= MEAN_POINTS, by its average over
 * the points of the same body and material (dilatation.h). t: constants of the materials; stress: stresses of the
 * points, AT_ONCE points (processed together) in each entry, changed. */
static ALWAYS_INLINE void points_average_mean_stress(const struct particles *p, const struct transfer_data *t,
                                                     const int32_t *list, struct points_stress *stress, int n,
                                                     const int dim)
{
    const int passes = (n + AT_ONCE(dim) - 1) / AT_ONCE(dim);
    real change[MEAN_POINTS];
    row_of_points sum = points_broadcast(0), volume = points_broadcast(0);
    for (int k = 0; k < passes; k++) {
        row_of_points mean = points_broadcast(0);
        for (int d = 0; d < dim; d++) mean += stress[k].stress[d];
        mean *= 1.0 / dim;
        const row_of_points own =
            points_keep_first_lanes(stress[k].volume, points_count_of_next_batch(n - k * AT_ONCE(dim), dim));
        volume += own, sum += own * mean;
        *(points_anywhere *)(change + k * AT_ONCE(dim)) = mean;
    }
    if (!points_all_share_mean_dilatation(p, list, n))
        points_replace_values_by_cell_mean_minus_value(p, t, list, n, change);
    else if (!t->elastic[p->material[list[0]]].mean_dilatation)
        return;
    else {
        const real mean = points_sum(sum) / points_sum(volume);
        for (int k = 0; k < passes * AT_ONCE(dim); k++) change[k] = mean - change[k];
    }
    for (int k = 0; k < passes; k++)
        for (int d = 0; d < dim; d++) stress[k].stress[d] += *(const points_anywhere *)(change + k * AT_ONCE(dim));
}

/* Adds mass, momentum and force of the points list[n] of p (n <= AT_ONCE, points processed together) in cell c of grid
 * g to `sum`, the nodal sums over the points of this cell. stress: stress of these points; t: inputs of the transfer,
 * with the shape function `shape` and the scheme `transfer`; extrapolate_velocity: true if points extrapolate their
 * velocity to nodes (points_extrapolate_velocity_to_nodes). */
static ALWAYS_INLINE void p2g_add_batch_of_points_to_nodal_sums(
    cell_sums sum, const struct grid *g, const struct grid_cell *c, const struct particles *p,
    const struct transfer_data *t, const struct points_stress *stress, const int32_t *list, int n, const int dim,
    const enum shape shape, const enum transfer transfer, const bool extrapolate_velocity)
{
    struct cell_stencil s;
    struct points_transfer_quantities q;
    cell_stencil_compute_weights(&s, g, c, p, list, n, t->half_width, dim, shape);
    stencil_transpose_weights_to_node_lanes(&s, dim, shape);
    points_load_quantities_to_transfer(&q, p, t, stress, dim, transfer, extrapolate_velocity);
    for (int at = 0; at < n; at++) {
        p2g_prefetch_point(p, t, list, at, dim, transfer);
        p2g_add_one_point_to_nodal_sums(sum, g, p, t, &s, &q, at, dim, shape, extrapolate_velocity);
    }
}

/* Adds mass, momentum and force of the points list[n] of p in one cell to the nodes of the grid g. t: inputs of the
 * transfer, with the shape function `shape` and the scheme `transfer`; average_mean_stress: true if the points of a
 * cell get the average of their mean stresses (transfer_uses_mean_dilatation). */
static ALWAYS_INLINE void p2g_add_points_of_cell_to_grid_nodes(const struct grid *g, const struct particles *p,
                                                               const struct transfer_data *t, const int32_t *list,
                                                               int n, const int dim, const enum shape shape,
                                                               const enum transfer transfer,
                                                               const bool average_mean_stress)
{
    enum { MOST = MEAN_POINTS / POINTS };
    const struct grid_cell c = cell_containing_point(g, p, list[0], dim, shape);
    const int most = average_mean_stress ? MEAN_POINTS : AT_ONCE(dim);
    struct points_stress stress[MOST];
    cell_sums sum;
    FOR_ROWS(dim, shape)
    for (int f = 0; f < 1 + 2 * dim; f++) sum[f][PATCH(dim, shape)] = nodes_broadcast(0);
    for (int from = 0; from < n; from += most) {
        const int some = int_min(n - from, most);
        for (int k = 0; k < some; k += AT_ONCE(dim))
            points_load_stress_for_transfer_to_grid(&stress[k / AT_ONCE(dim)], p, t, list + from + k,
                                                    points_count_of_next_batch(some - k, dim), dim);
        if (average_mean_stress) points_average_mean_stress(p, t, list + from, stress, some, dim);
        for (int k = 0; k < some; k += AT_ONCE(dim)) {
            const struct points_stress *own = &stress[k / AT_ONCE(dim)];
            const int points = points_count_of_next_batch(some - k, dim);
            const bool continued = points_extrapolate_velocity_to_nodes(t, dim, transfer);
            if (HAS_CORNERS(dim, shape) && continued) /* a loop of its own, without tests */
                p2g_add_batch_of_points_to_nodal_sums(sum, g, &c, p, t, own, list + from + k, points, dim, shape,
                                                      transfer, true);
            else
                p2g_add_batch_of_points_to_nodal_sums(sum, g, &c, p, t, own, list + from + k, points, dim, shape,
                                                      transfer, continued);
        }
    }
    FOR_ROWS(dim, shape)
    {
        const int64_t I = cell_row_first_node_index(&c, g, k1, k2, dim);
        const int k = PATCH(dim, shape);
        grid_field_add_values_of_node_row(g, g->mass + I, sum[0][k], dim, shape);
        for (int d = 0; d < dim; d++) {
            grid_field_add_values_of_node_row(g, g->momentum[d] + I, sum[1 + d][k], dim, shape);
            grid_field_add_values_of_node_row(g, g->force[d] + I, sum[1 + dim + d][k], dim, shape);
        }
    }
}

/* Adds the points of all cells to the nodes; AVERAGE: true if points have the mean dilatation of their cells. */
#define LOOP(D, S, T, AVERAGE)                                                                                         \
    SCATTER(                                                                                                           \
        D, t, g, p,                                                                                                    \
        p2g_add_points_of_cell_to_grid_nodes(&nodes, &points, &data, list, n, D, SHAPE_##S, TRANSFER_##T, AVERAGE))

/* Defines the function of the first map (points to nodes) for dimension D, shape function S and transfer scheme T. */
#ifdef ONE_LOOP_OVER_CELLS
#define INSTANCE(D, S, T)                                                                                              \
    void p2g_##D##d_##S##_##T(struct grid *g, const struct particles *p, const struct transfer_data *t)                \
    {                                                                                                                  \
        const bool average = transfer_uses_mean_dilatation(t, D);                                                      \
        LOOP(D, S, T, average);                                                                                        \
    }
#else
#define INSTANCE(D, S, T)                                                                                              \
    void p2g_##D##d_##S##_##T(struct grid *g, const struct particles *p, const struct transfer_data *t)                \
    {                                                                                                                  \
        if (transfer_uses_mean_dilatation(t, D)) {                                                                     \
            LOOP(D, S, T, true);                                                                                       \
        } else {                                                                                                       \
            LOOP(D, S, T, false);                                                                                      \
        }                                                                                                              \
    }
#endif
#define BOTH(D, S) TRANSFER_VARIANTS(INSTANCE, D, S)
MAP_VARIANTS(BOTH)
#undef BOTH
#undef INSTANCE
#undef LOOP

/* ---- single field of a few points -------------------------------------------------------------------------------- */

/* Adds `value`, a value of point i of p, to the nodal array `field`, distributed to the nodes of g with the weights N
 * of the first map (p2g). half_width: transfer_data.half_width [m]; shape: shape function. */
static ALWAYS_INLINE void p2g_add_weighted_point_value_to_nodes(const struct grid *g, const struct particles *p,
                                                                real half_width, int32_t i, real value, real *field,
                                                                const int dim, const enum shape shape)
{
    const struct grid_cell c = cell_containing_point(g, p, i, dim, shape);
    struct cell_stencil s;
    cell_stencil_compute_weights(&s, g, &c, p, &i, 1, half_width, dim, shape);
    stencil_transpose_weights_to_node_lanes(&s, dim, shape);
    const row_of_nodes spread = value * stencil_row_weights_of_point(&s, 0, g->h, dim, shape).N;
    FOR_TOUCHED(&s, 0, dim, shape)
    grid_field_add_values_of_node_row(g, field + cell_row_first_node_index(&c, g, k1, k2, dim),
                                      spread * stencil_point_row_transverse_weight(&s, 0, k1, k2, dim, shape), dim,
                                      shape);
}

#define SPREAD(D, S)                                                                                                   \
    void spread_##D##d_##S(const struct grid *g, const struct particles *p, real half_width, const int32_t *list,      \
                           int64_t n, const real *value, real *field)                                                  \
    {                                                                                                                  \
        for (int64_t k = 0; k < n; k++)                                                                                \
            p2g_add_weighted_point_value_to_nodes(g, p, half_width, list[k], value[k], field, D, SHAPE_##S);           \
    }
MAP_VARIANTS(SPREAD)
#undef SPREAD

#endif
