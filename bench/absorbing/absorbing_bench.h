/* `cleave bench absorbing`: declarations shared by its files. */
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
 * reflected velocity over that of the pulse; balance: largest error of the energy balance; back: largest energy that
 * the face released in one step, over that of the pulse. */
struct absorbing_pulse {
    double reflected, balance, back;
};

/* Measures the reflection of a pulse `width` spacings wide in 1, 2 or 3 dimensions (dim). */
status absorbing_pulse(const struct absorbing_method *m, int dim, int width, struct absorbing_pulse *figure);

/* ---- oblique waves ----------------------------------------------------------------------------------------------- */

/* Displacement amplitudes of the P and the S wave reflected from a wave of amplitude 1 [1]. */
struct absorbing_reflection {
    double as_p, as_s;
};

/* Computes the reflection at a half space with wave speeds 1 (S) and `ratio` (P), in closed form: the tractions of the
 * waves and of both dashpots balance (Lysmer & Kuhlemeyer 1969). shear: the incident wave is an S wave; angle: between
 * its direction and the normal [rad]. */
struct absorbing_reflection absorbing_theory(bool shear, double angle, double ratio);

/* Measures the reflection of two plane waves at +-angle between two mirrors, whose distance is half a wavelength along
 * the face. wavelength: [spacings]. Plane strain, Poisson's ratio 1/4. shear, angle: as for absorbing_theory. */
status absorbing_oblique(const struct absorbing_method *m, bool shear, double angle, double wavelength,
                         struct absorbing_reflection *measured);

#endif
