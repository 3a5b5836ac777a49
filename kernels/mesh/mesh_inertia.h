/* Inertia of coarse cells, matched so that waves disperse as in the lattice of bonds.
 *
 * A lumped mass lets waves of wave number kappa run too slowly, by (kappa h)^2/24 for cell edge h; a
 * consistent mass lets them run too fast by an equal amount. Coarse cells blend both: the momentum of their
 * nodes is p, the velocity v = B p with
 *
 *     B = m^-1 + m^-1 [sum over matched cells of alpha (L - C)] m^-1        L: lumped, C: consistent mass of a cell
 *
 * and the nodal masses m. B is symmetric and positive, and the rows of L - C sum to 0: momentum is exact, and
 * the kinetic energy is p . v/2. mesh_levels_match_wave_dispersion_of_bonds chooses alpha = mesh->match such
 * that the dispersion equals that of the bonds' lattice. Not matched are cells next to cells of another size,
 * at faces, and with nodes whose motion is prescribed: B is then the inverse of the lumped mass at these
 * nodes. */
#ifndef CLEAVE_KERNELS_MESH_INERTIA
#define CLEAVE_KERNELS_MESH_INERTIA

#include "kernels/kernels.h"

/* Returns the entry for the corners `corner` and `other_corner` (0 .. 2^dim - 1) of the consistent mass matrix of a
 * linear cell, divided by the mass of the cell [1]: the product of 1/3 for each axis along which both corners have the
 * same position and 1/6 for each other axis. */
static ALWAYS_INLINE real mesh_consistent_mass_entry(int dim, int corner, int other_corner)
{
    real share = 1;
    for (int d = 0; d < dim; d++) share *= (corner ^ other_corner) >> d & 1 ? 1.0 / 6 : 1.0 / 3;
    return share;
}

/* Returns the contribution [N^2/kg] of cell `cell` of a mesh of coarse cells to the leap-frog correction of the kinetic
 * energy (mesh_kick), divided by dt^2/4: a . alpha (L - C) a, summed over components, with the accelerations a = f/m of
 * the corners by nodal forces f and masses m, the lumped and consistent mass matrices L and C of the cell, and their
 * blending factor alpha = mesh->match. Sums s and differences d along the axes diagonalise both matrices: along one
 * axis a . L a = (s^2 + d^2)/4 and a . C a = (s^2 + d^2/3)/4. */
static inline real mesh_cell_leapfrog_energy_correction(const struct mesh *mesh, int64_t cell)
{
    static const real less[DIM_MAX + 1] = {0, 2.0 / 3, 8.0 / 9, 26.0 / 27}; /* 1 - 3^-n for n differences */
    const int dim = mesh->grid.dim, corners = 1 << dim;
    real sum = 0;
    for (int d = 0; d < dim; d++) {
        real a[CORNERS_MAX];
        for (int c = 0; c < corners; c++) {
            const int64_t J = cell + mesh->corner[c];
            a[c] = mesh->grid.force[d][J] * mesh->inverse_mass[J];
        }
        for (int axis = 1; axis < corners; axis *= 2)
            for (int c = 0; c < corners; c++) {
                if (c & axis) continue;
                const real low = a[c], high = a[c | axis];
                a[c] = low + high, a[c | axis] = low - high;
            }
        for (int c = 1; c < corners; c++) sum += less[(c & 1) + (c >> 1 & 1) + (c >> 2)] * a[c] * a[c];
    }
    return mesh->match * mesh->cell_mass[mesh->material[cell]] * sum / (real)(corners * corners);
}

#endif
