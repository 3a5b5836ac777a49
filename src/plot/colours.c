/* Defines the colour tables of pictures. Colours are distinguishable with any colour vision, and the lightness of
 * colour scales changes uniformly, so that they remain readable in grey. */
#include "plot/colours.h"

#include <math.h>
#include <string.h>

#include "base/base.h"

/* One support point of a colour scale: position `at` in the scale, 0 to 1, and its colour, with components 0 to 255. */
struct stop {
    double at, red, green, blue;
};

/* Every eighth colour of viridis (Smith & van der Walt 2015): position in 0..1; red, green, blue. */
static const struct stop sequential[] = {
    {0.000, 68, 1, 84},    {0.125, 71, 45, 123}, {0.250, 59, 82, 139},  {0.375, 44, 114, 142}, {0.500, 33, 145, 140},
    {0.625, 40, 174, 128}, {0.750, 94, 201, 98}, {0.875, 173, 220, 48}, {1.000, 253, 231, 37},
};

/* Diverging colours RdBu of ColorBrewer (Harrower & Brewer 2003), blue first. The middle colour is grey, to differ from
 * white paper. */
static const struct stop diverging[] = {
    {0.0, 5, 48, 97},     {0.1, 33, 102, 172},  {0.2, 67, 147, 195},  {0.3, 146, 197, 222},
    {0.4, 200, 217, 228}, {0.5, 226, 226, 226}, {0.6, 240, 209, 192}, {0.7, 244, 165, 130},
    {0.8, 214, 96, 77},   {0.9, 178, 24, 43},   {1.0, 103, 0, 31},
};
/* Ten evenly spaced colours of cividis (Nunez, Anderton & Renslow 2018), which appear similar with any colour
 * vision. */
static const struct stop cividis[] = {
    {0, 0, 34, 78},
    {0.111111, 18, 53, 112},
    {0.222222, 59, 73, 108},
    {0.333333, 87, 93, 109},
    {0.444444, 112, 113, 115},
    {0.555556, 138, 134, 120},
    {0.666667, 165, 156, 116},
    {0.777778, 195, 179, 105},
    {0.888889, 225, 204, 85},
    {1, 254, 232, 56},
};
/* Ten evenly spaced colours of inferno (Smith & van der Walt 2015). */
static const struct stop inferno[] = {
    {0, 0, 0, 4},
    {0.111111, 27, 12, 65},
    {0.222222, 74, 12, 107},
    {0.333333, 120, 28, 109},
    {0.444444, 165, 44, 96},
    {0.555556, 207, 68, 70},
    {0.666667, 237, 105, 37},
    {0.777778, 251, 155, 6},
    {0.888889, 247, 209, 61},
    {1, 252, 255, 164},
};
/* Ten evenly spaced colours of magma (Smith & van der Walt 2015). */
static const struct stop magma[] = {
    {0, 0, 0, 4},
    {0.111111, 24, 15, 61},
    {0.222222, 68, 15, 118},
    {0.333333, 114, 31, 129},
    {0.444444, 158, 47, 127},
    {0.555556, 205, 64, 113},
    {0.666667, 241, 96, 93},
    {0.777778, 253, 150, 104},
    {0.888889, 254, 202, 141},
    {1, 252, 253, 191},
};
/* Dark to light grey. */
static const struct stop grey[] = {{0, 20, 20, 20}, {1, 235, 235, 235}};
/* Colours of damage: grey where no bond is broken, then red. */
static const struct stop damage_stops[] = {
    {0.00, 226, 228, 231}, {0.12, 246, 220, 190}, {0.35, 240, 160, 110},
    {0.60, 214, 80, 62},   {0.80, 158, 24, 42},   {1.00, 84, 2, 24},
};
static const struct stop bond_stops[] = {
    {0.00, 158, 202, 233},
    {0.40, 74, 144, 204},
    {0.75, 22, 84, 158},
    {1.00, 6, 34, 86},
};

