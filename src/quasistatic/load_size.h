/* Size of the loads, one number that scales with them; crack increments by the size at which they are due. */
#ifndef CLEAVE_LOAD_SIZE
#define CLEAVE_LOAD_SIZE

#include "quasistatic/load_steps.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Returns the pseudo-time near the present one at which the loads have this size [s]. */
real statics_time_of_size(const struct run *e, real size);

/* Returns the size of loads at which two crack increments together release what they cost, INFINITY if at none. */
real size_of_balance(const struct advance *a, const struct advance *b);

/* Returns the size of loads at which a crack increment releases what it costs, INFINITY if at none. */
real size_of_advance(const struct advance *a);

/* Returns the increment before the first one of a pre-crack, as if the pre-crack had grown by it: its release follows
 * from those of the first two increments linearly, and is 0 or more. */
struct advance advance_before(const struct advance *first, const struct advance *second);

/* Returns the energy released so far: taken by broken bonds, or lost in solutions [J]. */
real statics_released(const struct statics *s, const struct bonds *b);

#endif
