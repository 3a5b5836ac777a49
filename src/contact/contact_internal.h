/* Declarations shared by the files of src/contact. "Row" is the position of a particle in the contact list c->particle,
 * the particles that may come into contact. The form `surface` of the contact law determines the gap to a smooth face
 * from the density of the particles of that face; the form `pair` from the distance of two particles. */
#ifndef CLEAVE_CONTACT_INTERNAL
#define CLEAVE_CONTACT_INTERNAL

#include "contact/contact.h"

/* Lengths of contact. The list of pairs extends beyond the contact distance by a margin, which is larger for
 * equilibrium solutions, because their corrections move particles farther. */
#define CONTACT_REACH 2.0 /* range within which a particle contributes to the density of a face [mean spacings] */
#define CONTACT_SKIN 0.3  /* margin of the list of pairs beyond the contact distance [spacings] */
#define STATIC_SKIN 1.5   /* the same margin in equilibrium solutions [spacings] */
#define FAR_LAMMPS                                                                                                     \
    1.35                /* rule of LAMMPS: contact distance of a pair is the smaller of this [mean spacings] and ...   \
                         */
#define NEAR_LAMMPS 0.9 /* ... this times the distance of the pair in the reference configuration [1] */
/* Factor by which a gap can shrink more than the largest displacement of a particle [1]: 2 because both faces move,
 * plus a margin for the curvature of the density field. */
#define CONTACT_FLATNESS 3

/* State of a row (a particle of the contact list) until the next search. ROW_FAR: too far from all faces. ROW_NEAR:
 * near a face, but it and its neighbours in the list are at rest. ROW_SOURCE: neighbour of an active row, whose contact
 * force acts on it. ROW_ACTIVE: its own contact is evaluated. */
enum row_state { ROW_FAR, ROW_NEAR, ROW_SOURCE, ROW_ACTIVE };

/* Summary of the contacts of a step. touching: number of contacts; overlap: largest overlap [m]; deepest: index of the
 * particle with the largest overlap. */
struct contact_summary {
    real overlap;
    int64_t touching;
    int32_t deepest;
};

/* Adds one contact of particle `particle` to *summary, the summary of the contacts of a step: counts the contact, and
 * stores overlap and particle if `overlap` [m] is the largest so far. Of equal overlaps the particle with the lowest
 * index is stored. */
static inline void contact_summary_add_overlap(struct contact_summary *summary, real overlap, int32_t particle)
{
    const bool first = overlap == summary->overlap && particle < summary->deepest;
    if (overlap > summary->overlap || first) summary->overlap = overlap, summary->deepest = particle;
    summary->touching++;
}

/* Computes vector[dim] [m], the vector from the present position of entry `other_list_index` of the contact list of c
 * (particles of p that may come into contact) to that of entry `list_index`. Returns its square [m^2]. */
static inline real contact_pair_vector_and_squared_distance(const struct contact *c, const struct particles *p,
                                                            int64_t list_index, int64_t other_list_index, real *vector)
{
    const int32_t i = c->particle[list_index], j = c->particle[other_list_index];
    real r2 = 0;
    for (int d = 0; d < p->dim; d++) {
        vector[d] = p->x[d][i] - p->x[d][j];
        r2 += square(vector[d]);
    }
    return r2;
}

/* Returns the contact stiffness k [N/m] of the pair of entries `list_index` and `other_list_index` of the contact list
 * c->particle (particles that may come into contact), from the materials and volumes of both particles in p. */
static inline real contact_pair_stiffness(const struct contact *c, const struct particles *p, int64_t list_index,
                                          int64_t other_list_index)
{
    const int32_t i = c->particle[list_index], j = c->particle[other_list_index];
    return c->law.stiffness[p->material[i] * c->law.materials + p->material[j]] * (p->volume0[i] * p->volume0[j]);
}

/* Returns true if contact is possible in the run of c: between particles or with rigid bodies. */
static inline bool contact_is_enabled(const struct contact *c)
{
    return c->law.between != CONTACT_NONE || c->rigids > 0;
}

/* Returns true if contact forces may act in this step on the particle of row `list_index` of the contact list of c
 * (particles that may come into contact). They do not act on particles that are at rest together with their neighbours,
 * nor on particles far from all faces (contact_activate_newly_moving_particles). */
static inline bool contact_list_particle_may_receive_force(const struct contact *c, int64_t list_index)
{
    return c->followed[list_index] >= ROW_SOURCE;
}

/* Includes particles in the computation of contact that were skipped because they and all their neighbours were at
 * rest, if a neighbour now moves. For these particles of p (rows of the contact list of c), marks in `loads` that
 * forces act on them, and in b that the forces of their bonds are computed. Call it in steps without a search for pairs
 * of particles. */
void contact_activate_newly_moving_particles(struct contact *c, const struct particles *p, struct bonds *b,
                                             struct loads *loads);

