/* `cleave bench laws`: compares laws of materials with closed forms and published values. Declarations shared by its
 * files. */
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

/* Cases of `cleave bench laws`, laws_cases_count entries. */
extern const struct laws_case laws_cases[];

/* Number of entries of the table laws_cases. */
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

/* Adds the elastic stress of a strain increment by `law` to the stress of all points in `points`, and keeps the
 * previous stress in points->before. strain_increment[SYM_MAX]: tensor components of the increment [1]; normal
 * components out of a plane or across a bar are not used if `space` leaves them free. */
void laws_add_elastic_stress_of_increment(const struct law *law, struct law_points *points,
                                          const real *strain_increment, enum space space);

/* Returns the elastic energy density [J/m^3] of the first of the eight points in `points`. law: their material law. */
real laws_elastic_energy_density(const struct law *law, const struct law_points *points);

/* Strains an element with the law `law` in the plane or body `space` by 500 random increments of up to 0.2 %, with an
 * explicit law update after each. Returns the relative error of the energy, which should be 0: the work of the strains
 * minus elastic energy and plastic work, divided by the sum of the absolute values of the work of all increments.
 * Returns NAN if the element has hardly yielded. */
double laws_energy_error_of_random_strains(const struct law *law, enum space space);

/* Pulls a bar of laws_steel and measures, for the case c, the stress at the strains 0.01 and 0.05 [MPa] and the plastic
 * work up to 0.05 [MJ/m^3] into measured[3]. c->given[0]: flow law (enum flow). Returns OK. */
status laws_measure_hardening(const struct laws_case *c, double *measured);

/* Pulls a bar of laws_steel with tabulated hardening, and stores its stress [MPa] at the strains 0.008, 0.04 and 0.2 in
 * measured[3]. c: the case, without parameters. Returns OK. */
status laws_measure_tabulated_hardening(const struct laws_case *c, double *measured);

/* Loads a bar of steel with linear kinematic hardening (Prager) to the strains 0.01, -0.01, 0.01 and -0.01 in turn, and
 * stores the stress [MPa] at each in measured[4]. c: the case, without parameters. Returns OK. */
status laws_measure_prager_hardening(const struct laws_case *c, double *measured);

/* Loads a bar of steel with kinematic hardening by Armstrong & Frederick. Stores in measured[3] the stress [MPa] when
 * the strain is 0.01 for the first and, in cycles between -0.01 and 0.01, for the sixth time, and the growth of the
 * strain [1e-3] in the fourth of four cycles between the stresses 300 and -200 MPa. c: the case, without parameters.
 * Returns OK. */
status laws_measure_armstrong_frederick_hardening(const struct laws_case *c, double *measured);

/* Stretches a sheet in plane strain. Stores in measured[4], at the final strain, the stress along the tension and the
 * one normal to the plane [MPa] and the plastic strain [1e-3], and the largest stress before the first plastic strain
 * [MPa]. Parameters of the case c: c->given[0] hardening modulus [MPa], c->given[1] final strain [1]. Returns OK. */
status laws_measure_plane_strain_tension(const struct laws_case *c, double *measured);

/* Stretches a point with the Johnson-Cook law, which its plastic work heats, at a plastic strain rate of 1000/s. Stores
 * its equivalent stress [MPa] and its temperature [K] at the final plastic strain in measured[2]. Parameters of the
 * case c: c->given[0] 0 for copper, 1 for steel; c->given[1] exponent m of the thermal softening; c->given[2] final
 * plastic strain [1]. Returns OK. */
status laws_measure_johnson_cook_heating(const struct laws_case *c, double *measured);

/* Strains a bar of Johnson-Cook copper sinusoidally for five cycles, in 1000 and in 10000 steps per cycle, and stores
 * the accumulated plastic strain [%] of both runs in measured[2]. Parameters of the case c: c->given[0] amplitude of
 * the strain [1], c->given[1] frequency [Hz]. Returns OK. */
status laws_measure_rate_sensitive_cycles(const struct laws_case *c, double *measured);

/* Strains a bar with a rate-sensitive law to 0.01 at 1000/s and then keeps its strain constant. Stores in measured[3]
 * the stress [MPa] at the end of the straining and at two later times. c->given[0], c->given[1]: these times, after the
 * end of the straining [s]; c: the case. Returns OK. */
