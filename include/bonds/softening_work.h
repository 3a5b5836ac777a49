/* Work of separation of a lattice whose state-based bonds soften, or break without rotations of particles. */
#ifndef CLEAVE_SOFTENING_WORK
#define CLEAVE_SOFTENING_WORK

#include "bonds/family.h"
#include "data/softening_states.h"

/* Returns G/s_c^2 [N/m] in the ordinary state-based model, with the work G per area that separates the two halves of a
 * lattice along a plane and the stretch s_c at which bonds break (separation.c). f: family of the lattice; modulus:
 * moduli of the material; intact_bonds_only: true if the weighted volume Q is summed over the unbroken bonds of a
 * family, false over all. */
real family_ordinary_fracture_energy_over_stretch_squared(const struct family *f, const struct state_modulus *modulus,
                                                          bool intact_bonds_only);

/* Returns the work per area that separates two halves of an infinite lattice [J/m^2], by quadrature over the distance
 * between the halves (separation.c). Bonds soften by `curve` from the stretch softening_stretches.onset on and break at
 * softening_stretches.end; the weighted volumes of families stay those without softening. f: family of the lattice;
 * modulus: moduli of the material; particles_rotate: true for the model with particle rotations. */
real family_fracture_energy_of_softening_bonds(const struct family *f, const struct state_modulus *modulus,
                                               bool particles_rotate, const struct softening_curve *curve,
                                               struct softening_range softening_stretches);

#endif
