/* Eight doubles, or four (WIDE), as one value. Uses the compiler's vector extension, so one source becomes AVX-512,
 * AVX2 or SSE code. Where one instruction replaces several, its intrinsic is used, beside a version for vectors wider
 * than a register. That version works on sign bits, because comparing eight doubles takes eight comparisons there. */
#ifndef CLEAVE_KERNELS_LANES
#define CLEAVE_KERNELS_LANES

#include <math.h>

#include "data/particles.h"

#ifdef __AVX__
#include <immintrin.h>
#endif

/* Number of lanes of a vector: eight, or four in files that define ROWS_IN_PARTS and process the eight rows of a block
 * (bonds of eight particles) in parts of WIDE rows. With AVX2 a vector of eight doubles needs two registers, and the
 * compiler keeps such pairs in memory. */
#if defined ROWS_IN_PARTS && defined __AVX2__ && !defined __AVX512F__
#define LANES_WIDE 4
#else
#define LANES_WIDE 8
#endif
enum { WIDE = LANES_WIDE };

/* Vectors of WIDE numbers: aligned doubles, doubles at any address, floats, masks (all bits of a lane set or clear),
 * bit patterns of doubles, and 16-bit integers. */
typedef real lanes __attribute__((vector_size(WIDE * sizeof(real))));
typedef real lanes_anywhere __attribute__((vector_size(WIDE * sizeof(real)), aligned(sizeof(real)), may_alias));
typedef float lanes_floats __attribute__((vector_size(WIDE * sizeof(float)), aligned(sizeof(float)), may_alias));
typedef int64_t lanes_mask __attribute__((vector_size(WIDE * sizeof(int64_t))));
typedef uint64_t lanes_bits __attribute__((vector_size(WIDE * sizeof(uint64_t))));
typedef int16_t lanes_units __attribute__((vector_size(WIDE * sizeof(int16_t)), may_alias));

/* Vectors of eight numbers and masks of eight lanes, whatever WIDE is: for structs that files with and without
 * ROWS_IN_PARTS exchange. */
typedef real eight_lanes __attribute__((vector_size(LANES * sizeof(real))));
typedef int64_t eight_mask __attribute__((vector_size(LANES * sizeof(int64_t))));

/* Returns the numbers from[0] .. from[WIDE - 1]; `from` need not be aligned. */
static ALWAYS_INLINE lanes lanes_load(const real *from) { return (lanes) * (const lanes_anywhere *)from; }

/* Stores the entries of a in to[0] .. to[WIDE - 1]; `to` need not be aligned. */
static ALWAYS_INLINE void lanes_store(real *to, lanes a) { *(lanes_anywhere *)to = a; }

/* Returns the floats from[0] .. from[WIDE - 1] as doubles; `from` need not be aligned. */
static ALWAYS_INLINE lanes lanes_load_floats(const float *from)
{
#ifdef __AVX512F__
    return (lanes)_mm512_cvtps_pd(_mm256_loadu_ps(from));
#else
    return __builtin_convertvector(*(const lanes_floats *)from, lanes);
#endif
}

/* Stores the entries of a, rounded to floats, in to[0] .. to[WIDE - 1]; `to` need not be aligned. */
static ALWAYS_INLINE void lanes_store_floats(float *to, lanes a)
{
    *(lanes_floats *)to = __builtin_convertvector(a, lanes_floats);
}

/* Returns a vector whose entries are all a. */
static ALWAYS_INLINE lanes lanes_broadcast(real a) { return a - (lanes){0}; }

/* Returns a vector whose lane l (entry) is from[index[l]]. index: WIDE numbers, aligned to 4 WIDE bytes. */
static ALWAYS_INLINE lanes lanes_gather(const real *from, const int32_t *index)
{
#ifdef __AVX512F__
    return (lanes)_mm512_i32gather_pd(_mm256_load_si256((const __m256i *)index), from, sizeof(real));
#elif LANES_WIDE == 4
    return (lanes){from[index[0]], from[index[1]], from[index[2]], from[index[3]]};
#else
    return (lanes){from[index[0]], from[index[1]], from[index[2]], from[index[3]],
                   from[index[4]], from[index[5]], from[index[6]], from[index[7]]};
#endif
}

/* Returns a pointer to the eight entries of list[n] from list[k] on. If fewer than eight are left, copies these to
 * `padded`, fills the rest of `padded` with copies of list[k] and returns `padded`, so that fewer than eight entries
 * never count as consecutive (list_is_consecutive). */
static ALWAYS_INLINE const int32_t *list_get_eight_padded_entries(const int32_t *list, int64_t k, int64_t n,
                                                                  int32_t padded[LANES])
{
    if (k + LANES <= n) return list + k;
    for (int l = 0; l < LANES; l++) padded[l] = list[k + l < n ? k + l : k];
    return padded;
}

/* Returns true if the eight entries list[0 .. 7] are consecutive numbers. The entries must be strictly ascending, or
 * copies of list[0] may follow the ascending ones, as list_get_eight_padded_entries fills them up. */