status laws_measure_stress_relaxation(const struct laws_case *c, double *measured);

/* Loads a point of ideally plastic steel to its yield stress in tension and then shears it. Stores in measured[4] the
 * remaining tensile stress divided by the yield stress [1]: with 1000 explicit steps, and with 1, 4 and 16 load steps.
 * c: the case, without parameters. Returns OK. */
status laws_measure_tension_then_shear(const struct laws_case *c, double *measured);

/* Stores in measured[3] the relative error of the energy under random strains (laws_energy_error_of_random_strains) of
 * three laws: Voce in space, kinematic hardening in plane stress, and Johnson-Cook in plane strain. c: the case,
 * without parameters. Returns OK. */
status laws_measure_energy_of_random_strains(const struct laws_case *c, double *measured);

/* ---- laws_bodies.c: bodies --------------------------------------------------------------------------------------- */

/* Runs a bar of copper that hits a rigid wall at 227 m/s (Wilkins). Stores in measured[3] its length and its largest
 * radius at the end [mm] and the error of the energy balance [%]. Parameters of the case c: c->given[0] shape
 * functions, 0 gimp (of particles with extent), 1 linear; c->given[1] dilatation of a point, 0 the mean of its cell, 1
 * its own. Returns REFUSED or FAILED if the run does. */
status laws_measure_wilkins_bar_impact(const struct laws_case *c, double *measured);

/* Runs a bar of copper that hits a rigid wall at 190 m/s. Stores in measured[5] its length and its largest radius at
 * the end [mm], its largest plastic strain [1], the root mean square of its pressure [GPa] and the error of the energy
 * balance [%]. c: the case; c->given as in laws_measure_wilkins_bar_impact. Returns REFUSED or FAILED if the run does.
 */
status laws_measure_copper_bar_impact(const struct laws_case *c, double *measured);

/* Runs a bar of copper with the Johnson-Cook law that hits a rigid wall at 190 m/s. Stores in measured[4] its length
 * and its largest radius at the end [mm], its highest temperature [K] and the error of the energy balance [%]. c: the
 * case; c->given as in laws_measure_wilkins_bar_impact. Returns REFUSED or FAILED if the run does. */
status laws_measure_johnson_cook_bar_impact(const struct laws_case *c, double *measured);

/* Bends Cook's membrane, of a nearly incompressible material, and stores the displacement of its upper corner [um] in
 * measured[0]. Parameters of the case c: c->given[0] 0 for plane strain, 1 for a slab in space; c->given[1] 0 for load
 * steps on the reference grid, 1 for relaxation on the current grid; c->given[2] particle spacing [mm]. Returns REFUSED
 * or FAILED if the run does. */
status laws_measure_cook_membrane(const struct laws_case *c, double *measured);

/* Twists a cylinder of ideally plastic steel, and stores its moment [N m] in measured[0]. c: the case; c->given[0]:
 * angle divided by the angle of first yield [1]. Returns REFUSED or FAILED if the run does. */
status laws_measure_torsion_moment(const struct laws_case *c, double *measured);

/* Bends a beam of ideally plastic steel, and stores its moment divided by the moment of first yield [1] in measured[0].
 * Parameters of the case c: c->given[0] 0 for plane stress, 1 for plane strain; c->given[1] curvature divided by the
 * curvature of first yield [1]. Returns REFUSED or FAILED if the run does. */
status laws_measure_beam_bending(const struct laws_case *c, double *measured);

/* Loads a hollow sphere of ideally plastic steel by a pressure inside. Stores in measured[4] the radius of the plastic
 * front from the stress outside it and from the plastic strain [inner radii], the outward displacement of the outer
 * face [um], and the pressure of collapse divided by the yield stress [1]. c: the case, without parameters. Returns
 * REFUSED or FAILED if a run does. */
status laws_measure_hollow_sphere(const struct laws_case *c, double *measured);

/* Loads a thick cylinder of ideally plastic steel by a pressure inside. Stores in measured[2] the radius of the plastic
 * front from the stress outside it and from the plastic strain [inner radii]. c: the case; c->given[0]: radius of the
 * front that is expected from the pressure, divided by the inner radius [1]. Returns REFUSED or FAILED if a run does.
 */
status laws_measure_thick_cylinder(const struct laws_case *c, double *measured);

#endif
