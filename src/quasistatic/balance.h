/* Equilibrium at a pseudo-time. */
#ifndef CLEAVE_BALANCE
#define CLEAVE_BALANCE

#include "run/run.h"

/* Finds the equilibrium under the loads and supports of pseudo-time t [s], which becomes the present one; books work,
 * losses and reactions, and finds the overload. Returns FAILED, with the place of the largest residual, if there is no
 * equilibrium, and INTERRUPTED if the run is to stop. */
status statics_go(struct run *e, real t);

/* Converts marked material points to peridynamic particles and finds the equilibrium again, until no point is marked.
 * broken: directed bonds that have broken since the last call. Returns what statics_go returns. */
status statics_convert(struct run *e, int64_t broken);

#endif
