/* floor 1: what of the bonds survives a restart. */
#include <math.h>

#include "bonds_parts.h"

status bonds_archive(struct bonds *b, struct particles *p, struct archive *a)
{
    size_t padded = (size_t)(b->groups * LANES);
    TRY(a->exchange(a, "bonds/w", b->w, (size_t)b->slots * LANES * sizeof *b->w));
    for (int64_t q = 0; q < b->slots * LANES; q++)
        if (b->w[q] == 0) b->inverse_length[q] = -fabs(b->inverse_length[q]);
    bonds_share_all(b);
    if (b->plastic_stretch) {
        size_t stored = (size_t)b->slots * LANES * sizeof(real);
        TRY(a->exchange(a, "bonds/plastic_stretch", b->plastic_stretch, stored));
        TRY(a->exchange(a, "bonds/plastic_path", b->plastic_path, stored));
        TRY(a->exchange(a, "bonds/plastic_work", b->plastic_work, padded * sizeof *b->plastic_work));
    }
    TRY(a->exchange(a, "bonds/broken_volume", b->broken_volume, padded * sizeof *b->broken_volume));
    TRY(a->exchange(a, "bonds/fracture_energy", b->fracture_energy, padded * sizeof *b->fracture_energy));
    TRY(a->exchange(a, "bonds/broken", b->broken, padded * sizeof *b->broken));
    TRY(a->exchange(a, "bonds/damage", p->damage, (size_t)p->n_all * sizeof *p->damage));
    return OK;
}
