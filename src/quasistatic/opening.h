/* Declares the functions for load steps that are controlled by the opening of a crack: the increase of the distance
 * between two gauge particles, one on each side of the crack. */
#ifndef CLEAVE_OPENING
#define CLEAVE_OPENING

#include "quasistatic/statics.h"
#include "run/run.h"

/* Checks the two gauge positions of `scene` (the input file), points on both sides of a crack whose distance controls
 * the load steps (successive static equilibria). Returns REFUSED, with a message, if one of them is far from the body,
 * or if the same particle is nearest to both. part: particles of the body. */
status crack_gauge_check_positions(const struct scene *scene, const struct particles *part);

/* Returns the opening: the increase of the distance between the two gauge particles of `part` (statics->gauge, on both
 * sides of a crack) since the start [m]. */
real crack_gauge_opening(const struct particles *part, const struct statics *statics);

/* Returns true if material points or bonds of the body `part` may yield (have plastic strain). */
bool particles_or_bonds_may_yield(const struct particles *part, const struct bonds *bonds);

/* Finds the equilibrium of the run at which the opening between the two gauge particles (on both sides of a crack)
 * equals `wanted_opening` [m], by varying the pseudo-time. pseudo_time_guess: first pseudo-time tried [s]. Returns
 * FAILED, with a message, if an equilibrium is not found, or if the opening that is reached differs from
 * `wanted_opening` by more than a hundredth. */
status equilibrium_find_at_crack_opening(struct run *run, real wanted_opening, real pseudo_time_guess);

#endif
