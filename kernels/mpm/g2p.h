/* Grid to particles (G2P): computes position, velocity gradient L, stress and volume of the material points
 * at the end of the step, and sets FLAG_STRESSED where the largest principal stress exceeds the conversion
 * stress. Zeng et al. 2022, eqs. 32, 40, 43-49, corrected: L from remapped velocities, rotation W sigma -
 * sigma W; APIC: Jiang et al. 2015. With the shape function N of node I, its velocity v_I, and its velocity
 * v2_I after the remapping of MUSL (remap.h):
 *     FLIP (MUSL)    x += dt sum N v_I,   L = sum v2_I (x) grad N
 *       with bonds   x += dt sum N v2_I   for points with bonds, and for points that rotate (data/turning.h)
 *     APIC           v = sum N v_I,   x += dt v,   L = sum v_I (x) grad N
 * Eq. 40 moves all points with v_I. Bond forces act on points through N M^-1 N^T (M: nodal masses), whose
 * adjoint in the mass is the remapping. Where bonds depend on the positions of points, motion with v2_I makes
 * the linear step the leap-frog scheme of one energy. With v_I each displacement has the extra term dt^2 (1 -
 * N M^-1 N^T m) N M^-1 f (m: point masses, f: nodal forces), and bonds gain energy. Points without bonds move
 * with v_I, since their weights follow the positions in long runs: a free rotating plate with GIMP shapes
 * loses a tenth of its energy in 1e5 steps with v_I, and gains 40 % with v2_I
 * (bench/stability/limits_motion.c). Each point is written by one thread. */
#ifndef CLEAVE_KERNELS_G2P
#define CLEAVE_KERNELS_G2P

#include "kernels/kernels.h"
#include "dilatation.h"
#include "maps.h"
#include "points_flow.h"
#include "scatter.h"
#include "shape.h"
#include "stress.h"

/* Returns the elastic constants [Pa] of a few material points, one per lane. point: indices of the points in p; t:
 * constants of the materials. Fast if all points have one material. */
static ALWAYS_INLINE struct elastic_points points_load_elastic_constants(const struct particles *p,
                                                                         const struct transfer_data *t,
                                                                         const int32_t *point, const int dim)
{
    const struct elastic *first = &t->elastic[p->material[point[0]]];
    struct elastic_points m = {points_broadcast(first->c11), points_broadcast(first->c12),
                               points_broadcast(first->shear), points_broadcast(first->trigger), first->surface.g0 > 0};
    for (int k = 1; k < AT_ONCE(dim); k++) {
        const struct elastic *own = &t->elastic[p->material[point[k]]];
        if (own == first) continue;
        m.surface |= own->surface.g0 > 0;
        m.c11[k] = own->c11, m.c12[k] = own->c12, m.shear[k] = own->shear, m.trigger[k] = own->trigger;
    }
    return m;
}

/* Updates stress [Pa], volume [m^3] and (cpGIMP) stretches of a few points of p in one cell, one per lane, from their
 * velocity gradients L[dim dim] [1/s], and sets FLAG_STRESSED on points whose stress requires conversion to
 * peridynamics (stress_requires_conversion_to_pd). m: elastic constants by lane; point[points]: indices of the points;
 * return_queue: list to which points of yielding materials are appended for the return mapping (points_flow.h); t:
 * inputs of the transfer; shape: shape function. The volume changes by the trace of the strain. In plane stress the
 * elastic strain through the thickness is left out, which changes the volume by less than 0.5 % below 1 % strain; the
 * plastic one is added with the return mapping. */
