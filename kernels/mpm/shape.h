/* Shape functions of the background grid, and the nodes of a cell.
 *
 * t is the distance of a point from the lower node of its cell, l half the width of its particle, both divided by the
 * node distance h. A shape function gives the weights N and slopes dN/dt of four nodes in a row, from the node below
 * the cell on: enough for every shape function, and the same four nodes for all points of a cell. In two and three
 * dimensions shape functions are products. All are partitions of unity and reproduce linear fields. Linear and GIMP:
 * Bardenhagen & Kober 2004, Zeng et al. 2021, eq. 9. */
#ifndef CLEAVE_KERNELS_SHAPE
#define CLEAVE_KERNELS_SHAPE

#include "kernels/kernels.h"
#include "row.h"

/* ---- one direction, a few points ---------------------------------------------------------------------------------
 *
 * Weights are computed for a few points of a cell at once, one point per lane, so that no sum runs across lanes. */

/* Computes weights N and slopes dN/dt of linear (hat) functions at the four nodes of a row (nodes around a cell along
 * one axis), for a few points, one per lane: 1 - t and t at the two nodes of the cell, 0 at the outer nodes. t:
 * distance from the lower node of the cell, in node distances. */
static ALWAYS_INLINE void shape_functions_evaluate_linear(row_of_points t, row_of_points N[ROW], row_of_points dN[ROW])
{
    N[0] = N[3] = dN[0] = dN[3] = points_broadcast(0);
    N[1] = 1 - t, N[2] = t;
    dN[1] = points_broadcast(-1), dN[2] = points_broadcast(1);
}

/* Computes weights N and slopes dN/dt of GIMP shape functions at the four nodes of a row (nodes around a cell along one
 * axis), for a few points, one per lane: linear (hat) functions averaged over the width 2l of the particle. t: distance
 * from the lower node of the cell, l <= 1: half width, inverse_width: 1/(2 l), all in node distances.
 *
 * A particle that extends over the lower end of the cell by b = (l - t)_+ gives the node below the cell the weight
 * b^2/4l, and changes the averages of the two hats with a kink at that end by multiples of b^2/4l; likewise at the
 * upper end. Computed in this form, the weight of a node that the particle just touches has a correct size and is never
 * below 0. This matters, since the node may have no other mass, and momentum that a node without mass receives is lost.
 * GIMP with 2l <= 1 has three nodes with weights. A stretched particle (cpGIMP) reaches all four; contiguous particles
 * then cover every hat without gap or overlap, and a uniform stress leaves no residual (Bardenhagen & Kober 2004). */
static ALWAYS_INLINE void shape_functions_evaluate_gimp(row_of_points t, row_of_points l, row_of_points inverse_width,
                                                        row_of_points N[ROW], row_of_points dN[ROW])
{
    const row_of_points rest = 1 - t, below = points_max(l - t, points_broadcast(0)),
                        above = points_max(l - rest, points_broadcast(0));
    dN[0] = -below * inverse_width, dN[3] = above * inverse_width;
    N[0] = -0.5 * below * dN[0], N[3] = 0.5 * above * dN[3];
    N[1] = rest - 2 * N[0] + N[3], N[2] = t + N[0] - 2 * N[3];
    dN[1] = dN[3] - 2 * dN[0] - 1, dN[2] = dN[0] - 2 * dN[3] + 1;
}

/* Computes weights N and slopes dN/dt of the cubic B-spline at the four nodes of a row (nodes around a cell along one
 * axis), for a few points, one per lane. t: distance from the lower node of the cell, in node distances. From either
 * end the weights are t^3/6 at the outer and 2/3 - t^2 + t^3/2 at the inner node. */
static ALWAYS_INLINE void shape_functions_evaluate_cubic_b_spline(row_of_points t, row_of_points N[ROW],
                                                                  row_of_points dN[ROW])
{
    const row_of_points rest = 1 - t, t2 = t * t, rest2 = rest * rest;
    N[0] = rest2 * rest * (1.0 / 6), N[3] = t2 * t * (1.0 / 6);
    N[1] = 2.0 / 3 + t2 * (0.5 * t - 1), N[2] = 2.0 / 3 + rest2 * (0.5 * rest - 1);
    dN[0] = -0.5 * rest2, dN[3] = 0.5 * t2;
    dN[1] = t * (1.5 * t - 2), dN[2] = rest * (2 - 1.5 * rest);
}

