/* Stores stencils: lists of bond vectors and weights that blocks of eight bond rows with equal bonds share, instead of
 * storing their bonds one by one. */
#include <string.h>

#include "bonds_parts.h"
#include "base/memory.h"

/* STENCILS_MOST: largest number of stencils (bonds that equal blocks share) in a table. HASHES: number of hash values,
 * with one list of stencils each. */
enum { STENCILS_MOST = 2048, HASHES = 4096 };

/* Table of stencils (bonds that many blocks of eight rows have in common), with a list for each hash value to find
 * equal ones. Several bond storages share one table; the last one to be freed frees it. */
struct stencil_table {
    int n, users; /* number of stencils; number of bond storages that share them */
    struct stencil stencil[STENCILS_MOST];
    int32_t first[HASHES]; /* first stencil with this hash, + 1; 0: none */
};

struct stencil_table *stencil_table_add_reference_or_make(struct stencil_table *existing)
{
    struct stencil_table *p = existing ? existing : NEW("bonds.stencils", 1, struct stencil_table);
    p->users++;
    return p;
}

void stencil_table_drop_reference(struct stencil_table *stencils)
{
    if (!stencils || --stencils->users > 0) return;
    for (int k = 0; k < stencils->n; k++) memory_free(stencils->stencil[k].column), memory_free(stencils->stencil[k].w);
    memory_free(stencils);
}

void stencil_allocate_columns(struct stencil *stencil, int max_columns)
{
    *stencil = (struct stencil){0};
    stencil->column = BARE("bonds.stencil_column", max_columns, struct stencil_column);
    stencil->w = (real(*)[LANES])BARE("bonds.stencil_w", (int64_t)max_columns * LANES, real);
}

void stencil_free(struct stencil *stencil)
{
    memory_free(stencil->column);
    memory_free(stencil->w);
}

/* ---- stencil of one block of eight rows -------------------------------------------------------------------------- */

/* Stores the reference vector of the bonds from particle i + l to particle j + l of p, l = 0 .. 7, in the stencil
 * column `to` (eight bonds, one of each of eight particles), whose bits to->intact must be set. Returns false if the
 * intact bonds do not all have the same vector to the last bit. */
static bool reference_of(const struct particles *p, int64_t i, int64_t j, struct stencil_column *to)
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

bool stencil_add_column(struct stencil *stencil, const struct bonds *b, const struct particles *p,
                        int64_t first_particle, const struct column_copy *added_column)
{
    struct stencil_column *column = &stencil->column[stencil->columns];
    const real *inverse = added_column->inverse_length, *w = added_column->w;
    int16_t excess[LANES];
    int alone = added_column->first < 0, alike = 1, bonds = 0;
    *column =
        (struct stencil_column){.offset = (int32_t)(added_column->first - first_particle),
                                .shell = (uint8_t)eight_bonds_find_common_squared_lattice_distance(b, inverse, excess)};
    for (int l = 0; l < LANES; l++) {
        stencil->w[stencil->columns][l] = w[l];
        alone |= (w[l] == 0) != (inverse[l] == 0); /* cut or broken */
        if (w[l] == 0) continue;
        alone |= bonds > 0 && inverse[l] != column->inverse_length;
        alike &= bonds == 0 || w[l] == column->w;
        column->inverse_length = inverse[l], column->w = w[l], column->intact |= (uint8_t)(1 << l), bonds++;
    }
    if (alone || bonds == 0 || column->shell == 0 || !reference_of(p, first_particle, added_column->first, column))
        return false;
    const struct bond_length *length = &b->shell_length[column->shell];
    column->length = 1 / column->inverse_length;
    column->weighted = column->w * length->length, column->squared = column->w * length->square;
    for (int d = 0; d < p->dim; d++) column->w_xi[d] = column->w * column->xi[d];
    stencil->whole = (stencil->columns == 0 || stencil->whole) && alike && bonds == LANES;
    stencil->unit = stencil->whole && (stencil->columns == 0 || stencil->unit) && column->w == 1;
    stencil->columns++;
    return true;
}

