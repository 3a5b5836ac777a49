/* `cleave bench absorbing`: measures how much of a wave absorbing faces reflect. Declarations shared by its files. */
#ifndef CLEAVE_ABSORBING_BENCH
#define CLEAVE_ABSORBING_BENCH

#include "bench/common/bench.h"

/* Spacing of all bodies [m], and speed of their fastest waves [m/s]. */
#define ABSORBING_SPACING 1e-3
#define ABSORBING_SPEED 100.0

/* A numerical method: name, and the scene keys that select it. */
struct absorbing_method {
    const char *name, *keys;
};
enum { ABSORBING_METHODS = 6 };
extern const struct absorbing_method absorbing_methods[ABSORBING_METHODS];

/* Results for a plane longitudinal pulse that hits an absorbing face at normal incidence [1]. reflected: largest
 * reflected velocity divided by the peak velocity of the pulse; balance: largest error of the energy balance; back:
 * largest energy that the face released in one step, divided by the energy of the pulse. The face may only absorb, so
 * that `back` should be 0. */
struct absorbing_pulse {
    double reflected, balance, back;
};

/* Runs a plane pulse that hits an absorbing face at normal incidence, measures its reflection, and stores the results
 * in *result. m: numerical method; dim: number of dimensions, 1, 2 or 3; width: width of the pulse [spacings]. Returns
 * FAILED if a step of a run fails, REFUSED if a scene is invalid. */
status absorbing_measure_pulse_reflection(const struct absorbing_method *m, int dim, int width,
                                          struct absorbing_pulse *result);

/* ---- oblique waves ----------------------------------------------------------------------------------------------- */

/* Displacement amplitudes of the P and the S wave reflected from a wave of amplitude 1 [1]. */
struct absorbing_reflection {
    double as_p, as_s;
};

/* Computes in closed form the reflection of a plane wave at the face of a half space with dashpots normal and
 * tangential to the face (Lysmer & Kuhlemeyer 1969): the tractions of incident and reflected waves equal the forces of
 * the dashpots. shear: true if the incident wave is an S wave, false for a P wave; angle: angle between the direction
 * of the wave and the normal of the face [rad]; wave_speed_ratio: speed of P waves divided by that of S waves. Returns
 * the amplitudes of the reflected waves. */
struct absorbing_reflection absorbing_reflection_in_closed_form(bool shear, double angle, double wave_speed_ratio);

/* Measures the reflection of a plane wave at oblique incidence in plane strain at Poisson's ratio 1/4, and stores it in
 * *measured. The body is a strip between two mirrors, whose distance is half a wavelength along the face, so that waves
 * at +angle and -angle are superposed. m: numerical method; shear: true for an S wave, false for a P wave; angle: angle
 * between the direction of the wave and the normal of the face [rad]; wavelength: length of the wave [spacings].
 * Returns FAILED if a step of a run fails, REFUSED if a scene is invalid. */
status absorbing_measure_oblique_reflection(const struct absorbing_method *m, bool shear, double angle,
                                            double wavelength, struct absorbing_reflection *measured);

#endif
