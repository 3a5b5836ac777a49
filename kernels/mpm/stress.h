/* Updates the stress of a material point by linear elasticity in the rate form of Jaumann, with the velocity
 * gradient L and the elastic tensor C:
 *     sigma += C : eps + W sigma - sigma W,   eps = sym(A) - W W / 2,  W = skew(A),  A = L dt
 * The second-order term of eps makes rotations free of strain: positions that rotate by the angle w in a step
 * have sym(A) = -w^2/2 across the axis (Hughes and Winget 1980, to second order). With sym(A) alone a
 * rotating body of material points grows by w^2/2 per step, its unstrained state differs from that of bonds,
 * and a disc with a peridynamic core gains half its energy in four turns. Components as in base.h; plane
 * stress and plane strain differ in their constants only. */
#ifndef CLEAVE_KERNELS_STRESS
#define CLEAVE_KERNELS_STRESS

#include <math.h>

#include "kernels/kernels.h"
#include "row.h"

/* Rotation angle of a step [rad] above which stress_rotate uses the exact rotation. Below, it uses the series to second
 * order, whose error is a sixth of the cube of the angle. */
#define SPIN_SMALL 1e-3
/* Rotation angle of a step up to which power series give the exact rotation to round-off [rad]. */
#define SPIN_SERIES 0.0625
/* Rotation angle of a step [rad] below which stress_rotate uses the first-order term alone. The stress then grows in
 * each step by the square of the angle, relatively: by 1e-4 in 1e5 steps. */
#define SPIN_NONE 3e-5

/* Rotates the stress s = `stress` (xx, yy, xy) in 2D: s = R s R^T with the rotation R by the angle -`angle` from x to
 * y, where `angle` is W_xy [rad]. */
static inline void stress_rotate_2d(real *stress, real angle)
{
    const real c = cos(2 * angle), n = sin(2 * angle), mean = 0.5 * (stress[0] + stress[1]),
               half = 0.5 * (stress[0] - stress[1]);
    const real turned = half * c + stress[2] * n;
    stress[2] = stress[2] * c - half * n;
    stress[0] = mean + turned, stress[1] = mean - turned;
}

/* Computes the matrix product c = a b of 3 x 3 matrices. */
static ALWAYS_INLINE void matrix_product_3x3(const real a[3][3], const real b[3][3], real c[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
}

/* Rotates the stress s = `stress` (xx, yy, zz, xy, yz, zx) in 3D: s = R s R^T with R = exp W (Rodrigues' formula). wxy,
 * wyz, wzx: components of the antisymmetric matrix W, not all 0 [rad]. */
static inline void stress_rotate_3d(real *stress, real wxy, real wyz, real wzx)
{
    const real S[3][3] = {
        {stress[0], stress[3], stress[5]}, {stress[3], stress[1], stress[4]}, {stress[5], stress[4], stress[2]}};
    const real W[3][3] = {{0, wxy, -wzx}, {-wxy, 0, wyz}, {wzx, -wyz, 0}};
    const real angle2 = wxy * wxy + wyz * wyz + wzx * wzx, angle = sqrt(angle2);
    const real first = sin(angle) / angle, second = (1 - cos(angle)) / angle2;
    real WW[3][3], R[3][3], RS[3][3], turned[3][3];
    matrix_product_3x3(W, W, WW);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) R[a][b] = (a == b) + first * W[a][b] + second * WW[a][b];
    matrix_product_3x3(R, S, RS);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) turned[a][b] = RS[a][0] * R[b][0] + RS[a][1] * R[b][1] + RS[a][2] * R[b][2];
    stress[0] = turned[0][0], stress[1] = turned[1][1], stress[2] = turned[2][2];
    stress[3] = turned[0][1], stress[4] = turned[1][2], stress[5] = turned[2][0];
}

/* Computes the first-order change of the stress by a rotation, increment = W s - s W with the stress s = `stress`, for
 * a few points (one per lane). stress, increment: components xx, yy, xy in 2D, xx, yy, zz, xy, yz, zx in 3D [Pa]; spin:
 * the components W_xy, in 3D also W_yz and W_zx, of the antisymmetric matrix W [rad]. */
