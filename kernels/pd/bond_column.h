/* Reading the eight bonds of a column, in as few bytes as they allow. All kinds give the same bits. */
#ifndef CLEAVE_KERNELS_BOND_COLUMN
#define CLEAVE_KERNELS_BOND_COLUMN

#include "bonds/bonds.h"
#include "kernels/simd/lanes.h"

enum { COLUMNS_AHEAD = 40 }; /* prefetched this far ahead: about 200 ns                */

/* What a column's bonds share: nothing; neighbours in a row, with lengths of the lattice; their weight too; all but
 * the weight with other row blocks; all with other row blocks; and that weight is one, as it is inside a body: 5 to 7 %
 * less time for forces, energy and stress of bonds in the plane. Table in bonds/bond_storage.h. */
enum column_kind { COLUMN_FREE, COLUMN_SHELL, COLUMN_ALIKE, COLUMN_STENCIL, COLUMN_WHOLE, COLUMN_UNIT };

/* Eight bonds, entries number LANES on of what bonds store. Its kind is a constant wherever it is visited. */
struct column {
    const struct bonds *b;
    int64_t number;
    int64_t first;                        /* neighbour of lane 0; COLUMN_FREE: maybe < 0 */
    const struct stencil_column *stencil; /* of COLUMN_STENCIL and on */
    const real *w;                        /* of COLUMN_STENCIL: of the lanes */
    enum column_kind kind;
};

/* A stored column; prefetches the columns COLUMNS_AHEAD further on. */
static ALWAYS_INLINE struct column column_stored(const struct bonds *b, int64_t number, const enum column_kind kind)
{
    const int64_t q = (number + COLUMNS_AHEAD) * LANES;
    __builtin_prefetch(b->common + number + COLUMNS_AHEAD);
    if (kind == COLUMN_FREE) __builtin_prefetch(b->inverse_length + q), __builtin_prefetch(b->nbr + q);
    if (kind != COLUMN_ALIKE) __builtin_prefetch(b->w + q);
    return (struct column){b, number, b->common[number].first, NULL, NULL, kind};
}

/* Column k of a row block that follows a stencil and begins with particle `own`; column `number` of all. */
static ALWAYS_INLINE struct column column_of(const struct bonds *b, int64_t number, const struct stencil *stencil,
                                             int64_t k, int64_t own, const enum column_kind kind)
{
    const struct stencil_column *column = stencil->column + k;
    return (struct column){b, number, own + column->offset, column, kind >= COLUMN_WHOLE ? NULL : stencil->w[k], kind};
}

/* Calls VISIT(column) for the columns of a row block that have an intact bond: one body, an instance for each kind. */
#define FOR_COLUMNS(B, ROW_BLOCK, VISIT)                                                                               \
    do {                                                                                                               \
        const struct stencil *stencil_ = (B)->stencil[ROW_BLOCK];                                                      \
        const int64_t from_ = (B)->column[ROW_BLOCK], columns_ = (B)->column_count[ROW_BLOCK];                         \
        const int64_t own_ = (B)->particle[(ROW_BLOCK)*LANES];                                                         \
        if (!stencil_)                                                                                                 \
            for (int64_t k_ = from_; k_ < from_ + columns_; k_++)                                                      \
                if ((B)->common[k_].intact == 0)                                                                       \
                    continue;                                                                                          \
                else if ((B)->common[k_].alike)                                                                        \
                    VISIT(column_stored(B, k_, COLUMN_ALIKE));                                                         \
                else if ((B)->common[k_].shell)                                                                        \
                    VISIT(column_stored(B, k_, COLUMN_SHELL));                                                         \
                else                                                                                                   \
                    VISIT(column_stored(B, k_, COLUMN_FREE));                                                          \
        else if (stencil_->unit)                                                                                       \
            for (int64_t k_ = 0; k_ < columns_; k_++)                                                                  \
                VISIT(column_of(B, from_ + k_, stencil_, k_, own_, COLUMN_UNIT));                                      \
        else if (stencil_->whole)                                                                                      \
            for (int64_t k_ = 0; k_ < columns_; k_++)                                                                  \
                VISIT(column_of(B, from_ + k_, stencil_, k_, own_, COLUMN_WHOLE));                                     \
        else                                                                                                           \
            for (int64_t k_ = 0; k_ < columns_; k_++)                                                                  \
                VISIT(column_of(B, from_ + k_, stencil_, k_, own_, COLUMN_STENCIL));                                   \
    } while (0)

