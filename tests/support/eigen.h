/* Eigenvalues of small dense matrices, for tests: symmetric matrices by Householder reduction and QL (tred1, tql1),
 * others by Hessenberg form and QR (elmhes, hqr), after Wilkinson & Reinsch 1971. Matrices are row major and are
 * overwritten. */
#ifndef CLEAVE_TESTS_EIGEN
#define CLEAVE_TESTS_EIGEN

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/base.h"

/* ---- symmetric --------------------------------------------------------------------------------------------------- */

/* Reduces row i of the symmetric matrix a[n][n], of which only the lower half is stored, to its diagonal and one
 * off-diagonal entry, e[i], by a Householder reflection that changes the rows above it. Call it for i = n - 1 down to
 * 0. d[n] is scratch; the diagonal of the tridiagonal matrix remains in a. */
static inline void eigen_reduce_row(real *a, int64_t n, int64_t i, real *d, real *e)
{
    real *row = a + i * n, scale = 0, h = 0, f = 0;
    for (int64_t k = 0; k < i; k++) scale += fabs(row[k]);
    e[i] = i > 0 ? row[i - 1] : 0;
    if (i < 2 || scale == 0) return;
    for (int64_t k = 0; k < i; k++) row[k] /= scale, h += square(row[k]);
    const real g = row[i - 1] >= 0 ? -sqrt(h) : sqrt(h);
    e[i] = scale * g;
    h -= row[i - 1] * g;
    row[i - 1] -= g;
    for (int64_t j = 0; j < i; j++) d[j] = 0;
    for (int64_t j = 0; j < i; j++) { /* d = A u, from the lower half, row by row */
        const real *lower = a + j * n, u = row[j];
        real sum = lower[j] * u;
        for (int64_t k = 0; k < j; k++) sum += lower[k] * row[k], d[k] += lower[k] * u;
        d[j] += sum;
    }
    for (int64_t j = 0; j < i; j++) d[j] /= h, f += d[j] * row[j];
    for (int64_t j = 0; j < i; j++) d[j] -= f / (h + h) * row[j];
    for (int64_t j = 0; j < i; j++)
        for (int64_t k = 0; k <= j; k++) a[j * n + k] -= row[j] * d[k] + d[j] * row[k];
}

/* Performs one implicit QL sweep on rows l .. m of a symmetric tridiagonal matrix, from m to l, with a shift near an
 * eigenvalue, after which e[l] is closer to 0. d: diagonal; e[k]: entry between rows k and k + 1. */
static inline void eigen_sweep(real *d, real *e, int64_t l, int64_t m)
{
    real g = (d[l + 1] - d[l]) / (2 * e[l]), r = hypot(g, 1), s = 1, c = 1, p = 0;
    int64_t i;
    g = d[m] - d[l] + e[l] / (g + copysign(r, g));
    for (i = m - 1; i >= l; i--) {
        real f = s * e[i];
        const real b = c * e[i];
        e[i + 1] = r = hypot(f, g);
        if (r == 0) {
            d[i + 1] -= p, e[m] = 0;
            return;
        }
        s = f / r, c = g / r;
        g = d[i + 1] - p;
        r = (d[i] - g) * s + 2 * c * b;
        p = s * r;
        d[i + 1] = g + p;
        g = c * r - b;
    }
    d[l] -= p, e[l] = g, e[m] = 0;
}

/* Compares the numbers (real) at a and b for qsort, in ascending order. */
static inline int eigen_ascending(const void *a, const void *b)
{
    const real x = *(const real *)a, y = *(const real *)b;
    return (x > y) - (x < y);
}

/* Computes all eigenvalues of the symmetric matrix a[n][n] into d[n], in ascending order. Reads the lower half of a and
 * overwrites it; e[n] is scratch. */
