/* The laws of single bonds: a law maps the stretch of a bond to the force of a bond of unit weight; the loops over
 * bonds are elsewhere (bond_force.c, bond_measure.c). To add a law: write it here, add its name to enum pd_model, a
 * case below, and one line per dimension in simd/variants.h. */
#ifndef CLEAVE_KERNELS_BOND_LAWS
#define CLEAVE_KERNELS_BOND_LAWS

#include <math.h>

#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"

/* Applies return mapping with linear isotropic hardening to the eight bonds with indices `first_bond` to `first_bond` +
 * 7 in the arrays of b, and updates the plastic state of those set in the mask `intact`. stretch: total stretch s [1].
 * With the plastic stretch s_p, the accumulated plastic stretch alpha, the yield stretch s_y, and the hardening modulus
 * divided by the elastic one, H,
 *
 *     phi = |s - s_p| - (s_y + H alpha),   phi > 0:  g = phi/(1 + H),  s_p += g sign(s - s_p),  alpha += g
 *
 * In monotonic loading this is the capped force of Zeng et al. 2021, eq. 18, which lacks elastic unloading. Returns the
 * elastic parts s - s_p of the eight stretches. */
static ALWAYS_INLINE lanes bonds_apply_return_mapping_get_elastic_stretch(const struct bonds *b, int64_t first_bond,
                                                                          lanes stretch, lanes_mask intact)
{
    const lanes yield = lanes_gather(b->yield.stretch, b->pair + first_bond);
    const lanes hardening = lanes_gather(b->yield.hardening, b->pair + first_bond);
    lanes plastic = lanes_load(b->plastic_stretch + first_bond), path = lanes_load(b->plastic_path + first_bond);
    const lanes trial = stretch - plastic, zero = lanes_broadcast(0);
    const lanes size = lanes_choose(trial < zero, -trial, trial);
    lanes step = lanes_max(size - (yield + hardening * path), zero) / (1.0 + hardening);
    step = lanes_choose(intact, step, zero);
    plastic += lanes_choose(trial < zero, -step, step);
    lanes_store(b->plastic_stretch + first_bond, plastic);
    lanes_store(b->plastic_path + first_bond, path + step);
    return stretch - plastic;
}

/* Returns stretch times remaining stiffness fraction [1] of the eight bonds with indices `first_bond` to `first_bond` +
 * 7 in the arrays of b, in a block of eight rows that softens (data/softening.h). stretch: present stretches of these
 * bonds [1]; largest_stretch: their largest stretches so far, the present ones included [1]. */
static ALWAYS_INLINE lanes bonds_scale_stretch_by_remaining_stiffness(const struct bonds *b, int64_t first_bond,
                                                                      lanes stretch, lanes largest_stretch)
{
    const struct softening_curve *c = b->soft.curve;
    const lanes onset = lanes_load_floats(b->soft.onset + first_bond);
    const lanes span = lanes_load_floats(b->soft.end + first_bond) - onset, x = largest_stretch - onset;
    const lanes scale = onset / (span * largest_stretch);
    lanes level = lanes_broadcast(0);
    for (int k = 0; k < c->pieces; k++) level = lanes_max(level, c->level[k] * span - c->slope[k] * x);
    return lanes_choose((stretch > 0.0) & (onset < SOFTENING_NEVER), stretch * (scale * level), stretch);
}

/* Returns stretch times remaining stiffness fraction [1] of the eight bonds with indices `first_bond` to `first_bond` +
 * 7 in the arrays of b, i.e. of one column (one bond of each of eight particles). Raises the stored largest stretches
 * of these bonds to their present stretches `stretch`, except in load steps (quasi-static solutions). If none of the
 * eight bonds has begun to soften, returns `stretch` and stores nothing. */
static ALWAYS_INLINE lanes bonds_update_softening_and_scale_stretch(const struct bonds *b, int64_t first_bond,
                                                                    lanes stretch)
{
    lanes most = lanes_load_floats(b->soft.most + first_bond);
    if (!b->common[first_bond / LANES].begun) return stretch;
    if (!b->soft.settled && lanes_any_less(most, stretch)) {
        most = lanes_max(most, stretch);
        lanes_store_floats(b->soft.most + first_bond, most);
    }
    return bonds_scale_stretch_by_remaining_stiffness(b, first_bond, stretch, most);
}

