/* Work of separation of a lattice whose state-based bonds soften. */
#ifndef CLEAVE_SOFTENING_WORK
#define CLEAVE_SOFTENING_WORK

#include "bonds/family.h"
#include "data/softening_states.h"

/* Returns the work per area [J/m^2] that separates two halves of an infinite lattice, by quadrature over the distance
 * between the halves (separation.c). Bonds soften as the curve `curve` describes from the stretch
 * softening_stretches.onset on and break at softening_stretches.end; the weighted volumes of neighbourhoods stay those
 * without softening. f: neighbourhood of the lattice; modulus: moduli of the material; particles_rotate: true for the
 * modified state-based model, in which particles rotate. */
real family_fracture_energy_of_softening_bonds(const struct family *f, const struct state_modulus *modulus,
                                               bool particles_rotate, const struct softening_curve *curve,
                                               struct softening_range softening_stretches);

#endif
