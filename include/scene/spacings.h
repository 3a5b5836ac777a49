/* Chooses spacings from the lengths of a scene. */
#ifndef CLEAVE_SPACINGS
#define CLEAVE_SPACINGS

#include "scene.h"

/* Returns the largest particle spacing between 3/4 `largest_spacing` and `largest_spacing` [m] for which the edges of
 * boxes of scene s, and the positions of gaps in them and of cracks along the axes, are whole numbers of spacings. Only
 * bodies that begin with a box are considered. even_edge_counts: true if the edges of the first box must be even
 * numbers of spacings. If there is no such spacing, it fits only the edge of the first box along x; without such a box,
 * returns `largest_spacing`. */
real spacing_that_fits_box_edges(const struct scene *s, real largest_spacing, bool even_edge_counts);

/* Returns a spacing [m] at which each length that a solution must resolve has a few spacings: edges of bodies, radii,
 * cracks and their ligaments, pulses and wavelengths, contours of probes of stress-intensity factors. Returns 0 if the
 * scene s has no such length. */
real spacing_that_resolves_all_lengths(const struct scene *s);

#endif
