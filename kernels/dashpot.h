/* Velocity change by a dashpot: force -k (v_old + v_new)/2 within a leap-frog step, v_old and v_new being the
 * velocities at the ends of the step. All other forces are known, so the mean velocity has a closed form for any step
 * size: (v_old + change/2)/(1 + k dt/(2 m)), `change` due to the other forces. The work of its impulse, -k dt mean^2,
 * is never positive. */
#ifndef CLEAVE_KERNELS_DASHPOT
#define CLEAVE_KERNELS_DASHPOT

#include "data/grid.h"

/* Returns the impulse [N s] of a dashpot along axis `axis` on a node or particle in a step, by the implicit mean
 * velocity (v_old + v_new)/2. Adds impulse and dissipated energy to *a, and a quarter of the impulse times the change
 * of velocity to a->kick, which is excluded from the correction of the kinetic energy in energy balances. rate_dt:
 * dashpot rate times the duration of the step, k dt [kg]; mass [kg]; old_velocity: velocity v_old [m/s];
 * velocity_change: velocity change by all other forces [m/s]. */
static inline real dashpot_compute_and_add_impulse(struct dashpot_effect *a, int axis, real rate_dt, real mass,
                                                   real old_velocity, real velocity_change)
{
    const real mean = (old_velocity + 0.5 * velocity_change) / (1 + 0.5 * rate_dt / mass), impulse = -rate_dt * mean;
    a->energy += rate_dt * mean * mean;
    a->kick += 0.5 * impulse * (mean - old_velocity); /* v_new - v_old = 2 (mean - v_old) */
    a->impulse[axis] += impulse;
    return impulse;
}

/* Corrects a->energy, the energy that dashpots dissipate, and a->kick, a quarter of the sum of impulse times change of
 * velocity [J], to which dashpot_compute_and_add_impulse has added, if the velocity at the end of the step is
 * afterwards changed by a further `velocity_change` [m/s], along the same axis. impulse: of the dashpot on the body, as
 * dashpot_compute_and_add_impulse has returned it [N s]. */
static inline void dashpot_correct_energy_for_velocity_change(struct dashpot_effect *a, real impulse,
                                                              real velocity_change)
{
    a->energy -= 0.5 * impulse * velocity_change;
    a->kick += 0.25 * impulse * velocity_change;
}

#endif
