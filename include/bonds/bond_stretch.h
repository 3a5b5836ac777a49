/* Stretches of single bonds, computed from the positions of their particles. */
#ifndef CLEAVE_BOND_STRETCH
#define CLEAVE_BOND_STRETCH

#include <math.h>

#include "data/particles.h"

/* Returns component `axis` of the vector x_j - x_i [m] between the particles i and j of p at a time `lag` [s] before
 * that of the present positions, extrapolated by the present velocities. */
static inline real bond_vector_component_at_earlier_time(const struct particles *p, int32_t i, int32_t j, int axis,
                                                         real lag)
{
    const real y = p->x[axis][j] - p->x[axis][i];
    return lag == 0 ? y : y - lag * (p->v[axis][j] - p->v[axis][i]);
}

/* Returns the stretch [1] of the bond between the particles i and j of p at a time `lag` [s] before that of the present
 * positions. inverse_length: inverse of the reference length of the bond [1/m]; its sign, negative for broken bonds,
 * does not matter. */
static inline real bond_stretch_at_earlier_time(const struct particles *p, real inverse_length, int32_t i, int32_t j,
                                                real lag)
{
    real distance2 = 0;
    for (int d = 0; d < p->dim; d++) distance2 += square(bond_vector_component_at_earlier_time(p, i, j, d, lag));
    return sqrt(distance2) * fabs(inverse_length) - 1;
}

#endif
