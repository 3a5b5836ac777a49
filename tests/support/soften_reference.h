/* Reference implementation of bonds that soften, written from the formulas of data/softening.h and of bond_begin.c and
 * not from their code: one bond at a time, a full matrix of states, no vectors, no threads. Linear and bilinear
 * softening. */
#ifndef CLEAVE_TESTS_SOFTEN_REFERENCE
#define CLEAVE_TESTS_SOFTEN_REFERENCE

#include "tests/support/reference.h"

/* State of all bonds of a body of n particles. All arrays but `due` have an entry for each bond i-j at [i n + j]. The
 * caller sets the stretches onset (s_0, where softening begins) and critical (s_c, critical stretch of a brittle bond
 * of equal energy). */
struct soften_reference {
    enum softening law;
    real *most, *onset, *critical; /* largest stretch, 0: not begun; s_0 and s_c of each bond [1] */
    bool *ended;
    bool *due;   /* [row_blocks] a bond was beyond its onset in the last step, or was not allowed to begin */
    real jumped; /* energy lost beside the closed form, by bonds that began late and in steps across a kink [J] */
    real broken; /* energy of ended bonds [J] */
};

/* Returns new states for the bonds of n particles, none of which softens, has ended or is due to be examined. law:
 * softening law. Release them with soften_reference_free. */
static inline struct soften_reference soften_reference_make(enum softening law, int64_t n)
{
    struct soften_reference r = {.law = law};
    r.most = NEW("reference.most", n * n, real);
    r.onset = NEW("reference.onset", n * n, real);
    r.critical = NEW("reference.critical", n * n, real);
    r.ended = NEW("reference.ended", n * n, bool);
    r.due = NEW("reference.due", n, bool);
    return r;
}

/* Frees the arrays of r, the states of all bonds. */
static inline void soften_reference_free(struct soften_reference *r)
{
    memory_free(r->most), memory_free(r->onset), memory_free(r->critical), memory_free(r->ended), memory_free(r->due);
}

/* Returns the stretch [1] at which the force of a softening bond has fallen to 0: s_c^2/s_0 for the linear law, s_0 +
 * 9/5 (s_c^2 - s_0^2)/s_0 for the bilinear law. onset: stretch s_0 at which softening begins; critical: critical
 * stretch s_c of a brittle bond of equal energy. */
static inline real soften_reference_end(enum softening law, real onset, real critical)
{
    if (law == SOFTENING_LINEAR) return critical * critical / onset;
    return onset + 1.8 * (critical * critical - onset * onset) / onset;
}

/* Returns the force of a bond on the softening curve, divided by its stiffness [1], at the stretch k >= onset; 0 beyond
 * the end of the curve. onset, critical: as in soften_reference_end. */
static inline real soften_reference_peak(enum softening law, real onset, real critical, real k)
{
    const real end = soften_reference_end(law, onset, critical), kink = onset + 2 * (end - onset) / 9;
    if (k >= end) return 0;
    if (law == SOFTENING_LINEAR) return onset * (end - k) / (end - onset);
    if (k < kink) return onset - (2.0 / 3) * onset * (k - onset) / (kink - onset);
    return onset / 3 * (end - k) / (end - kink);
}

/* Returns the energy that a bond has dissipated when its largest stretch so far is k >= onset, divided by the stiffness
 * and the length of the bond [1]: the area under the softening curve up to k, by trapezoids between its corners, minus
 * the triangle of unloading. onset, critical: as in soften_reference_end. */
static inline real soften_reference_spent(enum softening law, real onset, real critical, real k)
{
    const real end = soften_reference_end(law, onset, critical), kink = onset + 2 * (end - onset) / 9;
    const real to = fmin(k, end), at = soften_reference_peak(law, onset, critical, to);
    real area = 0.5 * onset * onset;
    if (law == SOFTENING_LINEAR || to < kink)
        area += 0.5 * (onset + at) * (to - onset);
    else
        area += 0.5 * (onset + onset / 3) * (kink - onset) + 0.5 * (onset / 3 + at) * (to - kink);
    return area - 0.5 * at * to;
}