/* ---- all stencils ------------------------------------------------------------------------------------------------ */

/* Returns true if the stencils a and b are equal byte by byte. (A stencil has the bond vectors and weights that many
 * particles of a lattice have in common.) */
static bool stencils_equal(const struct stencil *a, const struct stencil *b)
{
    return a->columns == b->columns && arrays_equal(a->column, b->column, a->columns, sizeof *a->column) &&
           arrays_equal(a->w, b->w, a->columns, sizeof *a->w);
}

/* Returns a hash of the stencil p (bonds that many blocks of eight rows share), from 0 to HASHES - 1, by the method of
 * Fowler, Noll and Vo. It depends on the index distance (neighbour minus particle) and the first weight of each column
 * of p. */
static int hash_of(const struct stencil *p)
{
    const uint64_t prime = UINT64_C(0x100000001b3);
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (int k = 0; k < p->columns; k++) {
        const struct stencil_column *column = &p->column[k];
        uint64_t weight;
        memcpy(&weight, &column->w, sizeof weight);
        hash = (hash ^ ((uint64_t)(uint32_t)column->offset << LANES | column->intact)) * prime;
        hash = (hash ^ weight) * prime;
    }
    return (int)((hash ^ hash >> 32) % HASHES);
}

/* Returns the stencil (bond vectors and weights that many particles share) in the table `all` that equals `stencil`. If
 * there is none, stores a copy of `stencil` in the table and returns the copy, or NULL if the table already has
 * STENCILS_MOST stencils. The table owns what is returned. */
static const struct stencil *stencil_store(struct stencil_table *all, const struct stencil *stencil)
{
    const int hash = hash_of(stencil);
    for (int32_t k = all->first[hash] - 1; k >= 0; k = all->stencil[k].next)
        if (stencils_equal(&all->stencil[k], stencil)) return &all->stencil[k];
    if (all->n == STENCILS_MOST) return NULL;
    struct stencil *stored = &all->stencil[all->n];
    stencil_allocate_columns(stored, stencil->columns);
    array_copy(stored->column, stencil->column, stencil->columns, sizeof *stored->column);
    array_copy(stored->w, stencil->w, stencil->columns, sizeof *stored->w);
    stored->columns = stencil->columns, stored->whole = stencil->whole, stored->unit = stencil->unit;
    stored->next = all->first[hash] - 1;
    all->first[hash] = ++all->n;
    return stored;
}

const struct stencil *stencil_find_or_add(struct stencil_table *table, const struct stencil *stencil,
                                          const struct stencil *first_guess)
{
    const struct stencil *known;
    if (first_guess && stencils_equal(first_guess, stencil)) return first_guess;
#pragma omp critical(bonds_stencils)
    known = stencil_store(table, stencil);
    return known;
}

bool bond_row_block_share_stencil_of_particle(struct bonds *b, int64_t g, int64_t particle)
{
    const int64_t from = particle >= 0 ? b->row_of[particle] / LANES : g;
    if (!b->stencil[from]) return false;
    b->stencil[g] = b->stencil[from];
    b->implicit[g] = b->aligned[g] = true;
    memcpy(b->trigger + g * LANES, b->trigger + from * LANES, LANES * sizeof *b->trigger);
    memcpy(b->family_volume + g * LANES, b->family_volume + from * LANES, LANES * sizeof *b->family_volume);
    return true;
}

/* ---- bond by bond ------------------------------------------------------------------------------------------------ */

/* Reads column k (the k-th bonds of eight particles) of a block of eight rows of b into *copy: neighbours, inverse
 * lengths and weights. They are taken from the stencil if the block stores no columns. row_block: index of the block.
 */
