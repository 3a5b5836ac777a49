/* Colours of all pictures: tables of colours for fields, and colours of kinds, fragments and bodies. */
#ifndef CLEAVE_COLOURS
#define CLEAVE_COLOURS

#include <stdbool.h>
#include <stdint.h>

/* Colour with 8 bits per channel; alpha 255 is opaque. */
struct colour {
    uint8_t red, green, blue, alpha;
};

/* Tables of colours for fields, in the order of their names in COLOUR_TABLE_WORDS. COLOURS_USUAL: viridis, for signed
 * quantities the diverging table; COLOUR_TABLES: number of tables. */
enum colour_table {
    COLOURS_USUAL,
    COLOURS_VIRIDIS,
    COLOURS_CIVIDIS,
    COLOURS_INFERNO,
    COLOURS_MAGMA,
    COLOURS_GREY,
    COLOURS_DIVERGING,
    COLOUR_TABLES
};
/* Names of the tables of colours, as the user writes them, separated by |. */
#define COLOUR_TABLE_WORDS "usual|viridis|cividis|inferno|magma|grey|diverging"

/* Returns the colour at `position` in 0 .. 1 of the colour table `table`. Smaller and larger values are treated as 0
 * and 1, NaN and infinity as 1. */
struct colour colour_from_table(enum colour_table table, double position);

/* Returns a colour of the sequential scale, which goes from dark at 0 to light at 1 with uniformly increasing
 * lightness. position: position on the scale, 0 .. 1. Smaller and larger values are treated as 0 and 1, NaN and
 * infinity as 1. */
struct colour colour_on_sequential_scale(double position);

/* Returns a colour of the diverging scale for signed quantities: blue at 0, grey at 0.5, red at 1. position: position
 * on the scale, 0 .. 1. Smaller and larger values are treated as 0 and 1, NaN and infinity as 1. */
struct colour colour_on_diverging_scale(double position);

/* Returns a colour of the scale for damage: grey at 0, then orange, dark red at 1. position: position on the scale, 0
 * .. 1. Smaller and larger values are treated as 0 and 1, NaN and infinity as 1. */
struct colour colour_on_damage_scale(double position);

/* Returns the colour of a peridynamic particle in maps of the particle kind. It goes from light blue at 0 to dark blue
 * at 1. position: position on this scale, 0 .. 1, which depends on the damage of the particle. Smaller and larger
 * values are treated as 0 and 1, NaN and infinity as 1. */
struct colour colour_on_peridynamic_particle_scale(double position);

/* Returns the colour of material points in maps of the kind of particles (MAP_KIND), which distinguish them from
 * peridynamic particles. */
struct colour colour_of_material_points(void);

/* Returns the colour of the fragment with the index `fragment`, 0 for the heaviest one. -1 denotes particles without
 * bonds, which belong to no fragment and have a colour of their own. */
struct colour fragment_colour(int32_t fragment);

/* Returns the colour of the material or body with the index `index` >= 0. The colours are light, so that symbols drawn
 * on top are visible, and repeat after nine. */
struct colour colour_of_material_or_body(int index);

/* Returns the mixture of the colour c with white. colour_weight: weight of c, from 0 for white to 1 for c. */
struct colour colour_mixed_with_white(struct colour c, double colour_weight);

/* Returns the mixture of the colour c with black. colour_weight: weight of c, from 0 for black to 1 for c. */
struct colour colour_mixed_with_black(struct colour c, double colour_weight);

#endif
