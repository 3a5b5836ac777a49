/* Declares the static solver `relaxation`, which finds equilibria of material points by damped time steps on the
 * grid. */
#ifndef CLEAVE_ENGINE_RELAXATION
#define CLEAVE_ENGINE_RELAXATION

#include "run/run.h"

/* Returns the time [s] over which loads grow to their full value: the smallest whole number of time steps `time_step`
 * [s] in which a wave with the speed wave_speed [m/s] travels twice the length of the body, `body_length` [m]. */
real grid_relaxation_load_ramp_time(real body_length, real wave_speed, real time_step);

/* Makes one damped time step of the run towards equilibrium on the grid (`solver: relaxation`). Sets *is_in_equilibrium
 * to true if the body has reached equilibrium, else leaves *is_in_equilibrium unchanged. Returns FAILED if the step
 * fails or is unstable. */
status grid_relaxation_step(struct run *run, bool *is_in_equilibrium);

#endif
