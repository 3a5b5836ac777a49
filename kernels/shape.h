/* floor 2: shape functions of the background grid, and the nodes of a cell.
 *
 * A place t is counted from the lower node of the point's cell in node distances h, l is the half width of the particle
 * over h. A shape gives the weights N and the slopes dN/dt of four nodes in a row, from the one below the cell: wide enough
 * for every shape, and the same four for all points of a cell. Two and three dimensions are products. All shapes are
 * partitions of unity and reproduce linear fields. Linear and GIMP: Bardenhagen & Kober 2004, Zeng et al. 2021, eq. 9. */
#ifndef CLEAVE_SHAPE_H
#define CLEAVE_SHAPE_H

#include <math.h>

#include "kernels.h"

#ifdef __AVX__
#include <immintrin.h>
#endif

enum { ROW = 4 };
typedef real row_of_nodes __attribute__((vector_size(ROW * sizeof(real))));
typedef real row_anywhere __attribute__((vector_size(ROW * sizeof(real)), aligned(sizeof(real)), may_alias));
typedef int64_t row_mask __attribute__((vector_size(ROW * sizeof(int64_t))));
typedef real pair_of_nodes __attribute__((vector_size(2 * sizeof(real))));
typedef real pair_anywhere __attribute__((vector_size(2 * sizeof(real)), aligned(sizeof(real)), may_alias));

static ALWAYS_INLINE row_of_nodes row_of(real a) { return (row_of_nodes){a, a, a, a}; }
static ALWAYS_INLINE real row_sum(row_of_nodes a) { return (a[0] + a[2]) + (a[1] + a[3]); }

/* a where `sign` is negative, else b. Without AVX a comparison of four would be four comparisons. */
static ALWAYS_INLINE row_of_nodes row_choose(row_of_nodes sign, row_of_nodes a, row_of_nodes b)
{
#ifdef __AVX__
    return (row_of_nodes)_mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)sign);
#else
    typedef uint64_t row_bits __attribute__((vector_size(ROW * sizeof(uint64_t))));
    const row_bits mask = -((row_bits)sign >> 63);
    return (row_of_nodes)((mask & (row_bits)a) | (~mask & (row_bits)b));
#endif
}

static ALWAYS_INLINE row_of_nodes row_max(row_of_nodes a, row_of_nodes b)
{
#ifdef __AVX__
    return (row_of_nodes)_mm256_max_pd((__m256d)a, (__m256d)b);
#else
    return row_choose(b - a, a, b);
#endif
}

static ALWAYS_INLINE row_of_nodes row_min(row_of_nodes a, row_of_nodes b)
{
#ifdef __AVX__
    return (row_of_nodes)_mm256_min_pd((__m256d)a, (__m256d)b);
#else
    return row_choose(a - b, a, b);
#endif
}

/* The four sums of four rows. */
static ALWAYS_INLINE row_of_nodes row_sums(row_of_nodes a, row_of_nodes b, row_of_nodes c, row_of_nodes d)
{
    const row_mask even = {0, 4, 2, 6}, odd = {1, 5, 3, 7}, low = {0, 1, 4, 5}, high = {2, 3, 6, 7};
    const row_of_nodes ab = __builtin_shuffle(a, b, even) + __builtin_shuffle(a, b, odd);
    const row_of_nodes cd = __builtin_shuffle(c, d, even) + __builtin_shuffle(c, d, odd);
    return __builtin_shuffle(ab, cd, low) + __builtin_shuffle(ab, cd, high);
}

static ALWAYS_INLINE row_of_nodes row_size(row_of_nodes a)
{
    const row_mask digits = (row_mask){0} + INT64_MAX;
    return (row_of_nodes)((row_mask)a & digits);
}

/* `to` with the sign of `from`, which it has not itself. */
static ALWAYS_INLINE row_of_nodes row_signed(row_of_nodes to, row_of_nodes from)
{
    const row_mask sign = (row_mask){0} + INT64_MIN;
    return (row_of_nodes)((row_mask)to | ((row_mask)from & sign));
}

/* ---- one direction ---------------------------------------------------------------------------------- */

/* Distances from the nodes of the row. */
static ALWAYS_INLINE row_of_nodes row_distance(real t) { return t - (row_of_nodes){-1, 0, 1, 2}; }

