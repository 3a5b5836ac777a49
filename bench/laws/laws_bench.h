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

/* Returns true if the measured value `measured` is within the tolerance of expected->expected. */
bool laws_figure_holds(const struct laws_figure *expected, double measured);

/* ---- laws_elements.c: single elements ---------------------------------------------------------------------------- */

/* Returns a copy of `law` in which the constants of the material are set, and the constants that follow from them
 * computed. young: Young's modulus [Pa]; poisson: Poisson's ratio; yield: yield stress [Pa]; density: mass density
 * [kg/m^3]. */
struct law laws_law_with_derived_constants(struct law law, real young, real poisson, real yield, real density);

/* Returns the law of a steel (Young's modulus 200 GPa, Poisson's ratio 0.3, yield stress 200 MPa) that hardens by the
 * flow law `flow`. */
struct law laws_steel(enum flow flow);

/* Returns a state of eight equal material points, which law_update treats together: without stress, at 294 K, and with
 * duration 0, so that the strain rate has no effect. */
struct law_points laws_points_at_rest(void);

/* Adds the elastic stress of a strain increment to the stress of all points in `points`, and keeps the previous stress
 * in points->before. strain_increment[SYM_MAX]: tensor components of the increment [1]; normal components out of a
 * plane or across a bar are not used if `space` leaves them free. */
void laws_add_elastic_stress_of_increment(const struct law *law, struct law_points *points,
                                          const real *strain_increment, enum space space);

/* Returns the elastic energy density of the first of the eight points in `points` with the material law `law` [J/m^3].
 */
real laws_elastic_energy_density(const struct law *law, const struct law_points *points);

/* Strains an element with the material law `law` by 500 random increments of up to 0.2 %, with an explicit law update
 * after each. Returns the relative error of the energy, which should be 0: the work of the strains minus elastic energy
 * and plastic work, divided by the sum of the absolute values of the work of all increments. Returns NAN if the element
 * has hardly yielded. */
double laws_energy_error_of_random_strains(const struct law *law, enum space space);

/* Measure the quantities of a case with a single element in tension, cycled or heated, in explicit steps.
 * measured[LAWS_FIGURES]: receives the quantities in the order and units of c->asked; given: meaning of c->given. */
status laws_measure_hardening(const struct laws_case *c, double *measured); /* given: enum flow, with the constants of
    laws_steel; measured: stress at the strains 0.01 and 0.05 [MPa], plastic work up to 0.05 [MJ/m^3] */
status laws_measure_tabulated_hardening(const struct laws_case *c, double *measured);
status laws_measure_prager_hardening(const struct laws_case *c, double *measured);
status laws_measure_armstrong_frederick_hardening(const struct laws_case *c, double *measured);
status laws_measure_plane_strain_tension(const struct laws_case *c,
                                         double *measured); /* given: hardening [MPa], strain */
status laws_measure_johnson_cook_heating(const struct laws_case *c,
                                         double *measured); /* given: 0 copper or 1 steel, m, plastic strain */
status laws_measure_rate_sensitive_cycles(const struct laws_case *c,
                                          double *measured); /* given: amplitude, frequency [Hz] */
status laws_measure_stress_relaxation(const struct laws_case *c,
                                      double *measured); /* given: two times after which it is held [s] */
status laws_measure_tension_then_shear(const struct laws_case *c, double *measured);
status laws_measure_energy_of_random_strains(const struct laws_case *c, double *measured);

/* ---- laws_bodies.c: bodies --------------------------------------------------------------------------------------- */

/* Measure the quantities of a case with a body: bars that hit a wall, and bodies under static loads.
 * measured[LAWS_FIGURES]: receives the quantities in the order and units of c->asked. c->given of bars: [0] shape
 * functions, 0 gimp or 1 linear; [1] dilatation, 0 the mean of a cell or 1 that of each point. */
status laws_measure_wilkins_bar_impact(const struct laws_case *c, double *measured);
status laws_measure_copper_bar_impact(const struct laws_case *c, double *measured);
status laws_measure_johnson_cook_bar_impact(const struct laws_case *c, double *measured);
status laws_measure_cook_membrane(const struct laws_case *c,
                                  double *measured); /* given: 1 in space, 1 in the current frame, spacing [mm] */
status laws_measure_torsion_moment(const struct laws_case *c,
                                   double *measured); /* given: angle over that of first yield */
status laws_measure_beam_bending(const struct laws_case *c,
                                 double *measured); /* given: 1 in plane strain, curvature over first yield */
status laws_measure_hollow_sphere(const struct laws_case *c, double *measured);
status laws_measure_thick_cylinder(const struct laws_case *c,
                                   double *measured); /* given: radius of the front over the inner radius */

#endif
