/* floor 2: what the material points of a mesh know: their motion, their stress, and whether it asks for conversion. */
#include "mesh_point.h"

/* Motion of one point: weights are constants, u_p = sum N u_I, v_p = sum N v_I. */
static ALWAYS_INLINE void point_move(const struct mesh *mesh, struct particles *p, int64_t i, const int dim)
{
    const int64_t I = mesh->place[i] >> dim;
    const int q = mesh->place[i] & ((1 << dim) - 1);
    for (int a = 0; a < dim; a++) {
        real u = 0, v = 0;
        for (int c = 0; c < 1 << dim; c++) {
            const real N = mesh_weight(dim, c, q);
            u += N * mesh->displacement[a][I + mesh->corner[c]];
            v += N * mesh->grid.velocity[a][I + mesh->corner[c]];
        }
        p->x[a][i] = p->X[a][i] + u;
        p->v[a][i] = v;
    }
}

#define MOVE(D)                                                                                                      \
    static void points_move_##D(const struct mesh *mesh, struct particles *p, const int32_t *list, int64_t n)        \
    {                                                                                                                \
        _Pragma("omp parallel for schedule(static)") for (int64_t k = 0; k < n; k++)                                 \
        {                                                                                                            \
            const int64_t i = list ? list[k] : k;                                                                    \
            if (mesh->place[i] >= 0) point_move(mesh, p, i, D);                                                      \
        }                                                                                                            \
    }
MOVE(1)
MOVE(2)
MOVE(3)

void mesh_points_move(const struct mesh *mesh, struct particles *p, const int32_t *list, int64_t n)
{
    if (p->dim == 1) points_move_1(mesh, p, list, n);
    else if (p->dim == 2) points_move_2(mesh, p, list, n);
    else points_move_3(mesh, p, list, n);
}

void mesh_points_force(struct mesh *mesh, const struct particles *p, const int32_t *list, int64_t n)
{
    const int dim = p->dim;
    for (int64_t k = 0; k < n; k++) {            /* few, and several share a node: in order */
        const int64_t i = list[k], I = mesh->place[i] >> dim;
        const int q = mesh->place[i] & ((1 << dim) - 1);
        for (int c = 0; c < 1 << dim; c++)
            for (int a = 0; a < dim; a++)
                mesh->grid.force[a][I + mesh->corner[c]] += mesh_weight(dim, c, q) * p->f[a][i];
    }
}

/* Cauchy stress R sym(s U) R^T/det U of a point, and its volume. */
static void point_stress(const struct mesh *mesh, struct particles *p, const struct elastic *m, int64_t i, bool finite)
{
    const int dim = p->dim, n = symmetric_count(dim);
    real R[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, e[9], s[SYM_MAX] = {0}, S[9], T[9], det = 1;
    mesh_point_strain(mesh, i, R, e, dim, finite);
    mesh_point_stress(m, e, s, dim);
    if (!finite) {
        for (int k = 0; k < n; k++) p->stress[k][i] = s[k];
        return;
    }
    for (int k = 0; k < n; k++) {
        int a, b;
        symmetric_axes(dim, k, &a, &b);
        S[a * dim + b] = S[b * dim + a] = s[k];
    }
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) {
            T[a * dim + b] = S[a * dim + b];
            for (int k = 0; k < dim; k++) T[a * dim + b] += S[a * dim + k] * 0.5 * (e[k * dim + b] + e[b * dim + k]);
        }
    if (dim == 1) det = 1 + e[0];
    if (dim == 2) det = (1 + e[0]) * (1 + e[3]) - e[1] * e[2];
    if (dim == 3)
        det = (1 + e[0]) * ((1 + e[4]) * (1 + e[8]) - e[5] * e[7]) - e[1] * (e[3] * (1 + e[8]) - e[5] * e[6]) +
              e[2] * (e[3] * e[7] - (1 + e[4]) * e[6]);
    for (int k = 0; k < n; k++) {
        int a, b;
        real sum = 0;
        symmetric_axes(dim, k, &a, &b);
        for (int c = 0; c < dim; c++)
            for (int d = 0; d < dim; d++)
                sum += R[a * dim + c] * 0.5 * (T[c * dim + d] + T[d * dim + c]) * R[b * dim + d];
        p->stress[k][i] = sum / (dim == 1 ? 1 : det);
    }
    p->volume[i] = p->volume0[i] * det;
}

void mesh_points_stress(const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite)
{
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++)
        if (mesh->place[i] >= 0) point_stress(mesh, p, &m[p->material[i]], i, finite);
}

/* ---- conversion ------------------------------------------------------------------------------------------- */

/* Marks the points of a cell whose largest principal stress passes the trigger. */
static ALWAYS_INLINE void cell_mark(const struct mesh *mesh, struct particles *p, const struct elastic *m, int64_t I,
                                    const int dim, bool finite)
{
    for (int q = 0; q < 1 << dim; q++) {
        const int32_t i = mesh->point[(I << dim) + q];
        real R[9], e[9], s[SYM_MAX];
        if (i < 0) continue;
        const struct elastic *own = &m[p->material[i]];
        mesh_point_strain(mesh, i, R, e, dim, finite);
        mesh_point_stress(own, e, s, dim);
        if (stress_bound(s, dim) > own->trigger && stress_principal(s, dim) > own->trigger) p->flag[i] |= FLAG_STRESSED;
    }
}

#define MARK(D)                                                                                                      \
    static void cells_mark_##D(const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite)   \
    {                                                                                                                \
        for (int64_t k = 0; k < mesh->cuts; k++)                                                                     \
            if (mesh->cut_stressed[k]) cell_mark(mesh, p, m, mesh->cut[k], D, finite);                               \
        for (int64_t r = 0; r < mesh->runs; r++)                                                                     \
            for (int64_t k = 0; mesh->run[r].stressed && k < mesh->run[r].cells; k++)                                \
                cell_mark(mesh, p, m, mesh->run[r].cell + k, D, finite);                                             \
    }
MARK(1)
MARK(2)
MARK(3)

void mesh_points_mark(const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite)
{
    if (p->dim == 1) cells_mark_1(mesh, p, m, finite);
    else if (p->dim == 2) cells_mark_2(mesh, p, m, finite);
    else cells_mark_3(mesh, p, m, finite);
}
