/* State-based bonds in the step in which they break. A breaking bond acts with the states (pressure, spring stiffness,
 * rotation) of the neighbourhoods of both particles before it broke, times the fraction `share` of bond_last.h. The
 * forces of the remaining bonds depend on these neighbourhoods, too: in this step they use the mixture of `share` times
 * the state with and (1 - share) times the state without the breaking bonds. */
#ifndef CLEAVE_KERNELS_STATE_LAST
#define CLEAVE_KERNELS_STATE_LAST

#include "bond_last.h"
#include "bond_laws.h"
#include "kernels/kernels.h"
#include "base/polar.h"
#include "rotation.h"

/* Sums over those bonds of one particle (its neighbourhood) that do not break in this step. w: weight of a bond; xi, r:
 * its reference vector and length; Y: deformed vector; e: extension. */
struct unbroken_family_sums {
    real extension, weighted;       /* sum w r e, with e = r stretch; sum w r^2 [m^2] */
    real moment[DIM_MAX * DIM_MAX]; /* sum w Y (x) xi [m^2] */
    real share;                     /* mean, over the breaking bonds, of the share of struct bond_break_moment [1] */
    int64_t ended;                  /* number of breaking bonds */
};

/* Returns the sums over those bonds of row `row` of b (all bonds of one particle of p) that stay below their breaking
 * stretch. limit: breaking stretches. The members `ended` and `share` of the result: number of breaking bonds, and mean
 * share of their force that acts in this step. */
static inline struct unbroken_family_sums family_sums_over_bonds_below_breaking_stretch(const struct bonds *b,
                                                                                        const struct particles *p,
                                                                                        const struct bond_limit *limit,
                                                                                        int64_t row)
{
    const int32_t i = b->particle[row];
    struct unbroken_family_sums left = {0};
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const int32_t j = it.bond.nbr;
        const real w = it.bond.w, inverse = it.bond.inverse_length;
        if (w == 0) continue;
        const real stretch = bond_stretch_at_earlier_time(p, inverse, i, j, 0);
        if (stretch > bond_breaking_stretch(p, limit, i, j)) {
            left.share += bond_find_break_time_and_force_fraction(p, limit, inverse, 0, i, j).share;
            left.ended++;
            continue;
        }
        left.extension += w * stretch / square(inverse), left.weighted += w / square(inverse);
        for (int d = 0; d < p->dim; d++)
            for (int c = 0; c < p->dim; c++)
                left.moment[d * p->dim + c] += w * (p->x[d][j] - p->x[d][i]) * (p->X[c][j] - p->X[c][i]);
    }
    if (left.ended > 0) left.share /= (real)left.ended;
    return left;
}

/* Replaces *value, a quantity of a neighbourhood with the bonds that break in this step, by weight * *value + (1 -
 * weight) * without_breaking, where `without_breaking` is the quantity without these bonds. weight: share (0 to 1) of
 * the force of the breaking bonds that acts in this step. */
static inline void value_blend_with_value_without_breaking_bonds(real *value, real without_breaking, real weight)
{
    *value = weight * *value + (1 - weight) * without_breaking;
}

/* Replaces the rotation of the neighbourhood of particle i, stored in t, by S R + (1 - S) R'. R: rotation over all
 * bonds; R': rotation without the breaking bonds; S = left->share: fraction of the force of the breaking bonds that
 * acts in this step. left: sums over the remaining bonds; spring: spring stiffness (force per extension) of the
 * neighbourhood without the breaking bonds [N/m]; dim: dimensions. */
