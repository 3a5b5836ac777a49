/* floor 3: the time step that single cells of the mesh allow. */
#include <math.h>
#include <string.h>

#include "memory.h"
#include "mesh_parts.h"
#include "mesh_point.h"

/* Adds to the stiffness K of displacements, column by column, the part of a point at place q. */
static void point_stiffness(real *K, const struct elastic *m, int dim, real h, real V, int q)
{
    const int corners = 1 << dim, n = corners * dim;
    for (int column = 0; column < n; column++) {
        real g[DIM_MAX * DIM_MAX] = {0}, s[SYM_MAX], P[DIM_MAX * DIM_MAX];
        for (int d = 0; d < dim; d++) g[column % dim * dim + d] = mesh_slope(dim, column / dim, q, d) / h;
        mesh_point_stress(m, g, s, dim);
        for (int k = 0; k < symmetric_count(dim); k++) {
            int a, b;
            symmetric_axes(dim, k, &a, &b);
            P[a * dim + b] = P[b * dim + a] = s[k];
        }
        for (int c = 0; c < corners; c++)
            for (int a = 0; a < dim; a++)
                for (int b = 0; b < dim; b++) K[column * n + c * dim + a] += V * mesh_slope(dim, c, q, b) / h * P[a * dim + b];
    }
}

enum { ITERATIONS = 200 };

/* Largest eigenvalue of a symmetric matrix by power iteration, a little above. */
static real largest_eigenvalue(const real *A, int n)
{
    real x[CELL_UNKNOWNS_MAX], y[CELL_UNKNOWNS_MAX], value = 0;
    for (int a = 0; a < n; a++) x[a] = 1 + 0.37 * a - 0.11 * a * a;      /* no mode is orthogonal to it */
    for (int k = 0; k < ITERATIONS; k++) {
        const real size = sqrt(dot(x, x, n));
        for (int a = 0; a < n; a++) x[a] /= size, y[a] = 0;
        for (int b = 0; b < n; b++)
            for (int a = 0; a < n; a++) y[a] += A[b * n + a] * x[b];     /* columns: whole vectors */
        value = sqrt(dot(y, y, n));
        memcpy(x, y, sizeof x);
    }
    return value * 1.001;
}

/* A mesh moves no faster than its stiffest cell would alone, with the masses of its own points: of m^-1/2 K m^-1/2 [1/s^2]. */
static real cell_eigenvalue(const struct elastic *m, int dim, real h, real V, real density, unsigned places)
{
    const int corners = 1 << dim, n = corners * dim;
    real K[CELL_UNKNOWNS_MAX * CELL_UNKNOWNS_MAX] = {0}, mass[CORNERS_MAX] = {0};
    for (int q = 0; q < corners; q++) {
        if (!(places >> q & 1)) continue;
        for (int c = 0; c < corners; c++) mass[c] += density * V * mesh_weight(dim, c, q);
        point_stiffness(K, m, dim, h, V, q);
    }
    for (int b = 0; b < n; b++)
        for (int a = 0; a < n; a++) K[b * n + a] /= sqrt(mass[a / dim] * mass[b / dim]);
    return largest_eigenvalue(K, n);
}

static unsigned places_of(const struct mesh *mesh, int64_t I)
{
    const int dim = mesh->grid.dim;
    unsigned places = 0;
    for (int q = 0; q < 1 << dim; q++) places |= (unsigned)(mesh->point[(I << dim) + q] >= 0) << q;
    return places;
}

real mesh_critical_step(const struct mesh *mesh, const struct mesh_source *source, const real *density, bool any)
{
    const int dim = mesh->grid.dim, sets = 1 << (1 << dim);
    bool *there = NEW("mesh.there", sets, bool);
    for (int64_t k = 0; k < mesh->cuts; k++) there[places_of(mesh, mesh->cut[k])] = true;
    real most = 0;
    for (int set = 1; set < sets; set++) {
        if (!any && !there[set] && set != sets - 1) continue;
        for (int m = 0; m < source->materials; m++)
            most = real_max(most, cell_eigenvalue(&source->elastic[m], dim, mesh->grid.h, mesh->volume, density[m],
                                                  (unsigned)set));
    }
    memory_free(there);
    return 2 / sqrt(most);
}
