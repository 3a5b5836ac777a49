/* Flow law with linear isotropic hardening. The functions of every flow law NAME, for eight points at once:
 *     flow_NAME   returns the yield stress [Pa] at plastic strain a [1], total deviatoric strain rate `rate` [1/s] and
 *                 temperature T [K], and stores its derivative by a in *slope [Pa]
 *     work_NAME   returns the integral of the yield stress from 0 to a [J/m^3]
 *     reach_NAME  returns the plastic strain at which the yield stress is q [Pa], or an upper bound of it; INFINITY if
 *                 there is none
 * The yield stress is a concave function of a. */
#ifndef CLEAVE_KERNELS_FLOW_LINEAR
#define CLEAVE_KERNELS_FLOW_LINEAR

#include "data/law.h"
#include "lanes_power.h"

/* Returns the yield stresses of eight points with linear hardening [Pa] and stores the hardening modulus in *slope
 * [Pa]. Rate and temperature have no effect. */
static ALWAYS_INLINE lanes flow_linear(const struct law *m, lanes a, lanes rate, lanes T, lanes *slope)
{
    (void)rate, (void)T;
    *slope = lanes_broadcast(m->hardening);
    return m->yield + m->hardening * a;
}

/* Returns the integral of the yield stress from plastic strain 0 to a [J/m^3]. */
static ALWAYS_INLINE lanes work_linear(const struct law *m, lanes a, lanes rate, lanes T)
{
    (void)rate, (void)T;
    return (m->yield + 0.5 * m->hardening * a) * a;
}

/* Returns INFINITY: load steps need no bound of the plastic strain for a law that is linear. */
static ALWAYS_INLINE lanes reach_linear(const struct law *m, lanes q, lanes rate, lanes T)
{
    return (void)m, (void)q, (void)rate, (void)T, lanes_broadcast(INFINITY);
}

#endif