static inline void family_rotation_blend_out_breaking_bonds(struct state *t, int32_t i,
                                                            const struct unbroken_family_sums *left, real spring,
                                                            int dim)
{
    real R[DIM_MAX * DIM_MAX], along = 0;
    lanes eight[DIM_MAX * DIM_MAX] = {{0}}, kept[ROTATION]; /* eight equal lanes */
    polar_rotation(left->moment, R, dim);
    for (int c = 0; c < dim * dim; c++) eight[c] = lanes_broadcast(R[c]);
    rotation_encode_with_spring_stiffness(kept, eight, lanes_broadcast(spring), dim);
    for (int c = 0; c < ROTATION; c++) along += t->rotation[c][i] * kept[c][0];
    const real sign = dim == 3 && along < 0 ? -1 : 1; /* a quaternion and its negative are one rotation */
    for (int c = 0; c < ROTATION; c++)
        value_blend_with_value_without_breaking_bonds(&t->rotation[c][i], sign * kept[c][0], left->share);
}

/* Replaces pressure (from which the part of bond forces that is due to dilatation follows), spring stiffness (force per
 * extension) and rotation of the neighbourhood of one particle in b->state by S a + (1 - S) a', if bonds of this
 * particle break in this step: a is the value with these bonds, a' the value without them, and S the share of their
 * force that acts in this step (bond_find_break_time_and_force_fraction), as a mean over these bonds. row: row of b
 * that holds the bonds of the particle (of p); limit: breaking stretches, and the rule for the share. Does nothing for
 * material points, to whose state their cells contribute. */
static inline void family_state_blend_out_breaking_bonds(struct bonds *b, const struct particles *p,
                                                         const struct bond_limit *limit, int64_t row)
{
    const int32_t i = b->particle[row];
    const struct state_modulus *m = &b->state.modulus[p->material[i]];
    if (p->kind[i] != KIND_PD) return;
    const struct unbroken_family_sums left = family_sums_over_bonds_below_breaking_stretch(b, p, limit, row);
    if (left.ended == 0) return;
    const real Q = b->state.local && b->whole[row] ? left.weighted : b->state.weighted[row];
    const real share = b->state.share > 0 ? b->state.share : Q > 0 ? p->volume0[i] / Q : 0;
    const real inverse = Q > 0 ? 1 / Q : 0, spring = m->B * share;
    value_blend_with_value_without_breaking_bonds(&b->state.pressure[i], m->A * left.extension * inverse * share,
                                                  left.share);
    if (b->state.rotation[0]) family_rotation_blend_out_breaking_bonds(&b->state, i, &left, spring, p->dim);
    value_blend_with_value_without_breaking_bonds(&b->state.spring[i], spring, left.share);
}

/* Prepares the states of the neighbourhoods (pressure, from which the part of bond forces that is due to dilatation
 * follows; spring stiffness, force per extension; rotation) of the eight particles of block number `row_block` of eight
 * rows of b for a step in which bonds break. Copies them to b->state.before, which breaking bonds use. Then replaces
 * them in b->state by weighted means of the values with and without the breaking bonds, which the remaining bonds use.
 * limit: breaking stretches. Only for blocks in which a bond of a particle of p exceeds its limit. */
static inline void bond_row_block_states_blend_out_breaking_bonds(struct bonds *b, const struct particles *p,
                                                                  const struct bond_limit *limit, int64_t row_block)
{
    struct state *t = &b->state;
    for (int64_t row = row_block * LANES; row < row_block * LANES + LANES && row < b->rows; row++) {
        const int32_t i = b->particle[row];
        t->before[0][i] = t->pressure[i], t->before[1][i] = t->spring[i];
        for (int c = 0; c < ROTATION && t->rotation[c]; c++) t->before[2 + c][i] = t->rotation[c][i];
        if (limit->last_force == LAST_FORCE_MOMENT) family_state_blend_out_breaking_bonds(b, p, limit, row);
    }
}

/* ---- force of a breaking bond ------------------------------------------------------------------------------------ */

/* Returns one component of the state of the neighbourhood (all bonds) of particle i of p, as it was before bonds broke
 * in this step (b->state.before), or the present one if no bond near the particle breaks. component: 0 for the
 * pressure, from which the part of bond forces that is due to dilatation follows [N/m^2]; 1 for the spring stiffness,
 * force per extension of a bond [N/m]; 2 + c for entry c of the stored rotation
 * (rotation_encode_with_spring_stiffness). If i is a mirror image (a copy beyond a plane of symmetry), returns the
 * component of its source particle, for rotations with the sign that the reflection gives it: a bond to an image and
 * the reflected bond break in the same step and must use equal numbers. Returns 0 if i is an image in a clamped plane
 * (at which all motion is prevented). */
