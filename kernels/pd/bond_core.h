/* Repulsive core of bonds, which prevents their inversion. The force of a linear bond stays finite as its length goes
 * to 0, so particles pass through each other at speeds above half the wave speed. Below CORE_FROM of its length a bond
 * therefore has an additional repulsion, in every model; above it nothing changes, to the last bit. With l = |y|/|xi|
 * and K the force of the bond per stretch:
 *
 *     force   -K a (CORE_FROM - l)
 *     energy   1/2 K |xi| a (CORE_FROM - l)^2
 *
 * a = 3 (CORE_STIFFNESS), reduced where the time step requires it: bonds with cores have sqrt(1 + a) times the
 * frequency of bonds alone, so a <= (critical step/step)^2 - 1: 3 at 0.5 of the critical step (bonds that may break),
 * 0.56 at 0.8. With a = 3 the halves of a plate that collide at half the wave speed each keep their order (measured);
 * faster collisions may not. Rare: the hot loops find the most compressed bond of a block of eight rows, and visit the
 * block again only if it is in its core. */
#ifndef CLEAVE_KERNELS_BOND_CORE
#define CLEAVE_KERNELS_BOND_CORE

#include <math.h>

#include "bonds/bonds.h"

#define RARE static __attribute__((noinline, unused))

/* Ratio of present to reference length of a bond, |y|/|xi|, below which its repulsive core acts; empirical. */
#define CORE_FROM 0.7

/* A bond that is so strongly compressed that its repulsive core acts. ratio: present length divided by reference
 * length, |y|/|xi| (1 if the core does not act); K: force of the bond per stretch [N]; y: vector from i to j [m];
 * distance: |y| [m]. */
struct repulsive_core {
    real ratio, K, y[DIM_MAX], distance;
};

/* Returns length ratio, stiffness and present vector of `bond`, a bond in b of particle i of p, from which the force of
 * its repulsive core follows (additional repulsion of strongly compressed bonds). The member `ratio` is 1 if the core
 * does not act, because the bond is broken or longer than CORE_FROM times its reference length. */
static inline struct repulsive_core bond_evaluate_repulsive_core(const struct bonds *b, const struct particles *p,
                                                                 const struct bond *bond, int32_t i)
{
    struct repulsive_core c = {.ratio = 1};
    const real *spring = b->state.spring;
    real distance2 = 0;
    if (bond->w == 0) return c;
    for (int d = 0; d < p->dim; d++) c.y[d] = p->x[d][bond->nbr] - p->x[d][i], distance2 += square(c.y[d]);
    c.distance = sqrt(distance2);
    if (!(c.distance * bond->inverse_length < CORE_FROM && c.distance > 0)) return c;
    c.ratio = c.distance * bond->inverse_length;
    c.K = bond->w * (spring ? (spring[i] + spring[bond->nbr]) / bond->inverse_length : b->stiffness);
    return c;
}

/* Adds the forces [N] of the repulsive cores (additional repulsion of strongly compressed bonds) of all bonds in block
 * `row_block` of eight rows of b (the bonds of eight particles) to the forces p->f on these particles. */
RARE void bond_row_block_add_repulsive_core_forces(const struct bonds *b, struct particles *p, int64_t row_block)
{
    for (int64_t row = row_block * LANES; row < b->rows && row < (row_block + 1) * LANES; row++) {
        const int32_t i = b->particle[row];
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
            const struct repulsive_core c = bond_evaluate_repulsive_core(b, p, &it.bond, i);
            if (!(c.ratio < CORE_FROM)) continue;
            for (int d = 0; d < p->dim; d++) p->f[d][i] -= c.K * b->core * (CORE_FROM - c.ratio) * c.y[d] / c.distance;
        }
    }
}

/* Returns half the energy [J] of the repulsive cores (additional repulsion of strongly compressed bonds) of the bonds
 * of block `row_block` of eight rows (the bonds of eight particles of p); the other particle of each bond has the other
 * half. row_energy: NULL, or [b->rows], to whose entries the energy of each row (the bonds of one particle) is added
 * [J]. */
RARE real bond_row_block_repulsive_core_energy(const struct bonds *b, const struct particles *p, int64_t row_block,
                                               real *row_energy)
{
    real sum = 0;
    for (int64_t row = row_block * LANES; row < b->rows && row < (row_block + 1) * LANES; row++)
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
            const struct repulsive_core c = bond_evaluate_repulsive_core(b, p, &it.bond, b->particle[row]);
            if (!(c.ratio < CORE_FROM)) continue;
            const real energy = 0.25 * c.K / it.bond.inverse_length * b->core * square(CORE_FROM - c.ratio);
            sum += energy;
            if (row_energy) row_energy[row] += energy;
        }
    return sum;
}

#endif
