/* Chooses spacings from the lengths of a scene. */
#ifndef CLEAVE_SPACINGS
#define CLEAVE_SPACINGS

#include "scene.h"

/* Returns the largest spacing [m] between 3/4 h and h that divides the edges of the boxes that bodies begin with, and
 * the positions of gaps and of cracks along the axes in them, into whole numbers, and with `even` the edges of the
 * first box into even numbers. If there is none, the edge of the first box along x alone counts; h if there is no such
 * box. */
real spacing_fit(const struct scene *s, real h, bool even);

/* Returns a spacing [m] at which each length that a solution must resolve has a few spacings, or 0 if the scene has no
 * such length: edges of bodies, radii, cracks and their ligaments, pulses and wavelengths, rings of sif probes. */
real spacing_that_resolves(const struct scene *s);

#endif
