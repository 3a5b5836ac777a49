/* floor 2: reading the eight bonds of a slot, in as few bytes as they allow. All kinds give the same bits. */
#ifndef CLEAVE_BOND_SLOT_H
#define CLEAVE_BOND_SLOT_H

#include "bonds/bonds.h"
#include "kernels/simd/lanes.h"

enum { SLOTS_AHEAD = 40 };               /* asked from memory before they are needed: about 200 ns */

/* What a slot's bonds share: nothing; neighbours in a row, with lengths of the lattice; their weight too; all but the weight with
 * other groups; all with other groups; and that weight is one, as it is inside a body. */
enum slot_kind { SLOT_FREE, SLOT_LATTICE, SLOT_ALIKE, SLOT_PATTERN, SLOT_WHOLE, SLOT_UNIT };

/* Eight bonds, entries number LANES on of what bonds store. Its kind is a constant wherever it is visited. */
struct slot {
    const struct bonds *b;
    int64_t number;
    int64_t first;                       /* neighbour of lane 0; SLOT_FREE: maybe < 0 */
    const struct pattern_slot *pattern;  /* of SLOT_PATTERN and on                    */
    const real *w;                       /* of SLOT_PATTERN: of the lanes             */
    enum slot_kind kind;
};

/* Asks memory for what will be visited soon. */
static ALWAYS_INLINE struct slot slot_stored(const struct bonds *b, int64_t number, const enum slot_kind kind)
{
    const int64_t q = (number + SLOTS_AHEAD) * LANES;
    __builtin_prefetch(b->common + number + SLOTS_AHEAD);
    if (kind == SLOT_FREE) __builtin_prefetch(b->inverse_length + q), __builtin_prefetch(b->nbr + q);
    if (kind != SLOT_ALIKE) __builtin_prefetch(b->w + q);
    return (struct slot){b, number, b->common[number].first, NULL, NULL, kind};
}

/* Slot k of a group that follows a pattern and begins with particle `own`; slot `number` of all. */
static ALWAYS_INLINE struct slot slot_of(const struct bonds *b, int64_t number, const struct pattern *pattern, int64_t k,
                                         int64_t own, const enum slot_kind kind)
{
    const struct pattern_slot *slot = pattern->slot + k;
    return (struct slot){b, number, own + slot->offset, slot, kind >= SLOT_WHOLE ? NULL : pattern->w[k], kind};
}

/* Calls VISIT(slot) for the slots of a group that have an intact bond: one body, an instance for each kind. */
#define FOR_SLOTS(B, GROUP, VISIT)                                                                                             \
    do {                                                                                                                       \
        const struct pattern *pattern_ = (B)->pattern[GROUP];                                                                  \
        const int64_t from_ = (B)->slot[GROUP], slots_ = (B)->slot_count[GROUP], own_ = (B)->particle[(GROUP) * LANES];        \
        if (!pattern_)                                                                                                         \
            for (int64_t k_ = from_; k_ < from_ + slots_; k_++)                                                                \
                if ((B)->common[k_].intact == 0) continue;                                                                     \
                else if ((B)->common[k_].alike) VISIT(slot_stored(B, k_, SLOT_ALIKE));                                         \
                else if ((B)->common[k_].lattice) VISIT(slot_stored(B, k_, SLOT_LATTICE));                                     \
                else VISIT(slot_stored(B, k_, SLOT_FREE));                                                                     \
        else if (pattern_->unit)                                                                                               \
            for (int64_t k_ = 0; k_ < slots_; k_++) VISIT(slot_of(B, from_ + k_, pattern_, k_, own_, SLOT_UNIT));              \
        else if (pattern_->whole)                                                                                              \
            for (int64_t k_ = 0; k_ < slots_; k_++) VISIT(slot_of(B, from_ + k_, pattern_, k_, own_, SLOT_WHOLE));             \
        else                                                                                                                   \
            for (int64_t k_ = 0; k_ < slots_; k_++) VISIT(slot_of(B, from_ + k_, pattern_, k_, own_, SLOT_PATTERN));           \
    } while (0)

