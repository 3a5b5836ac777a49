/* Computes the forces of eight consecutive whole cells (with all points, of one material) by the closed form of
 * mesh_law.h. A run is a row of consecutive whole cells. */
#ifndef CLEAVE_KERNELS_MESH_RUN
#define CLEAVE_KERNELS_MESH_RUN

#include "mesh_law.h"

/* Loads the displacements u[c][i] [m] of corner c along axis i of eight mesh cells: those number k .. k + 7, counted
 * from 0, of `run`, a row of consecutive cells. Vector lanes beyond the last cell are set to 0. */
static ALWAYS_INLINE void mesh_cell_run_load_corner_displacements(const struct mesh *mesh,
                                                                  const struct mesh_cell_run *run, int64_t k,
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
 * all its points, of one material, then have no moment, and cell_stress_balance_moments_at_finite_strain is not needed.
 */
static ALWAYS_INLINE bool elastic_is_isotropic_in_2d(const struct elastic *m, const int dim)
{
    return dim == 2 && fabs(m->c11 - m->c12 - 2 * m->shear) <= 1e-14 * m->c11;
}

/* Computes the forces f[c][i] [N] on corner c along axis i of eight whole cells (with all points, of one material,
 * without partial stresses) from the displacements u[c][i] [m]. m: elastic constants; h, volume: edge [m] and volume
 * [m^3] of a cell; tension: raised to an upper bound of the largest principal stress at the material points [Pa];
 * finite: true if strains are finite, false if small; stress_has_no_moment: result of elastic_is_isotropic_in_2d. */
static ALWAYS_INLINE void whole_cells_compute_corner_forces(const struct elastic *m, real h, real volume,
                                                            lanes u[CORNERS_MAX][3], lanes f[CORNERS_MAX][3],
                                                            lanes *tension, const int dim, const bool finite,
                                                            const bool stress_has_no_moment)
{
    struct mesh_cell s;
    const bool rotates = finite && dim > 1;
    cell_compute_rotation_strain_and_modes(&s, h, u, dim, rotates);
    cell_compute_stress_and_hourglass_forces(m, &s, dim);
    *tension = lanes_max(*tension, cell_largest_principal_stress_upper_bound(m, &s, s.P, dim));
    if (rotates && !stress_has_no_moment) cell_stress_balance_moments_at_finite_strain(&s, (lanes[3]){{0}}, dim);
    cell_compute_corner_forces(&s, h, volume, f, dim, rotates);
}

#endif
