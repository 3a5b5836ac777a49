/* Adds the reactions of bonds across clamped planes (planes at which all motion is prevented) to the forces
 * on the particles whose mirror images these bonds lead to.
 *
 * The image g of a particle j in a clamped plane is at x_g = X_g + P u_j, with the displacement u_j and P =
 * -1 (by component if a plane of symmetry is involved as well). The lattice is symmetric under the
 * reflection, but such a displacement is not. The bond from i to g(j) pulls along n, that from j to g(i)
 * along R n, and the forces on i and j from the force kernels derive from no energy. The energy is
 *
 *     E(u) = sum of the energies W_i of the rows of the body (a row: all bonds of one particle),
 *     f_i += T_ig,   f_j -= P^T T_ig    for every image g of j in the row of i
 *
 * with T_ig the force from W_i alone. In bond-based models half of the force of a bond belongs to each of its
 * two rows; the image has no row, so that half of the force that the kernel has added to i is moved to j. In
 * state-based models clamped images have no state, so that the kernel has added T_ig alone. */
#include "bond_last.h"
#include "bond_laws.h"
#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"
#include "state_last.h"
#include "state_laws.h"

enum { MANY = 4096 }; /* number of bonds above which a thread team is faster than one thread; empirical */

/* Eight bonds to mirror images beyond clamped planes: vector y from particle to image [m], weight w [1], inverse_length
 * 1/|xi|, inverse 1/|y| [1/m], and stretch [1]. */
struct across {
    lanes y[DIM_MAX], w, inverse_length, inverse, stretch;
};

/* Returns bond vectors, lengths, weights and stretches of the eight bonds k .. k + 7 in the list c of bonds across
 * clamped planes (planes of symmetry that also prevent tangential motion). The neighbour in such a bond is the mirror
 * image of a particle. p: particles and images; dim: dimensions of space. */
static ALWAYS_INLINE struct across across_of(const struct clamped *c, const struct particles *p, int64_t k,
                                             const int dim)
{
    struct across a = {.w = lanes_load(c->w + k), .inverse_length = lanes_load(c->inverse_length + k)};
    lanes distance2 = lanes_broadcast(STATE_TINY);
    for (int d = 0; d < dim; d++) {
        a.y[d] = lanes_gather(p->x[d], c->to + k) - lanes_gather(p->x[d], c->from + k);
        distance2 += a.y[d] * a.y[d];
    }
    a.inverse = lanes_inverse_square_root(distance2);
    a.stretch = STRETCH_OF(distance2 * a.inverse, a.inverse_length);
    return a;
}

/* Computes the forces on the mirror images in the eight bonds k .. k + 7 of the list b->clamped [N], and stores them
 * in its member `reaction`. The list has all bonds across clamped planes (planes of symmetry that also prevent
 * tangential motion). For bond-based models, where the force on the image is minus half of the force of the bond on
 * its particle: the other half is that of a second row, which an image does not have. p: all particles. */
static ALWAYS_INLINE void bond_reactions(const struct bonds *b, const struct particles *p, int64_t k, const int dim)
{
    const struct clamped *c = &b->clamped;
    const struct across a = across_of(c, p, k, dim);
    lanes elastic = a.stretch;
    for (int l = 0; b->plastic_stretch && l < LANES && k + l < c->n; l++)
        elastic[l] -= b->plastic_stretch[c->entry[k + l]];
    for (int l = 0; b->soft.curve && l < LANES && k + l < c->n; l++)
        elastic[l] *=
            bond_remaining_stiffness_fraction(b, b->row_of[c->from[k + l]] / LANES, c->entry[k + l], elastic[l]);
    const lanes share = (-0.5 * b->stiffness) * (a.w * elastic * a.inverse);
    for (int d = 0; d < dim; d++) lanes_store(c->reaction[d] + k, share * a.y[d]);
}

/* Computes the forces on the mirror images in the eight bonds k .. k + 7 of the list b->clamped [N], and stores them
 * in its member `reaction`. The list has all bonds across clamped planes (planes of symmetry that also prevent
 * tangential motion). For state-based models, where the force on the image is minus the part of the bond force that
 * follows from the state of the bond's particle (state_laws.h). rotates: true in models with rotations. p: all
 * particles. */
