/* Computes the time within a step at which a bond exceeds its breaking stretch, and the fraction of its force that acts
 * in that step. */
#ifndef CLEAVE_KERNELS_BOND_LAST
#define CLEAVE_KERNELS_BOND_LAST

#include <math.h>

#include "bonds/bond_stretch.h"
#include "kernels/kernels.h"

/* Returns the total energy that a softening bond has dissipated when its stretch exceeds the end of its softening in
 * the leap-frog step from `before` to `now` [1], divided by stiffness, weight (factor on its force) and length of the
 * bond (dimensionless). In this last step it dissipates (1 - d) before now/2, with the damage d at the start of the
 * step. c: softening curve; onset, end: stretches at which the bond begins to soften and breaks [1]. */
static inline real bond_softening_energy_dissipated_at_failure(const struct softening_curve *c, real onset, real end,
                                                               real before, real now)
{
    const real most = real_min(real_max(before, onset), end);
    const real kept = before > 0 ? softening_remaining_stiffness_fraction(c, onset, end, most) : 1;
    return softening_normalised_dissipated_energy(c, onset, end, most) + 0.5 * kept * before * now;
}

/* When a bond breaks within a time step. lag: time from the moment at which the stretch exceeded the limit to the
 * present positions [s]; share: fraction of the force of the bond that acts in the velocity update of this step [1]. */
struct bond_break_moment {
    real lag, share;
};

/* Computes when, within the last step, the bond between the particles i and j exceeded its breaking stretch, and how
 * much of its force acts in the velocity update of this step. p: particles. Returns the lag, the time from this moment
 * to that of the present positions [s], and the share, the fraction of the force that acts [1]. limit->last_force
 * selects the rule: with LAST_FORCE_HALF, WHOLE and NONE the share is 1/2, 1 and 0, and the lag 0; with
 * LAST_FORCE_MOMENT both follow from the stretches before and after the step as below. With this rule both are 0 if the
 * bond exceeded its limit already before the step, and if bonds soften, whose energy loss in the step is computed
 * elsewhere (stretch_at_break in bond_break.c). inverse_length: inverse of the reference length of the bond [1/m];
 * plastic: plastic stretch s_p of the bond [1]. The result for j and i is bitwise equal.
 *
 * In the last step positions moved from x - dt v to x, and the bond passed its limit s_c at time t*. The velocity
 * update by the forces at x extends from half a step before x to half a step after. By impulse, a bond that breaks at
 * t* contributes a share of (t* - t)/dt + 1/2 to this update, negative where the previous update was too large. By
 * energy: if a bond of energy W and force F breaks with a share S, a leap-frog step loses, up to terms of the change of
 * velocity squared,
 *
 *     W(s) - (1/2 - S) F(s) (|y(t)| - |y(t - dt)|)
 *
 * This equals W(s_c), the energy of the bond at t*, if
 *
 *     S = 1/2 - (W(s) - W(s_c))/(F(s) (|y(t)| - |y(t - dt)|)) = 1/2 - (t - t*)/dt (1 + e_c/e)/2,     e = s - s_p
 *
 * for a force linear in e. Both shares agree to first order in dt, so impulse and energy of breaking are of second
 * order. */
static inline struct bond_break_moment bond_find_break_time_and_force_fraction(const struct particles *p,
                                                                               const struct bond_limit *limit,
                                                                               real inverse_length, real plastic,
                                                                               int32_t i, int32_t j)
{
    const real most = bond_breaking_stretch(p, limit, i, j);
    const real now = bond_stretch_at_earlier_time(p, inverse_length, i, j, 0);
    const real before = bond_stretch_at_earlier_time(p, inverse_length, i, j, limit->dt);
    switch (limit->last_force) {
    case LAST_FORCE_HALF:
        return (struct bond_break_moment){0, 0.5};
    case LAST_FORCE_WHOLE:
        return (struct bond_break_moment){0, 1};
    case LAST_FORCE_NONE:
        return (struct bond_break_moment){0, 0};
    case LAST_FORCE_MOMENT:
        break;
    }
    if (limit->softening || !(before <= most && most < now)) /* or already beyond the limit when first evaluated */
        return (struct bond_break_moment){0, 0};
    const real lag = (now - most) / (now - before), part = most > plastic ? (most - plastic) / (now - plastic) : 0;
    return (struct bond_break_moment){lag * limit->dt, 0.5 - 0.5 * lag * (1 + part)};
}

/* Returns, for the bond with index `bond` in the arrays of b between particles i and j of p, when in the last step it
 * exceeded its breaking stretch, and which share of its force acts in this step
 * (bond_find_break_time_and_force_fraction). limit: breaking stretches and rule for the share. Inverse length and
 * plastic stretch are read from b. */
static inline struct bond_break_moment
bond_at_index_find_break_time_and_force_fraction(const struct bonds *b, const struct particles *p,
                                                 const struct bond_limit *limit, int64_t bond, int32_t i, int32_t j)
{
    return bond_find_break_time_and_force_fraction(p, limit, b->inverse_length[bond],
                                                   b->plastic_stretch ? b->plastic_stretch[bond] : 0, i, j);
}

#endif
