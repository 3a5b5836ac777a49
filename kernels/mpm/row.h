/* Vectors of the nodes of a row of grid nodes, or of as many material points as fit into a register, one node or point
 * per lane. Interpolation from nodes to points has points in the lanes, summation from points to nodes has nodes in the
 * lanes: neither adds across lanes.
 *
 * A file that is to have other widths defines ROW_NODES, the number of nodes of a row, and POINTS_MOST, the largest
 * number of points at once, before it includes this header: the usual numbers in a cell. */
#ifndef CLEAVE_KERNELS_ROW
#define CLEAVE_KERNELS_ROW

#include "base/base.h"

#ifndef ROW_NODES
#define ROW_NODES 4
#endif
#ifndef POINTS_MOST
#define POINTS_MOST 4
#endif
#if defined __AVX512F__ && POINTS_MOST == 8
#define POINTS_LANES 8
#elif defined __AVX__
#define POINTS_LANES 4
#else
#define POINTS_LANES 2
#endif
#ifdef __AVX__
#include <immintrin.h>
#endif
enum { ROW = ROW_NODES, POINTS = POINTS_LANES };

typedef real row_of_nodes __attribute__((vector_size(ROW * sizeof(real))));
typedef real row_anywhere __attribute__((vector_size(ROW * sizeof(real)), aligned(sizeof(real)), may_alias));
typedef real pair_of_nodes __attribute__((vector_size(2 * sizeof(real))));
typedef real pair_anywhere __attribute__((vector_size(2 * sizeof(real)), aligned(sizeof(real)), may_alias));
typedef real row_of_points __attribute__((vector_size(POINTS * sizeof(real))));
typedef real points_anywhere __attribute__((vector_size(POINTS * sizeof(real)), aligned(sizeof(real)), may_alias));
typedef int64_t points_mask __attribute__((vector_size(POINTS * sizeof(int64_t))));

/* Returns a vector of ROW entries, one for each node of a row of grid nodes, that are all equal to a. */
static ALWAYS_INLINE row_of_nodes nodes_broadcast(real a) { return a - (row_of_nodes){0}; }

/* Returns a vector of POINTS entries, one for each material point processed together, that are all equal to a. */
static ALWAYS_INLINE row_of_points points_broadcast(real a) { return a - (row_of_points){0}; }

/* Returns in each lane the entry of a if the entry of `sign` is negative, else the entry of b. */
static ALWAYS_INLINE row_of_points points_choose_by_sign(row_of_points sign, row_of_points a, row_of_points b)
{
#if POINTS_LANES == 8
    return (row_of_points)_mm512_mask_blend_pd(_mm512_movepi64_mask((__m512i)sign), (__m512d)b, (__m512d)a);
#elif POINTS_LANES == 4
    return (row_of_points)_mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)sign);
#else
    const points_mask mask = sign < 0;
    return (row_of_points)((mask & (points_mask)a) | (~mask & (points_mask)b));
#endif
}

/* Returns the larger of a and b in each lane of two vectors of material points. */
static ALWAYS_INLINE row_of_points points_max(row_of_points a, row_of_points b)
{
#if POINTS_LANES == 8
    return (row_of_points)_mm512_max_pd((__m512d)a, (__m512d)b);
#elif POINTS_LANES == 4
    return (row_of_points)_mm256_max_pd((__m256d)a, (__m256d)b);
#else
    return points_choose_by_sign(b - a, a, b);
#endif
}

/* Returns the smaller of a and b in each lane of two vectors of material points. */
static ALWAYS_INLINE row_of_points points_min(row_of_points a, row_of_points b)
{
#if POINTS_LANES == 8
    return (row_of_points)_mm512_min_pd((__m512d)a, (__m512d)b);
#elif POINTS_LANES == 4
    return (row_of_points)_mm256_min_pd((__m256d)a, (__m256d)b);
#else
    return points_choose_by_sign(a - b, a, b);
#endif
}

/* Returns the absolute value of a in each lane of a vector of material points. */
static ALWAYS_INLINE row_of_points points_absolute(row_of_points a)
{
    const points_mask digits = (points_mask){0} + INT64_MAX;
    return (row_of_points)((points_mask)a & digits);
}

/* Returns the signs of the vector a as bits: bit k is set if lane k (0 to POINTS - 1) is negative. */
static ALWAYS_INLINE int points_sign_bits(row_of_points a)
{
#if POINTS_LANES == 8
    return _mm512_movepi64_mask((__m512i)a);
#elif POINTS_LANES == 4
    return _mm256_movemask_pd((__m256d)a);
#else
    const points_mask bits = (points_mask)a;
    return (bits[0] < 0) | (bits[1] < 0) << 1;
#endif
}

