/* Particles to grid (P2G), the first map: mass, momentum and force of material points to the nodes, scattered block by
 * block, colour by colour (struct transfer_order), so that a node has one writer at a time and a fixed order of terms.
 *
 *     m_I = sum m N,   P_I = sum m v N,   f_I = sum (N f - V sigma_given . grad N)
 *
 * with v + L (x_I - x_p) in place of v for APIC (Jiang et al. 2015) and for points that rotate
 * (rotating_velocity_gradients).
 *
 * Zeng et al. 2022, eqs. 33-36, with sums over all nodes of a point. Reads about 120 bytes per point in 2D; the nodes
 * of a block stay in cache. */
#ifndef CLEAVE_KERNELS_P2G
#define CLEAVE_KERNELS_P2G

#include <string.h>

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

/* Adds to the force sums `sum` of a cell the force of the antisymmetric part `skew` of the stress of point `at` of
 * stencil s (weights of a few points): f_a = -V sum_b skew_ab grad_b. Does nothing unless the point has bonds of a
 * state-based model (partial_stress.c). p: particles; t: inputs of the transfer; row: weights and slopes of a row of
 * nodes at this point; shape: shape function. */
static ALWAYS_INLINE void p2g_add_skew_stress_force(cell_sums sum, const struct particles *p,
                                                    const struct transfer_data *t, const struct cell_stencil *s,
                                                    const struct touch *row, int at, const int dim,
                                                    const enum shape shape)
{
    static const int first[DIM_MAX] = {0, 1, 2}, second[DIM_MAX] = {1, 2, 0};
    const int64_t i = s->point[at];
    real skew[DIM_MAX];
    if (dim == 1 || t->momentum_only || !point_skew_stress_on_grid(p, t->partial, i, skew, dim)) return;
    FOR_TOUCHED(s, at, dim, shape)
    {
        row_of_nodes grad[DIM_MAX];
        for (int e = 0; e < dim; e++)
            grad[e] = e < ROW_DIMS(dim, shape) ? row->D[e] * stencil_row_factor(s, at, k1, k2, dim, shape)
                                               : row->N * stencil_row_factor_slope(s, at, k1, k2, e, dim, shape);
        for (int c = 0; c < dim * (dim - 1) / 2; c++) {
            const real force = skew[c] * p->volume[i];
            sum[1 + dim + first[c]][PATCH(dim, shape)] -= force * grad[second[c]];
            sum[1 + dim + second[c]][PATCH(dim, shape)] += force * grad[first[c]];
        }
    }
}

/* Returns true if, in the transfer t, points extrapolate their velocity to the positions of the nodes by a velocity
 * gradient: with APIC, and if points rotate in groups (data/turning.h). */
static ALWAYS_INLINE bool continues(const struct transfer_data *t, const int dim, const enum transfer transfer)
{
    return transfer == TRANSFER_APIC || (dim > 1 && t->turn[2] && !t->momentum_only);
}

/* Adds mass, momentum and force of point `at` of stencil s (weights of a few points of p) to the sums `sum` of its cell
 * of grid g. t: inputs of the transfer, with the shape function `shape` and the scheme `transfer`. Factors of the
 * directions along a row, equal for all rows, are computed once. turn: velocity gradients of the points of the stencil,
 * by which they extrapolate their velocity to nodes, from rotating_velocity_gradients [1/s]; not read for APIC, nor
 * where points do not rotate. pressure: mean stress that is added to the stress of the point [Pa], from
 * points_mean_stress_changes; NULL: none. */