/* Hat function: N = 1 - |s|. */
static ALWAYS_INLINE void shape_linear(real t, row_of_nodes *N, row_of_nodes *dN)
{
    *N = (row_of_nodes){0, 1, 0, 0} + t * (row_of_nodes){0, -1, 1, 0};
    *dN = (row_of_nodes){0, -1, 1, 0};
}

/* Mean of the hat functions over the particle's width 2l <= 2, by what a hat has beyond the particle's ends, at a - l and
 * a + l for a node at the distance a: (1 - |s|)^2/2 beyond s, one end's less the other's, or less what is missing at both where
 * the node lies between them. So a node that the particle just touches gets a weight of the size that it should, never below
 * 0: it may have no other, and what a node without mass is given is lost. GIMP keeps 2l <= 1 and has three nodes. A stretched
 * particle (cpGIMP) reaches into the cells beside its own, whose nodes are the four of its row; contiguous particles then
 * share out every hat without gap or overlap, and a uniform stress leaves no residual (contiguous particles: Bardenhagen &
 * Kober 2004). */
static ALWAYS_INLINE void shape_gimp(real t, real l, real inverse_width, row_of_nodes *N, row_of_nodes *dN)
{
    const row_of_nodes s = row_distance(t), a = row_size(s);
    const row_of_nodes near = row_min(row_size(a - l), row_of(1)), far = row_min(a + l, row_of(1));
    const row_of_nodes twice_near = (1 - near) * (1 - near), twice_far = (1 - far) * (1 - far), rest = 2 - twice_near;
    const row_of_nodes from = row_choose(a - l, rest, twice_near);
    *N = (from - twice_far) * (0.5 * inverse_width);
    *dN = row_signed((far - near) * inverse_width, -s);
}

/* B-splines as sums of truncated powers, a = |s|: N = ((3/2 - a)_+^2 - 3 (1/2 - a)_+^2)/2. */
static ALWAYS_INLINE void shape_quadratic(real t, row_of_nodes *N, row_of_nodes *dN)
{
    const row_of_nodes s = row_distance(t), size = row_size(s);
    const row_of_nodes far = row_max(1.5 - size, row_of(0)), near = row_max(0.5 - size, row_of(0));
    *N = 0.5 * far * far - 1.5 * near * near;
    *dN = row_signed(row_of(1), s) * (3 * near - far);
}

/* N = ((2 - a)_+^3 - 4 (1 - a)_+^3)/6. */
static ALWAYS_INLINE void shape_cubic(real t, row_of_nodes *N, row_of_nodes *dN)
{
    const row_of_nodes s = row_distance(t), size = row_size(s);
    const row_of_nodes far = row_max(2 - size, row_of(0)), near = row_max(1 - size, row_of(0));
    const row_of_nodes far2 = far * far, near2 = near * near;
    *N = (far2 * far - 4 * near2 * near) * (1.0 / 6);
    *dN = row_signed(row_of(1), s) * (2 * near2 - 0.5 * far2);
}

/* Weights must add up to 1 to the last bit: every map gives momentum (sum N) times what it takes, and on a lattice all points
 * have the same round-off, which grows with the steps. The nearer node of the cell, never a light one, takes what is
 * missing. */
static ALWAYS_INLINE row_of_nodes whole(row_of_nodes N, real t)
{
    const row_of_nodes nearer = t < 0.5 ? (row_of_nodes){0, 1, 0, 0} : (row_of_nodes){0, 0, 1, 0};
    return N + (1 - row_sum(N)) * nearer;
}

static ALWAYS_INLINE void shape_row(const enum shape shape, real t, real l, real inverse_width, row_of_nodes *N,
                                    row_of_nodes *dN)
{
    switch (shape) {
    case SHAPE_LINEAR: shape_linear(t, N, dN); return;
    case SHAPE_QUADRATIC: shape_quadratic(t, N, dN); break;
    case SHAPE_CUBIC: shape_cubic(t, N, dN); break;
    default: shape_gimp(t, l, inverse_width, N, dN);
    }
    *N = whole(*N, t);
}

/* ---- the nodes of a cell ----------------------------------------------------------------------------
 *
 * The points of a cell share a patch of nodes: rows of four along x, and one row beside the other in the directions across.
 * Linear shapes in two and three dimensions, which reach only the corners, take the four corners of a face z = const as
 * one row instead, so that no place of a vector is idle. */

