/* Measures the duration of the last tenfold increase of a quantity, and classifies its growth rate. */
#include "base/rise.h"

#include <math.h>

#define NOTHING 1e-30 /* smaller recorded values, also negative ones, count as this share of the present value [1] */

/* Smallest ratio of a recorded value to the present value from which a growth rate is derived. A smaller recorded value
 * may be the constant background of a quantity that grows faster. Empirical. */
#define SOMETHING 0.03

void quantity_samples_add_value(struct quantity_samples *samples, int64_t step, real value)
{
    if (samples->n > 0 && step < samples->at[(samples->n - 1) % RISE_VALUES].step + RISE_CLOSEST) return;
    samples->at[samples->n % RISE_VALUES].step = step;
    samples->at[samples->n++ % RISE_VALUES].value = value;
}

enum growth_rate quantity_samples_classify_growth_rate(const struct quantity_samples *samples, int64_t step, real value,
                                                       real *steps_of_last_tenfold_rise)
{
    real newer = value, older = 0, least = 0;
    *steps_of_last_tenfold_rise = INFINITY;
    for (int64_t k = samples->n; k-- > 0 && k >= samples->n - RISE_VALUES;) {
        const real most = (real)(step - samples->at[k % RISE_VALUES].step);
        older = real_max(samples->at[k % RISE_VALUES].value, NOTHING * value);
        if (older <= 0.1 * value) {
            *steps_of_last_tenfold_rise = least + (most - least) * log(newer / (0.1 * value)) / log(newer / older);
            break;
        }
        newer = older, least = most;
    }
    if (least >= RISE_STEPS || (*steps_of_last_tenfold_rise > RISE_STEPS && older >= SOMETHING * value &&
                                isfinite(*steps_of_last_tenfold_rise)))
        return RISE_SLOW;
    return *steps_of_last_tenfold_rise <= RISE_STEPS ? RISE_FAST : RISE_UNSURE;
}
