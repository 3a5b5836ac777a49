/* Softening bonds that act as struts under pressure (bonds_soften.c). */
#ifndef CLEAVE_BONDS_STRUTS
#define CLEAVE_BONDS_STRUTS

#include "bonds/bonds.h"

/* Returns true if softening bonds of b act as struts at a particle of p: a tenth of its bonds have ended and are
 * stretched beyond their end, while another tenth are intact and press with more than five times the tensile strength.
 * A crack that is sheared under pressure cannot slide there, and columns between cracks do not crush. limit: onsets of
 * softening. Returns false if no bond softens. */
bool bonds_any_softened_crack_carries_compression(const struct bonds *b, const struct particles *p,
                                                  const struct bond_limit *limit);

#endif
