/* Stores the state of bonds that soften (struct softened of bond_storage.h): allocates it with the bond rows, copies it
 * to rebuilt rows, saves and restores it, and computes dissipated energy and damage from it. */
#include <math.h>

#include "base/memory.h"
#include "base/team.h"
#include "bonds/closing.h"
#include "bonds/struts.h"
#include "bonds_parts.h"

/* Thresholds from which on the bonds of a particle count as struts across a crack (row_has_struts). STRUT_SHARE: least
 * volume of the neighbours beyond open softened bonds, and least volume of those in compression, divided by the volume
 * of the neighbourhood [1]. STRUT_STRETCH: least compressive stretch, divided by the stretch at which softening begins
 * [1]: five times the tensile strength, chosen by judgement. */
#define STRUT_SHARE 0.1
#define STRUT_STRETCH 5

/* Allocates b->soft.near, a flag for each block of eight bond rows, if a material has a strength surface (failure
 * criterion in stress). The flag is 1 if a particle of p in the block may be near its surface. Sets b->soft.gate, the
 * stretch of a bond above which later force loops set the flag of its block [1]: SURFACE_NEAR times the least strain on
 * a surface, for the weakest particle. source: materials. previous: bonds before a rebuild, or NULL; flags of blocks
 * with a particle that had no row there, or a row in a flagged block, are set at once. */
static void rows_watch(struct bonds *b, const struct bonds *previous, const struct bond_source *source,
                       const struct particles *p)
{
    real least = INFINITY, weakest = 1;
    for (int m = 0; m < source->materials; m++)
        if (material_has_strength_surface(&source->material[m]))
            least = real_min(least, source->material[m].surface_least_strain);
    if (isinf(least)) return;
    for (int64_t i = 0; i < p->n && p->strength; i++) weakest = real_min(weakest, p->strength[i]);
    b->soft.gate = least > 0 ? SURFACE_NEAR * least * weakest : -INFINITY; /* reached where nothing is stretched */
    b->soft.near = NEW("bonds.near", b->row_blocks, uint8_t);
    for (int64_t row = 0; row < b->rows && previous; row++) {
        const int32_t before = previous->row_of[b->particle[row]];
        b->soft.near[row / LANES] |= before < 0 || previous->soft.near[before / LANES];
    }
}

/* Allocates the strain rates of bond rows, b->soft.rate and b->soft.beyond, if the strength of a material depends on
 * the strain rate (limit). Copies them from the previous bonds, `previous`, for particles that had a row there; NULL:
 * none had. */
static void rates_make(struct bonds *b, const struct bonds *previous, const struct bond_limit *limit)
{
    bool any = false;
    for (int k = 0; k < square(limit->materials); k++) any |= limit->softening[k].rate != NULL;
    if (!any) return;
    b->soft.rate = NEW("bonds.rate", b->row_blocks * LANES, real);
    b->soft.beyond = NEW("bonds.beyond", b->row_blocks * LANES, real);
    for (int64_t row = 0; row < b->rows && previous; row++) {
        const int32_t before = previous->row_of[b->particle[row]];
        if (before >= 0) b->soft.rate[row] = previous->soft.rate[before];
        if (before >= 0) b->soft.beyond[row] = previous->soft.beyond[before];
    }
    b->soft.rates_kept = previous && previous->soft.rates_kept;
}

void bonds_allocate_softening_state(struct bonds *b, const struct bonds *previous, const struct bond_source *source,
                                    const struct particles *p)
{
    if (!source->limit.softening) return;
    b->soft.curve = source->limit.curve, b->soft.image = source->image;
    b->soft.begun = NEW("bonds.begun", b->row_blocks, uint8_t);
    b->soft.due = NEW("bonds.due", b->row_blocks, uint8_t);
    b->soft.needed = NEW("bonds.needed", b->row_blocks * LANES, uint8_t);
    b->soft.dilatation = NEW("bonds.dilatation", b->row_blocks * LANES, real);
    b->soft.any_due = previous && previous->soft.any_due;
    b->soft.least_ratio = p->strength ? 1 : INFINITY;
    for (int k = 0; k < square(source->limit.materials); k++) {
        const struct softening_range range = softening_range_from_onset(
            source->limit.curve, source->limit.softening[k].onset, source->limit.critical_stretch[k]);
        if (isfinite(range.onset)) b->soft.least_ratio = real_min(b->soft.least_ratio, range.end / range.onset);
    }
    rows_watch(b, previous, source, p);
    rates_make(b, previous, &source->limit);
}

void bond_row_block_initialise_softening(struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                                         int64_t g)
{
    const int64_t first = bond_copy_on_write_and_return_array_index(b, g, 0, 0);
    for (int64_t q = first; q < first + b->column_count[g] * LANES; q++) {
        const int32_t i = b->particle[g * LANES + (q - first) % LANES];
        bond_softening_state_write(b, q,
                                   b->inverse_length[q] == 0 ? bond_softness_none
                                                             : bond_softening_state_before_onset(
                                                                   bond_softening_range(p, limit, i, b->nbr[q])));
    }
    b->soft.begun[g] = b->changed[g] = 1;
    b->stencil[g] = NULL;
    __atomic_store_n(&b->clamped.stale, true, __ATOMIC_RELAXED);
}

