/* Flow law of Voce 1948: sigma_y + Q (1 - exp(-b a)). The functions: flow_linear.h. */
#ifndef CLEAVE_KERNELS_FLOW_VOCE
#define CLEAVE_KERNELS_FLOW_VOCE

#include "data/law.h"
#include "lanes_power.h"

/* Returns the yield stresses sigma_y + Q (1 - exp(-b a)) of eight points [Pa] and stores their derivatives by the
 * plastic strain a in *slope [Pa]. Rate and temperature have no effect. */
static ALWAYS_INLINE lanes flow_voce(const struct law *m, lanes a, lanes rate, lanes T, lanes *slope)
{
    (void)rate, (void)T;
    const lanes left = m->voce.saturation * lanes_exp(-m->voce.rate * a);
    *slope = m->voce.rate * left;
    return m->yield + (m->voce.saturation - left);
}

/* Returns the integral of the yield stress from plastic strain 0 to a [J/m^3]. */
static ALWAYS_INLINE lanes work_voce(const struct law *m, lanes a, lanes rate, lanes T)
{
    (void)rate, (void)T;
    return (m->yield + m->voce.saturation) * a -
           m->voce.saturation / m->voce.rate * (1.0 - lanes_exp(-m->voce.rate * a));
}

/* Returns INFINITY: this law gives no bound of the plastic strain at which the yield stress is q. */
static ALWAYS_INLINE lanes reach_voce(const struct law *m, lanes q, lanes rate, lanes T)
{
    return (void)m, (void)q, (void)rate, (void)T, lanes_broadcast(INFINITY);
}

#endif
