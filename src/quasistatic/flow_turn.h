/* The turn of the direction of plastic flow, and the fall of the yield stress, within a load step. The return mapping
 * of a load step has one direction of flow, that at the end of the step (kernels/laws/law_update.c), so that steps of
 * any size are exact where this direction is constant, and of first order in the turn elsewhere. */
#ifndef CLEAVE_FLOW_TURN
#define CLEAVE_FLOW_TURN

#include "base/warnings.h"
#include "kernels/kernels.h"
#include "quasistatic/statics.h"

/* Measures by how much the direction of flow of each point has turned since the last call, from where the trial stress
 * of the load step reached the yield surface to the end of the step, and by how much its yield stress has fallen.
 * Updates the largest values so far in s->turn (not in 1D, where the direction of flow only changes its sign) and
 * s->softening, and stores the present state as the start of the next load step. The first call stores the state only.
 * elastic_constants: elastic constants of all materials; load_step: number of the load step (static equilibrium). Does
 * nothing if no point of p yields. */
void plastic_flow_measure_direction_change(struct statics *s, const struct particles *p,
                                           const struct elastic *elastic_constants, int64_t load_step);

/* Adds a warning to *warnings if the largest angle *turn by which the direction of plastic flow has turned within a
 * load step (static equilibrium) is so large that stresses may be wrong by more than 5 %. dim: dimension of the space.
 */
void plastic_flow_warn_of_inexact_stress(const struct plastic_flow_direction_change *turn, int dim,
                                         struct warnings *warnings);

/* Adds a warning to *warnings if heat has lowered the yield stress of a point that flows by more than a thousandth
 * within a load step, so that plastic flow may localise in one row of cells. softening: largest decrease in a load step
 * so far; dim: dimension of the space. */
void plastic_flow_warn_of_thermal_softening(const struct plastic_flow_thermal_softening *softening, int dim,
                                            struct warnings *warnings);

#endif
