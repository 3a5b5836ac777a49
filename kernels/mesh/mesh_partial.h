/* Eight partial cells at once, each with its own stiffness, which follows from the points that it still has.
 *
 * The energy of a cell depends on its mean strain and its bending modes (mesh_law.h), not on translation and rotation:
 * in 3D on 18 modes instead of 24 displacements. The stiffness acts on these modes and is symmetric: one half is
 * stored, 171 numbers in 3D and 15 in 2D. Shear strains are angles (twice the tensor component), so their conjugate
 * forces are stresses. */
#ifndef CLEAVE_KERNELS_MESH_PARTIAL
#define CLEAVE_KERNELS_MESH_PARTIAL

#include "mesh_law.h"

/* Loads the displacements u of the corners of the eight partial cells of a group [m]. */
static ALWAYS_INLINE void mesh_partial_load(const struct mesh *mesh, int64_t group, lanes u[CORNERS_MAX][3],
                                            const int dim)
{
    const int32_t *cell = mesh->partial_cell + group * LANES, *own = mesh_group_corners(mesh, group, dim);
    const int32_t first = cell[LANES - 1] - cell[0] == LANES - 1 ? cell[0] : -1;
    for (int c = 0; c < 1 << dim && own; c++)
        for (int i = 0; i < dim; i++) u[c][i] = lanes_at(mesh->displacement[i], -1, own + c * LANES);
    if (own) return;
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) u[c][i] = lanes_at(mesh->displacement[i] + mesh->corner[c], first, cell);
}

/* Stores the modes as one vector v [1]: symmetric components of the mean strain, then the bending modes, set by set. */
static ALWAYS_INLINE void partial_modes(const struct mesh_cell *s, lanes *v, const int dim)
{
    int n = symmetric_count(dim);
    for (int k = 0; k < n; k++) {
        int a, b;
        symmetric_axes(dim, k, &a, &b);
        v[k] = a == b ? s->e[a][a] : s->e[a][b] + s->e[b][a];
    }
    SETS for (int M = 3; M < 1 << dim; M++) if (M & (M - 1)) for (int i = 0; i < dim; i++) v[n++] = s->mode[M][i];
}

/* Computes f = K v for a symmetric matrix K of which one half is stored, row by row from the diagonal on. */
static ALWAYS_INLINE void cut_times(const lanes *K, const lanes *v, lanes *f, const int n)
{
    for (int a = 0; a < n; a++) f[a] = lanes_of(0);
#pragma GCC unroll 18
    for (int a = 0; a < n; a++) {
        lanes sum = f[a] + *K++ * v[a];
#pragma GCC unroll 18
        for (int b = a + 1; b < n; b++, K++) sum += *K * v[b], f[b] += *K * v[a];
        f[a] = sum;
    }
}

/* Adds the forces of state-based bonds on the modes of the cells of a group: f += share^T pull for each bonded point
 * (struct mesh_end) [Pa]. */
static ALWAYS_INLINE void partial_add_ends(const struct mesh *mesh, const struct particles *p, int64_t group, lanes *f,
                                           const int dim)
{
    const struct mesh_end *end = mesh->end + mesh->ends[group], *last = mesh->end + mesh->ends[group + 1];
    const int n = mesh_modes(dim);
    const real inverse = 1 / (mesh->volume * (1 << dim));
    for (; end < last; end++) {
        const real pull = p->end_pull[end->point] * inverse;
        const real *share = mesh->end_share + (end - mesh->end) * n;
        for (int k = 0; k < n; k++) f[k][end->lane] += share[k] * pull;
    }
}

/* Adds the moments of bonds about the bonded points of a group, per volume of the cell, to moment[axis] [Pa]. */
static ALWAYS_INLINE void partial_add_moments(const struct mesh *mesh, const struct particles *p, int64_t group,
                                              lanes *moment, const int dim)
{
    const struct mesh_end *end = mesh->end + mesh->ends[group], *last = mesh->end + mesh->ends[group + 1];
    const real inverse = 1 / (mesh->volume * (1 << dim));
    for (; end < last; end++)
        for (int k = dim == 2 ? 2 : 0, c = 0; k < 3; k++, c++)
            moment[k][end->lane] += p->end_moment[c][end->point] * inverse;
}

/* Computes the stress of the mean strain and the forces on the bending modes of a group of partial cells [Pa]. */
static ALWAYS_INLINE void partial_law(const struct mesh *mesh, const struct particles *p, int64_t group,
                                      struct mesh_cell *s, const int dim)
{
    const int n = mesh_modes(dim), half = n * (n + 1) / 2;
    lanes v[MODES_MAX], f[MODES_MAX];
    partial_modes(s, v, dim);
    cut_times((const lanes *)mesh->stiffness + mesh->alike[group] * half, v, f, n);
    if (mesh->ends) partial_add_ends(mesh, p, group, f, dim);
    int k = symmetric_count(dim);
    for (int t = 0; t < k; t++) {
        int a, b;
        symmetric_axes(dim, t, &a, &b);
        s->P[a][b] = s->P[b][a] = f[t];
    }
    SETS for (int M = 3; M < 1 << dim; M++) if (M & (M - 1)) for (int i = 0; i < dim; i++) s->force[M][i] = f[k++];
}

#endif
