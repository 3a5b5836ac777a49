/* floor 1: making bond rows: pack eight rows to a group. */
#include "bonds_parts.h"

#include <math.h>
#include <omp.h>
#include <string.h>

#include "memory.h"

/* A thread's room for the eight rows of a group. */
struct group_room {
    struct lattice_bonds regular;        /* without a search                   */
    int room;                            /* bonds a row may have */
    struct row row[LANES];
    int32_t *offset;                     /* [LANES room] distinct index distances */
};

static bool was_whole(const struct bonds *old, const struct bond_source *s, const struct particles *p, int64_t i)
{
    i = image_root(p, s->image, i);
    return old->row_of[i] >= 0 && old->whole[old->row_of[i]];
}

/* Rows made before can be taken over if nobody who held a whole one has turned back into a material point. */
static bool rows_last(const struct bonds *old, const struct particles *p)
{
    if (!old) return false;
    for (int64_t r = 0; r < old->rows; r++)
        if (old->whole[r] && p->kind[old->particle[r]] != KIND_PD) return false;
    return true;
}

/* Rows: peridynamic particles, and material points with a peridynamic neighbour. Marks `wanted`; `fresh` those that have to be
 * searched anew: of who has become peridynamic and whoever is within its reach. */
static void mark_rows(const struct bond_source *s, const struct particles *p, const struct bonds *old, int room,
                      uint8_t *wanted, uint8_t *fresh)
{
    const bool last = rows_last(old, p);
    if (!last) memset(fresh, 1, (size_t)p->n);
    if (p->n_of[KIND_PD] == p->n && !last) {
        memset(wanted, 1, (size_t)p->n);
        return;
    }
    for (int64_t r = 0; last && r < old->rows; r++) wanted[old->particle[r]] = 1;
    int32_t *found = NEW("bonds.found", room, int32_t);
    for (int64_t i = 0; i < p->n_all; i++) {
        if (p->kind[i] != KIND_PD || (last && was_whole(old, s, p, i))) continue;
        if (i < p->n) wanted[i] = fresh[i] = 1;
        int n = family_search(s, p, (int32_t)i, found, room);
        for (int k = 0; k < n; k++)
            if (found[k] < p->n) wanted[found[k]] = fresh[found[k]] = 1;
    }
    memory_free(found);
}

/* ---- one group ------------------------------------------------------------------------------------- */

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
static int group_slots(struct group_room *g, const int32_t *particle, int rows, bool *by_offset)
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

