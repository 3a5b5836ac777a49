/* The particles of a scene, before anything is known of bonds, grids or loads. */
#ifndef CLEAVE_FILL
#define CLEAVE_FILL

#include "data/hollow.h"
#include "data/particles.h"
#include "scene.h"

/* Largest distance from the origin at which doubles resolve strains [spacings]: a coordinate is rounded by 1e-9 of a
 * spacing there, which is 1e-5 of a strain of 1e-4. At ten thousand times this distance stresses are 3 % off. */
#define FILL_FARTHEST 1e7

/* Positions, volumes, masses and the initial state, from lattices and lists; `optional` is a sum of WITH_*. REFUSED:
 * empty bodies, unreadable lists, lists in another unit than the spacing, two particles in one place; nothing is
 * left to free then. Those of cells that are absent in `hollow` (NULL: none) are not made, but have their ids. */
status fill_particles(struct particles *p, const struct scene *s, const struct hollow *hollow, int optional);
/* A place of the lattice of a body that is no list [m]. */
status fill_place(const struct scene *s, int body, real *X);
/* Finds the cells of a box that lie wholly in a body: places are those of its lattice. `hollow` has its box; the caller
 * frees `whole`. */
void fill_whole(struct hollow *hollow, const struct scene *s, int body);
/* Part of it (fill_lists.c): REFUSED where particles of a list are so far apart, or so close, that its unit is not
 * that of the spacing, or so many bonds would come of it that no memory holds them. */
status fill_check_lists(const struct particles *p, const struct scene *s);
/* Part of it (fill_strength.c): factors of materials whose strength scatters, 1 elsewhere. */
void fill_strength(struct particles *p, const struct scene *s);

#endif
