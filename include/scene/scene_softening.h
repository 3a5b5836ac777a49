/* The model of the families of a scene whose bonds soften. */
#ifndef CLEAVE_SCENE_SOFTENING
#define CLEAVE_SCENE_SOFTENING

#include "data/softening_states.h"
#include "scene/scene.h"

/* Returns the model of a family of material m in a scene: bond-based, or state-based with its moduli over E'. */
struct softening_model scene_softening_model(const struct scene *s, const struct material *m);

#endif
