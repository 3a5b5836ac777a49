/* Declares the functions for contact and rigid bodies in load steps (successive static equilibria). */
#ifndef CLEAVE_CONTACT_SET
#define CLEAVE_CONTACT_SET

#include "quasistatic/statics.h"
#include "run/run.h"

struct contact;
struct rigid_set;

/* Returns true if contact forces of c act between any two particles of a body, so that crack faces can press on each
 * other, and some particles are in contact at present. */
bool crack_faces_are_in_contact(const struct contact *c);

/* Returns true if any particles or rigid bodies were in contact before the present solution of s (state of the load
 * steps, i.e. successive equilibria) or are in contact now. */
bool statics_contact_existed_before_or_exists_now(const struct statics *s, const struct contact *contact);

/* Searches for pairs in contact of the run before its first solution. Does nothing in runs without contact and rigid
 * bodies, or if the search has been made. */
void statics_contact_search_before_first_solution(struct run *run);

/* Returns the number of substeps into which the load increment from the present positions of rigid bodies to those at
 * the pseudo-time `pseudo_time` [s] is divided, so that no rigid body moves by more than 0.2 particle spacings in a
 * substep; from 1 to 10000. */
int statics_rigid_motion_substep_count(const struct scene *s, const struct rigid_set *rigid, real pseudo_time);

/* Prepares the solution of the run at the pseudo-time `pseudo_time` [s]: computes the energy stored before the
 * solution, moves rigid bodies to their positions at that time, and searches for contacts there. */
void statics_move_rigid_bodies_and_search_contacts(struct run *run, real pseudo_time);

/* Moves particles and nodes of the run to the displacements of the present solution and updates the set of active
 * contacts (callback `settle` of solver/equilibrium.h). run: a struct run. Returns true if no contact was added or
 * removed. */
bool statics_update_contacts_and_test_unchanged(void *run);

/* Selects the contacts that exert forces (callback `laws` of solver/equilibrium.h): the fixed set of active contacts
 * if `use_fixed_set` is true, else all pairs that overlap. run: a struct run. */
void statics_contact_use_fixed_set_or_all_overlaps(void *run, bool use_fixed_set);

/* Completes the solution for an equilibrium of the run: adds the work done on rigid bodies in this solution to
 * their total work and, if anything is or was in contact, computes the energy that the solution has lost. load_work:
 * work of loads and supports in this solution [J]; solver_loss: energy lost in earlier solutions [J]. Returns the
 * uncertainty of the work of the rigid bodies [J]: the difference between the work with the mean of the initial and
 * final contact force and the work with one of these forces. */
real rigid_body_work_add_and_estimate_error(struct run *run, real load_work, real solver_loss);

/* Raises the largest contact force so far [N], which `rigid` stores for each of its `rigid_body_count` rigid bodies, to
 * the contact force of the present equilibrium if that is larger. */
void rigid_bodies_update_largest_contact_forces(struct rigid_set *rigid, int rigid_body_count);

/* Adds a warning to *warnings for each of the `rigid_body_count` rigid bodies that is driven (has a prescribed motion)
 * and whose largest contact force was at most `least_force` [N]: it misses the body, or pushes a body that nothing
 * constrains. */
void rigid_bodies_warn_of_no_contact(struct warnings *warnings, const struct rigid_set *rigid, int rigid_body_count,
                                     real least_force);

#endif