/* Returns the fraction of its stiffness that the bond with the index q keeps at the stretch s: 1 - d, with the damage d
 * that follows from the largest stretch so far, s included; 1 in compression and before softening begins. */
static inline real soften_reference_kept(const struct soften_reference *r, int64_t q, real s)
{
    const real k = fmax(r->most[q], s);
    if (s <= 0 || r->most[q] == 0) return 1;
    return soften_reference_peak(r->law, r->onset[q], r->critical[q], k) / k;
}

/* Returns by how much the energy that the bond with the index q dissipates in one leap-frog step exceeds the growth of
 * the closed form, divided by the stiffness and the length of the bond [1]. The step increases the largest stretch from
 * k to s > k and dissipates s k/2 times the lost fraction of the stiffness. The result is 0 for linear softening. */
static inline real soften_reference_excess(const struct soften_reference *r, int64_t q, real s)
{
    const real k = r->most[q];
    return 0.5 * s * k * (soften_reference_kept(r, q, k) - soften_reference_kept(r, q, s)) -
           soften_reference_spent(r->law, r->onset[q], r->critical[q], s) +
           soften_reference_spent(r->law, r->onset[q], r->critical[q], k);
}

/* Solves the symmetric system A x = b of n <= 6 unknowns by Cholesky's decomposition and stores x in b. Returns false,
 * with b unchanged, if a pivot is not above `least`. */
static inline bool soften_reference_solve(int n, real A[6][6], real *b, real least)
{
    real L[6][6] = {{0}};
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            real sum = A[i][j];
            for (int k = 0; k < j; k++) sum -= L[i][k] * L[j][k];
            if (i == j && !(sum > least)) return false;
            L[i][j] = i == j ? sqrt(sum) : sum / L[j][j];
        }
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++) b[i] -= L[i][k] * b[k];
        b[i] /= L[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) b[i] -= L[k][i] * b[k];
        b[i] /= L[i][i];
    }
    return true;
}

/* Returns the dilatation at particle i [1]: the trace of the strain that fits the stretches of its bonds by least
 * squares, weighted by their remaining stiffness. If the bonds have too few directions for a fit, returns their mean
 * stretch times the dimension; 0 without bonds. w: matrix of reference_table. */
static inline real soften_reference_dilatation(const struct soften_reference *r, const struct particles *p,
                                               const real *w, int64_t i)
{
    const int n = p->dim * (p->dim + 1) / 2;
    real A[6][6] = {{0}}, b[6] = {0}, sum = 0, all = 0, trace = 0;
    for (int64_t j = 0; j < p->n; j++) {
        const int64_t q = i * p->n + j;
        if (!(w[q] > 0) || r->ended[q]) continue;
        real xi[DIM_MAX], product[6];
        const real length = reference_relative(p->X, p->dim, i, j, xi);
        const real s = reference_bond(p, i, j).stretch, kept = w[q] * soften_reference_kept(r, q, s);
        for (int a = 0, k = p->dim; a < p->dim; a++) {
            product[a] = xi[a] * xi[a] / (length * length);
            for (int c = a + 1; c < p->dim; c++) product[k++] = 2 * xi[a] * xi[c] / (length * length);
        }
        for (int a = 0; a < n; a++) {
            for (int c = 0; c < n; c++) A[a][c] += kept * product[a] * product[c];
            b[a] += kept * product[a] * s;
        }
        sum += kept * s, all += kept;
    }
    if (!soften_reference_solve(n, A, b, 1e-6 * all)) return all > 0 ? p->dim * sum / all : 0;
    for (int a = 0; a < p->dim; a++) trace += b[a];
    return trace;
}

/* Starts the softening of all bonds whose stretch is beyond their onset and whose blocks of eight rows (the bonds of
 * eight particles), of both particles, are due to be examined. Bonds at which the dilatation shows that no tensile
 * stress acts do not start; their blocks remain due, all others are not. Adds the energy that bonds lose at once
 * because they start beyond their onset to r->jumped. w: matrix of reference_table; stiffness: force of a bond of
 * weight 1, divided by its stretch [N]; block[i]: block of particle i. */
