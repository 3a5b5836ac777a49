/* Decides which bonds begin to soften. The force computation marks the blocks of eight rows (the bonds of
 * eight particles) that have a bond beyond its onset of softening. Before the next force computation, the
 * bonds between marked blocks are examined, while all positions belong to one time, so that both rows of a
 * bond give the same answer. A bond thus begins to soften one step late, at the stretch s_1, after s_0 in the
 * previous step. A leap-frog step in which its stiffness falls from 1 to 1 - d takes the energy s_0 s_1 d/2
 * from the bond, in units of stiffness times weight times length. The difference between this energy and that
 * of a step from the onset to s_1 is added to the fracture energy.
 *
 * Lateral bonds of a compressed body are stretched, though the stress across them is not tensile. A bond from
 * i to j of direction n may therefore begin to soften only where n . sigma . n > 0.5 G s: 0.2 E s in solids
 * and plane strain, 0.19 E s in plane stress with the elastic constants of bonds, lambda = G. With n . eps .
 * n = s this is
 *
 *     (lambda/G) (tr eps_i + tr eps_j)/2 + a s > 0,    a = 1.5
 *
 * where eps is the strain that fits the stretches s = n . eps . n of the bonds of a particle best, weighted
 * by their remaining stiffness. It is exact for uniform strain, also beside faces. Uniaxial compression gives
 * tr eps = -2 s.
 *
 * If a strength surface also starts the softening, a = 1.2, i.e. 0.32 E s in solids. Measured with a prism of
 * glass with a compressive strength of 1000 MPa: with a = 1.5 its edges, whose neighbourhoods bulge, spall
 * from 165 MPa on, and the largest stress is 212 MPa; with 1.2 it is 1054 MPa. With a = 1 a disc between
 * jaws, with stresses T and -3 T, does not split.
 *
 * If the strength grows with the strain rate, the onset of a bond is that at the mean of the rates of its two
 * particles. The rate of a particle is the mean rate at which the largest stretch of its bonds grows from
 * half the onset in slow loading to this onset. The present rate would be that of short waves, and of
 * adjacent bonds that soften. */
#include <float.h>
#include <math.h>

#include "bond_last.h"
#include "kernels/kernels.h"

#define PULL 1.5         /* a, see above */
#define PULL_SURFACE 1.2 /* a of materials with a strength surface */
#define PIVOT 1e-6       /* least pivot of a fit divided by the sum of its weights [1] */

/* A bond from particle i to particle j that may begin to soften: its stretch [1], and the stretches of onset and end of
 * softening that it would have in slow loading (`range`). It exists only while one bond is examined. */
struct candidate {
    struct softening_range range;
    real stretch;
    int32_t i, j;
};

/* Returns b->soft.due[g]: whether a bond of row block g (the bonds of eight particles, stored together) is beyond its
 * onset of softening and must be examined (enum softening_due). The load is atomic, since other threads may set
 * DUE_DENIED at the same time. */
static unsigned due_of(const struct bonds *b, int64_t g) { return __atomic_load_n(&b->soft.due[g], __ATOMIC_RELAXED); }

/* Returns true if `bond` may begin to soften, and then describes it in *c. The bond is one of those of particle i in
 * row block g (the bonds of eight particles). Conditions: it has not begun to soften; its stretch is beyond the onset
 * of softening, and was so at the last computation of forces; and the row block of its other particle is marked in
 * b->soft.due, too. The second condition makes the result independent of the direction of the bond: otherwise a bond
 * that had not marked its own blocks would begin only if another bond had marked them. limit: critical stretches and
 * softening. p: all particles. */
static bool is_candidate(struct candidate *c, const struct bonds *b, const struct particles *p,
                         const struct bond_limit *limit, int64_t g, const struct bond *bond, int32_t i)
{
    const int64_t other = b->row_of[bond->nbr]; /* mirror images have no rows */
    if (bond->w == 0 || bond_is_softening(b, g, bond->entry)) return false;
    if (other >= 0 && due_of(b, other / LANES) == DUE_NOT) return false;
    c->i = i, c->j = bond->nbr;
    c->stretch = bond_stretch_at_earlier_time(p, bond->inverse_length, i, bond->nbr, 0);
    c->range = bond_softening_range(p, limit, i, bond->nbr);
    return c->stretch > c->range.onset && c->range.onset < c->range.end &&
           (b->soft.settled ||
            bond_stretch_at_earlier_time(p, bond->inverse_length, i, bond->nbr, limit->dt) > c->range.onset);
}

/* Returns the row of b (bonds of one particle) from which the dilatation at particle j is computed: the row of j, or
 * for a mirror image the row of the particle that it mirrors. Returns -1 if there is no row or if the row has bonds to
 * only some of the neighbours, as the row of a material point does. p: particles and images. */
