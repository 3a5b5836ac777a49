/* Declares how load steps (successive static equilibria) find and apply crack increments: sets of bonds that break
 * together. */
#ifndef CLEAVE_CRACK_INCREMENT
#define CLEAVE_CRACK_INCREMENT

#include "fracture/tips.h"
#include "run/run.h"

/* Returns the fraction of a crack area whose energy belongs to the modelled body: 1/2 if all cracks lie on planes of
 * symmetry, so that the mirror image has the other half, else 1. tips: tips of the cracks; bond_source: planes of
 * symmetry; plane_axis: only planes of symmetry perpendicular to this axis are considered, -1 for all planes. */
real crack_area_fraction_inside_modelled_body(const struct crack_tips *tips, const struct bond_source *bond_source,
                                              int plane_axis);

/* Returns the crack area [m^2] that is created if all cracks of the run grow by one particle spacing along their whole
 * fronts; on planes of symmetry half of this area. In a 3D body without a pre-crack the front has the length of the
 * shortest side of the body. A bar in one dimension (`space: line`) counts as 25 spacings wide. */
real crack_area_of_growth_by_one_spacing(const struct run *run);

/* Determines the next crack increment of the run (the next piece of crack growth) from trial equilibria (solutions that
 * may be discarded), unless it is already known. Stores in run->statics its bonds (`next`), its energies (`ahead`), and
 * the load size (`due`, a measure proportional to the loads) at which it releases as much energy as it costs. Returns
 * FAILED if a trial equilibrium is not found. */
status crack_increment_find_by_trial_equilibria(struct run *run);

/* Breaks the bonds of the next crack increment of the run and moves the tips of SIF-driven cracks (growth direction
 * from stress-intensity factors), without finding the new equilibrium (crack_increment_find_new_equilibrium does).
 * Returns the number of directed bonds broken (a bond between two particles counts twice). */
int64_t crack_increment_break_bonds_and_move_tips(struct run *run);

/* Finds the equilibrium of the run after crack_increment_break_bonds_and_move_tips has broken bonds, and converts
 * material points near the crack to peridynamic particles. broken_bonds: number of directed bonds that were broken (a
 * bond between two particles counts twice). Returns FAILED if no equilibrium is found, INTERRUPTED if the run is to
 * stop. */
status crack_increment_find_new_equilibrium(struct run *run, int64_t broken_bonds);

/* Scales the loads of the run to the size at which the next crack increment releases as much energy as it costs, finds
 * the equilibrium there, and makes the increment: breaks its bonds and finds the new equilibrium. Returns FAILED if no
 * equilibrium is found, INTERRUPTED if the run is to stop. */
status crack_increment_apply_at_energy_balance(struct run *run);

/* Makes the next crack increment of the run as a dynamic release (release.c): breaks its bonds, integrates the motion
 * of the body in time under fixed loads until the body is at rest, and finds the equilibrium. Returns FAILED if the
 * motion diverges or no equilibrium is found, INTERRUPTED if the run is to stop. */
status crack_increment_apply_by_dynamic_release(struct run *run);

#endif