/* Corrects the weights N of the four nodes of a row (nodes around a cell along one axis), for a few points, one per
 * lane, so that they add up to 1 without round-off. Every map multiplies momentum by sum N; on a lattice all points
 * have the same round-off, so that an error would grow with the number of steps. The missing part is added to the
 * nearer node of the cell, whose weight is never small. t: distance from the lower node of the cell, in node
 * distances. */
static ALWAYS_INLINE void shape_functions_normalise_sum_to_one(row_of_points t, row_of_points N[ROW])
{
    const row_of_points missing = 1 - ((N[0] + N[2]) + (N[1] + N[3]));
    N[1] += points_choose_by_sign(t - 0.5, missing, points_broadcast(0));
    N[2] += points_choose_by_sign(t - 0.5, points_broadcast(0), missing);
}

/* Computes weights N and slopes dN/dt of the shape function `shape` at the four nodes of a row (nodes around a cell
 * along one axis), for a few points, one per lane. t: distance from the lower node of the cell, l: half width of the
 * particle, inverse_width: 1/(2 l), in node distances; l and inverse_width are read for GIMP and cpGIMP only. GIMP with
 * l = 1/2, the mean of a hat over a whole cell, is the quadratic B-spline. */
static ALWAYS_INLINE void shape_functions_evaluate_at_row_nodes(const enum shape shape, row_of_points t,
                                                                row_of_points l, row_of_points inverse_width,
                                                                row_of_points N[ROW], row_of_points dN[ROW])
{
    switch (shape) {
    case SHAPE_LINEAR:
        shape_functions_evaluate_linear(t, N, dN);
        return;
    case SHAPE_CUBIC:
        shape_functions_evaluate_cubic_b_spline(t, N, dN);
        break;
    default:
        shape_functions_evaluate_gimp(t, l, inverse_width, N, dN);
    }
    shape_functions_normalise_sum_to_one(t, N);
}

/* ---- nodes of a cell ---------------------------------------------------------------------------------------------
 *
 * The points of a cell share a patch of nodes: rows of four along x, side by side in the directions across. Linear
 * shapes reach only the corners; in two and three dimensions a row holds corners of the cell instead, so that no lane
 * of a vector is idle: all of them, or in 3D with rows of four nodes (ROW_NODES) those of the lower face along z, then
 * those of the upper one. Bit d of the number of a corner is set on the upper side in direction d. */

enum { ACROSS = 4, ROWS_MAX = ACROSS * ACROSS };

#define HAS_CORNERS(dim, shape) ((shape) == SHAPE_LINEAR && (dim) > 1)
/* Number of axes along which the nodes of a row differ: x alone or, for corners of a cell, as many as a row has room
 * for. */
#define ROW_DIMS(dim, shape) (!HAS_CORNERS(dim, shape) ? 1 : ROW_NODES == 8 ? (dim) : 2)
/* Number of rows of nodes along y and along z, around one cell, that a shape function can reach; and their product. */
#define ROWS_Y(dim, shape) ((dim) > 1 && !HAS_CORNERS(dim, shape) ? ACROSS : 1)
#define ROWS_Z(dim, shape) ((dim) == ROW_DIMS(dim, shape) || (dim) < 3 ? 1 : HAS_CORNERS(dim, shape) ? 2 : ACROSS)
#define ROWS(dim, shape) (ROWS_Y(dim, shape) * ROWS_Z(dim, shape))

/* True if loops visit only the rows of nodes in which a point has weights: in 3D, for shape functions with three nodes
 * per direction. In 2D adding weights of 0 costs less than finding these rows. */
#define SKIPS(dim, shape) ((dim) > 2 && (shape) == SHAPE_GIMP)

/* Loop over the nodes k of a row; leaves out the two outer nodes of linear shapes, whose weights are 0. */
#define ROW_END(dim, shape) ((shape) == SHAPE_LINEAR && !HAS_CORNERS(dim, shape) ? 1 : 0)
#define FOR_NODES(dim, shape) for (int k = ROW_END(dim, shape); k < ROW - ROW_END(dim, shape); k++)