static ALWAYS_INLINE void points_update_stress(struct particles *p, const struct transfer_data *t,
                                               struct return_mapping_queue *return_queue,
                                               const struct elastic_points *m, const int32_t *point, int points,
                                               const row_of_points *L, const int dim, const enum shape shape)
{
    const int n = dim * (dim + 1) / 2;
    row_of_points stress[SYM_MAX];
    for (int c = 0; c < n; c++) stress[c] = points_gather_values(p->stress[c], point, dim);
    const row_of_points volume = points_gather_values(p->volume, point, dim),
                        trace = stress_update_and_return_strain_trace(stress, L, m, t->dt, dim),
                        after = volume + volume * trace;
    points_store(p->volume, point, after, dim);
    const bool flows = __builtin_expect(t->laws, 0), at_once = POINTS_LANES == 8;
    if (flows && !at_once) return_mapping_queue_append(return_queue, point, points, L, stress, after, dim);
    for (int c = 0; c < n && !flows; c++) points_store(p->stress[c], point, stress[c], dim);
    if (shape == SHAPE_CPGIMP)
        for (int d = 0; d < dim; d++) {
            const row_of_points stretch = points_gather_values(p->stretch[d], point, dim);
            points_store(p->stretch[d], point, stretch + stretch * (t->dt * L[d * dim + d]), dim);
        }
    int near = points_sign_bits(m->trigger - stress_largest_principal_upper_bounds(stress, dim));
    if (__builtin_expect(m->surface, 0)) near = (1 << AT_ONCE(dim)) - 1;
    for (int k = 0; k < AT_ONCE(dim) && __builtin_expect(near, 0); k++) {
        real own[SYM_MAX];
        for (int c = 0; c < n; c++) own[c] = stress[c][k];
        const int32_t i = point[k];
        if (near >> k & 1 && stress_requires_conversion_to_pd(&t->elastic[p->material[i]], p, i, own, dim))
            p->flag[i] |= FLAG_STRESSED;
    }
    if (flows && at_once)
        points_apply_return_mapping(p, t, point, (const lanes *)L, (lanes *)stress, *(const lanes *)&after, dim);
}

/* Multiplies the rotations of a few material points with bonds (p->end_rotation), one point per lane, by the rotation
 * in a step of dt [s], the Cayley transform of the antisymmetric part of L dt. point: numbers of the points; L[dim
 * dim]: velocity gradients [1/s]. */
static ALWAYS_INLINE void points_update_rotation(struct particles *p, const int32_t *point, const row_of_points *L,
                                                 real dt, const int dim)
{
    if (dim == 2) {
        const row_of_points half = 0.25 * dt * (L[2] - L[1]), scale = 2.0 / (1.0 + half * half);
        const row_of_points less = -half * half * scale, sine = half * scale; /* cos - 1, sin */
        const row_of_points a = points_gather_values(p->end_rotation[0], point, dim),
                            b = points_gather_values(p->end_rotation[1], point, dim);
        points_store(p->end_rotation[0], point, a + less + a * less - b * sine, dim);
        points_store(p->end_rotation[1], point, b + b * less + (1.0 + a) * sine, dim);
        return;
    }
    const row_of_points w[3] = {0.25 * dt * (L[7] - L[5]), 0.25 * dt * (L[2] - L[6]), 0.25 * dt * (L[3] - L[1])};
    row_of_points q[ROTATION], next[ROTATION];
    for (int c = 0; c < ROTATION; c++) q[c] = points_gather_values(p->end_rotation[c], point, dim);
    for (int k = 0; k < 3; k++)
        next[k] = q[k] + q[3] * w[k] + w[(k + 1) % 3] * q[(k + 2) % 3] - w[(k + 2) % 3] * q[(k + 1) % 3];
    next[3] = q[3] - w[0] * q[0] - w[1] * q[1] - w[2] * q[2];
    row_of_points size2 = points_broadcast(0);
    for (int c = 0; c < ROTATION; c++) size2 += next[c] * next[c];
    for (int k = 0; k < AT_ONCE(dim); k++) {
        const real inverse = 1 / sqrt(size2[k]);
        for (int c = 0; c < ROTATION; c++) next[c][k] *= inverse;
    }
    for (int c = 0; c < ROTATION; c++) points_store(p->end_rotation[c], point, next[c], dim);
}

