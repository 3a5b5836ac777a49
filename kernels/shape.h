/* floor 2: shape functions of the background grid in one dimension; two and three dimensions are products.
 *
 * Position r is counted in node distances h, l is the half width of the particle over h. A shape returns its lowest node
 * and the weights N and slopes dN/dr of shape_nodes() nodes from there. All are partitions of unity and reproduce
 * linear fields. Sheet 1.2; linear and GIMP: Bardenhagen & Kober 2004, Zeng et al. 2021, eq. 9. */
#ifndef CLEAVE_SHAPE_H
#define CLEAVE_SHAPE_H

#include <math.h>

#include "kernels.h"

enum { SHAPE_NODES_MAX = 4 };

static ALWAYS_INLINE int shape_nodes(const enum shape shape)
{
    return shape == SHAPE_LINEAR ? 2 : shape == SHAPE_CUBIC ? 4 : 3;
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
    case SHAPE_GIMP:
    case SHAPE_CPGIMP: return shape_gimp(r, l, N, dN);
    case SHAPE_QUADRATIC: return shape_quadratic(r, N, dN);
    default: return shape_cubic(r, N, dN);
    }
}

/* Weights of one particle over its box of nodes. */
struct stencil {
    int64_t node;                                        /* index of its lowest node          */
    real N[DIM_MAX][SHAPE_NODES_MAX];                    /* weights per direction         [1] */
    real dN[DIM_MAX][SHAPE_NODES_MAX];                   /* slopes per direction        [1/m] */
    real r[DIM_MAX];                                     /* distance to its lowest node   [m] */
};

/* Largest half width over h that GIMP's pieces allow; a particle stretched further keeps it (numerical fracture then
 * starts, sheet 1.2). */
#define HALF_WIDTH_MOST 0.5

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
        s->r[d] = (r - (real)base) * g->h;
        s->node += (base - g->first[d]) * g->stride[d];
    }
}

/* Loops over the nodes of a stencil by their places k0 k1 k2; unused directions fold away. */
#define FOR_NODES(dim, shape)                                                                                     \
    for (int k2 = 0; k2 < ((dim) > 2 ? shape_nodes(shape) : 1); k2++)                                           \
        for (int k1 = 0; k1 < ((dim) > 1 ? shape_nodes(shape) : 1); k1++)                                       \
            for (int k0 = 0; k0 < shape_nodes(shape); k0++)

static ALWAYS_INLINE int64_t stencil_index(const struct stencil *s, const struct grid *g, int k0, int k1, int k2, const int dim)
{
    int64_t I = s->node + k0;
    if (dim > 1) I += k1 * g->stride[1];
    if (dim > 2) I += k2 * g->stride[2];
    return I;
}

static ALWAYS_INLINE real stencil_weight(const struct stencil *s, int k0, int k1, int k2, const int dim)
{
    real N = s->N[0][k0];
    if (dim > 1) N *= s->N[1][k1];
    if (dim > 2) N *= s->N[2][k2];
    return N;
}

static ALWAYS_INLINE void stencil_gradient(const struct stencil *s, int k0, int k1, int k2, real *grad, const int dim)
{
    grad[0] = s->dN[0][k0];
    if (dim > 1) grad[0] *= s->N[1][k1], grad[1] = s->N[0][k0] * s->dN[1][k1];
    if (dim > 2) {
        grad[0] *= s->N[2][k2], grad[1] *= s->N[2][k2];
        grad[2] = s->N[0][k0] * s->N[1][k1] * s->dN[2][k2];
    }
}

#endif
