/* Crack energy per area. */
#ifndef CLEAVE_TOUGHNESS
#define CLEAVE_TOUGHNESS

#include "bonds/family.h"
#include "scene/scene.h"

/* Returns the crack energy per area of a material [J/m^2]: of bond-based models the energy of the bonds that cross a
 * plane of the lattice, each at its critical stretch; of state-based models G_c of the material. */
real toughness_of(const struct family *family, enum model model, const struct material *m);

/* Returns the crack energy per area between particles i and j [J/m^2]: that of their material or, for two materials,
 * of the interface, or else of the weaker material; times the square of the strength of the bond where strength
 * scatters. */
real toughness_between(const struct scene *s, const struct bond_source *source, const struct particles *p, int64_t i,
                       int64_t j);

/* Returns the work that stretches a bond from zero force to the elastic stretch `elastic` beyond its plastic stretch,
 * divided by its stiffness and length [1]. The force grows linearly with the stretch up to `yield` [1] (INFINITY: the
 * bond does not yield), then with the slope h/(1 + h), where h = `hardening` is the ratio of plastic modulus and
 * stiffness [1], as in a bar with linear isotropic hardening (Simo & Hughes 1998, section 1.2). */
real stretch_work(real elastic, real yield, real hardening);

#endif