static ALWAYS_INLINE void stress_rotation_increment(const row_of_points *stress, const row_of_points *spin,
                                                    row_of_points *increment, const int dim)
{
    if (dim == 2) {
        increment[0] = 2 * spin[0] * stress[2], increment[1] = -increment[0],
        increment[2] = spin[0] * (stress[1] - stress[0]);
        return;
    }
    const row_of_points xy = spin[0] * stress[3], yz = spin[1] * stress[4], zx = spin[2] * stress[5];
    increment[0] = 2 * (xy - zx), increment[1] = 2 * (yz - xy), increment[2] = 2 * (zx - yz);
    increment[3] = spin[0] * (stress[1] - stress[0]) + spin[1] * stress[5] - spin[2] * stress[4];
    increment[4] = spin[1] * (stress[2] - stress[1]) + spin[2] * stress[3] - spin[0] * stress[5];
    increment[5] = spin[2] * (stress[0] - stress[2]) + spin[0] * stress[4] - spin[1] * stress[3];
}

/* Computes the change of the stress s = `stress` of a few points (one per lane) by an exact rotation: increment = R s
 * R^T - s, R = exp(W), with its own rotation angle a for each point. The power series used here are exact to round-off
 * up to a = SPIN_SERIES [rad]; for larger angles the result is not valid. stress, increment: components xx, yy, xy in
 * 2D, xx, yy, zz, xy, yz, zx in 3D; spin: components W_xy, in 3D also W_yz and W_zx, of the antisymmetric matrix W
 * [rad]; angle2: a^2, the sum of the squares of these components [rad^2]. With A s = W s - s W, whose eigenvalues are
 * 0, +-i a and +-2i a,
 *     R s R^T = s + c1 A s + c2 A^2 s + c3 A^3 s + c4 A^4 s,
 *     c1 = (8 sin a - sin 2a)/6a, c2 = (15 - 16 cos a + cos 2a)/12a^2,
 *     c3 = (2 sin a - sin 2a)/6a^3, c4 = (3 - 4 cos a + cos 2a)/12a^4. */
static ALWAYS_INLINE void stress_exact_rotation_increment(const row_of_points *stress, const row_of_points *spin,
                                                          const row_of_points angle2, row_of_points *increment,
                                                          const int dim)
{
    const int n = dim * (dim + 1) / 2;
    const row_of_points c[4] = {1 + angle2 * angle2 * (-1.0 / 30 + angle2 * (1.0 / 252 - angle2 * (1.0 / 4320))),
                                0.5 + angle2 * angle2 * (-1.0 / 180 + angle2 * (1.0 / 2016 - angle2 * (1.0 / 43200))),
                                1.0 / 6 + angle2 * (-1.0 / 24 + angle2 * (1.0 / 240 - angle2 * (17.0 / 72576))),
                                1.0 / 24 + angle2 * (-1.0 / 144 + angle2 * (1.0 / 1920 - angle2 * (17.0 / 725760)))};
    row_of_points sum[SYM_MAX];
    for (int k = 0; k < n; k++) sum[k] = c[3] * stress[k];
    for (int power = 2; power >= 0; power--) {
        stress_rotation_increment(sum, spin, increment, dim);
        for (int k = 0; k < n; k++) sum[k] = c[power] * stress[k] + increment[k];
    }
    stress_rotation_increment(sum, spin, increment, dim);
}

/* Rotates the stresses of a few points (one per lane), each by the rotation exp(W) with its own antisymmetric matrix W:
 * to first order for angles below SPIN_NONE, exactly above SPIN_SMALL, to second order between. stress: components xx,
 * yy, xy in 2D, xx, yy, zz, xy, yz, zx in 3D [Pa]; spin: components W_xy, in 3D also W_yz and W_zx [rad]. */