/* Returns the energies, divided by the stiffness [m], by which eight bonds dissipate more in this leap-frog step than
 * the closed form of their dissipation states. The bonds have the indices `first_bond` to first_bond + 7 in the arrays
 * of b. A step does the work of the mean of the forces at both its ends, which is the area below the softening curve on
 * a straight piece. Where the largest stretch grows from k_0 to k_1 past a kink at k_m, at which the slope grows by a,
 * the work is larger by a (k_1 - k_m) (k_m - k_0)/2 times weight and length. Returns 0 for bonds beyond the end of
 * their softening, whose energy is computed elsewhere (half_energy_of_softening_to_end), and in load steps. stretch:
 * stretches after the step [1]; w: weights, 0 for broken bonds [1]; inverse_length: inverse reference lengths [1/m].
 * Call this function before bonds_update_softening_and_scale_stretch. */
static ALWAYS_INLINE lanes bonds_excess_dissipation_at_softening_kinks(const struct bonds *b, int64_t first_bond,
                                                                       lanes stretch, lanes w, lanes inverse_length)
{
    const struct softening_curve *c = b->soft.curve;
    const lanes zero = lanes_broadcast(0), most = lanes_load_floats(b->soft.most + first_bond);
    lanes sum = zero;
    if (c->pieces == 1 || b->soft.settled || !b->common[first_bond / LANES].begun || !lanes_any_less(most, stretch))
        return zero;
    const lanes onset = lanes_load_floats(b->soft.onset + first_bond);
    const lanes end = lanes_load_floats(b->soft.end + first_bond), span = end - onset;
    for (int k = 1; k < c->pieces; k++) {
        const lanes kink = onset + c->from[k] * span;
        sum += (c->slope[k - 1] - c->slope[k]) * (lanes_max(stretch - kink, zero) * lanes_max(kink - most, zero));
    }
    return lanes_choose((w > 0.0) & (onset < SOFTENING_NEVER) & (stretch <= end),
                        0.5 * w * sum * onset / (span * inverse_length), zero);
}

/* Adds the energies `excess_dissipation` of bonds_excess_dissipation_at_softening_kinks, summed for each of the WIDE
 * rows (the bonds of one particle each) from row number `row` on, to the fracture energies of these rows: one half,
 * because each bond is in two rows. */
static ALWAYS_INLINE void bond_rows_add_excess_softening_dissipation(const struct bonds *b, int64_t row,
                                                                     lanes excess_dissipation)
{
    real *energy = b->fracture_energy + row;
    if (b->soft.curve->pieces > 1) lanes_store(energy, lanes_load(energy) + 0.5 * b->stiffness * excess_dissipation);
}

/* Returns the normalised force [1] of the eight bonds with indices `first_bond` to `first_bond` + 7 in the arrays of b,
 * i.e. their force divided by stiffness and weight, by the law of `model`. It equals the stretch (Silling & Askari
 * 2005; Zeng et al. 2022, eqs. 17, 29), its elastic part where bonds yield, and stretch times remaining stiffness
 * fraction where they soften. Updates the plastic or softening state. stretch: total stretch [1]; w: weights, 0 for
 * broken bonds [1]. */
static ALWAYS_INLINE lanes bonds_update_state_and_get_normalised_force(const enum pd_model model, const struct bonds *b,
                                                                       int64_t first_bond, lanes stretch, lanes w)
{
    return model == PD_BOND_PLASTIC ? bonds_apply_return_mapping_get_elastic_stretch(b, first_bond, stretch, w > 0.0)
           : model == PD_BOND_SOFT  ? bonds_update_softening_and_scale_stretch(b, first_bond, stretch)
                                    : stretch;
}

/* Returns the elastic part [1] of the stretch of the eight bonds with indices `first_bond` to `first_bond` + 7 in the
 * arrays of b, by the law of `model`: in models that yield, `stretch` less the stored plastic stretch; in models that
 * soften, `stretch` times the share of their stiffness that the bonds keep. stretch: total stretch [1]. */
static ALWAYS_INLINE lanes bonds_elastic_stretch(const enum pd_model model, const struct bonds *b, int64_t first_bond,
                                                 lanes stretch)
{
    if (model == PD_BOND_SOFT) {
        const lanes most = lanes_load_floats(b->soft.most + first_bond);
        if (!b->common[first_bond / LANES].begun) return stretch;
        return bonds_scale_stretch_by_remaining_stiffness(b, first_bond, stretch,
                                                          b->soft.settled ? most : lanes_max(most, stretch));
    }
    return model == PD_BOND_PLASTIC ? stretch - lanes_load(b->plastic_stretch + first_bond) : stretch;
}

/* Returns the elastic part [1] of the stretch `stretch` of the bond with index `bond` in the arrays of b: `stretch`
 * less the plastic stretch where bonds yield, times the remaining stiffness fraction where they soften. row_block:
 * block of eight rows (the bonds of eight particles) that contains the bond. */
static inline real bond_at_index_elastic_stretch(const struct bonds *b, int64_t row_block, int64_t bond, real stretch)
{
    if (b->soft.curve) return stretch * bond_remaining_stiffness_fraction(b, row_block, bond, stretch);
    return b->plastic_stretch ? stretch - b->plastic_stretch[bond] : stretch;
}

