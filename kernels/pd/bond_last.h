/* When, within a step, a bond passes its limit, and what its force still does in that step. */
#ifndef CLEAVE_KERNELS_BOND_LAST
#define CLEAVE_KERNELS_BOND_LAST

#include <math.h>

#include "kernels/kernels.h"

/* Component d of x_j - x_i, `ago` before the present places [m]. */
static inline real apart_ago(const struct particles *p, int32_t i, int32_t j, int d, real ago)
{
    const real y = p->x[d][j] - p->x[d][i];
    return ago == 0 ? y : y - ago * (p->v[d][j] - p->v[d][i]);
}

/* Stretch of a bond between i and j [1], `ago` before the present places [s]; broken ones may have a negative inverse
 * length. */
static inline real stretch_ago(const struct particles *p, real inverse_length, int32_t i, int32_t j, real ago)
{
    real distance2 = 0;
    for (int d = 0; d < p->dim; d++) distance2 += square(apart_ago(p, i, j, d, ago));
    return sqrt(distance2) * fabs(inverse_length) - 1;
}

static inline real stretch_limit(const struct particles *p, const struct bond_limit *limit, int32_t i, int32_t j)
{
    return limit->critical_stretch[p->material[i] * limit->materials + p->material[j]] * bond_strength(p, i, j);
}

/* When a bond ends: so long before the present places [s], and the share of its force in this step's kick [1]. */
struct bond_last {
    real ago, share;
};

/* The end of a bond beyond its limit, of which `plastic` stretch has no force. Both rows find the same from the same
 * numbers.
 *
 * In the last step places went from x - dt v to x, and the bond passed its limit s_c at the moment t*. The kick by the
 * forces at x lasts from half a step before x to half a step after. A bond that is gone at t* has in it, by impulse, a
 * share of (t* - t)/dt + 1/2, negative where the kick before was too long. By energy: what a leap-frog step loses when
 * a bond of energy W and force F ends with a share S is, but for terms of the kick squared,
 *
 *     W(s) - (1/2 - S) F(s) (|y(t)| - |y(t - dt)|)
 *
 * which is W(s_c), what the bond has at t*, with
 *
 *     S = 1/2 - (W(s) - W(s_c))/(F(s) (|y(t)| - |y(t - dt)|)) = 1/2 - (t - t*)/dt (1 + e_c/e)/2,     e = s - s_p
 *
 * for a force linear in e. The two agree to first order in dt, so that impulse and energy of breaking are both of
 * second order. */
static inline struct bond_last bond_last_of(const struct particles *p, const struct bond_limit *limit,
                                            real inverse_length, real plastic, int32_t i, int32_t j)
{
    const real most = stretch_limit(p, limit, i, j);
    const real now = stretch_ago(p, inverse_length, i, j, 0);
    const real before = stretch_ago(p, inverse_length, i, j, limit->dt);
    switch (limit->last_force) {
    case LAST_FORCE_HALF:
        return (struct bond_last){0, 0.5};
    case LAST_FORCE_WHOLE:
        return (struct bond_last){0, 1};
    case LAST_FORCE_NONE:
        return (struct bond_last){0, 0};
    case LAST_FORCE_MOMENT:
        break;
    }
    if (!(before <= most && most < now)) return (struct bond_last){0, 0}; /* beyond before it was watched */
    const real ago = (now - most) / (now - before), part = most > plastic ? (most - plastic) / (now - plastic) : 0;
    return (struct bond_last){ago * limit->dt, 0.5 - 0.5 * ago * (1 + part)};
}

/* Entry q of a row, as stored. */
static inline struct bond_last bond_last_stored(const struct bonds *b, const struct particles *p,
                                                const struct bond_limit *limit, int64_t q, int32_t i, int32_t j)
{
    return bond_last_of(p, limit, b->inverse_length[q], b->plastic_stretch ? b->plastic_stretch[q] : 0, i, j);
}

#endif
