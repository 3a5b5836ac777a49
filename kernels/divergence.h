/* Test for diverged particles. */
#ifndef CLEAVE_KERNELS_DIVERGENCE
#define CLEAVE_KERNELS_DIVERGENCE

#include <float.h>

#include "kernels/simd/lanes.h"

/* Returns a mask of eight particles in which a lane is set if its particle has diverged, i.e. is too fast or has a
 * position or velocity that is not finite. speed2: squared speeds [m^2/s^2]; place: sums of the absolute values of the
 * position components [m]; limit2: square of the largest allowed speed [m^2/s^2]. NaN counts as diverged. */
static ALWAYS_INLINE lanes_mask has_diverged(lanes speed2, lanes place, real limit2)
{
    return ~((speed2 <= limit2) & (place <= DBL_MAX));
}

#endif
