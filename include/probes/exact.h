/* Closed forms of the uniform elastic bar [left, right]: what a computed field is compared with.
 * c = sqrt(E/rho); F is the stress at the loaded end, s the distance from it; tension is positive. Strain is stress/E
 * but where the bar has yielded.
 *
 *   STEP BAR      a load applied at t = 0 and held, the bar at rest before: d'Alembert's solution with all reflections
 *                     sigma = F sum_n (-r)^n [H(ct - 2nL - s) + r H(ct - 2(n+1)L + s)],   r = +1 fixed, -1 free far end
 *                 each front carries v = -+ sigma/(rho c); displacements are the fronts' velocities times their age
 *   PLASTIC BAR   the same load beyond the yield stress, bilinear with tangent E_t: a precursor sigma_y at c, the rest
 *                 at sqrt(E_t/rho) (von Karman & Duwez 1950); until the precursor reaches the far end, nothing after
 *                 that
 *   PULSE         the waves that initial pulses are (region.h): at rest ahead, displaced by sqrt(pi) V r/c behind; the
 *                 ends reflect by images, a fixed one is held wherever it is
 *   MANUFACTURED  u = U sin^2(pi t/T) sin(2 pi (x - origin)/lambda), under the body force that makes it a solution */
#ifndef CLEAVE_EXACT
#define CLEAVE_EXACT

#include "data/region.h"
#include "scene/requests.h"

struct exact {
    enum exact_form form;
    real left, right;                    /* ends of the bar [m] */
    real young, tangent, yield, density; /* E, E_t, sigma_y [Pa]; rho [kg/m^3] */
    int reflection[2];                   /* of stress at the left and right end: +1 fixed, -1 free */
    int loaded;                          /* STEP, PLASTIC: the loaded end, -1 left, +1 right */
    real load;                           /* STEP, PLASTIC: F [Pa] */
    const struct wave_pulse *pulse;      /* PULSE: borrowed */
    int pulses;
    real amplitude, period, wavelength, origin; /* MANUFACTURED: U [m], T [s], lambda [m], [m] */
};

struct exact_values {
    real displacement, velocity, stress, strain;
}; /* [m] [m/s] [Pa] [1] */

/* At reference position X and time t >= 0; all NAN where the form does not hold. On a front: its value behind. */
struct exact_values exact_at(const struct exact *e, real X, real t);

/* A jump of the stress that moves along the bar. */
struct exact_front {
    real place;          /* [m] */
    int ahead;           /* side that it has not reached: -1 smaller x, +1 greater x */
    real before, behind; /* stress on its two sides [Pa] */
};
enum { EXACT_FRONTS = 2 };

/* STEP BAR: the front that was reflected last. PLASTIC BAR: the precursor and, if the load is beyond yield, the plastic
 * front. Returns how many there are; none for smooth forms and where the form does not hold. */
int exact_fronts(const struct exact *e, real t, struct exact_front front[EXACT_FRONTS]);

/* Where the exact stress is even, well away from fronts and ends. PLATEAU: behind the (last) front, a tenth of the
 * bar away from it and from the ends; 0.08 of it behind a plastic front. PRECURSOR: from 0.07 of the bar behind the
 * precursor to 0.05 ahead of the plastic front. False: there is no such place. */
enum exact_window { EXACT_PLATEAU, EXACT_PRECURSOR };
bool exact_plateau(const struct exact *e, real t, enum exact_window which, real *from, real *to);

#endif
