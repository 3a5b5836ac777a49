/* Functions shared by the static solvers. */
#ifndef CLEAVE_SOLVER_PARTS
#define CLEAVE_SOLVER_PARTS

#include "solver/solver.h"

/* Computes the bond forces at the present positions of the particles into body->part->f [N], after an update of the
 * mirror images. No bond breaks. */
void static_body_compute_bond_forces(const struct static_body *body);

/* Computes out = K in, the product of the tangent stiffness K of the bonds at the reference positions with the
 * displacements `displacement` [N]. It is the decrease of the bond forces along `displacement`, by central differences.
 * displacement: a vector for each particle [m]; strain_ratio: largest strain that `displacement` causes over its
 * largest component [1/m]. Overwrites positions and forces of the particles. */
void static_body_compute_tangent_product(const struct static_body *body, const struct field *displacement,
                                         struct field *force, real strain_ratio);

/* Computes the Euclidean norms of the forces p->f [N]: norm[0] over free components, norm[1] over constrained
 * components, those with prescribed displacement. */
void static_solver_compute_force_norms(const struct static_solver *s, const struct particles *p, real *norm);

/* Computes the residual of a static solution and the force scale to which it refers, from the forces p->f
 * (static_solver_set_residual). The norm over free components is the residual force, that over constrained components
 * the reaction. */
void static_solver_compute_residual(struct static_solver *s, const struct particles *p);

#endif