/* Returns the colour at the position `at` in 0..1 of a colour scale, interpolated linearly between its stops
 * stop[stops]. Smaller and larger positions get the colour of the nearer end, NAN that of the upper end. */
static struct colour along_stops(const struct stop *stop, int stops, double at)
{
    int k = 0;
    at = isfinite(at) ? fmin(fmax(at, 0), 1) : 1;
    while (k + 2 < stops && at > stop[k + 1].at) k++;
    const struct stop *a = &stop[k], *b = &stop[k + 1];
    double share = (at - a->at) / (b->at - a->at);
    return (struct colour){(uint8_t)lround(a->red + share * (b->red - a->red)),
                           (uint8_t)lround(a->green + share * (b->green - a->green)),
                           (uint8_t)lround(a->blue + share * (b->blue - a->blue)), 255};
}

struct colour colour_on_sequential_scale(double position)
{
    return along_stops(sequential, COUNT_OF(sequential), position);
}
struct colour colour_on_diverging_scale(double position)
{
    return along_stops(diverging, COUNT_OF(diverging), position);
}

struct colour colour_from_table(enum colour_table table, double position)
{
    switch (table) {
    case COLOURS_CIVIDIS:
        return along_stops(cividis, COUNT_OF(cividis), position);
    case COLOURS_INFERNO:
        return along_stops(inferno, COUNT_OF(inferno), position);
    case COLOURS_MAGMA:
        return along_stops(magma, COUNT_OF(magma), position);
    case COLOURS_GREY:
        return along_stops(grey, COUNT_OF(grey), position);
    case COLOURS_DIVERGING:
        return colour_on_diverging_scale(position);
    default:
        return colour_on_sequential_scale(position);
    }
}

struct colour colour_on_damage_scale(double position)
{
    return along_stops(damage_stops, COUNT_OF(damage_stops), position);
}
struct colour colour_on_peridynamic_particle_scale(double position)
{
    return along_stops(bond_stops, COUNT_OF(bond_stops), position);
}
struct colour colour_of_material_points(void) { return (struct colour){236, 233, 226, 255}; }

/* Returns the colour of the fragment with the number `fragment`: light grey for number 0, the heaviest one; one of nine
 * colours in turn for the others; nearly black for -1, which denotes particles without bonds. */
struct colour fragment_colour(int32_t fragment)
{
    static const struct colour turn[] = {{68, 119, 170, 255}, {238, 153, 51, 255},  {34, 136, 51, 255},
                                         {170, 51, 119, 255}, {102, 204, 238, 255}, {204, 68, 51, 255},
                                         {187, 187, 68, 255}, {119, 85, 170, 255},  {17, 119, 119, 255}};
    if (fragment < 0) return (struct colour){40, 40, 44, 255};
    if (fragment == 0) return (struct colour){212, 214, 217, 255};
    return turn[(size_t)(fragment - 1) % COUNT_OF(turn)];
}

/* Returns the k-th colour of a list of nine light colours that repeats (light qualitative scheme of Tol 2021). */
struct colour colour_of_material_or_body(int k)
{
    static const struct colour turn[] = {{187, 204, 220, 255}, {238, 221, 136, 255}, {187, 204, 51, 255},
                                         {238, 136, 102, 255}, {153, 221, 255, 255}, {255, 170, 187, 255},
                                         {68, 187, 153, 255},  {170, 170, 0, 255},   {190, 190, 190, 255}};
    return turn[(size_t)k % COUNT_OF(turn)];
}

struct colour colour_mixed_with_white(struct colour c, double colour_weight)
{
    return (struct colour){(uint8_t)lround(255 - colour_weight * (255 - c.red)),
                           (uint8_t)lround(255 - colour_weight * (255 - c.green)),
                           (uint8_t)lround(255 - colour_weight * (255 - c.blue)), c.alpha};
}

struct colour colour_mixed_with_black(struct colour c, double colour_weight)
{
    return (struct colour){(uint8_t)lround(colour_weight * c.red), (uint8_t)lround(colour_weight * c.green),
                           (uint8_t)lround(colour_weight * c.blue), c.alpha};
}
