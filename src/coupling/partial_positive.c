/* Computes the stiffness of the cell of a material point of state-based PD-MPM bonds (partial_stress.c):
 * symmetric, and as close to the patch test as a positive energy of the point allows.
 *
 * With X = (1/Q) sum w r e and zeta = (1/Q) sum w xi (x) xi over the bonds of the point (w, r, e, xi: weight,
 * length, extension, reference vector; Q: weighted volume), these bonds store at least 1/2 V kappa X^2, kappa
 * = B/tr zeta, by the Cauchy-Schwarz inequality, and
 *     1/2 V [A (L : eps + X)^2 + kappa X^2 + eps : K eps] >= 1/2 V eps : (K + q L L) eps,
 *     q = A kappa/(A + kappa).
 * A, B: constants of the model; V, K, eps: volume, stiffness and strain of the cell; L: derivative of the
 * mean strain by eps. Negative eigenvalues of K + q L L are set to 0; they occur for a Poisson's ratio of
 * 0.45 and more in plane strain and in 3D. */
#include <math.h>
#include <string.h>

#include "partial_parts.h"

/* Computes the tensor zeta = (1/Q) sum w xi (x) xi over the intact bonds that material point i of p has in b, in
 * symmetric components [1]; zeta must be 0 before. w: weight of a bond; xi: reference vector of the bond; Q: weighted
 * volume of the point's neighbourhood. Returns true if the point has an intact bond, else false. */
static bool own_bonds(real *zeta, const struct particles *p, const struct bonds *b, int64_t i)
{
    const int64_t row = p->kind[i] == KIND_MPM ? b->row_of[i] : -1;
    bool any = false;
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const struct bond bond = it.bond;
        if (bond.w == 0) continue;
        for (int c = 0; c < symmetric_tensor_component_count(p->dim); c++) {
            int a, d;
            symmetric_tensor_component_axes(p->dim, c, &a, &d);
            zeta[c] +=
                bond.w * (p->X[a][bond.nbr] - p->X[a][i]) * (p->X[d][bond.nbr] - p->X[d][i]) / b->state.weighted[row];
        }
        any = true;
    }
    return any;
}

/* ---- eigenvalues ------------------------------------------------------------------------------------------------- */

/* Applies to the symmetric matrix M[n][n] the Jacobi rotation that makes the entry in row p and column q 0. Applies the
 * same rotation to the columns of Z[n][n], which become the eigenvectors if Z is the unit matrix at first. */
static void rotate(real *M, real *Z, int n, int p, int q)
{
    const real off = M[p * n + q];
    if (off == 0) return;
    const real theta = 0.5 * (M[q * n + q] - M[p * n + p]) / off;
    const real t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1)), c = 1 / sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < n; k++) {
        const real a = M[k * n + p], b = M[k * n + q], y = Z[k * n + p], z = Z[k * n + q];
        M[k * n + p] = c * a - s * b, M[k * n + q] = s * a + c * b;
        Z[k * n + p] = c * y - s * z, Z[k * n + q] = s * y + c * z;
    }
    for (int k = 0; k < n; k++) {
        const real a = M[p * n + k], b = M[q * n + k];
        M[p * n + k] = c * a - s * b, M[q * n + k] = s * a + c * b;
    }
}

/* Returns true if all eigenvalues of the symmetric matrix M[n][n] are positive, i.e. if it has a Cholesky factor. This
 * is true for most points, and twenty times cheaper to find than the eigenvalues. */
static bool is_positive(const real *M, int n)
{
    real F[SYM_MAX * SYM_MAX];
    for (int a = 0; a < n; a++)
        for (int b = 0; b <= a; b++) {
            real rest = M[a * n + b];
            for (int k = 0; k < b; k++) rest -= F[a * n + k] * F[b * n + k];
            if (a == b && !(rest > 0)) return false;
            F[a * n + b] = a == b ? sqrt(rest) : rest / F[b * n + b];
        }
    return true;
}

/* Sets the negative eigenvalues of the symmetric matrix M[n][n] to 0, and keeps its eigenvectors. n: at most
 * SYM_MAX. */
