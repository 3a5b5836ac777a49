/* floor 2: the laws of single bonds. A law maps what a bond measures to the force of a unit weight; how bonds are
 * visited is not its business. To add one: write it here, add its name to enum pd_model, a case below, and one line a
 * dimension in variants.h. */
#ifndef CLEAVE_BOND_LAWS_H
#define CLEAVE_BOND_LAWS_H

#include <math.h>

#include "kernels.h"
#include "lanes.h"

/* Prototype microelastic brittle: f = c s n (Silling & Askari 2005; Zeng et al. 2022, eqs. 17, 29). `stretch` s [1];
 * returns force over stiffness and weight [1]. */
static ALWAYS_INLINE lanes bond_law_elastic(lanes stretch) { return stretch; }

static ALWAYS_INLINE lanes bond_law(const enum pd_model model, lanes stretch)
{
    switch (model) {
    case PD_BOND: return bond_law_elastic(stretch);
    default: return stretch;
    }
}

/* Energy of a bond over stiffness, weight and reference length [1]: integral of the law over the stretch. */
static ALWAYS_INLINE lanes bond_law_energy(const enum pd_model model, lanes stretch)
{
    switch (model) {
    case PD_BOND: return 0.5 * stretch * stretch;
    default: return lanes_of(0);
    }
}

/* Force of one stored bond, entry q of the row of particle i, as the force kernel makes it; tension is positive [N]. For
 * what is visited at samples and frames only. */
static inline real bond_force_stored(const struct bonds *b, const struct particles *p, int64_t q, int32_t i)
{
    real distance2 = 0;
    if (b->w[q] == 0) return 0;
    for (int d = 0; d < p->dim; d++) distance2 += square(p->x[d][b->nbr[q]] - p->x[d][i]);
    real stretch = sqrt(distance2) * b->inverse_length[q] - 1;
    return b->stiffness * b->w[q] * bond_law(PD_BOND, lanes_of(stretch))[0];
}

#endif
