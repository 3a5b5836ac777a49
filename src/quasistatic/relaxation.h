/* Relaxation of bodies with material points, by damped steps in time. */
#ifndef CLEAVE_ENGINE_RELAXATION
#define CLEAVE_ENGINE_RELAXATION

#include "run/run.h"

/* Time in which loads grow [s]: whole steps in which a wave crosses the body twice. */
real grid_relaxation_ramp(const struct run *e);

/* A step in time; *done at equilibrium. */
status grid_relaxation_step(struct run *e, bool *done);

#endif