/* Returns the array of bytes that selects which contacts between particles act in an equilibrium
 * (contact_select_linear_springs_and_count_changes): one per particle of the contact list of c (particles that may come
 * into contact) for the contact law of form `surface` (forces of smooth faces), one per pair of particles for the form
 * `pair`. The array belongs to c. Returns NULL if exactly the overlapping contacts act. */
static inline const uint8_t *contact_active_set_flags(const struct contact *c)
{
    return c->by_overlap ? NULL : c->touch;
}

/* Returns the array of bytes that selects which contacts with rigid body number `body` act in an equilibrium
 * (contact_select_linear_springs_and_count_changes), one per particle in the list c->near of this body. The array
 * belongs to c. Returns NULL if exactly the overlapping contacts act. */
static inline const uint8_t *contact_rigid_body_active_set_flags(const struct contact *c, int body)
{
    return c->by_overlap ? NULL : c->near[body].touch;
}

/* Returns true if contact number `contact_number` acts. active_set_flags: an array with a byte for each contact, not 0
 * if the contact acts; NULL if exactly the overlapping contacts act. overlaps: true if this contact overlaps. */
static inline bool contact_is_in_active_set(const uint8_t *active_set_flags, int64_t contact_number, bool overlaps)
{
    return active_set_flags ? active_set_flags[contact_number] != 0 : overlaps;
}

/* Returns the gap [spacings] between the particle of row `list_index` of the contact list of c (particles of p that may
 * come into contact) and the nearby faces of other bodies or fragments, negative if they overlap. Only for laws of the
 * form `surface`, in which faces are smooth. */
real contact_face_gap_of_particle(const struct contact *c, const struct particles *p, int64_t list_index);

/* Returns the gap [m] of pair number `pair` of particles of p in the contact c: the distance of its two particles minus
 * the distance at which their contact begins; negative if they overlap. list_index: row of the contact list (particles
 * that may come into contact) to which the pair belongs. */
real contact_pair_gap(const struct contact *c, const struct particles *p, int64_t list_index, int64_t pair);

/* Returns the gap [m] between a particle of p and rigid body number `body_number` of c: their distance minus the
 * distance at which contact begins; negative if they overlap. near_list_index: entry of the particle in the list near
 * this body; normal: receives the outward unit vector normal to the surface. */
real contact_rigid_gap_of_particle(const struct contact *c, const struct particles *p, int body_number,
                                   int64_t near_list_index, real *normal);

/* Describes the contact of the particle of row `list_index` of the contact list of c (particles of p that may come into
 * contact) with the faces beside it as a linear spring: stiffness, and derivatives of the gap by the positions of the
 * particles, in *term. Its arrays must have a capacity of one element more than the row has pairs. Only for laws of the
 * form `surface` (forces of smooth faces). */
void contact_face_linearise_as_spring(const struct contact *c, const struct particles *p, int64_t list_index,
                                      struct contact_term *term);

/* Enables contact forces on all particles of the contact list of c (particles that may come into contact), also on
 * particles at rest, which time steps leave out but equilibrium solutions require. */
void contact_enable_forces_on_all_listed_particles(struct contact *c);

/* Saves the selection of contacts of c that act in equilibria (contact_select_linear_springs_and_count_changes) to the
 * archive a if a->saving, else restores it. Returns FAILED if the archive cannot be read or written or a stored size
 * differs. */
status contact_active_set_save_or_load(struct contact *c, struct archive *a);

/* Returns the margin [m] by which the list of pairs of c extends beyond the contact distance. The list stays complete
 * while particles move by less than half the margin. */
static inline real contact_pair_list_margin(const struct contact *c)
{
    return (c->marked ? STATIC_SKIN : CONTACT_SKIN) * c->law.spacing;
}

/* Returns the entry of particle i in the contact list of c (particles that may come into contact), by bisection; -1 if
 * the particle is not in the list. */
int64_t contact_list_index_of_particle(const struct contact *c, int64_t particle);

/* Returns the width [m] of the widest notch (a pre-crack with a width) that separates the entries `list_index` and
 * `other_list_index` of the contact list of c (particles of p that may come into contact) in the reference
 * configuration; 0 if there is none or if the particles belong to different bodies. */
real contact_width_of_widest_notch_between_particles(const struct contact *c, const struct particles *p,
                                                     int64_t list_index, int64_t other_list_index);

/* Computes three arrays for all entries of the contact list (particles of p that may come into contact): c->root, for a
 * mirror image (copy beyond a plane of symmetry) the entry of its source particle, for other entries the entry itself;
 * c->size, the spacing of the particle [m]; c->rise, the height of the surface of the body above the particle, minus
 * 1/2 [spacings]. */
void contact_list_set_spacings_and_surface_heights(struct contact *c, const struct particles *p);

