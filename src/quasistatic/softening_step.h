/* Load steps of bodies whose bonds soften. */
#ifndef CLEAVE_SOFTENING_STEP
#define CLEAVE_SOFTENING_STEP

#include "run/run.h"

/* Makes one load step of a body whose bonds soften. Control energy: bonds dissipate `steps.energy` more, under loads
 * that grow or fall as they must; control load: the pseudo-time becomes t [s]. Breaks the bonds that have ended.
 * Returns FAILED if no equilibrium is found, INTERRUPTED if the run is to stop. */
status softening_step(struct run *e, real t);

/* Returns the smallest crack energy per area of the materials whose bonds soften [J/m^2], INFINITY without any. */
real softening_least_toughness(const struct scene *s, const struct bond_source *source);

#endif