static ALWAYS_INLINE void p2g_add_point(cell_sums sum, const struct grid *g, const struct particles *p,
                                        const struct transfer_data *t, const struct cell_stencil *s,
                                        const row_of_points *turn, const real *pressure, int at, const int dim,
                                        const enum shape shape, const enum transfer transfer)
{
    const int along = ROW_DIMS(dim, shape);
    const int64_t i = s->point[at];
    const struct touch row = stencil_row_weights(s, at, g->h, dim, shape);
    real stress[SYM_MAX];
    if (t->momentum_only)
        memset(stress, 0, sizeof stress);
    else
        point_stress_on_grid(p, t->partial, i, stress, dim);
    for (int d = 0; d < dim && pressure; d++) stress[d] += *pressure;
    const real m = p->mass[i], volume = p->volume[i];
    for (int k = 0; k < dim * (dim + 1) / 2; k++) stress[k] *= volume;
    const row_of_nodes mass = m * row.N;
    row_of_nodes momentum[DIM_MAX], force[DIM_MAX], pull[SYM_MAX];
    real slope[DIM_MAX][DIM_MAX] = {{0}};
    const bool continued = continues(t, dim, transfer);
    row_of_nodes far[DIM_MAX];
    for (int e = 0; e < along && continued; e++) far[e] = stencil_distances_in_row(s, at, g->h, e, dim, shape);
    for (int k = 0; k < dim * (dim + 1) / 2; k++) pull[k] = stress[k] * row.N;
#pragma GCC unroll 3
    for (int d = 0; d < dim; d++) {
        row_of_nodes speed = row_broadcast(p->v[d][i]);
#pragma GCC unroll 3
        for (int e = 0; e < dim && continued; e++) {
            slope[d][e] = transfer == TRANSFER_APIC ? p->gradient[d * dim + e][i] : turn[d * dim + e][at];
            if (e < along) speed += slope[d][e] * far[e];
        }
        momentum[d] = mass * speed;
        force[d] = p->f[d][i] * row.N;
        for (int e = 0; e < along; e++) force[d] -= stress[symmetric_component_index(d, e, dim)] * row.D[e];
    }
    FOR_TOUCHED(s, at, dim, shape)
    {
        const real weight = stencil_row_factor(s, at, k1, k2, dim, shape);
        const int k = PATCH(dim, shape);
        sum[0][k] += mass * weight;
        for (int d = 0; d < dim; d++) {
            row_of_nodes carried = momentum[d], pushed = sum[1 + dim + d][k] + force[d] * weight;
            for (int e = along; e < dim; e++) {
                if (continued)
                    carried += slope[d][e] * mass * stencil_distance_to_row(s, at, g->h, e, e == 1 ? k1 : k2);
                pushed -=
                    pull[symmetric_component_index(d, e, dim)] * stencil_row_factor_slope(s, at, k1, k2, e, dim, shape);
            }
            sum[1 + d][k] += carried * weight;
            sum[1 + dim + d][k] = pushed;
        }
    }
    if (__builtin_expect(p->end_moment[0] != NULL, 0)) p2g_add_skew_stress_force(sum, p, t, s, &row, at, dim, shape);
}

/* Prefetches the data of p that p2g_add_point will read of the point list[k + ORDER_AHEAD], once per cache line. t:
 * inputs of the transfer. */
static ALWAYS_INLINE void p2g_prefetch_point(const struct particles *p, const struct transfer_data *t,
                                             const int32_t *list, int k, const int dim, const enum transfer transfer)
{
    int64_t i;
    points_prefetch_motion(p, t->turn, list, k, dim);
    if (!prefetch_next_point(list, k, &i)) return;
    prefetch_line(p->volume + i);
    for (int d = 0; d < dim; d++) prefetch_line(p->f[d] + i);
    for (int c = 0; c < dim * (dim + 1) / 2; c++) prefetch_line(p->stress[c] + i);
    for (int c = 0; c < dim * dim && transfer == TRANSFER_APIC; c++) prefetch_line(p->gradient[c] + i);
}

/* Computes by how much the mean stress of each of the n <= MEAN_POINTS points list[k] of p in a cell changes if points
 * of the same body and material get one mean stress (dilatation.h). change[MEAN_POINTS]: receives the changes [Pa]; t:
 * constants of the materials. */
static NEVER_INLINE void points_mean_stress_changes(const struct particles *p, const struct transfer_data *t,
                                                    const int32_t *list, int n, real *change, const int dim)
{
    const bool alike = points_all_share_mean_dilatation(p, list, n) && !(t->partial && t->partial->index);
    row_of_points sum = points_broadcast(0), volume = points_broadcast(0);
    if (alike && !t->elastic[p->material[list[0]]].mean_dilatation) {
        for (int k = 0; k < n; k++) change[k] = 0;
        return;
    }
    for (int k = 0; k < n && alike; k += AT_ONCE(dim)) {
        const int points = points_at_once(n - k, dim);
        int32_t point[POINTS];
        for (int l = 0; l < POINTS; l++) point[l] = list[k + int_min(l, points - 1)];
        row_of_points mean = points_broadcast(0);
        for (int d = 0; d < dim; d++) mean += points_load(p->stress[d], point, dim);
        mean *= 1.0 / dim;
        const row_of_points own = points_keep_first_lanes(points_load(p->volume, point, dim), points);
        volume += own, sum += own * mean;
        *(points_anywhere *)(change + k) = mean;
    }
    if (alike) {
        const real mean = points_sum(sum) / points_sum(volume);
        for (int k = 0; k < n; k++) change[k] = mean - change[k];
        return;
    }
    for (int k = 0; k < n; k++) {
        real stress[SYM_MAX];
        point_stress_on_grid(p, t->partial, list[k], stress, dim);
        change[k] = (dim == 2 ? stress[0] + stress[1] : stress[0] + stress[1] + stress[2]) / dim;
    }
    points_subtract_from_mean(p, t, list, n, change);
}

/* Adds mass, momentum and force of the points list[n] of p in one cell to the nodes of the grid g. t: inputs of the
 * transfer, with the shape function `shape` and the scheme `transfer`; averaged: result of
 * transfer_uses_mean_dilatation. */