void bond_row_set_softening_state(struct bond_row *row, const struct bond_row_inputs *inputs, int32_t particle)
{
    const struct bonds *old = inputs->old;
    const int64_t before = old ? old->row_of[particle] : -1;
    for (int k = 0; k < row->n; k++)
        row->soft[k] = bond_softening_state_before_onset(
            bond_softening_range(inputs->p, &inputs->source->limit, particle, row->nbr[k]));
    if (before < 0 || !bond_row_block_has_begun_softening(old, before / LANES)) return;
    int n = 0; /* neighbours ascend in both rows */
    for (struct bond_iterator it = bond_iterator_of_row(old, before); bond_iterator_advance(&it);) {
        const int64_t q = it.bond.entry;
        while (n < row->n && row->nbr[n] < it.bond.nbr) n++;
        if (n == row->n || row->nbr[n] != it.bond.nbr) continue;
        row->soft[n] = bond_softening_state_read(&old->soft, q);
    }
}

/* Copies the softening of a bond from the previous bonds `old` to the bond of b from the particle of row `row` to
 * particle nbr, in state-based models together with its weight. q: index of the bond in the arrays of `old`. Does
 * nothing if b has no such bond. */
static void softness_take(struct bonds *b, int64_t row, int32_t nbr, const struct bonds *old, int64_t q)
{
    for (int64_t k = 0; k < b->column_count[row / LANES]; k++) {
        const struct bond bond = bond_read(b, row / LANES, k, (int)(row % LANES));
        if (bond.inverse_length == 0 || bond.nbr != nbr) continue;
        bond_softening_state_write(b, bond.entry, bond_softening_state_read(&old->soft, q));
        if (!b->soft.whole || !(b->soft.whole[bond.entry] > 0) || old->w[q] == 0) continue;
        b->w[bond.entry] = old->w[q];
        bond_update_cached_data_after_modification(b, row, bond.entry);
    }
}

void bonds_copy_softening_state_of_row(struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                                       int64_t row, const struct bonds *previous_bonds, int64_t previous_row,
                                       const int32_t *new_index)
{
    if (!bond_row_block_has_begun_softening(previous_bonds, previous_row / LANES)) return;
    if (!b->soft.begun[row / LANES]) bond_row_block_initialise_softening(b, p, limit, row / LANES);
    for (struct bond_iterator it = bond_iterator_of_row(previous_bonds, previous_row); bond_iterator_advance(&it);)
        if (new_index[it.bond.nbr] >= 0) softness_take(b, row, new_index[it.bond.nbr], previous_bonds, it.bond.entry);
}

void bonds_allocate_max_stretches_at_last_equilibrium(struct bonds *b)
{
    if (!b->soft.settled) b->soft.settled = memory_new_lazy_zeroed("bonds.settled", b->room * LANES, sizeof(float));
}

/* Copies the softening of all bonds of b in blocks of eight rows (the bonds of eight particles) where softening has
 * begun: to `packed` if `saving`, else from `packed`. packed: eight entries for each column (the k-th bonds of eight
 * rows) of these blocks, padding included. */
static void pack_softness(struct bonds *b, struct bond_softening_state *packed, bool saving)
{
    for (int64_t g = 0; g < b->row_blocks; g++)
        for (int64_t k = 0; b->soft.begun[g] && k < b->column_count[g] * LANES; k++, packed++) {
            const int64_t q = b->column[g] * LANES + k;
            if (saving) {
                *packed = bond_softening_state_read(&b->soft, q);
                if (bond_ended_by_softening_transmits_compression(b, g, q)) packed->whole = b->soft.settled[q];
                continue;
            }
            bond_softening_state_write(b, q, *packed);
            if (b->soft.whole || !(packed->whole > 0)) continue;
            bonds_allocate_max_stretches_at_last_equilibrium(b);
            b->soft.settled[q] = packed->whole;
        }
}