static inline void eigen_symmetric(real *a, int64_t n, real *d, real *e)
{
    for (int64_t i = n - 1; i >= 0; i--) eigen_reduce_row(a, n, i, d, e);
    for (int64_t i = 0; i < n; i++) d[i] = a[i * n + i];
    for (int64_t i = 1; i < n; i++) e[i - 1] = e[i];
    if (n > 0) e[n - 1] = 0;
    for (int64_t l = 0; l < n; l++)
        for (int rounds = 0; rounds < 60; rounds++) {
            int64_t m = l;
            while (m < n - 1 && fabs(e[m]) > DBL_EPSILON * (fabs(d[m]) + fabs(d[m + 1]))) m++;
            if (m == l) break;
            eigen_sweep(d, e, l, m);
        }
    qsort(d, (size_t)n, sizeof *d, eigen_ascending);
}

/* ---- general ----------------------------------------------------------------------------------------------------- */

/* Transforms the matrix a[n][n] in place to Hessenberg form with the same eigenvalues, by elimination with pivoting.
 * The entries below the first subdiagonal become 0. */
static inline void eigen_hessenberg(real *a, int64_t n)
{
    for (int64_t m = 1; m < n - 1; m++) {
        int64_t pivot = m;
        for (int64_t j = m; j < n; j++)
            if (fabs(a[j * n + m - 1]) > fabs(a[pivot * n + m - 1])) pivot = j;
        const real x = a[pivot * n + m - 1];
        if (x == 0) continue;
        for (int64_t j = m - 1; pivot != m && j < n; j++) {
            const real t = a[pivot * n + j];
            a[pivot * n + j] = a[m * n + j], a[m * n + j] = t;
        }
        for (int64_t j = 0; pivot != m && j < n; j++) {
            const real t = a[j * n + pivot];
            a[j * n + pivot] = a[j * n + m], a[j * n + m] = t;
        }
        for (int64_t i = m + 1; i < n; i++) {
            const real y = a[i * n + m - 1] / x;
            if (y == 0) continue;
            for (int64_t j = m - 1; j < n; j++) a[i * n + j] -= y * a[m * n + j];
            a[i * n + m - 1] = 0;
            for (int64_t j = 0; j < n; j++) a[j * n + m] += y * a[j * n + i];
        }
    }
}

/* Performs a double QR step on rows l .. high of the Hessenberg matrix a[n][n]: two shifts at once, in real numbers. m:
 * row from which it acts, at least l; p, q, r: first three entries of the column m of the shifted matrix, up to a
 * factor (eigen_start). */
static inline void eigen_double_step(real *a, int64_t n, int64_t l, int64_t m, int64_t high, real p, real q, real r)
{
    for (int64_t k = m; k < high; k++) {
        real scale = 1;
        if (k != m) {
            p = a[k * n + k - 1], q = a[(k + 1) * n + k - 1], r = k + 1 < high ? a[(k + 2) * n + k - 1] : 0;
            scale = fabs(p) + fabs(q) + fabs(r);
            if (scale == 0) continue;
            p /= scale, q /= scale, r /= scale;
        }
        const real s = copysign(sqrt(p * p + q * q + r * r), p);
        if (s == 0) continue;
        if (k != m)
            a[k * n + k - 1] = -s * scale;
        else if (l != m)
            a[k * n + k - 1] = -a[k * n + k - 1];
        p += s;
        const real x = p / s, y = q / s, z = r / s;
        q /= p, r /= p;
        for (int64_t j = k; j <= high; j++) {
            const real t = a[k * n + j] + q * a[(k + 1) * n + j] + (k + 1 < high ? r * a[(k + 2) * n + j] : 0);
            if (k + 1 < high) a[(k + 2) * n + j] -= t * z;
            a[(k + 1) * n + j] -= t * y;
            a[k * n + j] -= t * x;
        }
        const int64_t end = high < k + 3 ? high : k + 3;
        for (int64_t i = l; i <= end; i++) {
            const real t = x * a[i * n + k] + y * a[i * n + k + 1] + (k + 1 < high ? z * a[i * n + k + 2] : 0);
            if (k + 1 < high) a[i * n + k + 2] -= t * r;
            a[i * n + k + 1] -= t * q;
            a[i * n + k] -= t;
        }
    }
}

