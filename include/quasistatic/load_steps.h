/* Solvers of static problems, as commands and the engine call them. */
#ifndef CLEAVE_LOAD_STEPS
#define CLEAVE_LOAD_STEPS

#include "run/run.h"

struct crack_tip_plane;
struct statics;

/* Finds the static equilibrium of a scene without load steps, of bonds by conjugate gradients (`solver: cg`) or of a
 * grid by damped time steps (`solver: relaxation`), and completes the run. Returns FAILED if no equilibrium is found
 * or a file cannot be written, INTERRUPTED, after a checkpoint, if the run is to stop. */
status run_solve_single_equilibrium(struct run *run);

/* Computes the load steps of the scene of the run (`solver: static` with `steps`; a sequence of equilibria under
 * changing loads), from the present step to the last. Returns FAILED if an equilibrium is not found or a file cannot be
 * written, INTERRUPTED, after a checkpoint, if the run is to stop. */
status run_solve_load_steps(struct run *run);

/* Initialises run->solver, with which run_solve_single_equilibrium finds one static equilibrium under the loads at the
 * end of the scene's duration. Returns REFUSED, with a message, if forces or moments are neither balanced nor carried
 * by supports. Released by run_free_memory. */
status run_make_single_equilibrium_solver(struct run *run);

/* Checks that the solver of load steps (sequences of static equilibria) can treat the bodies, loads and supports of the
 * scene of the run. Returns REFUSED, with the reason, if it cannot. */
status load_steps_check_scene_is_supported(const struct run *run);

/* Finds the equilibrium under the loads at time t [s], from which `cleave check` estimates the cost of a run. The run
 * cannot be continued with load steps afterwards. Returns FAILED, with a message, if no equilibrium is found. */
status run_find_equilibrium_for_cost_estimate(struct run *run, real t);

/* Computes the largest ratio of bond stretch to critical stretch that the whole run would reach if no bond broke.
 * *ratio receives the ratio [1], *load_time the time of the loads at which it is reached [s]. The run must be in the
 * equilibrium that run_find_equilibrium_for_cost_estimate found for the time first_load_time [s]. If all loads grow
 * in proportion, its stretches are scaled; if loads reverse or others begin later, further equilibria are computed.
 * Returns FAILED, with a message, if one of them is not found. */
status run_predict_largest_ratio_to_critical_stretch(struct run *run, real first_load_time, real *load_time,
                                                     real *ratio);

/* Returns the load size of the run at pseudo-time t [s], a measure that is proportional to the loads: the root of the
 * sum of squares of all prescribed displacements of particles and rigid bodies [m] or, if all of these are 0, of all
 * applied forces [N]. */
real statics_norm_of_prescribed_loads(const struct run *run, real t);

/* Returns the reason (a static text) why the growth direction of the cracks of the run is not determined from their
 * stress-intensity factors, or NULL if it is. The key `steps.path` of the scene may be a reason. plane: receives the
 * plane in which the crack tips move, valid only if NULL is returned; may be NULL if the caller does not need it. */
const char *sif_growth_reason_direction_is_undetermined(const struct run *run, struct crack_tip_plane *plane);

/* Checks the scene of the run, if it is three-dimensional and demands crack growth by stress-intensity factors
 * (`steps.path: hoop`). Returns REFUSED, with the reason, if the growth direction cannot be determined from them.
 * Returns OK for other scenes. */
status sif_growth_check_direction_is_determinable(const struct run *run);

/* Saves the state of the run between two load steps (static equilibria) to the archive `a` (checkpoint file or memory)
 * if a->saving is set, else restores it from `a`. If a->scope is ARCHIVE_TRIAL, only the state that a trial equilibrium
 * changes is saved or restored. Returns FAILED if an entry is missing or has another size. */
status load_steps_save_or_load_state(struct run *run, struct archive *a);

/* Frees the arrays in s: system of equations, preconditioner, saved plastic state and bonds of the next crack
 * increment. The state of cracks driven by stress-intensity factors (s->sif) remains; sif_cracks_free frees it. */
void statics_free(struct statics *s);

#endif
