/* Where the bodies of a run are, as text for messages about places that hold no particle. */
#ifndef CLEAVE_EXTENT
#define CLEAVE_EXTENT

#include "data/particles.h"

/* Text of an extent, returned by value. */
struct extent_text {
    char text[240];
};

/* Returns "the particles are between (..) and (..) m": the corners of the box around the reference positions of all
 * particles. */
struct extent_text particles_extent_text(const struct particles *p);

#endif
