/* The solver of a body at rest, as a part of a run. */
#include "solver/solver.h"
#include "run/part.h"

static void solver_free_all(struct run *e) { solver_free(e->solver); }

const struct part part_solver = {PART(solver, solver), .free = solver_free_all};