static ALWAYS_INLINE bool list_is_consecutive(const int32_t *list) { return list[LANES - 1] - list[0] == LANES - 1; }

/* Returns WIDE values of the array `from`: from[first] .. from[first + WIDE - 1] or, if first < 0, from[index[0]] ..
 * from[index[WIDE - 1]]. */
static ALWAYS_INLINE lanes lanes_load_or_gather(const real *from, int32_t first, const int32_t *index)
{
    return first >= 0 ? lanes_load(from + first) : lanes_gather(from, index);
}

/* Returns in each lane the entry of a if the mask is set in this lane, else the entry of b. */
static ALWAYS_INLINE lanes lanes_choose(lanes_mask mask, lanes a, lanes b)
{
#if LANES_WIDE == 4
    return (lanes)_mm256_blendv_pd((__m256d)b, (__m256d)a, (__m256d)mask);
#else
    return (lanes)((mask & (lanes_mask)a) | (~mask & (lanes_mask)b));
#endif
}

/* Returns the mask of the lanes in which the sign bit of a is set. */
static ALWAYS_INLINE lanes_mask lanes_negative(lanes a) { return (lanes_mask) - ((lanes_bits)a >> 63); }

/* Returns the mask of the lanes in which a < b. */
static ALWAYS_INLINE lanes_mask lanes_less(lanes a, lanes b)
{
#if defined __AVX512F__ || LANES_WIDE == 4
    return a < b;
#else
    return lanes_negative(a - b);
#endif
}

/* Returns the larger of a and b in each lane. */
static ALWAYS_INLINE lanes lanes_max(lanes a, lanes b)
{
#ifdef __AVX512F__
    return (lanes)_mm512_max_pd((__m512d)a, (__m512d)b);
#elif LANES_WIDE == 4
    return (lanes)_mm256_max_pd((__m256d)a, (__m256d)b);
#else
    return lanes_choose(lanes_less(b, a), a, b);
#endif
}

/* Returns the smaller of a and b in each lane. */
static ALWAYS_INLINE lanes lanes_min(lanes a, lanes b)
{
#ifdef __AVX512F__
    return (lanes)_mm512_min_pd((__m512d)a, (__m512d)b);
#elif LANES_WIDE == 4
    return (lanes)_mm256_min_pd((__m256d)a, (__m256d)b);
#else
    return lanes_choose(lanes_less(a, b), a, b);
#endif
}

/* Returns |a| in each lane. */
static ALWAYS_INLINE lanes lanes_absolute(lanes a)
{
    const lanes_mask digits = (lanes_mask){0} + INT64_MAX;
    return (lanes)((lanes_mask)a & digits);
}

/* Returns the mask of the lanes l whose bit l is set in `bits`. */
static ALWAYS_INLINE lanes_mask lanes_mask_from_bits(uint8_t bits)
{
    const uint64_t a = bits;
#if LANES_WIDE == 4
    const lanes_bits each = {1, 2, 4, 8};
    return ((lanes_bits){a, a, a, a} & each) == each;
#else
    return (lanes_mask) - (-((lanes_bits){a, a, a, a, a, a, a, a} & (lanes_bits){1, 2, 4, 8, 16, 32, 64, 128}) >> 63);
#endif
}

/* Returns WIDE bits: bit l is set if lane l is set in the mask `mask`. */
static ALWAYS_INLINE unsigned lanes_mask_bits(lanes_mask mask)
{
#ifdef __AVX512F__
    return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask);
#elif LANES_WIDE == 4
    return _mm256_movemask_pd((__m256d)mask);
#else
    unsigned bits = 0;
    for (int l = 0; l < WIDE; l++) bits |= (unsigned)(mask[l] & 1) << l;
    return bits;
#endif
}

/* Returns in each lane l the entry of a if bit l is set in `bits`, else 0. */
static ALWAYS_INLINE lanes lanes_zero_unless_selected(uint8_t bits, lanes a)
{
#ifdef __AVX512F__
    return (lanes)_mm512_maskz_mov_pd(bits, (__m512d)a);
#else
    return (lanes)(lanes_mask_from_bits(bits) & (lanes_mask)a);
#endif
}

/* Stores entry l of a at to[l] for all lanes l whose bit is set in `bits`; other elements of `to`, which need not be
 * aligned, stay unchanged. */
static ALWAYS_INLINE void lanes_store_selected(uint8_t bits, real *to, lanes a)
{
#ifdef __AVX512F__
    _mm512_mask_storeu_pd(to, bits, (__m512d)a);
#else
    for (int l = 0; l < WIDE; l++)
        if (bits >> l & 1) to[l] = a[l];
#endif
}

/* Returns in each lane l the larger of the entries of a and b if bit l is set in `bits`, else the entry of
 * a. */