enum { ACROSS = 4, ROWS_MAX = ACROSS * ACROSS };

#define IS_FACE(dim, shape) ((shape) == SHAPE_LINEAR && (dim) > 1)
/* Directions that lie in a row; the others are across it. */
#define ROW_DIMS(dim, shape) (IS_FACE(dim, shape) ? 2 : 1)
/* Rows of the patch along y and z. */
#define ROWS_Y(dim, shape) ((dim) > 1 && !IS_FACE(dim, shape) ? ACROSS : 1)
#define ROWS_Z(dim, shape) ((dim) > 2 ? IS_FACE(dim, shape) ? 2 : ACROSS : 1)
#define ROWS(dim, shape) (ROWS_Y(dim, shape) * ROWS_Z(dim, shape))

/* A point of a shape with three nodes skips the rest in 3D; in 2D a weight of zero costs less than finding its rows. */
#define SKIPS(dim, shape) ((dim) > 2 && ((shape) == SHAPE_GIMP || (shape) == SHAPE_QUADRATIC))

/* Loops over the rows k1, k2 of a patch, and over those of one point. */
#define FOR_ROWS(dim, shape)                                      \
    for (int k2 = 0; k2 < ROWS_Z(dim, shape); k2++)               \
        for (int k1 = 0; k1 < ROWS_Y(dim, shape); k1++)
#define FOR_TOUCHED(s, dim, shape)                                                                                   \
    for (int k2 = SKIPS(dim, shape) ? (s)->low[2] : 0, end2 = SKIPS(dim, shape) ? k2 + 3 : ROWS_Z(dim, shape);       \
         k2 < end2; k2++)                                                                                            \
        for (int k1 = SKIPS(dim, shape) ? (s)->low[1] : 0, end1 = SKIPS(dim, shape) ? k1 + 3 : ROWS_Y(dim, shape);   \
             k1 < end1; k1++)
/* Place of a row in the arrays of a patch. */
#define PATCH(dim, shape) (k2 * ROWS_Y(dim, shape) + k1)

struct cell {
    int64_t node;                        /* index of the patch's lowest node                            */
    real place[DIM_MAX];                 /* of its lower corner, in node distances from the anchor      */
};

/* Floor without the library call that a negative argument would need. */
static ALWAYS_INLINE int64_t floor_to_int(real r)
{
    int64_t k = (int64_t)r;
    return k - (r < (real)k);
}

/* The cell of point i. */
static ALWAYS_INLINE struct cell cell_make(const struct grid *g, const struct particles *p, int64_t i, const int dim,
                                           const enum shape shape)
{
    struct cell c = {0};
    for (int d = 0; d < dim; d++) {
        const int64_t k = floor_to_int(grid_place(g, d, p->x[d][i]));
        c.place[d] = (real)k;
        c.node += (k - (IS_FACE(dim, shape) ? 0 : 1) - g->first[d]) * g->stride[d];
    }
    return c;
}

/* First node of a row. */
static ALWAYS_INLINE int64_t cell_row(const struct cell *c, const struct grid *g, int k1, int k2, const int dim)
{
    return c->node + (dim > 1 ? k1 * g->stride[1] : 0) + (dim > 2 ? k2 * g->stride[2] : 0);
}

static ALWAYS_INLINE row_of_nodes nodes_load(const struct grid *g, const real *from, const int dim, const enum shape shape)
{
    if (!IS_FACE(dim, shape)) return (row_of_nodes) * (const row_anywhere *)from;
    const pair_of_nodes a = (pair_of_nodes) * (const pair_anywhere *)from,
                        b = (pair_of_nodes) * (const pair_anywhere *)(from + g->stride[1]);
    return (row_of_nodes){a[0], a[1], b[0], b[1]};
}

static ALWAYS_INLINE void nodes_add(const struct grid *g, real *to, row_of_nodes a, const int dim, const enum shape shape)
{
    if (IS_FACE(dim, shape)) {
        *(pair_anywhere *)to += (pair_of_nodes){a[0], a[1]};
        *(pair_anywhere *)(to + g->stride[1]) += (pair_of_nodes){a[2], a[3]};
    } else {
        *(row_anywhere *)to += a;
    }
}

/* ---- the weights of one point ----------------------------------------------------------------------- */

