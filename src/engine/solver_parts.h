/* floor 5: what the static solvers share. */
#ifndef CLEAVE_SOLVER_PARTS_H
#define CLEAVE_SOLVER_PARTS_H

#include "engine/engine.h"

/* One step; `done` when the residual is small enough. */
typedef status solver_step_fn(struct engine *e, bool *done);
solver_step_fn relaxation_step, cg_step, grid_relaxation_step;

/* Forces of bonds at the positions that are there, into part.f. */
void solver_bond_force(struct engine *e);

/* Largest |entry|. */
real solver_largest(const struct field *v, int dim, int64_t n);

/* out = K in: what the forces of bonds lose from the reference positions along `in`. */
void solver_tangent(struct engine *e, const struct field *in, struct field *out, real strain_ratio);

/* Norms of part.f on free components (as residual) and on held ones: sets residual and scale. */
void solver_measure(struct engine *e);
/* The same from the norms [N]. */
void solver_scale(struct solver *s, real reaction, real left);


/* How long loads grow: on the grid whole steps in which a wave crosses the body twice. */
void grid_relaxation_make(struct engine *e);

#endif
