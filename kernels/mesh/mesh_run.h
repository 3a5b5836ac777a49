/* Computes the forces of eight consecutive whole cells (with all points, of one material) by the closed form of
 * mesh_law.h. A run is a row of consecutive whole cells. */
#ifndef CLEAVE_KERNELS_MESH_RUN
#define CLEAVE_KERNELS_MESH_RUN

#include "mesh_law.h"

/* Loads the displacements u[c][i] [m] of corner c along axis i of eight mesh cells: those number k .. k + 7, counted
 * from 0, of `run`, a row of consecutive cells. Vector lanes beyond the last cell are set to 0. */
static ALWAYS_INLINE void mesh_run_load_displacements(const struct mesh *mesh, const struct mesh_run *run, int64_t k,
                                                      lanes u[CORNERS_MAX][3], const int dim)
{
    const int64_t I = run->cell + k, left = run->cells - k;
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) u[c][i] = lanes_load(mesh->displacement[i] + I + mesh->corner[c]);
    if (left >= LANES) return;
    const lanes inside =
        (lanes)((lanes_broadcast((real)left) > (lanes){0, 1, 2, 3, 4, 5, 6, 7}) & (lanes_mask)lanes_broadcast(1));
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) u[c][i] *= inside;
}

/* Returns true if the problem is 2D (dim = 2) and the elastic constants m are isotropic. The stresses in a cell with
 * all its points, of one material, then have no moment, and cell_balance_finite_moments is not needed. */
static ALWAYS_INLINE bool cells_have_balanced_moments(const struct elastic *m, const int dim)
{
    return dim == 2 && fabs(m->c11 - m->c12 - 2 * m->shear) <= 1e-14 * m->c11;
}

/* Computes the forces f[c][i] [N] on corner c along axis i of eight whole cells (with all points, of one material,
 * without partial stresses) from the displacements u[c][i] [m]. m: elastic constants; h, volume: edge [m] and volume
 * [m^3] of a cell; tension: raised to an upper bound of the largest principal stress at the material points [Pa];
 * finite: true if strains are finite, false if small; balanced: result of cells_have_balanced_moments. */
static ALWAYS_INLINE void mesh_run_corner_forces(const struct elastic *m, real h, real volume, lanes u[CORNERS_MAX][3],
                                                 lanes f[CORNERS_MAX][3], lanes *tension, const int dim,
                                                 const bool finite, const bool balanced)
{
    struct mesh_cell s;
    const bool rotates = finite && dim > 1;
    cell_strain(&s, h, u, dim, rotates);
    cell_compute_stress(m, &s, dim);
    *tension = lanes_max(*tension, cell_principal_stress_bound(m, &s, s.P, dim));
    if (rotates && !balanced) cell_balance_finite_moments(&s, (lanes[3]){{0}}, dim);
    cell_corner_forces(&s, h, volume, f, dim, rotates);
}

#endif
