/* Flow law of Johnson & Cook 1983: the yield stress is
 *     (A + B a^n)(1 + C log max(rate/eps0, 1))(1 - T*^m),   T* = (T - T_room)/(T_melt - T_room) between 0 and 1
 * with the plastic strain a and its rate, the temperature T, and the constants A, B, n, C, m, eps0, T_room
 * and T_melt of the material (struct law). The functions below omit the second factor (slow flow); law_update
 * adds the effect of the rate. flow_linear.h describes the functions. */
#ifndef CLEAVE_KERNELS_FLOW_JOHNSON_COOK
#define CLEAVE_KERNELS_FLOW_JOHNSON_COOK

#include "data/law.h"
#include "flow_power.h"

/* Returns the factor 1 - T*^m (0 to 1), by which heat reduces the yield stress in the law `law` of Johnson & Cook, for
 * eight points with the temperatures `temperature` [K]. T*: temperature above T_room divided by T_melt - T_room. */
static ALWAYS_INLINE lanes johnson_cook_thermal_softening_factor(const struct law *law, lanes temperature)
{
    const lanes hot =
        (temperature - law->johnson_cook.T_room) * (1 / (law->johnson_cook.T_melt - law->johnson_cook.T_room));
    const lanes between = lanes_max(lanes_min(hot, lanes_broadcast(1)), lanes_broadcast(0));
    return 1.0 - (law->johnson_cook.m == 1 ? between : lanes_power(between, law->johnson_cook.m));
}

/* Returns the yield stresses [Pa] of eight points in slow flow by the law `law` of Johnson & Cook, and stores their
 * derivatives by the plastic strain in *slope [Pa]. plastic_strain: plastic strains [1]; temperature: temperatures
 * [K]. */
static ALWAYS_INLINE lanes flow_stress_johnson_cook(const struct law *law, lanes plastic_strain, lanes temperature,
                                                    lanes *slope)
{
    const lanes factor = johnson_cook_thermal_softening_factor(law, temperature);
    const lanes power = power_law_stress_and_slope(law->johnson_cook.B, law->johnson_cook.n, plastic_strain, slope);
    *slope *= factor;
    return (law->johnson_cook.A + power) * factor;
}

/* Returns for eight points the plastic work per volume [J/m^3] up to `plastic_strain` at T_room, by the law `law` of
 * Johnson & Cook: the integral of A + B a^n over the plastic strain a. */
static ALWAYS_INLINE lanes johnson_cook_plastic_work_at_room_temperature(const struct law *law, lanes plastic_strain)
{
    const real n = law->johnson_cook.n;
    return law->johnson_cook.A * plastic_strain + law->johnson_cook.B / (n + 1) * lanes_power(plastic_strain, n + 1);
}

/* Returns for eight points the integral of the yield stress of the law `law` over the plastic strain from 0 to
 * `plastic_strain` at the constant temperature `temperature` [K], the plastic work per volume [J/m^3]. */
static ALWAYS_INLINE lanes flow_stress_integral_johnson_cook(const struct law *law, lanes plastic_strain,
                                                             lanes temperature)
{
    return johnson_cook_plastic_work_at_room_temperature(law, plastic_strain) *
           johnson_cook_thermal_softening_factor(law, temperature);
}

/* Number of steps in which johnson_cook_adiabatic_temperature integrates by the midpoint rule. */
enum { HEATING_STEPS = 4 };

/* Returns the temperatures [K] of eight points after slow plastic flow without heat conduction from the plastic strain
 * `from` to `to` [1], by the law `law` of Johnson & Cook. temperature: their temperatures at `from` [K]. With the
 * plastic work W at T_room and the heating k = law->heating [K m^3/J], dT* = k/(T_melt - T_room) (1 - T*^m) dW. To stay
 * below T_melt with any step, y = -log(1 - T*) is integrated: dy = k/(T_melt - T_room) g dW with g = (1 - T*^m)/(1 -
 * T*), which is between 1 and m; exact for m = 1. */
static ALWAYS_INLINE lanes johnson_cook_adiabatic_temperature(const struct law *law, lanes from, lanes to,
                                                              lanes temperature)
{
    const real room = law->johnson_cook.T_room, range = law->johnson_cook.T_melt - room, m = law->johnson_cook.m;
    const lanes work = johnson_cook_plastic_work_at_room_temperature(law, to) -
                       johnson_cook_plastic_work_at_room_temperature(law, from);
    const lanes start = lanes_max(1.0 - (temperature - room) / range, lanes_broadcast(1e-12));
    const lanes more = law->heating / range * work / HEATING_STEPS;
    lanes y = lanes_broadcast(0);
    for (int k = 0; k < HEATING_STEPS; k++) {
        lanes slope = lanes_broadcast(1);
        for (int part = 0; part < 2 && m != 1; part++) {
            const lanes left = start * lanes_exp(-(y + 0.5 * part * more * slope));
            const lanes hot = lanes_max(1.0 - left, lanes_broadcast(0));
            slope = (1.0 - lanes_power(hot, m)) / lanes_max(left, lanes_broadcast(1e-12));
        }
        y += more * slope;
    }
    return room + range * (1.0 - start * lanes_exp(-y));
}

/* Returns for eight points the plastic strain [1] at which the yield stress at the temperature `temperature` [K] is
 * `stress` [Pa]; INFINITY for a law without hardening. */
static ALWAYS_INLINE lanes plastic_strain_bound_at_stress_johnson_cook(const struct law *law, lanes stress,
                                                                       lanes temperature)
{
    const lanes factor = lanes_max(johnson_cook_thermal_softening_factor(law, temperature), lanes_broadcast(1e-12));
    if (!(law->johnson_cook.B > 0)) return lanes_broadcast(INFINITY);
    const lanes ratio = (stress / factor - law->johnson_cook.A) / law->johnson_cook.B;
    return lanes_power(lanes_max(ratio, lanes_broadcast(0)), 1 / law->johnson_cook.n);
}

#endif
