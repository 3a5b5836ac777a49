/* The load size, a number that is proportional to the loads, and the load size at which crack increments are in
 * balance. */
#ifndef CLEAVE_LOAD_SIZE
#define CLEAVE_LOAD_SIZE

#include "quasistatic/load_steps.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Returns the pseudo-time at which the load size equals `size`, by the secant method from the present pseudo-time
 * [s]. */
real statics_time_of_size(const struct run *e, real size);

/* Returns the load size at which the increments a and b together release as much energy as they cost, sqrt((cost_a +
 * cost_b)/(release_a + release_b)); INFINITY if they release none. */
real balanced_load(const struct crack_increment *a, const struct crack_increment *b);

/* Returns the load size at which the increment a alone releases as much energy as it costs; INFINITY if it releases
 * none. */
real balanced_load_alone(const struct crack_increment *a);

/* Returns the fictitious increment by which the pre-crack would have reached its present length. Its release is
 * extrapolated linearly from the first two increments, and is at least 0. */
struct crack_increment increment_before(const struct crack_increment *first, const struct crack_increment *second);

/* Returns the energy released so far: fracture energy of broken bonds and losses of solutions [J]. */
real statics_released(const struct statics *s, const struct bonds *b);

#endif
