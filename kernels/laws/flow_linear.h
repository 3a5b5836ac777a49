/* Flow law with linear isotropic hardening. The functions of every flow law NAME, for eight points at once:
 *     flow_stress_NAME            returns the yield stress [Pa] of slow flow at the plastic strain
 *                                 `plastic_strain` [1] and the temperature [K], and stores its derivative by the
 *                                 plastic strain in *slope [Pa]
 *     flow_stress_integral_NAME   returns the integral of the yield stress from 0 to `plastic_strain` [J/m^3]
 *     plastic_strain_bound_at_stress_NAME
 *                                 returns the plastic strain at which the yield stress is `stress` [Pa], or an upper
 *                                 bound of it; INFINITY if there is none
 * The yield stress is a concave function of the plastic strain. */
#ifndef CLEAVE_KERNELS_FLOW_LINEAR
#define CLEAVE_KERNELS_FLOW_LINEAR

#include "data/law.h"
#include "lanes_power.h"

/* Returns the yield stresses [Pa] of eight points with the plastic strains `plastic_strain` [1] by the law `law` with
 * linear hardening, and stores the hardening modulus in *slope [Pa]. `temperature` has no effect. */
static ALWAYS_INLINE lanes flow_stress_linear(const struct law *law, lanes plastic_strain, lanes temperature,
                                              lanes *slope)
{
    (void)temperature;
    *slope = lanes_broadcast(law->hardening);
    return law->yield + law->hardening * plastic_strain;
}

/* Returns for eight points the integral of the yield stress of the law `law` over the plastic strain from 0 to
 * `plastic_strain`, the plastic work per volume [J/m^3]. `temperature` has no effect. */
static ALWAYS_INLINE lanes flow_stress_integral_linear(const struct law *law, lanes plastic_strain, lanes temperature)
{
    (void)temperature;
    return (law->yield + 0.5 * law->hardening * plastic_strain) * plastic_strain;
}

/* Returns INFINITY for eight points, i.e. no upper bound of the plastic strain at which the yield stress is `stress`,
 * since the iteration of load steps (static equilibria) does not need a bound for a linear law. The arguments are not
 * used. */
static ALWAYS_INLINE lanes plastic_strain_bound_at_stress_linear(const struct law *law, lanes stress, lanes temperature)
{
    return (void)law, (void)stress, (void)temperature, lanes_broadcast(INFINITY);
}

#endif
