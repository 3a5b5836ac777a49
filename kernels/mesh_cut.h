/* floor 2: eight cut cells: what is left of the points of each answers by a stiffness of its own.
 *
 * A cell's energy hangs on its mean strain and on what bends it (mesh_law.h), not on its translation and rotation: in 3D on
 * 18 modes, not on 24 displacements. The stiffness is that of these modes, eight cells side by side: of its symmetric part
 * one half is stored, 171 numbers in 3D and 15 in the plane, and the odd part only where partial stress has one (state-based
 * models). Shear strains count by their angle, so that what belongs to them is their stress. */
#ifndef CLEAVE_MESH_CUT_H
#define CLEAVE_MESH_CUT_H

#include "mesh_law.h"

/* Displacements of the corners of the eight cut cells of a group. */
static ALWAYS_INLINE void mesh_cut_load(const struct mesh *mesh, int64_t group, lanes u[CORNERS_MAX][3], const int dim)
{
    const int32_t *cell = mesh->cut + group * LANES;
    const int32_t first = cell[LANES - 1] - cell[0] == LANES - 1 ? cell[0] : -1;
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) u[c][i] = lanes_at(mesh->displacement[i] + mesh->corner[c], first, cell);
}

/* Modes as one vector: symmetric components of the mean strain, then what bends, set by set. */
static ALWAYS_INLINE void cut_modes(const struct mesh_cell *s, lanes *v, const int dim)
{
    int n = symmetric_count(dim);
    for (int k = 0; k < n; k++) {
        int a, b;
        symmetric_axes(dim, k, &a, &b);
        v[k] = a == b ? s->e[a][a] : s->e[a][b] + s->e[b][a];
    }
    SETS for (int M = 3; M < 1 << dim; M++)
        if (M & (M - 1)) for (int i = 0; i < dim; i++) v[n++] = s->mode[M][i];
}

/* f = K v of the symmetric part, half of which is stored, row by row from the diagonal on. */
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

/* f += K v of the odd part, stored the same way without its diagonal. */
static ALWAYS_INLINE void cut_add_odd(const lanes *K, const lanes *v, lanes *f, const int n)
{
    for (int a = 0; a < n; a++)
        for (int b = a + 1; b < n; b++, K++) f[a] += *K * v[b], f[b] -= *K * v[a];
}

/* Stress and forces of the modes; v keeps the modes. */
static ALWAYS_INLINE void cut_law(const struct mesh *mesh, int64_t group, struct mesh_cell *s, lanes *v, const int dim)
{
    const int n = mesh_modes(dim), half = n * (n + 1) / 2, odd = half - n;
    const int64_t alike = mesh->alike[group];
    lanes f[MODES_MAX];
    cut_modes(s, v, dim);
    cut_times((const lanes *)mesh->stiffness + alike * half, v, f, n);
    if (mesh->odd) cut_add_odd((const lanes *)mesh->odd + alike * odd, v, f, n);
    int k = symmetric_count(dim);
    for (int t = 0; t < k; t++) {
        int a, b;
        symmetric_axes(dim, t, &a, &b);
        s->P[a][b] = s->P[b][a] = f[t];
    }
    SETS for (int M = 3; M < 1 << dim; M++)
        if (M & (M - 1)) for (int i = 0; i < dim; i++) s->force[M][i] = f[k++];
}

/* Adds the skew stress that bonds off their line leave: it balances their torque, and is not balanced itself. */
static ALWAYS_INLINE void cut_add_skew(const struct mesh *mesh, int64_t group, struct mesh_cell *s, const lanes *v, const int dim)
{
    const int n = mesh_modes(dim), count = mesh_skews(dim);
    const lanes *K = (const lanes *)mesh->skew + mesh->alike[group] * count * n;
    lanes f[MODES_MAX];
    int k = dim * (dim - 1) / 2;
    for (int a = 0; a < count; a++) {
        f[a] = lanes_of(0);
        for (int b = 0; b < n; b++, K++) f[a] += *K * v[b];
    }
    for (int t = 0; t < k; t++) {
        int a, b;
        symmetric_axes(dim, dim + t, &a, &b);
        s->P[a][b] += f[t], s->P[b][a] -= f[t];
    }
    SETS for (int M = 3; M < 1 << dim; M++)
        if (M & (M - 1)) for (int i = 0; i < dim; i++) s->force[M][i] += f[k++];
}

#endif
