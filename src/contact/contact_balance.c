/* What leap-frog gives and takes where contact begins and ends between two of its steps, and what takes it back.
 *
 * With the gap g of a row and its stiffness K, energy 1/4 K g^2 where g < 0, the work of the force over two steps is
 * 1/2 K g_n (g_n+1 - g_n-1)/2. Its sum over a contact differs from the change of the energy by
 *
 *     1/4 K g_n g_n+1    given at the last step with g_n < 0 (g_n+1 > 0), and taken at the first one,
 *
 * as likely the one as the other, so that faces that rest on each other and ring get warm: to three times their energy
 * in 1e5 automatic steps. Each row keeps the account of what it was given less what was taken from it. While that is
 * more than nothing, its force in contact has a part against the rate of its gap, which takes it back. Giving back what
 * was taken, by a force along the rate, makes bodies that ring unstable. */
#include "contact_internal.h"

#define BALANCE_DRAG 0.1 /* of the force per overlap that comes within a step */

real contact_balance(struct contact_balance *b, real stiffness, real gap, bool advance)
{
    if (!advance) return b->drag;
    const real was = b->gap;
    b->account -= 0.5 * b->drag * (gap - b->older);
    if ((was < 0) != (gap < 0)) b->account += (was < 0 ? -0.25 : 0.25) * stiffness * was * gap;
    b->older = was, b->gap = gap, b->drag = 0;
    if (!(gap < 0 && b->account > 0)) return 0;
    b->drag = real_min(0.5 * stiffness * BALANCE_DRAG * (gap - real_min(was, 0)), -0.5 * stiffness * gap);
    return b->drag;
}

struct contact_balance contact_balance_begin(const struct contact_balance *before, real gap)
{
    struct contact_balance to = {.gap = gap, .older = gap};
    if (!before) return to;
    if (gap < 0) return *before;
    to.account = before->account;
    return to;
}
