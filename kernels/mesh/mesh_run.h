/* floor 2: eight whole cells of a run: the closed form of mesh_law.h. */
#ifndef CLEAVE_MESH_RUN_H
#define CLEAVE_MESH_RUN_H

#include "mesh_law.h"

/* Displacements of the corners of eight cells of a run from its k-th on; 0 behind its end, whatever lies there. */
static ALWAYS_INLINE void mesh_run_load(const struct mesh *mesh, const struct mesh_run *run, int64_t k,
                                        lanes u[CORNERS_MAX][3], const int dim)
{
    const int64_t I = run->cell + k, left = run->cells - k;
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) u[c][i] = lanes_load(mesh->displacement[i] + I + mesh->corner[c]);
    if (left >= LANES) return;
    const lanes inside = (lanes)((lanes_of((real)left) > (lanes){0, 1, 2, 3, 4, 5, 6, 7}) & (lanes_mask)lanes_of(1));
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) u[c][i] *= inside;
}

/* In the plane stresses of isotropic constants have no moment about what bends or strains: nothing to balance. */
static ALWAYS_INLINE bool mesh_balanced(const struct elastic *m, const int dim)
{
    return dim == 2 && fabs(m->c11 - m->c12 - 2 * m->shear) <= 1e-14 * m->c11;
}

/* Forces f [N] on the corners of eight cells with displacements u [m]; both corner by corner. `tension` grows to a bound of
 * the largest principal stress at their points [Pa]. */
static ALWAYS_INLINE void mesh_run_force(const struct elastic *m, real h, real volume, lanes u[CORNERS_MAX][3],
                                         lanes f[CORNERS_MAX][3], lanes *tension, const int dim, const bool finite,
                                         const bool balanced)
{
    struct mesh_cell s;
    const bool turns = finite && dim > 1;
    cell_strain(&s, h, u, dim, turns);
    cell_law(m, &s, dim);
    *tension = lanes_max(*tension, cell_tension(m, &s, s.P, dim));
    if (turns && !balanced) cell_balance(&s, (lanes[3]){{0}}, dim);
    cell_corners(&s, h, volume, f, dim, turns);
}

#endif
