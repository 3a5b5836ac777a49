/* floor 2: polar.h for eight matrices at once: entry c of lane l is M[c][l]. */
#ifndef CLEAVE_POLAR_LANES_H
#define CLEAVE_POLAR_LANES_H

#include "lanes.h"
#include "polar.h"

#define POLAR_TINY 1e-300                /* keeps the root of nothing finite */

static ALWAYS_INLINE void polar_rotation_lanes_2d(const lanes *M, lanes *R)
{
    const lanes c = M[0] + M[3], s = M[2] - M[1], size2 = c * c + s * s;
    const lanes inverse = lanes_inverse_root(size2 + POLAR_TINY);
    R[0] = R[3] = lanes_choose(size2 > 0.0, c * inverse, lanes_of(1));
    R[2] = s * inverse;
    R[1] = -R[2];
}

/* One step of R <- (R + R^-T)/2; lanes that are singular or inside out lose their bit of `sound`. Returns the change. */
static ALWAYS_INLINE lanes polar_step(lanes *R, lanes_mask *sound)
{
    const lanes cofactor[9] = {
        R[4] * R[8] - R[5] * R[7], R[5] * R[6] - R[3] * R[8], R[3] * R[7] - R[4] * R[6],
        R[2] * R[7] - R[1] * R[8], R[0] * R[8] - R[2] * R[6], R[1] * R[6] - R[0] * R[7],
        R[1] * R[5] - R[2] * R[4], R[2] * R[3] - R[0] * R[5], R[0] * R[4] - R[1] * R[3]};
    const lanes determinant = R[0] * cofactor[0] + R[1] * cofactor[1] + R[2] * cofactor[2];
    *sound &= determinant > 1e-12;
    const lanes half = 0.5 / lanes_choose(*sound, determinant, lanes_of(1));
    lanes change = lanes_of(0);
    for (int c = 0; c < 9; c++) {
        const lanes next = lanes_choose(*sound, 0.5 * R[c] + cofactor[c] * half, lanes_of(c % 4 == 0));
        change = lanes_max(change, lanes_choose(next > R[c], next - R[c], R[c] - next));
        R[c] = next;
    }
    return change;
}

/* A step of Newton squares the error: after a change of 1e-8 what is left is below round-off. */
static ALWAYS_INLINE void polar_rotation_lanes_3d(const lanes *M, lanes *R)
{
    lanes size2 = lanes_of(POLAR_TINY);
    for (int c = 0; c < 9; c++) size2 += M[c] * M[c];
    const lanes inverse = lanes_inverse_root(size2 * (1.0 / 3));
    lanes_mask sound = size2 > 2 * POLAR_TINY;
    for (int c = 0; c < 9; c++) R[c] = M[c] * inverse;
    for (int step = 0; step < 30; step++)
        if (!lanes_any(polar_step(R, &sound) > 1e-8)) return;
}

static ALWAYS_INLINE void polar_rotation_lanes(const lanes *M, lanes *R, const int dim)
{
    if (dim == 2) polar_rotation_lanes_2d(M, R);
    else polar_rotation_lanes_3d(M, R);
}

#endif
