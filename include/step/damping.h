#ifndef CLEAVE_DAMPING
#define CLEAVE_DAMPING

#include "run/run.h"

/* Velocities before a step moves them, of particles and of nodes, where damping acts; from step to step it has no
 * state. */
struct damping_state {
    real *before[2][DIM_MAX];
};

#endif
