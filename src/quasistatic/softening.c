/* Collects the softening bonds of a load step, computes the energy that they dissipate, and updates their largest
 * stretches and weights at equilibria (softening.h). */
#include "softening.h"

#include <math.h>

#include "base/memory.h"
#include "bonds/bond_stretch.h"
#include "bonds/closing.h"
#include "kernels/kernels.h"
#include "kernels/pd/state_driving.h"

#define FACTOR_ERROR 1e-10 /* relative error of a factor */
/* Smallest weight of a softening bond in a state-based model, divided by its weight before softening [1]. It is
 * positive, since the weight 0 marks a broken bond. */
#define LEAST_WEIGHT 1e-9
enum { BISECTIONS_MOST = 100 }; /* largest number of bisections for a factor */

/* Loops over the intact bonds in row `row` of b (bonds of one particle) that have begun to soften. it: iterator whose
 * member `bond` is the present bond. */
#define FOR_SOFTENING_BONDS_OF_ROW(b, row, it)                                                                         \
    for (struct bond_iterator it = bond_iterator_of_row(b, row);                                                       \
         bond_row_block_has_begun_softening(b, row / LANES) && bond_iterator_advance(&it);)                            \
        if (it.bond.w != 0 && bond_is_softening(b, row / LANES, it.bond.entry))

/* Loops over the intact bonds of b that have begun to soften. row: receives the index of a bond row (bonds of one
 * particle); it: iterator whose member `bond` is the present bond. */
#define FOR_SOFTENING_BONDS(b, row, it)                                                                                \
    for (int64_t row = 0; row < (b)->rows; row++) FOR_SOFTENING_BONDS_OF_ROW(b, row, it)

/* Returns the largest stretch of the bond with index q at the last equilibrium, at least its onset of softening [1]. */
static real settled_stretch(const struct bonds *b, int64_t q) { return fmaxf(b->soft.settled[q], b->soft.onset[q]); }

/* ---- a list of bonds --------------------------------------------------------------------------------------------- */

/* Sets the weight b->w of a softening bond of b, with index q in row `row` (bonds of one particle), to the remaining
 * fraction of its stiffness after the largest stretch k [1]. The weight stays above 0, which marks broken bonds, until
 * the bond is broken. Does nothing in bond-based models. */
static void bond_weigh(struct bonds *b, int64_t row, int64_t q, real k)
{
    const struct softened *soft = &b->soft;
    if (!soft->whole) return;
    b->w[q] =
        soft->whole[q] *
        real_max(LEAST_WEIGHT, softening_remaining_stiffness_fraction(soft->curve, soft->onset[q], soft->end[q], k));
    bond_update_cached_data_after_modification(b, row, q);
}

/* Appends the softening bond `bond` of row `row` of b (bonds of one particle of p) to the list l. Stores its present
 * stretch divided by `factor` [1], its largest stretch at the last equilibrium, the stretches at which its softening
 * begins and ends, and the energy by which its normalised dissipation is multiplied. In state-based models this energy
 * follows from the energy that damage of the bond releases; if that is not positive the bond does not soften further,
 * and its stretch is stored as 0. */
static void softening_list_add(struct softening_bond_list *l, const struct bonds *b, const struct particles *p,
                               int64_t row, const struct bond *bond, real factor)
{
    const struct bond_softening_state soft = bond_softening_state_read(&b->soft, bond->entry);
    real stretch = bond_stretch_at_earlier_time(p, bond->inverse_length, b->particle[row], bond->nbr, 0),
         energy = 0.5 * b->stiffness * bond->w / bond->inverse_length;
    if (b->soft.whole) {
        energy = real_max(0, soft.whole * bond_energy_release_rate_by_damage(b, p, bond, b->particle[row]) /
                                 square(stretch));
        if (energy == 0) stretch = 0;
    }
    GROW("softening.bonds", l->bond, l->n + 1);
    l->bond[l->n++] = (struct softening_bond){
        bond->entry, row, stretch / factor, settled_stretch(b, bond->entry), soft.onset, soft.end, energy};
}

void softening_bond_list_collect(struct softening_bond_list *l, const struct bonds *b, const struct particles *p,
                                 real stretch_divisor)
{
    l->n = 0, l->curve = b->soft.curve;
    FOR_SOFTENING_BONDS(b, row, it) softening_list_add(l, b, p, row, &it.bond, stretch_divisor);
}

/* Returns the energy that `bond` of list l has dissipated once its largest stretch is k (dimensionless) [J]. */
static real spent_at(const struct softening_bond_list *l, const struct softening_bond *bond, real k)
{
    return bond->energy * softening_normalised_dissipated_energy(l->curve, bond->onset, bond->end, k);
}

real softening_bond_list_dissipated_energy(const struct softening_bond_list *l, real stretch_factor)
{
    real sum = 0;
    for (int64_t k = 0; k < l->n; k++) {
        const struct softening_bond *bond = &l->bond[k];
        const real stretch = stretch_factor * bond->stretch;
        if (stretch > bond->settled) sum += spent_at(l, bond, stretch) - spent_at(l, bond, bond->settled);
    }
    return sum;
}

/* Returns the smallest factor between 0 and `max_factor` by which the stretches of the bonds in list l must be
 * multiplied so that the bonds have dissipated `energy` [J]; `max_factor` if they dissipate less. Uses the false
 * position method with the Illinois rule (Dowell & Jarratt 1971). */