static ALWAYS_INLINE void p2g_add_points_of_cell(const struct grid *g, const struct particles *p,
                                                 const struct transfer_data *t, const int32_t *list, int n,
                                                 const int dim, const enum shape shape, const enum transfer transfer,
                                                 const bool averaged)
{
    const struct cell c = cell_containing_point(g, p, list[0], dim, shape);
    real change[MEAN_POINTS];
    cell_sums sum;
    FOR_ROWS(dim, shape)
    for (int f = 0; f < 1 + 2 * dim; f++) sum[f][PATCH(dim, shape)] = row_broadcast(0);
    for (int k = 0; k < n; k += AT_ONCE(dim)) {
        struct cell_stencil s;
        const int points = points_at_once(n - k, dim);
        if (averaged && k % MEAN_POINTS == 0)
            points_mean_stress_changes(p, t, list + k, int_min(n - k, MEAN_POINTS), change, dim);
        cell_stencil_make(&s, g, &c, p, list + k, points, t->half_width, dim, shape);
        stencil_transpose(&s, dim, shape);
        row_of_points turn[DIM_MAX * DIM_MAX];
        if (transfer == TRANSFER_FLIP && continues(t, dim, transfer))
            rotating_velocity_gradients(t, s.point, 0.5 * t->dt, turn, dim);
        for (int at = 0; at < points; at++) {
            p2g_prefetch_point(p, t, list, k + at, dim, transfer);
            p2g_add_point(sum, g, p, t, &s, turn, averaged ? &change[(k + at) % MEAN_POINTS] : NULL, at, dim, shape,
                          transfer);
        }
    }
    FOR_ROWS(dim, shape)
    {
        const int64_t I = cell_row_first_node(&c, g, k1, k2, dim);
        const int k = PATCH(dim, shape);
        grid_add_node_row(g, g->mass + I, sum[0][k], dim, shape);
        for (int d = 0; d < dim; d++) {
            grid_add_node_row(g, g->momentum[d] + I, sum[1 + d][k], dim, shape);
            grid_add_node_row(g, g->force[d] + I, sum[1 + dim + d][k], dim, shape);
        }
    }
}

/* Defines the map for dimension D, shape S and transfer T. Points with the mean dilatation of their cells have a loop
 * of their own, so that the other loop contains no code for them. */
#define INSTANCE(D, S, T)                                                                                              \
    void p2g_##D##d_##S##_##T(struct grid *g, const struct particles *p, const struct transfer_data *t)                \
    {                                                                                                                  \
        if (transfer_uses_mean_dilatation(t, D)) {                                                                     \
            SCATTER(D, t, g, p,                                                                                        \
                    p2g_add_points_of_cell(&nodes, &points, &data, list, n, D, SHAPE_##S, TRANSFER_##T, true));        \
        } else {                                                                                                       \
            SCATTER(D, t, g, p,                                                                                        \
                    p2g_add_points_of_cell(&nodes, &points, &data, list, n, D, SHAPE_##S, TRANSFER_##T, false));       \
        }                                                                                                              \
    }
#define BOTH(D, S) TRANSFER_VARIANTS(INSTANCE, D, S)
MAP_VARIANTS(BOTH)
#undef BOTH
#undef INSTANCE

/* ---- single field of a few points -------------------------------------------------------------------------------- */

/* Adds `value`, a value of point i of p, to the nodal array `field`, distributed to the nodes of g with the weights N
 * of the first map (p2g). half_width: half the reference edge of a particle, l_p [m]; shape: shape function. */
static ALWAYS_INLINE void p2g_spread_point_value(const struct grid *g, const struct particles *p, real half_width,
                                                 int32_t i, real value, real *field, const int dim,
                                                 const enum shape shape)
{
    const struct cell c = cell_containing_point(g, p, i, dim, shape);
    struct cell_stencil s;
    cell_stencil_make(&s, g, &c, p, &i, 1, half_width, dim, shape);
    stencil_transpose(&s, dim, shape);
    const row_of_nodes spread = value * stencil_row_weights(&s, 0, g->h, dim, shape).N;
    FOR_TOUCHED(&s, 0, dim, shape)
    grid_add_node_row(g, field + cell_row_first_node(&c, g, k1, k2, dim),
                      spread * stencil_row_factor(&s, 0, k1, k2, dim, shape), dim, shape);
}

#define SPREAD(D, S)                                                                                                   \
    void spread_##D##d_##S(const struct grid *g, const struct particles *p, real half_width, const int32_t *list,      \
                           int64_t n, const real *value, real *field)                                                  \
    {                                                                                                                  \
        for (int64_t k = 0; k < n; k++)                                                                                \
            p2g_spread_point_value(g, p, half_width, list[k], value[k], field, D, SHAPE_##S);                          \
    }
MAP_VARIANTS(SPREAD)
#undef SPREAD

#endif
