/* Tests whether particles have diverged. */
#ifndef CLEAVE_KERNELS_DIVERGENCE
#define CLEAVE_KERNELS_DIVERGENCE

#include <float.h>

#include "kernels/simd/lanes.h"

/* Tests eight particles for divergence. Returns a mask in which a lane is set if its particle is too fast or has a
 * position or velocity that is not finite. squared_speed: squares of the speeds [m^2/s^2]; position_sum: sums of the
 * absolute values of the position components [m]; squared_limit: square of the largest allowed speed [m^2/s^2]. NaN
 * counts as diverged. */
static ALWAYS_INLINE lanes_mask lanes_mask_of_diverged_particles(lanes squared_speed, lanes position_sum,
                                                                 real squared_limit)
{
    return ~((squared_speed <= squared_limit) & (position_sum <= DBL_MAX));
}

#endif
