/* The model of the families of a scene whose bonds soften. */
#ifndef CLEAVE_SCENE_SOFTENING
#define CLEAVE_SCENE_SOFTENING

#include "data/softening_states.h"
#include "scene/scene.h"

/* Returns the peridynamic model of families of material m in the scene: bond-based, or state-based with its moduli over
 * the modulus E' of uniaxial tension. */
struct softening_model scene_softening_model(const struct scene *s, const struct material *m);

#define FREE_OF_TRAPPING 2 /* kappa above which the lattice hardly impedes cracks; measured */

/* Returns the horizon at which bonds of material m have the given ratio kappa = (critical stretch/stretch at which
 * softening begins)^2 [1], in metres. Valid if m has an energy release rate. */
real scene_softening_horizon(const struct scene *s, const struct material *m, real kappa);

/* Returns the horizon [m] below which the strength surface of material m starts the softening of bonds in tension and
 * in shear, before their stretch does. Valid if m has an energy release rate. */
real scene_surface_horizon(const struct scene *s, const struct material *m);

#endif