/* Loops over the rows of nodes k1 (along y), k2 (along z) around a cell: FOR_ROWS over all rows, FOR_TOUCHED over the
 * rows in which point `at` of the stencil s has weights, FOR_ANY_TOUCHED over the rows in which any point of s has
 * weights. */
#define FOR_SPAN(low2, end2, low1, end1)                                                                               \
    for (int k2 = (low2), above = (end2); k2 < above; k2++)                                                            \
        for (int k1 = (low1), beyond = (end1); k1 < beyond; k1++)
#define FOR_ROWS(dim, shape) FOR_SPAN(0, ROWS_Z(dim, shape), 0, ROWS_Y(dim, shape))
#define FOR_TOUCHED(s, at, dim, shape)                                                                                 \
    FOR_SPAN(SKIPS(dim, shape) ? (s)->low[2][at] : 0, SKIPS(dim, shape) ? k2 + 3 : ROWS_Z(dim, shape),                 \
             SKIPS(dim, shape) ? (s)->low[1][at] : 0, SKIPS(dim, shape) ? k1 + 3 : ROWS_Y(dim, shape))
#define FOR_ANY_TOUCHED(s, dim, shape)                                                                                 \
    FOR_SPAN(SKIPS(dim, shape) ? (s)->lowest[2] : 0, SKIPS(dim, shape) ? (s)->end[2] : ROWS_Z(dim, shape),             \
             SKIPS(dim, shape) ? (s)->lowest[1] : 0, SKIPS(dim, shape) ? (s)->end[1] : ROWS_Y(dim, shape))
/* Index of row k1, k2 (variables of the enclosing loop) in arrays with one entry for each row of nodes around a
 * cell. */
#define PATCH(dim, shape) (k2 * ROWS_Y(dim, shape) + k1)

/* A cell of the background grid and the lowest of the nodes that points in the cell reach. */
struct grid_cell {
    int64_t node;        /* index of the lowest of these nodes */
    real place[DIM_MAX]; /* lower corner of the cell, in node distances from the anchor */
};

/* Returns the cell of grid g that contains point i of p, with the lowest node at which a point of the cell has a
 * weight. shape: shape function of the grid. */
static ALWAYS_INLINE struct grid_cell cell_containing_point(const struct grid *g, const struct particles *p, int64_t i,
                                                            const int dim, const enum shape shape)
{
    struct grid_cell c = {0};
    for (int d = 0; d < dim; d++) {
        const int64_t k = grid_cell_index_at(g, d, p->x[d][i]);
        c.place[d] = (real)k;
        c.node += (k - (HAS_CORNERS(dim, shape) ? 0 : 1) - g->first[d]) * g->stride[d];
    }
    return c;
}

/* Returns the index in grid g of the first node of a row (along x) of the nodes at which points of cell c have weights.
 * k1, k2: number of the row along y and along z, from 0. */
static ALWAYS_INLINE int64_t cell_row_first_node_index(const struct grid_cell *c, const struct grid *g, int k1, int k2,
                                                       const int dim)
{
    return c->node + (dim > 1 ? k1 * g->stride[1] : 0) + (dim > 2 ? k2 * g->stride[2] : 0);
}

/* Returns the index of node k (from 0) of a row of nodes of a cell of grid g, less the index of the first node of the
 * row. A row is four nodes along x or, for linear shape functions (shape) in 2D and 3D, all corners of the cell. */
static ALWAYS_INLINE int64_t grid_row_node_index_offset(const struct grid *g, int k, const int dim,
                                                        const enum shape shape)
{
    return HAS_CORNERS(dim, shape) ? k % 2 + k / 2 % 2 * g->stride[1] + k / 4 * g->stride[2] : k;
}

/* Adds the values a of the ROW nodes of a row of nodes to a nodal array of grid g. to: entry of the first node of the
 * row in this array; shape: shape function, which determines the row. */
static ALWAYS_INLINE void grid_field_add_values_of_node_row(const struct grid *g, real *to, row_of_nodes a,
                                                            const int dim, const enum shape shape)
{
    if (!HAS_CORNERS(dim, shape)) {
        *(row_anywhere *)to += a;
        return;
    }
    for (int k = 0; k < ROW; k += 2)
        *(pair_anywhere *)(to + grid_row_node_index_offset(g, k, dim, shape)) += (pair_of_nodes){a[k], a[k + 1]};
}

