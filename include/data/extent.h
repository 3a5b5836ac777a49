/* Text on the extent of the bodies of a run, for messages about positions at which there is no particle. */
#ifndef CLEAVE_EXTENT
#define CLEAVE_EXTENT

#include "data/particles.h"

/* Text on the extent of all particles, returned by value. */
struct extent_text {
    char text[240];
};

/* Returns "the particles are between (..) and (..) m": the corners of the box around the reference positions of all
 * particles. */
struct extent_text particles_extent_text(const struct particles *p);

#endif
