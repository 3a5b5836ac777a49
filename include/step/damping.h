#ifndef CLEAVE_DAMPING
#define CLEAVE_DAMPING

#include "run/run.h"

/* Velocities before a step moves them, of particles and of nodes, where damping acts; from step to step it has no
 * state. */
struct damping_state {
    real *before[2][DIM_MAX];
};

/* Of a kick that is left at its end, exp(-c dt/2); 1 without damping [1]. */
real damping_share(const struct run *e);
/* Keeps velocities before a step moves them. */
void damping_begin(struct run *e);
/* The loss since the step before, once it has one [J]. */
real damping_loss(struct run *e);
/* Slows all for the next step. */
void damping_end(struct run *e);
/* The loss of the last kick, which nothing follows, by the kinetic energies before it and across it [J]. */
real damping_last(const struct run *e, real kinetic_before, real kinetic);

#endif
