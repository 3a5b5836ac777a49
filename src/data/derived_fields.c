/* Computes invariants and principal values of symmetric tensors, and lists the output fields that are derived from
 * stored ones in a table. */
#include "data/derived_fields.h"

#include <math.h>
#include <string.h>

enum { XX, YY, ZZ, XY, YZ, XZ }; /* indices of the components of a symmetric tensor */
enum { SWEEPS = 12 };            /* largest number of Jacobi sweeps; they converge quadratically, five suffice */

real tensor_mises_stress(const real s[6])
{
    const real normal = square(s[XX] - s[YY]) + square(s[YY] - s[ZZ]) + square(s[ZZ] - s[XX]);
    return sqrt(0.5 * normal + 3 * (square(s[XY]) + square(s[YZ]) + square(s[XZ])));
}

real tensor_determinant(const real s[6])
{
    return s[XX] * (s[YY] * s[ZZ] - square(s[YZ])) - s[XY] * (s[XY] * s[ZZ] - s[YZ] * s[XZ]) +
           s[XZ] * (s[XY] * s[YZ] - s[YY] * s[XZ]);
}

/* Rotates the axes p and q of the symmetric matrix a such that a[p][q] becomes 0: one Jacobi rotation (Golub & Van
 * Loan, section 8.5). v: matrix whose rows are the axes found so far; rows p and q of it are rotated as well. */
static void axes_turn(real a[3][3], real v[3][3], int p, int q)
{
    if (a[p][q] == 0) return;
    const real tau = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    const real t = (tau >= 0 ? 1 : -1) / (fabs(tau) + sqrt(1 + tau * tau)), c = 1 / sqrt(1 + t * t), s = t * c;
    for (int k = 0; k < 3; k++) {
        const real kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; k++) {
        const real pk = a[p][k], qk = a[q][k], vp = v[p][k], vq = v[q][k];
        a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
        v[p][k] = c * vp - s * vq, v[q][k] = s * vp + c * vq;
    }
    a[p][q] = a[q][p] = 0;
}

/* Copies the unit vector axis[3] to to[3], with the sign that makes its largest component positive. */
static void axis_put(const real *axis, real *to)
{
    int most = 0;
    for (int d = 1; d < 3; d++)
        if (fabs(axis[d]) > fabs(axis[most])) most = d;
    for (int d = 0; d < 3; d++) to[d] = axis[most] < 0 ? -axis[d] : axis[d];
}

void tensor_compute_principal_values(const real s[6], real value[3], real direction[9])
{
    real a[3][3] = {{s[XX], s[XY], s[XZ]}, {s[XY], s[YY], s[YZ]}, {s[XZ], s[YZ], s[ZZ]}};
    real v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int order[3] = {0, 1, 2};
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int k = 0; k < 3; k++) axes_turn(a, v, k == 2, k == 0 ? 1 : 2);
    for (int k = 1; k < 3; k++) /* equal values keep the order of their axes */
        for (int l = k; l > 0 && a[order[l]][order[l]] > a[order[l - 1]][order[l - 1]]; l--) {
            const int held = order[l];
            order[l] = order[l - 1], order[l - 1] = held;
        }
    for (int k = 0; k < 3; k++) value[k] = a[order[k]][order[k]];
    if (!direction) return;
    for (int k = 0; k < 2; k++) axis_put(v[order[k]], direction + 3 * k);
    const real *m = direction, *n = direction + 3;
    direction[6] = m[1] * n[2] - m[2] * n[1];
    direction[7] = m[2] * n[0] - m[0] * n[2];
    direction[8] = m[0] * n[1] - m[1] * n[0];
}

/* ---- the table --------------------------------------------------------------------------------------------------- */

/* Computes *to, the von Mises stress of a particle, from its stress from[6] [Pa]. */
static void mises_from(const real *from, real *to) { *to = tensor_mises_stress(from); }

/* Computes *to, the pressure of a particle (minus the mean normal stress), from its stress from[6] [Pa]. */
static void pressure_from(const real *from, real *to) { *to = -(from[XX] + from[YY] + from[ZZ]) / 3; }

/* Computes to[3], the principal stresses of a particle in descending order, from its stress from[6] [Pa]. */
static void principal_from(const real *from, real *to) { tensor_compute_principal_values(from, to, NULL); }

/* Computes *to, the speed of a particle, from its velocity from[3] [m/s]. */
static void speed_from(const real *from, real *to) { *to = sqrt(dot(from, from, 3)); }

/* Computes to[9], three orthogonal unit vectors along the principal stresses of a particle, in descending order of
 * these, from its stress from[6] [Pa]. */
static void directions_from(const real *from, real *to)
{
    real value[3];
    tensor_compute_principal_values(from, value, to);
}

const struct derived_field derived_fields[DERIVED_FIELDS] = {
    {"von_mises", "Pa", "equivalent stress of von Mises", FROM_STRESS, 1, mises_from},
    {"pressure", "Pa", "minus the mean of the normal stresses", FROM_STRESS, 1, pressure_from},
    {"principal_stress", "Pa", "the three principal stresses in descending order", FROM_STRESS, 3, principal_from},
    {"principal_directions", "", "directions of the principal stresses, three unit vectors", FROM_STRESS, 9,
     directions_from},
    {"speed", "m/s", "length of the velocity", FROM_VELOCITY, 1, speed_from},
};

const struct derived_field *derived_field_find_by_name(const char *name)
{
    for (int k = 0; k < DERIVED_FIELDS; k++)
        if (strcmp(derived_fields[k].name, name) == 0) return &derived_fields[k];
    return NULL;
}
