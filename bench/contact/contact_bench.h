/* `cleave bench contact`: compares collisions of bodies with closed forms. Declarations shared by its files. */
#ifndef CLEAVE_CONTACT_BENCH
#define CLEAVE_CONTACT_BENCH

#include "bench/common/bench.h"

/* Spacing of all bodies [m], and speed sqrt(E/rho) of their waves [m/s]. */
#define CONTACT_SPACING 1e-3
#define CONTACT_WAVE 5000.0

enum { CONTACT_FIGURES = 4 };

/* A case: quantities that are measured in a run and compared with closed forms. name, law: of the case, and of the
 * contact law. measure: makes the runs and stores the quantities in figure[CONTACT_FIGURES]. given: its parameters.
 * falls_short: known not to meet the requirements, as contact between pairs of particles beyond the range of its law.
 * long_run: takes more than a second. asked: names of the quantities (NULL ends the list), and their required ranges,
 * which INFINITY leaves open. */
struct contact_case {
    const char *name, *law;
    status (*measure)(const struct contact_case *c, double *figure);
    double given[4];
    bool falls_short, long_run;
    struct {
        const char *what;
        double low, high;
    } asked[CONTACT_FIGURES];
};

/* Cases of `cleave bench contact`, contact_cases_count entries. */
extern const struct contact_case contact_cases[];

/* Number of entries of the table contact_cases. */
extern const int contact_cases_count;

/* Returns true if all quantities measured[CONTACT_FIGURES] of the case c are within their required ranges. */
bool contact_case_holds(const struct contact_case *c, const double *measured);

/* Creates the run of a scene and stores the scene in *s. text: the scene, a format of printf followed by its
 * arguments. Returns REFUSED or FAILED if the scene is invalid. Release with bench_engine_free. */
status contact_make_run_of_scene(struct run *run, struct scene *s, const char *text, ...)
    __attribute__((format(printf, 3, 4)));

/* Motion of a body from its particles: mass [kg], centre of mass [m], mean velocity [m/s], angular velocity in the
 * plane [1/s]. */
struct contact_motion {
    double mass, x[DIM_MAX], v[DIM_MAX], spin;
};

/* Returns the motion (velocities and so on) of the body with the index `body_number`, computed from its particles in
 * the run. */
struct contact_motion contact_motion_of_body(const struct run *run, int body_number);

/* Runs the collision of two bars of c->given[0] and given[1] particles with the velocities given[2] and given[3], in
 * units of the wave speed (contact_bars.c). Stores in measured[]: relative velocity after the collision divided by that
 * before; duration of contact divided by 2 L/c (L: length of a bar, c: wave speed); largest force divided by rho c v A;
 * error of the energy [1]. Returns FAILED if a step fails. */
status contact_measure_bar_collision(const struct contact_case *c, double *measured);

/* Runs a moving bar of c->given[0] particles with the speed given[2], in units of the wave speed, that hits a bar of
 * given[1] particles at rest (contact_bars.c). Stores in measured[]: velocities of the first and of the second bar
 * after the collision, divided by the initial velocity; error of the energy [1]. Returns FAILED if a step fails. */
status contact_measure_striker_bar(const struct contact_case *c, double *measured);

/* Runs a bar of c->given[0] particles in length that bounces given[1] times between rigid walls at the speed given[2],
 * in units of the wave speed (contact_bars.c). Stores the relative errors of energy and momentum in measured[0] and
 * measured[1]. Returns FAILED if a step fails. */
status contact_measure_bouncing_bar(const struct contact_case *c, double *measured);

/* Runs the collision of two discs with the radius c->given[0] [spacings] and the speed given[1] each, in units of the
 * wave speed, whose paths are given[2] radii apart, on a lattice rotated by given[3] [rad] relative to the line of
 * centres (contact_discs.c). Stores in measured[]: normal and tangential relative velocity after the collision, divided
 * by those before; mean angular velocity of the discs times R/v (R: radius, v: speed); error of the energy [1]. Returns
 * FAILED if a step fails. */
status contact_measure_disc_collision(const struct contact_case *c, double *measured);

/* Compares a block of c->given[0] x given[0] particles that is cut in two with an intact block (contact_faces.c). The
 * ends of both blocks are displaced towards each other by the strain given[1], and along each other by given[2]
 * [spacings]. Stores in measured[]: normal and tangential force on the ends, divided by those of the intact block;
 * overlap of the cut faces [spacings]. Returns FAILED if a run fails. */
status contact_measure_cut_block(const struct contact_case *c, double *measured);

/* Runs a block under its weight on a slope with the tangent c->given[0] and the coefficient of friction given[1], on a
 * rigid floor if given[2] > 0, else on a deformable floor (contact_slope.c). Stores in measured[]: acceleration divided
 * by g sin(slope); distance moved [spacings]; error of the energy [1]. Returns FAILED if a step fails. */
status contact_measure_sliding_block(const struct contact_case *c, double *measured);

/* Runs a ball of radius c->given[0] [spacings] that hits a rigid plane at the speed given[1], in units of the wave
 * speed (contact_faces.c). Stores in measured[]: exponent of the force as a function of the approach; duration of
 * contact divided by that of Hertz; speed after the collision divided by that before; error of the energy [1]. Returns
 * FAILED if a step fails. */
status contact_measure_ball_on_plane(const struct contact_case *c, double *measured);

#endif
