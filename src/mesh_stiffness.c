/* floor 3: stiffness of single cells of the mesh, point by point, and the time step they allow. */
#include <math.h>
#include <string.h>

#include "eigenvalue.h"
#include "memory.h"
#include "mesh_parts.h"
#include "mesh_point.h"

/* Stress that a point gives for the displacement gradient g: symmetric part of C : sym g less what bonds carry, and the skew
 * part that goes with it. */
static void given(const struct elastic *m, const struct elastic *isotropic, const struct partial_stress *partial,
                  int32_t entry, const real *g, real *P, real *S, int dim)
{
    const int n = symmetric_count(dim), rows = n - dim;
    real s[SYM_MAX] = {0}, left[SYM_MAX] = {0};
    mesh_point_stress(isotropic, g, s, dim);
    mesh_point_stress(m, g, left, dim);
    memset(S, 0, sizeof(real) * (size_t)(dim * dim));
    if (entry >= 0) {
        const real *M = partial->matrix + (int64_t)entry * n * n;
        for (int k = 0; k < n; k++) left[k] -= dot(&M[k * n], s, n);
        for (int k = 0; k < rows && partial->skew; k++) {
            int a, b;
            symmetric_axes(dim, dim + k, &a, &b);
            const real skew = -dot(partial->skew + ((int64_t)entry * rows + k) * n, s, n);
            S[a * dim + b] += skew, S[b * dim + a] -= skew;
        }
    }
    for (int k = 0; k < n; k++) {
        int a, b;
        symmetric_axes(dim, k, &a, &b);
        P[a * dim + b] = P[b * dim + a] = left[k];
    }
}

/* Adds the part of the point at place q. What it gives hangs on its strain alone: found once for each component, a shear by its
 * angle, and put together for every corner. */
static void point_stiffness(real *K, real *skew, const struct elastic *m, const struct elastic *isotropic, int dim, real h,
                            real V, int q, const struct partial_stress *partial, int32_t entry)
{
    const int corners = 1 << dim, n = corners * dim, components = symmetric_count(dim), squares = dim * dim;
    real P[SYM_MAX][DIM_MAX * DIM_MAX], S[SYM_MAX][DIM_MAX * DIM_MAX], slope[CORNERS_MAX][DIM_MAX];
    for (int t = 0; t < components; t++) {
        real g[DIM_MAX * DIM_MAX] = {0};
        int a, b;
        symmetric_axes(dim, t, &a, &b);
        g[a * dim + b] += 0.5, g[b * dim + a] += 0.5;
        given(m, isotropic, partial, entry, g, P[t], S[t], dim);
    }
    for (int c = 0; c < corners; c++)
        for (int d = 0; d < dim; d++) slope[c][d] = mesh_slope(dim, c, q, d) / h;
    for (int column = 0; column < n; column++) {
        real pull[DIM_MAX * DIM_MAX] = {0}, turned[DIM_MAX * DIM_MAX] = {0};
        for (int t = 0; t < components; t++) {
            int a, b;
            symmetric_axes(dim, t, &a, &b);
            if (column % dim != a && column % dim != b) continue;
            const real strain = slope[column / dim][column % dim == a ? b : a];
            for (int k = 0; k < squares; k++) pull[k] += strain * P[t][k], turned[k] += strain * S[t][k];
        }
        for (int c = 0; c < corners; c++)
            for (int a = 0; a < dim; a++)
                for (int b = 0; b < dim; b++) {
                    K[column * n + c * dim + a] += V * slope[c][b] * pull[a * dim + b];
                    if (skew) skew[column * n + c * dim + a] += V * slope[c][b] * turned[a * dim + b];
                }
    }
}

void mesh_stiffness(real *K, real *skew, const struct elastic *m, const struct elastic *isotropic, int dim, real h, real V, unsigned places,
                    const struct partial_stress *partial, const int32_t *entry)
{
    const int corners = 1 << dim, n = corners * dim;
    memset(K, 0, sizeof *K * (size_t)(n * n));
    if (skew) memset(skew, 0, sizeof *skew * (size_t)(n * n));
    for (int q = 0; q < corners; q++)
        if (places >> q & 1) point_stiffness(K, skew, m, isotropic, dim, h, V, q, partial, entry ? entry[q] : -1);
}

/* ---- time step -------------------------------------------------------------------------------------------- */

struct scaled_cell { const real *K, *mass; int n, dim; };

/* y = m^-1/2 K m^-1/2 x. */
static void scaled_stiffness(void *context, const real *x, real *y)
{
    const struct scaled_cell *c = context;
    for (int a = 0; a < c->n; a++) {
        y[a] = 0;
        for (int b = 0; b < c->n; b++) y[a] += c->K[b * c->n + a] * x[b] / sqrt(c->mass[a / c->dim] * c->mass[b / c->dim]);
    }
}

/* A mesh moves no faster than its stiffest cell would alone, with the masses of its own points. */
static real cell_eigenvalue(const struct elastic *m, int dim, real h, real V, real density, unsigned places)
{
    const int corners = 1 << dim;
    real K[CELL_UNKNOWNS_MAX * CELL_UNKNOWNS_MAX], mass[CORNERS_MAX] = {0};
    for (int c = 0; c < corners; c++)
        for (int q = 0; q < corners; q++)
            if (places >> q & 1) mass[c] += density * V * mesh_weight(dim, c, q);
    mesh_stiffness(K, NULL, m, m, dim, h, V, places, NULL, NULL);
    return largest_eigenvalue(corners * dim, scaled_stiffness, &(struct scaled_cell){K, mass, corners * dim, dim});
}

static unsigned places_of(const struct mesh *mesh, int64_t I)
{
    const int dim = mesh->grid.dim;
    unsigned places = 0;
    for (int q = 0; q < 1 << dim; q++) places |= (unsigned)(mesh->point[(I << dim) + q] >= 0) << q;
    return places;
}

/* Do points of a cell leave part of their stress to bonds? Then it is softer than the same cell by itself. */
static bool leaves_stress(const struct mesh *mesh, const struct partial_stress *partial, int64_t I)
{
    if (!partial || !partial->index) return false;
    for (int q = 0; q < 1 << mesh->grid.dim; q++) {
        const int32_t i = mesh->point[(I << mesh->grid.dim) + q];
        if (i >= 0 && partial->index[i] >= 0) return true;
    }
    return false;
}

real mesh_critical_step(const struct mesh *mesh, const struct mesh_source *source, const real *density, bool any)
{
    const int dim = mesh->grid.dim, sets = 1 << (1 << dim);
    bool *there = NEW("mesh.there", sets, bool);
    for (int64_t k = 0; k < mesh->cuts; k++)
        if (!leaves_stress(mesh, source->partial, mesh->cut[k])) there[places_of(mesh, mesh->cut[k])] = true;
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
