/* Crack increments. */
#ifndef CLEAVE_ADVANCE
#define CLEAVE_ADVANCE

#include "run/run.h"

/* Determines the next crack increment unless one is known: stores its bonds (statics.next), its energies, and the load
 * size at which it is due. Returns FAILED if a trial equilibrium is not found. */
status crack_increment_find(struct run *e);

/* Makes the next crack increment under the present loads: breaks its bonds and finds the equilibrium. Returns FAILED if
 * there is no equilibrium, INTERRUPTED if the run is to stop. */
status crack_increment_make(struct run *e);

/* Breaks the bonds of the next crack increment and moves the SIF-driven tips; the first half of crack_increment_make.
 * Returns the number of directed bonds broken. */
int64_t crack_increment_break(struct run *e);

/* Finds the equilibrium after the bonds of a crack increment have been broken, and converts material points near the
 * crack to peridynamic particles; the second half of crack_increment_make. broken: number of directed bonds that were
 * broken. Returns FAILED if there is no equilibrium, INTERRUPTED if the run is to stop. */
status crack_increment_settle(struct run *e, int64_t broken);

/* Scales the loads to the size at which the next crack increment releases as much energy as it costs, and makes the
 * increment there. Returns FAILED if there is no equilibrium, INTERRUPTED if the run is to stop. */
status crack_increment_make_balanced(struct run *e);

/* Makes the next crack increment as a dynamic release: integrates the motion of the body in time under fixed loads
 * until it is at rest, then finds the equilibrium (release.c). Returns FAILED if the motion diverges or there is no
 * equilibrium. */
status crack_increment_make_dynamic(struct run *e);

#endif
