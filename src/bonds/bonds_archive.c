/* Saves and restores the state of bonds that cannot be computed from the input file: weights, softening, plastic state,
 * damage and energies. */
#include <math.h>
#include <string.h>

#include "bonds_parts.h"
#include "base/memory.h"

/* Copies the weights of the bonds of b in changed blocks of eight rows (those in which a bond broke or softened) to w
 * if `saving`, else from w. After restoring, bonds of weight 0 are marked as broken, and the changed blocks use their
 * stored columns instead of a stencil. w: eight weights for each column (the k-th bonds of eight rows) of the changed
 * blocks, in the order of these. */
static void changed_weights(struct bonds *b, real *w, bool saving)
{
    for (int64_t g = 0; g < b->row_blocks; g++) {
        if (!b->changed[g]) continue;
        const int64_t from = bond_copy_on_write_and_return_array_index(b, g, 0, 0), n = b->column_count[g] * LANES;
        array_copy(saving ? w : b->w + from, saving ? b->w + from : w, n, sizeof *w);
        w += n;
        if (saving) continue;
        for (int64_t q = from; q < from + n; q++)
            if (b->w[q] == 0) b->inverse_length[q] = -fabs(b->inverse_length[q]);
        for (int64_t column = b->column[g]; column < b->column[g] + b->column_count[g]; column++)
            bond_column_update_common_bond_properties(b, column);
        b->stencil[g] = NULL;
    }
}

/* Saves to the archive a if a->saving, else restores from it: which blocks of eight rows of b (the bonds of eight
 * particles) have a broken or softened bond, and the weights of all bonds in these. Other blocks have the weights with
 * which they are made. Returns FAILED if the archive cannot be read or written, or lacks one of these entries. */
static status weights_archive(struct bonds *b, struct archive *a)
{
    int64_t columns = 0;
    TRY(a->exchange(a, "bonds/changed", b->changed, (size_t)b->row_blocks * sizeof *b->changed));
    for (int64_t g = 0; g < b->row_blocks; g++) columns += b->changed[g] ? b->column_count[g] : 0;
    if (columns == 0) return OK;
    real *w = NEW("bonds.changed_w", columns * LANES, real);
    if (a->saving) changed_weights(b, w, true);
    const status s = a->exchange(a, "bonds/w", w, (size_t)columns * LANES * sizeof *w);
    if (s == OK && !a->saving) changed_weights(b, w, false);
    memory_free(w);
    return s;
}

status bonds_save_or_load(struct bonds *b, struct particles *p, struct archive *a)
{
    const size_t padded = (size_t)(b->row_blocks * LANES), stored = (size_t)b->columns * LANES * sizeof(real);
    const bool whole = a->scope == ARCHIVE_ALL;
    if (whole) {
        TRY(weights_archive(b, a));
        TRY(bonds_save_or_load_softening_states(b, a));
        b->clamped.stale = true;
    }
    if (b->plastic_stretch) {
        TRY(a->exchange(a, "bonds/plastic_stretch", b->plastic_stretch, stored));
        TRY(a->exchange(a, "bonds/plastic_path", b->plastic_path, stored));
        if (whole) TRY(a->exchange(a, "bonds/plastic_work", b->plastic_work, padded * sizeof *b->plastic_work));
    }
    if (!whole) return OK;
    TRY(a->exchange(a, "bonds/broken_volume", b->broken_volume, padded * sizeof *b->broken_volume));
    TRY(a->exchange(a, "bonds/fracture_energy", b->fracture_energy, padded * sizeof *b->fracture_energy));
    TRY(a->exchange(a, "bonds/broken", b->broken, padded * sizeof *b->broken));
    TRY(a->exchange(a, "bonds/damage", p->damage, (size_t)p->n_all * sizeof *p->damage));
    return OK;
}
