/* Applies the return mapping to material points that yield, at the end of g2p. */
#ifndef CLEAVE_KERNELS_POINTS_FLOW
#define CLEAVE_KERNELS_POINTS_FLOW

#include "kernels/laws/law_update.h"
#include "stress.h"

/* Length of an array with the numbers of eight points, which ends with the entry PAIRED of
 * points_copy_list_indices_to_lanes; 0 where there are not eight points at once. */
enum { FLOW_NUMBERS = LANES + 1 };

/* List of n points of materials that yield, which wait for their return mapping, with the input data of the mapping.
 * FLOW_ROOM: capacity. Points are collected from several cells until they fill a vector, since a cell has fewer points
 * than a vector has lanes. */
enum { FLOW_ROOM = LANES + POINTS };
struct return_mapping_queue {
    int n;                                /* fewer than LANES between cells */
    int32_t point[FLOW_ROOM];             /* numbers of the points */
    real stress[SYM_MAX][FLOW_ROOM];      /* trial stresses [Pa] */
    real volume[FLOW_ROOM];               /* volumes at the end of the step [m^3] */
    real L[DIM_MAX * DIM_MAX][FLOW_ROOM]; /* velocity gradients of the step [1/s] */
};

/* The motion of eight points in a step. strain: strain increment xx yy zz xy yz zx as in
 * stress_update_and_return_strain_trace [1]; trace: its trace [1]; spin: components xy, yz, zx of the antisymmetric
 * matrix of rotation [rad], in 2D xy only. */
struct flow_motion {
    lanes strain[SYM_MAX], trace, spin[3];
};

/* Computes strain increments and spins of eight points in a step of dt [s] into *m from their velocity gradients L[a
 * dim + b] = dv_a/dx_b [1/s]. */
static ALWAYS_INLINE void flow_motion_compute_strain_and_spin(struct flow_motion *m, const lanes *L, real dt,
                                                              const int dim)
{
    const lanes none = lanes_broadcast(0);
    lanes D[SYM_MAX] = {L[0], none, none, none, none, none};
    for (int c = 0; c < 3; c++) m->spin[c] = none;
    if (dim == 2) D[1] = L[3], D[3] = 0.5 * (L[1] + L[2]), m->spin[0] = 0.5 * (L[1] - L[2]) * dt;
    if (dim == 3) {
        D[1] = L[4], D[2] = L[8];
        D[3] = 0.5 * (L[1] + L[3]), D[4] = 0.5 * (L[5] + L[7]), D[5] = 0.5 * (L[6] + L[2]);
        m->spin[0] = 0.5 * (L[1] - L[3]) * dt, m->spin[1] = 0.5 * (L[5] - L[7]) * dt;
        m->spin[2] = 0.5 * (L[6] - L[2]) * dt;
    }
    for (int c = 0; c < SYM_MAX; c++) m->strain[c] = D[c] * dt;
    const lanes xy = 0.5 * m->spin[0] * m->spin[0], yz = 0.5 * m->spin[1] * m->spin[1],
                zx = 0.5 * m->spin[2] * m->spin[2];
    m->strain[0] += xy + zx, m->strain[1] += dim > 1 ? xy + yz : none, m->strain[2] += dim > 2 ? yz + zx : none;
    m->strain[3] -= 0.5 * m->spin[1] * m->spin[2], m->strain[4] -= 0.5 * m->spin[0] * m->spin[2];
    m->strain[5] -= 0.5 * m->spin[0] * m->spin[1];
    m->trace = m->strain[0] + m->strain[1] + m->strain[2];
}

/* Returns a vector whose lane l is from[point[l]]. Eight loads take half the time of a gather instruction. point: with
 * FLOW_NUMBERS entries. */
static ALWAYS_INLINE lanes points_gather_values_to_lanes(const real *from, const int32_t *point)
{
#if POINTS_LANES == 8
    if (point[PAIRED]) return (lanes)points_load_consecutive_pairs(from, point);
#endif
    return (lanes){from[point[0]], from[point[1]], from[point[2]], from[point[3]],
                   from[point[4]], from[point[5]], from[point[6]], from[point[7]]};
}

/* Stores lane l of a in to[point[l]]. Lanes that hold the same point must have equal values. point: with FLOW_NUMBERS
 * entries. */
static ALWAYS_INLINE void points_scatter_values_from_lanes(real *to, const int32_t *point, lanes a)
{
#if POINTS_LANES == 8
    points_store(to, point, (row_of_points)a, DIM_MAX);
#else
    for (int l = 0; l < LANES; l++) to[point[l]] = a[l];
#endif
}