static inline void soften_reference_begin(struct soften_reference *r, const struct particles *p, const real *w,
                                          real stiffness, const int64_t *block)
{
    real *dilatation = NEW("reference.dilatation", p->n, real);
    bool *denied = NEW("reference.denied", p->n, bool);
    for (int64_t i = 0; i < p->n; i++) dilatation[i] = soften_reference_dilatation(r, p, w, i);
    for (int64_t i = 0; i < p->n; i++)
        for (int64_t j = 0; j < p->n; j++) {
            const int64_t q = i * p->n + j;
            if (!(w[q] > 0) || r->ended[q] || r->most[q] > 0 || !r->due[block[i]] || !r->due[block[j]]) continue;
            const struct reference_bond bond = reference_bond(p, i, j);
            if (!(bond.stretch > r->onset[q])) continue;
            if (p->dim > 1 && !(0.5 * (dilatation[i] + dilatation[j]) + 1.5 * bond.stretch > 0)) {
                denied[block[i]] = true;
                continue;
            }
            r->most[q] = r->onset[q];
            const real scale = 0.5 * stiffness * w[q] * bond.length, s = bond.stretch;
            const real step = fmin(s, soften_reference_end(r->law, r->onset[q], r->critical[q]));
            r->jumped += scale * (0.5 * s * s * (1 - soften_reference_kept(r, q, s)) -
                                  soften_reference_spent(r->law, r->onset[q], r->critical[q], step)) -
                         (step < s ? 0 : scale * soften_reference_excess(r, q, s));
        }
    memory_free(dilatation);
    memory_free(r->due);
    r->due = denied;
}

/* Computes force and energy of all particles and stores them in row[n] (the stress remains 0). Ends bonds that have
 * begun to soften and whose stretch is beyond the end of the softening curve, marks the blocks of eight rows (the bonds
 * of eight particles) of bonds beyond their onset as due, updates the largest stretches, and adds to r->jumped what
 * bonds lose in this step beside the closed form. w, stiffness, block: as for soften_reference_begin, which must have
 * been called before. */
static inline void soften_reference_step(struct soften_reference *r, const struct particles *p, const real *w,
                                         real stiffness, const int64_t *block, struct reference_row *row)
{
    for (int64_t i = 0; i < p->n; i++) {
        row[i] = (struct reference_row){.energy = 0};
        for (int64_t j = 0; j < p->n; j++) {
            const int64_t q = i * p->n + j;
            if (!(w[q] > 0) || r->ended[q]) continue;
            const struct reference_bond bond = reference_bond(p, i, j);
            const real end = soften_reference_end(r->law, r->onset[q], r->critical[q]), s = bond.stretch;
            const real scale = stiffness * w[q] * bond.length;
            if (r->most[q] == 0 && s > r->onset[q]) r->due[block[i]] = true;
            if (r->most[q] > 0 && s > end) {
                r->broken += 0.25 * scale * r->critical[q] * r->critical[q];
                r->ended[q] = true;
                continue;
            }
            if (r->most[q] > 0 && s > r->most[q]) r->jumped += 0.5 * scale * soften_reference_excess(r, q, s);
            if (r->most[q] > 0) r->most[q] = fmax(r->most[q], s);
            const real force = stiffness * w[q] * s * soften_reference_kept(r, q, s);
            row[i].energy += 0.5 * (0.5 * force * s * bond.length);
            for (int a = 0; a < p->dim; a++) row[i].force[a] += force * bond.n[a];
        }
    }
}

/* Returns the energy [J] that all bonds have dissipated so far: bonds that have ended, bonds that soften, and the
 * energy that bonds lost at once because they began to soften late. w, stiffness: as for soften_reference_begin. */
static inline real soften_reference_fracture(const struct soften_reference *r, const struct particles *p, const real *w,
                                             real stiffness)
{
    real sum = r->jumped + r->broken;
    for (int64_t q = 0; q < p->n * p->n; q++)
        if (w[q] > 0 && !r->ended[q] && r->most[q] > 0)
            sum += 0.5 * stiffness * w[q] * reference_bond(p, q / p->n, q % p->n).length *
                   soften_reference_spent(r->law, r->onset[q], r->critical[q], r->most[q]);
    return sum;
}

#endif
