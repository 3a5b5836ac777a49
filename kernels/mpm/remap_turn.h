/* The second map of MUSL for points in rotating groups (data/turning.h), in two halves. First points receive the change
 * of the nodal velocities, and the angular momentum that this interpolation loses is stored for each point. The caller
 * then distributes the angular momentum of each group to its points. At last nodes receive the momentum of the points,
 * whose velocity is extrapolated to the node with the spin of the group.
 *
 * Weights are computed at positions ahead of the points (g->ahead) for this reason: the strain of a step is a linear
 * map of the velocities of the points, and their change a linear map of the stress. Both maps are adjoint in the mass.
 * At fixed positions a step therefore conserves an energy exactly, which contains a term of first order in dt. In
 * flight through the grid the maps, and with them this term, change from step to step: a stretched block gains its
 * elastic energy several times over within 30 cells. With all weights (strain, mass, momentum) at the middle of the
 * flight of the step, the maps are to second order the mean of those before and after, and the first-order term
 * cancels. */
#ifndef CLEAVE_KERNELS_REMAP_TURN
#define CLEAVE_KERNELS_REMAP_TURN

#include "kernels/kernels.h"
#include "maps.h"
#include "scatter.h"
#include "shape.h"
#include "turn.h"

/* Component c of a vector product a x b is a_FIRST b_SECOND - a_SECOND b_FIRST. */
#define FIRST(c) (((c) + 1) % 3)
#define SECOND(c) (((c) + 2) % 3)
/* Index of the first component of a spin: in 2D spins have the component z only. */
#define SPIN_FROM(dim) ((dim) == 2 ? 2 : 0)

/* ---- nodes to points --------------------------------------------------------------------------------------------- */

/* Interpolates the change dv_I of the nodal velocities (g->force) to the points of stencil s (node weights of a few
 * points of cell c): the change of their velocity, gain[dim] = sum N dv_I [m/s], and the moments about the points,
 * moment[e][d] = sum N (x_I - x_p)_e (dv_I)_d [m^2/s]. shape: shape function. */
static ALWAYS_INLINE void rotating_remap_gather_velocity_gain_and_moments(
    const struct grid *g, const struct grid_cell *c, const struct cell_stencil *s, row_of_points *gain,
    row_of_points moment[DIM_MAX][DIM_MAX], const int dim, const enum shape shape)
{
    for (int d = 0; d < dim; d++) {
        gain[d] = points_broadcast(0);
        for (int e = 0; e < dim; e++) moment[e][d] = points_broadcast(0);
    }
    FOR_ANY_TOUCHED(s, dim, shape)
    {
        const row_of_points weight = stencil_row_transverse_weights(s, k1, k2, dim, shape);
        for (int d = 0; d < dim; d++) {
            const real *change = g->force[d] + cell_row_first_node_index(c, g, k1, k2, dim);
            row_of_points sum = points_broadcast(0), far = points_broadcast(0);
            FOR_NODES(dim, shape)
            {
                const row_of_points part = s->N[k] * change[grid_row_node_index_offset(g, k, dim, shape)];
                sum += part;
                far += part * stencil_all_point_distances_to_node(s, k, g->h, 0);
            }
            gain[d] += weight * sum;
            moment[0][d] += weight * far;
            for (int e = 1; e < dim; e++)
                moment[e][d] += weight * sum * stencil_all_point_distances_to_node(s, e == 1 ? k1 : k2, g->h, e);
        }
    }
}

/* Interpolates the change dv of the nodal velocities of g (g->force) to the points of stencil s (node weights of a few
 * points of cell c) for linear shape functions in 2D and 3D: the change of their velocity, gain[dim] [m/s], and the
 * moments about the points, moment[e][d] = sum N (x_I - x_p)_e (dv_I)_d [m^2/s]. For these shape functions sum N (x_I -
 * x_p)_e dv = h t_e (1 - t_e) d dv/dt_e at the position t in the cell (in node distances). */
