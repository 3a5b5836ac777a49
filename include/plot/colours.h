/* Colours of all pictures: one table for each purpose. */
#ifndef CLEAVE_COLOURS
#define CLEAVE_COLOURS

#include <stdbool.h>
#include <stdint.h>

struct colour {
    uint8_t red, green, blue, alpha;
};

/* `at` from 0 to 1, else the nearer end; not finite: 1. */
struct colour colour_sequential(double at); /* dark to light, evenly in lightness */
struct colour colour_diverging(double at);  /* blue, grey in the middle, red: of signed quantities */
struct colour colour_damage(double at);
struct colour colour_bonds(double at); /* damage of peridynamic particles beside material points */
struct colour colour_points(void);     /* material points */

/* Of a fragment by its number; -1: single particles. */
struct colour fragment_colour(int32_t fragment);
/* Of the k-th material or body: light, so that marks show on it. */
struct colour part_colour(int k);

/* `share` 1: the colour as it is; 0: white. */
struct colour colour_faded(struct colour c, double share);
/* `share` 1: the colour as it is; 0: black. */
struct colour colour_shaded(struct colour c, double share);

#endif
