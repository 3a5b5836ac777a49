/* Flow law of Voce 1948: the yield stress is sigma_y + Q (1 - exp(-b a)), with the plastic strain a, the initial yield
 * stress sigma_y, and the constants Q and b. flow_linear.h describes the functions. */
#ifndef CLEAVE_KERNELS_FLOW_VOCE
#define CLEAVE_KERNELS_FLOW_VOCE

#include "data/law.h"
#include "lanes_power.h"

/* Returns the yield stresses sigma_y + Q (1 - exp(-b a)) [Pa] of eight points with the plastic strains a =
 * `plastic_strain` [1] and the constants of `law`, and stores their derivatives by a in *slope [Pa]. `temperature` has
 * no effect. */
static ALWAYS_INLINE lanes flow_stress_voce(const struct law *law, lanes plastic_strain, lanes temperature,
                                            lanes *slope)
{
    (void)temperature;
    const lanes left = law->voce.saturation * lanes_exp(-law->voce.rate * plastic_strain);
    *slope = law->voce.rate * left;
    return law->yield + (law->voce.saturation - left);
}

/* Returns for eight points the integral of the yield stress of the law `law` over the plastic strain from 0 to
 * `plastic_strain`, the plastic work per volume [J/m^3]. `temperature` has no effect. */
static ALWAYS_INLINE lanes flow_stress_integral_voce(const struct law *law, lanes plastic_strain, lanes temperature)
{
    (void)temperature;
    return (law->yield + law->voce.saturation) * plastic_strain -
           law->voce.saturation / law->voce.rate * (1.0 - lanes_exp(-law->voce.rate * plastic_strain));
}

/* Returns INFINITY for eight points, i.e. no upper bound of the plastic strain at which the yield stress is `stress`:
 * load steps (static equilibria) then start their iteration from a bound by the elastic stress. The arguments are not
 * used. */
static ALWAYS_INLINE lanes plastic_strain_bound_at_stress_voce(const struct law *law, lanes stress, lanes temperature)
{
    return (void)law, (void)stress, (void)temperature, lanes_broadcast(INFINITY);
}

#endif
