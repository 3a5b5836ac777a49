/* Chooses spacings from the lengths of a scene. */
#ifndef CLEAVE_SPACINGS
#define CLEAVE_SPACINGS

#include "scene.h"

/* Returns the largest particle spacing between 3/4 `largest` and `largest` [m] at which a lattice fits the bodies that
 * begin with a box: the edges of the boxes, and the positions of gaps and of cracks along the axes in them, are whole
 * numbers of spacings, with `even_edges` the edges of the first box even numbers. If there is none, only the edge of
 * the first box along x is fitted; without such a box, `largest` is returned. */
real spacing_that_fits_lattice(const struct scene *s, real largest, bool even_edges);

/* Returns a spacing [m] at which each length that a solution must resolve has a few spacings, or 0 if the scene has no
 * such length: edges of bodies, radii, cracks and their ligaments, pulses and wavelengths, rings of sif probes. */
real spacing_that_resolves(const struct scene *s);

#endif