/* Returns for the eight (3D) or four (2D) corners of a cell, one per lane, 1 if the corner is on the upper side along
 * axis `axis`, 0 if it is on the lower side. */
static ALWAYS_INLINE row_of_nodes cell_corners_one_if_on_upper_side_of_axis(int axis)
{
#if ROW_NODES == 8
    return axis == 0   ? (row_of_nodes){0, 1, 0, 1, 0, 1, 0, 1}
           : axis == 1 ? (row_of_nodes){0, 0, 1, 1, 0, 0, 1, 1}
                       : (row_of_nodes){0, 0, 0, 0, 1, 1, 1, 1};
#else
    return axis == 0 ? (row_of_nodes){0, 1, 0, 1} : (row_of_nodes){0, 0, 1, 1};
#endif
}

/* Interpolates a nodal field linearly between the corners of a cell, by its polynomial in the positions t of a few
 * points in the cell, in node distances. at: entry of the nodal field, an array over the nodes of g, at the lowest
 * corner of the cell. Stores the derivatives by t_d in slope[dim] and returns the values. Coefficients are scalars: as
 * an array the compiler would keep them in memory. */
static ALWAYS_INLINE row_of_points cell_corners_interpolate_value_and_gradient(const struct grid *g, const real *at,
                                                                               const row_of_points *t,
                                                                               row_of_points *slope, const int dim)
{
    const real *next = at + g->stride[1];
    const real a = at[0], a_x = at[1] - a, a_y = next[0] - a, a_xy = (next[1] - next[0]) - a_x;
    if (dim == 2) {
        slope[0] = a_x + t[1] * a_xy, slope[1] = a_y + t[0] * a_xy;
        return (a + t[1] * a_y) + t[0] * slope[0];
    }
    const real *above = at + g->stride[2], *last = next + g->stride[2];
    const real b = above[0], b_x = above[1] - b, b_y = last[0] - b, b_xy = (last[1] - last[0]) - b_x;
    const real a_z = b - a, a_xz = b_x - a_x, a_yz = b_y - a_y, a_xyz = b_xy - a_xy;
    const row_of_points y = a_y + t[2] * a_yz, xy = a_xy + t[2] * a_xyz;
    slope[0] = (a_x + t[2] * a_xz) + t[1] * xy, slope[1] = y + t[0] * xy;
    slope[2] = (a_z + t[1] * a_yz) + t[0] * (a_xz + t[1] * a_xyz);
    return (a + t[2] * a_z) + t[1] * y + t[0] * slope[0];
}

/* ---- weights of a few points of a cell --------------------------------------------------------------------------- */

/* A stencil: weights and slopes of the shape functions of a few points of a cell, one point per lane. The weight of a
 * node is N, which depends on the position of the node in its row, times the factors A of the row in the directions
 * across. */
struct cell_stencil {
    int32_t point[POINT_NUMBERS];                /* indices of the points (points_copy_list_indices_to_lanes) */
    row_of_points x[DIM_MAX];                    /* position [m] */
    row_of_points t[DIM_MAX];                    /* position in the cell, in cell edges from the lower node [1] */
    row_of_points N[ROW], D[DIM_MAX][ROW];       /* of the nodes of a row: weights [1], slopes along it [1/m] */
    row_of_nodes from_N[POINTS], from_D[POINTS]; /* N and D by point, of maps to nodes */
    /* factors of the rows by direction across: weights [1], slopes [1/m] */
    row_of_points A[DIM_MAX][ACROSS], B[DIM_MAX][ACROSS];
    int low[DIM_MAX][POINTS];          /* first row that each point touches (shapes with three nodes) */
    int lowest[DIM_MAX], end[DIM_MAX]; /* first row that any point touches; one past the last */
};

/* Shape functions of the nodes of a row at one point, one node per lane. N: weights [1]; D: slopes along the axes along
 * which the nodes of the row differ [1/m]. */
struct node_row_weights {
    row_of_nodes N, D[DIM_MAX];
};

