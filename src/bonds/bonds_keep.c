/* Copies unchanged blocks of eight rows (the bonds of eight particles) from the previous bonds, and neighbours that
 * were found while columns were counted. */
#include <string.h>

#include "bonds_parts.h"
#include "base/memory.h"

int64_t bond_row_block_find_equal_in_previous_bonds(const struct bonds *b, const struct bond_row_inputs *inputs,
                                                    int64_t g)
{
    const int32_t *particle = b->particle + g * LANES;
    const int64_t first = inputs->old ? inputs->old->row_of[particle[0]] : -1;
    const int rows = bond_row_block_row_count(b, g);
    if (first < 0 || first % LANES != 0 || bond_row_block_row_count(inputs->old, first / LANES) != rows) return -1;
    for (int l = 0; l < rows; l++)
        if (inputs->old->row_of[particle[l]] != first + l ||
            !bond_row_previous_neighbours_are_valid(inputs, particle[l]))
            return -1;
    return first / LANES;
}

/* Copies the entries of one array from block number `of` of the previous bonds `old` to block number g of b. A block
 * has eight rows (the bonds of eight particles); column k has the k-th bonds of the rows. to, from: the array in b and
 * in `old`, with an entry for each column; each: size of an entry [byte]. */
static void columns_copy(void *to, const void *from, size_t each, const struct bonds *b, const struct bonds *old,
                         int64_t g, int64_t of)
{
    array_copy((char *)to + (size_t)b->column[g] * each, (const char *)from + (size_t)old->column[of] * each,
               b->column_count[g], each);
}

/* Copies the entries of all column arrays, and the softening and plastic state of the bonds, from block number `from`
 * of the previous bonds `old` to block number g of b (blocks of eight rows stored together; a column has the k-th bonds
 * of the rows). */
static void columns_keep(struct bonds *b, const struct bonds *old, int64_t g, int64_t from)
{
    columns_copy(b->first, old->first, sizeof *b->first, b, old, g, from);
    columns_copy(b->common, old->common, sizeof *b->common, b, old, g, from);
    columns_copy(b->nbr, old->nbr, LANES * sizeof *b->nbr, b, old, g, from);
    columns_copy(b->inverse_length, old->inverse_length, LANES * sizeof(real), b, old, g, from);
    columns_copy(b->w, old->w, LANES * sizeof(real), b, old, g, from);
    if (old->soft.curve && old->soft.begun[from]) {
        columns_copy(b->soft.most, old->soft.most, LANES * sizeof(float), b, old, g, from);
        columns_copy(b->soft.onset, old->soft.onset, LANES * sizeof(float), b, old, g, from);
        columns_copy(b->soft.end, old->soft.end, LANES * sizeof(float), b, old, g, from);
        if (b->soft.whole) columns_copy(b->soft.whole, old->soft.whole, LANES * sizeof(float), b, old, g, from);
    }
    if (b->plastic_stretch) {
        columns_copy(b->plastic_stretch, old->plastic_stretch, LANES * sizeof(real), b, old, g, from);
        columns_copy(b->plastic_path, old->plastic_path, LANES * sizeof(real), b, old, g, from);
        columns_copy(b->pair, old->pair, LANES * sizeof *b->pair, b, old, g, from);
    }
}

void bond_row_block_copy_from_previous_bonds(struct bonds *b, const struct bonds *previous_bonds, int64_t g,
                                             int64_t previous_row_block)
{
    b->stencil[g] = previous_bonds->stencil[previous_row_block];
    b->implicit[g] = previous_bonds->implicit[previous_row_block],
    b->changed[g] = previous_bonds->changed[previous_row_block];
    if (!b->implicit[g] && b->w != previous_bonds->w) columns_keep(b, previous_bonds, g, previous_row_block);
    if (b->soft.curve)
        b->soft.begun[g] = previous_bonds->soft.begun[previous_row_block],
        b->soft.due[g] = previous_bonds->soft.due[previous_row_block];
    b->made[g] = previous_bonds->made[previous_row_block];
    b->aligned[g] = previous_bonds->aligned[previous_row_block];
    if (b->state.weighted)
        memcpy(b->state.weighted + g * LANES, previous_bonds->state.weighted + previous_row_block * LANES,
               LANES * sizeof(real));
    memcpy(b->trigger + g * LANES, previous_bonds->trigger + previous_row_block * LANES, LANES * sizeof *b->trigger);
    memcpy(b->family_volume + g * LANES, previous_bonds->family_volume + previous_row_block * LANES,
           LANES * sizeof *b->family_volume);
    memcpy(b->broken_volume + g * LANES, previous_bonds->broken_volume + previous_row_block * LANES,
           LANES * sizeof *b->broken_volume);
}

struct bond_row_block_neighbours *bond_rows_save_found_neighbours(const struct bond_row *row, int row_count)
{
    int64_t n = 0;
    for (int l = 0; l < row_count; l++) n += row[l].n;
    struct bond_row_block_neighbours *found =
        memory_new_uninitialised("bonds.group_found", 1, sizeof *found + (size_t)n * sizeof *found->nbr);
    int32_t *to = found->nbr;
    for (int l = 0; l < row_count; l++) {
        found->n[l] = row[l].n, found->family_volume[l] = row[l].family_volume;
        array_copy(to, row[l].nbr, row[l].n, sizeof *to);
        to += row[l].n;
    }
    return found;
}

void bond_rows_restore_found_neighbours(const struct bond_row_block_neighbours *saved, struct bond_row *row,
                                        int row_count)
{
    const int32_t *from = saved->nbr;
    for (int l = 0; l < row_count; l++) {
        row[l].n = saved->n[l], row[l].family_volume = saved->family_volume[l];
        array_copy(row[l].nbr, from, row[l].n, sizeof *from);
        from += row[l].n;
    }
}