/* Returns -1 in each lane whose point moves with the remapped nodal velocities (FLIP: velocities from momentum mapped
 * to the nodes a second time, remap.h), else 1. The value is -1 for points with bonds; for all points if
 * t->momentum_only or t->second_map is set, or if weights are computed at positions shifted by g->ahead, where nodes
 * may have no other velocity. point: indices of the points. */
static ALWAYS_INLINE row_of_points points_sign_minus_if_moved_by_remapped_velocity(const struct grid *g,
                                                                                   const struct transfer_data *t,
                                                                                   const int32_t *point, const int dim)
{
    const bool all = t->momentum_only || t->second_map || grid_weights_use_half_step_ahead_positions(g, dim);
    row_of_points bonded = points_broadcast(all ? -1 : 1);
    for (int k = 0; t->bonded && !all && k < AT_ONCE(dim); k++) bonded[k] = t->bonded[point[k]] ? -1 : 1;
    return bonded;
}

/* Computes velocity[dim] [m/s] and velocity gradient L[dim dim] [1/s] at the points of stencil s (node weights of a few
 * points of cell c), by interpolation from the nodes of g. shape, transfer: shape function and transfer scheme;
 * negative_if_remapped: negative in lanes of points that move with the velocities after remapping
 * (points_sign_minus_if_moved_by_remapped_velocity). Nodes are summed row by row (along x). */
static ALWAYS_INLINE void points_interpolate_velocity(const struct grid *g, const struct grid_cell *c,
                                                      const struct cell_stencil *s,
                                                      const row_of_points negative_if_remapped, row_of_points *velocity,
                                                      row_of_points *L, const int dim, const enum shape shape,
                                                      const enum transfer transfer)
{
    const int along = ROW_DIMS(dim, shape);
    const bool any = transfer == TRANSFER_FLIP && points_sign_bits(negative_if_remapped) != 0;
    for (int d = 0; d < dim; d++) velocity[d] = points_broadcast(0);
    for (int k = 0; k < dim * dim; k++) L[k] = points_broadcast(0);
    FOR_ANY_TOUCHED(s, dim, shape)
    {
        const row_of_points weight = stencil_row_transverse_weights(s, k1, k2, dim, shape);
        const int64_t I = cell_row_first_node_index(c, g, k1, k2, dim);
        for (int d = 0; d < dim; d++) {
            const real *moving = g->velocity[d] + I,
                       *straining = transfer == TRANSFER_APIC ? moving : g->momentum[d] + I;
            row_of_points moved = points_broadcast(0), strained = points_broadcast(0),
                          slope[2] = {points_broadcast(0), points_broadcast(0)};
            FOR_NODES(dim, shape)
            {
                const int64_t node = grid_row_node_index_offset(g, k, dim, shape);
                moved += s->N[k] * moving[node];
                strained += s->N[k] * straining[node];
                for (int e = 0; e < along; e++) slope[e] += s->D[e][k] * straining[node];
            }
            velocity[d] += weight * (any ? points_choose_by_sign(negative_if_remapped, strained, moved) : moved);
            for (int e = 0; e < dim; e++)
                L[d * dim + e] += e < along ? weight * slope[e]
                                            : stencil_row_transverse_weight_slopes(s, k1, k2, e, dim, shape) * strained;
        }
    }
}

/* Computes velocity[dim] [m/s] and velocity gradient L[dim dim] [1/s] at the points of stencil s (node weights of a few
 * points of cell c) by interpolation from the nodes of g, for linear shapes in 2D and 3D. transfer: FLIP or APIC;
 * negative_if_remapped: negative in lanes of points that move with the velocities after remapping
 * (points_sign_minus_if_moved_by_remapped_velocity). */
