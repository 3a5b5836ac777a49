/* Flow law of Johnson & Cook 1983:
 *     (A + B a^n)(1 + C log max(rate/eps0, 1))(1 - T*^m),   T* = (T - T_room)/(T_melt - T_room) between 0 and 1
 * with the total deviatoric strain rate. The functions: flow_linear.h. */
#ifndef CLEAVE_KERNELS_FLOW_JOHNSON_COOK
#define CLEAVE_KERNELS_FLOW_JOHNSON_COOK

#include "data/law.h"
#include "flow_power.h"

/* Returns the factor (1 + C log max(rate/eps0, 1))(1 - T*^m) on the yield stress of the law m of Johnson & Cook [1],
 * for eight points. rate: total deviatoric strain rates [1/s]; T: temperatures [K]. */
static ALWAYS_INLINE lanes johnson_cook_factor(const struct law *m, lanes rate, lanes T)
{
    const lanes ratio = lanes_max(rate * (1 / m->johnson_cook.eps0), lanes_broadcast(1));
    const lanes hot = (T - m->johnson_cook.T_room) * (1 / (m->johnson_cook.T_melt - m->johnson_cook.T_room));
    const lanes between = lanes_max(lanes_min(hot, lanes_broadcast(1)), lanes_broadcast(0));
    const lanes soft = m->johnson_cook.m == 1 ? between : lanes_power(between, m->johnson_cook.m);
    return (1.0 + m->johnson_cook.C * lanes_log(ratio)) * (1.0 - soft);
}

/* Returns the yield stresses of eight points by the law of Johnson & Cook [Pa] and stores their derivatives by the
 * plastic strain a in *slope [Pa]. rate: total deviatoric strain rates [1/s]; T: temperatures [K]. */
static ALWAYS_INLINE lanes flow_johnson_cook(const struct law *m, lanes a, lanes rate, lanes T, lanes *slope)
{
    const lanes factor = johnson_cook_factor(m, rate, T);
    const lanes power = power_of_strain(m->johnson_cook.B, m->johnson_cook.n, a, slope);
    *slope *= factor;
    return (m->johnson_cook.A + power) * factor;
}

/* Returns the integral of the yield stress from plastic strain 0 to a at constant rate and temperature [J/m^3]. */
static ALWAYS_INLINE lanes work_johnson_cook(const struct law *m, lanes a, lanes rate, lanes T)
{
    const real n = m->johnson_cook.n;
    const lanes cold = m->johnson_cook.A * a + m->johnson_cook.B / (n + 1) * lanes_power(a, n + 1);
    return cold * johnson_cook_factor(m, rate, T);
}

/* Returns the plastic strain at which the yield stress at the given rate and temperature is q [Pa]; INFINITY without
 * hardening. */
static ALWAYS_INLINE lanes reach_johnson_cook(const struct law *m, lanes q, lanes rate, lanes T)
{
    const lanes factor = lanes_max(johnson_cook_factor(m, rate, T), lanes_broadcast(1e-12));
    if (!(m->johnson_cook.B > 0)) return lanes_broadcast(INFINITY);
    const lanes ratio = (q / factor - m->johnson_cook.A) / m->johnson_cook.B;
    return lanes_power(lanes_max(ratio, lanes_broadcast(0)), 1 / m->johnson_cook.n);
}

#endif
