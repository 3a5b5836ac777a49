/* Relaxation of bodies with material points, by damped steps in time. */
#ifndef CLEAVE_ENGINE_RELAXATION
#define CLEAVE_ENGINE_RELAXATION

#include "run/run.h"

/* Returns the time in which loads grow [s]: whole steps dt [s] in which a wave of this speed [m/s] travels twice the
 * length of the body [m]. */
real grid_relaxation_ramp(real length, real wave_speed, real dt);

/* A step in time; *done at equilibrium. */
status grid_relaxation_step(struct run *e, bool *done);

#endif
