/* `cleave bench circles`: declarations shared by its files. Bonds that soften beside the challenge problems of Kamarei,
 * Zeng, Dolbow & Lopez-Pamies (2025), "Nine circles of elastic brittle fracture". */
#ifndef CLEAVE_CIRCLES_BENCH
#define CLEAVE_CIRCLES_BENCH

#include "bench/common/bench.h"

/* Glass of the nine circles: Young's modulus [Pa], G_c [J/m^2], tensile strength [Pa]. */
#define CIRCLE_YOUNG 70e9
#define CIRCLE_TOUGHNESS 10.0
#define CIRCLE_STRENGTH 40e6

/* Horizon over the spacing [1], and the default of scenes. */
#define CIRCLE_HORIZON 3.015

struct circle_run;

/* A specimen. text: its scene, whose spacing is the variable h, or NULL, with `path` that of a shipped scene. from, to:
 * corners of the body [m]; radius: of a disc round the origin, 0: a box. turned: an override beside those of the list
 * for a body whose lattice is turned, or none. area: of the section through its middle [m^2]. measure:
 * returns the figure of a run in the unit of its case from the output in `folder`; NAN: none. */
struct circle_specimen {
    const char *name, *path, *text;
    double from[2], to[2], radius;
    struct scene_override turned;
    double area;
    double (*measure)(const char *folder, const struct circle_run *r);
};
enum circle_specimens {
    CIRCLE_STRIP,
    CIRCLE_DISC,
    CIRCLE_SQUARE,
    CIRCLE_CUBE,
    CIRCLE_NOTCH,
    CIRCLE_SHORT_NOTCH,
    CIRCLE_NOTCH_STEPS,
    CIRCLE_PURE_SHEAR,
    CIRCLE_CANTILEVER,
    CIRCLE_SPECIMENS
};
extern const struct circle_specimen circle_specimen[CIRCLE_SPECIMENS];

/* Largest number of spacings, of turned lattices, and of overrides of a case. */
enum { CIRCLE_SPACINGS = 4, CIRCLE_LATTICES = 2, CIRCLE_OVERRIDES = 2 };

/* A circle with an expected value; a found value may differ by `tolerance`. Both in `unit`. surface: softening starts
 * by a strength surface (strengths of 40 and 1000 MPa), else by the stretch. set: overrides of the scene. spacing,
 * turned: spacings of the lattices along the axes and of the turned ones [mm], the coarsest first, which is also run
 * with --quick; 0 ends the list. degrees: angles of the turned lattices, 0 ends the list. crack: length of the
 * pre-crack [mm] that has to be three horizons for the expected value to apply, 0: it always applies. horizon: largest
 * horizon over E G_c/strength^2 at which the expected value applies, 0: at any. why: reason for which there is no run,
 * or NULL.
 */
struct circle_case {
    const char *circle, *figure, *unit;
    double expected, tolerance;
    enum circle_specimens specimen;
    bool surface;
    struct scene_override set[CIRCLE_OVERRIDES];
    double spacing[CIRCLE_SPACINGS], turned[CIRCLE_SPACINGS];
    int degrees[CIRCLE_LATTICES];
    double crack, horizon;
    const char *why;
};
extern const struct circle_case circle_cases[];

/* Number of cases. */
extern const int circle_cases_count;

/* A run of a case. spacing [mm]; degrees: angle of its lattice; found: its figure. table: receives a line after the
 * run. */
struct circle_run {
    const struct circle_case *of;
    double spacing, found;
    int degrees;
    struct bench_table *table;
};

/* Returns "holds" or "MISSED" by the tolerance of the case, or "-" where its expected value does not apply. */
const char *circle_verdict(const struct circle_run *r);

/* Writes the particles of a body of the specimen to the file `path`, on a lattice that is turned by `degrees`; columns
 * x, y, volume. spacing [m]; the thickness is 1 mm. FAILED if the file cannot be written. */
status circle_list_write(const char *path, const struct circle_specimen *s, double spacing, int degrees);

#endif
