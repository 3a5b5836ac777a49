/* Crack increments. */
#ifndef CLEAVE_ADVANCE
#define CLEAVE_ADVANCE

#include "run/run.h"

/* Finds the next crack increment, if none is known: its bonds, and the size of loads at which it is due. */
status statics_look_ahead(struct run *e);

/* Makes the next crack increment under the present loads. */
status statics_advance(struct run *e);

/* First half of statics_advance: breaks the bonds of the increment and moves tips. Returns the number of directed bonds
 * broken. */
int64_t statics_advance_break(struct run *e);

/* Second half of statics_advance: finds the equilibrium, and converts material points. broken: directed bonds. */
status statics_advance_settle(struct run *e, int64_t broken);

/* Scales the loads to where the next crack increment releases what it costs, and makes it there. */
status statics_advance_balanced(struct run *e);

/* Makes the next crack increment and follows the motion of the body in time until it is at rest again (release.c). */
status statics_release(struct run *e);

#endif
