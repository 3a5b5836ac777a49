/* floor 5: what the step loop tells the world: samples, frames, checkpoints, progress. */
#ifndef CLEAVE_ENGINE_REPORT_H
#define CLEAVE_ENGINE_REPORT_H

#include "engine/engine.h"

/* Before the first step of this process: history file, frame 0, first checkpoint (a restart finds them there). */
status engine_report_start(struct engine *e);

/* A sample describes t_n. `begin`, before the step: positions, damage, and velocities half a step behind (of t = 0 in
 * the first). `energy`, between forces and motion: energies at the positions of t_n. `end`: the kinetic energy between
 * the velocities before and after, the work up to t_n, and the line of history.csv. */
void engine_sample_begin(struct engine *e);
void engine_sample_energy(struct engine *e);
void engine_sample_end(struct engine *e);

/* Stress of peridynamic particles, which is made only where somebody looks. */
void engine_stress(struct engine *e);

/* A sample of a body at rest on which nothing has done work. */
void engine_sample_rest(struct engine *e);

/* Books broken bonds: the run's first break, and the probes that watch. */
void engine_breaks(struct engine *e, int64_t broken);

/* Largest nodal force of the first step, for patch probes. Called between the first map and the motion of the nodes; in
 * a body without material points it looks at the particles only. */
void engine_residual(struct engine *e);
/* The same of the nodes of one grid. */
void engine_residual_of(struct engine *e, const struct grid *g);

/* Profiles of probes (engine_profiles.c): those of the frame just written; a warning that names what a run that goes on misses of
 * its own; and, before a run that replaces one, those of its probes away. */
status engine_profiles_write(struct engine *e);
void engine_profiles_check(struct engine *e);
void engine_profiles_remove(struct engine *e);

/* After every step: frame, checkpoint and progress line if due; INTERRUPTED after a checkpoint if asked to stop. */
status engine_report(struct engine *e);
status engine_report_end(struct engine *e);

#endif
