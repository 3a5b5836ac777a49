/* Fracture specimens in linear elastic fracture mechanics: closed forms (handbook.c). */
#ifndef CLEAVE_BENCH_HANDBOOK
#define CLEAVE_BENCH_HANDBOOK

enum specimen_kind {
    COMPACT_TENSION,     /* pulled at its pins; crack and width from their line (ASTM E399) */
    EDGE_CRACK_IN_GRIPS, /* single-edge-notched plate between grips that do not turn */
    DOUBLE_CANTILEVER,   /* crack from the line of its loads */
    THREE_POINT_BEND     /* edge crack opposite to the middle roller, span of four widths (ASTM E399) */
};
struct specimen {
    enum specimen_kind kind;
    double width;               /* W; of cantilevers the height of an arm [m] */
    double length;              /* between grips; span [m] */
    double thickness;           /* [m] */
    double crack;               /* at the start [m] */
    double modulus;             /* E in plane stress, E/(1 - nu^2) in plane strain [Pa] */
    double energy_release_rate; /* of the material [J/m^2] */
};

/* The load under which a crack of length a releases the material's energy release rate [N]; 3 % off at most for a/W
 * between 0.2 and 0.8, 0.5 % in the formulas of ASTM. */
double specimen_load(const struct specimen *s, double a);

/* A beam on two supports 160 mm apart, 40 mm high, pressed in the middle, with a notch of 16 mm 31.75 mm beside it:
 * angle of the chord from the notch to the tip of a crack that has grown so far to that tip [m], against the notch
 * [degree]; NAN beyond 20 mm. */
double bend_chord(double length);

#endif
