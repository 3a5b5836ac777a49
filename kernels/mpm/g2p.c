/* Grid to particles (G2P): position, velocity gradient, stress and volume of the material points at the end of the
 * step, and FLAG_STRESSED where the largest principal stress exceeds the trigger (Zeng et al. 2022, eqs. 32, 40, 43-49,
 * corrected: L from the second map, rotation W sigma - sigma W; APIC: Jiang et al. 2015).
 *     FLIP (MUSL)    x += dt sum N v_I,   L = sum v2_I (x) grad N   with the velocity v2 of the second map
 *       with bonds   x += dt sum N v2_I   for points with bonds, and for points that rotate (data/turning.h)
 *     APIC           v = sum N v_I,   x += dt v,   L = sum v_I (x) grad N
 * Eq. 40 moves all points with v_I. Bond forces act on points through N M^-1 N^T, whose adjoint in the mass is the
 * second map. Where bonds depend on the positions of points, motion with v2 makes the linear step the leap-frog scheme
 * of one energy; with v_I each displacement has the extra term dt^2 (1 - N M^-1 N^T m) N M^-1 f, and bonds gain energy
 * from the stress. For points without bonds no linear term depends on their positions, but the weights follow the
 * positions in long runs: a free rotating plate with GIMP shapes loses a tenth of its energy in 1e5 steps with v_I, and
 * gains 40 % with v2 (bench/stability/limits_motion.c). Each point is written by one thread. */
#include "kernels/kernels.h"
#include "dilatation.h"
#include "points_flow.h"
#include "scatter.h"
#include "shape.h"
#include "stress.h"
#include "kernels/simd/variants.h"

/* Returns the elastic constants of a few points, one per lane [Pa]. point: their numbers. Usually all points have one
 * material; those of other materials are filled in lane by lane. */
