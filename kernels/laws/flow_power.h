/* Flow law with a power of the plastic strain (Ludwik 1909): sigma_y + B a^n, 0 < n <= 1. The functions:
 * flow_linear.h. */
#ifndef CLEAVE_KERNELS_FLOW_POWER
#define CLEAVE_KERNELS_FLOW_POWER

#include "data/law.h"
#include "lanes_power.h"

/* Returns B a^n [Pa] for the plastic strains a of eight points, and stores its derivative n B a^(n - 1) in *slope [Pa],
 * which is large but finite at a = 0. B: coefficient [Pa]; n: exponent, 0 < n <= 1. */
static ALWAYS_INLINE lanes power_of_strain(real B, real n, lanes a, lanes *slope)
{
    const lanes least = lanes_max(a, lanes_broadcast(1e-200)), power = B * lanes_power(least, n);
    *slope = n * power / least;
    return lanes_choose(lanes_less(a, lanes_broadcast(1e-200)), lanes_broadcast(0), power);
}

/* Returns the yield stresses sigma_y + B a^n of eight points [Pa] and stores their derivatives by the plastic strain a
 * in *slope [Pa]. Rate and temperature have no effect. */
static ALWAYS_INLINE lanes flow_power(const struct law *m, lanes a, lanes rate, lanes T, lanes *slope)
{
    (void)rate, (void)T;
    return m->yield + power_of_strain(m->power.coefficient, m->power.exponent, a, slope);
}

/* Returns the integral of the yield stress from plastic strain 0 to a [J/m^3]. */
static ALWAYS_INLINE lanes work_power(const struct law *m, lanes a, lanes rate, lanes T)
{
    (void)rate, (void)T;
    const real n = m->power.exponent;
    return m->yield * a + m->power.coefficient / (n + 1) * lanes_power(a, n + 1);
}

/* Returns the plastic strain at which the yield stress is q [Pa], 0 if q is below the first one. */
static ALWAYS_INLINE lanes reach_power(const struct law *m, lanes q, lanes rate, lanes T)
{
    (void)rate, (void)T;
    return lanes_power(lanes_max((q - m->yield) / m->power.coefficient, lanes_broadcast(0)), 1 / m->power.exponent);
}

#endif
