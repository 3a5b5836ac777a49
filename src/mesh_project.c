/* floor 3: from points to nodes of a mesh, once: the nodal field that fits what the points have. */
#include <math.h>
#include <string.h>

#include "memory.h"
#include "mesh_parts.h"
#include "team.h"

enum { ITERATIONS_MOST = 500 };
#define TOLERANCE 1e-15                  /* of the largest nodal momentum */

/* Some nodes are unknown, the others stay; NULL: all are. */
struct unknown { const uint8_t *node; int64_t points; const int32_t *point; };

/* to = sum m_p N_I value_p at unknown nodes, value from the points, or where it is NULL from the nodes `from`. In order. */
static void spread(const struct mesh *mesh, const struct particles *p, const struct unknown *some, const real *value,
                   const real *from, real *to)
{
    const int dim = p->dim;
    memset(to, 0, sizeof *to * (size_t)mesh->grid.n);
    for (int64_t k = 0; k < (some ? some->points : p->n); k++) {
        const int64_t i = some ? some->point[k] : k;
        if (mesh->place[i] < 0) continue;
        const int64_t I = mesh->place[i] >> dim;
        const int q = mesh->place[i] & ((1 << dim) - 1);
        real here = value ? value[i] : 0;
        for (int c = 0; c < 1 << dim && !value; c++) here += mesh_weight(dim, c, q) * from[I + mesh->corner[c]];
        for (int c = 0; c < 1 << dim; c++) to[I + mesh->corner[c]] += p->mass[i] * mesh_weight(dim, c, q) * here;
    }
    for (int64_t I = 0; I < mesh->grid.n && some; I++)
        if (!some->node[I]) to[I] = 0;
}

struct pair { const real *a, *b, *weight; };

static real product_term(const void *context, int64_t I)
{
    const struct pair *q = context;
    return q->a[I] * q->b[I] * q->weight[I];
}

static real largest_of(const real *a, int64_t n)
{
    real most = 0;
    for (int64_t I = 0; I < n; I++) most = real_max(most, fabs(a[I]));
    return most;
}

/* Conjugate gradients on the consistent mass matrix, with the lumped one as preconditioner, from the start x. */
static void project(const struct mesh *mesh, const struct particles *p, const struct unknown *some, const real *value, real *x)
{
    const int64_t n = mesh->grid.n;
    const real *inverse = mesh->inverse_mass;
    real *r = NEW("mesh.r", n, real), *d = NEW("mesh.d", n, real), *q = NEW("mesh.q", n, real);
    spread(mesh, p, some, value, NULL, r);
    const real scale = largest_of(r, n);
    for (int64_t I = 0; I < n && !some; I++) x[I] = r[I] * inverse[I];
    spread(mesh, p, some, NULL, x, q);
    for (int64_t I = 0; I < n; I++) r[I] -= q[I], d[I] = r[I] * inverse[I];
    real rho = team_sum(n, product_term, &(struct pair){r, r, inverse});
    for (int k = 0; k < ITERATIONS_MOST && largest_of(r, n) > TOLERANCE * scale; k++) {
        spread(mesh, p, some, NULL, d, q);
        real one = 0;
        for (int64_t I = 0; I < n; I++) one += d[I] * q[I];
        if (!(one > 0)) break;
        const real step = rho / one;
        for (int64_t I = 0; I < n; I++) x[I] += step * d[I], r[I] -= step * q[I];
        const real next = team_sum(n, product_term, &(struct pair){r, r, inverse});
        for (int64_t I = 0; I < n; I++) d[I] = r[I] * inverse[I] + next / rho * d[I];
        rho = next;
    }
    memory_free(r);
    memory_free(d);
    memory_free(q);
}

void mesh_project(const struct mesh *mesh, const struct particles *p, real *const *value, real *const *node)
{
    for (int a = 0; a < p->dim; a++) project(mesh, p, NULL, value[a], node[a]);
}

/* Does the cell of a point have an unknown node? */
static bool looks_at(const struct mesh *mesh, int dim, int64_t i, const uint8_t *node)
{
    for (int c = 0; c < 1 << dim && mesh->place[i] >= 0; c++)
        if (node[(mesh->place[i] >> dim) + mesh->corner[c]]) return true;
    return false;
}

void mesh_project_near(const struct mesh *mesh, const struct particles *p, real *const *value, real *const *node,
                       const int32_t *list, int64_t n)
{
    uint8_t *mark = NEW("mesh.unknown", mesh->grid.n, uint8_t);
    int32_t *point = NEW("mesh.point", p->n, int32_t);
    struct unknown some = {.node = mark, .point = point};
    for (int64_t k = 0; k < n; k++) mark[list[k]] = 1;
    for (int64_t i = 0; i < p->n; i++)
        if (looks_at(mesh, p->dim, i, mark)) point[some.points++] = (int32_t)i;
    for (int a = 0; a < p->dim; a++) project(mesh, p, &some, value[a], node[a]);
    memory_free(mark);
    memory_free(point);
}