static ALWAYS_INLINE void points_interpolate_velocity_linear(const struct grid *g, const struct grid_cell *c,
                                                             const struct cell_stencil *s,
                                                             const row_of_points negative_if_remapped,
                                                             row_of_points *velocity, row_of_points *L, const int dim,
                                                             const enum transfer transfer)
{
    const int strained = transfer == TRANSFER_APIC ? (1 << POINTS) - 1 : points_sign_bits(negative_if_remapped);
    for (int d = 0; d < dim; d++) {
        const real *straining = transfer == TRANSFER_APIC ? g->velocity[d] : g->momentum[d];
        row_of_points slope[DIM_MAX];
        velocity[d] = cell_corners_interpolate_value_and_gradient(g, straining + c->node, s->t, slope, dim);
        for (int e = 0; e < dim; e++) L[d * dim + e] = slope[e] * (1 / g->h);
        if (strained == (1 << POINTS) - 1) continue;
        const row_of_points moved =
            cell_corners_interpolate_value_and_gradient(g, g->velocity[d] + c->node, s->t, slope, dim);
        velocity[d] = points_choose_by_sign(negative_if_remapped, velocity[d], moved);
    }
}

/* Motion of a few points of a cell, one per lane, between interpolation and update. point: numbers of the points; x:
 * positions [m]; velocity [m/s]; L: velocity gradients dv_a/dx_b at [a dim + b] [1/s]. */
struct points_motion {
    int32_t point[POINT_NUMBERS]; /* from points_copy_list_indices_to_lanes */
    row_of_points x[DIM_MAX], velocity[DIM_MAX], L[DIM_MAX * DIM_MAX];
};

/* Interpolates velocity and velocity gradient of the points list[n] of p (n <= AT_ONCE, which are processed at once) in
 * cell c from the nodes of g into *m. t: inputs of the transfer, with the shape function `shape` and the scheme
 * `transfer`. */
static ALWAYS_INLINE void g2p_gather_velocity_and_gradient(struct points_motion *m, const struct grid *g,
                                                           const struct grid_cell *c, const struct particles *p,
                                                           const struct transfer_data *t, const int32_t *list, int n,
                                                           const int dim, const enum shape shape,
                                                           const enum transfer transfer)
{
    struct cell_stencil s;
    cell_stencil_compute_weights(&s, g, c, p, list, n, t->half_width, dim, shape);
    const row_of_points bonded = points_sign_minus_if_moved_by_remapped_velocity(g, t, s.point, dim);
    if (HAS_CORNERS(dim, shape))
        points_interpolate_velocity_linear(g, c, &s, bonded, m->velocity, m->L, dim, transfer);
    else
        points_interpolate_velocity(g, c, &s, bonded, m->velocity, m->L, dim, shape, transfer);
    for (int k = 0; k < POINT_NUMBERS; k++) m->point[k] = s.point[k];
    for (int d = 0; d < dim; d++) m->x[d] = s.x[d];
}

/* Returns the rates of dilatation tr L [1/s] of the points in m, one per lane. */
static ALWAYS_INLINE row_of_points points_dilatation_rate(const struct points_motion *m, const int dim)
{
    row_of_points rate = m->L[0];
    for (int d = 1; d < dim; d++) rate += m->L[d * dim + d];
    return rate;
}

/* Adds the changes `change` [1/s] to the rates of dilatation of the points in m: a third of the change, in 2D half, to
 * each diagonal entry of the velocity gradients m->L. */
static ALWAYS_INLINE void points_add_dilatation_rate(struct points_motion *m, row_of_points change, const int dim)
{
    for (int d = 0; d < dim; d++) m->L[d * dim + d] += change * (1.0 / dim);
}

/* Averages the rates of dilatation of the n <= MEAN_POINTS points `list` of p in a cell that differ in body or
 * material, each over the points of the same body and material (dilatation.h). t: constants of the materials; motion:
 * motion of these points, AT_ONCE of them (points processed together) in each entry, whose velocity gradients are
 * changed. */