static ALWAYS_INLINE struct elastic_points elastic_of(const struct particles *p, const struct transfer_data *t,
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

/* Updates stress [Pa], volume [m^3] and (cpGIMP) stretches of a few points from their velocity gradients L [1/s], and
 * sets FLAG_STRESSED where they convert at their stress (stress_converts). The volume follows the trace of
 * the strain in the space; in plane stress the elastic strain through the thickness is left out (below 1 % strain it
 * changes the volume by less than 0.5 %), the plastic one is added with the return mapping. m: elastic constants by
 * lane; point: numbers of the points, of which there are `points`. Where materials yield the points go to `due`, too
 * (points_flow.h). */
static ALWAYS_INLINE void points_strain(struct particles *p, const struct transfer_data *t, struct flow_points *due,
                                        const struct elastic_points *m, const int32_t *point, int points,
                                        const row_of_points *L, const int dim, const enum shape shape)
{
    const int n = dim * (dim + 1) / 2;
    row_of_points stress[SYM_MAX];
    for (int c = 0; c < n; c++) stress[c] = points_load(p->stress[c], point, dim);
    const row_of_points volume = points_load(p->volume, point, dim), trace = stress_update(stress, L, m, t->dt, dim);
    points_store(p->volume, point, volume + volume * trace, dim);
    for (int c = 0; c < n; c++) points_store(p->stress[c], point, stress[c], dim);
    if (__builtin_expect(t->laws, 0)) flow_add(due, point, points, L, dim);
    if (shape == SHAPE_CPGIMP)
        for (int d = 0; d < dim; d++) {
            const row_of_points stretch = points_load(p->stretch[d], point, dim);
            points_store(p->stretch[d], point, stretch + stretch * (t->dt * L[d * dim + d]), dim);
        }
    int near = points_sign_bits(m->trigger - stress_principal_bounds(stress, dim));
    if (__builtin_expect(m->surface, 0)) near = (1 << AT_ONCE(dim)) - 1;
    for (int k = 0; k < AT_ONCE(dim) && __builtin_expect(near, 0); k++) {
        real own[SYM_MAX];
        for (int c = 0; c < n; c++) own[c] = stress[c][k];
        const int32_t i = point[k];
        if (near >> k & 1 && stress_converts(&t->elastic[p->material[i]], p, i, own, dim)) p->flag[i] |= FLAG_STRESSED;
    }
}

/* Multiplies the rotations particles.end_rotation of a few points by the rotation of the step, the Cayley transform of
 * the antisymmetric part of L dt. point: numbers of the points; L: velocity gradients [1/s]. */
static ALWAYS_INLINE void points_rotate(struct particles *p, const int32_t *point, const row_of_points *L, real dt,
                                        const int dim)
{
    if (dim == 2) {
        const row_of_points half = 0.25 * dt * (L[2] - L[1]), scale = 2.0 / (1.0 + half * half);
        const row_of_points less = -half * half * scale, sine = half * scale; /* cos - 1, sin */
        const row_of_points a = points_load(p->end_rotation[0], point, dim),
                            b = points_load(p->end_rotation[1], point, dim);
        points_store(p->end_rotation[0], point, a + less + a * less - b * sine, dim);
        points_store(p->end_rotation[1], point, b + b * less + (1.0 + a) * sine, dim);
        return;
    }
    const row_of_points w[3] = {0.25 * dt * (L[7] - L[5]), 0.25 * dt * (L[2] - L[6]), 0.25 * dt * (L[3] - L[1])};
    row_of_points q[ROTATION], next[ROTATION];
    for (int c = 0; c < ROTATION; c++) q[c] = points_load(p->end_rotation[c], point, dim);
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

/* Adds the displacements `step` [m] to the positions of the points of stencil s and stores them. Returns a bit mask:
 * bit k is set if point k has left cell c of the grid. */
static ALWAYS_INLINE int points_move(const struct grid *g, const struct cell *c, struct particles *p,
                                     const struct cell_stencil *s, const row_of_points *step, const int dim)
{
    points_mask inside = (points_mask){0} - 1;
    for (int d = 0; d < dim; d++) {
        const row_of_points x = s->x[d] + step[d];
        const row_of_points place = (x - g->anchor[d]) * (1 / g->h); /* grid_cell_coordinate */
        points_store(p->x[d], s->point, x, dim);
        inside &= (place >= c->place[d]) & (place < c->place[d] + 1);
    }
    return points_sign_bits((row_of_points)~inside);
}

/* Returns for a few points, in each lane, -1 if the point moves with the velocities of the second map (remap.c), else
 * 1. Points with bonds do; if t->momentum_only or t->second_map is set, all do. point: numbers of the points. */
static ALWAYS_INLINE row_of_points points_bonded(const struct transfer_data *t, const int32_t *point, const int dim)
{
    const bool all = t->momentum_only || t->second_map;
    row_of_points bonded = points_broadcast(all ? -1 : 1);
    for (int k = 0; t->bonded && !all && k < AT_ONCE(dim); k++) bonded[k] = t->bonded[point[k]] ? -1 : 1;
    return bonded;
}

/* Computes velocity[dim] [m/s] and velocity gradient L[dim dim] [1/s] at the points of stencil s of cell c, by
 * interpolation from the nodes. bonded: result of points_bonded. The nodes of a row are added first, since they have
 * one weight in the directions across the row. */
static ALWAYS_INLINE void points_gather(const struct grid *g, const struct cell *c, const struct cell_stencil *s,
                                        const row_of_points bonded, row_of_points *velocity, row_of_points *L,
                                        const int dim, const enum shape shape, const enum transfer transfer)
{
    const int along = ROW_DIMS(dim, shape);
    const bool any = transfer == TRANSFER_FLIP && points_sign_bits(bonded) != 0;
    for (int d = 0; d < dim; d++) velocity[d] = points_broadcast(0);
    for (int k = 0; k < dim * dim; k++) L[k] = points_broadcast(0);
    FOR_ANY_TOUCHED(s, dim, shape)
    {
        const row_of_points weight = stencil_row_factors(s, k1, k2, dim, shape);
        const int64_t I = cell_row_first_node(c, g, k1, k2, dim);
        for (int d = 0; d < dim; d++) {
            const real *moving = g->velocity[d] + I,
                       *straining = transfer == TRANSFER_APIC ? moving : g->momentum[d] + I;
            row_of_points moved = points_broadcast(0), strained = points_broadcast(0),
                          slope[2] = {points_broadcast(0), points_broadcast(0)};
            FOR_NODES(dim, shape)
            {
                const int64_t node = row_node_offset(g, k, dim, shape);
                moved += s->N[k] * moving[node];
                strained += s->N[k] * straining[node];
                for (int e = 0; e < along; e++) slope[e] += s->D[e][k] * straining[node];
            }
            velocity[d] += weight * (any ? points_choose(bonded, strained, moved) : moved);
            for (int e = 0; e < dim; e++)
                L[d * dim + e] +=
                    e < along ? weight * slope[e] : stencil_row_factor_slopes(s, k1, k2, e, dim, shape) * strained;
        }
    }
}

/* Computes the rate of dilatation tr L at the points of stencil s of cell c [1/s], with the velocity gradient L that
 * points_gather computes. */
static ALWAYS_INLINE row_of_points points_dilate(const struct grid *g, const struct cell *c,
                                                 const struct cell_stencil *s, const int dim, const enum shape shape,
                                                 const enum transfer transfer)
{
    row_of_points trace = points_broadcast(0);
    FOR_ANY_TOUCHED(s, dim, shape)
    {
        const row_of_points weight = stencil_row_factors(s, k1, k2, dim, shape);
        const int64_t I = cell_row_first_node(c, g, k1, k2, dim);
        for (int d = 0; d < dim; d++) {
            const real *at = (transfer == TRANSFER_APIC ? g->velocity[d] : g->momentum[d]) + I;
            row_of_points sum = points_broadcast(0);
            FOR_NODES(dim, shape)
            sum += (d < ROW_DIMS(dim, shape) ? s->D[d][k] : s->N[k]) * at[row_node_offset(g, k, dim, shape)];
            trace += sum * (d < ROW_DIMS(dim, shape) ? weight : stencil_row_factor_slopes(s, k1, k2, d, dim, shape));
        }
    }
    return trace;
}

/* Computes by how much the rate of dilatation of n <= MEAN_POINTS listed points of a cell changes by averaging over the
 * points of one body and material (dilatation.h), change[k] for point list[k] [1/s]. */
static NEVER_INLINE void means_of_dilatation(const struct grid *g, const struct particles *p,
                                             const struct transfer_data *t, const int32_t *list, int n, real *change,
                                             const int dim, const enum shape shape, const enum transfer transfer)
{
    const struct cell c = cell_containing_point(g, p, list[0], dim, shape);
    for (int k = 0; k < n; k += AT_ONCE(dim)) {
        struct cell_stencil s;
        const int points = points_at_once(n - k, dim);
        cell_stencil_make(&s, g, &c, p, list + k, points, t->half_width, dim, shape);
        const row_of_points trace = points_dilate(g, &c, &s, dim, shape, transfer);
        for (int at = 0; at < points; at++) change[k + at] = trace[at];
    }
    differences_from_mean(p, t, list, n, change);
}

/* Adds a third, in 2D half, of the changes of the rate of dilatation of n points, change[], to the diagonal of their
 * velocity gradients L [1/s]. */
static ALWAYS_INLINE void points_dilate_more(row_of_points *L, const real *change, int n, const int dim)
{
    row_of_points more;
    for (int k = 0; k < POINTS; k++) more[k] = change[int_min(k % AT_ONCE(dim), n - 1)] / dim;
    for (int d = 0; d < dim; d++) L[d * dim + d] += more;
}

/* Updates the n listed points (n <= AT_ONCE) of cell c: position, stress, volume, and with APIC velocity and its
 * gradient. due: receives the points where materials yield; dilatation: change of the rate of dilatation of each point
 * [1/s], NULL: none. Returns the number of points that have left the cell. */
static ALWAYS_INLINE int g2p_points(const struct grid *g, const struct cell *c, struct particles *p,
                                    const struct transfer_data *t, struct flow_points *due, const int32_t *list, int n,
                                    const real *dilatation, const int dim, const enum shape shape,
                                    const enum transfer transfer)
{
    struct cell_stencil s;
    row_of_points velocity[DIM_MAX], L[DIM_MAX * DIM_MAX];
    cell_stencil_make(&s, g, c, p, list, n, t->half_width, dim, shape);
    points_gather(g, c, &s, points_bonded(t, s.point, dim), velocity, L, dim, shape, transfer);
    if (transfer == TRANSFER_APIC) {
        for (int d = 0; d < dim; d++) points_store(p->v[d], s.point, velocity[d], dim);
        for (int k = 0; k < dim * dim; k++) points_store(p->gradient[k], s.point, L[k], dim);
    }
    if (dilatation) points_dilate_more(L, dilatation, n, dim);
    const struct elastic_points m = elastic_of(p, t, s.point, dim);
    if (!t->momentum_only) points_strain(p, t, due, &m, s.point, n, L, dim, shape);
    if (dim > 1 && __builtin_expect(p->end_rotation[0] != NULL, 0)) points_rotate(p, s.point, L, t->dt, dim);
    for (int d = 0; d < dim; d++) velocity[d] *= t->dt;
    const int moved = points_move(g, c, p, &s, velocity, dim);
    if (__builtin_expect(due->n >= LANES, 0)) flow_return(p, t, due, dim);
    return __builtin_popcount(moved & ((1 << n) - 1));
}

/* Prefetches the data of the point ORDER_AHEAD entries after entry k of the list, which g2p_points will read; once per
 * cache line. */
static ALWAYS_INLINE void g2p_fetch(const struct particles *p, const int32_t *list, int k, const int dim)
{
    int64_t i;
    if (!prefetch_is_due(list, k, &i)) return;
    prefetch_line(p->volume + i);
    for (int d = 0; d < dim; d++) prefetch_line(p->x[d] + i);
    for (int c = 0; c < dim * (dim + 1) / 2; c++) prefetch_line(p->stress[c] + i);
    if (__builtin_expect(p->plastic_work != NULL, 0))
        prefetch_line(p->plastic_strain + i), prefetch_line(p->plastic_work + i);
    if (__builtin_expect(p->plastic_work != NULL, 0)) prefetch_line(p->volume0 + i);
    if (__builtin_expect(p->temperature != NULL, 0)) prefetch_line(p->temperature + i);
}

/* Updates the n listed points of one cell of the grid at the end of the step (g2p_points). Returns the number of points
 * that have left the cell. due: receives the points where materials yield; averaged: result of mean_dilatation. The
 * cell is computed again for every AT_ONCE points: most cells need one pass only, so it is not kept in registers. */
static ALWAYS_INLINE int64_t g2p_cell(const struct grid *g, struct particles *p, const struct transfer_data *t,
                                      struct flow_points *due, const int32_t *list, int n, const int dim,
                                      const enum shape shape, const enum transfer transfer, const bool averaged)
{
    real change[MEAN_POINTS];
    int64_t moved = 0;
    for (int k = 0; k < n; k++) g2p_fetch(p, list, k, dim);
    for (int k = 0; k < n; k += AT_ONCE(dim)) {
        const struct cell c = cell_containing_point(g, p, list[k], dim, shape);
        if (averaged && k % MEAN_POINTS == 0)
            means_of_dilatation(g, p, t, list + k, int_min(n - k, MEAN_POINTS), change, dim, shape, transfer);
        moved += g2p_points(g, &c, p, t, due, list + k, points_at_once(n - k, dim),
                            averaged ? &change[k % MEAN_POINTS] : NULL, dim, shape, transfer);
    }
    return moved;
}

/* Two loops over all cells: points with the mean dilatation of their cells have one of their own, so that the other has
 * no code of it. */
#define CELLS(NAME, D, S, T, AVERAGED)                                                                                 \
    static int64_t NAME(const struct grid *g, struct particles *p, const struct transfer_data *t)                      \
    {                                                                                                                  \
        const struct transfer_order *o = t->order;                                                                     \
        int64_t moved = 0;                                                                                             \
        _Pragma("omp parallel reduction(+ : moved)")                                                                   \
        {                                                                                                              \
            struct grid nodes = *g; /* as in scatter.h */                                                              \
            struct particles points = *p;                                                                              \
            struct transfer_data data = *t;                                                                            \
            struct flow_points due = {.n = 0};                                                                         \
            _Pragma("omp for schedule(static)") for (int32_t k = 0; k < o->cells; k++) moved +=                        \
                g2p_cell(&nodes, &points, &data, &due, o->particle + o->cell_start[k],                                 \
                         o->cell_start[k + 1] - o->cell_start[k], D, SHAPE_##S, TRANSFER_##T, AVERAGED);               \
            if (due.n > 0) flow_return(&points, &data, &due, D);                                                       \
        }                                                                                                              \
        return moved;                                                                                                  \
    }
#define INSTANCE(D, S, T)                                                                                              \
    CELLS(g2p_plain_##D##d_##S##_##T, D, S, T, false)                                                                  \
    CELLS(g2p_averaged_##D##d_##S##_##T, D, S, T, true)                                                                \
    static int64_t g2p_##D##d_##S##_##T(const struct grid *g, struct particles *p, const struct transfer_data *t)      \
    {                                                                                                                  \
        return mean_dilatation(t, D) ? g2p_averaged_##D##d_##S##_##T(g, p, t) : g2p_plain_##D##d_##S##_##T(g, p, t);   \
    }
#define BOTH(D, S) TRANSFER_VARIANTS(INSTANCE, D, S)
SHAPE_VARIANTS(BOTH)

#define ENTRY(D, S, T) [D][SHAPE_##S][TRANSFER_##T] = g2p_##D##d_##S##_##T,
#define ENTRIES(D, S) TRANSFER_VARIANTS(ENTRY, D, S)
g2p_fn *const g2p_table[DIM_MAX + 1][SHAPES][TRANSFERS] = {SHAPE_VARIANTS(ENTRIES)};
