/* Closed-form solutions for waves in a uniform elastic bar [left, right], with which computed fields are
 * compared. L: length; rho: density; E: Young's modulus; c = sqrt(E/rho): wave speed; F: stress at the loaded
 * end; s: distance from that end; t: time; H: unit step. Tension is positive. Strain is stress/E unless the
 * bar has yielded.
 *
 *   STEP BAR      a load applied at t = 0 and kept, on a bar at rest: d'Alembert's solution, all reflections
 *                   sigma = F sum_n (-r)^n [H(ct - 2nL - s) + r H(ct - 2(n+1)L + s)],   n = 0, 1, ...
 *                 with r = +1 for a fixed, -1 for a free far end; each front has v = -+ sigma/(rho c);
 *                 displacements are the velocities of fronts times the time since they passed
 *   PLASTIC BAR   the same load beyond the yield stress sigma_y, bilinear with tangent modulus E_t: precursor
 *                 sigma_y at speed c, the rest at sqrt(E_t/rho) (von Karman & Duwez 1950); valid until the
 *                 precursor reaches the far end
 *   PULSE         the waves from initial pulses of velocity V and radius r (data/region.h): at rest ahead,
 *                 displaced by sqrt(pi) V r/c behind; the ends reflect by images, and a fixed end keeps its
 *                 displacement
 *   MANUFACTURED  u = U sin^2(pi t/T) sin(2 pi (x - origin)/lambda), with constants U, T, origin and lambda,
 *                 under the body force for which this displacement is a solution */
#ifndef CLEAVE_EXACT
#define CLEAVE_EXACT

#include "data/region.h"
#include "scene/requests.h"

/* A closed-form solution for a bar, with its parameters. Capitals in comments: the forms that use a member. */
struct exact {
    enum exact_form form;
    real left, right;                    /* ends of the bar [m] */
    real young, tangent, yield, density; /* Young's modulus, tangent modulus, yield stress [Pa]; density [kg/m^3] */
    int reflection[2];                   /* factor of stress at the left and right end: +1 fixed, -1 free */
    int loaded;                          /* STEP, PLASTIC: the loaded end, -1 left, +1 right */
    real load;                           /* STEP, PLASTIC: traction F on the loaded end from t = 0 on [Pa] */
    const struct wave_pulse *pulse;      /* PULSE: [pulses] initial wave packets, kept by reference */
    int pulses;
    real amplitude, period, wavelength, origin; /* MANUFACTURED: U [m], T [s], lambda [m], position of phase 0 [m] */
};

/* Values of a closed-form solution at one position and time. */
struct exact_values {
    real displacement; /* [m] */
    real velocity;     /* [m/s] */
    real stress;       /* [Pa] */
    real strain;       /* [1] */
};

/* Returns displacement, velocity, stress and strain of the closed-form solution e at reference position X [m] and time
 * t >= 0 [s]. At a front, the values behind the front are returned. All values are NAN if the closed form does not
 * apply at X and t. */
struct exact_values bar_exact_solution_at_position(const struct exact *e, real X, real t);

/* A stress front of the closed-form solution, a jump that moves along the bar. */
struct exact_front {
    real position;       /* position [m] */
    int ahead;           /* direction of its motion: -1 towards smaller x, +1 towards greater x */
    real before, behind; /* stress ahead of the front and behind it [Pa] */
};
/* Largest number of stress fronts of a closed-form solution. */
enum { EXACT_FRONTS = 2 };

/* Computes the stress fronts (jumps) of the closed-form solution e at time t [s] and stores them in front[]. An elastic
 * bar under a step load (EXACT_STEP_BAR) has one front, which is reflected at both ends. A plastic bar
 * (EXACT_PLASTIC_BAR) has the elastic precursor and, if the load exceeds the yield stress, the plastic front. Returns
 * the number of fronts; 0 for solutions without jumps and for times at which the closed form does not apply. */
int bar_exact_solution_compute_stress_fronts(const struct exact *e, real t, struct exact_front front[EXACT_FRONTS]);

/* Parts of a bar in which the stress of the closed-form solution is constant, at a distance from fronts and ends.
 * PLATEAU: behind the last front, at least 0.1 bar lengths from it (0.08 from a plastic front) and from the ends.
 * PRECURSOR: from 0.07 bar lengths behind the precursor to 0.05 ahead of the plastic front. */
enum exact_window { EXACT_PLATEAU, EXACT_PRECURSOR };

/* Computes the ends *lower_end and *upper_end [m] of a part of the bar in which the stress of the closed-form solution
 * e is constant at time t [s]. window: EXACT_PLATEAU the part behind the last front, EXACT_PRECURSOR that between the
 * elastic precursor and the plastic front, both at some distance from fronts and ends. Returns false if there is no
 * such part at time t. */
bool bar_exact_solution_find_constant_stress_range(const struct exact *e, real t, enum exact_window window,
                                                   real *lower_end, real *upper_end);

#endif
