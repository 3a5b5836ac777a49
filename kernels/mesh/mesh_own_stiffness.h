/* Computes the forces of eight cells with own stiffness (cells with missing points, partial stresses, several materials
 * or doubled nodes) at once. Each has a stiffness of its own, which follows from the points that it has.
 *
 * The energy of a cell depends on its mean strain and its bending modes (mesh_law.h), not on translation and rotation:
 * in 3D on 18 modes instead of 24 displacements. The stiffness acts on these modes and is symmetric: one half is
 * stored, 171 numbers in 3D and 15 in 2D. Shear strains are angles (twice the tensor component), so their conjugate
 * forces are stresses. */
#ifndef CLEAVE_KERNELS_MESH_OWN_STIFFNESS
#define CLEAVE_KERNELS_MESH_OWN_STIFFNESS

#include "mesh_law.h"

/* Loads the displacements u[c][i] [m] of corner c along axis i of the eight cells of group number `group` of partial
 * cells of the mesh: cells with missing points, partial stresses, several materials or doubled nodes. */
static ALWAYS_INLINE void mesh_cells_with_own_stiffness_gather_displacements(const struct mesh *mesh, int64_t group,
                                                                             lanes u[CORNERS_MAX][3], const int dim)
{
    const int32_t *cell = mesh->own_stiffness_cell + group * LANES,
                  *own = mesh_cells_with_own_stiffness_corner_nodes_if_at_slit(mesh, group, dim);
    const int32_t first = cell[LANES - 1] - cell[0] == LANES - 1 ? cell[0] : -1;
    for (int c = 0; c < 1 << dim && own; c++)
        for (int i = 0; i < dim; i++) u[c][i] = lanes_load_or_gather(mesh->displacement[i], -1, own + c * LANES);
    if (own) return;
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++)
            u[c][i] = lanes_load_or_gather(mesh->displacement[i] + mesh->corner[c], first, cell);
}

/* Writes the strains and bending (hourglass) modes of eight cells in `cell` as vectors v of
 * cell_deformation_mode_count(dim) numbers [1], one cell per lane: first the components of the mean strain (engineering
 * shear strains), then the bending modes. */
static ALWAYS_INLINE void cells_pack_strains_and_mode_amplitudes_in_vector(const struct mesh_cell *cell, lanes *v,
                                                                           const int dim)
{
    int n = symmetric_tensor_component_count(dim);
    for (int k = 0; k < n; k++) {
        int a, b;
        symmetric_tensor_component_axes(dim, k, &a, &b);
        v[k] = a == b ? cell->e[a][a] : cell->e[a][b] + cell->e[b][a];
    }
    SETS for (int M = 3; M < 1 << dim; M++) if (M & (M - 1)) for (int i = 0; i < dim; i++) v[n++] = cell->mode[M][i];
}

/* Computes f = K v for eight cells at a time, with a symmetric n x n matrix K for each. K: upper triangle, row by row
 * from the diagonal on; v, f: n values. */
static ALWAYS_INLINE void symmetric_matrix_times_vector(const lanes *K, const lanes *v, lanes *f, const int n)
{
    for (int a = 0; a < n; a++) f[a] = lanes_broadcast(0);
#pragma GCC unroll 18
    for (int a = 0; a < n; a++) {
        lanes sum = f[a] + *K++ * v[a];
#pragma GCC unroll 18
        for (int b = a + 1; b < n; b++, K++) sum += *K * v[b], f[b] += *K * v[a];
        f[a] = sum;
    }
}

/* Adds to f [Pa] the forces of state-based bonds on the deformation modes of the cells in group number `group` of eight
 * cells with own stiffness of the mesh (cells with missing or bonded points): f += share^T pull for each material point
 * with bonds, with the reaction `pull` of its bonds (p->end_pull) and the derivatives `share` of the strain at the
 * point by the modes (mesh->end_share). f: one value for each mode of cells_pack_strains_and_mode_amplitudes_in_vector,
 * one cell per lane.
 */
static ALWAYS_INLINE void mesh_cells_with_own_stiffness_add_bond_forces(const struct mesh *mesh,
                                                                        const struct particles *p, int64_t group,
                                                                        lanes *f, const int dim)
{
    const struct mesh_end *end = mesh->end + mesh->ends[group], *last = mesh->end + mesh->ends[group + 1];
    const int n = cell_deformation_mode_count(dim);
    const real inverse = 1 / (mesh->volume * (1 << dim));
    for (; end < last; end++) {
        const real pull = p->end_pull[end->point] * inverse;
        const real *share = mesh->end_share + (end - mesh->end) * n;
        for (int k = 0; k < n; k++) f[k][end->lane] += share[k] * pull;
    }
}

/* Adds the moments of bonds about the material points (of p) of group number `group` of eight cells with own stiffness
 * of the mesh (cells with missing points, partial stresses, several materials or doubled nodes), per volume of the
 * cell, to moment[axis] [Pa]; in 2D moment[2] only. */
static ALWAYS_INLINE void mesh_cells_with_own_stiffness_add_bond_moments(const struct mesh *mesh,
                                                                         const struct particles *p, int64_t group,
                                                                         lanes *moment, const int dim)
{
    const struct mesh_end *end = mesh->end + mesh->ends[group], *last = mesh->end + mesh->ends[group + 1];
    const real inverse = 1 / (mesh->volume * (1 << dim));
    for (; end < last; end++)
        for (int k = dim == 2 ? 2 : 0, c = 0; k < 3; k++, c++)
            moment[k][end->lane] += p->end_moment[c][end->point] * inverse;
}

/* Computes the stress in group number `group` of eight cells with own stiffness of the mesh, from the mean strain and
 * the hourglass (bending) amplitudes of each cell in s. cell->P: receives the stress that belongs to the mean strain
 * [Pa]; cell->force: that which belongs to the hourglass amplitudes, per volume of the cell [Pa]. A cell with own
 * stiffness lacks points, has several materials, is crossed by bonds that carry part of its stress, or has nodes that a
 * crack doubles; each has a stiffness matrix of its own. Forces of state-based bonds on points of p are added. */
static ALWAYS_INLINE void mesh_cells_with_own_stiffness_compute_stress(const struct mesh *mesh,
                                                                       const struct particles *p, int64_t group,
                                                                       struct mesh_cell *cell, const int dim)
{
    const int n = cell_deformation_mode_count(dim), half = n * (n + 1) / 2;
    lanes v[MODES_MAX], f[MODES_MAX];
    cells_pack_strains_and_mode_amplitudes_in_vector(cell, v, dim);
    symmetric_matrix_times_vector((const lanes *)mesh->stiffness + mesh->alike[group] * half, v, f, n);
    if (mesh->ends) mesh_cells_with_own_stiffness_add_bond_forces(mesh, p, group, f, dim);
    int k = symmetric_tensor_component_count(dim);
    for (int t = 0; t < k; t++) {
        int a, b;
        symmetric_tensor_component_axes(dim, t, &a, &b);
        cell->P[a][b] = cell->P[b][a] = f[t];
    }
    SETS for (int M = 3; M < 1 << dim; M++) if (M & (M - 1)) for (int i = 0; i < dim; i++) cell->force[M][i] = f[k++];
}

#endif