static int64_t row_of_dilatation(const struct bonds *b, const struct particles *p, int32_t j)
{
    const int64_t row = b->row_of[mirror_image_source_particle(p, b->soft.image, j)];
    return row >= 0 && b->whole[row] ? row : -1;
}

/* Marks in b->soft.needed the rows whose dilatation is needed to examine those bonds of row block g (the bonds of
 * eight particles) that may begin to soften. Several threads may mark one row. limit: critical stretches and
 * softening. p: all particles. */
static void mark_needed(struct bonds *b, const struct particles *p, const struct bond_limit *limit, int64_t g)
{
    for (int64_t row = g * LANES; row < b->rows && row < (g + 1) * LANES; row++)
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
            struct candidate c;
            if (!is_candidate(&c, b, p, limit, g, &it.bond, b->particle[row])) continue;
            const int64_t ends[] = {row_of_dilatation(b, p, c.i), row_of_dilatation(b, p, c.j)};
            for (int e = 0; e < 2; e++)
                if (ends[e] >= 0) __atomic_store_n(&b->soft.needed[ends[e]], 1, __ATOMIC_RELAXED);
        }
}

/* Normal equations A eps = b for the strain eps that fits the stretches of a neighbourhood (all bonds of one particle)
 * best. n: number of components of eps; all: sum of the weights of the bonds; sum: sum of their weighted stretches. */
struct strain_fit {
    int n;
    real A[SYM_MAX][SYM_MAX], b[SYM_MAX], all, sum;
};

/* Adds one bond to the least-squares fit *fit of a strain to the stretches of a neighbourhood (all bonds of one
 * particle). e[dim]: direction of the bond in the reference configuration; stretch: its stretch [1]; w: its weight
 * [1]. */
static void strain_fit_add(struct strain_fit *fit, const real *e, int dim, real stretch, real w)
{
    real product[SYM_MAX];
    for (int s = 0; s < fit->n; s++) {
        int a, b;
        symmetric_tensor_component_axes(dim, s, &a, &b);
        product[s] = (a == b ? 1 : 2) * e[a] * e[b];
    }
    for (int s = 0; s < fit->n; s++) {
        for (int t = 0; t < fit->n; t++) fit->A[s][t] += w * product[s] * product[t];
        fit->b[s] += w * product[s] * stretch;
    }
    fit->all += w, fit->sum += w * stretch;
}

/* Solves the least-squares fit of a strain to the bonds of a neighbourhood and returns the trace of this strain [1]. If
 * the bonds have too few directions (a pivot below PIVOT times the sum of weights), returns dim times their mean
 * stretch instead; 0 without bonds. Overwrites the equations in *fit. */
static real fit_trace(struct strain_fit *fit, int dim)
{
    real trace = 0;
    for (int k = 0; k < fit->n; k++) {
        if (!(fit->A[k][k] > PIVOT * fit->all)) return fit->all > 0 ? dim * fit->sum / fit->all : 0;
        for (int r = 0; r < fit->n; r++) {
            const real factor = r == k ? 0 : fit->A[r][k] / fit->A[k][k];
            for (int c = k; c < fit->n; c++) fit->A[r][c] -= factor * fit->A[k][c];
            fit->b[r] -= factor * fit->b[k];
        }
    }
    for (int k = 0; k < dim; k++) trace += fit->b[k] / fit->A[k][k];
    return trace;
}

/* Returns lambda/G of the material of particle i, the ratio of Lame's constants [1]; it is 1 in bond-based models. b,
 * p: all bonds and particles. */
static real lame_ratio(const struct bonds *b, const struct particles *p, int32_t i)
{
    const real D = p->dim;
    if (!b->state.modulus) return 1;
    const struct state_modulus m = b->state.modulus[p->material[i]];
    return b->state.rotation[0] ? 2 * m.A / (D * m.B) : 1 + (D + 2) * m.A / (D * m.B);
}

/* Returns (lambda/G) tr eps [1] for the neighbourhood of one particle, with Lame's constants lambda and G. eps is the
 * strain that fits the stretches of its bonds best, weighted by the remaining stiffness of each bond. row: row of b
 * with these bonds. p: all particles. */
static real row_dilatation(const struct bonds *b, const struct particles *p, int64_t row)
{
    const int32_t i = b->particle[row];
    struct strain_fit fit = {.n = symmetric_tensor_component_count(p->dim)};
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const struct bond *bond = &it.bond;
        real e[DIM_MAX];
        if (bond->w == 0) continue;
        const real stretch = bond_stretch_at_earlier_time(p, bond->inverse_length, i, bond->nbr, 0);
        for (int d = 0; d < p->dim; d++) e[d] = (p->X[d][bond->nbr] - p->X[d][i]) * bond->inverse_length;
        strain_fit_add(&fit, e, p->dim, stretch,
                       bond->w * bond_remaining_stiffness_fraction(b, row / LANES, bond->entry, stretch));
    }
    return fit_trace(&fit, p->dim) * lame_ratio(b, p, i);
}

