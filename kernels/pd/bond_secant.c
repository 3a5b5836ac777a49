/* Starts the softening of bonds in load steps (static equilibria) whose stretch exceeds their onset. Between two
 * equilibria such bonds are springs of their secant stiffness (src/quasistatic/softening.c). */
#include "kernels/kernels.h"

/* Returns the smallest stretch at which a bond in row block g (the bonds of eight particles, stored together) begins
 * to soften or breaks [1]. b: all bonds. */
static real row_block_trigger(const struct bonds *b, int64_t g)
{
    real least = INFINITY;
    for (int64_t row = g * LANES; row < b->rows && row < (g + 1) * LANES; row++)
        least = real_min(least, b->trigger[row]);
    return least;
}

void bonds_open_beyond_onset(struct bonds *b, struct particles *p, const struct bond_limit *limit)
{
    struct bond_limit again = *limit;
    again.retries = true;
#pragma omp parallel for schedule(dynamic, 64)
    for (int64_t g = 0; g < b->row_blocks; g++)
        b->soft.due[g] = bond_row_block_stretch(b, p, g) > row_block_trigger(b, g) ? DUE_NEW : DUE_NOT;
    bonds_begin_to_soften(b, p, &again);
}
