/* What the parts of `cleave bench contact` share. */
#ifndef CLEAVE_CONTACT_BENCH
#define CLEAVE_CONTACT_BENCH

#include "bench/common/bench.h"

/* Of all bodies: a metre is a thousand spacings, waves run at 5000 m/s (sqrt(E/rho)). */
#define CONTACT_SPACING 1e-3
#define CONTACT_WAVE 5000.0

enum { CONTACT_FIGURES = 4 };

/* A case: what it measures, what closed forms say, and within which limits it is asked to be (INFINITY: of no limit).
 * given: numbers of the case. falls_short: known not to hold (of pairs: what their law cannot do). long_run: takes more
 * than a second. */
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
/* Rows of a table; `figure` [CONTACT_FIGURES]. */
extern const struct contact_case contact_cases[];
extern const int contact_cases_count;
bool contact_case_holds(const struct contact_case *c, const double *figure);

/* An engine of a scene written by printf; free with bench_engine_free. */
status contact_engine(struct run *e, struct scene *s, const char *text, ...) __attribute__((format(printf, 3, 4)));

/* Motion of a body, by its particles: mean velocity [m/s], spin in the plane [1/s]. */
struct contact_motion {
    double mass, x[DIM_MAX], v[DIM_MAX], spin;
};
struct contact_motion contact_motion_of(const struct run *e, int body);

/* contact_bars.c: two bars of `given[0]` and `given[1]` particles, speeds given[2] and given[3] wave speeds: relative
 * speed after over before, duration over 2 L/c, largest force over that of a bar, energy error. */
status contact_bars(const struct contact_case *c, double *figure);
/* The first flies at the second: its speed after over before, the speed of the second over it, energy error. */
status contact_striker(const struct contact_case *c, double *figure);
/* A bar that bounces between rigid walls given[1] times: energy error, momentum error. */
status contact_bounces(const struct contact_case *c, double *figure);
/* contact_discs.c: discs of given[0] spacings at given[1] wave speeds each, paths given[2] radii apart on a lattice
 * turned by given[3] against the line of centres: relative velocity after over before, normal and tangential; spin of
 * each R/v; energy error. */
status contact_discs(const struct contact_case *c, double *figure);
/* contact_faces.c: a block of given[0] x given[0] particles cut through, its ends moved by the strain given[1] and
 * shear given[2] (in spacings): force on them over that of the whole block, normal and along; overlap. */
status contact_block(const struct contact_case *c, double *figure);
/* contact_slope.c: a block on a slope of tangent given[0], friction given[1], on a rigid floor if given[2]:
 * acceleration over g sin, way in spacings, energy error. */
status contact_slope(const struct contact_case *c, double *figure);
/* A ball of given[0] spacings at given[1] wave speeds on a fixed plane: exponent of force over approach, duration over
 * that of Hertz, speed after over before, energy error. */
status contact_hertz_space(const struct contact_case *c, double *figure);

#endif
