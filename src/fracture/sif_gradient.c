/* Computes gradients at particles by moving least squares and by the first-order peridynamic differential operator. */
#include <math.h>

#include "base/memory.h"
#include "fracture/sif.h"

enum { QUADRATIC = 6, LINEAR = 3 }; /* terms of complete polynomials in the plane */

/* Least pivot divided by the diagonal entry [1]. Pivots are smaller if all neighbours are on a line or a conic. */
#define SINGULAR 1e-10

/* ---- visibility across cracks ------------------------------------------------------------------------------------ */

/* Returns true if the bond between particles i and j is stored in b and is broken, by load or by a pre-crack. Returns
 * false without bonds (b is NULL). */
static bool bond_broken(const struct bonds *b, int64_t i, int32_t j)
{
    if (!b || b->rows == 0) return false;
    for (struct bond_iterator it = bond_iterator_of_row(b, b->row_of[i]); bond_iterator_advance(&it);)
        if (it.bond.nbr == j) return it.bond.inverse_length < 0;
    return false;
}

/* Returns true if a crack or a broken bond is between particles i and j of p, so that neither contributes to the
 * gradient at the other. s: cracks and bonds that are considered. */
static bool hidden(const struct sight *s, const struct particles *p, int64_t i, int32_t j)
{
    return precracks_cut_bond_between(s->crack, s->cracks, p, i, j) || bond_broken(s->bonds, i, j);
}

static real sif_gradient_between(const real *a, const real *b) { return hypot(a[0] - b[0], a[1] - b[1]); }

/* Returns the distance of particles i and j of p by which their weights in gradients decrease [m]. Without an obstacle
 * it is their reference distance r. If a crack or a broken bond is between them, it is r (r_tip/r)^diffraction instead,
 * where r_tip is the length of the path through the tip, or INFINITY if rule->diffraction is 0. */
static real distance_round_cracks(const struct gradient_rule *rule, const struct particles *p, int64_t i, int32_t j)
{
    real from[DIM_MAX] = {0}, to[DIM_MAX] = {0};
    particle_reference_position(p, i, from);
    particle_reference_position(p, j, to);
    const real straight = sif_gradient_between(from, to);
    if (j == i || !hidden(&rule->sight, p, i, j)) return straight;
    if (rule->diffraction == 0) return INFINITY;
    const real round = sif_gradient_between(from, rule->tip) + sif_gradient_between(rule->tip, to);
    return straight * pow(round / straight, rule->diffraction);
}

/* ---- small symmetric systems ------------------------------------------------------------------------------------- */

/* Replaces the lower triangle of the symmetric matrix A with n rows, n <= QUADRATIC, by its factors L D L^T. Returns
 * false if A is singular or not positive definite. */
static bool factor(real A[QUADRATIC][QUADRATIC], int n)
{
    for (int k = 0; k < n; k++) {
        const real whole = A[k][k];
        for (int m = 0; m < k; m++) A[k][k] -= square(A[k][m]) * A[m][m];
        if (!(A[k][k] > SINGULAR * whole)) return false;
        for (int i = k + 1; i < n; i++) {
            for (int m = 0; m < k; m++) A[i][k] -= A[i][m] * A[k][m] * A[m][m];
            A[i][k] /= A[k][k];
        }
    }
    return true;
}

/* Solves L D L^T x = y for n unknowns; x replaces y[n]. A: matrix whose lower triangle contains the factors L and D, as
 * computed by `factor`. */
static void sif_gradient_solve(real A[QUADRATIC][QUADRATIC], int n, real y[QUADRATIC])
{
    for (int k = 0; k < n; k++)
        for (int m = 0; m < k; m++) y[k] -= A[k][m] * y[m];
    for (int k = 0; k < n; k++) y[k] /= A[k][k];
    for (int k = n - 1; k >= 0; k--)
        for (int m = k + 1; m < n; m++) y[k] -= A[m][k] * y[m];
}

/* ---- moving least squares ---------------------------------------------------------------------------------------- */

/* Returns the cubic spline weight of a neighbour at s, its distance divided by half the support radius [1]; 0 for s >=
 * 2. */
static real spline(real s)
{
    if (s <= 1) return 1 - 1.5 * s * s + 0.75 * s * s * s;
    return s < 2 ? 0.25 * (2 - s) * (2 - s) * (2 - s) : 0;
}

/* Computes the terms b = (1, x, y, x^2, x y, y^2) of a quadratic polynomial [1], where (x, y) is the reference vector
 * from particle i to particle j of p divided by `scale` [m]. */
static void basis(const struct particles *p, int64_t i, int32_t j, real scale, real b[QUADRATIC])
{
    const real x = (p->X[0][j] - p->X[0][i]) / scale, y = (p->X[1][j] - p->X[1][i]) / scale;
    b[0] = 1, b[1] = x, b[2] = y, b[3] = x * x, b[4] = x * y, b[5] = y * y;
}

/* Computes the gradient weights of particle i of p by moving least squares (Belytschko et al. 1994). On entry,
 * weight[k][0] of the stencil s is the weight W_k of neighbour k. On return, weight[k][0 .. 1] are the weights [1/m] of
 * this neighbour in both components of the gradient: the rows of A^-1 P^T W for the linear terms, with the polynomials
 * P at the neighbours and the moment matrix A = P^T W P. (The order of the factors in that paper does not conform.)
 * scale: unit of length of the polynomials [m]; terms: LINEAR or QUADRATIC, their number. Returns false, with W
 * unchanged, if A is singular. */
