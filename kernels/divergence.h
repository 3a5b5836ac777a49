/* Test for diverged particles. */
#ifndef CLEAVE_KERNELS_DIVERGENCE
#define CLEAVE_KERNELS_DIVERGENCE

#include <float.h>

#include "kernels/simd/lanes.h"

/* Returns the mask of diverged particles among eight. speed2: squared speeds [m^2/s^2]; place: sums of |x_d| [m];
 * limit2: squared speed limit. The comparisons are written such that NaN counts as diverged. */
static ALWAYS_INLINE lanes_mask has_diverged(lanes speed2, lanes place, real limit2)
{
    return ~((speed2 <= limit2) & (place <= DBL_MAX));
}

#endif
