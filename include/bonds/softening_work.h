/* Work of separation of a lattice whose state-based bonds soften. */
#ifndef CLEAVE_SOFTENING_WORK
#define CLEAVE_SOFTENING_WORK

#include "bonds/family.h"
#include "data/softening_states.h"

/* Returns the work per area that moves two halves of a full lattice apart whose bonds soften from `range.onset` to
 * `range.end` [J/m^2], by quadrature over the opening (separation.c). modulus: moduli of the material; rotates: true
 * for the model with particle rotations. Weighted volumes are those of the intact families. */
real family_softening_work_per_area(const struct family *f, const struct state_modulus *modulus, bool rotates,
                                    const struct softening_curve *curve, struct softening_range range);

#endif
