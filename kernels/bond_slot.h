/* floor 2: reading the eight bonds of a slot, in as few bytes as they allow. All kinds give the same bits. */
#ifndef CLEAVE_BOND_SLOT_H
#define CLEAVE_BOND_SLOT_H

#include "bonds.h"
#include "lanes.h"

enum { SLOTS_AHEAD = 40 };               /* asked from memory before they are needed: about 200 ns */

/* What a slot's bonds share: nothing; neighbours in a row, with lengths of the lattice; their weight too. */
enum slot_kind { SLOT_FREE, SLOT_LATTICE, SLOT_ALIKE };

/* Calls VISIT(slot, kind), the kind a constant, for the slots of a group: one body, three instances. */
#define FOR_SLOTS(B, GROUP, SLOT, VISIT)                                                              \
    for (int64_t SLOT = (B)->slot[GROUP]; SLOT < (B)->slot[(GROUP) + 1]; SLOT++)                      \
        if ((B)->common[SLOT].alike) VISIT(SLOT, SLOT_ALIKE);                                         \
        else if ((B)->common[SLOT].lattice) VISIT(SLOT, SLOT_LATTICE);                                \
        else VISIT(SLOT, SLOT_FREE)

static ALWAYS_INLINE void slot_ask(const struct bonds *b, int64_t slot, const enum slot_kind kind)
{
    const int64_t q = (slot + SLOTS_AHEAD) * LANES;
    __builtin_prefetch(b->common + slot + SLOTS_AHEAD);
    if (kind == SLOT_FREE) __builtin_prefetch(b->inverse_length + q), __builtin_prefetch(b->nbr + q);
    if (kind != SLOT_ALIKE) __builtin_prefetch(b->w + q);
}

/* Of the neighbours. */
static ALWAYS_INLINE lanes slot_at(const struct bonds *b, int64_t slot, const enum slot_kind kind, const real *from)
{
    const int32_t first = b->common[slot].first;
    return kind ? lanes_load(from + first) : lanes_at(from, first, b->nbr + slot * LANES);
}

/* 1/|X_j - X_i| [1/m]; of broken bonds maybe the negative of it. */
static ALWAYS_INLINE lanes slot_inverse_length(const struct bonds *b, int64_t slot, const enum slot_kind kind)
{
    const struct bond_slot *c = &b->common[slot];
    return kind ? lanes_excess(b->lattice[c->lattice].inverse, c->excess) : lanes_load(b->inverse_length + slot * LANES);
}

static ALWAYS_INLINE lanes slot_weight(const struct bonds *b, int64_t slot, const enum slot_kind kind)
{
    const struct bond_slot *c = &b->common[slot];
    return kind == SLOT_ALIKE ? lanes_keep(c->intact, lanes_of(c->w)) : lanes_load(b->w + slot * LANES);
}

/* Stretch |y|/|xi| - 1, of broken bonds maybe -|y|/|xi| - 1: rounded to a multiple of 2^-49 by passing between 8 and 16, so
 * that it is 0 to the last bit where nothing has moved. Round-off there is below half of that, 8 units of 2^-53: 3.5 for the stored
 * inverse (three squares, root, division), 1.5 for three squares, 2.1 for the root and 2 for products, if all of them were
 * at their worst, and on one side, in one bond. Such a bond would pull, and its rows would not rest (rest.h). Far below what
 * the last bit of a position makes, 1e-14 in a body of 100 spacings. */
#define STRETCH_OF(LENGTH, INVERSE_LENGTH) (((LENGTH) * (INVERSE_LENGTH) + 8.0) - 9.0)

/* a, or of intact bonds what is larger. Where lengths are read as stored those of broken ones are negative and tell by
 * themselves. */
static ALWAYS_INLINE lanes slot_largest(const struct bonds *b, int64_t slot, const enum slot_kind kind, lanes a, lanes other)
{
    return kind ? lanes_max_kept(b->common[slot].intact, a, other) : lanes_max(a, other);
}

/* Rows of a group: f = new share + f (1 - share) */
static ALWAYS_INLINE void rows_store(real *f, const int32_t *row, int rows, bool aligned, lanes value, real share)
{
    if (aligned && share == 1) lanes_store(f + row[0], value);
    else for (int l = 0; l < rows; l++) f[row[l]] = share * value[l] + (share == 1 ? 0 : (1 - share) * f[row[l]]);
}

#endif
