/* The test for diverged particles. */
#ifndef CLEAVE_KERNELS_DIVERGENCE
#define CLEAVE_KERNELS_DIVERGENCE

#include <float.h>

#include "kernels/simd/lanes.h"

/* Of eight particles, by the squares of their speeds and what the sizes of their places' components add up to.
 * Comparisons are written so that a number that is none is caught. */
static ALWAYS_INLINE lanes_mask has_diverged(lanes speed2, lanes place, real limit2)
{
    return ~((speed2 <= limit2) & (place <= DBL_MAX));
}

#endif
