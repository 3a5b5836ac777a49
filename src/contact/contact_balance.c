/* Compensates the energy error of leap-frog when contact begins and ends between two steps.
 *
 * With the gap g of a row (a particle of the contact list), stiffness K and energy 1/4 K g^2 for g < 0, the
 * work of the force over two steps is 1/2 K g_n (g_n+1 - g_n-1)/2. Summed over a contact it differs from the
 * change of energy by
 *
 *     1/4 K g_n g_n+1    added at the last step with g_n < 0 (g_n+1 > 0), removed at the first such step.
 *
 * Both signs are equally likely, so that faces in contact that vibrate gain energy: up to three times their
 * energy in 1e5 automatic steps. Each row therefore keeps an account of the energy added minus the energy
 * removed. While the account is positive, the force in contact has a part against the rate of the gap, which
 * removes energy. (Adding energy by a force along the rate when the account is negative makes vibrating
 * bodies unstable.) */
#include "contact_internal.h"

/* Largest force against the rate of the gap, relative to the change of the contact force in a step [1]; empirical. */
#define BALANCE_DRAG 0.1

real contact_leapfrog_error_correction_force(struct contact_leapfrog_error_account *error_account, real stiffness,
                                             real gap, bool step_was_made)
{
    if (!step_was_made) return error_account->drag;
    const real was = error_account->gap;
    error_account->account -= 0.5 * error_account->drag * (gap - error_account->older);
    if ((was < 0) != (gap < 0)) error_account->account += (was < 0 ? -0.25 : 0.25) * stiffness * was * gap;
    error_account->older = was, error_account->gap = gap, error_account->drag = 0;
    if (!(gap < 0 && error_account->account > 0)) return 0;
    error_account->drag = real_min(0.5 * stiffness * BALANCE_DRAG * (gap - real_min(was, 0)), -0.5 * stiffness * gap);
    return error_account->drag;
}

struct contact_leapfrog_error_account
contact_leapfrog_error_carry_over_to_new_list(const struct contact_leapfrog_error_account *previous, real gap)
{
    struct contact_leapfrog_error_account to = {.gap = gap, .older = gap};
    if (!previous) return to;
    if (gap < 0) return *previous;
    to.account = previous->account;
    return to;
}