static inline real family_state_component_before_bonds_broke(const struct bonds *b, const struct particles *p,
                                                             int component, int64_t i)
{
    const struct state *t = &b->state;
    real sign = 1;
    for (; i >= p->n; i = t->image[i - p->n].source) {
        const int axis = t->image[i - p->n].axis;
        if (axis < 0) return 0;
        if (component >= 2 && encoded_rotation_component_flips_on_reflection(component - 2, axis, p->dim)) sign = -sign;
    }
    const int64_t row = b->row_of[i];
    if (row >= 0 && t->past[row / LANES]) return sign * t->before[component][i];
    return sign * (component == 0 ? t->pressure[i] : component == 1 ? t->spring[i] : t->rotation[component - 2][i]);
}

/* Computes the force f[dim] [N] of the state-based bond `bond` on particle i of p, to whose bonds in b it belongs, from
 * the states (pressure, spring stiffness, rotation) of the neighbourhoods of both particles. use_present_states: true
 * for their present states, false for the states before bonds broke in this step. */
static inline void state_bond_force(const struct bonds *b, const struct particles *p, const struct bond *bond,
                                    int32_t i, bool use_present_states, real *f, const int dim)
{
    const struct state *t = &b->state;
    const int32_t j = bond->nbr, at[2] = {i, j};
    const bool rotates = t->rotation[0];
    const real r = fabs(1 / bond->inverse_length);
    real y[DIM_MAX], xi[DIM_MAX], y2 = 0, pressure = 0, spring = 0;
    lanes turned[DIM_MAX], arm[DIM_MAX]; /* eight equal lanes */
    for (int d = 0; d < dim; d++) {
        y[d] = p->x[d][j] - p->x[d][i], xi[d] = p->X[d][j] - p->X[d][i];
        y2 += square(y[d]);
        turned[d] = lanes_broadcast(0), arm[d] = lanes_broadcast(xi[d]);
    }
    for (int end = 0; end < 2; end++) {
        lanes rotation[ROTATION];
        pressure +=
            use_present_states ? t->pressure[at[end]] : family_state_component_before_bonds_broke(b, p, 0, at[end]);
        spring += use_present_states ? t->spring[at[end]] : family_state_component_before_bonds_broke(b, p, 1, at[end]);
        for (int c = 0; rotates && c < ROTATION; c++)
            rotation[c] =
                lanes_broadcast(use_present_states ? t->rotation[c][at[end]]
                                                   : family_state_component_before_bonds_broke(b, p, 2 + c, at[end]));
        if (rotates) encoded_rotation_subtract_product_with_vector(turned, rotation, arm, dim);
    }
    const real length = sqrt(y2), along = r * pressure + (rotates ? 0 : (length - r) * spring);
    for (int d = 0; d < dim; d++)
        f[d] = bond->w * (along * y[d] / length + (rotates ? spring * (y[d] - xi[d]) + turned[d][0] : 0));
}

/* Computes the force f[dim] [N] of `bond` on particle i of p, to whose bonds in b it belongs, in a bond-based or
 * state-based model. use_present_states, for state-based models: true for the present states of both particles, false
 * for the states before bonds broke in this step. */
static inline void bond_force_vector_bond_or_state_based(const struct bonds *b, const struct particles *p,
                                                         const struct bond *bond, int32_t i, bool use_present_states,
                                                         real *f)
{
    if (!b->state.modulus)
        bond_based_force_vector(b, p, bond, i, f);
    else if (p->dim == 2)
        state_bond_force(b, p, bond, i, use_present_states, f, 2);
    else
        state_bond_force(b, p, bond, i, use_present_states, f, 3);
}

#endif
