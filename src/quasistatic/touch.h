/* Contact and rigid bodies in equilibria. */
#ifndef CLEAVE_TOUCH
#define CLEAVE_TOUCH

#include "quasistatic/statics.h"
#include "run/run.h"

struct contact;
struct rigid_set;

/* Returns true if faces of cracks can be in contact, and something is. */
bool statics_faces_closed(const struct contact *c);

/* Returns true if anything was in contact at the beginning of the solution, or is now. */
bool statics_touched(const struct statics *s, const struct contact *c);

/* Searches for contact before the first solution. */
void statics_touch_start(struct run *e);

/* Returns the number of solutions into which the increment to pseudo-time t [s] is divided, so that no rigid body moves
 * too far in one. */
int statics_strides(const struct scene *s, const struct rigid_set *rigid, real t);

/* Before a solution: moves rigid bodies to pseudo-time t [s] and marks what is in contact there. */
void statics_touch_begin(struct run *e, real t);

/* Updates the marks of contact at an equilibrium; returns true if none has changed (`settle` of
 * solver/equilibrium.h). `engine`: struct run. */
bool statics_touch_settle(void *engine);

/* Selects the law by marks, or by overlaps (`laws` of solver/equilibrium.h). `engine`: struct run. */
void statics_touch_laws(void *engine, bool settled);

/* After a solution: books the work of rigid bodies and, if anything was in contact, the energy that the solution has
 * lost. work: of loads and supports in the solution [J]; lost: the sum of losses before it [J]. Returns how far the
 * work of rigid bodies is from that by the force of one end alone [J]. */
real statics_touch_end(struct run *e, real work, real lost);

#endif
