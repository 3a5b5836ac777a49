/* Detection of softened cracks across which intact bonds transmit compression like struts (bonds_soften.c). */
#ifndef CLEAVE_BONDS_STRUTS
#define CLEAVE_BONDS_STRUTS

#include "bonds/bonds.h"

/* Returns true if a softened crack transmits compression at some particle of p. Criterion: softening has broken the
 * bonds to a tenth of the neighbour volume, and these are stretched beyond their breaking stretch; bonds to another
 * tenth are intact and compressed by more than five times the stretch at which they begin to soften. A crack that is
 * sheared under pressure cannot slide at such a particle, and columns of material between cracks cannot crush. b: bonds
 * of p; limit: stretches at which bonds begin to soften. Returns false if no bond softens. */
bool bonds_any_softened_crack_carries_compression(const struct bonds *b, const struct particles *p,
                                                  const struct bond_limit *limit);

#endif
