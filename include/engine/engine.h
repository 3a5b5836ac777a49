/* Room `engine`: a run as a whole: set-up, loop, checkpoints, warnings, summary. It knows every room below it; commands
 * and benches call it. */
#ifndef CLEAVE_ENGINE
#define CLEAVE_ENGINE

#include "output/output.h"
#include "run/critical_step.h"
#include "run/run.h"

/* Makes everything up to step 0: particles, cells, loads, bonds, grid, time step. `out` may be NULL: no files. The
 * caller frees it, whatever is returned. REFUSED for what a scene asks for and cannot be. */
status engine_make(struct run *e, const struct scene *s, struct output *out);
void engine_free(struct run *e);
/* What a run of its lattice bodies takes at the most, about, before anything of it is made but materials and family
 * [byte]; the same for all particles of the body, as peridynamic ones. */
real run_memory(const struct scene *s, const struct particles *p, const struct bond_source *source);
real run_memory_peridynamic(const struct scene *s, const struct particles *p, const struct bond_source *source);
/* Runs to the end of the scene. INTERRUPTED after a checkpoint when a signal came. */
status engine_run(struct run *e);
/* One step in time, levels of cells before it. */
status engine_step(struct run *e);
/* Saves the state between two steps. run: a struct run. */
status engine_archive(void *run, struct archive *a);
/* Restores it, after engine_make of the same scene; prints on standard error where it was saved with other kernels.
 * FAILED if the archive is of another body or in no state that a run can have. run: a struct run. */
status engine_restore(void *run, struct archive *a);
/* After the run: the same scene on material points alone, if a pulse probe compares with it. */
status engine_baseline(struct run *e);
/* Everything about the scene that is allowed but probably not meant, into e->warnings. Call once, before the first
 * step. */
void engine_warn(struct run *e);
/* Writes summary.json of the run so far; s is its status, `threads` and `wall_seconds` as measured by the caller. */
status summary_write(const struct run *e, status s, int threads, double wall_seconds);

#endif