/* Adds the contact forces of all pairs of particle number `list_index` of the contact list of c (particles that may
 * come into contact) to p->f of this particle, by the contact law of form `pair` (forces between two particles each).
 * found: receives largest overlap and number of contacts. */
void contact_pair_add_forces_on_particle(const struct contact *c, struct particles *p, int64_t list_index,
                                         struct contact_summary *found);

/* Returns half the elastic energy [J] of all pairs of particle number `list_index` of the contact list of c (particles
 * of p that may come into contact), by the contact law of form `pair` (forces between two particles each); each pair
 * belongs to two particles. */
real contact_pair_half_energy_of_particle(const struct contact *c, const struct particles *p, int64_t list_index);

/* Returns the distance [m] at which contact of the entries `list_index` and `other_list_index` of the contact list of c
 * (particles of p that may come into contact) begins: the contact distance, reduced if the two particles are closer in
 * the reference configuration or at present. previous_onset_distance: contact distance on the previous list of pairs
 * [m], NAN if the pair was not on it. */
real contact_pair_onset_distance(const struct contact *c, const struct particles *p, int64_t list_index,
                                 int64_t other_list_index, real previous_onset_distance);

/* Computes `table` for a flat face, the outermost layer of a square or cubic lattice of particles: the height of a
 * point above this layer as a function of the density at the point, i.e. the number of particles of the layer nearby,
 * weighted by a kernel. dim: dimensions of space. */
void contact_profile_tabulate_height_above_flat_face(struct contact_profile *table, int dim);

/* Computes into c->face[list_index] the gap between the particle of row `list_index` of the contact list of c
 * (particles of p that may come into contact) and the faces beside it, and the derivatives of its contact energy. First
 * of two passes over the rows; contact_face_add_force_on_particle adds the forces. Only for laws of the form `surface`
 * (forces of smooth faces). dt: time since the last call [s]; found: receives largest overlap and number of
 * contacts. */
void contact_face_store_gap_and_energy_derivatives(struct contact *c, const struct particles *p, int64_t list_index,
                                                   real dt, struct contact_summary *found);

/* Adds the contact force on particle number `list_index` of the contact list of c (particles that may come into
 * contact) to p->f, by the contact law of form `surface` (forces of smooth faces). Second of two passes:
 * contact_face_store_gap_and_energy_derivatives must have been called for all particles of the list. */
void contact_face_add_force_on_particle(const struct contact *c, struct particles *p, int64_t list_index);

/* Returns the elastic contact energy [J] of particle number `list_index` of the contact list of c (particles of p that
 * may come into contact), by the contact law of form `surface` (forces of smooth faces). */
real contact_face_energy_of_particle(const struct contact *c, const struct particles *p, int64_t list_index);

/* Computes into c->face[list_index] the height above the face at which contact begins for the particle of row
 * `list_index` of a new contact list of c (particles of p that may come into contact). Only for laws of the form
 * `surface` (forces of smooth faces). previous_list_index: entry of the particle in the previous list `previous`, -1 if
 * it was not listed. If the particle was in contact on that list, the height is chosen so that its contact energy does
 * not change. */
void contact_face_set_height_where_contact_begins(struct contact *c, const struct contact *previous,
                                                  int64_t previous_list_index, const struct particles *p,
                                                  int64_t list_index);

/* Returns a correction of the contact force, in the unit of stiffness times gap, which removes the energy that
 * leap-frog integration adds when contact begins or ends; 0 if no energy is to be removed. The contact has the energy
 * 1/4 stiffness gap^2, gap < 0. gap: [m] or [spacings], stiffness: [N/m] or [J] accordingly. error_account: account of
 * this contact, updated if `step_was_made` is true, i.e. if a time step was made since the last call; otherwise the
 * last force is returned again. */
real contact_leapfrog_error_correction_force(struct contact_leapfrog_error_account *error_account, real stiffness,
                                             real gap, bool step_was_made);

/* Returns the initial account of a contact on a new list of pairs, i.e. the sum of the energy errors of leap-frog from
 * which contact_leapfrog_error_correction_force computes a correcting force. gap: present gap [m] or [spacings];
 * previous: account of the contact on the previous list, which is continued; NULL if the contact was not listed. */
struct contact_leapfrog_error_account
contact_leapfrog_error_carry_over_to_new_list(const struct contact_leapfrog_error_account *previous, real gap);

/* Contribution of particle l of a face to the density of the face at particle k (contact law of form `surface`).
 * weight: the contribution [1]; pull: derivative of the contact energy of k by the distance of k and l, divided by this
 * distance [N/m]; apart: vector from l to k [m]. */
struct contact_density_contribution {
    real weight, pull, apart[DIM_MAX];
};

