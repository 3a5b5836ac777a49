/* The system of equations of load steps: the unknowns, and the forces on them. */
#ifndef CLEAVE_SYSTEM
#define CLEAVE_SYSTEM

#include "run/run.h"

/* Makes the system of equations for the present particles and nodes at their present displacements. Counters, losses
 * and the largest force norm of a previous system are kept. Release with statics_unknowns_free. */
void statics_unknowns_make(struct run *e);

/* Frees the system of equations. Counters, losses and the largest force norm remain. */
void statics_unknowns_free(struct statics *s);

/* Moves particles and nodes to the displacements of the last solution, and updates their plastic state. */
void plastic_update(struct run *e);

/* Saves or restores the plastic state of bonds and points. optional: WITH_* arrays that the particles have. Returns the
 * status of the archive. */
status plastic_archive(struct bonds *b, struct particles *p, int optional, struct archive *a);

/* Saves the plastic state of bonds and points as the start of the next solutions. */
void plastic_state_save(struct run *e);

/* Restores the plastic state saved last. Does nothing if none has been saved. */
void plastic_state_restore(struct run *e);

#endif