/* Returns the elastic energy of the bond with index `bond` in the arrays of b at the stretch `stretch` [1], divided by
 * stiffness, weight (factor on its force) and reference length of the bond (dimensionless). row_block: block of eight
 * rows (the bonds of eight particles) that contains the bond. */
static inline real bond_at_index_normalised_energy(const struct bonds *b, int64_t row_block, int64_t bond, real stretch)
{
    const real elastic = bond_at_index_elastic_stretch(b, row_block, bond, stretch);
    return 0.5 * ((b->soft.curve ? stretch : elastic) * elastic);
}

/* Returns the elastic energies of eight bonds, each divided by stiffness, weight (factor on its force) and reference
 * length of the bond (dimensionless). model: law of the bonds; stretch: stretches of the bonds [1]; elastic: elastic
 * parts of the stretches, equal to the normalised forces [1]. */
static ALWAYS_INLINE lanes bonds_normalised_energy(const enum pd_model model, lanes stretch, lanes elastic)
{
    return 0.5 * (model == PD_BOND_SOFT ? stretch : elastic) * elastic;
}

/* ---- one bond, for samples and frames ---------------------------------------------------------------------- */

/* Returns the stretch [1] of `bond`, a bond of particle i, at the present positions p->x. */
static inline real bond_stretch_at_present_positions(const struct particles *p, const struct bond *bond, int32_t i)
{
    real distance2 = 0;
    for (int d = 0; d < p->dim; d++) distance2 += square(p->x[d][bond->nbr] - p->x[d][i]);
    return sqrt(distance2) * bond->inverse_length - 1;
}

/* Returns the elastic part [1] of the present stretch of `bond`, a bond in b of particle i of p. It equals the force of
 * the bond divided by stiffness and weight. */
static inline real bond_elastic_stretch_at_present_positions(const struct bonds *b, const struct particles *p,
                                                             const struct bond *bond, int32_t i)
{
    return bond_at_index_elastic_stretch(b, b->row_of[i] / LANES, bond->entry,
                                         bond_stretch_at_present_positions(p, bond, i));
}

/* Returns the force [N] of `bond`, a bond in b of particle i of p in a bond-based model, as the force kernel computes
 * it; tension is positive. Returns 0 if the bond is broken. */
static inline real bond_based_signed_force(const struct bonds *b, const struct particles *p, const struct bond *bond,
                                           int32_t i)
{
    return bond->w == 0 ? 0 : b->stiffness * bond->w * bond_elastic_stretch_at_present_positions(b, p, bond, i);
}

/* Stores in f[dim] the force vector [N] that `bond`, a bond in b of particle i of p, exerts on this particle.
 * Bond-based models only. */
static inline void bond_based_force_vector(const struct bonds *b, const struct particles *p, const struct bond *bond,
                                           int32_t i, real *f)
{
    real distance2 = 0;
    for (int d = 0; d < p->dim; d++) f[d] = p->x[d][bond->nbr] - p->x[d][i], distance2 += square(f[d]);
    const real force = bond_based_signed_force(b, p, bond, i) / sqrt(distance2);
    for (int d = 0; d < p->dim; d++) f[d] *= force;
}

/* Returns the elastic energy [J] of `bond`, a bond in b of particle i of p in a bond-based model; 0 if the bond is
 * broken. */
static inline real bond_based_elastic_energy(const struct bonds *b, const struct particles *p, const struct bond *bond,
                                             int32_t i)
{
    if (bond->w == 0) return 0;
    const real energy = bond_at_index_normalised_energy(b, b->row_of[i] / LANES, bond->entry,
                                                        bond_stretch_at_present_positions(p, bond, i));
    return b->stiffness * bond->w * energy / bond->inverse_length;
}

/* Returns the plastic work [J] that `bond`, a bond in b, has dissipated so far; 0 if the bond is broken or has not
 * yielded. The closed form holds since hardening is linear and the plastic path (accumulated absolute plastic stretch,
 * b->plastic_path at the index bond->entry) never decreases. Call only if b->plastic_path is not NULL, i.e. in models
 * whose bonds yield. */
static inline real bond_dissipated_plastic_work(const struct bonds *b, const struct bond *bond)
{
    const int64_t q = bond->entry;
    if (bond->w == 0 || b->plastic_path[q] == 0) return 0;
    const int32_t pair = b->pair[q];
    const real path = b->plastic_path[q], yield = b->yield.stretch[pair], hardening = b->yield.hardening[pair];
    return b->stiffness * bond->w * path * (yield + 0.5 * hardening * path) / bond->inverse_length;
}

#endif
