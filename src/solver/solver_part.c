/* Registers the static solver with the engine: defines its callbacks (struct part in run/part.h). */
#include "solver/solver.h"
#include "run/part.h"

static void solver_free_all(struct run *run) { static_solver_free(run->solver); }

/* Writes the JSON object "solver" with name, steps and residual of a static solution to j; nothing for other runs. run:
 * the run. */
static void put_solver(const struct run *run, struct json *j)
{
    static const char *const name[] = {[SOLVER_RELAXATION] = "relaxation", [SOLVER_CG] = "cg"};
    if (!scene_is_single_equilibrium(run->scene)) return;
    json_begin_object_or_list(j, "solver", '{');
    json_write_text(j, "name", name[run->scene->solver]);
    json_write_integer(j, "steps", run->clock.step);
    json_write_real(j, "residual", run->solver->residual);
    json_write_integer(j, "bonds_past_limit", run->solver->past_limit);
    json_end_object_or_list(j, '}');
}

static status solver_state(struct run *run, struct archive *a) { return static_solver_save_or_load(run->solver, a); }

const struct part part_solver = {PART(solver, static_solver), .free = solver_free_all, .summary = put_solver,
                                 .state = solver_state};
