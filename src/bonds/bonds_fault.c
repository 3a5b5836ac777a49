/* Checks the invariants of stored bonds (bond_storage.h) one by one. */
#include <stdio.h>

#include "bonds_parts.h"

/* Checks the order of the rows of b, of which each has the bonds of one particle: b->particle[row] must ascend,
 * b->row_of must be its inverse, and the rows that pad the last block of eight rows must repeat the last particle.
 * Returns a constant text that names the first fault, or NULL if there is none. */
static const char *rows_fault(const struct bonds *b)
{
    for (int64_t row = 0; row < b->rows; row++) {
        if (row > 0 && b->particle[row] <= b->particle[row - 1]) return "rows do not ascend by particle";
        if (b->row_of[b->particle[row]] != row) return "row_of is not the inverse of `particle`";
    }
    for (int64_t row = b->rows; row < b->row_blocks * LANES; row++)
        if (b->rows > 0 && b->particle[row] != b->particle[b->rows - 1])
            return "the rows that pad the last block of eight do not repeat the last particle";
    return NULL;
}

/* Checks block g of eight rows of b (the bonds of eight particles), for blocks that use a stencil (columns that many
 * blocks share) and store no columns of their own. Returns a constant text that names the first fault; NULL if there is
 * none. */
static const char *implicit_fault(const struct bonds *b, int64_t g)
{
    if (!b->stencil[g]) return "a block of eight rows has neither stored bonds nor a stencil";
    if (b->stencil[g]->columns != b->column_count[g])
        return "a block of eight rows and its stencil have different numbers of columns";
    for (int l = 0; l < LANES && b->broken; l++)
        if (b->broken[g * LANES + l] > 0) return "a block of eight rows that follows a stencil has a broken bond";
    return NULL;
}

/* Checks that the common properties of a stored column (the k-th bonds of eight rows), b->common[column], agree with
 * each of its eight bonds. Returns a constant text that names the first fault; NULL if there is none. */
static const char *column_fault(const struct bonds *b, int64_t column)
{
    const struct bond_column *common = &b->common[column];
    if (common->first != b->first[column])
        return "the first neighbour of a column of eight bonds differs from the value stored for the column";
    for (int l = 0; l < LANES; l++) {
        const int64_t q = column * LANES + l;
        const bool there = b->inverse_length[q] != 0, intact = b->w[q] != 0;
        if (intact && !(b->inverse_length[q] > 0))
            return "a bond with a weight other than 0, thus intact, has no length";
        if (intact != (common->intact >> l & 1))
            return "a bond is marked as intact but has weight 0, or is not marked and has another weight";
        if (there && b->first[column] >= 0 && b->nbr[q] != b->first[column] + l)
            return "neighbours are not consecutive";
    }
    return NULL;
}

/* Checks that no intact bond of row `row` (bonds of one particle) leads to a particle whose row is more than b->reach
 * blocks of eight rows away. Returns a constant text that names the fault; NULL if there is none. */
static const char *reach_fault(const struct bonds *b, int64_t row)
{
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const int64_t to = b->row_of[it.bond.nbr];
        const int64_t away = to < 0 ? 0 : to / LANES - row / LANES;
        if (it.bond.w != 0 && (away > b->reach || -away > b->reach))
            return "a bond joins rows that are more blocks of eight rows apart than allowed";
    }
    return NULL;
}

const char *bonds_describe_first_inconsistency(const struct bonds *b)
{
    const char *fault = rows_fault(b);
    for (int64_t g = 0; g < b->row_blocks && !fault; g++) {
        if (b->implicit[g]) {
            fault = implicit_fault(b, g);
            continue;
        }
        for (int64_t k = b->column[g]; k < b->column[g] + b->column_count[g] && !fault; k++)
            if (!b->stencil[g]) fault = column_fault(b, k);
    }
    for (int64_t row = 0; row < b->rows && !fault; row++) fault = reach_fault(b, row);
    return fault;
}
