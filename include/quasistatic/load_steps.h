/* Load steps and other solvers that are not explicit, as commands and the engine call them. */
#ifndef CLEAVE_LOAD_STEPS
#define CLEAVE_LOAD_STEPS

#include "run/run.h"

/* Runs to the end of the scene with a solver of equilibrium, in load steps. INTERRUPTED as engine_run. */
status engine_solve(struct run *e);
status engine_steps(struct run *e);
/* Makes what a solver of equilibrium needs. */
status engine_solver_make(struct run *e);
/* REFUSED for bodies that load steps do not know. */
status statics_check(const struct run *e);
/* The first equilibrium, for an estimate of cost: the run has then taken no load step, and cannot. */
status engine_equilibrium_try(struct run *e, real t);
/* After that equilibrium at load time `first`: how near the most stretched bond comes to its limit if none breaks, its
 * stretch over the limit, *overload, at the load time *at [s] at which loads are worst. Loads in proportion are scaled;
 * where they turn back or others join them, the equilibria are sought: FAILED where there is none. */
status engine_overload_worst(struct run *e, real first, real *at, real *overload);
/* Size of what loads and supports prescribe at a load time, which scales as they do. */
real engine_load_size(const struct run *e, real t);
/* Why the tips of pre-cracks are not led in load steps (steps.path); NULL: they are, if there are any. */
const char *engine_led_fault(const struct run *e);
/* REFUSED where a scene in space asks for tips to be led that cannot be. */
status led_check(const struct run *e);
/* Saves or restores the state between two load steps; in a trial, the equilibrium alone. */
status statics_archive(struct run *e, struct archive *a);
/* Energy per area that a crack takes: of bonds at their limits, or of state-based models G_c as given [J/m^2]. */
real toughness_of(const struct run *e, const struct material *m);
/* Frees what equilibrium works on. */
void statics_free(struct run *e);

#endif