/* Returns the lanes l to l + POINTS - 1 of the vector *a as a vector of POINTS entries. */
static ALWAYS_INLINE row_of_points lanes_extract_row_of_points_from_lane(const lanes *a, int l)
{
    return (row_of_points) * (const points_anywhere *)((const real *)a + l);
}

/* Loads the back stresses of eight points of p, rotated by the spin of the step, into points->back. point: numbers of
 * the points; motion: their motion in the step. */
static NEVER_INLINE void flow_load_back_stress(const struct particles *p, const int32_t *point,
                                               const struct flow_motion *motion, struct law_points *points,
                                               const int dim)
{
    const int n = dim * (dim + 1) / 2;
    for (int c = 0; c < n; c++) points->back[law_place[dim][c]] = lanes_gather(p->back_stress[c], point);
    for (int l = 0; l < LANES && dim > 1; l += POINTS) {
        row_of_points back[SYM_MAX], spin[3];
        for (int c = 0; c < n; c++)
            back[c] = lanes_extract_row_of_points_from_lane(&points->back[law_place[dim][c]], l);
        for (int c = 0; c < 3; c++) spin[c] = lanes_extract_row_of_points_from_lane(&motion->spin[c], l);
        stress_rotate(back, spin, dim);
        for (int c = 0; c < n; c++) *(points_anywhere *)((real *)&points->back[law_place[dim][c]] + l) = back[c];
    }
    if (dim == 2) points->back[2] = -points->back[0] - points->back[1];
}

/* Loads the plastic state and the stresses of eight points of p into *points, for law_update. point: numbers of the
 * points; m: constants of their material; stress[components], volume: trial stresses [Pa] and volumes [m^3]; motion:
 * motion in the step of dt [s]. */
static ALWAYS_INLINE void flow_load_stress_and_plastic_state(const struct particles *p, const struct elastic *m,
                                                             const int32_t *point, const lanes *stress, lanes volume,
                                                             const struct flow_motion *motion, real dt,
                                                             struct law_points *points, const int dim)
{
    const int n = dim * (dim + 1) / 2;
    const lanes none = lanes_broadcast(0);
    lanes s[SYM_MAX] = {none, none, none, none, none, none};
    for (int c = 0; c < n; c++) s[law_place[dim][c]] = stress[c];
    if (m->space == SPACE_PLANE_STRAIN) s[2] = m->poisson * (s[0] + s[1]) + lanes_gather(p->out_of_plane, point);
    const lanes pressure = m->c12 * motion->trace;
    const real twice = dim == 1 ? m->c11 : m->c11 - m->c12;
    for (int c = 0; c < SYM_MAX; c++) {
        const bool across = c == 2 && dim < 3 && m->space != SPACE_PLANE_STRAIN;
        points->s[c] = s[c];
        points->before[c] = s[c] - (c < 3 && !across ? pressure : none) - twice * motion->strain[c];
        points->back[c] = none;
    }
    if (p->back_stress[0]) flow_load_back_stress(p, point, motion, points, dim);
    points->volume = volume / points_gather_values_to_lanes(p->volume0, point);
    points->volume_before = points->volume / (1.0 + motion->trace), points->thins = true;
    points->duration = dt;
    points->a = points_gather_values_to_lanes(p->plastic_strain, point),
    points->work = points_gather_values_to_lanes(p->plastic_work, point);
    points->temperature = p->temperature ? points_gather_values_to_lanes(p->temperature, point)
                                         : lanes_broadcast(m->law->johnson_cook.T_room);
}

/* Clears FLAG_STRESSED (the stress requires conversion to peridynamics), which the trial stress has set, on those of
 * eight points of p whose stress after the return mapping no longer exceeds their conversion stress. flowed: bit l is
 * set if point[l] has yielded; m: material of the points; points: their state after the return mapping. */
static ALWAYS_INLINE void flow_clear_conversion_flags_below_threshold(struct particles *p, const struct elastic *m,
                                                                      const struct law_points *points, unsigned flowed,
                                                                      const int32_t *point, const int dim)
{
    for (int l = 0; l < LANES; l++) {
        if (!(flowed >> l & 1 && p->flag[point[l]] & FLAG_STRESSED)) continue;
        const real trigger = point_stress_threshold_for_conversion_to_pd(m, p, point[l]);
        real stress[SYM_MAX];
        for (int c = 0; c < dim * (dim + 1) / 2; c++) stress[c] = points->s[law_place[dim][c]][l];
        if (!(stress_largest_principal_upper_bound(stress, dim) > trigger &&
              stress_largest_principal(stress, dim) > trigger))
            p->flag[point[l]] &= (uint8_t)~FLAG_STRESSED;
    }
}

