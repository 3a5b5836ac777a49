/* Return mapping of material points with flow laws at the end of g2p. */
#ifndef CLEAVE_KERNELS_POINTS_FLOW
#define CLEAVE_KERNELS_POINTS_FLOW

#include "kernels/laws/law_update.h"
#include "stress.h"

/* Returns a vector of eight lanes: the values of the listed points, repeated. */
static ALWAYS_INLINE lanes lanes_of_points(row_of_points a, const int dim)
{
    lanes eight;
    for (int l = 0; l < LANES; l++) eight[l] = a[l % AT_ONCE(dim)];
    return eight;
}

/* The motion of a few points in a step: strain increment xx yy zz xy yz zx [1] as in stress_update, its trace in the
 * space [1], angles of spin [rad], total deviatoric strain rate [1/s]. */
struct points_motion {
    row_of_points strain[SYM_MAX], trace, spin[3], rate;
};

/* Computes the motion of points from their velocity gradients L [1/s]. In plane stress and 1D the rate is that of
 * incompressible flow. */
static ALWAYS_INLINE void points_motion_of(struct points_motion *m, const row_of_points *L, real dt, enum space space,
                                           const int dim)
{
    const row_of_points none = points_of(0);
    row_of_points D[SYM_MAX] = {L[0], none, none, none, none, none}, square = none;
    for (int c = 0; c < 3; c++) m->spin[c] = none;
    if (dim == 2) D[1] = L[3], D[3] = 0.5 * (L[1] + L[2]), m->spin[0] = 0.5 * (L[1] - L[2]) * dt;
    if (dim == 3) {
        D[1] = L[4], D[2] = L[8];
        D[3] = 0.5 * (L[1] + L[3]), D[4] = 0.5 * (L[5] + L[7]), D[5] = 0.5 * (L[6] + L[2]);
        m->spin[0] = 0.5 * (L[1] - L[3]) * dt, m->spin[1] = 0.5 * (L[5] - L[7]) * dt;
        m->spin[2] = 0.5 * (L[6] - L[2]) * dt;
    }
    for (int c = 0; c < SYM_MAX; c++) m->strain[c] = D[c] * dt;
    const row_of_points xy = 0.5 * m->spin[0] * m->spin[0], yz = 0.5 * m->spin[1] * m->spin[1],
                        zx = 0.5 * m->spin[2] * m->spin[2];
    m->strain[0] += xy + zx, m->strain[1] += dim > 1 ? xy + yz : none, m->strain[2] += dim > 2 ? yz + zx : none;
    m->strain[3] -= 0.5 * m->spin[1] * m->spin[2], m->strain[4] -= 0.5 * m->spin[0] * m->spin[2];
    m->strain[5] -= 0.5 * m->spin[0] * m->spin[1];
    m->trace = m->strain[0] + m->strain[1] + m->strain[2];
    if (space == SPACE_PLANE_STRESS) D[2] = -D[0] - D[1];
    if (space == SPACE_LINE) D[1] = D[2] = -0.5 * D[0];
    const row_of_points mean = (D[0] + D[1] + D[2]) / 3.0;
    for (int c = 0; c < 3; c++) square += (D[c] - mean) * (D[c] - mean) + 2 * D[c + 3] * D[c + 3];
    for (int k = 0; k < POINTS; k++) m->rate[k] = sqrt(2.0 / 3 * square[k]);
}

