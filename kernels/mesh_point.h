/* floor 2: strain and stress of one material point of a mesh, plainly: what the closed forms of mesh_law.h add up. */
#ifndef CLEAVE_MESH_POINT_H
#define CLEAVE_MESH_POINT_H

#include "kernels.h"
#include "polar.h"
#include "stress.h"

/* Gradient of the displacement at place q of cell I, or with q < 0 the mean, row major. */
static ALWAYS_INLINE void mesh_gradient(const struct mesh *mesh, int64_t I, int q, real *g, const int dim)
{
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) {
            real sum = 0;
            for (int c = 0; c < 1 << dim; c++) {
                const real slope = q < 0 ? (c >> b & 1 ? 1.0 : -1.0) / (1 << (dim - 1)) : mesh_slope(dim, c, q, b);
                sum += slope * mesh->displacement[a][I + mesh->corner[c]];
            }
            g[a * dim + b] = sum / mesh->grid.h;
        }
}

/* e = R^T F_p - 1 of point i, R the rotation of its cell's mean gradient (1 at small strain). Row major; only the
 * symmetric part is strain. */
static ALWAYS_INLINE void mesh_point_strain(const struct mesh *mesh, int64_t i, real *R, real *e, const int dim, bool finite)
{
    const int64_t I = mesh->place[i] >> dim;
    real g[9], mean[9];
    mesh_gradient(mesh, I, mesh->place[i] & ((1 << dim) - 1), g, dim);
    if (!finite || dim == 1) {
        for (int k = 0; k < dim * dim; k++) e[k] = g[k];
        R[0] = 1;
        return;
    }
    mesh_gradient(mesh, I, -1, mean, dim);
    for (int a = 0; a < dim; a++) mean[a * dim + a] += 1;
    polar_rotation(mean, R, dim);
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) {
            e[a * dim + b] = R[b * dim + a] - (a == b);
            for (int k = 0; k < dim; k++) e[a * dim + b] += R[k * dim + a] * g[k * dim + b];
        }
}

/* C : sym e, symmetric components. */
static ALWAYS_INLINE void mesh_point_stress(const struct elastic *m, const real *e, real *s, const int dim)
{
    for (int a = 0; a < dim; a++) {
        s[a] = m->c11 * e[a * dim + a];
        for (int b = 0; b < dim; b++)
            if (b != a) s[a] += m->c12 * e[b * dim + b];
    }
    for (int k = dim; k < symmetric_count(dim); k++) {
        int a, b;
        symmetric_axes(dim, k, &a, &b);
        s[k] = m->shear * (e[a * dim + b] + e[b * dim + a]);
    }
}

#endif