/* Updates b->soft.rate[row], the strain rate of the bonds of one particle [1/s]: the mean rate at which the largest
 * stretch of these bonds grows from half its onset of softening to the onset. The rate remains until the stretch falls
 * below half the onset. While the stretch is between half the onset and the onset, the entry is instead minus the
 * stretch at the first step beyond half the onset [1]. row: row of the bonds; dt: time step [s]. p: all particles. */
static void row_measure_rate(struct bonds *b, const struct particles *p, int64_t row, real dt)
{
    const real from = b->trigger[row], onset = from / RATE_FROM;
    real most = -1;
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);)
        if (it.bond.w != 0)
            most = real_max(most,
                            bond_stretch_at_earlier_time(p, it.bond.inverse_length, b->particle[row], it.bond.nbr, 0));
    if (!(most > from)) {
        b->soft.beyond[row] = b->soft.rate[row] = 0;
        return;
    }
    if (b->soft.beyond[row] == 0) b->soft.rate[row] = -most;
    b->soft.beyond[row] += dt;
    if (!(b->soft.rate[row] <= 0 && most >= onset)) return;
    const real grown = most + b->soft.rate[row], time = b->soft.beyond[row] - dt;
    b->soft.rate[row] = real_max(DBL_MIN, time > 0.5 * dt ? grown / time : (most - from) / dt);
}

/* Updates the strain rates b->soft.rate of two kinds of rows (bonds of one particle): those whose largest stretch was
 * beyond half the onset of softening in the last step, and those in row blocks (eight rows) that soften or have a bond
 * beyond its onset. dt: time step [s]. p: all particles. */
static void measure_rates(struct bonds *b, const struct particles *p, real dt)
{
    bool any = false;
#pragma omp parallel for schedule(dynamic, 64) reduction(| : any)
    for (int64_t row = 0; row < b->rows; row++) {
        const bool watched = b->soft.begun[row / LANES] || b->soft.due[row / LANES] != DUE_NOT;
        if (watched || b->soft.beyond[row] > 0) row_measure_rate(b, p, row, dt);
        any |= b->soft.begun[row / LANES] || b->soft.beyond[row] > 0;
    }
    b->soft.rates_kept = any;
}

/* Returns true if the stress across candidate c (a bond that may begin to soften) is tensile enough for it to soften.
 * The stress follows from the stretch of the bond and from the dilatation at the bond, the mean of the dilatations of
 * its two particles. If one particle has bonds to only some of its neighbours, as a material point has, the dilatation
 * of the other particle is used. The answer is thus the same from both particles of a bond. In 1D, and if neither
 * particle has bonds to all neighbours, returns true. limit: softening by pair of materials. b, p: all bonds and
 * particles. */
static bool is_pulled(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                      const struct candidate *c)
{
    const int64_t one = row_of_dilatation(b, p, c->i), two = row_of_dilatation(b, p, c->j);
    if (p->dim == 1 || (one < 0 && two < 0)) return true;
    const real *dilatation = b->soft.dilatation;
    const real sum = one < 0 ? 2 * dilatation[two] : two < 0 ? 2 * dilatation[one] : dilatation[one] + dilatation[two];
    const bool surface = limit->softening[p->material[c->i] * limit->materials + p->material[c->j]].surface;
    return 0.5 * sum + (surface ? PULL_SURFACE : PULL) * c->stretch > 0;
}

/* Recomputes c->range, the stretches at which the softening of candidate c (a bond that may begin to soften) begins
 * and ends, for the strain rate of the bond: the mean of the rates of its two particles, or the rate of one if the
 * other does not have bonds to all neighbours. limit: critical stretches and softening. Returns true if the stretch of
 * the bond is above the onset at this rate. Also returns true, without changing c->range, if no material has a table
 * of rates. b, p: all bonds and particles. */
static bool is_beyond_at_rate(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                              struct candidate *c)
{
    if (!b->soft.rate) return true;
    const int64_t one = row_of_dilatation(b, p, c->i), two = row_of_dilatation(b, p, c->j);
    const real *known = b->soft.rate;
    const real rate = one < 0 && two < 0 ? 0
                      : one < 0          ? known[two]
                      : two < 0          ? known[one]
                                         : 0.5 * (known[one] + known[two]);
    c->range = bond_softening_range_at_strain_rate(p, limit, c->i, c->j, rate);
    return c->stretch > c->range.onset;
}

