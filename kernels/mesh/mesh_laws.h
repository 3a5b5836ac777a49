/* Evaluates flow laws (laws/law_update.h) at the material points of cells, for eight points at a time: the points of
 * equal number in eight cells. Stresses are in the axes of the cells, which rotate with them; volumes are those of the
 * undeformed body. */
#ifndef CLEAVE_KERNELS_MESH_LAWS
#define CLEAVE_KERNELS_MESH_LAWS

#include "kernels/laws/law_update.h"

/* Returns the index of the particle that is material point number `point_number` (0 .. 2^dim - 1) of cell `cell` of the
 * mesh; -1 if the cell has no such point or if `cell` is -1. */
static ALWAYS_INLINE int32_t mesh_cell_get_particle_index_of_point(const struct mesh *mesh, int32_t cell,
                                                                   int point_number, const int dim)
{
    return cell < 0 ? -1 : mesh->point[((int64_t)cell << dim) + point_number];
}

/* Returns the values from[point[l]] of a particle array for eight points, one per lane; 0 in lanes with point[l] =
 * -1. */
static ALWAYS_INLINE lanes lanes_gather_or_zero(const real *from, const int32_t *point)
{
    lanes eight;
    for (int l = 0; l < LANES; l++) eight[l] = point[l] < 0 ? 0 : from[point[l]];
    return eight;
}

/* Loads stress and plastic state of eight material points of p into *points, the input of law_update: trial stress,
 * stress at the start of the step (only if dt > 0), back stress, plastic strain, plastic work and temperature. point:
 * particle numbers, -1 for a lane without a point, which gets zeros; stress: symmetric components of the trial stress
 * [Pa]; dt: duration of an explicit time step [s], 0 in load steps (static equilibria); m: constants of the material
 * whose law is evaluated. */
static ALWAYS_INLINE void law_points_read_stress_and_plastic_state(const struct particles *p, const struct elastic *m,
                                                                   const int32_t *point, const lanes *stress, real dt,
                                                                   struct law_points *points, const int dim)
{
    const int n = symmetric_tensor_component_count(dim);
    for (int c = 0; c < SYM_MAX; c++) points->s[c] = points->before[c] = points->back[c] = lanes_broadcast(0);
    for (int k = 0; k < n; k++) {
        points->s[law_place[dim][k]] = stress[k];
        if (dt > 0) points->before[law_place[dim][k]] = lanes_gather_or_zero(p->mesh_stress[k], point);
        if (p->back_stress[0]) points->back[law_place[dim][k]] = lanes_gather_or_zero(p->back_stress[k], point);
    }
    if (dim == 2) points->back[2] = -points->back[0] - points->back[1];
    if (m->space == SPACE_PLANE_STRAIN) {
        const lanes across = lanes_gather_or_zero(p->out_of_plane, point);
        points->s[2] = m->law->poisson * (points->s[0] + points->s[1]) + across;
        points->before[2] = m->law->poisson * (points->before[0] + points->before[1]) + across;
    }
    points->volume_before = points->volume = lanes_broadcast(1), points->thins = false;
    points->duration = dt;
    points->a = lanes_gather_or_zero(p->plastic_strain, point),
    points->work = lanes_gather_or_zero(p->plastic_work, point);
    points->temperature =
        p->temperature ? lanes_gather_or_zero(p->temperature, point) : lanes_broadcast(m->law->johnson_cook.T_room);
}

/* Stores the result of the return mapping for particle i of p, which is in lane `lane` of *e. Adds the trial stress
 * less the returned stress to the plastic stress correction of the particle, replaces the trial stress in this lane of
 * stress[components] by the returned stress, and stores the plastic state in p. m: constants of the material. */
static ALWAYS_INLINE void law_points_store_lane_result_in_particle(const struct particles *p, const struct elastic *m,
                                                                   const struct law_points *points, int lane, int64_t i,
                                                                   lanes *stress, const int dim)
{
    for (int k = 0; k < symmetric_tensor_component_count(dim); k++) {
        const int c = law_place[dim][k];
        p->plastic_correction[k][i] += stress[k][lane] - points->s[c][lane];
        stress[k][lane] = points->s[c][lane];
        if (p->back_stress[0]) p->back_stress[k][i] = points->back[c][lane];
    }
    if (m->space == SPACE_PLANE_STRAIN)
        p->out_of_plane[i] = points->s[2][lane] - m->law->poisson * (points->s[0][lane] + points->s[1][lane]);
    p->plastic_strain[i] = points->a[lane], p->plastic_work[i] = points->work[lane];
    if (p->temperature) p->temperature[i] = points->temperature[lane];
}

/* Stores the stresses of eight material points in p->mesh_stress. point: particle numbers; selected_lane_bits: bit l is
 * set if the stress in lane l is to be stored; stress: symmetric components [Pa]. */
static ALWAYS_INLINE void mesh_points_store_stress_of_selected_lanes(const struct particles *p, const int32_t *point,
                                                                     unsigned selected_lane_bits, const lanes *stress,
                                                                     const int dim)
{
    for (int k = 0; k < symmetric_tensor_component_count(dim); k++)
        for (int l = 0; l < LANES; l++)
            if (selected_lane_bits >> l & 1) p->mesh_stress[k][point[l]] = stress[k][l];
}

/* Maps the trial stresses of the points number `point_number` (0 .. 2^dim - 1; particles of p) of eight cells of `mesh`
 * back to their yield surfaces by their flow laws, and updates their plastic state in p. Points of several materials
 * are mapped material by material. cell: eight cell indices; yielding_lanes: bit l is set if the point in lane l has a
 * flow law; dt: duration of an explicit time step [s], 0 in load steps (static equilibria); stress: symmetric
 * components, trial stress on entry, the returned stress on exit [Pa]; m: elastic constants of all materials. */
static NEVER_INLINE void cells_apply_flow_laws(const struct mesh *mesh, const struct particles *p,
                                               const struct elastic *m, const int32_t *cell, int point_number,
                                               unsigned yielding_lanes, real dt, lanes *stress, int dim)
{
    struct law_points e;
    int32_t point[LANES];
    for (int l = 0; l < LANES; l++) point[l] = mesh_cell_get_particle_index_of_point(mesh, cell[l], point_number, dim);
    while (yielding_lanes) {
        const uint8_t material = p->material[point[__builtin_ctz(yielding_lanes)]];
        unsigned own = 0;
        for (int l = 0; l < LANES; l++)
            own |= (unsigned)(yielding_lanes >> l & 1 && p->material[point[l]] == material) << l;
        yielding_lanes &= ~own;
        law_points_read_stress_and_plastic_state(p, &m[material], point, stress, dt, &e, dim);
        e.active = lanes_mask_from_bits((uint8_t)own);
        const unsigned flowed = law_update(m[material].law, &e, m[material].space, m[material].mode);
        for (int l = 0; l < LANES; l++)
            if (flowed >> l & 1)
                law_points_store_lane_result_in_particle(p, &m[material], &e, l, point[l], stress, dim);
        if (p->mesh_stress[0]) mesh_points_store_stress_of_selected_lanes(p, point, own, stress, dim);
    }
}

#endif