static ALWAYS_INLINE void state_reactions(const struct bonds *b, const struct particles *p, int64_t k, const int dim,
                                          const bool rotates)
{
    const struct clamped *c = &b->clamped;
    const struct state *t = &b->state;
    const struct across a = across_of(c, p, k, dim);
    const lanes r =
        lanes_inverse_square_root(lanes_choose(a.w > 0.0, a.inverse_length * a.inverse_length, lanes_broadcast(1)));
    const lanes spring = lanes_gather(t->spring, c->from + k);
    lanes along = r * lanes_gather(t->pressure, c->from + k), rotation[ROTATION], xi[DIM_MAX], effective[DIM_MAX];
    if (!rotates) along += r * a.stretch * spring;
    for (int d = 0; d < dim; d++) {
        xi[d] = lanes_gather(p->X[d], c->to + k) - lanes_gather(p->X[d], c->from + k);
        effective[d] = rotates ? spring * (a.y[d] - xi[d]) : lanes_broadcast(0);
    }
    for (int e = 0; rotates && e < ROTATION; e++) rotation[e] = lanes_gather(t->rotation[e], c->from + k);
    if (rotates) encoded_rotation_subtract_product_with_vector(effective, rotation, xi, dim);
    for (int d = 0; d < dim; d++) lanes_store(c->reaction[d] + k, -a.w * (along * a.inverse * a.y[d] + effective[d]));
}

/* Computes the forces that bonds exert on mirror images of particles (behind clamped planes, which are planes of
 * symmetry) for the eight bonds k .. k + 7 of the list b->clamped, and stores them in b->clamped.reaction [N]. Uses the
 * function for the model of the bonds b. p: particles and images. */
static ALWAYS_INLINE void clamp_force_reactions(const struct bonds *b, const struct particles *p, int64_t k,
                                                const int dim)
{
    if (!b->state.modulus)
        bond_reactions(b, p, k, dim);
    else if (b->state.rotation[0])
        state_reactions(b, p, k, dim, true);
    else
        state_reactions(b, p, k, dim, false);
}

/* Adds to the force p->f on one particle the forces on its mirror images beyond clamped planes (c->reaction), each
 * component with the sign of the reflection. h: position of the particle in the list c->particle, from 0. */
static void clamp_force_give(const struct clamped *c, struct particles *p, int64_t h)
{
    for (int d = 0; d < p->dim; d++) {
        real sum = 0;
        for (int64_t k = c->first[h]; k < c->first[h + 1]; k++)
            sum += c->end[k].sign[d] * c->reaction[d][c->end[k].bond];
        p->f[d][c->particle[h]] += sum;
    }
}

/* Copies the weights of the bonds to mirror images beyond clamped planes from the bond arrays b->w to the list
 * b->clamped. Call after weights have changed. */
static void weights_follow(struct bonds *b)
{
    struct clamped *c = &b->clamped;
    for (int64_t k = 0; k < c->n; k++) c->w[k] = b->w[c->entry[k]];
}

/* Recomputes the reactions (forces on the mirror images) of those bonds in b->clamped that the force kernel has broken
 * in this step. b->clamped lists the bonds to mirror images beyond clamped planes. Such a reaction is the share of the
 * force that acts until the bond breaks, from the states before bonds broke (bond_last.h). A bond has broken in this
 * step if its copied weight c->w is not 0 but the present weight is 0. limit: breaking limits and time step. p: all
 * particles. */
static void reactions_last(const struct bonds *b, const struct particles *p, const struct bond_limit *limit)
{
    const struct clamped *c = &b->clamped;
    for (int64_t k = 0; k < c->n; k++) {
        const struct bond bond = {c->entry[k], c->to[k], c->inverse_length[k], c->w[k]};
        if (bond.w == 0 || b->w[bond.entry] > 0) continue;
        const real share =
            bond_at_index_find_break_time_and_force_fraction(b, p, limit, bond.entry, c->from[k], bond.nbr).share;
        real f[DIM_MAX];
        bond_force_vector_bond_or_state_based(b, p, &bond, c->from[k], false, f);
        for (int d = 0; d < p->dim; d++) c->reaction[d][k] = -share * (b->state.modulus ? 1 : 0.5) * f[d];
    }
}

int64_t bond_forces(bond_force_fn *sweep, struct bonds *b, struct particles *p, const struct bond_limit *limit,
                    struct pd_motion *motion)
{
    struct clamped *c = &b->clamped;
    if ((b->soft.any_due || b->soft.rates_kept) && limit->softening) bonds_begin_to_soften(b, p, limit);
    if (c->n == 0) return sweep(b, p, limit, motion);
    INVARIANT(p->dim > 1 && (!motion || motion->loaded));
    if (c->stale) weights_follow(b);
    c->stale = false;
    const int64_t broken = sweep(b, p, limit, motion); /* sets c->stale if one of these bonds changes */
    if (c->stale && b->soft.whole) weights_follow(b), c->stale = false; /* of bonds that soften or have ended so */
    TEAM_LOOP(c->n > MANY, for (int64_t k = 0; k < c->n; k += LANES) if (p->dim == 2) clamp_force_reactions(b, p, k, 2);
              else clamp_force_reactions(b, p, k, 3););
    if (c->stale) reactions_last(b, p, limit);
    TEAM_LOOP(c->n > MANY, for (int64_t h = 0; h < c->held; h++) clamp_force_give(c, p, h););
    return broken;
}
