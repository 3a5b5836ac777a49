/* Equilibrium at a pseudo-time. */
#ifndef CLEAVE_BALANCE
#define CLEAVE_BALANCE

#include "run/run.h"

/* Finds the equilibrium under the loads and supports of pseudo-time t [s] and makes t the present pseudo-time. Updates
 * the work of loads, the losses, the reactions, and the largest ratio of stretch to critical stretch. Returns FAILED,
 * with the position of the largest residual, if there is no equilibrium, and INTERRUPTED if the run is to stop. */
status equilibrium_at(struct run *e, real t);

/* Converts marked material points to peridynamic particles and finds the equilibrium again, until no point is marked.
 * broken: number of directed bonds that have broken since the last call. Returns FAILED if there is no equilibrium,
 * INTERRUPTED if the run is to stop. */
status equilibrium_convert(struct run *e, int64_t broken);

#endif