static NEVER_INLINE void points_average_dilatation_rates_by_material(const struct particles *p,
                                                                     const struct transfer_data *t, const int32_t *list,
                                                                     struct points_motion *motion, int n, const int dim)
{
    real change[MEAN_POINTS];
    for (int k = 0; k < n; k += AT_ONCE(dim)) {
        const row_of_points rate = points_dilatation_rate(&motion[k / AT_ONCE(dim)], dim);
        for (int l = 0; l < points_count_of_next_batch(n - k, dim); l++) change[k + l] = rate[l];
    }
    points_replace_values_by_cell_mean_minus_value(p, t, list, n, change);
    for (int k = 0; k < n; k += AT_ONCE(dim)) {
        row_of_points more;
        for (int l = 0; l < POINTS; l++)
            more[l] = change[k + points_list_index_of_lane(l, points_count_of_next_batch(n - k, dim))];
        points_add_dilatation_rate(&motion[k / AT_ONCE(dim)], more, dim);
    }
}

/* Averages the rates of dilatation of the n <= MEAN_POINTS points `list` of p in a cell (dilatation.h), after storing
 * the rates before averaging in t->dilatation unless materials yield. motion: motion of these points, AT_ONCE of them
 * (points processed together) in each entry, whose velocity gradients are changed. */
static ALWAYS_INLINE void points_average_dilatation_rates(const struct particles *p, const struct transfer_data *t,
                                                          const int32_t *list, struct points_motion *motion, int n,
                                                          const int dim)
{
    row_of_points sum = points_broadcast(0), volume = points_broadcast(0);
    for (int k = 0; k < n && !t->laws; k += AT_ONCE(dim)) {
        const struct points_motion *m = &motion[k / AT_ONCE(dim)];
        points_store(t->dilatation, m->point, points_dilatation_rate(m, dim), dim);
    }
    if (!points_all_share_mean_dilatation(p, list, n)) {
        points_average_dilatation_rates_by_material(p, t, list, motion, n, dim);
        return;
    }
    if (!t->elastic[p->material[list[0]]].mean_dilatation) return;
    for (int k = 0; k < n; k += AT_ONCE(dim)) {
        const struct points_motion *m = &motion[k / AT_ONCE(dim)];
        const row_of_points own = points_keep_first_lanes(points_gather_values(p->volume, m->point, dim),
                                                          points_count_of_next_batch(n - k, dim));
        volume += own, sum += own * points_dilatation_rate(m, dim);
    }
    const real mean = points_sum(sum) / points_sum(volume);
    for (int k = 0; k < n; k += AT_ONCE(dim)) {
        struct points_motion *m = &motion[k / AT_ONCE(dim)];
        points_add_dilatation_rate(m, mean - points_dilatation_rate(m, dim), dim);
    }
}

/* Adds the displacements m->velocity [m], which the caller has already multiplied by the time step, to the positions of
 * the points of m, and stores the new positions in p. Returns a bit mask: bit k is set if point k has left cell c of
 * grid g. */
static ALWAYS_INLINE int points_move_and_find_points_leaving_cell(const struct grid *g, const struct grid_cell *c,
                                                                  struct particles *p, const struct points_motion *m,
                                                                  const int dim)
{
    points_mask inside = (points_mask){0} - 1;
    for (int d = 0; d < dim; d++) {
        const row_of_points x = m->x[d] + m->velocity[d];
        const row_of_points place = (x - g->anchor[d]) * (1 / g->h); /* grid_coordinate_in_cell_lengths */
        points_store(p->x[d], m->point, x, dim);
        inside &= (place >= c->place[d]) & (place < c->place[d] + 1);
    }
    return points_sign_bits((row_of_points)~inside);
}

/* Marks in o->left (o: order of the points by cell) the points that have left their cell. list: pointer into
 * o->particle; left_cell_bits: bit k is set if point list[k] has left its cell. */
static ALWAYS_INLINE void transfer_order_mark_points_that_left_cell(const struct transfer_order *o, const int32_t *list,
                                                                    int left_cell_bits)
{
    for (; __builtin_expect(left_cell_bits, 0); left_cell_bits &= left_cell_bits - 1)
        o->left[list - o->particle + __builtin_ctz((unsigned)left_cell_bits)] = 1;
}

