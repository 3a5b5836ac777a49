/* The kick of a dashpot: force -k (v_before + v_after)/2 within a leap-frog step. All other forces are known, so that
 * the velocity after it has a closed form, for any step: the mean of both is (v_before + change/2)/(1 + k dt/(2 m)),
 * `change` by the other forces. The work of the impulse is -k dt mean^2, which is never a gain. */
#ifndef CLEAVE_KERNELS_DASHPOT
#define CLEAVE_KERNELS_DASHPOT

#include "data/grid.h"

/* Impulse of component d on a mass [N s], with its account; rate_dt: k dt [kg]. */
static inline real dashpot_kick(struct absorbed *a, int d, real rate_dt, real mass, real before, real change)
{
    const real mean = (before + 0.5 * change) / (1 + 0.5 * rate_dt / mass), impulse = -rate_dt * mean;
    a->energy += rate_dt * mean * mean;
    a->kick += 0.5 * impulse * (mean - before); /* after - before = 2 (mean - before) */
    a->impulse[d] += impulse;
    return impulse;
}

/* Corrects the account of an impulse whose velocity after it is larger by `more`. */
static inline void dashpot_correct(struct absorbed *a, real impulse, real more)
{
    a->energy -= 0.5 * impulse * more;
    a->kick += 0.25 * impulse * more;
}

#endif
