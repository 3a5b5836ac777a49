/* Computes the fields at crack tips at rest and in motion, and the universal functions and factors by which the tip
 * speed changes stress-intensity factors. */
#include "fracture/sif_fields.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#define HALVINGS 45 /* number of bisections of a speed interval, to round-off of k */
#define REST 0.01   /* tip speed divided by the shear wave speed below which the crack counts as at rest [1] */

static const real pi = 3.14159265358979323846;

struct crack_medium crack_medium_of_material(const struct material *m, enum space space)
{
    const real nu = m->poisson;
    const bool thin = space == SPACE_PLANE_STRESS;
    INVARIANT(space_dim(space) == 2);
    return (struct crack_medium){.shear = m->shear,
                                 .lambda = m->c12,
                                 .poisson = nu,
                                 .density = m->density,
                                 .kappa = thin ? (3 - nu) / (1 + nu) : 3 - 4 * nu,
                                 .modulus = thin ? m->young : m->young / (1 - nu * nu),
                                 .longitudinal = m->wave_speed,
                                 .shear_speed = m->shear_speed,
                                 .rayleigh = m->rayleigh_speed};
}

void crack_medium_stress_from_displacement_gradient(const struct crack_medium *m, real gradient[2][2],
                                                    real stress[2][2])
{
    const real dilatation = gradient[0][0] + gradient[1][1];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            stress[i][j] = m->shear * (gradient[i][j] + gradient[j][i]) + (i == j ? m->lambda * dilatation : 0);
}

/* ---- a crack at rest --------------------------------------------------------------------------------------------- */

/* Computes g(theta) and slope = dg/dtheta [1] of the displacements u = K sqrt(r/(2 pi))/(2 G) g(theta) around the tip
 * of a crack at rest (Williams 1957), along the crack and perpendicular to it. K, G: stress-intensity factor and shear
 * modulus; r, theta: distance from the tip and angle from the crack direction [rad]; kappa: Kolosov's constant [1];
 * mode: I or II. */
static void williams_angular(real kappa, enum crack_mode mode, real theta, real g[2], real slope[2])
{
    const real c = cos(0.5 * theta), s = sin(0.5 * theta);
    if (mode == MODE_I) {
        g[0] = c * (kappa - 1 + 2 * s * s), slope[0] = 0.5 * (-s * (kappa - 1 + 2 * s * s) + 4 * s * c * c);
        g[1] = s * (kappa + 1 - 2 * c * c), slope[1] = 0.5 * (c * (kappa + 1 - 2 * c * c) + 4 * c * s * s);
    } else {
        g[0] = s * (kappa + 1 + 2 * c * c), slope[0] = 0.5 * (c * (kappa + 1 + 2 * c * c) - 4 * c * s * s);
        g[1] = -c * (kappa - 1 - 2 * s * s), slope[1] = 0.5 * (s * (kappa - 1 - 2 * s * s) + 4 * s * c * c);
    }
}

void crack_tip_unit_sif_field_at_rest(const struct crack_medium *m, enum crack_mode mode, const real x[2],
                                      struct crack_field *f)
{
    const real r = hypot(x[0], x[1]), theta = atan2(x[1], x[0]), c = cos(theta), s = sin(theta);
    const real size = sqrt(r / (2 * pi)) / (2 * m->shear);
    real g[2], slope[2];
    williams_angular(m->kappa, mode, theta, g, slope);
    memset(f, 0, sizeof *f);
    for (int i = 0; i < 2; i++) {
        f->displacement[i] = size * g[i];
        f->state.gradient[i][0] = size / r * (0.5 * g[i] * c - slope[i] * s);
        f->state.gradient[i][1] = size / r * (0.5 * g[i] * s + slope[i] * c);
    }
    crack_medium_stress_from_displacement_gradient(m, f->state.gradient, f->state.stress);
}

/* ---- a moving crack ---------------------------------------------------------------------------------------------- */

/* Computes a[0] = sqrt(1 - v^2/c_d^2) and a[1] = sqrt(1 - v^2/c_s^2) [1] for the tip speed v [m/s], which must be below
 * c_s. c_d, c_s: speeds of dilatational and of shear waves in the material m. */
