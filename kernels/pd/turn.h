/* floor 2: rotations of particles as state-based sweeps keep and apply them, eight at once: R - 1, times the spring g.
 *
 * In space four numbers, not nine: with the quaternion (q, q0) of R, and (a, s) = sqrt(2 g) (q, q0),
 *
 *     g (R - 1) v = 2 g [q0 q x v + q x (q x v)] = a x (s v + a x v)
 *
 * Neighbours are read at any place, and seven of eight such loads touch two cache lines: they cost more than products do. Where
 * R is 1 to the last bit, so is a 0, and nothing comes of it. */
#ifndef CLEAVE_TURN_H
#define CLEAVE_TURN_H

#include "bonds/bonds.h"
#include "kernels/simd/lanes.h"

#define TURN_TINY 1e-300                 /* keeps the root of nothing finite */

/* A row of the matrix 4 (q, q0) (q, q0)^T, that with the largest diagonal: never by a small component (Shepperd 1978). */
static ALWAYS_INLINE lanes quaternion_row(const lanes *R, lanes *row)
{
    const lanes odd[3] = {R[7] - R[5], R[2] - R[6], R[3] - R[1]}, even[3] = {R[1] + R[3], R[5] + R[7], R[6] + R[2]};
    const lanes size[TURN] = {1.0 + R[0] - R[4] - R[8], 1.0 - R[0] + R[4] - R[8], 1.0 - R[0] - R[4] + R[8],
                              1.0 + R[0] + R[4] + R[8]};
    const lanes rows[3][TURN] = {{size[0], even[0], even[2], odd[0]},
                                 {even[0], size[1], even[1], odd[1]},
                                 {even[2], even[1], size[2], odd[2]}};
    lanes largest = size[3];
    for (int c = 0; c < TURN; c++) row[c] = c < 3 ? odd[c] : size[3];
    for (int k = 0; k < 3; k++) {
        const lanes_mask larger = size[k] > largest;
        for (int c = 0; c < TURN; c++) row[c] = lanes_choose(larger, rows[k][c], row[c]);
        largest = lanes_choose(larger, size[k], largest);
    }
    return largest;
}

/* What is kept of R, row major, and g. */
static ALWAYS_INLINE void turn_make(lanes *turn, const lanes *R, lanes spring, const int dim)
{
    if (dim == 2) {
        for (int c = 0; c < TURN; c++) turn[c] = spring * (R[c] - (c % 3 == 0 ? 1.0 : 0.0));
        return;
    }
    const lanes size = quaternion_row(R, turn), scale = spring * lanes_inverse_root(2.0 * spring * size + TURN_TINY);
    for (int c = 0; c < TURN; c++) turn[c] *= scale;
}

/* f less g (R - 1) arm. The matrix in the plane is (a, -c; c, a). */
static ALWAYS_INLINE void turn_off(lanes *f, const lanes *turn, const lanes *arm, const int dim)
{
    if (dim == 2) {
        f[0] += turn[2] * arm[1] - turn[0] * arm[0];
        f[1] -= turn[2] * arm[0] + turn[0] * arm[1];
        return;
    }
    lanes u[DIM_MAX];
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, h = (d + 2) % 3;
        u[d] = turn[3] * arm[d] + turn[e] * arm[h] - turn[h] * arm[e];
    }
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, h = (d + 2) % 3;
        f[d] += turn[h] * u[e] - turn[e] * u[h];
    }
}

/* Is entry c read by turn_off? */
static ALWAYS_INLINE bool turn_reads(int c, const int dim) { return dim > 2 || c % 2 == 0; }

/* Does entry c change its sign in a mirror normal to an axis? A rotation's own axis is not turned round by a mirror across it,
 * but all others are. */
static inline bool turn_odd(int c, int axis, int dim)
{
    return axis >= 0 && (dim == 2 ? c == 1 || c == 2 : c < 3 && c != axis);
}

#endif
