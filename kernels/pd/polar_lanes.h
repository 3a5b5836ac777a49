/* Polar rotation (polar.h) of eight matrices at once: entry c of lane l is M[c][l]. */
#ifndef CLEAVE_KERNELS_POLAR_LANES
#define CLEAVE_KERNELS_POLAR_LANES

#include "kernels/simd/lanes.h"
#include "base/polar.h"

#define POLAR_TINY 1e-300 /* keeps the root of a zero matrix finite */

/* Computes the rotations R nearest to eight 2 x 2 matrices M, both row major with one matrix per lane, by the formula
 * of polar_rotation_2d; R is the identity if that formula has no solution, e.g. where M = 0. */
static ALWAYS_INLINE void polar_decomposition_rotations_2d(const lanes *M, lanes *R)
{
    const lanes c = M[0] + M[3], s = M[2] - M[1], size2 = c * c + s * s;
    const lanes inverse = lanes_inverse_square_root(size2 + POLAR_TINY);
    R[0] = R[3] = lanes_choose(size2 > 0.0, c * inverse, lanes_broadcast(1));
    R[2] = s * inverse;
    R[1] = -R[2];
}

/* Does one step of R <- (R + R^-T)/2 (Higham 1986) on eight 3 x 3 matrices R, and clears *valid in lanes whose R is
 * singular or inverted. Returns the determinants of R before the step. */
static ALWAYS_INLINE lanes polar_decomposition_newton_iteration(lanes *R, lanes_mask *valid)
{
    const lanes cofactor[9] = {R[4] * R[8] - R[5] * R[7], R[5] * R[6] - R[3] * R[8], R[3] * R[7] - R[4] * R[6],
                               R[2] * R[7] - R[1] * R[8], R[0] * R[8] - R[2] * R[6], R[1] * R[6] - R[0] * R[7],
                               R[1] * R[5] - R[2] * R[4], R[2] * R[3] - R[0] * R[5], R[0] * R[4] - R[1] * R[3]};
    const lanes determinant = R[0] * cofactor[0] + R[1] * cofactor[1] + R[2] * cofactor[2];
    *valid &= determinant > 1e-12;
    const lanes half = lanes_choose(*valid, 0.5 / determinant, lanes_broadcast(0));
    for (int c = 0; c < 9; c++) R[c] = 0.5 * R[c] + cofactor[c] * half;
    return determinant;
}

/* Computes the rotations R nearest to eight 3x3 matrices M, one per lane (entry of the vectors), as polar_rotation_3d:
 * the identity for singular or inverted M. M, R: [9], row major. Stops Newton's iteration by the determinant of R: a
 * step replaces each singular value s by (s + 1/s)/2 >= 1, so that det R - 1 bounds every s - 1. A step squares s - 1
 * and halves it; from 1e-8 on, the next value is below round-off. */
static ALWAYS_INLINE void polar_decomposition_rotations_3d(const lanes *M, lanes *R)
{
    lanes size2 = lanes_broadcast(POLAR_TINY);
    for (int c = 0; c < 9; c++) size2 += M[c] * M[c];
    const lanes inverse = lanes_inverse_square_root(size2 * (1.0 / 3));
    lanes_mask sound = size2 > 2 * POLAR_TINY;
    for (int c = 0; c < 9; c++) R[c] = M[c] * inverse;
    for (int step = 0; step < 30; step++)
        if (!lanes_mask_any(polar_decomposition_newton_iteration(R, &sound) > 1 + 1e-8) && step > 0) break;
    for (int c = 0; c < 9; c++) R[c] = lanes_choose(sound, R[c], lanes_broadcast(c % 4 == 0));
}

/* Computes the rotations R nearest to eight matrices M, both row major with one matrix per lane, in dimension dim = 2
 * or 3. */
static ALWAYS_INLINE void polar_decomposition_rotations(const lanes *M, lanes *R, const int dim)
{
    if (dim == 2)
        polar_decomposition_rotations_2d(M, R);
    else
        polar_decomposition_rotations_3d(M, R);
}

#endif
