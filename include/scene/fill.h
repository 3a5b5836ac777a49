/* The particles of a scene, before anything is known of bonds, grids or loads. */
#ifndef CLEAVE_FILL
#define CLEAVE_FILL

#include "data/particles.h"
#include "scene.h"

/* Largest distance from the origin at which doubles resolve strains [spacings]: a coordinate is rounded by 1e-9 of a
 * spacing there, which is 1e-5 of a strain of 1e-4. At ten thousand times this distance stresses are 3 % off. */
#define FILL_FARTHEST 1e7

/* Positions, volumes, masses and the initial state, from lattices and lists; `optional` is a sum of WITH_*. REFUSED:
 * empty bodies, unreadable lists, lists in another unit than the spacing, two particles in one place; nothing is
 * left to free then. */
status fill_particles(struct particles *p, const struct scene *s, int optional);
/* Part of it (fill_lists.c): REFUSED where particles of a list are so far apart, or so close, that its unit is not
 * that of the spacing, or so many bonds would come of it that no memory holds them. */
status fill_check_lists(const struct particles *p, const struct scene *s);

#endif
