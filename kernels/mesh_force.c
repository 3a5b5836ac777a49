/* floor 2: forces of the mesh on its nodes: whole cells in runs, eight at a time; cut cells by their stiffness.
 *
 * A run adds to the nodes of its cells, layer by layer. Layers are grouped in bands, and bands of one parity share no node:
 * two colours, any number of threads, the same bits. */
#include <string.h>

#include "mesh_cut.h"
#include "mesh_law.h"
#include "mesh_point.h"

/* ---- whole cells ------------------------------------------------------------------------------------------ */

/* {before[7], now[0], .., now[6]} */
static ALWAYS_INLINE lanes shifted(lanes before, lanes now)
{
    return __builtin_shuffle(before, now, (lanes_mask){7, 8, 9, 10, 11, 12, 13, 14});
}

/* Cells side by side share nodes: what a vector of cells gives to its upper corners along x joins what the next lower
 * corners get, one lane further, so that every node of the row is added to once. */
static ALWAYS_INLINE void run_force(const struct mesh *mesh, struct mesh_run *run, const struct elastic *m, const int dim,
                                    const bool finite)
{
    const struct grid *g = &mesh->grid;
    const real volume = mesh->volume * (1 << dim);
    const int64_t row = run->cell / g->count[0], start = run->cell - row * g->count[0];
    const uint8_t *levels = mesh_levels(mesh, row);
    lanes carry[CORNERS_MAX][3], tension = lanes_of(-INFINITY);
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) carry[c][i] = lanes_of(0);
    for (int64_t k = 0; k < run->cells; k += LANES) {
        const int64_t I = run->cell + k;
        lanes u[CORNERS_MAX][3], f[CORNERS_MAX][3];
        if (mesh_asleep(levels, start + k)) continue;      /* so what the cells before carry is 0 */
        mesh_run_load(mesh, run, k, u, dim);
        mesh_cell_force(m, g->h, volume, u, f, &tension, NULL, dim, finite);
        for (int c = 0; c < 1 << dim; c += 2)
            for (int i = 0; i < dim; i++) {
                real *to = g->force[i] + I + mesh->corner[c];
                lanes_store(to, lanes_load(to) + (f[c][i] + shifted(carry[c][i], f[c + 1][i])));
                carry[c][i] = f[c + 1][i];
            }
    }
    if (run->cells % LANES == 0)                 /* else the last upper corners are in the last vector */
        for (int c = 0; c < 1 << dim; c += 2)
            for (int i = 0; i < dim; i++) g->force[i][run->cell + run->cells + mesh->corner[c]] += carry[c][i][LANES - 1];
    run->stressed = false;
    for (int l = 0; l < LANES; l++) run->stressed |= tension[l] > m->trigger;
}

/* Two colours of bands. The parallel region stands in each instance, where dimension and strain are literals. */
#define BANDS(D, FINITE)                                                                                             \
    static void bands_force_##D##_##FINITE(struct mesh *mesh, const struct elastic *m)                               \
    {                                                                                                                \
        _Pragma("omp parallel") for (int colour = 0; colour < 2; colour++)                                           \
        {                                                                                                            \
            _Pragma("omp for schedule(static)") for (int64_t b = colour; b < mesh->bands; b += 2)                    \
                for (int64_t r = mesh->band[b]; r < mesh->band[b + 1]; r++)                                          \
                    run_force(mesh, &mesh->run[r], &m[mesh->run[r].material], D, FINITE);                            \
        }                                                                                                            \
    }

/* ---- cut cells -------------------------------------------------------------------------------------------- */

static ALWAYS_INLINE bool mesh_cut_asleep(const struct mesh *mesh, int64_t k)
{
    return mesh->rest.level[mesh_block(mesh, mesh->cut[k])] == 0;
}

/* q = K u over the corners and components. */
static ALWAYS_INLINE void times(const real *K, const real *u, real *q, const int n)
{
    for (int a = 0; a < n; a++) q[a] = 0;
    for (int b = 0; b < n; b++)
        for (int a = 0; a < n; a++) q[a] += K[b * n + a] * u[b];     /* columns: whole vectors */
}

/* Adds to the corner forces q the skew part w x of the mean stress that balances their moment about the cell's corners at
 * X + u: (tr U - U) w = sum (X + u) x q, and what w gives to a corner is its share of the mean gradient. */
static ALWAYS_INLINE void cut_balance(real h, const real *u, const real *U, real *q, const int dim)
{
    real m[3] = {0}, w[3] = {0};
    for (int k = dim == 2 ? 2 : 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        for (int c = 0; c < 1 << dim; c++)
            m[k] += (mesh_corner(c, i, h) + u[c * dim + i]) * q[c * dim + j] -
                    (mesh_corner(c, j, h) + u[c * dim + j]) * q[c * dim + i];
    }
    if (dim == 2) w[2] = m[2] / (U[0] + U[3]);
    else {
        real A[9], C[9], size = 0;
        for (int a = 0; a < 9; a++) A[a] = (a % 4 == 0 ? U[0] + U[4] + U[8] : 0) - U[a];
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                const int i = (a + 1) % 3, j = (a + 2) % 3, k = (b + 1) % 3, l = (b + 2) % 3;
                C[a * 3 + b] = A[i * 3 + k] * A[j * 3 + l] - A[i * 3 + l] * A[j * 3 + k];
            }
        for (int b = 0; b < 3; b++) size += A[b] * C[b];
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) w[a] += C[a * 3 + b] * m[b] / size;
    }
    for (int c = 0; c < 1 << dim; c++) {
        real slope[DIM_MAX];
        for (int d = 0; d < dim; d++) slope[d] = (c >> d & 1 ? 1 : -1) / (h * (1 << (dim - 1)));
        for (int k = dim == 2 ? 2 : 0; k < 3; k++) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            q[c * dim + j] -= w[k] * slope[i], q[c * dim + i] += w[k] * slope[j];
        }
    }
}