static ALWAYS_INLINE void stress_rotate(row_of_points *stress, const row_of_points *spin, const int dim)
{
    const int n = dim * (dim + 1) / 2;
    row_of_points more[SYM_MAX], angle2 = spin[0] * spin[0];
    if (dim == 3) angle2 += spin[1] * spin[1] + spin[2] * spin[2];
    stress_rotation_increment(stress, spin, more, dim);
    if (__builtin_expect(points_sign_bits(SPIN_NONE * SPIN_NONE - angle2), 0)) {
        row_of_points middle[SYM_MAX], second[SYM_MAX];
        for (int c = 0; c < n; c++) middle[c] = stress[c] + 0.5 * more[c];
        stress_rotation_increment(middle, spin, second, dim);
        for (int c = 0; c < n; c++) more[c] = points_choose_by_sign(SPIN_NONE * SPIN_NONE - angle2, second[c], more[c]);
    }
    if (__builtin_expect(points_sign_bits(SPIN_SMALL * SPIN_SMALL - angle2), 0)) {
        row_of_points exact[SYM_MAX];
        stress_exact_rotation_increment(stress, spin, angle2, exact, dim);
        for (int c = 0; c < n; c++)
            more[c] = points_choose_by_sign(SPIN_SMALL * SPIN_SMALL - angle2, exact[c], more[c]);
    }
    const int large = points_sign_bits(SPIN_SERIES * SPIN_SERIES - angle2);
    for (int k = 0; k < POINTS && __builtin_expect(large, 0); k++) {
        real turned[SYM_MAX];
        if (!(large >> k & 1)) continue;
        for (int c = 0; c < n; c++) turned[c] = stress[c][k];
        if (dim == 2)
            stress_rotate_2d(turned, spin[0][k]);
        else
            stress_rotate_3d(turned, spin[0][k], spin[1][k], spin[2][k]);
        for (int c = 0; c < n; c++) more[c][k] = turned[c] - stress[c][k];
    }
    for (int c = 0; c < n; c++) stress[c] += more[c];
}

/* Elastic constants (as in struct elastic) of a few material points, one per lane. */
struct elastic_points {
    row_of_points c11, c12, shear, trigger; /* [Pa] */
    bool surface;                           /* one of them has a strength surface */
};

/* Updates the stresses stress[components] [Pa] of a few points (one per lane) for a time step dt [s]: rotation by the
 * spin, then Hooke's law. velocity_gradient[a dim + b]: velocity gradient dv_a/dx_b [1/s]; m: elastic constants.
 * Returns the trace of the strain increment [1]. */
static ALWAYS_INLINE row_of_points stress_update_and_return_strain_trace(row_of_points *stress,
                                                                         const row_of_points *velocity_gradient,
                                                                         const struct elastic_points *m, real dt,
                                                                         const int dim)
{
    if (dim == 1) {
        stress[0] += m->c11 * velocity_gradient[0] * dt;
        return velocity_gradient[0] * dt;
    }
    if (dim == 2) {
        const row_of_points spin = 0.5 * (velocity_gradient[1] - velocity_gradient[2]) * dt, turned = 0.5 * spin * spin;
        const row_of_points xx = velocity_gradient[0] * dt + turned, yy = velocity_gradient[3] * dt + turned;
        stress_rotate(stress, &spin, dim);
        stress[0] += m->c11 * xx + m->c12 * yy;
        stress[1] += m->c12 * xx + m->c11 * yy;
        stress[2] += m->shear * (velocity_gradient[1] + velocity_gradient[2]) * dt;
        return xx + yy;
    }
    const row_of_points spin[3] = {0.5 * (velocity_gradient[1] - velocity_gradient[3]) * dt,
                                   0.5 * (velocity_gradient[5] - velocity_gradient[7]) * dt,
                                   0.5 * (velocity_gradient[6] - velocity_gradient[2]) * dt};
    const row_of_points half[3] = {0.5 * spin[0] * spin[0], 0.5 * spin[1] * spin[1], 0.5 * spin[2] * spin[2]};
    const row_of_points xx = velocity_gradient[0] * dt + half[0] + half[2],
                        yy = velocity_gradient[4] * dt + half[0] + half[1],
                        zz = velocity_gradient[8] * dt + half[1] + half[2];
    const row_of_points trace = xx + yy + zz, pressure = m->c12 * trace, twice = m->c11 - m->c12;
    stress_rotate(stress, spin, dim);
    stress[0] += pressure + twice * xx;
    stress[1] += pressure + twice * yy;
    stress[2] += pressure + twice * zz;
    stress[3] += m->shear * ((velocity_gradient[1] + velocity_gradient[3]) * dt - spin[1] * spin[2]);
    stress[4] += m->shear * ((velocity_gradient[5] + velocity_gradient[7]) * dt - spin[0] * spin[2]);
    stress[5] += m->shear * ((velocity_gradient[6] + velocity_gradient[2]) * dt - spin[0] * spin[1]);
    return trace;
}