status bonds_save_or_load_softening_states(struct bonds *b, struct archive *a)
{
    int64_t columns = 0;
    if (!b->soft.curve) return OK;
    TRY(a->exchange(a, "bonds/softening_begun", b->soft.begun, (size_t)b->row_blocks * sizeof *b->soft.begun));
    TRY(a->exchange(a, "bonds/softening_due", b->soft.due, (size_t)b->row_blocks * sizeof *b->soft.due));
    TRY(a->exchange(a, "bonds/softening_any_due", &b->soft.any_due, sizeof b->soft.any_due));
    if (b->soft.near)
        TRY(a->exchange(a, "bonds/softening_near", b->soft.near, (size_t)b->row_blocks * sizeof *b->soft.near));
    if (b->soft.rate) {
        const size_t rows = (size_t)(b->row_blocks * LANES) * sizeof *b->soft.rate;
        TRY(a->exchange(a, "bonds/strain_rate", b->soft.rate, rows));
        TRY(a->exchange(a, "bonds/strain_beyond", b->soft.beyond, rows));
        TRY(a->exchange(a, "bonds/strain_rates_kept", &b->soft.rates_kept, sizeof b->soft.rates_kept));
    }
    for (int64_t g = 0; g < b->row_blocks; g++) columns += b->soft.begun[g] ? b->column_count[g] : 0;
    if (columns == 0) return OK;
    struct bond_softening_state *packed = NEW("bonds.softness", columns * LANES, struct bond_softening_state);
    if (a->saving) pack_softness(b, packed, true);
    const status s = a->exchange(a, "bonds/softening", packed, (size_t)(columns * LANES) * sizeof *packed);
    if (s == OK && !a->saving) pack_softness(b, packed, false);
    memory_free(packed);
    return s;
}

/* Returns half of the energy that the bonds of block g of eight rows (the bonds of eight particles) have dissipated by
 * softening [J]; half, because each bond is in two rows. It is a term of reproducible_sum. context: the bonds (struct
 * bonds). */
static real row_block_spent(const void *context, int64_t g)
{
    const struct bonds *b = context;
    real sum = 0;
    for (int64_t q = b->column[g] * LANES; b->soft.begun[g] && q < (b->column[g] + b->column_count[g]) * LANES; q++)
        sum += bond_softening_dissipation_per_particle(b, g, q);
    return sum;
}

real bonds_dissipated_softening_energy(const struct bonds *b)
{
    return b->soft.curve ? reproducible_sum(b->row_blocks, row_block_spent, b) : 0;
}

real bonds_row_dissipated_energy(const struct bonds *b, int64_t row)
{
    const int64_t g = row / LANES, first = b->column[g] * LANES + row % LANES;
    real sum = b->fracture_energy[row];
    for (int64_t k = 0; b->soft.curve && b->soft.begun[g] && k < b->column_count[g]; k++)
        sum += bond_softening_dissipation_per_particle(b, g, first + k * LANES);
    return sum;
}

bool bonds_row_has_begun_softening(const struct bonds *b, int64_t row)
{
    if (row < 0 || !bond_row_block_has_begun_softening(b, row / LANES)) return false;
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);)
        if (it.bond.w != 0 && bond_is_softening(b, row / LANES, it.bond.entry)) return true;
    return false;
}

real bonds_row_softening_damage(const struct bonds *b, const struct particles *p, int64_t row)
{
    const int64_t g = row / LANES;
    real sum = 0;
    if (row < 0 || !bond_row_block_has_begun_softening(b, g) || !(b->family_volume[row] > 0)) return 0;
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        if (it.bond.w == 0 || !bond_is_softening(b, g, it.bond.entry)) continue;
        const int64_t q = it.bond.entry;
        sum += (1 - softening_remaining_stiffness_fraction(b->soft.curve, b->soft.onset[q], b->soft.end[q],
                                                           b->soft.most[q])) *
               p->volume0[it.bond.nbr];
    }
    return sum / b->family_volume[row];
}

/* Returns true if bonds of row `row` of b (all bonds of one particle of p) carry compression across a softened crack
 * (bonds_any_softened_crack_carries_compression). Both of these volumes must be at least STRUT_SHARE of the volume of
 * all neighbours: of neighbours whose bonds have softened to zero and are still stretched beyond that point, and of
 * neighbours whose intact bonds are compressed by more than STRUT_STRETCH onset stretches. limit: onset stretches by
 * pair of materials. */
static bool row_has_struts(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                           int64_t row)
{
    const int32_t i = b->particle[row];
    real parted = 0, pressed = 0;
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const struct bond *bond = &it.bond;
        const int pair = p->material[i] * limit->materials + p->material[bond->nbr];
        real length2 = 0;
        for (int d = 0; d < p->dim; d++) length2 += square(p->x[d][bond->nbr] - p->x[d][i]);
        const real stretch = sqrt(length2) * fabs(bond->inverse_length) - 1;
        if (bond->w != 0 && stretch < -STRUT_STRETCH * limit->softening[pair].onset) pressed += p->volume0[bond->nbr];
        if (bond->w == 0 && bond_is_softening(b, row / LANES, bond->entry) && stretch > b->soft.end[bond->entry])
            parted += p->volume0[bond->nbr];
    }
    return real_min(parted, pressed) >= STRUT_SHARE * b->family_volume[row];
}

bool bonds_any_softened_crack_carries_compression(const struct bonds *b, const struct particles *p,
                                                  const struct bond_limit *limit)
{
    bool found = false;
    for (int64_t row = 0; limit->softening && row < b->rows && !found; row++)
        found = b->soft.begun[row / LANES] && b->broken[row] > 0 && row_has_struts(b, p, limit, row);
    return found;
}
