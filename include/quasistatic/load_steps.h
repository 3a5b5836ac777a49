/* Load steps and other solvers that are not explicit, as commands and the engine call them. */
#ifndef CLEAVE_LOAD_STEPS
#define CLEAVE_LOAD_STEPS

#include "run/run.h"

struct led_plane;
struct statics;

/* Solves for the equilibrium of bonds or of a grid (`solver: cg, relaxation`) and ends the run. Returns INTERRUPTED as
 * engine_run does. */
status engine_solve(struct run *e);

/* Takes load steps to the end of the scene (`solver: static` with `steps`). Returns INTERRUPTED as engine_run does, and
 * FAILED if there is no equilibrium. */
status engine_steps(struct run *e);

/* Makes what the solver of engine_solve works on. Returns REFUSED for loads without equilibrium. */
status engine_solver_make(struct run *e);

/* Returns REFUSED for scenes whose bodies or loads load steps cannot treat. */
status statics_check(const struct run *e);

/* Finds the equilibrium at load time t [s], for an estimate of cost. No load step can follow. */
status engine_equilibrium_try(struct run *e, real t);

/* After engine_equilibrium_try at load time `first` [s]: stores the largest ratio of stretch to critical stretch of the
 * whole run, if no bond broke, in *overload [1], and its load time in *at [s]. Loads that grow in proportion are
 * scaled; where loads turn back or others join them, the equilibria are found. Returns FAILED where there is none. */
status engine_overload_worst(struct run *e, real first, real *at, real *overload);

/* Returns the size of the loads at pseudo-time t [s]: root of the sum of squares of prescribed displacements [m] or, if
 * all of them are 0, of applied forces [N]. */
real statics_load_size(const struct run *e, real t);

/* Returns why the tips of pre-cracks do not follow their stress-intensity factors (steps.path), or NULL if they do;
 * then *plane is the plane in which they move. */
const char *led_fault(const struct run *e, struct led_plane *plane);

/* Returns REFUSED where a scene in space asks for tips that follow their factors, and they cannot. */
status led_check(const struct run *e);

/* Saves or restores the state between two load steps; in a trial, the equilibrium alone. */
status statics_archive(struct run *e, struct archive *a);

/* Frees what equilibrium works on; the tips stay (led_free). */
void statics_free(struct statics *s);

#endif