/* Stores the stress normal to the plane (plane strain) or the volume (plane stress, 1D) of those of the points
 * point[LANES] of p that have yielded. flowed: bit l is set if point[l] has yielded; m: material of the points; points:
 * their state after the return mapping. */
static NEVER_INLINE void points_store_out_of_plane_stress_or_volume(struct particles *p, const struct elastic *m,
                                                                    const struct law_points *points, unsigned flowed,
                                                                    const int32_t *point)
{
    const lanes across = points->s[2] - m->poisson * (points->s[0] + points->s[1]);
    for (int l = 0; l < LANES; l++)
        if (flowed >> l & 1 && m->space == SPACE_PLANE_STRAIN)
            p->out_of_plane[point[l]] = across[l];
        else if (flowed >> l & 1)
            p->volume[point[l]] = points->volume[l] * p->volume0[point[l]];
}

/* Stores in p the state `points` of eight points of material m after the return mapping. flowed: bit l is set if
 * point[l] has yielded; all other points keep their stress. stress[components] [Pa]: receives the stresses of the
 * points that have yielded. */
static ALWAYS_INLINE void flow_store_stress_and_plastic_state(struct particles *p, const struct elastic *m,
                                                              const struct law_points *points, unsigned flowed,
                                                              const int32_t *point, lanes *stress, const int dim)
{
    const lanes_mask own = lanes_mask_from_bits((uint8_t)flowed);
    for (int c = 0; c < dim * (dim + 1) / 2; c++)
        stress[c] = lanes_choose(own, points->s[law_place[dim][c]], stress[c]);
    if (m->space != SPACE_SOLID) points_store_out_of_plane_stress_or_volume(p, m, points, flowed, point);
    points_scatter_values_from_lanes(p->plastic_strain, point, points->a),
        points_scatter_values_from_lanes(p->plastic_work, point, points->work);
    if (p->temperature) points_scatter_values_from_lanes(p->temperature, point, points->temperature);
    flow_clear_conversion_flags_below_threshold(p, m, points, flowed, point, dim);
}

/* Stores the back stresses points->back of those of the eight points point[0] .. point[7] in p whose bits are set in
 * `lanes_set` (bit l: point[l]). They are stored whether the points have yielded or not, since their components rotate
 * with the points. points: state of the points after the return mapping; point: numbers of the points. */
static NEVER_INLINE void flow_store_back_stress(struct particles *p, const struct law_points *points,
                                                unsigned lanes_set, const int32_t *point, const int dim)
{
    for (int l = 0; l < LANES; l++)
        for (int c = 0; c < dim * (dim + 1) / 2 && lanes_set >> l & 1; c++)
            p->back_stress[c][point[l]] = points->back[law_place[dim][c]][l];
}

/* Removes the first n points (at most LANES) from the list `queue` of points that wait for their return mapping. Moves
 * the remaining points, at most POINTS (as many as a vector of points holds), to the beginning of the list, with their
 * velocity gradients queue->L, trial stresses and volumes. */
static ALWAYS_INLINE void return_mapping_queue_remove_first(struct return_mapping_queue *queue, int n, const int dim)
{
    queue->n -= n;
    if (queue->n == 0) return;
    for (int k = 0; k < queue->n; k++) queue->point[k] = queue->point[n + k];
    for (int k = 0; k < dim * dim; k++) *(points_anywhere *)queue->L[k] = *(const points_anywhere *)(queue->L[k] + n);
    for (int c = 0; c < dim * (dim + 1) / 2; c++)
        *(points_anywhere *)queue->stress[c] = *(const points_anywhere *)(queue->stress[c] + n);
    *(points_anywhere *)queue->volume = *(const points_anywhere *)(queue->volume + n);
}

/* Maps the trial stresses of eight points of p back to their yield surfaces (return mapping) and stores stress, plastic
 * strain, plastic work, back stress and temperature. Clears FLAG_STRESSED of points that yield if their stress then no
 * longer exceeds the conversion stress. Their volumes must have been stored in p. point[FLOW_NUMBERS]: numbers of the
 * points; lanes may repeat a point with all its values. L: velocity gradients [1/s]; stress[components], volume: trial
 * stresses [Pa], which are changed, and volumes [m^3]; t: time step and constants of the materials. Points of several
 * materials are mapped material by material. */