/* Performs a double QR step on rows l .. high (at least three) of the Hessenberg matrix a[n][n]. It starts at the last
 * row where two consecutive subdiagonal entries are so small that rows above need not take part. x, y: the last and the
 * last but one diagonal entry; w: product of the two off-diagonal entries beside them, which together give both
 * shifts. */
static inline void eigen_start(real *a, int64_t n, int64_t l, int64_t high, real x, real y, real w)
{
    int64_t m;
    real p = 0, q = 0, r = 0;
    for (m = high - 2; m >= l; m--) {
        const real z = a[m * n + m], s = y - z, t = x - z;
        p = (t * s - w) / a[(m + 1) * n + m] + a[m * n + m + 1];
        q = a[(m + 1) * n + m + 1] - z - t - s;
        r = a[(m + 2) * n + m + 1];
        const real scale = fabs(p) + fabs(q) + fabs(r);
        p /= scale, q /= scale, r /= scale;
        if (m == l) break;
        const real u = fabs(a[m * n + m - 1]) * (fabs(q) + fabs(r));
        const real v = fabs(p) * (fabs(a[(m - 1) * n + m - 1]) + fabs(z) + fabs(a[(m + 1) * n + m + 1]));
        if (u <= DBL_EPSILON * v) break;
    }
    for (int64_t i = m + 2; i <= high; i++) {
        a[i * n + i - 2] = 0;
        if (i > m + 2) a[i * n + i - 3] = 0;
    }
    eigen_double_step(a, n, l, m, high, p, q, r);
}

/* Returns the largest magnitude of the imaginary parts of the eigenvalues of the matrix a[n][n], 0 if all are real, and
 * stores the smallest real part in *real_least. Overwrites a. Returns NAN if an eigenvalue is not found within 200
 * steps; *real_least is then of no use. */
static inline real eigen_imaginary(real *a, int64_t n, real *real_least)
{
    real most = 0, shift = 0, norm = 0;
    *real_least = INFINITY;
    eigen_hessenberg(a, n);
    for (int64_t i = 0; i < n; i++)
        for (int64_t j = i > 0 ? i - 1 : 0; j < n; j++) norm += fabs(a[i * n + j]);
    for (int64_t high = n - 1, rounds = 0; high >= 0;) {
        int64_t l = high;
        for (; l > 0; l--) {
            real s = fabs(a[(l - 1) * n + l - 1]) + fabs(a[l * n + l]);
            if (s == 0) s = norm;
            if (fabs(a[l * n + l - 1]) <= DBL_EPSILON * s) break;
        }
        real x = a[high * n + high];
        if (l == high) {
            *real_least = real_min(*real_least, x + shift);
            high--, rounds = 0;
            continue;
        }
        real y = a[(high - 1) * n + high - 1], w = a[high * n + high - 1] * a[(high - 1) * n + high];
        if (l == high - 1) {
            const real p = 0.5 * (y - x), q = p * p + w;
            if (q < 0) most = real_max(most, sqrt(-q));
            *real_least = real_min(*real_least, x + shift + p - (q > 0 ? sqrt(q) : 0));
            high -= 2, rounds = 0;
            continue;
        }
        if (++rounds > 200) return NAN;
        if (rounds % 10 == 0) {
            shift += x;
            for (int64_t i = 0; i <= high; i++) a[i * n + i] -= x;
            const real s = fabs(a[high * n + high - 1]) + fabs(a[(high - 1) * n + high - 2]);
            x = y = 0.75 * s, w = -0.4375 * s * s;
        }
        eigen_start(a, n, l, high, x, y, w);
    }
    return most;
}

#endif
