/* Stores the columns of rebuilt bonds (a column: the k-th bonds of eight rows; a row: all bonds of one particle).
 * Columns of unchanged blocks of eight rows keep their position. Other columns are placed in the holes of removed
 * blocks, or behind all stored columns. Memory that has been used is thus used again, and no column is copied. */
#include "bonds_parts.h"
#include "base/memory.h"

/* ---- holes ------------------------------------------------------------------------------------------------------- */

/* Linked lists of the holes (ranges of unused columns between blocks of eight rows), one list for each size.
 * first[size]: index of the first hole of this size in `all`, -1: none; next[hole]: next hole of the same size; most:
 * largest size. */
struct holes_by_size {
    struct bond_holes *all;
    int32_t *first, *next;
    int32_t most;
};

/* Inserts hole number k (a range of unused columns of the bond arrays, each with eight bonds) at the beginning of the
 * list of holes of its size in s. */
static void hole_list(struct holes_by_size *s, int64_t k)
{
    const int32_t size = s->all->hole[k].columns;
    s->next[k] = s->first[size];
    s->first[size] = (int32_t)k;
}

/* Returns lists of all holes (ranges of unused columns of the bond arrays, each with eight bonds) by size. all: the
 * holes, kept by reference. Release the lists with holes_close. */
static struct holes_by_size holes_sort(struct bond_holes *all)
{
    struct holes_by_size s = {.all = all};
    for (int64_t k = 0; k < all->n; k++) s.most = all->hole[k].columns > s.most ? all->hole[k].columns : s.most;
    s.first = BARE("bonds.hole_first", s.most + 1, int32_t);
    s.next = BARE("bonds.hole_next", all->n, int32_t);
    for (int32_t size = 0; size <= s.most; size++) s.first[size] = -1;
    for (int64_t k = all->n - 1; k >= 0; k--) hole_list(&s, k);
    return s;
}

/* Allocates `columns` columns (each of eight bonds) in the smallest hole of s (range of unused columns) that is large
 * enough, and returns the index of the first one. Returns -1 if there is no such hole or `columns` is 0. The rest of
 * the hole remains a hole. */
static int64_t hole_take(struct holes_by_size *s, int32_t columns)
{
    int32_t size = columns;
    while (size <= s->most && s->first[size] < 0) size++;
    if (columns == 0 || size > s->most) return -1;
    const int32_t k = s->first[size];
    struct bond_hole *hole = &s->all->hole[k];
    const int64_t at = hole->column;
    s->first[size] = s->next[k];
    hole->column += columns, hole->columns -= columns;
    if (hole->columns > 0) hole_list(s, k);
    return at;
}

/* Frees the lists of holes by size in s, and removes used-up holes from the array s->all: those of which no column is
 * left. (A hole is a range of unused columns, each with eight bonds.) */
static void holes_close(struct holes_by_size *s)
{
    int64_t n = 0;
    for (int64_t k = 0; k < s->all->n; k++)
        if (s->all->hole[k].columns > 0) s->all->hole[n++] = s->all->hole[k];
    s->all->n = n;
    memory_free(s->first);
    memory_free(s->next);
}

/* Appends the columns of those blocks of eight rows of the previous bonds `old` (the bonds of eight particles) that are
 * not kept to b->holes, the list of unused columns. The next rebuilding may use them; the present one still reads them.
 * kept[row_blocks of b]: block of `old` that is kept, or -1. */
static void holes_add(struct bonds *b, const struct bonds *old, const int64_t *kept)
{
    struct bond_holes *holes = &b->holes;
    uint8_t *stays = NEW("bonds.stays", old->row_blocks, uint8_t);
    int64_t more = old->row_blocks;
    for (int64_t g = 0; g < b->row_blocks; g++)
        if (kept[g] >= 0) stays[kept[g]] = 1, more--;
    GROW("bonds.hole", holes->hole, holes->n + more);
    for (int64_t g = 0; g < old->row_blocks; g++)
        if (!stays[g] && old->column_count[g] > 0)
            holes->hole[holes->n++] = (struct bond_hole){old->column[g], old->column_count[g]};
    memory_free(stays);
}

/* ---- positions of columns ---------------------------------------------------------------------------------------- */

/* Allocates the arrays of b with an entry for each column (the k-th bonds of eight rows), for b->room columns. s:
 * states which arrays the model needs; sparse: true to reserve addresses only, which get memory when they are written;
 * on a lattice most blocks of eight rows (the bonds of eight particles) write no column. */
static void columns_arrays(struct bonds *b, const struct bond_source *s, bool sparse)
{
    void *(*make)(const char *, int64_t, size_t) = sparse ? memory_new_lazy_uninitialised : memory_new_uninitialised;
    b->first = make("bonds.first", b->room, sizeof *b->first);
    b->nbr = make("bonds.nbr", b->room * LANES, sizeof *b->nbr);
    b->inverse_length = make("bonds.inverse_length", b->room * LANES, sizeof *b->inverse_length);
    b->w = make("bonds.w", b->room * LANES, sizeof *b->w);
    b->common = make("bonds.common", b->room, sizeof *b->common);
    if (s->limit.softening) {
        b->soft.most = memory_new_lazy_uninitialised("bonds.most", b->room * LANES, sizeof(float));
        b->soft.onset = memory_new_lazy_uninitialised("bonds.onset", b->room * LANES, sizeof(float));
        b->soft.end = memory_new_lazy_uninitialised("bonds.end", b->room * LANES, sizeof(float));
    }
    if (s->limit.softening && s->modulus)
        b->soft.whole = memory_new_lazy_uninitialised("bonds.whole_w", b->room * LANES, sizeof(float));
    if (!s->yield.stretch) return;
    b->yield = s->yield;
    b->plastic_stretch = NEW("bonds.plastic_stretch", b->room * LANES, real);
    b->plastic_path = NEW("bonds.plastic_path", b->room * LANES, real);
    b->pair = NEW("bonds.pair", b->room * LANES, int32_t);
}