static ALWAYS_INLINE lanes lanes_max_selected(uint8_t bits, lanes a, lanes b)
{
#ifdef __AVX512F__
    return (lanes)_mm512_mask_max_pd((__m512d)a, bits, (__m512d)a, (__m512d)b);
#elif LANES_WIDE == 4
    return lanes_choose(lanes_mask_from_bits(bits), lanes_max(a, b), a);
#else
    return lanes_choose(lanes_mask_from_bits(bits) & lanes_negative(a - b), b, a);
#endif
}

/* Returns in each lane l the smaller of the entries of a and b if bit l is set in `bits`, else the entry of
 * a. */
static ALWAYS_INLINE lanes lanes_min_selected(uint8_t bits, lanes a, lanes b)
{
#ifdef __AVX512F__
    return (lanes)_mm512_mask_min_pd((__m512d)a, bits, (__m512d)a, (__m512d)b);
#elif LANES_WIDE == 4
    return lanes_choose(lanes_mask_from_bits(bits), lanes_min(a, b), a);
#else
    return lanes_choose(lanes_mask_from_bits(bits) & lanes_negative(b - a), b, a);
#endif
}

/* Returns a vector whose lane l is a plus ulps[l] units in the last place. ulps: WIDE integers, aligned to 2 WIDE
 * bytes. */
static ALWAYS_INLINE lanes lanes_add_ulps(real a, const int16_t *ulps)
{
#ifdef __AVX512F__
    const lanes_mask more = (lanes_mask)_mm512_cvtepi16_epi64(_mm_load_si128((const __m128i *)ulps));
#elif LANES_WIDE == 4
    const lanes_mask more = (lanes_mask)_mm256_cvtepi16_epi64(_mm_loadl_epi64((const __m128i *)ulps));
#else
    const lanes_mask more = __builtin_convertvector(*(const lanes_units *)ulps, lanes_mask);
#endif
    return (lanes)((lanes_mask)lanes_broadcast(a) + more);
}

/* Returns true if any lane of the mask `mask` is set. */
static ALWAYS_INLINE bool lanes_mask_any(lanes_mask mask)
{
#ifdef __AVX512F__
    return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask) != 0;
#elif LANES_WIDE == 4
    return _mm256_movemask_pd((__m256d)mask) != 0;
#else
    int64_t any = 0;
    for (int l = 0; l < WIDE; l++) any |= mask[l];
    return any != 0;
#endif
}

/* Returns true if a < b in any lane. */
static ALWAYS_INLINE bool lanes_any_less(lanes a, lanes b)
{
#ifdef __AVX512F__
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ) != 0;
#else
    return lanes_mask_any(lanes_less(a, b));
#endif
}

#if defined __AVX512F__ || defined __FMA__

/* Returns estimates of 1/sqrt(a) in each lane, of 14 bits or more. Without AVX-512: halving the exponent and mantissa
 * bits and subtracting from a constant is accurate to 3.5 % for normal numbers (the constant minimises the largest
 * error); one step of the series of lanes_inverse_square_root leaves 6e-6. */
static ALWAYS_INLINE lanes lanes_estimate_inverse_square_root(lanes a)
{
#ifdef __AVX512F__
    return (lanes)_mm512_rsqrt14_pd((__m512d)a);
#else
    const lanes y = (lanes)(UINT64_C(0x5fe6eb50c7b537a9) - ((lanes_bits)a >> 1)), c = 1.0 - (a * y) * y;
    return y + (y * c) * (0.5 + c * (0.375 + c * 0.3125));
#endif
}

/* Returns 1/sqrt(a) in each lane, for positive normal numbers to full double precision, from an estimate y of 14 bits:
 * with c = 1 - a y^2 below 2^-13 the series y (1 + c/2 + 3c^2/8 + 5c^3/16) leaves 35 c^4/128 < 2^-53. This takes a
 * third of the time of a root and a division, and fewer operations than two Newton steps. */
static ALWAYS_INLINE lanes lanes_inverse_square_root(lanes a)
{
    const lanes y = lanes_estimate_inverse_square_root(a), c = 1.0 - (a * y) * y;
    return y + (y * c) * (0.5 + c * (0.375 + c * 0.3125));
}

/* Returns sqrt(a) in each lane (entry of the vector), for normal numbers to full double precision, by the series of
 * lanes_inverse_square_root. */
static ALWAYS_INLINE lanes lanes_square_root(lanes a)
{
    const lanes y = lanes_estimate_inverse_square_root(a), root = a * y, c = 1.0 - root * y;
    return root + (root * c) * (0.5 + c * (0.375 + c * 0.3125));
}

#else

/* Returns sqrt(a) in each lane (entry of the vector), by the square root of the C library: with vectors of two doubles
 * this is as fast as the series used for wider vectors. */
static ALWAYS_INLINE lanes lanes_square_root(lanes a)
{
    lanes y;
    for (int l = 0; l < WIDE; l++) y[l] = sqrt(a[l]);
    return y;
}

static ALWAYS_INLINE lanes lanes_inverse_square_root(lanes a) { return 1.0 / lanes_square_root(a); }

#endif

#endif
