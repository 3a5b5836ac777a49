/* Vectors of the four nodes of a row of grid nodes, or of as many material points as fit into a register, one node or
 * point per lane. Interpolation from nodes to points has points in the lanes, summation from points to nodes has nodes
 * in the lanes: neither adds across lanes. */
#ifndef CLEAVE_KERNELS_ROW
#define CLEAVE_KERNELS_ROW

#include "base/base.h"

#ifdef __AVX__
#include <immintrin.h>
enum { ROW = 4, POINTS = 4 };
#else
enum { ROW = 4, POINTS = 2 };
#endif

typedef real row_of_nodes __attribute__((vector_size(ROW * sizeof(real))));
typedef real row_anywhere __attribute__((vector_size(ROW * sizeof(real)), aligned(sizeof(real)), may_alias));
typedef real pair_of_nodes __attribute__((vector_size(2 * sizeof(real))));
typedef real pair_anywhere __attribute__((vector_size(2 * sizeof(real)), aligned(sizeof(real)), may_alias));
typedef real row_of_points __attribute__((vector_size(POINTS * sizeof(real))));
typedef int64_t points_mask __attribute__((vector_size(POINTS * sizeof(int64_t))));

/* Returns a vector of ROW nodes whose entries are a. */
static ALWAYS_INLINE row_of_nodes row_broadcast(real a) { return (row_of_nodes){a, a, a, a}; }

/* Returns a vector of POINTS material points whose entries are a. */
static ALWAYS_INLINE row_of_points points_broadcast(real a) { return a - (row_of_points){0}; }

/* Returns a in lanes where `sign` is negative, else b. */
static ALWAYS_INLINE row_of_points points_choose(row_of_points sign, row_of_points a, row_of_points b)
{
#ifdef __AVX__
    return (row_of_points)_mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)sign);
#else
    const points_mask mask = sign < 0;
    return (row_of_points)((mask & (points_mask)a) | (~mask & (points_mask)b));
#endif
}

/* Returns the larger of a and b in each lane of two vectors of material points. */
static ALWAYS_INLINE row_of_points points_max(row_of_points a, row_of_points b)
{
#ifdef __AVX__
    return (row_of_points)_mm256_max_pd((__m256d)a, (__m256d)b);
#else
    return points_choose(b - a, a, b);
#endif
}

/* Returns the smaller of a and b in each lane of two vectors of material points. */
static ALWAYS_INLINE row_of_points points_min(row_of_points a, row_of_points b)
{
#ifdef __AVX__
    return (row_of_points)_mm256_min_pd((__m256d)a, (__m256d)b);
#else
    return points_choose(a - b, a, b);
#endif
}

/* Returns |a| in each lane of a vector of material points. */
static ALWAYS_INLINE row_of_points points_absolute(row_of_points a)
{
    const points_mask digits = (points_mask){0} + INT64_MAX;
    return (row_of_points)((points_mask)a & digits);
}

/* Returns a bit mask of a vector of material points: bit k is set where lane k is negative. */
static ALWAYS_INLINE int points_sign_bits(row_of_points a)
{
#ifdef __AVX__
    return _mm256_movemask_pd((__m256d)a);
#else
    const points_mask bits = (points_mask)a;
    return (bits[0] < 0) | (bits[1] < 0) << 1;
#endif
}

/* Returns the number of material points processed at once: the usual number per cell, two in 1D. Unused vector entries
 * repeat the last point. */
#define AT_ONCE(dim) ((dim) == 1 ? 2 : POINTS)

/* Returns the smaller of two whole numbers. */
static ALWAYS_INLINE int int_min(int a, int b) { return a < b ? a : b; }

/* Returns how many of `left` remaining points of a cell are processed at once: at most AT_ONCE. */
static ALWAYS_INLINE int points_at_once(int left, const int dim) { return int_min(left, AT_ONCE(dim)); }

/* Returns true if all lanes of a vector of points hold the same point, as in cells with one point (2D and 3D). The
 * branch saves time there, and costs none where cells have four points. point: numbers of the points. */
static ALWAYS_INLINE bool points_are_the_same(const int32_t *point, const int dim)
{
    return dim > 1 && point[0] == point[POINTS - 1];
}

/* Returns the entries from[point[k]] of an array for the listed points, one per lane. point: numbers of POINTS points
 * (in 1D of two, which are repeated). */
static ALWAYS_INLINE row_of_points points_load(const real *from, const int32_t *point, const int dim)
{
    if (points_are_the_same(point, dim)) return points_broadcast(from[point[0]]);
    row_of_points a;
    for (int k = 0; k < POINTS; k++) a[k] = from[point[k % AT_ONCE(dim)]];
    return a;
}

/* Stores lane k of a in to[point[k]] for the listed points. Lanes that hold the same point must have equal values. */
static ALWAYS_INLINE void points_store(real *to, const int32_t *point, row_of_points a, const int dim)
{
    to[point[0]] = a[0];
    if (points_are_the_same(point, dim)) return;
    for (int k = 1; k < AT_ONCE(dim); k++) to[point[k]] = a[k];
}

/* Transposes ROW vectors with one lane per point to POINTS vectors with one lane per node. */
static ALWAYS_INLINE void rows_transpose(const row_of_points from[ROW], row_of_nodes to[POINTS])
{
#ifdef __AVX__
#define EVEN(u, v) VECTOR_PICK(points_mask, u, v, 0, 4, 2, 6)
#define ODD(u, v) VECTOR_PICK(points_mask, u, v, 1, 5, 3, 7)
#define FIRST(u, v) VECTOR_PICK(points_mask, u, v, 0, 1, 4, 5)
#define LAST(u, v) VECTOR_PICK(points_mask, u, v, 2, 3, 6, 7)
    const row_of_points a = EVEN(from[0], from[1]), b = ODD(from[0], from[1]);
    const row_of_points c = EVEN(from[2], from[3]), d = ODD(from[2], from[3]);
    to[0] = FIRST(a, c), to[1] = FIRST(b, d);
    to[2] = LAST(a, c), to[3] = LAST(b, d);
#undef EVEN
#undef ODD
#undef FIRST
#undef LAST
#else
    for (int k = 0; k < POINTS; k++) to[k] = (row_of_nodes){from[0][k], from[1][k], from[2][k], from[3][k]};
#endif
}

#endif
