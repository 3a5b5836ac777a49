/* Growth of a quantity that a stable run bounds: a few of its values, and from them the time of the last tenfold
 * rise.
 *
 * A mode of a leap-frog step dt above its limit dt_c is multiplied by -r in every step, r + 1/r = 4 (dt/dt_c)^2 - 2:
 * its square grows tenfold in RISE_STEPS steps where dt is 1.7e-5 of dt_c above that, and faster beyond. Slower
 * growth is not caused by the time step. */
#ifndef CLEAVE_RISE
#define CLEAVE_RISE

#include "base.h"

enum {
    RISE_STEPS = 100,
    RISE_STRIDE = 64,  /* steps between two records of values that no sample has      */
    RISE_CLOSEST = 16, /* steps between two values: what comes sooner is left out     */
    RISE_VALUES = 64
};

struct rise {
    int64_t n;
    struct {
        int64_t step;
        real value;
    } at[RISE_VALUES];
}; /* value n is at[n % RISE_VALUES] */

enum rise_rate { RISE_FAST, RISE_SLOW, RISE_UNSURE };

void rise_note(struct rise *r, int64_t step, real value);

/* Rate of the last tenfold rise, to `value` > 0 at `step`, and about how long it took [steps]; INFINITY: longer than
 * the record. FAST: within RISE_STEPS, where growth between two records is taken for exponential. SLOW: a value
 * above a tenth of `value` is older than that, or one near a tenth is older by more than that. */
enum rise_rate rise_rate(const struct rise *r, int64_t step, real value, real *steps);

#endif
