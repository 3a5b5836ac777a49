/* Evaluates closed-form solutions of waves in a uniform bar (exact.h). */
#include "probes/exact.h"

#include <math.h>

static const struct exact_values nothing = {NAN, NAN, NAN, NAN};
static const real pi = 3.14159265358979323846;

static real wave_speed(const struct exact *e) { return sqrt(e->young / e->density); }
static real plastic_speed(const struct exact *e) { return sqrt(e->tangent / e->density); }
static real length(const struct exact *e) { return e->right - e->left; }

/* Returns the distance [m] of coordinate X [m] from the loaded end of the bar e. */
static real depth(const struct exact *e, real X) { return e->loaded > 0 ? e->right - X : X - e->left; }

/* Returns the coordinate [m] of the point at distance s [m] from the loaded end of the bar e. */
static real exact_position(const struct exact *e, real s) { return e->loaded > 0 ? e->right - s : e->left + s; }

/* Returns the reflection factor of the end of bar e opposite to the loaded end: 1 if it is fixed, -1 if it is free. */
static int far_reflection(const struct exact *e) { return e->reflection[e->loaded > 0 ? 0 : 1]; }

/* Adds the jumps across a stress front in the bar e to *v, the values at a position. jump: stress behind minus stress
 * ahead [Pa]; modulus: stress divided by strain in the front [Pa]; speed: speed of the front [m/s]; sign: 1 or -1,
 * direction of travel along x; age: time since the front passed the position [s], nothing is added if it is negative.
 * The jump of velocity follows from the balance of momentum, -sign jump/(rho speed). */
static void add_front(struct exact_values *v, const struct exact *e, real jump, real modulus, real speed, int sign,
                      real age)
{
    if (age < 0) return;
    real velocity = -sign * jump / (e->density * speed);
    v->stress += jump;
    v->strain += jump / modulus;
    v->velocity += velocity;
    v->displacement += velocity * age;
}

/* ---- loaded bars ------------------------------------------------------------------------------------------------- */

/* Returns displacement, velocity, stress and strain at distance s [m] from the loaded end of the elastic bar e at time
 * t [s]: the sum of all fronts that have passed, with their reflections at both ends. */
static struct exact_values step_bar(const struct exact *e, real s, real t)
{
    struct exact_values v = {0};
    real c = wave_speed(e), L = length(e), r = far_reflection(e), jump = e->load;
    for (int n = 0; 2 * n * L <= c * t; n++, jump *= -r) {
        add_front(&v, e, jump, e->young, c, -e->loaded, t - (2 * n * L + s) / c);
        add_front(&v, e, r * jump, e->young, c, e->loaded, t - (2 * (n + 1) * L - s) / c);
    }
    return v;
}

/* Returns the stress of the elastic precursor (the front ahead of the plastic front) in bar e [Pa]: the load, limited
 * by the yield stress, with the sign of the load. */
static real precursor(const struct exact *e) { return copysign(real_min(fabs(e->load), e->yield), e->load); }

/* Returns displacement, velocity, stress and strain at distance s [m] from the loaded end of the elastic-plastic bar e
 * at time t [s]: the sum of the elastic precursor, a front at the yield stress, and the plastic front. All values are
 * NAN once the precursor has reached the other end. */
static struct exact_values plastic_bar(const struct exact *e, real s, real t)
{
    struct exact_values v = {0};
    real first = precursor(e);
    if (wave_speed(e) * t > length(e) * (1 + 1e-9)) return nothing;
    add_front(&v, e, first, e->young, wave_speed(e), -e->loaded, t - s / wave_speed(e));
    if (e->load != first)
        add_front(&v, e, e->load - first, e->tangent, plastic_speed(e), -e->loaded, t - s / plastic_speed(e));
    return v;
}

/* ---- pulses ------------------------------------------------------------------------------------------------------ */

/* Adds displacement, velocity and strain of the wave pulse p in an infinite bar with the constants of e to *v, at the
 * distance eta [m] ahead of the centre of the pulse. sign: direction of travel along x, 1 or -1; factor: sign of the
 * displacement after all reflections. */
static void add_pulse(struct exact_values *v, const struct exact *e, const struct wave_pulse *p, real eta, int sign,
                      real factor)
{
    struct wave_pulse centred = *p;
    centred.at[0] = 0, centred.direction[0] = 1;
    struct wave_state wave = wave_pulse_initial_state(&centred, &eta, wave_speed(e), 1);
    v->displacement += factor * wave.displacement;
    v->velocity += factor * wave.velocity;
    v->strain += factor * sign * wave.strain;
}

/* Adds displacement, velocity and strain of pulse p and of its reflections at the ends of the bar e to *v, at
 * coordinate X [m] and time t [s]. The reflections are images of the pulse, each a length of the bar farther away; the
 * displacement changes its sign at a fixed end and keeps it at a free end. The ends follow from e->reflection. */