/* Of the neighbours. */
static ALWAYS_INLINE lanes slot_at(const struct slot s, const real *from)
{
    return s.kind ? lanes_load(from + s.first) : lanes_at(from, (int32_t)s.first, s.b->nbr + s.number * LANES);
}

/* Component d of X_j - X_i, with X of the rows [m]. */
static ALWAYS_INLINE lanes slot_reference(const struct slot s, const struct particles *p, int d, lanes X)
{
    return s.pattern ? lanes_of(s.pattern->xi[d]) : slot_at(s, p->X[d]) - X;
}

/* The same, by weight [m]. */
static ALWAYS_INLINE lanes slot_weighted_reference(const struct slot s, int d, lanes w, lanes xi)
{
    return s.kind == SLOT_WHOLE ? lanes_of(s.pattern->w_xi[d]) : s.kind == SLOT_UNIT ? xi : w * xi;
}

/* 1/|X_j - X_i| [1/m]; of broken bonds maybe the negative of it. */
static ALWAYS_INLINE lanes slot_inverse_length(const struct slot s)
{
    if (s.pattern) return lanes_of(s.pattern->inverse_length);
    const struct bond_slot *c = &s.b->common[s.number];
    return s.kind ? lanes_excess(s.b->lattice[c->lattice].inverse, c->excess) : lanes_load(s.b->inverse_length + s.number * LANES);
}

/* Lanes with an intact bond. */
static ALWAYS_INLINE uint8_t slot_intact(const struct slot s)
{
    return s.pattern ? s.pattern->intact : s.b->common[s.number].intact;
}

static ALWAYS_INLINE lanes slot_weight(const struct slot s)
{
    if (s.kind == SLOT_UNIT) return lanes_of(1);
    if (s.kind == SLOT_WHOLE) return lanes_of(s.pattern->w);
    if (s.kind == SLOT_PATTERN) return lanes_load(s.w);
    const struct bond_slot *c = &s.b->common[s.number];
    return s.kind == SLOT_ALIKE ? lanes_keep(c->intact, lanes_of(c->w)) : lanes_load(s.b->w + s.number * LANES);
}

/* Stretch |y|/|xi| - 1, of broken bonds maybe -|y|/|xi| - 1: rounded to a multiple of 2^-49 by passing between 8 and 16, so
 * that it is 0 to the last bit where nothing has moved. Round-off there is below half of that, 8 units of 2^-53: 3.5 for the stored
 * inverse (three squares, root, division), 1.5 for three squares, 2.1 for the root and 2 for products, if all of them were
 * at their worst, and on one side, in one bond. Such a bond would pull, and its rows would not rest (rest.h). Far below what
 * the last bit of a position makes, 1e-14 in a body of 100 spacings. */
#define STRETCH_OF(LENGTH, INVERSE_LENGTH) (((LENGTH) * (INVERSE_LENGTH) + 8.0) - 9.0)

/* a, or of intact bonds what is larger. Where lengths are read as stored those of broken ones are negative and tell by
 * themselves. */
static ALWAYS_INLINE lanes slot_largest(const struct slot s, lanes a, lanes other)
{
    return s.kind == SLOT_FREE || s.kind >= SLOT_WHOLE ? lanes_max(a, other) : lanes_max_kept(slot_intact(s), a, other);
}

/* Rows of a group: f = new share + f (1 - share) */
static ALWAYS_INLINE void rows_store(real *f, const int32_t *row, int rows, bool aligned, lanes value, real share)
{
    if (aligned && share == 1) lanes_store(f + row[0], value);
    else for (int l = 0; l < rows; l++) f[row[l]] = share * value[l] + (share == 1 ? 0 : (1 - share) * f[row[l]]);
}

#endif
