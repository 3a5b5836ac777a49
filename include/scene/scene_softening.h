/* The model of the families of a scene whose bonds soften. */
#ifndef CLEAVE_SCENE_SOFTENING
#define CLEAVE_SCENE_SOFTENING

#include "data/softening_states.h"
#include "scene/scene.h"

/* Returns the model of a family of material m in a scene: bond-based, or state-based with its moduli over E'. */
struct softening_model scene_softening_model(const struct scene *s, const struct material *m);

#define FREE_OF_TRAPPING 2 /* kappa from which on the lattice hardly holds cracks back; measured */

/* Returns the horizon [m] at which the softening law of material m has the ratio kappa = (critical stretch/onset
 * stretch)^2 [1]. Valid if m has an energy release rate. */
real scene_softening_horizon(const struct scene *s, const struct material *m, real kappa);

/* Returns the horizon [m] below which the strength surface of material m starts bonds in tension and in shear before
 * they soften by themselves. Valid if m has an energy release rate. */
real scene_surface_horizon(const struct scene *s, const struct material *m);

#endif