static void group_fill(struct bonds *b, struct group_room *room, int64_t g, int rows, bool by_offset,
                       const struct particles *p)
{
    const int32_t *particle = b->particle + g * LANES;
    int used[LANES] = {0}, slots = (int)(b->slot[g + 1] - b->slot[g]);
    for (int k = 0; k < slots; k++) {
        int64_t q = bond_index(b, g, k, 0);
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

bool group_regular(const struct lattice *lattice, const struct bond_source *s, const struct particles *p, int64_t i,
                          struct lattice_bonds *to)
{
    if (!lattice_bonds(lattice, p, i, to)) return false;
    for (int l = 0; l < LANES; l++)
        if (p->kind[i + l] != KIND_PD || cracks_near(s, p, i + l)) return false;
    return true;
}

/* group_fill and group_note of whole rows on a lattice. */
static void group_fill_regular(struct bonds *b, const struct lattice_bonds *bonds, int64_t g, const struct bond_source *s,
                               const struct particles *p, const struct pair_table *pairs)
{
    const int32_t i = b->particle[g * LANES];
    real family_volume[LANES] = {0}, *trigger = b->trigger + g * LANES;
    for (int l = 0; l < LANES; l++) trigger[l] = INFINITY;
    for (int k = 0; k < bonds->n; k++) {
        const int32_t j = i + bonds->offset[k], from = bonds->from[k], to = bonds->to[k];
        const int64_t q = bond_index(b, g, k, 0);
        lattice_weigh(s, p, pairs, i, j, b->inverse_length + q, b->w + q);
        for (int l = 0; l < LANES; l++) b->nbr[q + l] = j + l;
        for (int l = 0; l < LANES; l++)
            if (l < from || l > to) slot_pad(b, q + l, j + l);
        for (int l = 0; l < LANES; l++) family_volume[l] += l >= from && l <= to ? p->volume0[j + l] : 0;
        for (int l = from; l <= to; l++)
            if (s->limit.materials > 1 || trigger[l] == INFINITY)
                trigger[l] = real_min(trigger[l], row_trigger(s, p, i + l, j + l));
        b->first[b->slot[g] + k] = j;
        bonds_share(b, b->slot[g] + k);
    }
    for (int l = 0; l < LANES; l++) b->family_volume[g * LANES + l] = (float)family_volume[l];
    b->aligned[g] = true;
}

static void group_note(struct bonds *b, const struct group_room *room, int64_t g, int rows)
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

/* ---- all rows -------------------------------------------------------------------------------------- */

static void rooms_make(struct group_room *g, int room, const struct lattice *lattice)
{
    g->room = room;
    for (int l = 0; l < LANES; l++) row_room_make(&g->row[l], room);
    g->offset = NEW("bonds.offset", (int64_t)LANES * room + 1, int32_t);
    lattice_bonds_make(&g->regular, lattice);
}

static void rooms_free(struct group_room *g)
{
    for (int l = 0; l < LANES; l++) row_room_free(&g->row[l]);
    memory_free(g->offset);
    lattice_bonds_free(&g->regular);
}

struct pair_table pairs_make(const struct bond_source *s)
{
    struct pair_table t = {NEW("bonds.pairs", square(s->materials), real), s->materials};
    real *c = NEW("bonds.moduli", s->materials, real);
    for (int m = 0; m < s->materials; m++) c[m] = family_micro_modulus(&s->family, &s->material[m]);
    for (int a = 0; a < s->materials; a++)       /* springs in series across a material interface */
        for (int b = 0; b < s->materials; b++)
            t.ratio[a * s->materials + b] = s->modulus ? 1 : 2 * (c[a] * c[b]) / (c[a] + c[b]) / c[0];
    memory_free(c);
    return t;
}

static void rows_list(struct bonds *b, const struct particles *p, const uint8_t *wanted)
{
    b->row_of = NEW("bonds.row_of", p->n_all, int32_t);
    b->rows = 0;
    for (int64_t i = 0; i < p->n_all; i++) b->row_of[i] = i < p->n && wanted[i] ? (int32_t)b->rows++ : -1;
    b->groups = (b->rows + LANES - 1) / LANES;
    b->particle = NEW("bonds.particle", b->groups * LANES, int32_t);
    for (int64_t i = 0; i < p->n; i++)
        if (b->row_of[i] >= 0) b->particle[b->row_of[i]] = (int32_t)i;
    for (int64_t r = b->rows; r < b->groups * LANES; r++) b->particle[r] = b->particle[b->rows - 1];
}

static void rows_arrays(struct bonds *b)
{
    int64_t padded = b->groups * LANES;
    b->slot = NEW("bonds.slot", b->groups + 1, int64_t);
    b->aligned = NEW("bonds.aligned", b->groups, uint8_t);
    b->whole = NEW("bonds.whole", padded, uint8_t);
    b->trigger = NEW("bonds.trigger", padded, real);
    b->family_volume = NEW("bonds.family_volume", padded, float);
    b->broken_volume = NEW("bonds.broken_volume", padded, float);
    b->fracture_energy = NEW("bonds.fracture_energy", padded, real);
    b->plastic_work = NEW("bonds.plastic_work", padded, real);
    b->broken = NEW("bonds.broken", padded, int32_t);
    rest_make(&b->rest, b->groups);
}

/* Bonds go to memory in the second of two equal passes, the first only counts: a list of all bonds never exists twice.
 * Returns how many there are. */
static int64_t rows_pass(struct bonds *b, const struct bonds *old, const struct particles *p, const struct bond_source *s,
                      const struct pair_table *pairs, const struct lattice *lattice, const uint8_t *fresh, int most, bool count)
{
    int64_t made = 0;
#pragma omp parallel reduction(+ : made)
    {
        struct group_room room = {0};
        rooms_make(&room, most, lattice);
#pragma omp for schedule(static)
        for (int64_t g = 0; g < b->groups; g++) {
            int rows = group_rows(b, g);
            const int32_t *particle = b->particle + g * LANES;
            if (lattice->at && rows == LANES && particle[LANES - 1] - particle[0] == LANES - 1 &&
                group_regular(lattice, s, p, particle[0], &room.regular)) {
                if (count) b->slot[g + 1] = room.regular.n;
                else group_fill_regular(b, &room.regular, g, s, p, pairs);
                for (int k = 0; k < room.regular.n; k++) made += room.regular.to[k] - room.regular.from[k] + 1;
                continue;
            }
            for (int l = 0; l < rows; l++) {
                int32_t i = b->particle[g * LANES + l];
                row_make(&room.row[l], old, s, p, pairs, i, most, !count, fresh[i]);
                made += room.row[l].n;
            }
            bool by_offset;
            int slots = group_slots(&room, b->particle + g * LANES, rows, &by_offset);
            if (count) b->slot[g + 1] = slots;
            else group_fill(b, &room, g, rows, by_offset, p), group_note(b, &room, g, rows);
        }
        rooms_free(&room);
    }
    return made;
}

static void rows_carry(struct bonds *b, const struct bonds *old)
{
    for (int64_t r = 0; r < b->rows; r++) {
        int32_t before = old->row_of[b->particle[r]];
        if (before < 0) continue;
        b->fracture_energy[r] = old->fracture_energy[before];
        b->plastic_work[r] = old->plastic_work[before];
        b->broken[r] = old->broken[before];
    }
}

void bonds_make(struct bonds *b, const struct bonds *old, struct particles *p, const struct bond_source *s)
{
    memset(b, 0, sizeof *b);
    int most = bonds_room(s);
    uint8_t *wanted = NEW("bonds.wanted", p->n, uint8_t);
    uint8_t *fresh = NEW("bonds.fresh", p->n, uint8_t);
    mark_rows(s, p, old, most, wanted, fresh);
    rows_list(b, p, wanted);
    memory_free(wanted);
    rows_arrays(b);

    struct pair_table pairs = pairs_make(s);
    struct lattice lattice = {0};
    if (!old) lattice_make(&lattice, s, p);      /* a map of all sites does not pay for a few rows */
    rows_pass(b, old, p, s, &pairs, &lattice, fresh, most, true);
    for (int64_t g = 0; g < b->groups; g++) b->slot[g + 1] += b->slot[g];
    b->slots = b->slot[b->groups];
    b->first = NEW("bonds.first", b->slots, int32_t);
    b->nbr = NEW("bonds.nbr", b->slots * LANES, int32_t);
    b->inverse_length = NEW("bonds.inverse_length", b->slots * LANES, real);
    b->w = NEW("bonds.w", b->slots * LANES, real);
    bonds_share_make(b, s->family.spacing);
    if (s->yield.stretch) {
        b->yield = s->yield;
        b->plastic_stretch = NEW("bonds.plastic_stretch", b->slots * LANES, real);
        b->plastic_path = NEW("bonds.plastic_path", b->slots * LANES, real);
        b->pair = NEW("bonds.pair", b->slots * LANES, int32_t);
    }
    b->n = rows_pass(b, old, p, s, &pairs, &lattice, fresh, most, false);
    lattice_free(&lattice);
    memory_free(fresh);
    memory_free(pairs.ratio);
    if (old) rows_carry(b, old);

    b->stiffness = family_micro_modulus(&s->family, &s->material[0]) * square(s->family.cell_volume);
#pragma omp parallel for schedule(static)
    for (int64_t r = 0; r < b->rows; r++) {
        b->whole[r] = p->kind[b->particle[r]] == KIND_PD;
        if (b->whole[r])
            p->damage[b->particle[r]] = b->family_volume[r] > 0 ? b->broken_volume[r] / b->family_volume[r] : 0;
    }
    state_make(b, p, s);
}

void bonds_images_follow(struct particles *p, const struct bond_source *s)
{
    for (int64_t k = p->n; k < p->n_all; k++) p->kind[k] = p->kind[s->image[k - p->n].source];
}

void bonds_renew(struct bonds *b, struct particles *p, const struct bond_source *s)
{
    struct bonds old = *b;
    bonds_images_follow(p, s);
    particles_list(p);
    bonds_make(b, &old, p, s);
    for (int64_t row = 0; row < old.rows; row++) {
        const int32_t i = old.particle[row];
        for (int d = 0; d < p->dim && b->row_of[i] < 0; d++) p->f[d][i] = 0;
    }
    bonds_free(&old);
}

void bonds_free(struct bonds *b)
{
    memory_free(b->particle);
    memory_free(b->row_of);
    memory_free(b->slot);
    memory_free(b->aligned);
    memory_free(b->whole);
    memory_free(b->first);
    memory_free(b->nbr);
    memory_free(b->inverse_length);
    memory_free(b->w);
    memory_free(b->common);
    memory_free(b->lattice);
    memory_free(b->plastic_stretch);
    memory_free(b->plastic_path);
    memory_free(b->pair);
    memory_free(b->plastic_work);
    state_free(b);
    rest_free(&b->rest);
    memory_free(b->trigger);
    memory_free(b->family_volume);
    memory_free(b->broken_volume);
    memory_free(b->fracture_energy);
    memory_free(b->broken);
    memset(b, 0, sizeof *b);
}