/* Returns the contribution of entry `other_list_index` of the contact list of c (particles of p that may come into
 * contact) to the density at entry `list_index`, the number of particles of a face nearby, weighted by a kernel.
 * time_before_present: positions are those this time [s] before the present one, x - v t, with present positions x and
 * velocities v. The derivative of the contact energy in the result is that at the present gap. */
struct contact_density_contribution
contact_face_kernel_density_contribution_of_pair(const struct contact *c, const struct particles *p, int64_t list_index,
                                                 int64_t other_list_index, real time_before_present);

/* Advances the friction spring *s by a step. dim: dimensions; normal[dim]: outward unit normal of the face, 0 if
 * contact has ended; slip[dim]: displacement of the particle relative to the face in the step [m]; stiffness: stiffness
 * of the spring [N/m]; slip_force: force at which the spring slides [N], 0 after separation. */
void contact_friction_spring_advance(struct contact_spring *s, int dim, const real *normal, const real *slip,
                                     real stiffness, real slip_force);

/* Advances the friction spring of particle number `list_index` of the contact list of c (particles of p that may come
 * into contact) by a time step dt [s], by the contact law of form `surface` (forces of smooth faces). First of two
 * passes over the particles; contact_face_add_friction_on_particle adds the forces. */
void contact_face_advance_friction_spring(struct contact *c, const struct particles *p, int64_t list_index, real dt);

/* Adds friction forces on particle number `list_index` of the contact list of c (particles that may come into contact)
 * to p->f: the force of its own spring, and the reactions to springs of other particles that slide on a face to which
 * the particle belongs. Second of two passes, after contact_face_advance_friction_spring for all particles. */
void contact_face_add_friction_on_particle(const struct contact *c, struct particles *p, int64_t list_index);

/* Returns the elastic energy [J] stored in all friction springs of the contact c. */
real contact_friction_stored_energy(const struct contact *c);

/* Allocates c->reaction, the reactions to the friction springs, one entry for each particle of the contact list
 * (particles that may come into contact): with them the force of a spring is distributed over the particles of the
 * opposite face. The values are computed with the next contact forces. contact_free releases the array. */
void contact_friction_reactions_allocate(struct contact *c);

/* Allocates the friction springs of c, whose list of particles is new, and copies to them the springs of particles that
 * were on the previous list, `previous`. contact_free releases them. */
void contact_friction_springs_copy_from_previous(struct contact *c, const struct contact *previous);

/* Copies friction spring number `previous_list_index` of the previous list `previous` to *spring. Leaves *spring
 * unchanged if `previous` is NULL or `previous_list_index` is -1, i.e. if the particle was not listed. */
void contact_friction_spring_copy_previous(struct contact_spring *spring, const struct contact_spring *previous,
                                           int64_t previous_list_index);

/* Sets the friction work of c, whose list of particles is new, to that of the previous list, `previous`, plus the
 * elastic energy of springs of particles that are not on the new list. */
void contact_friction_work_carry_over_to_new_list(struct contact *c, const struct contact *previous);

/* Lists in c->near, for each rigid body, the particles of p within `max_distance` [m] of its surface, with the gaps at
 * which contact begins and the friction springs. previous: the previous list, from which known particles keep gap and
 * spring. */
void contact_rigid_list_nearby_particles(struct contact *c, const struct contact *previous, const struct particles *p,
                                         real max_distance);

/* Frees c->near, the lists of particles near rigid bodies. */
void contact_rigid_free_particle_lists(struct contact *c);

/* Returns true if some point of a rigid body has been displaced by `min_distance` [m] or more since the last search for
 * pairs of the contact c. */
bool rigid_bodies_moved_since_last_contact_search(const struct contact *c, real min_distance);

/* Adds the contact forces of all rigid bodies of c on particles of p to p->f, and stores the opposite forces and
 * moments in the rigid bodies. dt: time since the last call [s], by which friction springs are stretched; found:
 * receives largest overlap and number of contacts. */
void contact_rigid_compute_forces(struct contact *c, struct particles *p, real dt, struct contact_summary *found);

/* Saves c->near, the lists of particles near rigid bodies, to the archive a if a->saving, else restores them. Returns
 * FAILED, with a message, if the archive cannot be read or written, or if a restored list has indices or counts that do
 * not fit. */
status contact_rigid_save_or_load_particle_lists(struct contact *c, struct archive *a);

/* Saves the array *array to the archive a if a->saving, else allocates *array with memory_new and restores it from the
 * archive. name: name of the entry; count: number of elements; element_size: bytes of an element. Returns FAILED if the
 * archive cannot be read or written or the stored size differs. */
status contact_array_save_or_load(struct archive *a, const char *name, void **array, int64_t count,
                                  size_t element_size);

/* Returns the elastic energy [J] of the contacts of particles p with all rigid bodies of c at the present positions. */
real contact_rigid_elastic_energy(const struct contact *c, const struct particles *p);

#endif
