/* floor 3: geometry of bonds that cross the cell of a particle, shared by partial stress and return. */
#ifndef CLEAVE_PARTIAL_PARTS_H
#define CLEAVE_PARTIAL_PARTS_H

#include "bonds.h"

/* Share of the segment a-b inside the cube of half edge `half` round X. */
real segment_share(const real *a, const real *b, const real *X, real half, int dim);

/* Position of the mirror chain's image of a point: X'_d = sign_d X_d + offset_d. */
struct reflection { real sign[DIM_MAX], offset[DIM_MAX]; int64_t root; };
struct reflection reflection_of(const struct bond_source *s, const struct particles *p, int64_t i);

/* Half the edge of a particle's cell [m]. */
real half_edge(const struct particles *p, const struct bond_source *s, int64_t i);

#endif
