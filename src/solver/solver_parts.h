/* Functions shared by the static solvers. */
#ifndef CLEAVE_SOLVER_PARTS
#define CLEAVE_SOLVER_PARTS

#include "solver/solver.h"

/* Computes the bond forces at the present positions into part.f; bonds do not break. */
void solver_bond_force(const struct static_body *body);

/* Computes out = K in: the decrease of bond forces along `in` from the reference positions, by central differences.
 * strain_ratio: largest strain of `in` over its largest component [1/m]. */
void solver_tangent(const struct static_body *body, const struct field *in, struct field *out, real strain_ratio);

/* Computes the norms of part.f on free components, norm[0], and on constrained ones, norm[1] [N]. */
void solver_norms(const struct solver *s, const struct particles *p, real *norm);

/* Computes residual and scale from part.f: the residual, and the reactions. */
void solver_measure(struct solver *s, const struct particles *p);

#endif
