/* Declares the list of unknowns of load steps (struct statics): displacements of the peridynamic particles, followed by
 * those of the mesh nodes that have mass. */
#ifndef CLEAVE_UNKNOWNS
#define CLEAVE_UNKNOWNS

#include "data/mesh.h"
#include "loads/loads.h"
#include "quasistatic/statics.h"

struct contact;

/* Lists the particles of p and nodes of `mesh` whose displacements are unknown, with their weights (1, or 1/2 on planes
 * of symmetry, where half of a particle belongs to the body), the boundaries that prescribe their components and their
 * present displacements, and allocates the fields of s->balance. The caller has set s->balance.length, the distance
 * between neighbouring nodes. loads: boundaries. Release with unknowns_free. */
void unknowns_list_particles_and_nodes(struct statics *s, const struct particles *p, const struct mesh *mesh,
                                       const struct loads *loads);

/* Frees the lists and fields in *s that unknowns_list_particles_and_nodes has allocated. */
void unknowns_free(struct statics *s);

/* Stores the reference position of a particle of p or a node of `mesh`, entry `unknown_number` in the list s of unknown
 * displacements, in position[dim] [m]. */
void unknown_compute_reference_position(const struct statics *s, const struct particles *p, const struct mesh *mesh,
                                        int64_t unknown_number, real *position);

/* Sets the positions of the particles p, the nodes of `mesh` and the mirror images of nodes (beyond planes of symmetry)
 * to their reference positions plus the displacements `displacement` [m]. s: list of these particles and nodes. */
void unknowns_apply_displacements(const struct statics *s, struct particles *p, struct mesh *mesh,
                                  const struct field *displacement);

/* Stores in sign[d] the factor, +1 or -1, between component d of the displacement of the mirror image `image` (an index
 * of the arrays of p) and that of the particle that it mirrors. All factors are +1 if `image` is a particle of the
 * body. loads: planes of symmetry. */
void mirror_image_compute_displacement_signs(const struct particles *p, const struct loads *loads, int64_t image,
                                             real sign[DIM_MAX]);

/* Computes the applied forces of `loads` at the pseudo-time `pseudo_time` [s] and stores them in s->applied, dim
 * components for each particle of p [N]. Allocates these arrays on the first call. */
void applied_forces_compute(struct statics *s, const struct particles *p, const struct loads *loads, real pseudo_time);

/* Returns the Euclidean norm [N] of all applied forces in s (state of the load steps, i.e. static equilibria) on
 * components of displacement that no boundary prescribes, and of the contact forces of rigid bodies. p: particles;
 * loads: the supports of the body. */
real applied_forces_norm(const struct statics *s, const struct particles *p, const struct loads *loads,
                         const struct contact *contact);

/* Computes the reactions and mean displacements (of particles p) of the supports and the sums of applied forces in the
 * present equilibrium of s, the state of the load steps, and stores them in *loads. */
void reactions_compute_and_store(const struct statics *s, const struct particles *p, struct loads *loads);

#endif
