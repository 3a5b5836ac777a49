/* Declares functions that the static solvers share: forces, stiffness products and residuals. */
#ifndef CLEAVE_SOLVER_PARTS
#define CLEAVE_SOLVER_PARTS

#include "solver/solver.h"

/* Computes the bond forces at the present positions of the particles of `body` into body->part->f [N]. Moves the mirror
 * images (copies of particles beyond planes of symmetry) first. No bond breaks. */
void static_body_compute_bond_forces(const struct static_body *body);

/* Computes the product K u of the tangent stiffness K of the bonds of `body` at the reference positions with the
 * displacements u, as the decrease of the bond forces along u by central differences. displacement: u, a vector for
 * each particle [m]; force: receives K u, a vector for each particle [N]; strain_per_displacement: largest strain that
 * u causes, divided by the largest component of u [1/m]. Overwrites positions and forces of the particles. */
void static_body_compute_tangent_stiffness_product(const struct static_body *body, const struct field *displacement,
                                                   struct field *force, real strain_per_displacement);

/* Computes the Euclidean norms of the forces p->f of s [N]: norm[0] over free components, norm[1] over constrained
 * components, those with prescribed displacement. */
void static_solver_compute_free_and_fixed_force_norms(const struct static_solver *s, const struct particles *p,
                                                      real *norm);

/* Computes the residual s->residual of a static solution and the force s->scale to which it refers, from the forces
 * p->f, by static_solver_compute_relative_residual: the norm of the forces over free components is the unbalanced
 * force, the norm over constrained components (with prescribed displacement) the reaction. */
void static_solver_compute_residual(struct static_solver *s, const struct particles *p);

#endif
