/* Logarithm, exponential and power of eight doubles, without calls of the C library. Relative errors, measured over
 * 1e-300 to 1e300: logarithm 6e-16, exponential 3e-16, powers with |b log a| up to 30: 1e-14; 2e-15 up to 5. */
#ifndef CLEAVE_KERNELS_LANES_POWER
#define CLEAVE_KERNELS_LANES_POWER

#include "kernels/simd/lanes.h"

/* ln 2 = LN2_HIGH + LN2_LOW; the first has 32 bits, so that its product with an exponent is exact. */
#define LN2_HIGH 0x1.62e42fee00000p-1
#define LN2_LOW 0x1.a39ef35793c76p-33

/* Returns the natural logarithm of eight positive normal numbers a. With a = 2^e m, m between sqrt(1/2) and sqrt(2),
 * and f = (m - 1)/(m + 1): log a = e log 2 + 2 (f + f^3/3 + ... + f^21/21), whose remainder is below 3e-18 as |f| <
 * 0.172. */
static ALWAYS_INLINE lanes lanes_log(lanes a)
{
    const lanes_bits root_half = (lanes_bits){0} + UINT64_C(0x3fe6a09e667f3bcd);
    const lanes_bits exponent = ((lanes_bits)a - root_half + (UINT64_C(1023) << 52)) >> 52; /* e + 1023 */
    const lanes e = (lanes)(exponent | UINT64_C(0x4330000000000000)) - (0x1p52 + 1023);
    const lanes m = (lanes)((lanes_bits)a - ((exponent - 1023) << 52));
    const lanes f = (m - 1.0) / (m + 1.0), f2 = f * f;
    lanes sum = lanes_broadcast(2.0 / 21);
    for (int k = 19; k >= 3; k -= 2) sum = sum * f2 + 2.0 / k;
    return e * LN2_HIGH + (2.0 * f + (f * f2 * sum + e * LN2_LOW));
}

/* Returns exp(a) of eight numbers a, which are limited to -708 .. 709. With a = k log 2 + r and |r| <= log(2)/2: 2^k
 * times the Taylor series of exp r to the 13th power, whose remainder is below 5e-18. */
static ALWAYS_INLINE lanes lanes_exp(lanes a)
{
    const real round = 0x1.8p52; /* added and subtracted: rounds to a whole number */
    a = lanes_max(lanes_min(a, lanes_broadcast(709)), lanes_broadcast(-708));
    const lanes shifted = a * 1.44269504088896340736 + round, k = shifted - round;
    const lanes r = (a - k * LN2_HIGH) - k * LN2_LOW;
    static const real inverse[] = {1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800,
                                   1.0 / 362880,     1.0 / 40320,     1.0 / 5040,     1.0 / 720,
                                   1.0 / 120,        1.0 / 24,        1.0 / 6,        0.5};
    lanes sum = lanes_broadcast(inverse[0]);
    for (int p = 1; p < (int)COUNT_OF(inverse); p++) sum = sum * r + inverse[p];
    sum = 1.0 + (r + r * r * sum);
    return (lanes)((lanes_bits)sum + ((lanes_bits)shifted << 52));
}

/* Returns a^b of eight numbers a >= 0 with one exponent b > 0; 0 where a is below 1e-300. */
static ALWAYS_INLINE lanes lanes_power(lanes a, real b)
{
    const lanes_mask none = lanes_less(a, lanes_broadcast(1e-300));
    return lanes_choose(none, lanes_broadcast(0), lanes_exp(b * lanes_log(lanes_max(a, lanes_broadcast(1e-300)))));
}

#endif
