/* Solvers of static problems, as commands and the engine call them. */
#ifndef CLEAVE_LOAD_STEPS
#define CLEAVE_LOAD_STEPS

#include "run/run.h"

struct sif_plane;
struct statics;

/* Finds the equilibrium of bonds or of a grid (`solver: cg, relaxation`) and ends the run. Returns FAILED if it is not
 * found, INTERRUPTED as engine_run does. */
status engine_solve(struct run *e);

/* Makes load steps to the end of the scene (`solver: static` with `steps`). Returns FAILED if there is no equilibrium,
 * INTERRUPTED as engine_run does. */
status engine_steps(struct run *e);

/* Initialises the solver of engine_solve. Returns REFUSED for loads without equilibrium. */
status engine_solver_make(struct run *e);

/* Returns REFUSED for scenes with bodies or loads that load steps do not support. */
status statics_check(const struct run *e);

/* Finds the equilibrium at load time t [s] for an estimate of cost. No load step can follow. Returns FAILED if there is
 * none. */
status engine_equilibrium_try(struct run *e, real t);

/* Computes the largest ratio of stretch to critical stretch of the whole run, if no bond broke, and stores it in *ratio
 * [1] and its load time in *at [s]. Loads that grow in proportion are scaled from the present equilibrium; where loads
 * turn back or others join them, the equilibria are computed. first: load time of the preceding engine_equilibrium_try
 * [s]. Returns FAILED if an equilibrium is not found. */
status engine_stretch_ratio_worst(struct run *e, real first, real *at, real *ratio);

/* Returns the load size at pseudo-time t [s]: the root of the sum of squares of the prescribed displacements of
 * particles and rigid bodies [m] or, if all of them are 0, of the applied forces [N]. */
real statics_load_size(const struct run *e, real t);

/* Returns the reason why the growth direction of cracks does not follow from their stress-intensity factors
 * (`steps.path`), or NULL if it does; then stores the plane of the tips in *plane (may be NULL). */
const char *sif_fault(const struct run *e, struct sif_plane *plane);

/* Returns REFUSED if a scene in space requires SIF-driven cracks (`steps.path: hoop`) and they are not possible. */
status sif_check(const struct run *e);

/* Saves or restores the state between two load steps; for a trial, the equilibrium alone. Returns the status of the
 * archive. */
status statics_archive(struct run *e, struct archive *a);

/* Frees the storage of the equilibrium solver. The SIF-driven cracks stay (sif_cracks_free). */
void statics_free(struct statics *s);

#endif
