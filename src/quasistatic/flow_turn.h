/* Measures by how much the direction of plastic flow turns within a load step, and by how much the yield stress falls,
 * and warns of inexact stresses. The return mapping of a load step uses the direction of flow at the end of the step
 * (kernels/laws/law_update.c). Its stresses are exact, for steps of any size, if the direction is constant; otherwise
 * their error is of first order in the angle by which the direction turns. */
#ifndef CLEAVE_FLOW_TURN
#define CLEAVE_FLOW_TURN

#include "base/warnings.h"
#include "kernels/kernels.h"
#include "quasistatic/statics.h"

/* Measures for each point that yields by how much its direction of plastic flow has turned in this load step, and by
 * how much its yield stress has fallen. The turn is measured from the direction at which the trial stress reached the
 * yield surface to that at the end of the step. Updates the largest values so far in s->turn (not in 1D, where the
 * direction only changes its sign) and s->softening. Stores the present state as the start of the next load step; the
 * first call does nothing else. Does nothing if no point of p yields. elastic_constants: of all materials; load_step:
 * number of the load step (static equilibrium). */
void plastic_flow_measure_direction_change(struct statics *s, const struct particles *p,
                                           const struct elastic *elastic_constants, int64_t load_step);

/* Adds a warning to *warnings if the largest angle *turn by which the direction of plastic flow has turned within a
 * load step (static equilibrium) is so large that stresses may be wrong by more than 5 %. dim: dimension of the space.
 */
void plastic_flow_warn_of_inexact_stress(const struct plastic_flow_direction_change *turn, int dim,
                                         struct warnings *warnings);

/* Adds a warning to *warnings if heat has lowered the yield stress of a yielding material point by more than a
 * thousandth within a load step, since plastic flow may then localise in a single row of cells. softening: largest such
 * decrease so far; dim: dimension of the space. */
void plastic_flow_warn_of_thermal_softening(const struct plastic_flow_thermal_softening *softening, int dim,
                                            struct warnings *warnings);

#endif
