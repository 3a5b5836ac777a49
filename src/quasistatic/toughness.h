/* Energy that a crack takes per area. */
#ifndef CLEAVE_TOUGHNESS
#define CLEAVE_TOUGHNESS

#include "bonds/family.h"
#include "scene/scene.h"

/* Returns the energy per area that a crack in a material takes [J/m^2]: of bonds at their limits, in state-based models
 * G_c as given. */
real toughness_of(const struct family *family, enum model model, const struct material *m);

/* Returns the energy per area that a crack between particles i and j takes [J/m^2]: of bonds at their limits, in
 * state-based models G_c as given, between materials that of the interface; scaled where strength scatters. */
real toughness_between(const struct scene *s, const struct bond_source *source, const struct particles *p, int64_t i,
                       int64_t j);

/* Returns the work on a bond up to a stretch `elastic` beyond its plastic stretch, over its stiffness and length [1]:
 * the integral of force over stiffness by the stretch. The force grows with the stretch up to `yield` [1], then with
 * the slope h/(1 + h), h = `hardening`: plastic modulus over stiffness [1], as in a bar with linear isotropic hardening
 * (Simo & Hughes 1998, 1.2). yield: INFINITY for a bond that does not yield. */
real stretch_work(real elastic, real yield, real hardening);

#endif