/* Values of `from` at the eight neighbours. */
static ALWAYS_INLINE lanes column_at(const struct column s, const real *from)
{
    return s.kind ? lanes_load(from + s.first) : lanes_at(from, (int32_t)s.first, s.b->nbr + s.number * LANES);
}

/* Component d of X_j - X_i, with X of the rows [m]. */
static ALWAYS_INLINE lanes column_reference(const struct column s, const struct particles *p, int d, lanes X)
{
    return s.stencil ? lanes_of(s.stencil->xi[d]) : column_at(s, p->X[d]) - X;
}

/* The same, by weight [m]. */
static ALWAYS_INLINE lanes column_weighted_reference(const struct column s, int d, lanes w, lanes xi)
{
    return s.kind == COLUMN_WHOLE ? lanes_of(s.stencil->w_xi[d]) : s.kind == COLUMN_UNIT ? xi : w * xi;
}

/* 1/|X_j - X_i| [1/m]; of broken bonds maybe the negative of it. */
static ALWAYS_INLINE lanes column_inverse_length(const struct column s)
{
    if (s.stencil) return lanes_of(s.stencil->inverse_length);
    const struct bond_column *c = &s.b->common[s.number];
    return s.kind ? lanes_excess(s.b->shell_length[c->shell].inverse, c->excess)
                  : lanes_load(s.b->inverse_length + s.number * LANES);
}

/* Lanes with an intact bond. */
static ALWAYS_INLINE uint8_t column_intact(const struct column s)
{
    return s.stencil ? s.stencil->intact : s.b->common[s.number].intact;
}

static ALWAYS_INLINE lanes column_weight(const struct column s)
{
    if (s.kind == COLUMN_UNIT) return lanes_of(1);
    if (s.kind == COLUMN_WHOLE) return lanes_of(s.stencil->w);
    if (s.kind == COLUMN_STENCIL) return lanes_load(s.w);
    const struct bond_column *c = &s.b->common[s.number];
    return s.kind == COLUMN_ALIKE ? lanes_keep(c->intact, lanes_of(c->w)) : lanes_load(s.b->w + s.number * LANES);
}

/* Stretch |y|/|xi| - 1, of broken bonds maybe -|y|/|xi| - 1: rounded to a multiple of 2^-49 by passing between 8 and
 * 16, so that it is 0 to the last bit where nothing has moved. Round-off there is below half of that, 8 units of
 * 2^-53: 3.5 for the stored inverse (three squares, root, division), 1.5 for three squares, 2.1 for the root and 2
 * for products, if all of them were at their worst, and on one side, in one bond. Such a bond would pull, and its
 * rows would not rest (active_set.h). Far below what the last bit of a position makes, 1e-14 in a body of 100
 * spacings. */
#define STRETCH_OF(LENGTH, INVERSE_LENGTH) (((LENGTH) * (INVERSE_LENGTH) + 8.0) - 9.0)

/* a, or of intact bonds what is larger. Where lengths are read as stored those of broken ones are negative and tell by
 * themselves. */
static ALWAYS_INLINE lanes column_largest(const struct column s, lanes a, lanes other)
{
    return s.kind == COLUMN_FREE || s.kind >= COLUMN_WHOLE ? lanes_max(a, other)
                                                           : lanes_max_kept(column_intact(s), a, other);
}

/* a, or of intact bonds what is smaller. */
static ALWAYS_INLINE lanes column_smallest(const struct column s, lanes a, lanes other)
{
    return s.kind >= COLUMN_WHOLE ? lanes_min(a, other) : lanes_min_kept(column_intact(s), a, other);
}

/* Values of a row block's particles. */
static ALWAYS_INLINE void rows_store(real *to, const int32_t *row, int rows, bool aligned, lanes value)
{
    if (aligned)
        lanes_store(to + row[0], value);
    else
        for (int l = 0; l < rows; l++) to[row[l]] = value[l];
}

#endif