struct stencil {
    row_of_nodes N, D[2];                /* weights [1] of a row, slopes in the directions along it [1/m] */
    real A[DIM_MAX][ACROSS], B[DIM_MAX][ACROSS]; /* weights [1] and slopes [1/m] of rows, by the direction across */
    real t[DIM_MAX];                     /* place in the cell                                         [1] */
    int low[DIM_MAX];                    /* first row that a point of three nodes touches                 */
};

/* Largest half width over h of cpGIMP: four nodes reach no further. A particle stretched beyond it keeps it, and numerical
 * fracture starts: at a stretch of 4 with two particles per cell. */
#define HALF_WIDTH_MOST 1

/* Corners of a face: products of two hats. */
static ALWAYS_INLINE void stencil_face(struct stencil *s, real inverse, const int dim)
{
    const row_of_nodes right = {-1, 1, -1, 1}, up = {-1, -1, 1, 1};
    const row_of_nodes X = (row_of_nodes){1, 0, 1, 0} + s->t[0] * right, Y = (row_of_nodes){1, 1, 0, 0} + s->t[1] * up;
    s->N = X * Y;
    s->D[0] = Y * (right * inverse);
    s->D[1] = X * (up * inverse);
    if (dim < 3) return;
    s->A[2][0] = 1 - s->t[2], s->A[2][1] = s->t[2];
    s->B[2][0] = -inverse, s->B[2][1] = inverse;
}

static ALWAYS_INLINE void stencil_make(struct stencil *s, const struct grid *g, const struct cell *c,
                                       const struct particles *p, int64_t i, real half_width, const int dim,
                                       const enum shape shape)
{
    const real inverse = 1 / g->h, l0 = half_width * inverse, inverse_width0 = 0.5 / l0;
    for (int d = 0; d < dim; d++) s->t[d] = grid_place(g, d, p->x[d][i]) - c->place[d];
    if (IS_FACE(dim, shape)) {
        stencil_face(s, inverse, dim);
        return;
    }
    for (int d = 0; d < dim; d++) {
        row_of_nodes N, dN;
        real l = l0, inverse_width = inverse_width0;
        if (shape == SHAPE_CPGIMP) {
            l *= p->stretch[d][i];
            if (l > HALF_WIDTH_MOST) l = HALF_WIDTH_MOST;
            inverse_width = 0.5 / l;
        }
        shape_row(shape, s->t[d], l, inverse_width, &N, &dN);
        dN *= inverse;
        if (d == 0) {
            s->N = N, s->D[0] = dN;
            continue;
        }
        for (int k = 0; k < ACROSS; k++) s->A[d][k] = N[k], s->B[d][k] = dN[k];
        if (SKIPS(dim, shape)) s->low[d] = s->t[d] >= (shape == SHAPE_GIMP ? l : 0.5);
    }
}

/* Weight of a row, and its slope in the direction d across it [1/m]. */
static ALWAYS_INLINE real stencil_row(const struct stencil *s, int k1, int k2, const int dim, const enum shape shape)
{
    real weight = 1;
    if (dim > 1 && !IS_FACE(dim, shape)) weight *= s->A[1][k1];
    if (dim > 2) weight *= s->A[2][k2];
    return weight;
}

static ALWAYS_INLINE real stencil_slope(const struct stencil *s, int k1, int k2, int d, const int dim,
                                        const enum shape shape)
{
    real slope = 1;
    if (dim > 1 && !IS_FACE(dim, shape)) slope *= d == 1 ? s->B[1][k1] : s->A[1][k1];
    if (dim > 2) slope *= d == 2 ? s->B[2][k2] : s->A[2][k2];
    return slope;
}

/* From the point to the nodes of a row in the direction d along it, and to those of row k across it [m]. */
static ALWAYS_INLINE row_of_nodes stencil_along(const struct stencil *s, real h, int d, const int dim,
                                                const enum shape shape)
{
    if (!IS_FACE(dim, shape)) return -row_distance(s->t[0]) * h;
    return ((d == 0 ? (row_of_nodes){0, 1, 0, 1} : (row_of_nodes){0, 0, 1, 1}) - s->t[d]) * h;
}

static ALWAYS_INLINE real stencil_across(const struct stencil *s, real h, int d, int k, const int dim,
                                         const enum shape shape)
{
    return (k - (IS_FACE(dim, shape) ? 0 : 1) - s->t[d]) * h;
}

#endif
