/* Output of the step loop: samples, frames, checkpoints, progress. */
#ifndef CLEAVE_ENGINE_REPORT
#define CLEAVE_ENGINE_REPORT

#include "engine/engine.h"

/* Before the first step of this process: history file, frame 0, first checkpoint; a restart has the last two
 * already. */
status engine_report_start(struct engine *e);

/* A sample describes t_n. `begin`, before the step: positions, damage, and velocities half a step behind (of t = 0 in
 * the first). `energy`, between forces and motion: energies at the positions of t_n. `end`: the kinetic energy between
 * the velocities before and after, the work up to t_n, and the line of history.csv. */
void engine_sample_begin(struct engine *e);
void engine_sample_energy(struct engine *e);
void engine_sample_end(struct engine *e);

/* Stress of peridynamic particles, which steps do not compute: for samples, frames and reversion. */
void engine_stress(struct engine *e);
/* Positions, velocities and stresses of all particles, up to date for a frame. */
void engine_sync(struct engine *e);

/* A sample of a body at rest on which nothing has done work. */
void engine_sample_rest(struct engine *e);

/* Records broken bonds (`broken`: their number in this step) and calls the probes of breaks. */
void engine_breaks(struct engine *e, int64_t broken);

/* Largest nodal force of the first step, for patch probes. Called between the first map and the motion of the nodes; in
 * a body without material points it uses the particles only. */
void engine_residual(struct engine *e);
/* Largest force on the nodes of grid g in the first step, for patch probes. */
void engine_residual_of(struct engine *e, const struct grid *g);

/* Profiles of probes (engine_profiles.c). write: with the frame just written; check: a warning of profiles that a
 * resumed run lacks; remove: those of an older run, before a run that replaces it. */
status engine_profiles_write(struct engine *e);
void engine_profiles_check(struct engine *e);
void engine_profiles_remove(struct engine *e);

/* After every step: frame, checkpoint and progress line if due; INTERRUPTED after a checkpoint if a signal came. */
status engine_report(struct engine *e);
status engine_report_end(struct engine *e);

#endif
