/* Room `step`: one time step, samples, reports and stability checks. It calls all parts of a run except load steps;
 * load steps and the engine call it. */
#ifndef CLEAVE_STEP
#define CLEAVE_STEP

#include "probes/probes.h"
#include "run/run.h"

/* Makes one time step. Returns FAILED if material points have left the background grid and diverged. */
status step(struct run *e);

/* Converts material points to peridynamic particles between load steps, without motion. broken: directed bonds
 * broken since the last call. Returns true if points have converted. */
bool step_convert(struct run *e, int64_t broken);

/* Computes the internal forces at the present positions, without motion: of bonds into part.f, of bonds and cells
 * into the forces of mesh nodes. Points of the mesh to which bonds reach, and mirror images, are synchronised first.
 * Bonds beyond their limit break. */
void run_forces(struct run *e);

/* Synchronises positions, velocities and stresses of all particles, as frames need them. */
void run_sync(struct run *e);

/* Chooses the time step and the number of steps. Returns REFUSED if time.step is too long for coarse cells, or the run
 * would have more than 1e12 steps. */
status time_step_make(struct run *e);

/* Returns the read-only view of a run that probes measure; all pointers borrow from the run. */
struct observed run_observed(const struct run *e);

#endif
