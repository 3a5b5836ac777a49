/* Reflection from dashpots in closed form (Lysmer & Kuhlemeyer 1969). */
#include <complex.h>
#undef I /* avoids a conflict of the imaginary unit with other headers */
#include <math.h>

#include "absorbing_bench.h"

/* A plane wave a exp(i w (s x + p y - t)): amplitude a of the displacement, slowness s along x; the frequency w and
 * the slowness p along y are those of the incident wave. */
struct plane_wave {
    double complex s, a[2];
};

/* Computes by how much the plane wave w violates the boundary conditions of dashpots at x = 0 (Lysmer & Kuhlemeyer
 * 1969), divided by i times its frequency. to[0]: stress_xx + rho c_p v_x; to[1]: stress_xy + rho c_s v_y, both of
 * which should be 0. p: slowness along y. Density and c_p are 1; mu: shear modulus, thus c_s^2. */
static void conditions(const struct plane_wave *w, double p, double mu, double complex *to)
{
    to[0] = w->s * w->a[0] + (1 - 2 * mu) * p * w->a[1] - w->a[0];
    to[1] = mu * (p * w->a[0] + w->s * w->a[1]) - sqrt(mu) * w->a[1];
}

struct absorbing_reflection absorbing_reflection_in_closed_form(bool shear, double angle, double wave_speed_ratio)
{
    const double cs = 1 / wave_speed_ratio, mu = cs * cs, p = sin(angle) / (shear ? cs : 1);
    const double complex qp = csqrt(1 - p * p + 0 * _Complex_I), qs = csqrt(1 / mu - p * p + 0 * _Complex_I);
    const struct plane_wave in = shear ? (struct plane_wave){qs, {-p * cs, qs * cs}} : (struct plane_wave){qp, {qp, p}};
    const struct plane_wave as_p = {-qp, {-qp, p}}, as_s = {-qs, {-p * cs, -qs * cs}};
    double complex b[2], m[2], n[2];
    conditions(&in, p, mu, b), conditions(&as_p, p, mu, m), conditions(&as_s, p, mu, n);
    const double complex det = m[0] * n[1] - n[0] * m[1];
    return (struct absorbing_reflection){cabs((n[0] * b[1] - b[0] * n[1]) / det),
                                         cabs((b[0] * m[1] - m[0] * b[1]) / det)};
}
