/* Static solutions with material points by damped time steps on the grid. */
#ifndef CLEAVE_ENGINE_RELAXATION
#define CLEAVE_ENGINE_RELAXATION

#include "run/run.h"

/* Returns the time in which loads grow [s]: the whole number of steps dt [s] in which a wave of this speed [m/s]
 * travels twice the length of the body [m]. */
real grid_relaxation_ramp(real length, real wave_speed, real dt);

/* Makes a damped time step. Sets *done at equilibrium, and leaves it otherwise. Returns the status of step, or FAILED
 * if the step is unstable. */
status grid_relaxation_step(struct run *e, bool *done);

#endif
