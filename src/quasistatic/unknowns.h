/* The unknowns of load steps (struct statics): peridynamic particles, then nodes of the mesh that move. */
#ifndef CLEAVE_UNKNOWNS
#define CLEAVE_UNKNOWNS

#include "quasistatic/statics.h"
#include "run/run.h"

/* Lists the unknowns with their weights, the boundaries that hold components of them, and their present displacements.
 * Allocates the fields of the balance. */
void unknowns_list(struct run *e);

/* Frees what unknowns_list has allocated. */
void unknowns_unlist(struct run *e);

/* Stores the reference position of unknown k in X [m]. */
void statics_node_place(const struct run *e, int64_t k, real *X);

/* Moves particles, nodes and the mirror images of nodes to the displacements u [unknowns, m]. */
void statics_place(struct run *e, const struct field *u);

/* Stores the signs by which the components of an image's motion follow those of its source particle (image_root); +1
 * for a particle that is no image. */
void statics_image_signs(const struct run *e, int64_t i, real sign[DIM_MAX]);

/* Computes the applied forces at pseudo-time t [s] as the forces that act. */
void statics_applied_make(struct run *e, real t);

/* Returns the norm of the applied forces on free components, and of the forces of rigid bodies [N]. */
real statics_applied_norm(const struct run *e);

/* Stores reactions and mean displacements of supports, and sums of applied forces, at the present equilibrium. */
void statics_react(struct run *e);

#endif
