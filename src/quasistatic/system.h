/* The system of equations of load steps: the unknowns, and the forces on them. */
#ifndef CLEAVE_SYSTEM
#define CLEAVE_SYSTEM

#include "run/run.h"

/* Makes the system of the present particles and nodes at their present displacements. The counters and losses of a
 * former system are kept. */
void statics_unknowns_make(struct run *e);

/* Frees the system; its counters and losses stay. To be called before statics_unknowns_make after a conversion. */
void statics_unknowns_free(struct statics *s);

/* Moves particles and nodes to the equilibrium that has been found, and updates their plastic state. */
void statics_flow(struct run *e);

/* Saves or restores the plastic state of bonds and points, as far as a trial changes it. optional: WITH_* arrays that
 * particles have. */
status plastic_archive(struct bonds *b, struct particles *p, int optional, struct archive *a);

/* Saves the plastic state of bonds and points as the start of the next solutions. */
void statics_plastic_keep(struct run *e);
/* Restores the plastic state saved last. Does nothing if none has been saved. */
void statics_plastic_restore(struct run *e);

#endif
