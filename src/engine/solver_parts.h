/* Functions that the static solvers share. */
#ifndef CLEAVE_SOLVER_PARTS
#define CLEAVE_SOLVER_PARTS

#include "engine/engine.h"

/* One step; `done` when the residual is small enough. */
typedef status solver_step_fn(struct engine *e, bool *done);
solver_step_fn relaxation_step, cg_step, grid_relaxation_step;

/* Forces of bonds at the current positions, into part.f. */
void solver_bond_force(struct engine *e);

/* Largest |entry|. */
real solver_largest(const struct field *v, int dim, int64_t n);

/* out = K in: the decrease of bond forces along `in` from the reference positions, by central differences.
 * strain_ratio: largest strain of `in` over its largest component [1/m]. */
void solver_tangent(struct engine *e, const struct field *in, struct field *out, real strain_ratio);

/* Residual and scale from the norms of part.f on free components (residual) and on constrained ones (reactions). */
void solver_measure(struct engine *e);
/* Residual and scale from the norms of reactions and of residual forces `left` [N]. */
void solver_scale(struct solver *s, real reaction, real left);


/* Sets ramp_time, in which loads grow: on the grid the whole steps in which a wave crosses the body twice. */
void grid_relaxation_make(struct engine *e);

#endif
