/* Cracks of softening bonds that close (closing.h). An ended bond that presses has its weight, and the softening state
 * of a bond that has not begun to soften; its onset is kept in b->soft.settled. */
#include "bonds/closing.h"

#include <math.h>

#include "base/memory.h"
#include "bonds/bond_stretch.h"
#include "bonds_parts.h"

/* Returns the stretch [1] at the present positions of the particles p of the bond with index q in row `row` of b (bonds
 * of one particle). The bond may be broken. */
static real bond_stretch_also_if_broken(const struct bonds *b, const struct particles *p, int64_t row, int64_t q)
{
    return bond_stretch_at_earlier_time(p, b->inverse_length[q], b->particle[row], b->nbr[q], 0);
}

/* Makes the ended bond with index q in row `row` of b (bonds of one particle) transmit compression, as a spring of the
 * weight `weight` [1]. */
static void ended_bond_press(struct bonds *b, int64_t row, int64_t q, real weight)
{
    b->soft.settled[q] = b->soft.onset[q];
    bond_softening_state_write(b, q,
                               (struct bond_softening_state){SOFTENING_NEVER, SOFTENING_NEVER, b->soft.end[q], 0});
    b->w[q] = weight, b->inverse_length[q] = fabs(b->inverse_length[q]);
    bond_update_cached_data_after_modification(b, row, q);
}

/* Sets the force of the ended bond with index q in row `row` of b (bonds of one particle), which transmits compression,
 * to 0 from here on. */
static void ended_bond_release(struct bonds *b, int64_t row, int64_t q)
{
    bond_softening_state_write(b, q,
                               (struct bond_softening_state){b->soft.end[q], b->soft.settled[q], b->soft.end[q], 0});
    b->w[q] = 0, b->inverse_length[q] = -fabs(b->inverse_length[q]);
    bond_update_cached_data_after_modification(b, row, q);
}

/* Updates whether the bond with index q in row `row` of b (bonds of one particle) presses, if it has ended. pairs:
 * micro-moduli by pair of materials. Returns the number of changes, 0 or 1. Other arguments:
 * bonds_update_contact_springs_of_broken_bonds. */
static int ended_bond_update_whether_it_presses(struct bonds *b, const struct particles *p,
                                                const struct bond_source *source,
                                                const struct material_pair_table *pairs, int64_t row, int64_t q)
{
    const bool presses = bond_ended_by_softening_transmits_compression(b, row / LANES, q);
    if (!presses && (b->w[q] != 0 || !bond_is_softening(b, row / LANES, q))) return 0;
    if (presses == (bond_stretch_also_if_broken(b, p, row, q) < 0)) return 0;
    if (presses)
        ended_bond_release(b, row, q);
    else
        ended_bond_press(b, row, q, bond_weight_of_pair(source, p, pairs, b->particle[row], b->nbr[q]));
    return 1;
}

int64_t bonds_update_contact_springs_of_broken_bonds(struct bonds *b, const struct particles *p,
                                                     const struct bond_source *source)
{
    int64_t changes = 0;
    if (!b->soft.settled || b->soft.whole) return 0;
    struct material_pair_table pairs = material_pair_table_compute_micro_moduli(source);
    for (int64_t row = 0; row < b->rows; row++)
        for (int64_t k = 0; b->broken[row] > 0 && k < b->column_count[row / LANES]; k++)
            changes += ended_bond_update_whether_it_presses(b, p, source, &pairs, row,
                                                            (b->column[row / LANES] + k) * LANES + row % LANES);
    memory_free(pairs.ratio);
    return changes;
}

struct bond_overlap bonds_find_overlap_at_cracks(const struct bonds *b, const struct particles *p,
                                                 const struct bond_limit *limit)
{
    struct bond_overlap found = {0};
    for (int64_t row = 0; limit->softening && row < b->rows; row++) {
        const int32_t i = b->particle[row];
        for (struct bond_iterator it = bond_iterator_of_row(b, row);
             b->broken_volume[row] > 0 && bond_iterator_advance(&it);) {
            const struct bond *bond = &it.bond;
            const int pair = p->material[i] * limit->materials + p->material[bond->nbr];
            if (bond->w != 0 || bond->nbr < i) continue;
            const real stretch = bond_stretch_also_if_broken(b, p, row, bond->entry);
            if (!(stretch < -limit->softening[pair].onset)) continue;
            found.pairs++;
            found.deepest = real_max(found.deepest, -stretch / fabs(bond->inverse_length));
        }
    }
    return found;
}