/* Extends the bond arrays of b, whose entries belong to columns of eight bonds, from b->room to `room` columns. The new
 * entries are not initialised. The arrays may move to another address. */
static void columns_extend(struct bonds *b, int64_t room)
{
    const int64_t had = b->room, each = LANES;
    b->first = memory_resize_uninitialised("bonds.first", b->first, had, room, sizeof *b->first);
    b->nbr = memory_resize_uninitialised("bonds.nbr", b->nbr, had * each, room * each, sizeof *b->nbr);
    b->inverse_length = memory_resize_uninitialised("bonds.inverse_length", b->inverse_length, had * each, room * each,
                                                    sizeof *b->inverse_length);
    b->w = memory_resize_uninitialised("bonds.w", b->w, had * each, room * each, sizeof *b->w);
    b->common = memory_resize_uninitialised("bonds.common", b->common, had, room, sizeof *b->common);
    if (b->soft.most) {
        b->soft.most = memory_resize_uninitialised("bonds.most", b->soft.most, had * each, room * each, sizeof(float));
        b->soft.onset =
            memory_resize_uninitialised("bonds.onset", b->soft.onset, had * each, room * each, sizeof(float));
        b->soft.end = memory_resize_uninitialised("bonds.end", b->soft.end, had * each, room * each, sizeof(float));
        if (b->soft.whole)
            b->soft.whole =
                memory_resize_uninitialised("bonds.whole_w", b->soft.whole, had * each, room * each, sizeof(float));
        INVARIANT(!b->soft.settled); /* rows of load steps with softening are made once */
    }
    b->room = room;
}

/* Chooses the position of each block g of eight rows (the bonds of eight particles) of b in the arrays of the previous
 * bonds `old` that have an entry for each column (the k-th bonds of the eight rows). If kept[g] >= 0, it is equal to
 * this previous block and stays at the columns of that one. If kept[g] is -1, it gets a range of unused columns that is
 * large enough, or else columns at the end of the arrays, which are extended. */
static void columns_fit(struct bonds *b, struct bonds *old, const int64_t *kept)
{
    struct holes_by_size holes = holes_sort(&old->holes);
    b->used = old->used;
    for (int64_t g = 0; g < b->row_blocks; g++) {
        b->column[g] = kept[g] >= 0 ? old->column[kept[g]] : hole_take(&holes, b->column_count[g]);
        if (b->column[g] < 0) b->column[g] = b->used, b->used += b->column_count[g];
    }
    holes_close(&holes);
    if (b->used > old->room) columns_extend(old, 2 * b->used);
}

/* Makes b use the column arrays of the previous bonds `old`. Both use them until
 * bonds_disown_arrays_shared_with_new_bonds removes them from `old`. kept[g]: block of eight rows of `old` (the bonds
 * of eight particles) whose columns block g of b continues to use, or -1. */
static void columns_share(struct bonds *b, struct bonds *old, const int64_t *kept)
{
    b->room = old->room;
    b->first = old->first, b->nbr = old->nbr, b->inverse_length = old->inverse_length, b->w = old->w,
    b->common = old->common;
    b->soft.most = old->soft.most, b->soft.onset = old->soft.onset, b->soft.end = old->soft.end;
    b->soft.whole = old->soft.whole;
    b->holes = old->holes;
    old->holes = (struct bond_holes){0};
    holes_add(b, old, kept);
}

/* Assigns columns (the k-th bonds of eight rows) to all blocks of eight rows of b, in the arrays of the previous bonds
 * inputs->old if possible, else in new ones. Blocks with plastic bonds always get new arrays, because their plastic
 * state is archived in the order of the blocks (bonds_archive.c). previous_row_block[row_blocks]: previous block that
 * is kept, or -1; not used without previous bonds. */
void bonds_allocate_storage_for_row_blocks(struct bonds *b, const struct bond_row_inputs *inputs,
                                           const int64_t *previous_row_block)
{
    for (int64_t g = 0; g < b->row_blocks; g++) b->columns += b->column_count[g];
    bonds_compute_lattice_shell_lengths(b, inputs->source->family.spacing);
    if (inputs->old && !inputs->old->plastic_stretch && inputs->old->room > 0) {
        columns_fit(b, inputs->old, previous_row_block);
        columns_share(b, inputs->old, previous_row_block);
        return;
    }
    for (int64_t g = 0; g < b->row_blocks; g++) b->column[g] = b->used, b->used += b->column_count[g];
    b->room = b->columns;
    columns_arrays(b, inputs->source, inputs->map->at != NULL);
}

void bonds_disown_arrays_shared_with_new_bonds(struct bonds *previous, const struct bonds *b)
{
    if (!previous || previous->w != b->w) return;
    previous->first = previous->nbr = NULL, previous->inverse_length = previous->w = NULL, previous->common = NULL;
    previous->soft.most = previous->soft.onset = previous->soft.end = previous->soft.whole = NULL;
}