/* Returns a vector that equals a in lanes 0 to n - 1 and is 0 in all others. */
static ALWAYS_INLINE row_of_points points_keep_first_lanes(row_of_points a, int n)
{
    row_of_points lane;
    for (int k = 0; k < POINTS; k++) lane[k] = k;
    return points_choose_by_sign(lane - n, a, points_broadcast(0));
}

/* Returns the sum of the POINTS entries of the vector a. */
static ALWAYS_INLINE real points_sum(row_of_points a)
{
    real sum = a[0];
    for (int k = 1; k < POINTS; k++) sum += a[k];
    return sum;
}

/* Number of material points that are processed at once: the usual number in a cell, in 1D two. Vector entries beyond it
 * repeat the last point. */
#define AT_ONCE(dim) ((dim) == 1 ? 2 : POINTS)

/* Returns the smaller of the integers a and b. */
static ALWAYS_INLINE int int_min(int a, int b) { return a < b ? a : b; }

/* Returns how many of `points_left` remaining points of a cell are processed at once: at most AT_ONCE. */
static ALWAYS_INLINE int points_count_of_next_batch(int points_left, const int dim)
{
    return int_min(points_left, AT_ONCE(dim));
}

/* POINT_NUMBERS: length of the arrays that points_copy_list_indices_to_lanes fills with the indices of POINTS points
 * and, as entry PAIRED, a flag. The flag is not 0 if the points come in pairs of consecutive indices, as neighbours
 * along x do; the values of a pair are then loaded or stored at once. */
enum { PAIRED = POINTS, POINT_NUMBERS = POINTS + 1 };

/* Returns the index in a list of n points (n <= AT_ONCE, points processed together) of the point that vector lane
 * `lane` holds. Lanes beyond the last point repeat the last point or, if n is even, the last two, so that pairs stay
 * together. */
static ALWAYS_INLINE int points_list_index_of_lane(int lane, int n)
{
    return lane < n ? lane : n % 2 == 1 ? n - 1 : n - 2 + lane % 2;
}

/* Stores the indices list[n] of n points (n <= AT_ONCE, points processed together) in point[0] .. point[POINTS - 1],
 * one per lane, with repeated points in further lanes (points_list_index_of_lane). Sets point[PAIRED] to 1 if the
 * points are pairs of consecutive indices, else to 0. list: must have POINTS entries, of which those from n on are not
 * used, unless n is 1. */
static ALWAYS_INLINE void points_copy_list_indices_to_lanes(int32_t *point, const int32_t *list, int n, const int dim)
{
    if (n == 1) {
        for (int k = 0; k < POINTS; k++) point[k] = list[0];
        point[PAIRED] = 0;
        return;
    }
#if POINTS_LANES == 8
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), even = _mm256_set1_epi32((n - 1) & ~1);
    const __m256i most = _mm256_add_epi32(even, _mm256_and_si256(lane, _mm256_set1_epi32((n - 1) & 1)));
    const __m256i all = _mm256_loadu_si256((const __m256i *)list);
    const __m256i own = _mm256_permutevar8x32_epi32(all, _mm256_min_epi32(lane, most));
    const __m256i next = _mm256_add_epi32(own, _mm256_set1_epi32(1)), other = _mm256_srli_epi64(own, 32);
    _mm256_storeu_si256((__m256i *)point, own);
    point[PAIRED] = (_mm256_cmpeq_epi32_mask(next, other) & 0x55) == 0x55;
    (void)dim;
#else
    for (int k = 0; k < POINTS; k++) point[k] = list[points_list_index_of_lane(k, n)];
    point[PAIRED] = dim > 1;
    for (int k = 0; k < POINTS; k += 2) point[PAIRED] &= point[k + 1] == point[k] + 1;
#endif
}

/* Returns true if all lanes of a vector of points hold the same point, as in cells with one point (2D and 3D). The
 * branch saves time there, and costs none where cells have four points. point: numbers of the points. */
static ALWAYS_INLINE bool point_vector_has_only_one_point(const int32_t *point, const int dim)
{
    return dim > 1 && point[0] == point[POINTS - 1];
}

/* Returns a vector whose lane k, 0 <= k < POINTS, is from[point[k]], for points in pairs of consecutive indices:
 * point[k + 1] = point[k] + 1 for even k. */
