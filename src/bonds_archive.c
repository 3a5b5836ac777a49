/* floor 1: what of the bonds survives a restart. */
#include <math.h>

#include <string.h>

#include "bonds_parts.h"
#include "memory.h"

/* Groups that follow a pattern have the weights that they are made with. Marks the others; returns their slots. */
static int64_t mark_own(const struct bonds *b, uint8_t *own)
{
    int64_t slots = 0;
    for (int64_t g = 0; g < b->groups; g++)
        if ((own[g] = b->pattern[g] == NULL)) slots += b->slot[g + 1] - b->slot[g];
    return slots;
}

/* Weights of the marked groups, side by side, there or back. */
static void own_weights(struct bonds *b, const uint8_t *own, real *w, bool saving)
{
    for (int64_t g = 0; g < b->groups; g++) {
        if (!own[g]) continue;
        const int64_t from = bond_index(b, g, 0, 0), n = (b->slot[g + 1] - b->slot[g]) * LANES;
        memcpy(saving ? w : b->w + from, saving ? b->w + from : w, (size_t)n * sizeof *w);
        w += n;
        if (saving) continue;
        for (int64_t q = from; q < from + n; q++)
            if (b->w[q] == 0) b->inverse_length[q] = -fabs(b->inverse_length[q]);
        for (int64_t slot = b->slot[g]; slot < b->slot[g + 1]; slot++) bonds_share(b, slot);
        b->pattern[g] = NULL;
    }
}

static status weights_archive(struct bonds *b, struct archive *a)
{
    uint8_t *own = NEW("bonds.own", b->groups, uint8_t);
    int64_t slots = mark_own(b, own);
    status s = a->exchange(a, "bonds/own", own, (size_t)b->groups * sizeof *own);
    if (s == OK) s = a->exchange(a, "bonds/own_slots", &slots, sizeof slots);
    real *w = NEW("bonds.own_w", slots * LANES, real);
    if (a->saving) own_weights(b, own, w, true);
    if (s == OK && slots > 0) s = a->exchange(a, "bonds/w", w, (size_t)slots * LANES * sizeof *w);
    if (s == OK && !a->saving) own_weights(b, own, w, false);
    memory_free(own);
    memory_free(w);
    return s;
}

status bonds_archive(struct bonds *b, struct particles *p, struct archive *a)
{
    size_t padded = (size_t)(b->groups * LANES);
    TRY(weights_archive(b, a));
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
