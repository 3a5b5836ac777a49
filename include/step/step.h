/* Room `step` (folders include/step and src/step): one time step, samples of history.csv, reports and stability checks.
 * It calls all parts of a run except load steps; load steps and the engine call it. */
#ifndef CLEAVE_STEP
#define CLEAVE_STEP

#include "probes/probes.h"
#include "run/run.h"

/* Advances the run by one time step run->clock.dt: computes forces, breaks bonds, moves particles and nodes, and
 * converts material points to peridynamic particles. Returns FAILED if material points have left the background grid
 * because their motion has diverged. */
status run_advance_by_one_time_step(struct run *run);

/* Marks with FLAG_NEAR the material points of the run, at their present positions, that are near other bodies; rigid
 * bodies are at their positions of pseudo-time t [s]. Marked points become peridynamic at the next call of
 * load_step_convert_points_near_breaks_to_pd. present_pseudo_time: present pseudo-time [s], to whose positions rigid
 * bodies are moved back. Returns true if positions were examined; does nothing and returns false if no rigid body can
 * touch a material point. */
bool load_step_flag_points_near_contact_to_convert(struct run *run, real present_pseudo_time,
                                                   real rigid_body_pseudo_time);

/* Converts material points near broken bonds to peridynamic particles between load steps (static equilibria), at fixed
 * positions. run: run; broken_bond_count: number of bonds broken since the last call, each counted once for each of its
 * particles. Returns true if points have been converted. */
bool load_step_convert_points_near_breaks_to_pd(struct run *run, int64_t broken_bond_count);

/* Computes the internal forces of the run at the current positions without moving anything: forces of bonds in
 * run->part.f, and forces of mesh cells, and of bonds to material points of the mesh, in the nodal forces of the mesh.
 * Material points of the mesh that have bonds, and mirror images of particles, are first brought to their current
 * positions. Bonds stretched beyond their limit break. */
void run_compute_internal_forces(struct run *run);

/* Brings positions, velocities and stresses of all particles of the run up to date, as frames need them: points of a
 * mesh from its nodes, stresses of peridynamic particles from their bonds. */
void run_update_particle_motion_and_stress(struct run *run);

/* Computes the critical time step of the run, and sets the time step dt and the number of steps in run->clock. Returns
 * REFUSED if time.step of the scene is too long for coarse cells, or if the run would have more than 1e12 steps. */
status run_choose_time_step_and_step_count(struct run *run);

/* Returns a read-only view of the run, from which probes read. All pointers of the view refer to data of the run;
 * nothing has to be freed. */
struct observed_run observed_run_make_read_only_view(const struct run *run);

#endif