static ALWAYS_INLINE void rotating_remap_gather_gain_and_moments_linear(const struct grid *g, const struct grid_cell *c,
                                                                        const struct cell_stencil *s,
                                                                        row_of_points *gain,
                                                                        row_of_points moment[DIM_MAX][DIM_MAX],
                                                                        const int dim)
{
    for (int d = 0; d < dim; d++) {
        row_of_points slope[DIM_MAX];
        gain[d] = cell_corners_interpolate_value_and_gradient(g, g->force[d] + c->node, s->t, slope, dim);
        for (int e = 0; e < dim; e++) moment[e][d] = g->h * (s->t[e] * (1 - s->t[e])) * slope[e];
    }
}

/* Interpolates the change dv_I of the nodal velocities (g->force) to the n points `list` (n <= AT_ONCE, points
 * processed together) of cell c and adds it to their velocities in p. Stores in t->turn the angular momentum [kg m^2/s]
 * that this interpolation loses at each point: m sum N (x_I - x_p) x dv_I. shape: shape function. */
static ALWAYS_INLINE void rotating_remap_update_velocity_of_points(const struct grid *g, const struct grid_cell *c,
                                                                   struct particles *p, const struct transfer_data *t,
                                                                   const int32_t *list, int n, const int dim,
                                                                   const enum shape shape)
{
    struct cell_stencil s;
    row_of_points gain[DIM_MAX], arm[DIM_MAX][DIM_MAX];
    cell_stencil_compute_weights(&s, g, c, p, list, n, t->half_width, dim, shape);
    if (HAS_CORNERS(dim, shape))
        rotating_remap_gather_gain_and_moments_linear(g, c, &s, gain, arm, dim);
    else
        rotating_remap_gather_velocity_gain_and_moments(g, c, &s, gain, arm, dim, shape);
    const row_of_points mass = points_gather_values(p->mass, s.point, dim);
    for (int d = 0; d < dim; d++)
        points_store(p->v[d], s.point, points_gather_values(p->v[d], s.point, dim) + gain[d], dim);
    for (int e = SPIN_FROM(dim); e < 3; e++)
        points_store(t->turn[e], s.point, mass * (arm[FIRST(e)][SECOND(e)] - arm[SECOND(e)][FIRST(e)]), dim);
}

