/* `cleave bench laws`: declarations shared by its files. Laws of materials beside closed forms and published values. */
#ifndef CLEAVE_LAWS_BENCH
#define CLEAVE_LAWS_BENCH

#include "bench/common/bench.h"
#include "kernels/laws/law_update.h"

#define MPA 1e6

enum { LAWS_FIGURES = 6 };

/* A quantity of a case with its expected value; a found value may differ by `tolerance`. All in `unit`. */
struct laws_figure {
    const char *what, *unit;
    double expected, tolerance;
};

/* A case. measure: stores the measured values in found[], in the order of `asked`. given: parameters for `measure`.
 * body: true if it runs a body, which takes seconds; false for a single element, in milliseconds. source: where the
 * expected values come from. */
struct laws_case {
    const char *name, *source;
    status (*measure)(const struct laws_case *c, double *found);
    bool body;
    double given[3];
    struct laws_figure asked[LAWS_FIGURES]; /* a quantity without a name ends the list */
};

/* Table of the cases. */
extern const struct laws_case laws_cases[];

/* Number of cases. */
extern const int laws_cases_count;

/* Returns true if the measured value `found` is within the tolerance of asked->expected. */
bool laws_figure_holds(const struct laws_figure *asked, double found);

/* ---- laws_elements.c: single elements ---------------------------------------------------------------------------- */

/* Returns a copy of `law` with its derived constants. young [Pa], poisson [1], yield [Pa], density [kg/m^3]: constants
 * of the material. */
struct law laws_material(struct law law, real young, real poisson, real yield, real density);

/* Returns steel with one of the flow laws: Young's modulus 200 GPa, Poisson's ratio 0.3, yield stress 200 MPa. */
struct law laws_steel(enum flow flow);

/* Returns a state of eight equal material points, which law_update treats together: without stress, at 294 K, and with
 * duration 0, so that the strain rate has no effect. */
struct law_points laws_points_at_rest(void);

/* Adds the elastic stress of a strain increment to the stress of all points of p, and keeps the previous stress in
 * p->before. strain[SYM_MAX]: tensor components of the increment [1]; normal components out of a plane or across a bar
 * are not used if `space` leaves them free. */
void laws_add_trial_stress(const struct law *m, struct law_points *p, const real *strain, enum space space);

/* Returns the elastic energy density of the first of the eight points of p with the law m [J/m^3]. */
real laws_elastic_energy(const struct law *m, const struct law_points *p);

/* Strains an element with the law m by 500 random increments of up to 0.2 %, with an explicit law update after each.
 * Returns the work of the strains minus elastic energy and plastic work, which should be 0, over the sum of the
 * absolute values of the work of all increments [1]. Returns NAN if the element has hardly yielded. */
double laws_cycled_energy(const struct law *m, enum space space);

/* Measure the quantities of a case with a single element in tension, cycled or heated, in explicit steps.
 * found[LAWS_FIGURES]: receives the quantities in the order and units of c->asked; given: meaning of c->given. */
status laws_hardening(const struct laws_case *c, double *found); /* given: enum flow, with the constants of laws_steel;
    found: stress at the strains 0.01 and 0.05 [MPa], plastic work up to 0.05 [MJ/m^3] */
status laws_table(const struct laws_case *c, double *found);
status laws_prager(const struct laws_case *c, double *found);
status laws_armstrong_frederick(const struct laws_case *c, double *found);
status laws_plane_strain(const struct laws_case *c, double *found); /* given: hardening [MPa], strain */
status laws_johnson_cook(const struct laws_case *c, double *found); /* given: 0 copper or 1 steel, m, plastic strain */
status laws_cycled_rate(const struct laws_case *c, double *found);  /* given: amplitude, frequency [Hz] */
status laws_held(const struct laws_case *c, double *found);         /* given: two times after which it is held [s] */
status laws_turning(const struct laws_case *c, double *found);
status laws_energy(const struct laws_case *c, double *found);

/* ---- laws_bodies.c: bodies --------------------------------------------------------------------------------------- */

/* Measure the quantities of a case with a body: bars that hit a wall, and bodies under static loads.
 * found[LAWS_FIGURES]: receives the quantities in the order and units of c->asked. c->given of bars: [0] shape
 * functions, 0 gimp or 1 linear; [1] dilatation, 0 the mean of a cell or 1 that of each point. */
status laws_bar_wilkins(const struct laws_case *c, double *found);
status laws_bar_copper(const struct laws_case *c, double *found);
status laws_bar_johnson_cook(const struct laws_case *c, double *found);
status laws_cook(const struct laws_case *c,
                 double *found); /* given: 1 in space, 1 in the current frame, spacing [mm] */
status laws_torsion(const struct laws_case *c, double *found); /* given: angle over that of first yield */
status laws_beam(const struct laws_case *c, double *found); /* given: 1 in plane strain, curvature over first yield */
status laws_sphere(const struct laws_case *c, double *found);
status laws_cylinder(const struct laws_case *c, double *found); /* given: radius of the front over the inner radius */

#endif