real softening_bond_list_stretch_factor_at_energy(const struct softening_bond_list *l, real energy, real max_factor)
{
    real low = 0, at_low = -energy, at_high = softening_bond_list_dissipated_energy(l, max_factor) - energy;
    int side = 0;
    for (int k = 0; k < BISECTIONS_MOST && max_factor - low > FACTOR_ERROR * max_factor && at_high > 0; k++) {
        const real middle =
            k % 4 == 3 ? 0.5 * (low + max_factor) : (low * at_high - max_factor * at_low) / (at_high - at_low);
        const real at = softening_bond_list_dissipated_energy(l, middle) - energy;
        if (at > 0) {
            max_factor = middle, at_high = at;
            if (side > 0) at_low *= 0.5;
        } else {
            low = middle, at_low = at;
            if (side < 0) at_high *= 0.5;
        }
        side = at > 0 ? 1 : -1;
        if (fabs(at) <= FACTOR_ERROR * energy) return middle;
    }
    return max_factor;
}

void softening_bond_list_store_largest_stretches(const struct softening_bond_list *l, struct bonds *b,
                                                 real stretch_factor)
{
    for (int64_t k = 0; k < l->n; k++) {
        const struct softening_bond *bond = &l->bond[k];
        b->soft.most[bond->entry] = (float)real_max(bond->settled, stretch_factor * bond->stretch);
        bond_weigh(b, bond->row, bond->entry, b->soft.most[bond->entry]);
    }
}

/* ---- equilibria -------------------------------------------------------------------------------------------------- */

/* Stores the largest stretch of bond `bond` of row `row` of b (bonds of one particle of p) as its value at the last
 * equilibrium. A bond that has not exceeded its onset of softening is then no longer marked as softening. limit:
 * critical stretches and softening of bonds. */
static void settle_bond(struct bonds *b, const struct particles *p, const struct bond_limit *limit, int64_t row,
                        const struct bond *bond)
{
    const int64_t q = bond->entry;
    if (b->soft.most[q] > b->soft.onset[q]) {
        b->soft.settled[q] = b->soft.most[q];
        return;
    }
    b->soft.settled[q] = 0;
    bond_softening_state_write(
        b, q, bond_softening_state_before_onset(bond_softening_range(p, limit, b->particle[row], bond->nbr)));
}

void bonds_store_max_stretches_at_last_equilibrium(struct bonds *b, const struct particles *p,
                                                   const struct bond_limit *limit)
{
    bonds_allocate_max_stretches_at_last_equilibrium(b);
    FOR_SOFTENING_BONDS(b, row, it) settle_bond(b, p, limit, row, &it.bond);
}

void bonds_restore_max_stretches_at_last_equilibrium(struct bonds *b)
{
    FOR_SOFTENING_BONDS(b, row, it)
    {
        const int64_t q = it.bond.entry;
        b->soft.most[q] = (float)settled_stretch(b, q);
        bond_weigh(b, row, q, b->soft.most[q]);
    }
}

/* Sets the weights of the softening bonds in row `row` of b (bonds of one particle) by their largest stretches: those
 * of the last equilibrium if `settled`, else the present ones. */
static void row_weigh_softened(struct bonds *b, int64_t row, bool settled)
{
    FOR_SOFTENING_BONDS_OF_ROW(b, row, it)
    {
        const int64_t q = it.bond.entry;
        bond_weigh(b, row, q, settled ? settled_stretch(b, q) : b->soft.most[q]);
    }
}

/* Raises the largest stretches of the last equilibrium of the softening bonds in row `row` of b (bonds of one particle)
 * to their stretches at the positions of p, but not above their present largest stretches; to these if `last`. */
static void row_raise_settled(struct bonds *b, const struct particles *p, int64_t row, bool last)
{
    FOR_SOFTENING_BONDS_OF_ROW(b, row, it)
    {
        const int64_t q = it.bond.entry;
        const real stretch = bond_stretch_at_earlier_time(p, it.bond.inverse_length, b->particle[row], it.bond.nbr, 0);
        b->soft.settled[q] =
            last ? b->soft.most[q] : fminf(b->soft.most[q], fmaxf((float)stretch, (float)settled_stretch(b, q)));
    }
}

void bonds_add_softening_losses_to_fracture_energy(struct bonds *b, const struct particles *midway,
                                                   const struct particles *end, bool is_last_part)
{
#pragma omp parallel for schedule(dynamic, 8)
    for (int64_t g = 0; g < b->row_blocks; g++)
        for (int64_t row = g * LANES; b->soft.begun[g] && row < b->rows && row < (g + 1) * LANES; row++) {
            row_weigh_softened(b, row, true);
            const real before = state_row_energy(b, midway, row, 0);
            row_raise_settled(b, end, row, is_last_part);
            row_weigh_softened(b, row, true);
            b->fracture_energy[row] += before - state_row_energy(b, midway, row, 0);
            row_weigh_softened(b, row, false);
        }
}

real bonds_largest_stretch_growth_per_softening_range(const struct bonds *b, const struct particles *before,
                                                      const struct particles *now)
{
    real most = 0;
    FOR_SOFTENING_BONDS(b, row, it)
    {
        const int64_t q = it.bond.entry;
        if (!(b->soft.most[q] > settled_stretch(b, q))) continue;
        const int32_t i = b->particle[row], j = it.bond.nbr;
        const real grown = bond_stretch_at_earlier_time(now, it.bond.inverse_length, i, j, 0) -
                           bond_stretch_at_earlier_time(before, it.bond.inverse_length, i, j, 0);
        most = real_max(most, grown / (b->soft.end[q] - b->soft.onset[q]));
    }
    return most;
}
