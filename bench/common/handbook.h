/* Fracture specimens in linear elastic fracture mechanics: closed forms (handbook.c). */
#ifndef CLEAVE_BENCH_HANDBOOK
#define CLEAVE_BENCH_HANDBOOK

/* Kinds of specimens with a crack for which handbooks state the stress-intensity factor. */
enum specimen_kind {
    COMPACT_TENSION,     /* loaded at its pins; crack and width are measured from the line of the pins (ASTM E399) */
    EDGE_CRACK_IN_GRIPS, /* single-edge-notched plate between grips that do not rotate */
    DOUBLE_CANTILEVER,   /* crack measured from the line of the loads */
    THREE_POINT_BEND     /* edge crack opposite to the middle roller, span of four widths (ASTM E399) */
};

/* A specimen with a crack: its kind, its dimensions and its material. */
struct specimen {
    enum specimen_kind kind;
    double width;               /* width W; for double cantilevers the height of an arm [m] */
    double length;              /* distance of the grips; span [m] */
    double thickness;           /* [m] */
    double crack;               /* initial length of the crack [m] */
    double modulus;             /* E in plane stress, E/(1 - nu^2) in plane strain [Pa] */
    double energy_release_rate; /* of the material [J/m^2] */
};

/* Returns the load [N] at which a crack of length `crack_length` [m] in the specimen s has the energy release rate
 * s->energy_release_rate of its material. The error of the formulas is at most 3 % if the ratio of `crack_length` to
 * s->width is between 0.2 and 0.8, and 0.5 % for those of ASTM. */
double specimen_load_at_crack_growth(const struct specimen *s, double crack_length);

/* Returns the angle between the pre-crack and the straight line from its end to the crack tip [degree], for a beam in
 * three-point bending with an eccentric notch: span 160 mm, height 40 mm, notch of 16 mm at 31.75 mm from the middle.
 * chord_length: length of that line [m]. Returns NAN if it is more than 20 mm. */
double bend_crack_chord_angle(double chord_length);

#endif
