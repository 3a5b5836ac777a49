/* Declares the load step of bodies whose bonds soften. */
#ifndef CLEAVE_SOFTENING_STEP
#define CLEAVE_SOFTENING_STEP

#include "run/run.h"

/* Makes one load step (static equilibrium under increased loads) of the run, whose bonds soften. With the control
 * `energy`, bonds dissipate the energy `steps.energy` in the step, and the size of the loads follows from it; with the
 * control `load`, the pseudo-time becomes `pseudo_time` [s]. Breaks the bonds that have no stiffness left. Returns
 * FAILED if no equilibrium is found, INTERRUPTED if the run is to stop. */
status load_step_solve_with_softening_bonds(struct run *run, real pseudo_time);

/* Returns the smallest crack energy per area [J/m^2] of the materials of scene s (the input file) whose bonds soften;
 * INFINITY if none do. bond_source: inputs of the bonds (horizon, materials, cracks, mirrors). */
real softening_materials_least_toughness(const struct scene *s, const struct bond_source *bond_source);

#endif