/* Updates position, stress, volume, stretch and rotation of the points list[n] of p (n <= AT_ONCE, points processed
 * together) of cell c of grid g from their motion m. t: inputs of the transfer, with the order that contains `list`;
 * shape: shape function. On return m->velocity contains displacements [m]. return_queue: list to which points of
 * yielding materials are appended for the return mapping. Returns the number of points that have left the cell; they
 * are marked in t->order->left. */
static G2P_UPDATE_INLINE int g2p_update_points_from_motion(const struct grid *g, const struct grid_cell *c,
                                                           struct particles *p, const struct transfer_data *t,
                                                           struct return_mapping_queue *return_queue,
                                                           struct points_motion *m, const int32_t *list, int n,
                                                           const int dim, const enum shape shape)
{
    const struct elastic_points e = points_load_elastic_constants(p, t, m->point, dim);
    if (!t->momentum_only) points_update_stress(p, t, return_queue, &e, m->point, n, m->L, dim, shape);
    if (dim > 1 && __builtin_expect(p->end_rotation[0] != NULL, 0))
        points_update_rotation(p, m->point, m->L, t->dt, dim);
    for (int d = 0; d < dim; d++) m->velocity[d] *= t->dt;
    const int moved = points_move_and_find_points_leaving_cell(g, c, p, m, dim) & ((1 << n) - 1);
    transfer_order_mark_points_that_left_cell(t->order, list, moved);
    if (__builtin_expect(return_queue->n >= LANES, 0)) return_mapping_queue_process_first(p, t, return_queue, dim);
    return __builtin_popcount(moved);
}

/* Stores the velocities m->velocity and velocity gradients m->L of the points in m in p, as the APIC transfer
 * requires. */
static ALWAYS_INLINE void points_store_velocity_gradient(struct particles *p, const struct points_motion *m,
                                                         const int dim)
{
    for (int d = 0; d < dim; d++) points_store(p->v[d], m->point, m->velocity[d], dim);
    for (int k = 0; k < dim * dim; k++) points_store(p->gradient[k], m->point, m->L[k], dim);
}

/* Prefetches the data of p that g2p_update_points_of_cell will read of the point list[k + ORDER_AHEAD], once per cache
 * line. */
static ALWAYS_INLINE void g2p_prefetch_point(const struct particles *p, const int32_t *list, int k, const int dim)
{
    int64_t i;
    if (!point_ahead_starts_new_cache_line(list, k, &i)) return;
    prefetch_cache_line(p->volume + i);
    for (int d = 0; d < dim; d++) prefetch_cache_line(p->x[d] + i);
    for (int c = 0; c < dim * (dim + 1) / 2; c++) prefetch_cache_line(p->stress[c] + i);
    if (__builtin_expect(p->plastic_work != NULL, 0))
        prefetch_cache_line(p->plastic_strain + i), prefetch_cache_line(p->plastic_work + i);
    if (__builtin_expect(p->plastic_work != NULL, 0)) prefetch_cache_line(p->volume0 + i);
    if (__builtin_expect(p->temperature != NULL, 0)) prefetch_cache_line(p->temperature + i);
}

/* Updates motion, stress and volume of the points list[n] of p in one cell of g (grid to particles). t: materials, time
 * step and other inputs; shape: shape function; transfer: scheme, such as FLIP or APIC; return_queue: list to which
 * points of yielding materials are appended for the return mapping; average_dilatation: true if the points of a cell
 * get the mean of their rates of dilatation (transfer_uses_mean_dilatation); up to MEAN_POINTS points of the cell are
 * then interpolated before the first is updated. Points are processed AT_ONCE(dim) at a time. Returns the number of
 * points that have left the cell. */