static void slownesses(const struct crack_medium *m, real v, real a[2])
{
    a[0] = sqrt(1 - square(v / m->longitudinal));
    a[1] = sqrt(1 - square(v / m->shear_speed));
}

/* Returns the Rayleigh function D(v) = 4 a_d a_s - (1 + a_s^2)^2 [1] of the material m at the tip speed v [m/s]. a_d =
 * sqrt(1 - v^2/c_d^2) and a_s = sqrt(1 - v^2/c_s^2) contain the speeds c_d of dilatational and c_s of shear waves. D is
 * 0 at the Rayleigh speed. */
static real crack_rayleigh_function(const struct crack_medium *m, real v)
{
    real a[2];
    slownesses(m, v, a);
    return 4 * a[0] * a[1] - square(1 + a[1] * a[1]);
}

/* Computes weight[i][w], the coefficients of the displacements u_i around a tip of speed v [m/s] (i = 0: along the
 * crack, 1: perpendicular to it; w = 0: dilatational, 1: shear waves). u_i is the real or the imaginary part of sum_w
 * weight[i][w] sqrt(z_w), with the complex number z_w = x_1 + a_w x_2 sqrt(-1): the real part for i = 0 in mode I and
 * for i = 1 in mode II, else the imaginary part. m: material; a[2]: the factors a_w = sqrt(1 - v^2/c_w^2) with the wave
 * speeds c_w. */
static void wave_weights(const struct crack_medium *m, enum crack_mode mode, real v, const real a[2], real weight[2][2])
{
    const real size = sqrt(2 / pi) / (m->shear * crack_rayleigh_function(m, v)), b = 1 + a[1] * a[1];
    const real one[2][2] = {{b, -2 * a[0] * a[1]}, {-a[0] * b, 2 * a[0]}};
    const real two[2][2] = {{2 * a[1], -a[1] * b}, {2 * a[0] * a[1], -b}};
    for (int i = 0; i < 2; i++)
        for (int w = 0; w < 2; w++) weight[i][w] = size * (mode == MODE_I ? one : two)[i][w];
}

void crack_tip_unit_sif_field_moving(const struct crack_medium *m, enum crack_mode mode, real speed, const real x[2],
                                     struct crack_field *f)
{
    real a[2], weight[2][2], twice_along[2] = {0};
    slownesses(m, speed, a);
    wave_weights(m, mode, speed, a, weight);
    memset(f, 0, sizeof *f);
    for (int w = 0; w < 2; w++) {
        const double complex z = x[0] + I * (a[w] * x[1]), root = csqrt(z), slope = 0.5 / root,
                             bend = -0.25 / (root * z);
        for (int i = 0; i < 2; i++) {
            const bool real_part = (mode == MODE_I) == (i == 0);
            const double complex unit = weight[i][w] * (real_part ? 1 : -I); /* Im z = Re(-i z) */
            f->displacement[i] += creal(unit * root);
            f->state.gradient[i][0] += creal(unit * slope);
            f->state.gradient[i][1] += creal(unit * I * a[w] * slope);
            twice_along[i] += creal(unit * bend);
        }
    }
    crack_medium_stress_from_displacement_gradient(m, f->state.gradient, f->state.stress);
    for (int i = 0; i < 2; i++) { /* steady in the moving frame: d/dt = -speed d/dx1 */
        f->state.velocity[i] = -speed * f->state.gradient[i][0];
        f->state.velocity_along[i] = -speed * twice_along[i];
        f->state.acceleration[i] = speed * speed * twice_along[i];
    }
}

void crack_tip_unit_sif_field_at_any_speed(const struct crack_medium *m, enum crack_mode mode, real speed,
                                           const real x[2], struct crack_field *f)
{
    if (speed < REST * m->shear_speed)
        crack_tip_unit_sif_field_at_rest(m, mode, x, f);
    else
        crack_tip_unit_sif_field_moving(m, mode, speed, x, f);
}

