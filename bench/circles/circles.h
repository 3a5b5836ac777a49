/* `cleave bench circles`: declarations shared by its files. Bonds that soften beside the challenge problems of Kamarei,
 * Zeng, Dolbow & Lopez-Pamies (2025), "Nine circles of elastic brittle fracture". */
#ifndef CLEAVE_CIRCLES_BENCH
#define CLEAVE_CIRCLES_BENCH

#include "bench/common/bench.h"

/* Glass of the nine circles: Young's modulus [Pa], G_c [J/m^2], tensile strength [Pa]. */
#define CIRCLE_YOUNG 70e9
#define CIRCLE_TOUGHNESS 10.0
#define CIRCLE_STRENGTH 40e6

/* Horizon of the bonds [spacings], the default of scenes. */
#define CIRCLE_HORIZON 3.015

struct circle_run;

/* A specimen. name: in tables. text: its scene, in which the variable h is the spacing, or NULL; path: file of the
 * scene in inputs/ if `text` is NULL. from, to: corners of the body [m]; radius: of a disc around the origin [m], 0 for
 * a box. turned: a further override for runs with a rotated lattice, or none (key NULL). area: of the cross section
 * through the middle [m^2]. measure: returns the measured value of the run r from its output in `folder`, in the unit
 * of the case; NAN if there is none. */
struct circle_specimen {
    const char *name, *path, *text;
    double from[2], to[2], radius;
    struct scene_override turned;
    double loaded, area;
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

/* Largest number of spacings, of turned lattices, and of overrides of a case, of which the last is the load P of a
 * notched strip. */
enum { CIRCLE_SPACINGS = 3, CIRCLE_LATTICES = 2, CIRCLE_OVERRIDES = 2, CIRCLE_LOAD = CIRCLE_OVERRIDES - 1 };

/* A case: a problem of the nine circles with an expected value. circle, figure: names of the problem and of the
 * measured value. expected, tolerance: expected value and permitted deviation in `unit`. surface: true if bonds begin
 * to soften by a strength surface (strengths of 40 and 1000 MPa), false if by their stretch. set: overrides of the
 * scene. spacing, turned: spacings of lattices along the axes and of rotated ones [mm], ending with 0; the first, the
 * coarsest, of most cases also runs with --quick. degrees: angles of the rotated lattices, ending with 0. crack: length
 * of the pre-crack [mm]; the expected value applies only if it is at least three horizons; 0: it always applies.
 * horizon: largest horizon, divided by E G_c/strength^2, at which the expected value applies; 0: any. why: reason for
 * which there is no run, or NULL. */
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

/* Number of entries of the table circle_cases. */
extern const int circle_cases_count;

/* A run of a case. of: the case; spacing [mm]; found: measured value in the unit of the case, NAN until the run has
 * ended; degrees: angle of its lattice. table: receives a row after the run. */
struct circle_run {
    const struct circle_case *of;
    double spacing, section, found;
    int degrees;
    struct bench_table *table;
};

/* Returns true if the case c has runs, on lattices along the axes or on rotated ones. */
static inline bool circle_has_runs(const struct circle_case *c) { return c->spacing[0] > 0 || c->turned[0] > 0; }

/* Returns "holds" if the value measured in the run is within the tolerance of its case, else "MISSED"; "-" if the
 * expected value of the case does not apply to the run. */
const char *circle_verdict(const struct circle_run *run);

/* Sizes of a specimen on a turned lattice, relative to the nominal ones [1]. section: mean area of its cross sections;
 * layer: volume of its loaded layer, or 1 if the specimen has none. */
struct circle_list {
    double section, layer;
};

/* Fills the body of the specimen, with a thickness of 1 mm, with a lattice that is turned by `lattice_degrees` and has
 * the spacing `spacing` [m], and writes the particles as a CSV list with the columns x, y, volume to the file `path`.
 * middle_x: coordinate [m] that is half-way between rows of a lattice turned by 45 degrees. Stores the sizes of the
 * body in *body_sizes. Returns FAILED if the file cannot be written. */
status circle_write_particle_list(const char *path, const struct circle_specimen *specimen, double spacing,
                                  int lattice_degrees, double middle_x, struct circle_list *body_sizes);

#endif