static ALWAYS_INLINE int64_t g2p_update_points_of_cell(const struct grid *g, struct particles *p,
                                                       const struct transfer_data *t,
                                                       struct return_mapping_queue *return_queue, const int32_t *list,
                                                       int n, const int dim, const enum shape shape,
                                                       const enum transfer transfer, const bool average_dilatation)
{
    enum { MOST = MEAN_POINTS / POINTS };
    struct points_motion motion[MOST];
    const int most = average_dilatation ? MEAN_POINTS : AT_ONCE(dim);
    int64_t moved = 0;
    for (int k = 0; k < n; k++) g2p_prefetch_point(p, list, k, dim);
    for (int from = 0; from < n; from += most) {
        const struct grid_cell c = cell_containing_point(g, p, list[from], dim, shape);
        const int some = int_min(n - from, most);
        struct points_motion *m = motion;
        for (int k = 0; k < some; k += AT_ONCE(dim), m++) {
            g2p_gather_velocity_and_gradient(m, g, &c, p, t, list + from + k, points_count_of_next_batch(some - k, dim),
                                             dim, shape, transfer);
            if (transfer == TRANSFER_APIC) points_store_velocity_gradient(p, m, dim);
        }
        if (average_dilatation) points_average_dilatation_rates(p, t, list + from, motion, some, dim);
        m = motion;
        for (int k = 0; k < some; k += AT_ONCE(dim), m++)
            moved += g2p_update_points_from_motion(g, &c, p, t, return_queue, m, list + from + k,
                                                   points_count_of_next_batch(some - k, dim), dim, shape);
    }
    return moved;
}

/* Defines the function NAME, the loop of g2p over all cells for dimension D, shape function S and transfer scheme T.
 * LINKAGE: static or nothing; AVERAGE: true if points have the mean dilatation of their cells. */
#define LOOP(LINKAGE, NAME, D, S, T, AVERAGE)                                                                          \
    LINKAGE int64_t NAME(const struct grid *g, struct particles *p, const struct transfer_data *t)                     \
    {                                                                                                                  \
        const struct transfer_order *o = t->order;                                                                     \
        int64_t moved = 0;                                                                                             \
        const bool average = AVERAGE;                                                                                  \
        _Pragma("omp parallel reduction(+ : moved)")                                                                   \
        {                                                                                                              \
            struct grid nodes = *g; /* as in scatter.h */                                                              \
            struct particles points = *p;                                                                              \
            struct transfer_data data = *t;                                                                            \
            struct return_mapping_queue due = {.n = 0};                                                                \
            _Pragma("omp for schedule(static)") for (int32_t k = 0; k < o->cells; k++) moved +=                        \
                g2p_update_points_of_cell(&nodes, &points, &data, &due, o->particle + o->cell_start[k],                \
                                          o->cell_start[k + 1] - o->cell_start[k], D, SHAPE_##S, TRANSFER_##T,         \
                                          average);                                                                    \
            if (due.n > 0) return_mapping_queue_process_first(&points, &data, &due, D);                                \
        }                                                                                                              \
        return moved;                                                                                                  \
    }

#ifdef ONE_LOOP_OVER_CELLS
#define INSTANCE(D, S, T) LOOP(, g2p_##D##d_##S##_##T, D, S, T, transfer_uses_mean_dilatation(t, D))
#else
#define INSTANCE(D, S, T)                                                                                              \
    LOOP(static, g2p_plain_##D##d_##S##_##T, D, S, T, false)                                                           \
    LOOP(static, g2p_averaged_##D##d_##S##_##T, D, S, T, true)                                                         \
    int64_t g2p_##D##d_##S##_##T(const struct grid *g, struct particles *p, const struct transfer_data *t)             \
    {                                                                                                                  \
        return transfer_uses_mean_dilatation(t, D) ? g2p_averaged_##D##d_##S##_##T(g, p, t)                            \
                                                   : g2p_plain_##D##d_##S##_##T(g, p, t);                              \
    }
#endif
#define BOTH(D, S) TRANSFER_VARIANTS(INSTANCE, D, S)
MAP_VARIANTS(BOTH)
#undef BOTH
#undef INSTANCE
#undef LOOP

#endif