static NEVER_INLINE void points_apply_return_mapping(struct particles *p, const struct transfer_data *t,
                                                     const int32_t *point, const lanes *L, lanes *stress, lanes volume,
                                                     const int dim)
{
    struct flow_motion motion;
    struct law_points e;
    unsigned left = (1u << LANES) - 1;
    flow_motion_compute_strain_and_spin(&motion, L, t->dt, dim);
    while (left) {
        const struct elastic *m = &t->elastic[p->material[point[__builtin_ctz(left)]]];
        unsigned own = 0;
        for (int l = 0; l < LANES; l++)
            own |= (unsigned)(left >> l & 1 && &t->elastic[p->material[point[l]]] == m) << l;
        left &= ~own;
        if (!m->law) continue;
        flow_load_stress_and_plastic_state(p, m, point, stress, volume, &motion, t->dt, &e, dim);
        e.active = lanes_mask_from_bits((uint8_t)own);
        const unsigned flowed = law_update(m->law, &e, m->space, LAW_EXPLICIT);
        if (p->back_stress[0]) flow_store_back_stress(p, &e, own, point, dim);
        if (flowed) flow_store_stress_and_plastic_state(p, m, &e, flowed, point, stress, dim);
    }
    for (int c = 0; c < dim * (dim + 1) / 2; c++) points_scatter_values_from_lanes(p->stress[c], point, stress[c]);
}

/* Fills the n < LANES points of the list `queue` up to LANES by repeating the last one. */
static NEVER_INLINE void return_mapping_queue_pad_with_last_point(struct return_mapping_queue *queue, int n,
                                                                  const int dim)
{
    for (int l = n; l < LANES; l++) {
        queue->point[l] = queue->point[n - 1], queue->volume[l] = queue->volume[n - 1];
        for (int k = 0; k < dim * dim; k++) queue->L[k][l] = queue->L[k][n - 1];
        for (int c = 0; c < dim * (dim + 1) / 2; c++) queue->stress[c][l] = queue->stress[c][n - 1];
    }
}

/* Applies the return mapping (points_apply_return_mapping) to the first points in the list `queue`, at most LANES, and
 * removes them from the list. p: particles; t: time step and constants of the materials. */
static NEVER_INLINE void return_mapping_queue_process_first(struct particles *p, const struct transfer_data *t,
                                                            struct return_mapping_queue *queue, const int dim)
{
    const int n = int_min(queue->n, LANES);
    int32_t point[FLOW_NUMBERS] __attribute__((aligned(LANES * sizeof(int32_t)))) = {0};
    lanes L[DIM_MAX * DIM_MAX], stress[SYM_MAX];
    if (n < LANES) return_mapping_queue_pad_with_last_point(queue, n, dim);
    for (int l = 0; l < LANES; l++) point[l] = queue->point[l];
    for (int k = 0; k < dim * dim; k++) L[k] = lanes_load(queue->L[k]);
    for (int c = 0; c < dim * (dim + 1) / 2; c++) stress[c] = lanes_load(queue->stress[c]);
    points_apply_return_mapping(p, t, point, L, stress, lanes_load(queue->volume), dim);
    return_mapping_queue_remove_first(queue, n, dim);
}

/* Appends n points to the list `queue` of points that wait for their return mapping. point: numbers of the points,
 * filled up to AT_ONCE (points processed together); L: velocity gradients [1/s]; stress[components], volume: trial
 * stresses [Pa] and volumes [m^3]. */
static ALWAYS_INLINE void return_mapping_queue_append(struct return_mapping_queue *queue, const int32_t *point, int n,
                                                      const row_of_points *L, const row_of_points *stress,
                                                      row_of_points volume, const int dim)
{
    for (int c = 0; c < dim * (dim + 1) / 2; c++) *(points_anywhere *)(queue->stress[c] + queue->n) = stress[c];
    *(points_anywhere *)(queue->volume + queue->n) = volume;
    for (int k = 0; k < AT_ONCE(dim); k++) queue->point[queue->n + k] = point[k];
    for (int k = 0; k < dim * dim; k++) *(points_anywhere *)(queue->L[k] + queue->n) = L[k];
    queue->n += n;
}

#endif