/* Largest half width of a cpGIMP particle [node distances], since the four nodes of a row allow no more. A particle
 * that is stretched further keeps this width, so that gaps open between particles (numerical fracture): with two
 * particles per cell at a stretch of 4. */
#define HALF_WIDTH_MOST 1

/* Computes the weights s->N and slopes s->D of linear shape functions in 2D and 3D, as products of hat functions, for a
 * few points at the positions s->t in the cell. A row then holds corners of the cell; if two rows along z hold them,
 * also the factors s->A[2] and s->B[2] of these rows. inverse_node_distance: 1/h of the node distance h [1/m]. */
static ALWAYS_INLINE void stencil_compute_corner_weights(struct cell_stencil *s, real inverse_node_distance,
                                                         const int dim)
{
    const int along = ROW_DIMS(dim, SHAPE_LINEAR);
    for (int k = 0; k < ROW; k++) {
        s->N[k] = points_broadcast(1);
        for (int d = 0; d < along; d++) {
            s->N[k] *= k >> d & 1 ? s->t[d] : 1 - s->t[d];
            s->D[d][k] = points_broadcast(k >> d & 1 ? inverse_node_distance : -inverse_node_distance);
            for (int e = 0; e < along; e++)
                if (e != d) s->D[d][k] *= k >> e & 1 ? s->t[e] : 1 - s->t[e];
        }
    }
    if (along == dim) return;
    s->A[2][0] = 1 - s->t[2], s->A[2][1] = s->t[2];
    s->B[2][0] = points_broadcast(-inverse_node_distance), s->B[2][1] = points_broadcast(inverse_node_distance);
}

/* Finds in which rows of nodes along axis d the points of stencil s (node weights of a few points) have weights, for
 * shapes with three nodes per direction: a point with t < l has none in the upper outer row, others none in the lower
 * outer row. Stores the first row with a weight of each point in s->low[d], the first and the end of the rows with
 * weights of any point in s->lowest[d] and s->end[d]. l: half widths in node distances. The code has no branches,
 * because on a lattice t = l up to round-off and the result is unpredictable. */
static ALWAYS_INLINE void stencil_find_node_range_with_nonzero_weights(struct cell_stencil *s, row_of_points l, int d)
{
    const int all = (1 << POINTS) - 1, upper = ~points_sign_bits(s->t[d] - l) & all;
    for (int k = 0; k < POINTS; k++) s->low[d][k] = upper >> k & 1;
    s->lowest[d] = upper == all, s->end[d] = 3 + (upper > 0);
}

/* Computes in stencil s the node weights and slopes of a few points of p in a cell along axis d for the shape function
 * `shape`; not for linear shapes in 2D and 3D. inverse_node_distance: 1/h of the node distance h [1/m]; half_width:
 * transfer_data.half_width [m]. */
static ALWAYS_INLINE void stencil_compute_axis_weights(struct cell_stencil *s, const struct particles *p,
                                                       real inverse_node_distance, real half_width, int d,
                                                       const int dim, const enum shape shape)
{
    row_of_points l = points_broadcast(half_width * inverse_node_distance),
                  inverse_width = points_broadcast(0.5 / (half_width * inverse_node_distance));
    row_of_points N[ROW], dN[ROW];
    if (shape == SHAPE_CPGIMP) {
        l = points_min(l * points_gather_values(p->stretch[d], s->point, dim), points_broadcast(HALF_WIDTH_MOST));
        inverse_width = 0.5 / l;
    }
    shape_functions_evaluate_at_row_nodes(shape, s->t[d], l, inverse_width, N, dN);
    for (int k = 0; k < ROW; k++) {
        if (d == 0)
            s->N[k] = N[k], s->D[0][k] = dN[k] * inverse_node_distance;
        else
            s->A[d][k] = N[k], s->B[d][k] = dN[k] * inverse_node_distance;
    }
    if (SKIPS(dim, shape) && d > 0) stencil_find_node_range_with_nonzero_weights(s, l, d);
}

/* Returns true if the weights of points on grid g are computed at positions ahead of the actual ones, shifted by the
 * mean motion of all points in half a time step (g->ahead is not 0). */
static ALWAYS_INLINE bool grid_weights_use_half_step_ahead_positions(const struct grid *g, const int dim)
{
    bool ahead = false;
    for (int d = 0; d < dim; d++) ahead |= g->ahead[d] != 0;
    return ahead;
}

