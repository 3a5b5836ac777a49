/* Functions that the static solvers share. */
#ifndef CLEAVE_SOLVER_PARTS
#define CLEAVE_SOLVER_PARTS

#include "solver/solver.h"

/* Forces of bonds at the current positions, into part.f. */
void solver_bond_force(const struct static_body *body);

/* out = K in: the decrease of bond forces along `in` from the reference positions, by central differences.
 * strain_ratio: largest strain of `in` over its largest component [1/m]. */
void solver_tangent(const struct static_body *body, const struct field *in, struct field *out, real strain_ratio);

/* Norms of part.f on free components, sum[0], and on constrained ones, sum[1] [N]. */
void solver_norms(const struct solver *s, const struct particles *p, real *norm);

/* Residual and scale from these norms: the residual, and the reactions. */
void solver_measure(struct solver *s, const struct particles *p);

#endif
