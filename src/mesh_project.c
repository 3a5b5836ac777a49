/* floor 3: from points to nodes of a mesh, once: the nodal field that fits what the points have. */
#include <math.h>
#include <string.h>

#include "memory.h"
#include "mesh_parts.h"
#include "team.h"

enum { ITERATIONS_MOST = 500 };
#define TOLERANCE 1e-15                  /* of the largest nodal momentum */

/* to = sum m_p N_I value_p, value from the points, or where it is NULL from the nodes `from`. In order. */
static void spread(const struct mesh *mesh, const struct particles *p, const real *value, const real *from, real *to)
{
    const int dim = p->dim;
    memset(to, 0, sizeof *to * (size_t)mesh->grid.n);
    for (int64_t i = 0; i < p->n; i++) {
        if (mesh->place[i] < 0) continue;
        const int64_t I = mesh->place[i] >> dim;
        const int q = mesh->place[i] & ((1 << dim) - 1);
        real here = value ? value[i] : 0;
        for (int c = 0; c < 1 << dim && !value; c++) here += mesh_weight(dim, c, q) * from[I + mesh->corner[c]];
        for (int c = 0; c < 1 << dim; c++) to[I + mesh->corner[c]] += p->mass[i] * mesh_weight(dim, c, q) * here;
    }
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

/* Conjugate gradients on the consistent mass matrix, with the lumped one as preconditioner. */
static void project(const struct mesh *mesh, const struct particles *p, const real *value, real *x)
{
    const int64_t n = mesh->grid.n;
    const real *inverse = mesh->inverse_mass;
    real *r = NEW("mesh.r", n, real), *d = NEW("mesh.d", n, real), *q = NEW("mesh.q", n, real);
    spread(mesh, p, value, NULL, r);
    const real scale = largest_of(r, n);
    for (int64_t I = 0; I < n; I++) x[I] = r[I] * inverse[I];
    spread(mesh, p, NULL, x, q);
    for (int64_t I = 0; I < n; I++) r[I] -= q[I], d[I] = r[I] * inverse[I];
    real rho = team_sum(n, product_term, &(struct pair){r, r, inverse});
    for (int k = 0; k < ITERATIONS_MOST && largest_of(r, n) > TOLERANCE * scale; k++) {
        spread(mesh, p, NULL, d, q);
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
    for (int a = 0; a < p->dim; a++) project(mesh, p, value[a], node[a]);
}