#define GATHER(D, S)                                                                                                   \
    void turn_gather_##D##d_##S(const struct grid *g, struct particles *p, const struct transfer_data *t)              \
    {                                                                                                                  \
        const struct transfer_order *o = t->order;                                                                     \
        _Pragma("omp parallel")                                                                                        \
        {                                                                                                              \
            const struct grid nodes = *g; /* as in scatter.h */                                                        \
            struct particles points = *p;                                                                              \
            const struct transfer_data data = *t;                                                                      \
            _Pragma("omp for schedule(static)") for (int32_t k = 0; k < o->cells; k++)                                 \
            {                                                                                                          \
                const int32_t *list = o->particle + o->cell_start[k], n = o->cell_start[k + 1] - o->cell_start[k];     \
                const struct grid_cell c = cell_containing_point(&nodes, &points, list[0], D, SHAPE_##S);              \
                for (int m = 0; m < n; m++)                                                                            \
                    points_prefetch_mass_position_velocity_and_spin(&points, data.turn, list, m, D);                   \
                for (int m = 0; m < n; m += AT_ONCE(D))                                                                \
                    rotating_remap_update_velocity_of_points(&nodes, &c, &points, &data, list + m,                     \
                                                             points_count_of_next_batch(n - m, D), D, SHAPE_##S);      \
            }                                                                                                          \
        }                                                                                                              \
    }
MAP_VARIANTS_TURNING(GATHER)
#undef GATHER

/* ---- points to nodes --------------------------------------------------------------------------------------------- */

/* Sums over the points of a cell for every node that they reach, [quantity][row of nodes]: dim components of momentum
 * [kg m/s], then mass [kg], which is summed only if weights are computed ahead of the actual positions (g->ahead). */
typedef row_of_nodes turn_rows[DIM_MAX + 1][ROWS_MAX];

/* Adds the momentum m N (v + L (x_I - x_p)), with `add_mass` also the mass m N, of point number `point_in_stencil` of
 * stencil s (node weights of a few points of p) to `sum`, the nodal sums over the points of its cell of grid g. shape:
 * shape function; slope: velocity gradients L of the points of the stencil, from
 * rotating_group_velocity_gradients_of_points [1/s]. */
static ALWAYS_INLINE void rotating_remap_add_momentum_of_point(turn_rows sum, const struct grid *g,
                                                               const struct particles *p, const row_of_points *slope,
                                                               const struct cell_stencil *s, int point_in_stencil,
                                                               const bool add_mass, const int dim,
                                                               const enum shape shape)
{
    const int along = ROW_DIMS(dim, shape);
    const int64_t i = s->point[point_in_stencil];
    const row_of_nodes mass = p->mass[i] * stencil_row_weights_of_point(s, point_in_stencil, g->h, dim, shape).N;
    row_of_nodes momentum[DIM_MAX];
    for (int d = 0; d < dim; d++) {
        row_of_nodes speed = nodes_broadcast(p->v[d][i]);
        for (int e = 0; e < along; e++)
            speed += slope[d * dim + e][point_in_stencil] *
                     stencil_point_distances_to_row_nodes(s, point_in_stencil, g->h, e, dim, shape);
        momentum[d] = mass * speed;
    }
    FOR_TOUCHED(s, point_in_stencil, dim, shape)
    {
        const real weight = stencil_point_row_transverse_weight(s, point_in_stencil, k1, k2, dim, shape);
        for (int d = 0; d < dim; d++) {
            row_of_nodes given = momentum[d];
            for (int e = along; e < dim; e++)
                given +=
                    mass * (slope[d * dim + e][point_in_stencil] *
                            stencil_point_distance_to_row(s, point_in_stencil, g->h, e, e == 1 ? k1 : k2, dim, shape));
            sum[d][PATCH(dim, shape)] += weight * given;
        }
        if (add_mass) sum[dim][PATCH(dim, shape)] += weight * mass;
    }
}

/* Adds the momentum of the points list[n] of one cell to the nodes of the grid g, with their velocity extrapolated to
 * each node (rotating_remap_add_momentum_of_point); also their mass if weights are computed ahead of the actual
 * positions (g->ahead). p: particles; t: inputs of the transfer; shape: shape function. */
static ALWAYS_INLINE void rotating_remap_add_momentum_of_cell_points(const struct grid *g, const struct particles *p,
                                                                     const struct transfer_data *t, const int32_t *list,
                                                                     int n, const int dim, const enum shape shape)
{
    const struct grid_cell c = cell_containing_point(g, p, list[0], dim, shape);
    const bool massive = grid_weights_use_half_step_ahead_positions(g, dim);
    turn_rows sum;
    FOR_ROWS(dim, shape)
    for (int d = 0; d <= dim; d++) sum[d][PATCH(dim, shape)] = nodes_broadcast(0);
    for (int k = 0; k < n; k += AT_ONCE(dim)) {
        struct cell_stencil s;
        const int points = points_count_of_next_batch(n - k, dim);
        cell_stencil_compute_weights(&s, g, &c, p, list + k, points, t->half_width, dim, shape);
        stencil_transpose_weights_to_node_lanes(&s, dim, shape);
        row_of_points slope[DIM_MAX * DIM_MAX];
        rotating_group_velocity_gradients_of_points(t, s.point, -0.5 * t->dt, slope, dim);
        for (int at = 0; at < points; at++) {
            points_prefetch_mass_position_velocity_and_spin(p, t->turn, list, k + at, dim);
            rotating_remap_add_momentum_of_point(sum, g, p, slope, &s, at, massive, dim, shape);
        }
    }
    FOR_ROWS(dim, shape)
    for (int d = 0; d < dim + massive; d++)
        grid_field_add_values_of_node_row(
            g, (d < dim ? g->momentum[d] : g->mass) + cell_row_first_node_index(&c, g, k1, k2, dim),
            sum[d][PATCH(dim, shape)], dim, shape);
}

#define TURN_SCATTER(D, S)                                                                                             \
    void turn_scatter_##D##d_##S(struct grid *g, const struct particles *p, const struct transfer_data *t)             \
    {                                                                                                                  \
        SCATTER(D, t, g, p,                                                                                            \
                rotating_remap_add_momentum_of_cell_points(&nodes, &points, &data, list, n, D, SHAPE_##S));            \
    }
MAP_VARIANTS_TURNING(TURN_SCATTER)
#undef TURN_SCATTER

#endif
