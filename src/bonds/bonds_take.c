/* Copies broken and softened bonds of a body to the bonds of a new set of particles of this body, which contains
 * additional particles in cells that had none (data/hollow.h). */
#include <math.h>

#include "bonds_parts.h"

/* Marks the bond of b from the particle of row `row` to particle nbr as broken by load: weight 0, negative inverse
 * length. Does nothing if there is no such bond or it is broken already. */
static void bond_take(struct bonds *b, int64_t row, int32_t nbr)
{
    const int lane = (int)(row % LANES);
    for (int64_t k = 0; k < b->column_count[row / LANES]; k++) {
        const struct bond bond = bond_read(b, row / LANES, k, lane);
        if (bond.inverse_length == 0 || bond.nbr != nbr) continue;
        if (bond.w == 0 && bond.inverse_length < 0) return;
        const int64_t q = bond_copy_on_write_and_return_array_index(b, row / LANES, k, lane);
        b->w[q] = 0;
        b->inverse_length[q] = -fabs(b->inverse_length[q]);
        bond_update_cached_data_after_modification(b, row, q);
        return;
    }
}

void bonds_copy_damage_to_new_particles(struct bonds *b, struct particles *p, const struct bond_limit *limit,
                                        const struct bonds *old_bonds, const struct particles *old_particles,
                                        const int32_t *new_index)
{
    for (int64_t from = 0; from < old_bonds->rows; from++) {
        const int32_t i = new_index[old_bonds->particle[from]], row = i < 0 ? -1 : b->row_of[i];
        if (row < 0) continue;
        b->broken_volume[row] = old_bonds->broken_volume[from];
        b->fracture_energy[row] = old_bonds->fracture_energy[from];
        b->plastic_work[row] = old_bonds->plastic_work[from];
        b->broken[row] = old_bonds->broken[from];
        if (!old_bonds->changed[from / LANES]) continue;
        if (old_bonds->soft.curve) bonds_copy_softening_state_of_row(b, p, limit, row, old_bonds, from, new_index);
        for (struct bond_iterator it = bond_iterator_of_row(old_bonds, from); bond_iterator_advance(&it);)
            if (it.bond.w == 0 && it.bond.inverse_length < 0) bond_take(b, row, new_index[it.bond.nbr]);
    }
    for (int64_t j = 0; j < old_particles->n; j++)
        if (new_index[j] >= 0) p->damage[new_index[j]] = old_particles->damage[j];
    b->clamped.stale = true;
}