static bool least_squares(struct gradient_stencil *s, const struct particles *p, int64_t i, real scale, int terms)
{
    real A[QUADRATIC][QUADRATIC] = {{0}}, b[QUADRATIC], y[2][QUADRATIC] = {{0, 1}, {0, 0, 1}};
    for (int k = 0; k < s->n; k++) {
        basis(p, i, s->particle[k], scale, b);
        for (int m = 0; m < terms; m++)
            for (int l = 0; l <= m; l++) A[m][l] += s->weight[k][0] * b[m] * b[l];
    }
    if (!factor(A, terms)) return false;
    for (int d = 0; d < 2; d++) sif_gradient_solve(A, terms, y[d]);
    for (int k = 0; k < s->n; k++) {
        const real w = s->weight[k][0] / scale;
        basis(p, i, s->particle[k], scale, b);
        s->weight[k][0] = w * dot(b, y[0], terms);
        s->weight[k][1] = w * dot(b, y[1], terms);
    }
    return true;
}

/* Computes the gradient weights of particle i of p by moving least squares over its neighbours in the stencil s.
 * Neighbours behind cracks get smaller weights, or are removed from s if rule->diffraction is 0. rule: support radius
 * and cracks. s->order: receives 2 if the polynomials are quadratic, 1 if only linear ones are possible, 0 if none are
 * (there are then no weights). */
static void stencil_mls(struct gradient_stencil *s, const struct gradient_rule *rule, const struct particles *p,
                        int64_t i)
{
    const int found = s->n;
    s->n = 0;
    for (int k = 0; k < found; k++) {
        const int32_t j = s->particle[k];
        const real w = spline(distance_round_cracks(rule, p, i, j) / rule->reach);
        if (!(w > 0)) continue;
        s->particle[s->n] = j;
        s->weight[s->n++][0] = w;
    }
    s->order = s->n >= QUADRATIC && least_squares(s, p, i, rule->reach, QUADRATIC) ? 2
               : s->n >= LINEAR && least_squares(s, p, i, rule->reach, LINEAR)     ? 1
                                                                                   : 0;
}

/* ---- peridynamic differential operator --------------------------------------------------------------------------- */

/* Computes the gradient weights of particle i of p by the peridynamic differential operator (Madenci, Barut & Futch
 * 2016): g_ij V_j = omega K_i^-1 xi_ij V_j [1/m], with K_i = sum omega xi xi^T V_j and omega = delta/r. Stores them in
 * the stencil s, whose neighbours must be set. For neighbours behind cracks r is the distance around the tip
 * (distance_round_cracks); they are removed from s if it exceeds the support radius. rule: delta and cracks. s->order:
 * receives 1, or 0 if K_i is singular. */
static void stencil_pddo(struct gradient_stencil *s, const struct gradient_rule *rule, const struct particles *p,
                         int64_t i)
{
    const int found = s->n;
    real A[QUADRATIC][QUADRATIC] = {{0}};
    s->n = 0;
    for (int k = 0; k < found; k++) {
        const int32_t j = s->particle[k];
        const real r = distance_round_cracks(rule, p, i, j), x = p->X[0][j] - p->X[0][i], y = p->X[1][j] - p->X[1][i];
        if (j == i || !(r <= 2 * rule->reach)) continue;
        const real w = rule->reach / r * p->volume0[j] / p->volume0[i];
        A[0][0] += w * x * x, A[1][0] += w * x * y, A[1][1] += w * y * y;
        s->particle[s->n] = j;
        s->weight[s->n++][0] = w;
    }
    s->order = factor(A, 2) ? 1 : 0;
    for (int k = 0; k < s->n && s->order > 0; k++) {
        const int32_t j = s->particle[k];
        real y[QUADRATIC] = {p->X[0][j] - p->X[0][i], p->X[1][j] - p->X[1][i]};
        const real w = s->weight[k][0];
        sif_gradient_solve(A, 2, y);
        s->weight[k][0] = w * y[0], s->weight[k][1] = w * y[1];
    }
}

/* ---- public functions -------------------------------------------------------------------------------------------- */

/* Makes sure that the stencil s has memory for `capacity` neighbours. Its contents are lost if the memory has to
 * grow. */
static void stencil_room(struct gradient_stencil *s, int capacity)
{
    if (capacity <= s->room) return;
    gradient_stencil_free(s);
    s->room = 2 * capacity;
    s->particle = NEW("sif.particle", s->room, int32_t);
    s->weight = memory_new("sif.weight", s->room, sizeof *s->weight);
}

void gradient_stencil_compute_weights(struct gradient_stencil *s, const struct gradient_rule *rule,
                                      const struct particles *p, const struct cells *c, int64_t particle)
{
    const real support = 2 * rule->reach * (1 + 1e-9);
    real X[DIM_MAX];
    particle_reference_position(p, particle, X);
    s->n = cells_list_particles_near_point(c, p, X, support, -1, s->particle, s->room);
    if (s->n > s->room) {
        stencil_room(s, s->n);
        s->n = cells_list_particles_near_point(c, p, X, support, -1, s->particle, s->room);
    }
    if (rule->method == GRADIENT_MLS)
        stencil_mls(s, rule, p, particle);
    else
        stencil_pddo(s, rule, p, particle);
    if (s->order == 0) s->n = 0;
}

void gradient_stencil_free(struct gradient_stencil *s)
{
    memory_free(s->particle);
    memory_free(s->weight);
    *s = (struct gradient_stencil){0};
}

void gradient_stencil_apply(const struct gradient_stencil *s, int64_t particle, const real *const field[2],
                            real gradient[2][2])
{
    for (int a = 0; a < 2; a++) {
        gradient[a][0] = gradient[a][1] = 0;
        for (int k = 0; k < s->n; k++) {
            const real difference = field[a][s->particle[k]] - field[a][particle];
            for (int b = 0; b < 2; b++) gradient[a][b] += s->weight[k][b] * difference;
        }
    }
}