/* Starts the softening of the bond with index q in the bond arrays, of row `row` (bonds of one particle), which
 * candidate *c describes. It loses some energy at once, which is not counted with the steps beyond its onset; half of
 * it is added to the fracture energy of the row, except in load steps and state-based models. dt: time step [s]. b, p:
 * all bonds and particles. */
static void bond_begin(struct bonds *b, const struct particles *p, int64_t row, int64_t q, const struct candidate *c,
                       real dt)
{
    const struct softening_range range = {(float)c->range.onset, (float)c->range.end};
    bond_softening_state_write(
        b, q, (struct bond_softening_state){(float)range.onset, (float)range.onset, (float)range.end, (float)b->w[q]});
    if (b->soft.settled || b->soft.whole) return;
    const real before = bond_stretch_at_earlier_time(p, b->inverse_length[q], c->i, c->j, dt);
    const real kept = bond_remaining_stiffness_fraction(b, row / LANES, q, c->stretch);
    const real counted = /* what will be counted for the bond from the onset to its stretch */
        c->stretch > range.end
            ? bond_softening_energy_dissipated_at_failure(b->soft.curve, range.onset, range.end, before, c->stretch)
            : 0.5 * range.onset * c->stretch * (1 - kept);
    const real lost = 0.5 * before * c->stretch * (1 - kept) - counted;
    b->fracture_energy[row] += 0.5 * b->stiffness * b->w[q] * lost / b->inverse_length[q];
}

/* Examines the bonds of row block g (the bonds of eight particles) that are beyond their onset of softening and have
 * not begun to soften. Starts the softening of those across which the stress is tensile enough (is_pulled) and, with
 * tables of rates, whose stretch is above the onset at their rate. Sets DUE_DENIED in b->soft.due[g] if the stress does
 * not allow one of the bonds to soften. limit: critical stretches, softening and time step. p: all particles. */
static void row_block_examine(struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t g)
{
    bool denied = false;
    for (int64_t row = g * LANES; row < b->rows && row < (g + 1) * LANES; row++)
        for (int64_t k = 0; k < b->column_count[g]; k++) {
            const struct bond bond = bond_read(b, g, k, (int)(row % LANES));
            struct candidate c;
            if (!is_candidate(&c, b, p, limit, g, &bond, b->particle[row])) continue;
            if (!is_pulled(b, p, limit, &c)) {
                denied = true;
                continue;
            }
            if (!is_beyond_at_rate(b, p, limit, &c)) continue;
            if (!b->soft.begun[g]) bond_row_block_initialise_softening(b, p, limit, g);
            bond_begin(b, p, row, bond.entry, &c, limit->dt);
            softening_flag_material_point_for_conversion(b, p, c.i);
        }
    if (denied) __atomic_fetch_or(&b->soft.due[g], DUE_DENIED, __ATOMIC_RELAXED);
}

/* Returns true if the last computation of forces has newly marked a row block (the bonds of eight particles) in
 * b->soft.due because one of its bonds went beyond its onset of softening. All marked blocks must then be examined, so
 * that a bond is examined from both of its particles in the same step. */
static bool any_new(const struct bonds *b)
{
    bool found = false;
    for (int64_t g = 0; g < b->row_blocks && !found; g++) found = b->soft.due[g] == DUE_NEW;
    return found;
}

void bonds_begin_to_soften(struct bonds *b, struct particles *p, const struct bond_limit *limit)
{
    bool any = false;
    if (b->soft.rate) measure_rates(b, p, limit->dt);
    if (!limit->retries && !b->soft.rate && !any_new(b)) return;
#pragma omp parallel
    {
#pragma omp for schedule(dynamic, 64)
        for (int64_t g = 0; g < b->row_blocks; g++)
            if (p->dim > 1 && b->soft.due[g] != DUE_NOT) mark_needed(b, p, limit, g);
#pragma omp for schedule(dynamic, 64)
        for (int64_t row = 0; row < b->rows; row++) {
            if (!b->soft.needed[row]) continue;
            b->soft.dilatation[row] = row_dilatation(b, p, row);
            b->soft.needed[row] = 0;
        }
#pragma omp for schedule(dynamic, 64)
        for (int64_t g = 0; g < b->row_blocks; g++)
            if (due_of(b, g) != DUE_NOT) row_block_examine(b, p, limit, g);
#pragma omp for schedule(static) reduction(| : any)
        for (int64_t g = 0; g < b->row_blocks; g++) {
            b->soft.due[g] = b->soft.due[g] & DUE_DENIED ? DUE_AGAIN : DUE_NOT;
            any |= b->soft.due[g] != DUE_NOT;
        }
    }
    b->soft.any_due = any;
}
