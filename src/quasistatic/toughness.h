/* Declares the energy per area of a crack through a material or between two particles, for load steps. */
#ifndef CLEAVE_TOUGHNESS
#define CLEAVE_TOUGHNESS

#include "bonds/family.h"
#include "scene/scene.h"

/* Returns the crack energy per area of the material m [J/m^2]. For a bond-based `model` it is the energy per area of
 * all bonds that cross a plane of the lattice, each at its critical stretch; for state-based models the fracture energy
 * G_c of the material. family: rules that select the neighbours of a particle and the weights of its bonds (factors on
 * their stiffness). */
real toughness_of_material(const struct family *family, enum model model, const struct material *m);

/* Returns the crack energy per area [J/m^2] between the particles `particle` and `other_particle` of p: that of their
 * common material; for two materials that of their interface if scene s (the input file) defines it, else that of the
 * weaker material. Where the strength of bonds is random, the value is multiplied by the square of the relative
 * strength of the bond between these particles. bond_source: inputs of the bonds (horizon, materials, cracks, mirrors).
 */
real toughness_between_particles(const struct scene *s, const struct bond_source *bond_source,
                                 const struct particles *p, int64_t particle, int64_t other_particle);

/* Returns the work that stretches a bond from zero force by the elastic stretch `elastic_stretch` beyond its plastic
 * stretch, divided by the stiffness and length of the bond [1]. The force grows linearly up to the stretch
 * `yield_stretch` [1] (INFINITY: the bond does not yield), then with the slope h/(1 + h), where h = `hardening_ratio`
 * is the ratio of plastic modulus to stiffness [1], as in a bar with linear isotropic hardening (Simo & Hughes 1998,
 * section 1.2). */
real bond_normalised_work_to_elastic_stretch(real elastic_stretch, real yield_stretch, real hardening_ratio);

#endif
