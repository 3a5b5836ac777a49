/* Velocity gradient by which rotating points (data/turning.h) extrapolate their velocity to nodes. */
#ifndef CLEAVE_KERNELS_TURN
#define CLEAVE_KERNELS_TURN

#include "kernels/kernels.h"

/* Returns the derivative of velocity component d along axis e by which point i extrapolates its velocity to nodes
 * [1/s]. It follows from the spin w of the point's group, t->turn. The leap-frog velocity v = (x' - x)/dt is along a
 * chord of the circle of rotation: v = w x r - share dt w x (w x r). share: 1/2 for r at the position x' at the end of
 * the step, -1/2 at its start x. Without the second-order term rotating bodies shrink: a square by 0.2 % per turn at
 * 4000 1/s. */
static ALWAYS_INLINE real turn_slope(const struct transfer_data *t, int64_t i, int d, int e, const real share,
                                     const int dim)
{
    if (dim == 2) return d == e ? share * t->dt * square(t->turn[2][i]) : d < e ? -t->turn[2][i] : t->turn[2][i];
    const real part = -share * t->dt * t->turn[d][i] * t->turn[e][i];
    if (d != e) return part + (e == (d + 1) % 3 ? -t->turn[3 - d - e][i] : t->turn[3 - d - e][i]);
    return part + share * t->dt * (square(t->turn[0][i]) + square(t->turn[1][i]) + square(t->turn[2][i]));
}

#endif
