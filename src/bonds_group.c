/* floor 1: eight rows become a group: which neighbours share a slot, and what is stored of them. */
#include <string.h>

#include "bonds_parts.h"
#include "memory.h"

/* Are these the index distances of a row? */
static bool offsets_are(const int32_t *offset, int n, const struct row *row, int32_t particle)
{
    int32_t other = 0;
    if (row->n != n) return false;
    for (int k = 0; k < n; k++) other |= row->nbr[k] - particle - offset[k];
    return other == 0;
}

/* Distinct index distances of the group's bonds, ascending. */
static int group_offsets(struct group_room *g, const int32_t *particle, int rows)
{
    int n = g->row[0].n;
    for (int k = 0; k < n; k++) g->offset[k] = g->row[0].nbr[k] - particle[0];
    for (int l = 1; l < rows; l++)
        for (int k = 0, at = 0; k < g->row[l].n && (k > 0 || !offsets_are(g->offset, n, &g->row[l], particle[l])); k++) {
            int32_t offset = g->row[l].nbr[k] - particle[l];
            while (at < n && g->offset[at] < offset) at++;
            if (at < n && g->offset[at] == offset) continue;
            memmove(g->offset + at + 1, g->offset + at, (size_t)(n - at) * sizeof *g->offset);
            g->offset[at] = offset, n++;
        }
    return n;
}

/* Slots the group needs; `by_offset` tells whether a slot holds one index distance (a lattice) or the rows are
 * simply packed (an irregular cloud, where distances differ and slots by distance would be mostly padding). */
int group_slots(struct group_room *g, const int32_t *particle, int rows, bool *by_offset)
{
    int longest = 0;
    for (int l = 0; l < rows; l++)
        if (g->row[l].n > longest) longest = g->row[l].n;
    int offsets = group_offsets(g, particle, rows);
    *by_offset = slots_by_offset(offsets, longest);
    return *by_offset ? offsets : longest;
}

static void slot_put(struct bonds *b, int64_t q, const struct row *row, int k, int32_t pair)
{
    if (b->plastic_stretch) {
        b->plastic_stretch[q] = row->plastic[k].stretch;
        b->plastic_path[q] = row->plastic[k].path;
        b->pair[q] = pair;
    }
    b->nbr[q] = row->nbr[k];
    b->inverse_length[q] = row->inverse_length[k];
    b->w[q] = row->w[k];
}

static void slot_pad(struct bonds *b, int64_t q, int32_t neighbour)
{
    b->nbr[q] = neighbour;
    b->inverse_length[q] = 0;
    b->w[q] = 0;
}

static int32_t pair_of(const struct bonds *b, const struct particles *p, int32_t i, int32_t j)
{
    return p->material[i] * b->yield.materials + p->material[j];
}

void group_fill(struct bonds *b, struct group_room *room, int64_t g, int rows, bool by_offset,
                       const struct particles *p)
{
    const int32_t *particle = b->particle + g * LANES;
    int used[LANES] = {0}, slots = (int)(b->slot[g + 1] - b->slot[g]);
    for (int k = 0; k < slots; k++) {
        const int64_t q = (b->slot[g] + k) * LANES;
        for (int l = 0; l < LANES; l++) {
            const struct row *row = &room->row[l];
            bool has = l < rows && used[l] < row->n;
            if (has && by_offset) has = row->nbr[used[l]] - particle[l] == room->offset[k];
            int64_t other = by_offset ? particle[l] + (l < rows ? room->offset[k] : 0) : particle[l];
            if (has) slot_put(b, q + l, row, used[l], pair_of(b, p, particle[l], row->nbr[used[l]])), used[l]++;
            else slot_pad(b, q + l, other < 0 || other >= p->n_all ? particle[l] : (int32_t)other);
        }
        bool consecutive = true;
        for (int l = 1; l < LANES; l++) consecutive = consecutive && b->nbr[q + l] == b->nbr[q] + l;
        b->first[b->slot[g] + k] = consecutive ? b->nbr[q] : -1;
        bonds_share(b, b->slot[g] + k);
    }
}

void group_follow(struct bonds *b, struct group_room *room, int64_t g)
{
    b->pattern[g] = room->pattern.slots > 0 ? pattern_known(b->patterns, &room->pattern, room->likely) : NULL;
    if (b->pattern[g]) room->likely = b->pattern[g];
}

bool group_regular(const struct lattice *lattice, const struct bond_source *s, const struct particles *p, int64_t i,
                          struct lattice_bonds *to)
{
    if (!lattice_bonds(lattice, p, i, to)) return false;
    for (int l = 0; l < LANES; l++)
        if (p->kind[i + l] != KIND_PD || cracks_near(s, p, i + l)) return false;
    return true;
}

