/* floor 2: shape functions of the background grid in one dimension; two and three dimensions are products.
 *
 * Position r is counted in node distances h, l is the half width of the particle over h. A shape returns its lowest node
 * and the weights N and slopes dN/dr of shape_nodes() nodes from there. All are partitions of unity and reproduce
 * linear fields. Linear and GIMP: Bardenhagen & Kober 2004, Zeng et al. 2021, eq. 9. */
#ifndef CLEAVE_SHAPE_H
#define CLEAVE_SHAPE_H

#include <math.h>

#include "kernels.h"

enum { SHAPE_NODES_MAX = 4 };

static ALWAYS_INLINE int shape_nodes(const enum shape shape)
{
    return shape == SHAPE_LINEAR ? 2 : shape == SHAPE_CUBIC || shape == SHAPE_CPGIMP ? 4 : 3;
}

/* Floor without the library call that a negative argument would need. */
static ALWAYS_INLINE int64_t floor_to_int(real r)
{
    int64_t k = (int64_t)r;
    return k - (r < (real)k);
}

/* Hat function: N = 1 - |r|. */
static ALWAYS_INLINE int64_t shape_linear(real r, real *N, real *dN)
{
    int64_t base = floor_to_int(r);
    real t = r - (real)base;
    N[0] = 1 - t, N[1] = t;
    dN[0] = -1, dN[1] = 1;
    return base;
}

/* Mean of the hat functions over the particle's width 2l <= 1. The width covers `a` of its first cell and `b` of the
 * next; the mean over each piece is that of a straight line. */
static ALWAYS_INLINE int64_t shape_gimp(real r, real l, real *N, real *dN)
{
    int64_t base = floor_to_int(r - l);
    real u = r - l - (real)base, width = 2 * l, inverse = 1 / width;
    real a = width < 1 - u ? width : 1 - u, b = width - a;
    N[0] = a * inverse * (1 - u - 0.5 * a);
    N[2] = 0.5 * b * b * inverse;
    N[1] = 1 - N[0] - N[2];
    dN[0] = -a * inverse;
    dN[2] = b * inverse;
    dN[1] = -(dN[0] + dN[2]);
    return base;
}

/* Integral of the hat function from -1 to s, and the hat at s; s is taken between -1 and 1. */
static ALWAYS_INLINE real hat_integral(real s, real *hat)
{
    s = s < -1 ? -1 : s > 1 ? 1 : s;
    const real size = fabs(s);
    *hat = 1 - size;
    return 0.5 + s * (1 - 0.5 * size);
}

/* Mean of the hat functions over a width 2l <= 2: a stretched particle reaches into the cells beside its own, whose nodes
 * are the four of its row. Contiguous particles then share out every hat without gap or overlap, and a uniform stress
 * leaves no residual (contiguous particles: Bardenhagen & Kober 2004). */
static ALWAYS_INLINE int64_t shape_cpgimp(real r, real l, real *N, real *dN)
{
    const int64_t cell = floor_to_int(r);
    const real t = r - (real)cell, inverse = 0.5 / l;
    for (int k = 0; k < 4; k++) {
        real left, right;
        const real node = (real)(k - 1), below = hat_integral(t - l - node, &left);
        N[k] = (hat_integral(t + l - node, &right) - below) * inverse;
        dN[k] = (right - left) * inverse;
    }
    return cell - 1;
}

/* N = 3/4 - t^2 and (3/2 - |t|)^2/2. */
static ALWAYS_INLINE int64_t shape_quadratic(real r, real *N, real *dN)
{
    int64_t base = floor_to_int(r - 0.5);
    real t = r - (real)(base + 1);
    N[0] = 0.5 * (0.5 - t) * (0.5 - t), N[1] = 0.75 - t * t, N[2] = 0.5 * (0.5 + t) * (0.5 + t);
    dN[0] = t - 0.5, dN[1] = -2 * t, dN[2] = t + 0.5;
    return base;
}

/* N = 2/3 - t^2 + |t|^3/2 and (2 - |t|)^3/6. */
static ALWAYS_INLINE int64_t shape_cubic(real r, real *N, real *dN)
{
    int64_t cell = floor_to_int(r);
    real t = r - (real)cell, s = 1 - t;
    N[0] = s * s * s / 6, N[1] = 2.0 / 3 - t * t + 0.5 * t * t * t;
    N[2] = 2.0 / 3 - s * s + 0.5 * s * s * s, N[3] = t * t * t / 6;
    dN[0] = -0.5 * s * s, dN[1] = -2 * t + 1.5 * t * t;
    dN[2] = 2 * s - 1.5 * s * s, dN[3] = 0.5 * t * t;
    return cell - 1;
}

static ALWAYS_INLINE int64_t shape_1d(const enum shape shape, real r, real l, real *N, real *dN)
{
    switch (shape) {
    case SHAPE_LINEAR: return shape_linear(r, N, dN);
    case SHAPE_GIMP: return shape_gimp(r, l, N, dN);
    case SHAPE_CPGIMP: return shape_cpgimp(r, l, N, dN);
    case SHAPE_QUADRATIC: return shape_quadratic(r, N, dN);
    default: return shape_cubic(r, N, dN);
    }
}

