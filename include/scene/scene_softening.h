/* Computes the stretches at which bonds of a scene soften and break, and the horizons that this requires. */
#ifndef CLEAVE_SCENE_SOFTENING
#define CLEAVE_SCENE_SOFTENING

#include "bonds/family.h"
#include "data/softening_states.h"
#include "scene/scene.h"

/* Returns the complete neighbourhood of a particle (all neighbours within the horizon) on the lattice of the scene s,
 * with the horizon and the weights of bonds (factors on their forces). */
struct family scene_make_complete_lattice_family(const struct scene *s);

/* Returns the peridynamic model of the bonds of material m in scene s: bond-based, or state-based with its moduli
 * divided by the modulus E' of uniaxial tension. */
struct softening_model scene_softening_model_of_bonds(const struct scene *s, const struct material *m);

/* Returns the critical stretch [1] of bonds between the materials a and b of scene s. It is chosen such that a crack
 * between them releases the energy of the weaker material; the stiffness of a bond is that of its two halves in series
 * in the bond-based model, their mean in state-based models. If a material yields, returns the smaller of the two
 * critical stretches. */
real scene_critical_stretch_between_materials(const struct scene *s, const struct material *a,
                                              const struct material *b);

#define FREE_OF_TRAPPING 2 /* squared stretch ratio (below) above which the lattice hardly impedes cracks; measured */

/* Returns the horizon [m] with which bonds of material m of scene s have the given squared_stretch_ratio = (critical
 * stretch/stretch at which softening begins)^2. With smaller horizons the ratio is larger. The material must have an
 * energy release rate and a tensile strength. */
real scene_horizon_for_failure_to_onset_stretch_ratio(const struct scene *s, const struct material *m,
                                                      real squared_stretch_ratio);

/* Returns the horizon [m] below which bonds of material m of scene s begin to soften, in tension and in shear, because
 * the stress reaches the strength surface. With larger horizons they begin to soften earlier, by their own stretch. The
 * material must have an energy release rate. */
real scene_largest_horizon_for_strength_surface(const struct scene *s, const struct material *m);

/* Returns the radius [m] within which strains are averaged for the strength surface of material m of scene s: the
 * horizon times sqrt(n + 0.3), where n is the number of successive averages over neighbourhoods. */
real scene_strength_surface_averaging_radius(const struct scene *s, const struct material *m);

#endif
