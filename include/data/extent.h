/* Text on the extent of the bodies of a run, for messages about positions at which there is no particle. */
#ifndef CLEAVE_EXTENT
#define CLEAVE_EXTENT

#include "data/particles.h"

/* Text on the extent of all particles, returned by value. */
struct extent_text {
    char text[240];
};

/* Returns the text "the particles are between (..) and (..) m" with two corners: those of the smallest box round the
 * reference positions of all particles of p. */
struct extent_text particles_describe_bounding_box(const struct particles *p);

/* Returns the text "; the body is .. m from the origin, .. times its size, and ..: move it to the origin" if the
 * particles of p are so far from the origin that round-off of their positions limits the accuracy of solvers, else
 * "". */
struct extent_text particles_warning_text_if_far_from_origin(const struct particles *p);

#endif
