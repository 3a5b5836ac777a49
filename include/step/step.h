/* Room `step`: one step in time, its samples, reports, checks of stability. It knows every part but load steps; those
 * and the engine call it. */
#ifndef CLEAVE_STEP
#define CLEAVE_STEP

#include "probes/probes.h"
#include "run/run.h"

/* One step in time. FAILED where material points have left every grid. */
status step(struct run *e);
/* Conversion between load steps, a step without motion, after so many directed bonds have broken; true if particles
 * have converted. */
bool step_convert(struct run *e, int64_t broken);
/* Internal forces at the present positions, those of the nodes of a mesh first of all: of bonds into part.f, of bonds
 * and cells into the mesh's nodes. Points of the mesh to which bonds reach, and images, are brought up to date. The
 * same parts as in a step, without any motion; bonds beyond their limit break. */
void run_forces(struct run *e);
/* Positions, velocities and stresses of all particles, up to date for a frame. */
void run_sync(struct run *e);
/* The time step and the number of steps. REFUSED for a step that coarse cells do not bear. */
status time_step_make(struct run *e);
/* What probes may look at, read only. */
struct observed run_observed(const struct run *e);

#endif
