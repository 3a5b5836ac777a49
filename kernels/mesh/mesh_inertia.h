/* Inertia of coarse cells that disperses waves as bonds do.
 *
 * A lumped cell of edge h lets short waves run too slowly, by (kappa h)^2/24; a consistent mass matrix lets them run
 * too fast by as much. Coarse cells mix both: the momentum of their nodes is p, its velocity v = B p with
 *
 *     B = m^-1 + m^-1 [sum over matched cells of alpha (L - C)] m^-1        L: lumped, C: consistent mass of a cell
 *
 * B is symmetric and positive, rows of L - C sum to 0: momentum is exact and the kinetic energy is p . v/2. alpha
 * makes the dispersion that of the bonds' lattice (match_share in src/mesh/levels_build.c). Cells beside cells of
 * other sizes, faces and held nodes are not matched: B is then the inverse of the lumped mass at these nodes. */
#ifndef CLEAVE_KERNELS_MESH_INERTIA
#define CLEAVE_KERNELS_MESH_INERTIA

#include "kernels/kernels.h"

/* Entry of C/M of a cell for corners c and k: a factor 1/3 for each axis along which they agree, else 1/6. */
static ALWAYS_INLINE real mesh_consistent(int dim, int c, int k)
{
    real share = 1;
    for (int d = 0; d < dim; d++) share *= (c ^ k) >> d & 1 ? 1.0 / 6 : 1.0 / 3;
    return share;
}

/* a . alpha (L - C) a over the corners of matched cell I with a = f/m, summed over components. */
static inline real mesh_matched_form(const struct mesh *mesh, int64_t I)
{
    const int dim = mesh->grid.dim, corners = 1 << dim;
    real sum = 0;
    for (int d = 0; d < dim; d++) {
        real a[CORNERS_MAX];
        for (int c = 0; c < corners; c++) {
            const int64_t J = I + mesh->corner[c];
            a[c] = mesh->grid.force[d][J] * mesh->inverse_mass[J];
        }
        for (int c = 0; c < corners; c++) {
            sum += a[c] * a[c] / corners;
            for (int k = 0; k < corners; k++) sum -= mesh_consistent(dim, c, k) * a[c] * a[k];
        }
    }
    return mesh->match * mesh->cell_mass[mesh->material[I]] * sum;
}

#endif
