/* Computes the energy that an increase of the damage of a bond releases in a state-based model (state_soften.c). */
#ifndef CLEAVE_KERNELS_STATE_DRIVING
#define CLEAVE_KERNELS_STATE_DRIVING

#include <math.h>

#include "kernels/kernels.h"
#include "rotation.h"

/* Returns the energy release by damage of `bond`, a bond in b, at the present states (pressure, spring stiffness,
 * rotation) of the neighbourhoods of both particles: the energy [J] that a small increase of its damage releases,
 * divided by this increase and by the weight of the bond (factor on its force). Damage may grow only if the result is
 * positive. i: particle of p to whose bonds `bond` belongs; the result for the other particle is bitwise equal. */
static inline real bond_energy_release_rate_by_damage(const struct bonds *b, const struct particles *p,
                                                      const struct bond *bond, int32_t i)
{
    const struct state *t = &b->state;
    const int32_t at[2] = {i, bond->nbr};
    const int dim = p->dim;
    const real r = 1 / bond->inverse_length;
    real y[DIM_MAX], xi[DIM_MAX], y2 = 0, own[2] = {0, 0};
    for (int d = 0; d < dim; d++) {
        y[d] = p->x[d][at[1]] - p->x[d][i], xi[d] = p->X[d][at[1]] - p->X[d][i];
        y2 += square(y[d]);
    }
    const real e = sqrt(y2) - r;
    for (int end = 0; end < 2; end++) {
        const real g = t->spring[at[end]];
        if (!t->rotation[0]) own[end] = g * square(e);
        if (!t->rotation[0] || g == 0) continue;
        lanes turned[DIM_MAX], arm[DIM_MAX], rotation[ROTATION]; /* eight equal lanes */
        for (int d = 0; d < dim; d++) turned[d] = lanes_broadcast(0), arm[d] = lanes_broadcast(xi[d]);
        for (int c = 0; c < ROTATION; c++) rotation[c] = lanes_broadcast(t->rotation[c][at[end]]);
        if (dim == 2)
            encoded_rotation_subtract_product_with_vector(turned, rotation, arm, 2);
        else
            encoded_rotation_subtract_product_with_vector(turned, rotation, arm, 3);
        for (int d = 0; d < dim; d++) own[end] += square(g * (y[d] - xi[d]) + turned[d][0]) / g;
    }
    return r * e * (t->pressure[at[0]] + t->pressure[at[1]]) + 0.5 * (own[0] + own[1]);
}

#endif
