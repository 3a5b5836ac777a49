/* Creates the particles of a scene: positions, volumes, masses, materials; bonds, grids and loads follow later. */
#ifndef CLEAVE_FILL
#define CLEAVE_FILL

#include "data/hollow.h"
#include "data/particles.h"
#include "scene.h"

/* Largest distance from the origin at which doubles resolve strains [spacings]: a coordinate is rounded by 1e-9 of a
 * spacing there, which is 1e-5 of a strain of 1e-4. At ten thousand times this distance stresses are 3 % off. */
#define FILL_FARTHEST 1e7

/* Creates the particles of all bodies of s, from lattices and particle lists, and sets their positions, volumes, masses
 * and initial state. optional: sum of WITH_*, the optional arrays of p. hollow: cells without particles, NULL if there
 * are none; the ids of their particles stay unused. The caller owns p. REFUSED for an empty body, an unreadable list,
 * a list in another length unit than the spacing, and two particles at one position; p is empty in these cases. */
status fill_particles(struct particles *p, const struct scene *s, const struct hollow *hollow, int optional);

/* Writes the position of one lattice site of a body to X [dim, m]. The body must not come from a particle list. */
status fill_lattice_site(const struct scene *s, int body, real *X);

/* Marks in hollow->whole [cells of hollow->box] the cells all of whose lattice sites are inside the body. The caller
 * sets hollow->box and frees hollow->whole. */
void fill_mark_whole_cells(struct hollow *hollow, const struct scene *s, int body);

/* Compares the distances between particles of each list with the spacing (fill_lists.c). REFUSED if they differ so much
 * that the list must be in another length unit, or if the bonds would exceed any memory. */
status fill_check_lists(const struct particles *p, const struct scene *s);

/* Sets the strength factor of each particle [1] (fill_strength.c): random where the strength of its material scatters,
 * else 1. Does nothing if p->strength is NULL. */
void fill_strength(struct particles *p, const struct scene *s);

#endif
