/* Computes stress-intensity factors by fitting the Williams series to the displacements around a crack tip. */
#include "fracture/tip_fit.h"

#include <math.h>
#include <string.h>

/* Number of terms of the Williams series for each mode; number of unknowns, with a rigid displacement. */
enum { TERMS = 9, UNKNOWNS = MODES * TERMS + 2 };

/* Distance ahead of the tip from which visibility is tested, since the crack itself ends at the tip [inner radius]. */
#define AHEAD 1e-3
/* Distance from the line of the last segment of the crack below which a particle counts as on neither side [inner
 * radius]. */
#define ON_FACE 0.03
#define SINGULAR 1e-12 /* least pivot divided by the diagonal entry [1] */

/* Computes the displacements, times 2 G, of term n of the Williams series (expansion of the field at a crack tip) with
 * a unit coefficient [1]: mode_1[2] for mode I, mode_2[2] for mode II, each along the crack and perpendicular to it. G:
 * shear modulus; r: distance from the tip divided by the outer radius of the fit [1]; theta: angle from the crack
 * direction [rad]; kappa: Kolosov's constant [1]. */
static void fit_term(real kappa, int n, real r, real theta, real mode_1[2], real mode_2[2])
{
    const real half = 0.5 * n, s = n % 2 ? -1 : 1, q = pow(r, half);
    const real c = cos(half * theta), d = cos((half - 2) * theta), a = sin(half * theta), b = sin((half - 2) * theta);
    mode_1[0] = q * ((kappa + half + s) * c - half * d);
    mode_1[1] = q * ((kappa - half - s) * a + half * b);
    mode_2[0] = q * ((kappa + half - s) * a - half * b);
    mode_2[1] = -q * ((kappa - half + s) * c + half * d);
}

/* Normal equations A x = y of the least-squares fit of the Williams series, for coefficients x, and the number of
 * particles in it. */
struct surface_fit_problem {
    real A[UNKNOWNS][UNKNOWNS], y[UNKNOWNS];
    int particles;
};

/* Adds one equation, sum_m row[m] x_m = value, for the coefficients x[UNKNOWNS] of the fit to the normal equations *f
 * of the least-squares problem. row[UNKNOWNS]: its coefficients. */
static void fit_add(struct surface_fit_problem *f, const real *row, real value)
{
    for (int m = 0; m < UNKNOWNS; m++) {
        for (int l = 0; l <= m; l++) f->A[m][l] += row[m] * row[l];
        f->y[m] += row[m] * value;
    }
}

/* Returns true if the position X [m], relative to the tip, is behind the tip seen in v and less than ON_FACE times the
 * inner radius of the fit away from the line of the crack. Such particles are left out of the fit, since round-off
 * would decide on which side of the crack they are. */
static bool on_face(const struct tip_view *v, const real X[2])
{
    return dot(v->last, X, 2) < 0 && fabs(v->last[0] * X[1] - v->last[1] * X[0]) < ON_FACE * v->inner;
}

/* Adds the two equations of a particle, one for each displacement component, to the normal equations *f of the fit. v:
 * the tip, its axes and the radii of the fit; X: position of the particle relative to the tip [m]; u: displacement of
 * the particle [m]. */
static void fit_particle(struct surface_fit_problem *f, const struct tip_view *v, const real X[2], const real u[2])
{
    const real *a = v->along, *l = v->last;
    const real theta = atan2(l[0] * X[1] - l[1] * X[0], l[0] * X[0] + l[1] * X[1]) +
                       atan2(a[0] * l[1] - a[1] * l[0], a[0] * l[0] + a[1] * l[1]);
    real row[2][UNKNOWNS] = {{0}}, one[2], two[2];
    for (int k = 0; k < TERMS; k++) {
        fit_term(v->medium.kappa, k < TERMS - 1 ? k + 1 : -1, hypot(X[0], X[1]) / v->outer, theta, one, two);
        for (int d = 0; d < 2; d++) row[d][2 * k] = one[d], row[d][2 * k + 1] = two[d];
    }
    for (int d = 0; d < 2; d++) row[d][UNKNOWNS - 2 + d] = 1;
    fit_add(f, row[0], u[0] * a[0] + u[1] * a[1]);
    fit_add(f, row[1], u[1] * a[0] - u[0] * a[1]);
    f->particles++;
}

/* Solves the normal equations A x = y of the fit *f by L D L^T factors; x replaces f->y, and f->A is overwritten.
 * Returns false if A is singular. */
static bool fit_solve(struct surface_fit_problem *f)
{
    real(*A)[UNKNOWNS] = f->A, *y = f->y;
    for (int k = 0; k < UNKNOWNS; k++) {
        const real whole = A[k][k];
        for (int m = 0; m < k; m++) A[k][k] -= square(A[k][m]) * A[m][m];
        if (!(A[k][k] > SINGULAR * whole)) return false;
        for (int i = k + 1; i < UNKNOWNS; i++) {
            for (int m = 0; m < k; m++) A[i][k] -= A[i][m] * A[k][m] * A[m][m];
            A[i][k] /= A[k][k];
        }
    }
    for (int k = 0; k < UNKNOWNS; k++)
        for (int m = 0; m < k; m++) y[k] -= A[k][m] * y[m];
    for (int k = 0; k < UNKNOWNS; k++) y[k] /= A[k][k];
    for (int k = UNKNOWNS - 1; k >= 0; k--)
        for (int m = k + 1; m < UNKNOWNS; m++) y[k] -= A[m][k] * y[m];
    return true;
}

/* Returns true if no crack of v is between the position X [m] and a point ahead of the tip by AHEAD (a thousandth) of
 * the inner radius of the fit, so that a particle at X is visible from the tip. */
static bool seen(const struct tip_view *v, const real *X)
{
    real eye[DIM_MAX] = {0};
    for (int d = 0; d < 2; d++) eye[d] = v->place[d] + AHEAD * v->inner * v->last[d];
    for (int k = 0; k < v->cracks; k++)
        if (crack_cuts_bond(&v->crack[k], eye, X, 2)) return false;
    return true;
}

bool crack_tip_fit_sif_to_displacements(const struct tip_view *v, const struct particles *p, real K[MODES])
{
    struct surface_fit_problem f = {.particles = 0};
    K[MODE_I] = K[MODE_II] = 0;
    for (int64_t i = 0; i < p->n_all; i++) {
        real X[DIM_MAX] = {0}, from[2], u[2];
        for (int a = 0; a < 2; a++) {
            real way = 0;
            for (int d = 0; d < p->dim; d++)
                X[a] += v->axis[a][d] * p->X[d][i], way += v->axis[a][d] * (p->x[d][i] - p->X[d][i]);
            from[a] = X[a] - v->place[a], u[a] = way;
        }
        const real r2 = square(from[0]) + square(from[1]);
        if (r2 < square(v->inner) || r2 > square(v->outer) || p->body[i] != v->body) continue;
        if (on_face(v, from) || !seen(v, X)) continue;
        fit_particle(&f, v, from, u);
    }
    if (f.particles < UNKNOWNS || !fit_solve(&f)) return false;
    const real size = 2 * v->medium.shear * sqrt(2 * 3.14159265358979323846 / v->outer);
    for (int m = 0; m < MODES; m++) K[m] = size * f.y[m];
    return true;
}
