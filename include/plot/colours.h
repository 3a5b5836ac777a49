/* Colour tables of all pictures. */
#ifndef CLEAVE_COLOURS
#define CLEAVE_COLOURS

#include <stdbool.h>
#include <stdint.h>

/* Colour with 8 bits per channel; alpha 255 is opaque. */
struct colour {
    uint8_t red, green, blue, alpha;
};

/* Returns a colour of a scale for `at` in 0 .. 1; values outside are clamped, NaN and infinity count as 1. Sequential
 * scale: dark to light, with uniformly increasing lightness. */
struct colour colour_sequential(double at);

/* Returns a colour of a diverging scale for signed quantities: blue, grey at 0.5, red. at: as for colour_sequential. */
struct colour colour_diverging(double at);

/* Returns a colour of the damage scale: grey, orange, dark red. at: damage [1], as for colour_sequential. */
struct colour colour_damage(double at);

/* Returns the colour of a peridynamic particle in maps of the particle kind: light to dark blue with damage. at:
 * damage [1], as for colour_sequential. */
struct colour colour_bonds(double at);

/* Returns the colour of material points in maps of the particle kind. */
struct colour colour_points(void);

/* Returns the colour of a fragment by its index; -1: particles without bonds. */
struct colour fragment_colour(int32_t fragment);

/* Returns the colour of material or body k: light, so that marks drawn over it are visible. Colours repeat. */
struct colour part_colour(int k);

/* Mixes a colour with white. share: 1 returns c, 0 white. */
struct colour colour_faded(struct colour c, double share);

/* Mixes a colour with black. share: 1 returns c, 0 black. */
struct colour colour_shaded(struct colour c, double share);

#endif