/* Returns the largest principal stress [Pa] of the stress `stress` (components xx yy xy in 2D, xx yy zz xy yz zx in
 * 3D), in 3D by the trigonometric solution of the cubic equation. */
static ALWAYS_INLINE real stress_largest_principal(const real *stress, const int dim)
{
    if (dim == 1) return stress[0];
    if (dim == 2)
        return 0.5 * (stress[0] + stress[1]) +
               sqrt(0.25 * (stress[0] - stress[1]) * (stress[0] - stress[1]) + stress[2] * stress[2]);
    const real mean = (stress[0] + stress[1] + stress[2]) / 3, a = stress[0] - mean, b = stress[1] - mean,
               c = stress[2] - mean;
    const real off = stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5];
    const real j2 = 0.5 * (a * a + b * b + c * c) + off;
    if (j2 <= 0) return mean;
    const real j3 = a * b * c + 2 * stress[3] * stress[4] * stress[5] - a * stress[4] * stress[4] -
                    b * stress[5] * stress[5] - c * stress[3] * stress[3];
    real cosine = 1.5 * sqrt(3.0) * j3 / (j2 * sqrt(j2));
    cosine = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
    return mean + 2 * sqrt(j2 / 3) * cos(acos(cosine) / 3);
}

/* Returns an upper bound [Pa] of the largest principal stress of the stress `stress` (components xx yy xy in 2D, xx yy
 * zz xy yz zx in 3D). The principal stress itself is computed only where this bound exceeds the conversion stress (at
 * which a point becomes peridynamic). */
static ALWAYS_INLINE real stress_largest_principal_upper_bound(const real *stress, const int dim)
{
    if (dim == 1) return stress[0];
    if (dim == 2) return 0.5 * (stress[0] + stress[1]) + 0.5 * fabs(stress[0] - stress[1]) + fabs(stress[2]);
    real most = stress[0] > stress[1] ? stress[0] : stress[1];
    most = most > stress[2] ? most : stress[2];
    return most + 2 * (fabs(stress[3]) + fabs(stress[4]) + fabs(stress[5]));
}

/* Returns upper bounds [Pa] of the largest principal stresses of a few points, one per lane. stress: components xx yy
 * xy in 2D, xx yy zz xy yz zx in 3D. */
static ALWAYS_INLINE row_of_points stress_largest_principal_upper_bounds(const row_of_points *stress, const int dim)
{
    if (dim == 1) return stress[0];
    if (dim == 2) return points_max(stress[0], stress[1]) + points_absolute(stress[2]);
    return points_max(points_max(stress[0], stress[1]), stress[2]) +
           2 * (points_absolute(stress[3]) + points_absolute(stress[4]) + points_absolute(stress[5]));
}

/* Returns sqrt(J2) + g1 I1 [Pa] of the stress `stress` (symmetric components [Pa]), the measure that the strength
 * surface of material m limits (data/strength_surface.h). */
static ALWAYS_INLINE real stress_drucker_prager_measure(const struct elastic *m, const real *stress, const int dim)
{
    const real across = m->space == SPACE_PLANE_STRAIN ? m->poisson : 0;
    return strength_surface_stress_tensor_to_strength_ratio(&m->surface, stress, across, dim) * m->surface.g0;
}