real crack_tip_speed_universal_function(const struct crack_medium *m, enum crack_mode mode, real speed)
{
    real a[2];
    if (speed < REST * m->shear_speed) return 1;
    slownesses(m, speed, a);
    return 4 * a[mode] * (1 - a[1] * a[1]) / ((m->kappa + 1) * crack_rayleigh_function(m, speed));
}

/* ---- growth at constant speed ------------------------------------------------------------------------------------ */

/* Returns the angle in the integrand of the speed factor k(v) of a crack [rad] at the slowness z [s/m], which is
 * between 1/c_d and 1/c_s (Freund 1990, eq. 6.4.26). c_d, c_s: speeds of dilatational and of shear waves in the
 * material m. */
static real factor_angle(const struct crack_medium *m, real z)
{
    const real a = 1 / m->longitudinal, b = 1 / m->shear_speed;
    return atan(4 * z * z * sqrt(real_max(0, (z * z - a * a) * (b * b - z * z))) / square(b * b - 2 * z * z));
}

/* Returns the factor k(v) by which the constant speed v [m/s] of a crack in the material m changes its stress-intensity
 * factor [1], by numerical integration (Freund 1990). The integrand has square roots at both ends. The substitution z =
 * middle - half cos(phi) makes it smooth and periodic in phi, where the midpoint rule converges faster than any
 * power. */
static real factor_exact(const struct crack_medium *m, real v)
{
    enum { POINTS = 256 };
    const real a = 1 / m->longitudinal, b = 1 / m->shear_speed, middle = 0.5 * (a + b), half = 0.5 * (b - a);
    real sum = 0;
    for (int k = 0; k < POINTS; k++) {
        const real phi = (k + 0.5) * pi / POINTS, z = middle - half * cos(phi);
        sum += factor_angle(m, z) * v / (1 - v * z) * half * sin(phi) * pi / POINTS;
    }
    return (1 - v / m->rayleigh) / sqrt(1 - v / m->longitudinal) * exp(sum / pi);
}

real crack_moving_to_resting_sif_ratio(const struct crack_medium *m, enum speed_factor form, real speed)
{
    const real c_d = m->longitudinal, c_s = m->shear_speed, falling = 1 - speed / m->rayleigh;
    if (form == SPEED_EXACT) return factor_exact(m, speed);
    if (form == SPEED_APPROXIMATE) return falling / sqrt(1 - speed / c_d);
    const real h = 2 / c_d * square(c_s / m->rayleigh) * (1 - square(c_s / c_d));
    return falling / sqrt(1 - h * speed);
}

real crack_speed_from_sif_ratio(const struct crack_medium *m, real sif_ratio, real max_speed)
{
    real low = 0, high = max_speed;
    if (sif_ratio >= 1) return 0;
    if (factor_exact(m, max_speed) >= sif_ratio) return max_speed;
    for (int k = 0; k < HALVINGS; k++) { /* k decreases from 1 at rest to 0 at c_R */
        const real v = 0.5 * (low + high);
        *(factor_exact(m, v) > sif_ratio ? &low : &high) = v;
    }
    return 0.5 * (low + high);
}

real crack_sif_after_plane_wave(const struct crack_medium *m, real wave_stress, real time_since_arrival)
{
    const real nu = m->poisson;
    return time_since_arrival > 0
               ? 2 * wave_stress * sqrt(m->longitudinal * time_since_arrival * (1 - 2 * nu) / pi) / (1 - nu)
               : 0;
}

/* ---- direction of growth ----------------------------------------------------------------------------------------- */

/* Returns the angle between a crack and the direction of the largest circumferential stress ahead of its tip [rad]
 * (Erdogan & Sih 1963), by a formula that stays accurate as K_II -> 0. K: stress-intensity factors of modes I and II.
 * The angle is negative for positive K_II. */
real crack_kink_angle_from_sif(const real K[MODES])
{
    return 2 * atan2(-2 * K[MODE_II], K[MODE_I] + sqrt(square(K[MODE_I]) + 8 * square(K[MODE_II])));
}

real crack_equivalent_sif(const real K[MODES])
{
    const real theta = crack_kink_angle_from_sif(K), c = cos(0.5 * theta);
    return c * c * c * K[MODE_I] - 1.5 * c * sin(theta) * K[MODE_II];
}
