/* Functions that evaluate any flow law: each calls the function of the law that law->flow selects. flow_linear.h
 * describes the functions. */
#ifndef CLEAVE_KERNELS_FLOWS
#define CLEAVE_KERNELS_FLOWS

#include "flow_johnson_cook.h"
#include "flow_linear.h"
#include "flow_power.h"
#include "flow_table.h"
#include "flow_voce.h"

#define FLOW_CASE(upper, lower, ...)                                                                                   \
    case FLOW_##upper:                                                                                                 \
        return FLOW_CALL(lower);

/* Returns the yield stresses [Pa] of eight points in slow flow by the flow law `law`, and stores their derivatives by
 * the plastic strain in *slope [Pa]. plastic_strain: plastic strains [1]; temperature: temperatures [K]. */
static ALWAYS_INLINE lanes law_flow_stress(const struct law *law, lanes plastic_strain, lanes temperature, lanes *slope)
{
#define FLOW_CALL(name) flow_stress_##name(law, plastic_strain, temperature, slope)
    switch (law->flow) {
        FLOWS(FLOW_CASE)
    default:
        return *slope = lanes_broadcast(0);
    }
#undef FLOW_CALL
}

/* Returns for eight points the plastic strain [1] at which the yield stress of the flow law `law` is `stress` [Pa], or
 * an upper bound of this strain; INFINITY if no bound is known. temperature: temperatures [K]. */
static ALWAYS_INLINE lanes law_plastic_strain_bound_at_yield_stress(const struct law *law, lanes stress,
                                                                    lanes temperature)
{
#define FLOW_CALL(name) plastic_strain_bound_at_stress_##name(law, stress, temperature)
    switch (law->flow) {
        FLOWS(FLOW_CASE)
    default:
        return lanes_broadcast(INFINITY);
    }
#undef FLOW_CALL
}

/* Returns for eight points the integral of the yield stress of the flow law `law` over the plastic strain from 0 to
 * `plastic_strain`, the plastic work per volume [J/m^3]. temperature: temperatures [K]. */
static ALWAYS_INLINE lanes law_flow_stress_integral(const struct law *law, lanes plastic_strain, lanes temperature)
{
#define FLOW_CALL(name) flow_stress_integral_##name(law, plastic_strain, temperature)
    switch (law->flow) {
        FLOWS(FLOW_CASE)
    default:
        return lanes_broadcast(0);
    }
#undef FLOW_CALL
}

#endif
