/* Loads of fracture specimens in linear elastic fracture mechanics. */
#include <math.h>

#include "handbook.h"

static const double pi = 3.14159265358979323846;

/* Returns the factor f(x) of a compact-tension specimen of thickness B under the load P, K = P f/(B W^(1/2)) (ASTM
 * E399-20, A4.5). x = a/W: crack length over width. */
static double compact_tension(double x)
{
    return (2 + x) * (0.886 + 4.64 * x - 13.32 * x * x + 14.72 * x * x * x - 5.6 * x * x * x * x) / pow(1 - x, 1.5);
}

/* Returns the factor f(x) of a three-point bend specimen of thickness B and span S = 4 W under the load P, K = P S
 * f/(B W^(3/2)) (ASTM E399-20, A3.5). x = a/W: crack length over width. */
static double three_point_bend(double x)
{
    return 3 * sqrt(x) * (1.99 - x * (1 - x) * (2.15 - 3.93 * x + 2.7 * x * x)) / (2 * (1 + 2 * x) * pow(1 - x, 1.5));
}

/* Returns the factor F(x) of an edge crack in tension, K = stress (pi a)^(1/2) F, accurate to 0.5 % (Tada, Paris &
 * Irwin 2000, 2.10). x = a/W: crack length over width. */
static double edge_tension(double x)
{
    const double t = 0.5 * pi * x;
    return sqrt(tan(t) / t) * (0.752 + 2.02 * x + 0.37 * pow(1 - sin(t), 3)) / cos(t);
}

/* Returns the factor F(x) of an edge crack in pure bending, K = stress (pi a)^(1/2) F (Tada, Paris & Irwin 2000, 2.13).
 * x = a/W: crack length over width. */
static double edge_bending(double x)
{
    const double t = 0.5 * pi * x;
    return sqrt(tan(t) / t) * (0.923 + 0.199 * pow(1 - sin(t), 4)) / cos(t);
}

/* Returns the factor F(x) of an edge crack between grips that do not rotate, K = force/(B W) (pi a)^(1/2) F, with crack
 * length a, width W and thickness B. x = a/W; slenderness: H/W with the distance H of the grips. The grips exert a
 * moment that cancels the rotation caused by the crack. Both rotations follow from the energy of the crack
 * (Castigliano). */
static double edge_in_grips(double x, double slenderness)
{
    enum { PARTS = 400 };
    double both = 0, bending = 0;
    for (int k = 0; k < PARTS; k++) {
        const double y = (k + 0.5) * x / PARTS;
        both += y * edge_tension(y) * edge_bending(y) * x / PARTS;
        bending += y * edge_bending(y) * edge_bending(y) * x / PARTS;
    }
    return edge_tension(x) - 6 * pi * both / (slenderness + 6 * pi * bending) * edge_bending(x);
}

double specimen_load_at_crack_growth(const struct specimen *s, double crack_length)
{
    const double K = sqrt(s->modulus * s->energy_release_rate), x = crack_length / s->width;
    switch (s->kind) {
    case COMPACT_TENSION:
        return K * s->thickness * sqrt(s->width) / compact_tension(x);
    case EDGE_CRACK_IN_GRIPS:
        return K * s->thickness * s->width / (sqrt(pi * crack_length) * edge_in_grips(x, s->length / s->width));
    case THREE_POINT_BEND:
        return K * s->thickness * pow(s->width, 1.5) / (s->length * three_point_bend(x));
    case DOUBLE_CANTILEVER:
        break; /* beams on an elastic foundation, the body ahead of the crack (Fichter 1983) */
    }
    return s->thickness * K * sqrt(pow(s->width, 3) / 12) / (crack_length + 0.673 * s->width);
}

/* Angle between the pre-crack and the line from its end to the crack tip, after increments of 2 mm in the direction
 * of the largest hoop stress [degree]. The stress-intensity factors are from quadratic finite elements of 0.1 mm at
 * the tip; for a central notch these deviate by 0.4 % from ASTM E399. */
static const double chord_step = 2e-3, chord[] = {14.66, 15.0, 15.13, 15.12, 15.0, 14.77, 14.44, 14.01, 13.49, 12.88};

double bend_crack_chord_angle(double chord_length)
{
    enum { CHORDS = sizeof chord / sizeof *chord };
    const double at = chord_length / chord_step - 1;
    if (at > CHORDS - 1 + 1e-9) return NAN;
    const int k = at <= 0 ? 0 : at >= CHORDS - 1 ? CHORDS - 2 : (int)at;
    return at <= 0 ? chord[0] : chord[k] + (at - k) * (chord[k + 1] - chord[k]);
}