/* Returns true if material point i of p, of material m, converts to a peridynamic particle at the stress `stress`: if
 * the largest principal stress exceeds its conversion stress, or if the stress exceeds the strength surface of the
 * material. stress: symmetric components [Pa]. */
static ALWAYS_INLINE bool stress_requires_conversion_to_pd(const struct elastic *m, const struct particles *p,
                                                           int64_t i, const real *stress, const int dim)
{
    const real most = point_stress_threshold_for_conversion_to_pd(m, p, i);
    if (stress_largest_principal_upper_bound(stress, dim) > most && stress_largest_principal(stress, dim) > most)
        return true;
    if (dim == 1 || !(m->surface.g0 > 0)) return false;
    return stress_drucker_prager_measure(m, stress, dim) > m->failure * (p->strength ? p->strength[i] : 1);
}

/* Computes into `stress` (symmetric components [Pa]) the stress that material point i of p transmits to the grid: all
 * of its stress, or the part that bonds to peridynamic particles do not carry. partial: matrices that give the part
 * carried by bonds; NULL: bonds carry no stress. */
static ALWAYS_INLINE void point_compute_stress_transmitted_to_grid(const struct particles *p,
                                                                   const struct partial_stress *partial, int64_t i,
                                                                   real *stress, const int dim)
{
    const int n = dim * (dim + 1) / 2;
    for (int s = 0; s < n; s++) stress[s] = p->stress[s][i];
    if (!partial || !partial->index || partial->index[i] < 0) return;
    const real *M = partial->matrix + (int64_t)partial->index[i] * n * n;
    real borne[SYM_MAX];
    for (int a = 0; a < n; a++) {
        borne[a] = 0;
        for (int b = 0; b < n; b++) borne[a] += M[a * n + b] * stress[b];
    }
    for (int a = 0; a < n; a++) stress[a] -= borne[a];
    if (!partial->local) return;
    const real *local = partial->local + (int64_t)partial->index[i] * n, pull = p->end_pull[i] / p->volume[i];
    for (int a = 0; a < n; a++) stress[a] += pull * local[a];
}

/* Rotates vector[3] by a unit quaternion, in place. quaternion: first the three components along the axes, then the
 * scalar component. */
static inline void quaternion_rotate_vector(const real *quaternion, real *vector)
{
    real u[3], old[3] = {vector[0], vector[1], vector[2]};
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        u[k] = quaternion[3] * old[k] + quaternion[i] * old[j] - quaternion[j] * old[i];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        vector[k] = old[k] + 2 * (quaternion[i] * u[j] - quaternion[j] * u[i]);
    }
}

/* Computes into `skew` the antisymmetric part of the stress that material point i of p transmits to the grid:
 * components sigma_ab in the order xy, yz, zx, in 2D xy only [Pa]. partial: partial stresses, which tell the points
 * that have bonds. This part balances the moment of the state-based bonds of the point. Returns true, or false if there
 * is none. */
static ALWAYS_INLINE bool point_compute_skew_stress_transmitted_to_grid(const struct particles *p,
                                                                        const struct partial_stress *partial, int64_t i,
                                                                        real *skew, const int dim)
{
    if (!partial || !partial->local || !p->end_moment[0] || partial->index[i] < 0) return false;
    const real half = 0.5 / p->volume[i];
    if (dim == 2) {
        skew[0] = half * p->end_moment[0][i];
        return true;
    }
    const real rotation[ROTATION] = {p->end_rotation[0][i], p->end_rotation[1][i], p->end_rotation[2][i],
                                     p->end_rotation[3][i]};
    real moment[3] = {p->end_moment[0][i], p->end_moment[1][i], p->end_moment[2][i]};
    quaternion_rotate_vector(rotation, moment);
    for (int c = 0; c < 3; c++) skew[c] = half * moment[(c + 2) % 3];
    return true;
}

#endif
