/* Declares the functions that find the equilibrium of a body at a given pseudo-time of its load steps. */
#ifndef CLEAVE_BALANCE
#define CLEAVE_BALANCE

#include "run/run.h"

/* Finds the equilibrium of the run under the loads and supports at the pseudo-time `pseudo_time` [s], which becomes the
 * present pseudo-time. Updates the work of loads, the energy losses, the reactions of supports, and the largest ratio
 * of stretch to critical stretch. Returns FAILED, with the position of the largest residual in the message, if no
 * equilibrium is found; INTERRUPTED if the run is to stop. */
status equilibrium_find_at_time(struct run *run, real pseudo_time);

/* Solves for the equilibrium of the run at the pseudo-time `pseudo_time` [s], starting from the present equilibrium,
 * and makes `pseudo_time` the present pseudo-time. Does not update work, energy losses and reactions.
 * present_applied_forces[dim]: applied forces of the present equilibrium, a value for each particle [N]; they must not
 * be the arrays run->statics->applied. Returns FAILED, with the position of the largest residual in the message, if no
 * equilibrium is found: `pseudo_time` is then set, and the displacements are those of the last iteration. Before
 * anything is changed, returns INTERRUPTED if the run is to stop, and FAILED if the formula of a load is not finite. */
status equilibrium_solve_without_updating_work(struct run *run, real pseudo_time, real *const *present_applied_forces);

/* Converts the material points of the run that lost bonds or have a high stress to peridynamic particles, and finds the
 * equilibrium again, until no further point has to be converted. broken_bonds: number of directed bonds that have
 * broken since the last call (a bond between two particles counts twice). Returns FAILED if no equilibrium is found,
 * INTERRUPTED if the run is to stop. */
status equilibrium_convert_points_to_pd_and_solve_again(struct run *run, int64_t broken_bonds);

#endif
