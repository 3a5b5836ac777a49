/* floor 5: what the step loop tells the world: samples, frames, checkpoints, progress. */
#ifndef CLEAVE_ENGINE_REPORT_H
#define CLEAVE_ENGINE_REPORT_H

#include "engine.h"

/* Before the first step of this process: history file, frame 0, first checkpoint (a restart finds them there). */
status engine_report_start(struct engine *e);

/* A sample describes t_n: energies at the positions of step n's forces, kinetic energy as the mean of before and after
 * the velocity update. `begin` stands between forces and motion, `end` after conversion. */
void engine_sample_begin(struct engine *e);
void engine_sample_end(struct engine *e);

/* Books broken bonds: the run's first break, and the probes that watch. */
void engine_breaks(struct engine *e, int64_t broken);

/* Largest nodal force of the first step, for patch probes. Called between the first map and the motion of the nodes. */
void engine_residual(struct engine *e);

/* After every step: frame, checkpoint and progress line if due; INTERRUPTED after a checkpoint if asked to stop. */
status engine_report(struct engine *e);
status engine_report_end(struct engine *e);

#endif