/* Slot k of a group whose rows are regular. */
static void regular_weigh(const struct lattice_bonds *bonds, int k, const struct bond_source *s, const struct particles *p,
                          const struct pair_table *pairs, int32_t i, real *inverse, real *w)
{
    lattice_weigh(s, p, pairs, i, i + bonds->offset[k], inverse, w);
    for (int l = 0; l < LANES; l++)
        if (l < bonds->from[k] || l > bonds->to[k]) inverse[l] = w[l] = 0;
}

/* Does it follow a pattern? Then nothing is written. */
static bool regular_follows(struct bonds *b, struct group_room *room, int64_t g, const struct row_maker *m)
{
    const int32_t i = b->particle[g * LANES];
    real inverse[LANES], w[LANES];
    room->pattern.slots = 0;
    for (int k = 0; k < room->regular.n; k++) {
        regular_weigh(&room->regular, k, m->source, m->p, m->pairs, i, inverse, w);
        if (!pattern_add(&room->pattern, b, m->p, i, i + room->regular.offset[k], inverse, w)) return false;
    }
    group_follow(b, room, g);
    b->folded[g] = b->pattern[g] != NULL;
    return b->folded[g];
}

static void regular_write(struct bonds *b, const struct lattice_bonds *bonds, int64_t g, const struct row_maker *m)
{
    const int32_t i = b->particle[g * LANES];
    for (int k = 0; k < bonds->n; k++) {
        const int64_t slot = b->slot[g] + k, q = slot * LANES;
        b->first[slot] = i + bonds->offset[k];
        regular_weigh(bonds, k, m->source, m->p, m->pairs, i, b->inverse_length + q, b->w + q);
        for (int l = 0; l < LANES; l++) b->nbr[q + l] = b->first[slot] + l;
        bonds_share(b, slot);
    }
}

/* group_fill and group_note of whole rows on a lattice. */
void group_fill_regular(struct bonds *b, struct group_room *room, int64_t g, const struct row_maker *m)
{
    const struct lattice_bonds *bonds = &room->regular;
    const struct bond_source *s = m->source;
    const struct particles *p = m->p;
    const int32_t i = b->particle[g * LANES];
    real family_volume[LANES] = {0}, *trigger = b->trigger + g * LANES;
    if (!regular_follows(b, room, g, m)) regular_write(b, bonds, g, m);
    for (int l = 0; l < LANES; l++) trigger[l] = INFINITY;
    for (int k = 0; k < bonds->n; k++) {
        const int32_t j = i + bonds->offset[k], from = bonds->from[k], to = bonds->to[k];
        for (int l = 0; l < LANES; l++) family_volume[l] += l >= from && l <= to ? p->volume0[j + l] : 0;
        for (int l = from; l <= to; l++)
            if (s->limit.materials > 1 || trigger[l] == INFINITY)
                trigger[l] = real_min(trigger[l], row_trigger(s, p, i + l, j + l));
    }
    for (int l = 0; l < LANES; l++) b->family_volume[g * LANES + l] = (float)family_volume[l];
    b->aligned[g] = true;
}

void group_note(struct bonds *b, const struct group_room *room, int64_t g, int rows)
{
    bool aligned = rows == LANES;
    for (int l = 1; l < rows; l++) aligned = aligned && b->particle[g * LANES + l] == b->particle[g * LANES] + l;
    b->aligned[g] = aligned;
    for (int l = 0; l < rows; l++) {
        int64_t r = g * LANES + l;
        b->trigger[r] = room->row[l].trigger;
        b->family_volume[r] = (float)room->row[l].family_volume;
        b->broken_volume[r] = (float)room->row[l].cut_volume;
    }
    for (int l = rows; l < LANES; l++) b->trigger[g * LANES + l] = INFINITY;
}

void group_room_make(struct group_room *g, int room, const struct lattice *lattice)
{
    g->room = room;
    for (int l = 0; l < LANES; l++) row_room_make(&g->row[l], room);
    g->offset = NEW("bonds.offset", (int64_t)LANES * room + 1, int32_t);
    lattice_bonds_make(&g->regular, lattice);
    pattern_make(&g->pattern, LANES * room + 1);
}

void group_room_free(struct group_room *g)
{
    for (int l = 0; l < LANES; l++) row_room_free(&g->row[l]);
    memory_free(g->offset);
    lattice_bonds_free(&g->regular);
    pattern_free(&g->pattern);
}