static void make_positive(real *M, int n)
{
    if (is_positive(M, n)) return;
    enum { SWEEPS = 12 }; /* Jacobi sweeps; with six unknowns quadratic convergence is complete far earlier */
    real D[SYM_MAX * SYM_MAX], Z[SYM_MAX * SYM_MAX] = {0};
    array_copy(D, M, n * n, sizeof *M);
    for (int a = 0; a < n; a++) Z[a * n + a] = 1;
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int a = 0; a < n; a++)
            for (int b = a + 1; b < n; b++) rotate(D, Z, n, a, b);
    for (int k = 0; k < n; k++)
        for (int a = 0; a < n && D[k * n + k] < 0; a++)
            for (int b = 0; b < n; b++) M[a * n + b] -= D[k * n + k] * Z[a * n + k] * Z[b * n + k];
}

/* ---- one point --------------------------------------------------------------------------------------------------- */

/* Returns the factor of component c of a symmetric tensor [1]: 1 for a normal component (c < dim), sqrt(2) for a shear
 * component. If the rows and columns of a matrix over symmetric components are multiplied by these factors, the matrix
 * has the eigenvalues of the fourth-order tensor, in which shear components occur twice. */
static real partial_positive_root_of(int c, int dim) { return c < dim ? 1 : M_SQRT2; }

/* Reduces T, the part of the stiffness of a material point that bonds replace [J], until V C + q L L - T has no
 * negative eigenvalue, so that the point stays stable. T[n][n]: over symmetric components; C: elastic tensor of the
 * material m; V: volume of the point [m^3]; q: stiffness of the point's bonds against a change of their mean strain
 * [J]; L[n]: derivative of this mean strain by the strain of the point's cell [1]. */
static void stay_below(real *T, const struct material *m, int dim, real V, real q, const real *L)
{
    const int n = symmetric_tensor_component_count(dim);
    real H[SYM_MAX * SYM_MAX], kept[SYM_MAX * SYM_MAX];
    for (int c = 0; c < n; c++)
        for (int d = 0; d < n; d++) {
            const real C = c < dim && d < dim ? (c == d ? m->c11 : m->c12) : c == d ? m->shear : 0;
            H[c * n + d] = partial_positive_root_of(c, dim) * partial_positive_root_of(d, dim) *
                           (V * C - 0.5 * (T[c * n + d] + T[d * n + c]) + q * L[c] * L[d]);
        }
    memcpy(kept, H, sizeof kept);
    make_positive(H, n);
    for (int c = 0; c < n; c++)
        for (int d = 0; d < n; d++)
            T[c * n + d] -= (H[c * n + d] - kept[c * n + d]) /
                            (partial_positive_root_of(c, dim) * partial_positive_root_of(d, dim));
}

bool cell_limit_state_based_stiffness_reduction(real *tensor, real *mean_strain_derivative, const struct particles *p,
                                                const struct bonds *b, const struct bond_source *s, int64_t point)
{
    const int dim = p->dim, n = symmetric_tensor_component_count(dim);
    const struct state_modulus *m = &s->modulus[p->material[point]];
    const struct material *material = &s->material[p->material[point]];
    const real V = p->volume0[point];
    real zeta[SYM_MAX] = {0}, trace = 0;
    const bool end = own_bonds(zeta, p, b, point);
    for (int d = 0; d < dim; d++) trace += zeta[d];
    const real kappa = end ? m->B / trace : 0, q = end ? V * m->A * kappa / (m->A + kappa) : 0;
    for (int c = 0; c < n; c++) mean_strain_derivative[c] = end ? (c < dim ? 1.0 / dim : 0) - zeta[c] : 0;
    real wanted[SYM_MAX * SYM_MAX];
    for (int c = 0; c < n; c++)
        for (int d = 0; d < n; d++) {
            const real one = c < dim ? 1.0 / dim : 0, other = d < dim ? 1.0 / dim : 0;
            wanted[c * n + d] = 0.5 * (tensor[c * n + d] + tensor[d * n + c]) +
                                0.5 * V * m->A * (mean_strain_derivative[c] * other + one * mean_strain_derivative[d]);
        }
    array_copy(tensor, wanted, n * n, sizeof *tensor);
    stay_below(tensor, material, dim, V, q, mean_strain_derivative);
    return end;
}

void cell_limit_bond_based_stiffness_reduction(real *tensor, const struct particles *p, const struct bond_source *s,
                                               int64_t point)
{
    const real none[SYM_MAX] = {0};
    stay_below(tensor, &s->material[p->material[point]], p->dim, p->volume0[point], 0, none);
}