static ALWAYS_INLINE row_of_points points_load_consecutive_pairs(const real *from, const int32_t *point)
{
#if POINTS_LANES == 2
    return *(const points_anywhere *)(from + point[0]);
#else
    const __m256d low = _mm256_loadu2_m128d(from + point[2], from + point[0]);
#if POINTS_LANES == 4
    return (row_of_points)low;
#else
    const __m256d high = _mm256_loadu2_m128d(from + point[6], from + point[4]);
    return (row_of_points)_mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1);
#endif
#endif
}

/* Returns a vector whose lane k, 0 <= k < POINTS, is from[point[k]], the value of a point in the particle array `from`.
 * point: as set by points_copy_list_indices_to_lanes, the indices of the points (in 1D of at most two, which further
 * lanes repeat), then in point[PAIRED] not 0 if they are pairs of consecutive indices, which are loaded together. */
static ALWAYS_INLINE row_of_points points_gather_values(const real *from, const int32_t *point, const int dim)
{
    if (dim > 1 && point[PAIRED]) return points_load_consecutive_pairs(from, point);
    if (point_vector_has_only_one_point(point, dim)) return points_broadcast(from[point[0]]);
#if POINTS_LANES == 8
    return (row_of_points){from[point[0]], from[point[1]], from[point[2]], from[point[3]],
                           from[point[4]], from[point[5]], from[point[6]], from[point[7]]};
#else
    row_of_points a;
    for (int k = 0; k < POINTS; k++) a[k] = from[point[k % AT_ONCE(dim)]];
    return a;
#endif
}

/* Stores lane k of the vector a in to[point[k]], 0 <= k < POINTS. to: particle array; point: as set by
 * points_copy_list_indices_to_lanes, the indices of the points, then in point[PAIRED] not 0 if they are pairs of
 * consecutive indices. Lanes that hold the same point must have equal values. */
static ALWAYS_INLINE void points_store(real *to, const int32_t *point, row_of_points a, const int dim)
{
    if (dim > 1 && point[PAIRED]) {
        for (int k = 0; k < POINTS; k += 2) *(pair_anywhere *)(to + point[k]) = (pair_of_nodes){a[k], a[k + 1]};
        return;
    }
    to[point[0]] = a[0];
    if (point_vector_has_only_one_point(point, dim)) return;
    for (int k = 1; k < AT_ONCE(dim); k++) to[point[k]] = a[k];
}

#if ROW_NODES == 4
#ifdef __AVX__
typedef real four_points __attribute__((vector_size(4 * sizeof(real))));
typedef int64_t four_mask __attribute__((vector_size(4 * sizeof(int64_t))));

/* Transposes four vectors of four entries: entry j of to[i] is entry i of from[j]. */
static ALWAYS_INLINE void matrix_transpose_4x4(const four_points from[4], four_points to[4])
{
#define EVEN(u, v) VECTOR_PICK(four_mask, u, v, 0, 4, 2, 6)
#define ODD(u, v) VECTOR_PICK(four_mask, u, v, 1, 5, 3, 7)
#define FIRST(u, v) VECTOR_PICK(four_mask, u, v, 0, 1, 4, 5)
#define LAST(u, v) VECTOR_PICK(four_mask, u, v, 2, 3, 6, 7)
    const four_points a = EVEN(from[0], from[1]), b = ODD(from[0], from[1]);
    const four_points c = EVEN(from[2], from[3]), d = ODD(from[2], from[3]);
    to[0] = FIRST(a, c), to[1] = FIRST(b, d);
    to[2] = LAST(a, c), to[3] = LAST(b, d);
#undef EVEN
#undef ODD
#undef FIRST
#undef LAST
}
#endif

/* Transposes ROW vectors with one lane per point to POINTS vectors with one lane per node: entry j of to[i] is entry i
 * of from[j]. */
static ALWAYS_INLINE void rows_transpose_points_to_nodes(const row_of_points from[ROW], row_of_nodes to[POINTS])
{
#if POINTS_LANES == 8
    four_points half[2][ROW];
    for (int k = 0; k < ROW; k++) {
        half[0][k] = (four_points)_mm512_castpd512_pd256((__m512d)from[k]);
        half[1][k] = (four_points)_mm512_extractf64x4_pd((__m512d)from[k], 1);
    }
    matrix_transpose_4x4(half[0], to), matrix_transpose_4x4(half[1], to + 4);
#elif POINTS_LANES == 4
    matrix_transpose_4x4(from, to);
#else
    for (int k = 0; k < POINTS; k++) to[k] = (row_of_nodes){from[0][k], from[1][k], from[2][k], from[3][k]};
#endif
}
#endif

#endif
