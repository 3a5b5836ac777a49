/* How points that turn (data/turning.h) continue their velocity to nodes. */
#ifndef CLEAVE_KERNELS_TURN
#define CLEAVE_KERNELS_TURN

#include "kernels/kernels.h"

/* Slope of velocity component d along e about point i [1/s]: of the spin w of its group, and of the chord that a step
 * is of the circle. Leap-frog's v = (x' - x)/dt is w x r - share dt w x (w x r), share 1/2 for r from the place x' at
 * the end of the step, -1/2 for that at its begin. Without this part of second order, faces of bodies that turn shrink:
 * of a square by 0.2 % a turn at 4000 1/s. */
static ALWAYS_INLINE real turn_slope(const struct transfer_data *t, int64_t i, int d, int e, const real share,
                                     const int dim)
{
    if (dim == 2) return d == e ? share * t->dt * square(t->turn[2][i]) : d < e ? -t->turn[2][i] : t->turn[2][i];
    const real part = -share * t->dt * t->turn[d][i] * t->turn[e][i];
    if (d != e) return part + (e == (d + 1) % 3 ? -t->turn[3 - d - e][i] : t->turn[3 - d - e][i]);
    return part + share * t->dt * (square(t->turn[0][i]) + square(t->turn[1][i]) + square(t->turn[2][i]));
}

#endif
