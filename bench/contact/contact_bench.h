/* `cleave bench contact`: declarations shared by its files. */
#ifndef CLEAVE_CONTACT_BENCH
#define CLEAVE_CONTACT_BENCH

#include "bench/common/bench.h"

/* Spacing of all bodies [m], and speed sqrt(E/rho) of their waves [m/s]. */
#define CONTACT_SPACING 1e-3
#define CONTACT_WAVE 5000.0

enum { CONTACT_FIGURES = 4 };

/* A case: measured quantities and the ranges required from closed forms (INFINITY: no limit). given: parameters of the
 * case. falls_short: known to miss the ranges (for contact of pairs: beyond their law). long_run: takes more than a
 * second. */
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

/* Table of the cases. */
extern const struct contact_case contact_cases[];

/* Number of cases. */
extern const int contact_cases_count;

/* Returns true if all figure[CONTACT_FIGURES] are within the required ranges. */
bool contact_case_holds(const struct contact_case *c, const double *figure);

/* Creates a run of a scene; text: format of printf. Release with bench_engine_free. */
status contact_engine(struct run *e, struct scene *s, const char *text, ...) __attribute__((format(printf, 3, 4)));

/* Motion of a body from its particles: mass [kg], centre of mass [m], mean velocity [m/s], angular velocity in the
 * plane [1/s]. */
struct contact_motion {
    double mass, x[DIM_MAX], v[DIM_MAX], spin;
};

/* Returns the motion of a body. */
struct contact_motion contact_motion_of(const struct run *e, int body);

/* Two bars of given[0] and given[1] particles with speeds given[2] and given[3] wave speeds (contact_bars.c). figure:
 * relative speed after over before; duration over 2 L/c; largest force over that of a bar; energy error. */
status contact_bars(const struct contact_case *c, double *figure);

/* A moving bar hits a bar at rest (contact_bars.c). figure: its speed after over before; speed of the second bar over
 * that; energy error. */
status contact_striker(const struct contact_case *c, double *figure);

/* A bar that bounces between rigid walls given[1] times (contact_bars.c). figure: energy error; momentum error. */
status contact_bounces(const struct contact_case *c, double *figure);

/* Two discs of radius given[0] spacings with speed given[1] wave speeds each, on paths given[2] radii apart, on a
 * lattice rotated by given[3] against the line of centres (contact_discs.c). figure: normal and tangential relative
 * velocity after over before; angular velocity of each times R/v; energy error. */
status contact_discs(const struct contact_case *c, double *figure);

/* A block of given[0] x given[0] particles that is cut through, with its ends displaced by the strain given[1] and the
 * shear given[2] [spacings] (contact_faces.c). figure: normal and tangential force on the ends over that of the intact
 * block; overlap. */
status contact_block(const struct contact_case *c, double *figure);

/* A block on a slope with tangent given[0] and friction given[1], on a rigid floor if given[2] is not 0
 * (contact_slope.c). figure: acceleration over g sin; displacement [spacings]; energy error. */
status contact_slope(const struct contact_case *c, double *figure);

/* A ball of radius given[0] spacings hits a fixed plane at given[1] wave speeds (contact_faces.c). figure: exponent of
 * the force over the approach; duration over that of Hertz; speed after over before; energy error. */
status contact_hertz_space(const struct contact_case *c, double *figure);

#endif
