/* How close bonds are to a strength surface that starts their softening (bonds_strength.c). */
#ifndef CLEAVE_BONDS_STRENGTH_SURFACES
#define CLEAVE_BONDS_STRENGTH_SURFACES

#include "bonds/bonds.h"

/* Returns the largest stress at which bonds can still begin to soften, over that at which they begin [1]: of the
 * particles with a bond that has not begun, the smaller one of the stresses of its own strain and of the averaged one.
 * Considered are particles whose bonds have stretches near the strength surface; 0 if there is none. source: inputs of
 * the bonds. */
real bonds_largest_stress_to_strength_ratio(const struct bonds *b, const struct particles *p,
                                            const struct bond_source *source);

#endif
