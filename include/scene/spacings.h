/* Chooses particle spacings from the lengths in a scene: edges, gaps, cracks, radii and wavelengths. */
#ifndef CLEAVE_SPACINGS
#define CLEAVE_SPACINGS

#include "scene.h"

/* Returns the largest particle spacing between 3/4 `largest_spacing` and `largest_spacing` [m] that divides all lengths
 * of scene s into whole numbers: edges of boxes, and positions of gaps in them and of cracks along the axes. Only
 * bodies that begin with a box count. prefer_even_edge_counts: true to prefer even numbers along the edges of the first
 * body. If no spacing divides all lengths, returns one that divides the first body along x, or `largest_spacing` if it
 * is no box. */
real spacing_that_fits_box_edges(const struct scene *s, real largest_spacing, bool prefer_even_edge_counts);

/* Returns a spacing [m] at which each length that a solution must resolve has a few spacings: edges of bodies, radii,
 * cracks and their ligaments, pulses and wavelengths, contours of probes of stress-intensity factors. Returns 0 if the
 * scene s has no such length. */
real spacing_that_resolves_all_lengths(const struct scene *s);

#endif
