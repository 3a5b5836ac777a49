/* floor 1: groups that have the same bonds as others read one list of slots, their pattern. */
#include <string.h>

#include "bonds_parts.h"
#include "base/memory.h"

enum { PATTERNS_MOST = 2048, HASHES = 4096 };

struct patterns {
    int n, users;                        /* users: rows and rows made anew from them */
    struct pattern pattern[PATTERNS_MOST];
    int32_t first[HASHES];               /* of a hash, + 1; 0: none */
};

struct patterns *patterns_make(struct patterns *of)
{
    struct patterns *p = of ? of : NEW("bonds.patterns", 1, struct patterns);
    p->users++;
    return p;
}

void patterns_free(struct patterns *p)
{
    if (!p || --p->users > 0) return;
    for (int k = 0; k < p->n; k++) memory_free(p->pattern[k].slot), memory_free(p->pattern[k].w);
    memory_free(p);
}

void pattern_make(struct pattern *p, int slots)
{
    *p = (struct pattern){0};
    p->slot = BARE("bonds.pattern_slot", slots, struct pattern_slot);
    p->w = (real (*)[LANES])BARE("bonds.pattern_w", (int64_t)slots * LANES, real);
}

void pattern_free(struct pattern *p)
{
    memory_free(p->slot);
    memory_free(p->w);
}

/* ---- what a group would follow ---------------------------------------------------------------------- */

/* Do all bonds of a slot have the same components to the last bit? Then they are stored. */
static bool reference_of(const struct particles *p, int64_t i, int64_t j, struct pattern_slot *to)
{
    int one = 0, same = 1;
    while (!(to->intact & (1 << one))) one++;
    for (int d = 0; d < p->dim; d++) {
        const real *X = p->X[d];
        to->xi[d] = X[j + one] - X[i + one];
        for (int l = 0; l < LANES; l++) same &= !(to->intact & (1 << l)) | (X[j + l] - X[i + l] == to->xi[d]);
    }
    return same;
}

bool pattern_add(struct pattern *to, const struct bonds *b, const struct particles *p, int64_t i, const struct slot_copy *from)
{
    struct pattern_slot *slot = &to->slot[to->slots];
    const real *inverse = from->inverse_length, *w = from->w;
    int16_t excess[LANES];
    int alone = from->first < 0, alike = 1, bonds = 0;
    *slot = (struct pattern_slot){.offset = (int32_t)(from->first - i), .lattice = (uint8_t)lattice_length(b, inverse, excess)};
    for (int l = 0; l < LANES; l++) {
        to->w[to->slots][l] = w[l];
        alone |= (w[l] == 0) != (inverse[l] == 0);       /* cut or broken */
        if (w[l] == 0) continue;
        alone |= bonds > 0 && inverse[l] != slot->inverse_length;
        alike &= bonds == 0 || w[l] == slot->w;
        slot->inverse_length = inverse[l], slot->w = w[l], slot->intact |= (uint8_t)(1 << l), bonds++;
    }
    if (alone || bonds == 0 || slot->lattice == 0 || !reference_of(p, i, from->first, slot)) return false;
    const struct bond_length *length = &b->lattice[slot->lattice];
    slot->length = 1 / slot->inverse_length;
    slot->weighted = slot->w * length->length, slot->squared = slot->w * length->square;
    for (int d = 0; d < p->dim; d++) slot->w_xi[d] = slot->w * slot->xi[d];
    to->whole = (to->slots == 0 || to->whole) && alike && bonds == LANES;
    to->unit = to->whole && (to->slots == 0 || to->unit) && slot->w == 1;
    to->slots++;
    return true;
}

/* ---- all patterns ----------------------------------------------------------------------------------- */

static bool patterns_equal(const struct pattern *a, const struct pattern *b)
{
    return a->slots == b->slots && memcmp(a->slot, b->slot, (size_t)a->slots * sizeof *a->slot) == 0 &&
           memcmp(a->w, b->w, (size_t)a->slots * sizeof *a->w) == 0;
}

/* Fowler, Noll & Vo's hash over words, of what tells most patterns apart: who is bonded to whom, and how heavily. */
static int hash_of(const struct pattern *p)
{
    const uint64_t prime = UINT64_C(0x100000001b3);
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (int k = 0; k < p->slots; k++) {
        const struct pattern_slot *slot = &p->slot[k];
        uint64_t weight;
        memcpy(&weight, &slot->w, sizeof weight);
        hash = (hash ^ ((uint64_t)(uint32_t)slot->offset << LANES | slot->intact)) * prime;
        hash = (hash ^ weight) * prime;
    }
    return (int)((hash ^ hash >> 32) % HASHES);
}