/* Loads the state of the points, after stress_update, into e. m: constants of their material. */
static ALWAYS_INLINE void points_flow_load(const struct particles *p, const struct elastic *m, const int32_t *point,
                                           const struct points_motion *motion, struct law_points *e, const int dim)
{
    const int n = dim * (dim + 1) / 2;
    const row_of_points none = points_of(0);
    row_of_points s[SYM_MAX] = {none, none, none, none, none, none}, back[SYM_MAX];
    for (int c = 0; c < n; c++) s[law_place[dim][c]] = points_load(p->stress[c], point, dim);
    if (m->space == SPACE_PLANE_STRAIN) s[2] = m->poisson * (s[0] + s[1]) + points_load(p->out_of_plane, point, dim);
    for (int c = 0; c < SYM_MAX; c++) {
        const bool across = c == 2 && dim < 3 && m->space != SPACE_PLANE_STRAIN;
        const row_of_points pressure = c < 3 && !across ? m->c12 * motion->trace : none;
        const row_of_points more = dim == 1 ? m->c11 * motion->strain[c] : (m->c11 - m->c12) * motion->strain[c];
        e->s[c] = lanes_of_points(s[c], dim);
        e->before[c] = lanes_of_points(s[c] - pressure - more, dim);
        e->back[c] = lanes_of(0);
    }
    if (p->back_stress[0]) {
        for (int c = 0; c < n; c++) back[c] = points_load(p->back_stress[c], point, dim);
        if (dim > 1) stress_rotate(back, motion->spin, dim);
        for (int c = 0; c < n; c++) e->back[law_place[dim][c]] = lanes_of_points(back[c], dim);
        if (dim == 2) e->back[2] = -e->back[0] - e->back[1];
    }
    const row_of_points ratio = points_load(p->volume, point, dim) / points_load(p->volume0, point, dim);
    e->volume = lanes_of_points(ratio, dim), e->volume_before = lanes_of_points(ratio / (1.0 + motion->trace), dim);
    e->a = lanes_of_points(points_load(p->plastic_strain, point, dim), dim);
    e->work = lanes_of_points(points_load(p->plastic_work, point, dim), dim);
    e->rate = lanes_of_points(motion->rate, dim);
    e->temperature = p->temperature ? lanes_of_points(points_load(p->temperature, point, dim), dim)
                                    : lanes_of(m->law->johnson_cook.T_room);
}

/* Stores the state of lane l to point i. */
static ALWAYS_INLINE void point_flow_store(struct particles *p, const struct elastic *m, const struct law_points *e,
                                           int l, int64_t i, const int dim)
{
    for (int c = 0; c < dim * (dim + 1) / 2; c++) {
        p->stress[c][i] = e->s[law_place[dim][c]][l];
        if (p->back_stress[0]) p->back_stress[c][i] = e->back[law_place[dim][c]][l];
    }
    if (m->space == SPACE_PLANE_STRAIN) p->out_of_plane[i] = e->s[2][l] - m->poisson * (e->s[0][l] + e->s[1][l]);
    p->plastic_strain[i] = e->a[l], p->plastic_work[i] = e->work[l];
    if (p->temperature) p->temperature[i] = e->temperature[l];
}

/* Maps the trial stresses of n points back to their yield surfaces if their materials have flow laws, and updates
 * plastic strain, plastic work, back stress and temperature. Works on stored values, after stress and volume of the
 * step are stored; not inlined, so that points without laws keep their values in registers. point: numbers of the
 * points, filled up to AT_ONCE; velocity_gradient: L of the step [1/s]. Points of several materials: law by law. */
static NEVER_INLINE void points_flow(struct particles *p, const struct transfer_data *t, const int32_t *point, int n,
                                     const row_of_points *velocity_gradient, int dim)
{
    struct points_motion motion;
    struct law_points e;
    unsigned left = (1u << n) - 1;
    points_motion_of(&motion, velocity_gradient, t->dt, t->elastic[p->material[point[0]]].space, dim);
    while (left) {
        const struct elastic *m = &t->elastic[p->material[point[__builtin_ctz(left)]]];
        unsigned own = 0;
        for (int l = 0; l < n; l++) own |= (unsigned)(left >> l & 1 && &t->elastic[p->material[point[l]]] == m) << l;
        left &= ~own;
        if (!m->law) continue;
        points_flow_load(p, m, point, &motion, &e, dim);
        e.active = lanes_of_bits((uint8_t)own);
        law_update(m->law, &e, m->space, LAW_EXPLICIT);
        for (int l = 0; l < n; l++)
            if (own >> l & 1) point_flow_store(p, m, &e, l, point[l], dim);
    }
}

#endif
