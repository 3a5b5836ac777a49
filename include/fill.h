/* floor 4: the particles of a scene, before anything is known of bonds, grids or loads. */
#ifndef CLEAVE_FILL_H
#define CLEAVE_FILL_H

#include "particles.h"
#include "scene.h"

/* Positions, volumes, masses and the initial state, from lattices and lists; `optional` is a sum of WITH_*. REFUSED:
 * empty bodies, unreadable lists, two particles in one place; nothing is left to free then. */
status fill_particles(struct particles *p, const struct scene *s, int optional);

#endif
