/* Return mapping of von Mises plasticity in the four spaces (Simo & Hughes 1998). In the functions below s is the trial
 * stress [Pa], replaced by the stress on the yield surface; `bound` is the yield stress before the step, sigma_y + H a,
 * with the accumulated plastic strain a; the result da is the increment of a [1], 0 for an elastic step. */
#include "plastic.h"

#include <math.h>

/* Relative residual at which Newton's method for plane stress stops, a few round-offs. For trial stresses from 1e-4 to
 * 1e5 yield stresses beyond the surface it takes two to four steps; RETURN_STEPS is never reached. */
#define RETURN_CLOSE 1e-15
enum { RETURN_STEPS = 40 };

/* Return mapping of a uniaxial stress s[0]: solves |s| - E da = bound + H da. Returns da. */
static real return_line(const struct elastic *m, real *s, real bound)
{
    const real excess = fabs(s[0]) - bound;
    if (!(excess > 0)) return 0;
    const real more = excess / (m->c11 + m->hardening);
    s[0] = copysign(bound + m->hardening * more, s[0]);
    return more;
}

/* Solves q - 3 G da = bound + H da, the radial return of a trial stress with the equivalent stress q. q2: q^2 [Pa^2].
 * Returns da; *left: receives the factor by which the deviator of the stress is multiplied, unchanged if da = 0. */
static real return_radial(const struct elastic *m, real q2, real bound, real *left)
{
    if (!(q2 > bound * bound)) return 0;
    const real q = sqrt(q2), more = (q - bound) / (3 * m->shear + m->hardening);
    *left = (bound + m->hardening * more) / q;
    return more;
}

/* Radial return of a 3D stress s (xx, yy, zz, xy, yz, zx). Returns da. */
static real return_solid(const struct elastic *m, real *s, real bound)
{
    const real mean = (s[0] + s[1] + s[2]) / 3, a = s[0] - mean, b = s[1] - mean, c = s[2] - mean;
    const real off = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
    real left = 1;
    const real more = return_radial(m, 1.5 * (a * a + b * b + c * c) + 3 * off, bound, &left);
    if (more == 0) return 0;
    s[0] = mean + left * a, s[1] = mean + left * b, s[2] = mean + left * c;
    for (int k = 3; k < 6; k++) s[k] *= left;
    return more;
}

/* Radial return of a plane-strain stress s (xx, yy, xy). sigma_zz follows from eps_zz = 0: nu (sigma_xx + sigma_yy)
 * plus the part *out_of_plane due to plastic strain [Pa], which is updated. Returns da. */
static real return_plane_strain(const struct elastic *m, real *s, real bound, real *out_of_plane)
{
    const real zz = m->poisson * (s[0] + s[1]) + *out_of_plane, mean = (s[0] + s[1] + zz) / 3;
    const real a = s[0] - mean, b = s[1] - mean, c = zz - mean;
    real left = 1;
    const real more = return_radial(m, 1.5 * (a * a + b * b + c * c) + 3 * s[2] * s[2], bound, &left);
    if (more == 0) return 0;
    s[0] = mean + left * a, s[1] = mean + left * b, s[2] *= left;
    *out_of_plane = mean + left * c - m->poisson * (s[0] + s[1]);
    return more;
}

/* Return mapping of a plane-stress stress s (xx, yy, xy) within sigma_zz = 0 (Simo & Hughes 1998, section 3.4). Returns
 * da. With p = xx + yy and d = xx - yy
 *     q^2 = p^2/4 + 3 d^2/4 + 3 xy^2,   p = p_trial/(1 + A t),   d, xy = trial/(1 + 3 G t),   A = E/(2 (1 - nu))
 * and t = da/q from q (1 - H t) = bound. Written as 1 - H t - bound/q(t) = 0 the left side is decreasing and convex,
 * since 1/q is a power mean of two linear functions, which is concave: Newton's method from t = 0 increases to the
 * root. */
static real return_plane_stress(const struct elastic *m, real *s, real bound)
{
    const real p = s[0] + s[1], d = s[0] - s[1], even = 0.25 * p * p, odd = 0.75 * d * d + 3 * s[2] * s[2];
    if (!(even + odd > bound * bound)) return 0;
    const real A = 0.5 * (m->c11 + m->c12), B = 3 * m->shear;
    real t = 0, u, v, q2, inverse;
    for (int k = 0;; k++) {
        const real both = 1 / ((1 + A * t) * (1 + B * t));
        u = both * (1 + B * t), v = both * (1 + A * t);
        q2 = even * u * u + odd * v * v;
        inverse = 1 / sqrt(q2);
        const real rest = 1 - m->hardening * t - bound * inverse;
        if (!(rest > RETURN_CLOSE) || k == RETURN_STEPS) break;
        const real slope = (even * A * u * u * u + odd * B * v * v * v) * inverse * inverse * inverse;
        t += rest / (m->hardening + bound * slope);
    }
    s[0] = 0.5 * (p * u + d * v), s[1] = 0.5 * (p * u - d * v), s[2] *= v;
    return t * q2 * inverse;
}

real plastic_return(const struct elastic *m, real *stress, real strain, real *out_of_plane)
{
    const real bound = m->yield + m->hardening * strain;
    switch (m->space) {
    case SPACE_LINE:
        return return_line(m, stress, bound);
    case SPACE_PLANE_STRESS:
        return return_plane_stress(m, stress, bound);
    case SPACE_PLANE_STRAIN:
        return return_plane_strain(m, stress, bound, out_of_plane);
    default:
        return return_solid(m, stress, bound);
    }
}