/* ---- the nodes of one particle ---------------------------------------------------------------------- */

/* Four nodes in a row along x, from the node below the particle's cell: wide enough for every shape, and the same four
 * for all particles of a cell, so that a row just written is read again whole. */
enum { ROW = 4 };
typedef real row_of_nodes __attribute__((vector_size(ROW * sizeof(real))));
typedef real row_anywhere __attribute__((vector_size(ROW * sizeof(real)), aligned(sizeof(real)), may_alias));

static ALWAYS_INLINE row_of_nodes row_load(const real *from) { return (row_of_nodes) * (const row_anywhere *)from; }
static ALWAYS_INLINE void row_add(real *to, row_of_nodes a) { *(row_anywhere *)to = row_load(to) + a; }
static ALWAYS_INLINE real row_sum(row_of_nodes a) { return (a[0] + a[1]) + (a[2] + a[3]); }

/* Weights of one particle: a row along x, and the rows of its box in the other directions. */
struct stencil {
    int64_t node;                                        /* index of the lowest node            */
    row_of_nodes N0, dN0;                                /* weights [1] and slopes [1/m] along x */
    real N[DIM_MAX][SHAPE_NODES_MAX];                    /* weights per direction y, z      [1] */
    real dN[DIM_MAX][SHAPE_NODES_MAX];                   /* slopes per direction y, z     [1/m] */
    real r[DIM_MAX];                                     /* distance to the lowest node     [m] */
};

/* Largest half width over h of cpGIMP: four nodes reach no further. A particle stretched beyond it keeps it, and numerical
 * fracture starts: at a stretch of 4 with two particles per cell. */
#define HALF_WIDTH_MOST 1

/* Weights from `base` as a row from the node below the cell. */
static ALWAYS_INLINE row_of_nodes row_shifted(const enum shape shape, const real *N, bool from_cell)
{
    if (shape == SHAPE_LINEAR) return (row_of_nodes){0, N[0], N[1], 0};
    if (shape_nodes(shape) == ROW) return (row_of_nodes){N[0], N[1], N[2], N[3]};
    return from_cell ? (row_of_nodes){0, N[0], N[1], N[2]} : (row_of_nodes){N[0], N[1], N[2], 0};
}

static ALWAYS_INLINE void stencil_make(struct stencil *s, const struct grid *g, const struct particles *p, int64_t i,
                                       real half_width, const int dim, const enum shape shape)
{
    const real inverse = 1 / g->h;
    s->node = 0;
    for (int d = 0; d < dim; d++) {
        real r = (p->x[d][i] - g->anchor[d]) * inverse, l = half_width * inverse;
        if (shape == SHAPE_CPGIMP) {
            l *= p->stretch[d][i];
            if (l > HALF_WIDTH_MOST) l = HALF_WIDTH_MOST;
        }
        int64_t base = shape_1d(shape, r, l, s->N[d], s->dN[d]);
        for (int k = 0; k < shape_nodes(shape); k++) s->dN[d][k] *= inverse;
        if (d == 0) {
            const int64_t cell = floor_to_int(r);
            s->N0 = row_shifted(shape, s->N[0], base == cell);
            s->dN0 = row_shifted(shape, s->dN[0], base == cell);
            base = cell - 1;
        }
        s->r[d] = (r - (real)base) * g->h;
        s->node += (base - g->first[d]) * g->stride[d];
    }
}

/* Loops over the rows of a stencil by their places k1 k2; unused directions fold away. */
#define FOR_ROWS(dim, shape)                                                        \
    for (int k2 = 0; k2 < ((dim) > 2 ? shape_nodes(shape) : 1); k2++)               \
        for (int k1 = 0; k1 < ((dim) > 1 ? shape_nodes(shape) : 1); k1++)

/* First node of a row. */
static ALWAYS_INLINE int64_t stencil_row(const struct stencil *s, const struct grid *g, int k1, int k2, const int dim)
{
    return s->node + (dim > 1 ? k1 * g->stride[1] : 0) + (dim > 2 ? k2 * g->stride[2] : 0);
}

static ALWAYS_INLINE row_of_nodes stencil_weight(const struct stencil *s, int k1, int k2, const int dim)
{
    real across = 1;
    if (dim > 1) across *= s->N[1][k1];
    if (dim > 2) across *= s->N[2][k2];
    return s->N0 * across;
}

static ALWAYS_INLINE void stencil_gradient(const struct stencil *s, int k1, int k2, row_of_nodes *grad, const int dim)
{
    const real N1 = dim > 1 ? s->N[1][k1] : 1, N2 = dim > 2 ? s->N[2][k2] : 1;
    grad[0] = s->dN0 * (N1 * N2);
    if (dim > 1) grad[1] = s->N0 * (s->dN[1][k1] * N2);
    if (dim > 2) grad[2] = s->N0 * (N1 * s->dN[2][k2]);
}

#endif
