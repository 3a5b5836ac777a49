/* What the parts of `cleave bench absorbing` share. */
#ifndef CLEAVE_ABSORBING_BENCH
#define CLEAVE_ABSORBING_BENCH

#include "bench/common/bench.h"

/* Of all bodies: a metre is a thousand spacings, the fastest waves run at 100 m/s. */
#define ABSORBING_SPACING 1e-3
#define ABSORBING_SPEED 100.0

/* A way to move particles: keys of a scene. */
struct absorbing_method {
    const char *name, *keys;
};
enum { ABSORBING_METHODS = 6 };
extern const struct absorbing_method absorbing_methods[ABSORBING_METHODS];

/* A plane longitudinal pulse `width` spacings wide meets an absorbing face at right angles; dim 1 .. 3. reflected:
 * largest velocity that comes back, over that of the pulse; balance: largest error of the energy balance; back: the
 * largest energy that the face gave in a step, over that of the pulse [1]. */
struct absorbing_pulse {
    double reflected, balance, back;
};
status absorbing_pulse(const struct absorbing_method *m, int dim, int width, struct absorbing_pulse *figure);

/* ---- oblique waves ----------------------------------------------------------------------------------------------- */

/* Amplitudes of displacement that come back from a wave of amplitude 1, as P and as S wave [1]. */
struct absorbing_reflection {
    double as_p, as_s;
};
/* Closed form for a half space of wave speeds 1 and `ratio` (P over S), both dashpots, by the slowness along the face:
 * normal and tangential traction vanish together with those of the dashpots (Lysmer & Kuhlemeyer 1969). `angle`
 * between the incoming wave's direction and the normal [rad]. */
struct absorbing_reflection absorbing_theory(bool shear, double angle, double ratio);
/* The same measured: two plane waves at +-angle between two mirrors, whose distance is half a wavelength along the
 * face, `wavelength` spacings long; plane strain, Poisson's ratio 1/4. */
status absorbing_oblique(const struct absorbing_method *m, bool shear, double angle, double wavelength,
                         struct absorbing_reflection *measured);

#endif