static void one_pulse(struct exact_values *v, const struct exact *e, const struct wave_pulse *p, real X, real t)
{
    real L = length(e), gone = wave_speed(e) * t;
    int sign = p->direction[0] < 0 ? -1 : 1;
    real factor = sign, start = sign > 0 ? p->at[0] - e->left : e->right - p->at[0]; /* from the end behind the pulse */
    for (int n = 0; n * L <= start + gone + 2 * p->width; n++) {
        real here = sign > 0 ? X - e->left : e->right - X; /* from the end behind this image */
        add_pulse(v, e, p, here + n * L - start - gone, sign, factor);
        factor *= -e->reflection[sign > 0 ? 1 : 0];
        sign = -sign;
    }
}

/* Returns displacement, velocity, stress and strain of the bar e at coordinate X [m] and time t [s]: the sum of all
 * initial pulses and their reflections at the ends. */
static struct exact_values pulses(const struct exact *e, real X, real t)
{
    struct exact_values v = {0};
    for (int k = 0; k < e->pulses; k++) one_pulse(&v, e, &e->pulse[k], X, t);
    v.stress = e->young * v.strain;
    return v;
}

/* Returns the manufactured solution of e at coordinate X [m] and time t [s]: displacement u = amplitude sin^2(pi
 * t/period) sin(k (X - origin)) with k = 2 pi/wavelength, its velocity, strain and elastic stress. */
static struct exact_values manufactured(const struct exact *e, real X, real t)
{
    real k = 2 * pi / e->wavelength, phase = k * (X - e->origin), grown = square(sin(pi * t / e->period));
    real strain = e->amplitude * grown * k * cos(phase);
    return (struct exact_values){.displacement = e->amplitude * grown * sin(phase),
                                 .velocity = e->amplitude * pi / e->period * sin(2 * pi * t / e->period) * sin(phase),
                                 .stress = e->young * strain,
                                 .strain = strain};
}

struct exact_values bar_exact_solution_at_position(const struct exact *e, real X, real t)
{
    switch (e->form) {
    case EXACT_STEP_BAR:
        return step_bar(e, depth(e, X), t);
    case EXACT_PLASTIC_BAR:
        return plastic_bar(e, depth(e, X), t);
    case EXACT_PULSE:
        return pulses(e, X, t);
    case EXACT_MANUFACTURED:
        return manufactured(e, X, t);
    default:
        return nothing;
    }
}

/* ---- fronts and plateaus ----------------------------------------------------------------------------------------- */

/* Returns position, direction and stresses of the elastic front in the bar e under a sudden constant load at time t
 * [s]. The front is reflected at both ends. The stress behind it is the sum of its jumps in all passages. */
static struct exact_front step_front(const struct exact *e, real t)
{
    real L = length(e), gone = wave_speed(e) * t, m = floor(gone / L);
    bool outward = fmod(m, 2) == 0;
    real r = far_reflection(e), before = 0, jump = e->load;
    for (int k = 0; k < (int)m; k++) before += jump, jump *= k % 2 == 0 ? r : -1;
    return (struct exact_front){.position = exact_position(e, outward ? gone - m * L : (m + 1) * L - gone),
                                .ahead = outward ? -e->loaded : e->loaded,
                                .before = before,
                                .behind = before + jump};
}

int bar_exact_solution_compute_stress_fronts(const struct exact *e, real t, struct exact_front front[EXACT_FRONTS])
{
    if (e->form == EXACT_STEP_BAR) {
        front[0] = step_front(e, t);
        return 1;
    }
    if (e->form != EXACT_PLASTIC_BAR || wave_speed(e) * t > length(e) * (1 + 1e-9)) return 0;
    real first = precursor(e);
    front[0] = (struct exact_front){exact_position(e, wave_speed(e) * t), -e->loaded, 0, first};
    if (e->load == first) return 1;
    front[1] = (struct exact_front){exact_position(e, plastic_speed(e) * t), -e->loaded, first, e->load};
    return 2;
}

bool bar_exact_solution_find_constant_stress_range(const struct exact *e, real t, enum exact_window window,
                                                   real *lower_end, real *upper_end)
{
    struct exact_front front[EXACT_FRONTS];
    int fronts = bar_exact_solution_compute_stress_fronts(e, t, front);
    real L = length(e), near, far; /* distances from the loaded end */
    if (fronts == 0 || (window == EXACT_PRECURSOR && fronts < 2)) return false;
    bool outward = front[0].ahead == -e->loaded;
    if (window == EXACT_PRECURSOR)
        near = depth(e, front[1].position) + 0.05 * L, far = depth(e, front[0].position) - 0.07 * L;
    else if (fronts == 2)
        near = 0.1 * L, far = depth(e, front[1].position) - 0.08 * L;
    else if (outward)
        near = 0.1 * L, far = depth(e, front[0].position) - 0.1 * L;
    else
        near = depth(e, front[0].position) + 0.1 * L, far = 0.9 * L;
    *lower_end = real_min(exact_position(e, near), exact_position(e, far));
    *upper_end = real_max(exact_position(e, near), exact_position(e, far));
    return near < far;
}
