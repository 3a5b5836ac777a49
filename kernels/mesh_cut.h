/* floor 2: displacements of a cell's corners in axes that turn with it: u -> R^T (X + u) - X, plainly. */
#ifndef CLEAVE_MESH_CUT_H
#define CLEAVE_MESH_CUT_H

#include "kernels.h"
#include "polar.h"

/* Place of corner c about the cell's centre along axis i [m]. */
static ALWAYS_INLINE real mesh_corner(int c, int i, real h) { return (c >> i & 1 ? 0.5 : -0.5) * h; }

/* Rotation R of the mean gradient F = R U of the corners' displacements u[c dim + i]. */
static ALWAYS_INLINE void mesh_cell_turn(real h, const real *u, real *R, real *U, const int dim)
{
    real F[DIM_MAX * DIM_MAX];
    for (int i = 0; i < dim; i++)
        for (int b = 0; b < dim; b++) {
            F[i * dim + b] = i == b;
            for (int c = 0; c < 1 << dim; c++)
                F[i * dim + b] += (c >> b & 1 ? 1 : -1) * u[c * dim + i] / (h * (1 << (dim - 1)));
        }
    polar_rotation(F, R, dim);
    for (int i = 0; i < dim; i++)
        for (int b = 0; b < dim; b++) {
            U[i * dim + b] = 0;
            for (int k = 0; k < dim; k++) U[i * dim + b] += R[k * dim + i] * F[k * dim + b];
        }
}

/* Displacements u[c dim + i] of the corners of cell I about their mean (a stiffness does not feel a common one, but for
 * round-off); where the cell turns in its own axes, with R and U of its mean gradient unless they are not wanted. */
static ALWAYS_INLINE void mesh_cell_local(const struct mesh *mesh, int64_t I, real *u, real *R, real *U, const int dim,
                                          const bool turns)
{
    const int corners = 1 << dim;
    const real h = mesh->grid.h;
    real R_own[DIM_MAX * DIM_MAX], U_own[DIM_MAX * DIM_MAX];
    for (int i = 0; i < dim; i++) {
        real mean = 0;
        for (int c = 0; c < corners; c++) mean += u[c * dim + i] = mesh->displacement[i][I + mesh->corner[c]];
        for (int c = 0; c < corners; c++) u[c * dim + i] -= mean / corners;
    }
    if (!turns) return;
    if (!R) R = R_own, U = U_own;
    mesh_cell_turn(h, u, R, U, dim);
    for (int c = 0; c < corners; c++) {
        real x[DIM_MAX];
        for (int a = 0; a < dim; a++) x[a] = mesh_corner(c, a, h) + u[c * dim + a];
        for (int a = 0; a < dim; a++) {
            u[c * dim + a] = -mesh_corner(c, a, h);
            for (int b = 0; b < dim; b++) u[c * dim + a] += R[b * dim + a] * x[b];
        }
    }
}

#endif
