/* The unknowns of load steps (struct statics): displacements of the peridynamic particles, then of the mesh nodes that
 * have mass. */
#ifndef CLEAVE_UNKNOWNS
#define CLEAVE_UNKNOWNS

#include "data/mesh.h"
#include "loads/loads.h"
#include "quasistatic/statics.h"

struct contact;

/* Lists the unknowns with their weights, the boundaries that prescribe their components, and their present
 * displacements; allocates the fields of the balance, whose member `length` the caller has set. Release with
 * unknowns_unlist. */
void unknowns_list(struct statics *s, const struct particles *p, const struct mesh *mesh, const struct loads *loads);

/* Frees the lists and fields that unknowns_list has allocated. */
void unknowns_unlist(struct statics *s);

/* Stores the reference position of unknown k in X [m]. */
void unknown_position(const struct statics *s, const struct particles *p, const struct mesh *mesh, int64_t k, real *X);

/* Moves particles, nodes and the mirror images of nodes to the displacements u[unknowns] [m]. */
void unknowns_move(const struct statics *s, struct particles *p, struct mesh *mesh, const struct field *u);

/* Stores the signs with which the displacement components of image i follow those of its source particle (image_root);
 * +1 for a particle of the body. */
void image_signs(const struct particles *p, const struct loads *loads, int64_t i, real sign[DIM_MAX]);

/* Stores the applied forces at pseudo-time t [s] in `applied` [dim][particles of the body, N]. */
void applied_forces_make(struct statics *s, const struct particles *p, const struct loads *loads, real t);

/* Returns the norm of the applied forces on free components of particles and on points of the mesh that no boundary
 * drives, and of the contact forces of rigid bodies [N]. */
real applied_forces_norm(const struct statics *s, const struct particles *p, const struct contact *c);

/* Stores reactions and mean displacements of supports, and sums of applied forces, at the present equilibrium. */
void reactions_store(const struct statics *s, const struct particles *p, struct loads *loads);

#endif
