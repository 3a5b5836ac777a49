/* Flow law of Ludwik 1909: the yield stress is sigma_y + B a^n, with the plastic strain a, the initial yield stress
 * sigma_y, and the constants B and 0 < n <= 1. flow_linear.h describes the functions. */
#ifndef CLEAVE_KERNELS_FLOW_POWER
#define CLEAVE_KERNELS_FLOW_POWER

#include "data/law.h"
#include "lanes_power.h"

/* Returns coefficient * strain^exponent [Pa] for the plastic strains `strain` of eight points, and stores its
 * derivative by the strain in *slope [Pa], which is large but finite at strain 0. coefficient: [Pa]; exponent: in
 * (0, 1]. */
static ALWAYS_INLINE lanes power_law_stress_and_slope(real coefficient, real exponent, lanes strain, lanes *slope)
{
    const lanes least = lanes_max(strain, lanes_broadcast(1e-200)), power = coefficient * lanes_power(least, exponent);
    *slope = exponent * power / least;
    return lanes_choose(lanes_less(strain, lanes_broadcast(1e-200)), lanes_broadcast(0), power);
}

/* Returns the yield stresses sigma_y + B a^n [Pa] of eight points with the plastic strains a = `plastic_strain` [1] and
 * the constants of `law`, and stores their derivatives by a in *slope [Pa]. `temperature` has no effect. */
static ALWAYS_INLINE lanes flow_stress_power(const struct law *law, lanes plastic_strain, lanes temperature,
                                             lanes *slope)
{
    (void)temperature;
    return law->yield + power_law_stress_and_slope(law->power.coefficient, law->power.exponent, plastic_strain, slope);
}

/* Returns for eight points the integral of the yield stress of the law `law` over the plastic strain from 0 to
 * `plastic_strain`, the plastic work per volume [J/m^3]. `temperature` has no effect. */
static ALWAYS_INLINE lanes flow_stress_integral_power(const struct law *law, lanes plastic_strain, lanes temperature)
{
    (void)temperature;
    const real n = law->power.exponent;
    return law->yield * plastic_strain + law->power.coefficient / (n + 1) * lanes_power(plastic_strain, n + 1);
}

/* Returns for eight points the plastic strain a [1] at which the yield stress sigma_y + B a^n of the law `law` equals
 * `stress` [Pa]; 0 where `stress` is below sigma_y, the yield stress at plastic strain 0. `temperature` has no
 * effect. */
static ALWAYS_INLINE lanes plastic_strain_bound_at_stress_power(const struct law *law, lanes stress, lanes temperature)
{
    (void)temperature;
    return lanes_power(lanes_max((stress - law->yield) / law->power.coefficient, lanes_broadcast(0)),
                       1 / law->power.exponent);
}

#endif