static const struct pattern *pattern_store(struct patterns *all, const struct pattern *pattern)
{
    const int hash = hash_of(pattern);
    for (int32_t k = all->first[hash] - 1; k >= 0; k = all->pattern[k].next)
        if (patterns_equal(&all->pattern[k], pattern)) return &all->pattern[k];
    if (all->n == PATTERNS_MOST) return NULL;
    struct pattern *stored = &all->pattern[all->n];
    pattern_make(stored, pattern->slots);
    memcpy(stored->slot, pattern->slot, (size_t)pattern->slots * sizeof *stored->slot);
    memcpy(stored->w, pattern->w, (size_t)pattern->slots * sizeof *stored->w);
    stored->slots = pattern->slots, stored->whole = pattern->whole, stored->unit = pattern->unit;
    stored->next = all->first[hash] - 1;
    all->first[hash] = ++all->n;
    return stored;
}

const struct pattern *pattern_known(struct patterns *all, const struct pattern *pattern, const struct pattern *likely)
{
    const struct pattern *known;
    if (likely && patterns_equal(likely, pattern)) return likely;
#pragma omp critical(bonds_patterns)
    known = pattern_store(all, pattern);
    return known;
}

bool group_follow(struct bonds *b, int64_t g, int64_t twin)
{
    const int64_t from = twin >= 0 ? b->row_of[twin] / LANES : g;
    if (!b->pattern[from]) return false;
    b->pattern[g] = b->pattern[from];
    b->folded[g] = b->aligned[g] = true;
    memcpy(b->trigger + g * LANES, b->trigger + from * LANES, LANES * sizeof *b->trigger);
    memcpy(b->family_volume + g * LANES, b->family_volume + from * LANES, LANES * sizeof *b->family_volume);
    return true;
}

/* ---- bond by bond ----------------------------------------------------------------------------------- */

void slot_read(struct slot_copy *to, const struct bonds *b, int64_t group, int64_t k)
{
    const int64_t slot = b->slot[group] + k;
    if (!__atomic_load_n(&b->folded[group], __ATOMIC_ACQUIRE)) {
        to->first = b->first[slot];
        memcpy(to->nbr, b->nbr + slot * LANES, sizeof to->nbr);
        memcpy(to->inverse_length, b->inverse_length + slot * LANES, sizeof to->inverse_length);
        memcpy(to->w, b->w + slot * LANES, sizeof to->w);
        return;
    }
    const struct pattern_slot *of = &b->pattern[group]->slot[k];
    to->first = b->particle[group * LANES] + of->offset;
    memcpy(to->w, b->pattern[group]->w[k], sizeof to->w);
    for (int l = 0; l < LANES; l++) to->nbr[l] = to->first + l, to->inverse_length[l] = to->w[l] == 0 ? 0 : of->inverse_length;
}

void slot_write(const struct bonds *b, int64_t slot, const struct slot_copy *from)
{
    b->first[slot] = from->first;
    memcpy(b->nbr + slot * LANES, from->nbr, sizeof from->nbr);
    memcpy(b->inverse_length + slot * LANES, from->inverse_length, sizeof from->inverse_length);
    memcpy(b->w + slot * LANES, from->w, sizeof from->w);
    bonds_share(b, slot);
}

static void unfold(const struct bonds *b, int64_t group)
{
    struct slot_copy copy;
    for (int64_t slot = b->slot[group]; slot < b->slot[group] + b->slot_count[group]; slot++) {
        slot_read(&copy, b, group, slot - b->slot[group]);
        slot_write(b, slot, &copy);
    }
}

void group_unfold(const struct bonds *b, int64_t group)
{
#pragma omp critical(bonds_unfold)
    if (b->folded[group]) {
        unfold(b, group);
        __atomic_store_n(&b->folded[group], 0, __ATOMIC_RELEASE);
    }
}

void bonds_changed(struct bonds *b, int64_t row, int64_t q)
{
    b->pattern[row / LANES] = NULL;
    b->changed[row / LANES] = 1;
    bonds_share(b, q / LANES);
    __atomic_store_n(&b->clamped.stale, true, __ATOMIC_RELAXED);     /* rows break their bonds side by side */
}
