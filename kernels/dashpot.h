/* Computes the velocity change by a dashpot: a force -k (v_old + v_new)/2 in a leap-frog step, with the dashpot rate k
 * [kg/s] and the velocities v_old and v_new at both ends of the step. Since all other forces are known, the mean
 * velocity has a closed form for any step dt: mean = (v_old + change/2)/(1 + k dt/(2 m)), with the mass m and the
 * velocity change `change` by all other forces. The work of the impulse -k dt mean is -k dt mean^2, which is never
 * positive. */
#ifndef CLEAVE_KERNELS_DASHPOT
#define CLEAVE_KERNELS_DASHPOT

#include "data/grid.h"

/* Returns the impulse [N s] of a dashpot along axis `axis` on a node or particle in a step, by the implicit mean
 * velocity (v_old + v_new)/2. Adds impulse and dissipated energy [J] to *effect. Adds a quarter of impulse times
 * velocity change to effect->kick [J], which energy balances exclude from the correction of the kinetic energy.
 * rate_dt: dashpot rate times duration of the step, k dt [kg]; mass [kg]; old_velocity: velocity v_old [m/s];
 * velocity_change: velocity change by all other forces [m/s]. */
static inline real dashpot_compute_and_add_impulse(struct dashpot_effect *effect, int axis, real rate_dt, real mass,
                                                   real old_velocity, real velocity_change)
{
    const real mean = (old_velocity + 0.5 * velocity_change) / (1 + 0.5 * rate_dt / mass), impulse = -rate_dt * mean;
    effect->energy += rate_dt * mean * mean;
    effect->kick += 0.5 * impulse * (mean - old_velocity); /* v_new - v_old = 2 (mean - v_old) */
    effect->impulse[axis] += impulse;
    return impulse;
}

/* Corrects the energies in *effect if a velocity is changed by a further `velocity_change` [m/s] after the call of
 * dashpot_compute_and_add_impulse, along the same axis: effect->energy, dissipated by dashpots, and effect->kick, a
 * quarter of the sum of impulse times velocity change [J]. impulse: result of dashpot_compute_and_add_impulse [N s]. */
static inline void dashpot_correct_energy_for_velocity_change(struct dashpot_effect *effect, real impulse,
                                                              real velocity_change)
{
    effect->energy -= 0.5 * impulse * velocity_change;
    effect->kick += 0.25 * impulse * velocity_change;
}

#endif
