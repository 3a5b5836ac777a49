/* Contact and rigid bodies in equilibrium states. */
#ifndef CLEAVE_TOUCH
#define CLEAVE_TOUCH

#include "quasistatic/statics.h"
#include "run/run.h"

struct contact;
struct rigid_set;

/* Returns true if contact acts between the faces of cracks and anything is in contact. */
bool statics_faces_closed(const struct contact *c);

/* Returns true if anything was in contact before the present solution, or is now. */
bool statics_in_contact(const struct statics *s, const struct contact *c);

/* Searches for contact pairs before the first solution. Does nothing without contact and rigid bodies. */
void statics_contact_start(struct run *e);

/* Returns the number of substeps into which the load increment to pseudo-time t [s] is divided, so that no rigid body
 * moves by more than 0.2 spacings in a substep. */
int statics_substeps(const struct scene *s, const struct rigid_set *rigid, real t);

/* Prepares a solution: moves rigid bodies to pseudo-time t [s], finds what is in contact there, and computes the stored
 * energy. */
void statics_contact_begin(struct run *e, real t);

/* Updates the set of active contacts at an equilibrium. Returns true if the set has not changed (`settle` of
 * solver/equilibrium.h). engine: a struct run. */
bool statics_contact_settle(void *engine);

/* Selects whether contact forces act on the fixed set of active contacts (settled) or on all that overlap (`laws` of
 * solver/equilibrium.h). engine: a struct run. */
void statics_contact_laws(void *engine, bool settled);

/* Completes a solution: adds the work of rigid bodies to their accounts and, if anything is or was in contact, computes
 * the energy that the solution has lost. work: of loads and supports in the solution [J]. lost: losses of the solver
 * before the solution [J]. Returns the uncertainty of the work of the rigid bodies: the difference between the work
 * with the mean of the initial and final force and the work with one of these forces [J]. */
real statics_contact_end(struct run *e, real work, real lost);

#endif