/* May a point of the cell be past the trigger? The bound of whole cells (mesh_law.h), of the corners' displacements. */
static ALWAYS_INLINE bool cut_tension(const struct elastic *m, real h, const real *u, const int dim)
{
    static const real scale[DIM_MAX + 1] = {0, 0.25, 0.5, 1};    /* 2^-(3 - |M|) */
    const real inverse = (1 << (DIM_MAX - dim)) / h;
    real e[DIM_MAX * DIM_MAX], s[SYM_MAX], bent = 0;
    for (int a = 0; a < dim; a++) {
        real v[CORNERS_MAX];
        for (int c = 0; c < 1 << dim; c++) v[c] = u[c * dim + a];
        for (int d = 0; d < dim; d++)
            for (int c = 0; c < 1 << dim; c++)
                if (!(c >> d & 1)) {
                    const real low = v[c], high = v[c | 1 << d];
                    v[c] = low + high, v[c | 1 << d] = high - low;
                }
        for (int d = 0; d < dim; d++) e[a * dim + d] = v[1 << d] * scale[1] * inverse;
        for (int M = 3; M < 1 << dim; M++)
            if (M != 4) bent += fabs(v[M]) * scale[M == 7 ? 3 : 2] * inverse;
    }
    mesh_point_stress(m, e, s, dim);
    return stress_bound(s, dim) + bent * (m->c11 + m->shear) * 0.25 > m->trigger;
}

static ALWAYS_INLINE void cut_force(struct mesh *mesh, const struct elastic *m, int64_t k, const int dim, const bool finite)
{
    const int corners = 1 << dim, n = corners * dim;
    const bool turns = finite && dim > 1;
    real u[CELL_UNKNOWNS_MAX], pull[CELL_UNKNOWNS_MAX], R[DIM_MAX * DIM_MAX], U[DIM_MAX * DIM_MAX];
    real *out = mesh->cut_force + k * n;
    mesh_cell_local(mesh, mesh->cut[k], u, R, U, dim, turns);
    times(mesh->stiffness + k * n * n, u, pull, n);
    for (int a = 0; a < n; a++) out[a] = -pull[a];
    if (turns) cut_balance(mesh->grid.h, u, U, out, dim);
    mesh->cut_stressed[k] = cut_tension(m, mesh->grid.h, u, dim);
    if (mesh->skew) {
        times(mesh->skew + k * n * n, u, pull, n);
        for (int a = 0; a < n; a++) out[a] -= pull[a];
    }
    for (int c = 0; c < corners && turns; c++) {
        real q[DIM_MAX];
        for (int a = 0; a < dim; a++) q[a] = out[c * dim + a];
        for (int a = 0; a < dim; a++) out[c * dim + a] = dot(&R[a * dim], q, dim);
    }
}

/* Few, and several may share a node: computed by the team, added in order. */
static ALWAYS_INLINE void cuts_add(struct mesh *mesh, const int dim)
{
    const int corners = 1 << dim;
    for (int64_t k = 0; k < mesh->cuts; k++)
        for (int c = 0; c < corners && !mesh_cut_asleep(mesh, k); c++)
            for (int a = 0; a < dim; a++)
                mesh->grid.force[a][mesh->cut[k] + mesh->corner[c]] += mesh->cut_force[(k * corners + c) * dim + a];
}

#define CUTS(D, FINITE)                                                                                              \
    static void cuts_force_##D##_##FINITE(struct mesh *mesh, const struct elastic *m)                                \
    {                                                                                                                \
        _Pragma("omp parallel for schedule(static)") for (int64_t k = 0; k < mesh->cuts; k++)                        \
            if (!mesh_cut_asleep(mesh, k)) cut_force(mesh, &m[mesh->cut_material[k]], k, D, FINITE);                                                \
        cuts_add(mesh, D);                                                                                           \
    }

/* ---- all -------------------------------------------------------------------------------------------------- */

#define MESH_FORCES(X) X(1, 0) X(2, 0) X(2, 1) X(3, 0) X(3, 1)
MESH_FORCES(BANDS)
MESH_FORCES(CUTS)

void mesh_force(struct mesh *mesh, const struct elastic *m, bool finite)
{
#define CASE(D, FINITE)                                                                                              \
    if (mesh->grid.dim == D && (D == 1 || finite == FINITE)) {                                                       \
        bands_force_##D##_##FINITE(mesh, m);                                                                         \
        cuts_force_##D##_##FINITE(mesh, m);                                                                          \
    }
    MESH_FORCES(CASE)
#undef CASE
}