/* Computes the stencil s: weights and slopes of the shape functions of the n points `list` of p (n <= AT_ONCE, points
 * processed together) in cell c of grid g. half_width: transfer_data.half_width [m]. */
static ALWAYS_INLINE void cell_stencil_compute_weights(struct cell_stencil *s, const struct grid *g,
                                                       const struct grid_cell *c, const struct particles *p,
                                                       const int32_t *list, int n, real half_width, const int dim,
                                                       const enum shape shape)
{
    const real inverse = 1 / g->h;
    points_copy_list_indices_to_lanes(s->point, list, n, dim);
    for (int d = 0; d < dim; d++) {
        s->x[d] = points_gather_values(p->x[d], s->point, dim);
        s->t[d] = (s->x[d] - g->anchor[d]) * inverse - c->place[d] + g->ahead[d]; /* grid_coordinate_in_cell_lengths */
    }
    if (HAS_CORNERS(dim, shape))
        stencil_compute_corner_weights(s, inverse, dim);
    else
        for (int d = 0; d < dim; d++) stencil_compute_axis_weights(s, p, inverse, half_width, d, dim, shape);
}

/* Transposes the weights and slopes of a row of nodes in stencil s (node weights of a few points) from one lane per
 * point to one lane per node (s->from_N, s->from_D), for maps that add to nodes. Does nothing for linear shape
 * functions (shape) in 2D and 3D. */
static ALWAYS_INLINE void stencil_transpose_weights_to_node_lanes(struct cell_stencil *s, const int dim,
                                                                  const enum shape shape)
{
#if ROW_NODES == 4
    if (HAS_CORNERS(dim, shape)) return;
    rows_transpose_points_to_nodes(s->N, s->from_N);
    rows_transpose_points_to_nodes(s->D[0], s->from_D);
#else
    (void)s, (void)dim, (void)shape;
#endif
}

/* Returns weights and slopes of the nodes of a row (along x) for point number `point_in_stencil` of stencil s (node
 * weights of a few points), one node per lane. stencil_transpose_weights_to_node_lanes must have been called. h: node
 * distance [m]. For linear shape functions (shape) in 2D and 3D weights and slopes are computed anew, which is cheaper
 * than transposing.
 */
static ALWAYS_INLINE struct node_row_weights stencil_row_weights_of_point(const struct cell_stencil *s,
                                                                          int point_in_stencil, real h, const int dim,
                                                                          const enum shape shape)
{
    if (!HAS_CORNERS(dim, shape))
        return (struct node_row_weights){s->from_N[point_in_stencil], {s->from_D[point_in_stencil]}};
    struct node_row_weights own = {.N = nodes_broadcast(1)};
    const int along = ROW_DIMS(dim, shape);
    row_of_nodes hat[DIM_MAX], sign[DIM_MAX];
    for (int d = 0; d < along; d++) {
        sign[d] = 2 * cell_corners_one_if_on_upper_side_of_axis(d) - 1;
        hat[d] = (1 - cell_corners_one_if_on_upper_side_of_axis(d)) + s->t[d][point_in_stencil] * sign[d];
    }
    for (int d = 0; d < along; d++) {
        own.N *= hat[d];
        own.D[d] = sign[d] * (1 / h);
        for (int e = 0; e < along; e++)
            if (e != d) own.D[d] *= hat[e];
    }
    return own;
}

/* Returns the product [1] of the shape functions along y and z for the row of nodes number k1 along y and k2 along z;
 * times s->N, the shape function along the row, it is the weight of a node. s: node weights of a few points, one per
 * lane; shape: shape function. */
static ALWAYS_INLINE row_of_points stencil_row_transverse_weights(const struct cell_stencil *s, int k1, int k2,
                                                                  const int dim, const enum shape shape)
{
    row_of_points weight = points_broadcast(1);
    if (dim > 1 && !HAS_CORNERS(dim, shape)) weight *= s->A[1][k1];
    if (ROWS_Z(dim, shape) > 1) weight *= s->A[2][k2];
    return weight;
}

