/* How close bonds are to a strength surface that starts their softening (bonds_strength.c). */
#ifndef CLEAVE_BONDS_STRENGTH_SURFACES
#define CLEAVE_BONDS_STRENGTH_SURFACES

#include "bonds/bonds.h"

/* Returns how close the stress is to starting the softening of further bonds of b: the largest ratio of the stress of a
 * particle of p to the stress at which its bonds begin to soften, i.e. the stress on its strength surface (failure
 * criterion in stress) times its strength factor; 1 or more: bonds begin to soften. The stress follows from the strain
 * of the neighbourhood, or from this strain averaged over neighbours if that gives less. Only particles with large bond
 * stretches and a bond that has not begun to soften are considered; 0 if there are none. source: inputs of the bonds
 * (horizon, materials, cracks, mirrors). */
real bonds_largest_stress_to_strength_ratio(const struct bonds *b, const struct particles *p,
                                            const struct bond_source *source);

#endif
