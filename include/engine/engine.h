/* Room `engine`: a run as a whole: set-up, time loop, checkpoints, warnings, summary. It uses every room below;
 * commands and benches call it. */
#ifndef CLEAVE_ENGINE
#define CLEAVE_ENGINE

#include "output/output.h"
#include "run/critical_step.h"
#include "run/run.h"

/* Creates the state of a run at step 0: particles, cells, loads, bonds, grid, time step. out: opened by output_open,
 * borrowed; NULL: no files. REFUSED if the scene is invalid; FAILED if memory is exhausted or a file cannot be read.
 * Release e with engine_free whatever is returned. */
status engine_make(struct run *e, const struct scene *s, struct output *out);

/* Releases the memory of a run. */
void engine_free(struct run *e);

/* Estimates the peak memory of a run of the lattice bodies of a scene [byte]. p: their particles; source: materials and
 * families. Can be called before bonds and grids are allocated. */
real run_memory(const struct scene *s, const struct particles *p, const struct bond_source *source);

/* Estimates the peak memory as run_memory does if all particles of the bodies were peridynamic [byte]. */
real run_memory_peridynamic(const struct scene *s, const struct particles *p, const struct bond_source *source);

/* Runs to the end of the scene. Returns INTERRUPTED, after a checkpoint, when a signal was received; FAILED if the run
 * becomes unstable or output fails. */
status engine_run(struct run *e);

/* Performs one time step, preceded by changes of the cell levels. */
status engine_step(struct run *e);

/* Saves the state between two steps. run: struct run. */
status engine_archive(void *run, struct archive *a);

/* Restores the state into a run of the same scene that engine_make has created. Reports on standard error if it was
 * saved with another instruction set. FAILED if the archive belongs to another body or is inconsistent. run: struct
 * run. */
status engine_restore(void *run, struct archive *a);

/* Repeats the scene on material points alone if it has a PULSE probe, which compares the two runs. Call after the run.
 */
status engine_baseline(struct run *e);

/* Checks the scene for what is allowed but probably unintended, and adds warnings to e->warnings. Call once, before the
 * first step. */
void engine_warn(struct run *e);

/* Writes summary.json for the steps done so far. s: status of the run; threads, wall_seconds: measured by the
 * caller. */
status summary_write(const struct run *e, status s, int threads, double wall_seconds);

#endif
