/* floor 2: what bonds across clamped planes do to the sources of their images.
 *
 * The image g of a source j in a clamped plane is where the plane reflects j, x_g = X_g + P u_j with P = -1 (by component where a
 * plane of symmetry has a part in it). The lattice is its own image, a displacement turned round is not: the bond from i to g(j)
 * pulls along n, that from j to g(i) along R n, and the forces that sweeps find for i and j come from no energy. The energy is
 *
 *     E(u) = sum of the energies W_i of the body's own rows, images following their sources,
 *     f_i  = sum_g T_ig - ...,   f_j += P^T (- T_ig)    for every image g of j in the row of i
 *
 * with T_ig what W_i alone gives. A bond that knows but itself has half its force from either end: half of what the sweep gave i
 * belongs to the row that the image does not have. State-based rows see clamped images that know nothing, so theirs is T_ig. */
#include <math.h>

#include "bond_laws.h"
#include "bond_slot.h"
#include "kernels.h"
#include "state_laws.h"

enum { MANY = 256 };                     /* bonds from which on a team pays */

/* Force of the row on the image, of half a bond by weight w [N]. */
static void bond_reaction(const struct bonds *b, const struct particles *p, int64_t q, real w, int32_t i, real *f)
{
    const int32_t j = b->nbr[q];
    real y[DIM_MAX], length2 = 0;
    for (int d = 0; d < p->dim; d++) y[d] = p->x[d][j] - p->x[d][i], length2 += square(y[d]);
    const real length = sqrt(length2), stretch = STRETCH_OF(length, fabs(b->inverse_length[q]));
    const real force = 0.5 * b->stiffness * w * bond_elastic_one(b, q, stretch) / length;
    for (int d = 0; d < p->dim; d++) f[d] = -force * y[d];
}

static void state_reaction(const struct bonds *b, const struct particles *p, int64_t q, real w, int32_t i, real *f)
{
    real xi[DIM_MAX];
    const bool turns = b->state.turn[0] != NULL;
    if (p->dim == 2) state_force_by(b, p, q, w, i, f, xi, 2, turns);
    else state_force_by(b, p, q, w, i, f, xi, 3, turns);
    for (int d = 0; d < p->dim; d++) f[d] = -f[d];
}

/* A bond that the sweep broke acts as it does there: with half its force, or with all of it (bond_force_fn). */
static void reaction(struct bonds *b, const struct particles *p, int64_t k, bool whole_force)
{
    struct clamped *c = &b->clamped;
    const int64_t q = c->entry[k];
    const int32_t i = c->particle_of[k];
    const real w = bits_equal(b->w[q], c->w[k]) ? c->w[k] : whole_force ? c->w[k] : 0.5 * (c->w[k] + b->w[q]);
    real f[DIM_MAX] = {0};
    if (w != 0 && b->state.modulus) state_reaction(b, p, q, w, i, f);
    else if (w != 0) bond_reaction(b, p, q, w, i, f);
    for (int d = 0; d < p->dim; d++) c->reaction[d][k] = f[d];
}

static void give(const struct clamped *c, struct particles *p, int64_t h)
{
    for (int d = 0; d < p->dim; d++) {
        real sum = 0;
        for (int64_t k = c->first[h]; k < c->first[h + 1]; k++) sum += c->end[k].sign[d] * c->reaction[d][c->end[k].bond];
        p->f[d][c->particle[h]] += sum;
    }
}

int64_t bond_forces(bond_force_fn *sweep, struct bonds *b, struct particles *p, const struct bond_limit *limit,
                    struct pd_motion *motion)
{
    struct clamped *c = &b->clamped;
    assert(!motion || c->n == 0 || motion->loaded);
    for (int64_t k = 0; k < c->n; k++) c->w[k] = b->w[c->entry[k]];
    const int64_t broken = sweep(b, p, limit, motion);
    TEAM_LOOP(c->n > MANY, for (int64_t k = 0; k < c->n; k++) reaction(b, p, k, limit->whole_force););
    TEAM_LOOP(c->n > MANY, for (int64_t h = 0; h < c->held; h++) give(c, p, h););
    return broken;
}