/* Returns the derivative [1/m] along axis d (1 or 2) of stencil_row_transverse_weights, the product of the shape
 * functions along y and z for a row of nodes. s: node weights of a few points, one per lane; k1, k2: number of the row
 * along y and z; shape: shape function. */
static ALWAYS_INLINE row_of_points stencil_row_transverse_weight_slopes(const struct cell_stencil *s, int k1, int k2,
                                                                        int d, const int dim, const enum shape shape)
{
    row_of_points slope = points_broadcast(1);
    if (dim > 1 && !HAS_CORNERS(dim, shape)) slope *= d == 1 ? s->B[1][k1] : s->A[1][k1];
    if (ROWS_Z(dim, shape) > 1) slope *= d == 2 ? s->B[2][k2] : s->A[2][k2];
    return slope;
}

/* Returns the product [1] of the shape functions along y and z for the row of nodes number k1 along y and k2 along z,
 * for point number `point_in_stencil` of stencil s (node weights of a few points). shape: shape function. */
static ALWAYS_INLINE real stencil_point_row_transverse_weight(const struct cell_stencil *s, int point_in_stencil,
                                                              int k1, int k2, const int dim, const enum shape shape)
{
    real weight = 1;
    if (dim > 1 && !HAS_CORNERS(dim, shape)) weight *= s->A[1][k1][point_in_stencil];
    if (ROWS_Z(dim, shape) > 1) weight *= s->A[2][k2][point_in_stencil];
    return weight;
}

/* Returns the derivative [1/m] along axis d (1 or 2) of stencil_point_row_transverse_weight, the product of shape
 * functions that all nodes of a row (nodes along x) share, for point number `point_in_stencil` of stencil s (node
 * weights of a few points). k1, k2: number of the row along y and z. */
static ALWAYS_INLINE real stencil_point_row_transverse_weight_slope(const struct cell_stencil *s, int point_in_stencil,
                                                                    int k1, int k2, int d, const int dim,
                                                                    const enum shape shape)
{
    real slope = 1;
    if (dim > 1 && !HAS_CORNERS(dim, shape))
        slope *= d == 1 ? s->B[1][k1][point_in_stencil] : s->A[1][k1][point_in_stencil];
    if (ROWS_Z(dim, shape) > 1) slope *= d == 2 ? s->B[2][k2][point_in_stencil] : s->A[2][k2][point_in_stencil];
    return slope;
}

/* Returns the signed distances [m] along axis d from point number `point_in_stencil` of stencil s (node weights of a
 * few points) to the nodes of a row (along x), one node per lane. d: an axis along which the nodes of a row differ; h:
 * node distance [m]; shape: shape function. */
static ALWAYS_INLINE row_of_nodes stencil_point_distances_to_row_nodes(const struct cell_stencil *s,
                                                                       int point_in_stencil, real h, int d,
                                                                       const int dim, const enum shape shape)
{
#if ROW_NODES == 4
    const row_of_nodes nodes =
        HAS_CORNERS(dim, shape) ? cell_corners_one_if_on_upper_side_of_axis(d) : (row_of_nodes){-1, 0, 1, 2};
#else
    const row_of_nodes nodes = cell_corners_one_if_on_upper_side_of_axis(d);
    (void)shape, (void)dim;
#endif
    return (nodes - s->t[d][point_in_stencil]) * h;
}

/* Returns the signed distances [m] along axis d from all points of stencil s (node weights of a few points), one per
 * lane, to node k of a row (along x) or, if d is y or z, to row number k; not for linear shapes in 2D and 3D. h: node
 * distance [m]. */
static ALWAYS_INLINE row_of_points stencil_all_point_distances_to_node(const struct cell_stencil *s, int k, real h,
                                                                       int d)
{
    return (k - 1 - s->t[d]) * h;
}

/* Returns the signed distance [m] along axis d from point number `point_in_stencil` of stencil s (node weights of a few
 * points) to the row of nodes number k. d: axis y or z, across the rows; h: node distance [m]; shape: shape function.
 */
static ALWAYS_INLINE real stencil_point_distance_to_row(const struct cell_stencil *s, int point_in_stencil, real h,
                                                        int d, int k, const int dim, const enum shape shape)
{
    return (k - (HAS_CORNERS(dim, shape) ? 0 : 1) - s->t[d][point_in_stencil]) * h;
}

#endif
