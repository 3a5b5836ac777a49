/* Growth of a quantity that stays bounded in a stable computation: records some of its values, and computes from them
 * the duration of the last tenfold increase, in time steps.
 *
 * If the time step dt of leap-frog exceeds the critical step dt_c of a vibration mode, every step multiplies the mode
 * by -r, where r > 1 and r + 1/r = 4 (dt/dt_c)^2 - 2. Its square grows tenfold in RISE_STEPS steps if dt exceeds dt_c
 * by 1.7e-5 dt_c, and faster beyond. Slower growth is not caused by the time step. */
#ifndef CLEAVE_RISE
#define CLEAVE_RISE

#include "base.h"

enum {
    RISE_STEPS = 100,
    RISE_STRIDE = 64,  /* steps between two records of values that no sample has */
    RISE_CLOSEST = 16, /* smallest number of steps between two records; earlier values are omitted */
    RISE_VALUES = 64
};

/* Values of a quantity recorded at some time steps. n: number of records so far, of which the last RISE_VALUES are
 * kept; record k (0 .. n - 1) is at[k % RISE_VALUES]. step: number of the time step of a record; value: the
 * quantity. */
struct quantity_samples {
    int64_t n;
    struct {
        int64_t step;
        real value;
    } at[RISE_VALUES];
};

/* Growth of a quantity: tenfold within RISE_STEPS time steps (as by a time step that is too long), slower, or undecided
 * because there are too few records. */
enum growth_rate { RISE_FAST, RISE_SLOW, RISE_UNSURE };

/* Records `value` at time step number `step` in `samples`, unless the last record is less than RISE_CLOSEST (16) steps
 * old. The last RISE_VALUES (64) records are kept. */
void quantity_samples_add_value(struct quantity_samples *samples, int64_t step, real value);

/* Returns how fast the quantity recorded in `samples` has grown to `value` > 0 at time step number `step`: RISE_FAST if
 * it increased tenfold within RISE_STEPS (100) steps (growth between two records is taken as exponential), RISE_SLOW if
 * that took longer, RISE_UNSURE if the records do not decide. *tenfold_steps receives the approximate duration of the
 * last tenfold increase [steps], INFINITY if that increase began before the first record. */
enum growth_rate quantity_samples_classify_growth_rate(const struct quantity_samples *samples, int64_t step, real value,
                                                       real *steps_of_last_tenfold_rise);

#endif