void bond_column_read_eight_bonds(struct column_copy *copy, const struct bonds *b, int64_t row_block, int64_t k)
{
    const int64_t column = b->column[row_block] + k;
    if (!__atomic_load_n(&b->implicit[row_block], __ATOMIC_ACQUIRE)) {
        copy->first = b->first[column];
        memcpy(copy->nbr, b->nbr + column * LANES, sizeof copy->nbr);
        memcpy(copy->inverse_length, b->inverse_length + column * LANES, sizeof copy->inverse_length);
        memcpy(copy->w, b->w + column * LANES, sizeof copy->w);
        return;
    }
    const struct stencil_column *of = &b->stencil[row_block]->column[k];
    copy->first = b->particle[row_block * LANES] + of->offset;
    memcpy(copy->w, b->stencil[row_block]->w[k], sizeof copy->w);
    for (int l = 0; l < LANES; l++)
        copy->nbr[l] = copy->first + l, copy->inverse_length[l] = copy->w[l] == 0 ? 0 : of->inverse_length;
}

/* Returns true if block number row_block of eight rows of b (the bonds of eight particles) may have bonds to mirror
 * images of p; false only if it has none. Images have indices above those of all particles. Blocks without a stencil
 * are not examined (true). In a stencil, bonds are sorted by neighbour, up to padding of fewer than eight lanes; there
 * is none to an image if the last one is far enough below the first image. */
bool bond_row_block_may_have_bonds_to_mirror_images(const struct bonds *b, const struct particles *p, int64_t row_block)
{
    const int64_t columns = bond_row_block_bond_slots_per_particle(b, row_block);
    if (p->n_all == p->n || columns == 0) return false;
    return !b->stencil[row_block] ||
           bond_column_first_neighbour_if_consecutive(b, row_block, columns - 1) + 3 * LANES > p->n;
}

void bonds_row_clear_bitmap_at_intact_neighbours(const struct bonds *b, int64_t row, uint64_t *particle_bits)
{
    if (row < 0) return;
    const int64_t row_block = row / LANES, from = b->column[row_block];
    const int lane = (int)(row % LANES);
    const struct stencil *stencil = b->stencil[row_block];
    const int32_t first = b->particle[row_block * LANES] + lane;
    for (int k = 0; stencil && k < stencil->columns; k++)
        if (stencil->column[k].intact >> lane & 1) bit_clear(particle_bits, first + stencil->column[k].offset);
    for (int64_t column = from; !stencil && column < from + b->column_count[row_block]; column++) {
        const struct bond_column *c = &b->common[column];
        if (c->intact >> lane & 1)
            bit_clear(particle_bits, c->first >= 0 ? c->first + lane : b->nbr[column * LANES + lane]);
    }
}

void bond_column_write_eight_bonds(const struct bonds *b, int64_t column_number, const struct column_copy *bonds)
{
    b->first[column_number] = bonds->first;
    memcpy(b->nbr + column_number * LANES, bonds->nbr, sizeof bonds->nbr);
    memcpy(b->inverse_length + column_number * LANES, bonds->inverse_length, sizeof bonds->inverse_length);
    memcpy(b->w + column_number * LANES, bonds->w, sizeof bonds->w);
    bond_column_update_common_bond_properties(b, column_number);
}

/* Stores the columns (k-th bonds of all rows) of block `row_block` of eight rows (the bonds of eight particles) in the
 * arrays of b. So far the stencil of the block alone defined them. */
static void expand(struct bonds *b, int64_t row_block)
{
    struct column_copy copy;
    for (int64_t column = b->column[row_block]; column < b->column[row_block] + b->column_count[row_block]; column++) {
        bond_column_read_eight_bonds(&copy, b, row_block, column - b->column[row_block]);
        bond_column_write_eight_bonds(b, column, &copy);
    }
}

void bond_row_block_copy_bonds_from_stencil(struct bonds *b, int64_t row_block)
{
#pragma omp critical(bonds_unfold)
    if (b->implicit[row_block]) {
        expand(b, row_block);
        __atomic_store_n(&b->implicit[row_block], 0, __ATOMIC_RELEASE);
    }
}

void bond_update_cached_data_after_modification(struct bonds *b, int64_t row_number, int64_t q)
{
    b->stencil[row_number / LANES] = NULL;
    b->changed[row_number / LANES] = 1;
    bond_column_update_common_bond_properties(b, q / LANES);
    __atomic_store_n(&b->clamped.stale, true, __ATOMIC_RELAXED); /* several threads may break bonds */
}
