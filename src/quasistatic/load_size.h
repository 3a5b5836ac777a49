/* Declares the functions for the load size (a number proportional to the loads) at which a crack increment releases as
 * much energy as it costs. */
#ifndef CLEAVE_LOAD_SIZE
#define CLEAVE_LOAD_SIZE

#include "quasistatic/load_steps.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Returns the pseudo-time [s] at which the load size of the run, a measure proportional to the loads
 * (statics_norm_of_prescribed_loads), equals `load_size` [m or N]. It is found by the secant method from the present
 * pseudo-time. */
real statics_find_pseudo_time_at_load_size(const struct run *run, real load_size);

/* Returns the load size (a measure proportional to the loads) [m or N] at which the crack increments `increment` and
 * `other_increment` together release as much energy as they cost: the square root of the sum of both costs divided by
 * the sum of both releases. The release of an increment is its released energy divided by the square of the load size.
 * Returns INFINITY if `increment` has no cost or the two release no energy. */
real two_crack_increments_load_size_at_energy_balance(const struct crack_increment *increment,
                                                      const struct crack_increment *other_increment);

/* Returns the load size (a measure proportional to the loads) [m or N] at which the crack increment `increment`
 * releases as much energy as it costs; INFINITY if it has no cost or releases no energy. */
real crack_increment_load_size_at_energy_balance(const struct crack_increment *increment);

/* Returns a fictitious crack increment that precedes the first one, as if the pre-crack had reached its length by
 * increments; for two_crack_increments_load_size_at_energy_balance. first, second: the first two increments. The cost
 * of the result is that of *first; its release is extrapolated linearly from the releases of *first and *second, and is
 * at least 0. */
struct crack_increment crack_increment_extrapolate_predecessor_of_first(const struct crack_increment *first,
                                                                        const struct crack_increment *second);

/* Returns the energy [J] that the body has released since the start: the fracture energy of the broken bonds of b plus
 * s->balance.lost, the energy that the jumps between equilibria would have turned into motion and that is lost, since
 * load steps have no inertia. */
real statics_energy_released_since_start(const struct statics *s, const struct bonds *b);

#endif
