/* Access to the eight bonds of a column of a block of eight rows: one bond of each of eight particles. Bonds of a
 * lattice have data in common; each kind of column reads as few bytes as its bonds allow, and all kinds give equal
 * bits. In files that define ROWS_IN_PARTS (lanes.h) a view of a column and the vectors of the functions below have
 * only the WIDE bonds of a part of these rows. */
#ifndef CLEAVE_KERNELS_BOND_COLUMN
#define CLEAVE_KERNELS_BOND_COLUMN

#include "bonds/bonds.h"
#include "kernels/simd/lanes.h"

enum { COLUMNS_AHEAD = 40 }; /* prefetch distance in columns: about 200 ns ahead */

/* Kinds of columns, by what their eight bonds have in common (table in bonds/bond_storage.h). FREE: nothing. SHELL:
 * consecutive neighbours, and lengths of one lattice shell. ALIKE: as SHELL, and one weight. STENCIL: all data but the
 * weights equal those of other blocks of eight rows. WHOLE: as STENCIL, weights included. UNIT: as WHOLE, and all
 * weights are 1, as inside a body; this saves 5 to 7 % of the time of forces, energy and stress of bonds in 2D. */
enum column_kind { COLUMN_FREE, COLUMN_SHELL, COLUMN_ALIKE, COLUMN_STENCIL, COLUMN_WHOLE, COLUMN_UNIT };

/* A view of one column, i.e. of eight bonds that are stored together, one of each of eight particles (a block of eight
 * rows of b). number: index of the column among all columns, so that its bonds have the indices number * LANES + l in
 * the bond arrays, for the particles l = 0 .. 7; kind: what the eight bonds have in common, a compile-time constant
 * wherever a column is used. */
struct bond_column_view {
    const struct bonds *b;
    int64_t number;
    int64_t first; /* particle number of the neighbour of lane 0; COLUMN_FREE: may be < 0 (not consecutive) */
    const struct stencil_column *stencil; /* COLUMN_STENCIL, WHOLE, UNIT only */
    const real *w;                        /* COLUMN_STENCIL: weights of the lanes [1] */
    enum column_kind kind;
    int part; /* first of the WIDE rows of the block whose bonds are in a vector: 0, or a multiple of WIDE */
};

/* Returns a view of the stored column number `column_number` of b (one bond of each of eight particles), and prefetches
 * the column COLUMNS_AHEAD columns behind it. kind: what the eight bonds have in common: nothing (COLUMN_FREE),
 * consecutive neighbours and a tabulated length (SHELL), also one weight (ALIKE). part: as in struct bond_column_view.
 */
static ALWAYS_INLINE struct bond_column_view
bond_column_view_of_stored_bonds(const struct bonds *b, int64_t column_number, const enum column_kind kind, int part)
{
    const int64_t q = (column_number + COLUMNS_AHEAD) * LANES, first = b->common[column_number].first;
    if (part == 0) {
        __builtin_prefetch(b->common + column_number + COLUMNS_AHEAD);
        if (kind == COLUMN_FREE) __builtin_prefetch(b->inverse_length + q), __builtin_prefetch(b->nbr + q);
        if (kind != COLUMN_ALIKE) __builtin_prefetch(b->w + q);
    }
    return (struct bond_column_view){
        b, column_number, kind == COLUMN_FREE && first < 0 ? first : first + part, NULL, NULL, kind, part};
}

/* Returns a view of a column (one bond of each of eight consecutive particles) whose bonds b does not store, but which
 * follow from `stencil`, a bond pattern that many blocks of eight rows of a lattice share. column_in_stencil: number of
 * the column in the stencil; first_particle: first of the eight particles; column_number: index of the column among all
 * columns; kind: what the stencil determines: all but the weights (COLUMN_STENCIL), also the weights (WHOLE), which are
 * 1 (UNIT). part: as in struct bond_column_view. */
static ALWAYS_INLINE struct bond_column_view
bond_column_view_of_stencil_bonds(const struct bonds *b, int64_t column_number, const struct stencil *stencil,
                                  int64_t column_in_stencil, int64_t first_particle, const enum column_kind kind,
                                  int part)
{
    const struct stencil_column *column = stencil->column + column_in_stencil;
    return (struct bond_column_view){b,
                                     column_number,
                                     first_particle + column->offset + part,
                                     column,
                                     kind >= COLUMN_WHOLE ? NULL : stencil->w[column_in_stencil] + part,
                                     kind,
                                     part};
}

/* Calls VISIT(column) for every column with an intact bond of the block of eight rows of the bonds B that contains the
 * WIDE rows from FIRST_ROW, a multiple of WIDE, on: `column` views the bonds of these rows. A block stores the bonds of
 * eight particles, a column one bond of each. The call is compiled once for each kind of column, with the kind as a
 * constant. */
#define FOR_COLUMNS(B, FIRST_ROW, VISIT)                                                                               \
    do {                                                                                                               \
        const int64_t block_ = (FIRST_ROW) / LANES;                                                                    \
        const int part_ = (int)WIDE == (int)LANES ? 0 : (int)((FIRST_ROW) % LANES);                                    \
        const struct stencil *stencil_ = (B)->stencil[block_];                                                         \
        const int64_t from_ = (B)->column[block_], columns_ = (B)->column_count[block_];                               \
        const int64_t own_ = (B)->particle[block_ * LANES];                                                            \
        if (!stencil_)                                                                                                 \
            for (int64_t k_ = from_; k_ < from_ + columns_; k_++)                                                      \
                if ((B)->common[k_].intact == 0)                                                                       \
                    continue;                                                                                          \
                else if ((B)->common[k_].alike)                                                                        \
                    VISIT(bond_column_view_of_stored_bonds(B, k_, COLUMN_ALIKE, part_));                               \
                else if ((B)->common[k_].shell)                                                                        \
                    VISIT(bond_column_view_of_stored_bonds(B, k_, COLUMN_SHELL, part_));                               \
                else                                                                                                   \
                    VISIT(bond_column_view_of_stored_bonds(B, k_, COLUMN_FREE, part_));                                \
        else if (stencil_->unit)                                                                                       \
            for (int64_t k_ = 0; k_ < columns_; k_++)                                                                  \
                VISIT(bond_column_view_of_stencil_bonds(B, from_ + k_, stencil_, k_, own_, COLUMN_UNIT, part_));       \
        else if (stencil_->whole)                                                                                      \
            for (int64_t k_ = 0; k_ < columns_; k_++)                                                                  \
                VISIT(bond_column_view_of_stencil_bonds(B, from_ + k_, stencil_, k_, own_, COLUMN_WHOLE, part_));      \
        else                                                                                                           \
            for (int64_t k_ = 0; k_ < columns_; k_++)                                                                  \
                VISIT(bond_column_view_of_stencil_bonds(B, from_ + k_, stencil_, k_, own_, COLUMN_STENCIL, part_));    \
    } while (0)

/* Calls VISIT(column) for the columns of WIDE rows from FIRST_ROW on as FOR_COLUMNS does, or VISIT_BRITTLE(column) if
 * MODEL is PD_BOND_SOFT and no bond of their block of eight rows has begun to soften. */
#define FOR_COLUMNS_BY_LAW(B, FIRST_ROW, MODEL, VISIT, VISIT_BRITTLE)                                                  \
    do {                                                                                                               \
        if ((MODEL) != PD_BOND_SOFT || bond_row_block_has_begun_softening(B, (FIRST_ROW) / LANES))                     \
            FOR_COLUMNS(B, FIRST_ROW, VISIT);                                                                          \
        else                                                                                                           \
            FOR_COLUMNS(B, FIRST_ROW, VISIT_BRITTLE);                                                                  \
    } while (0)

/* Returns the index in the bond arrays of the first bond of `column` in a vector. */
static ALWAYS_INLINE int64_t bond_column_first_bond(const struct bond_column_view column)
{
    return column.number * LANES + column.part;
}

/* Returns the values from[j] of the eight particles j to which the bonds of `column` (one bond of each of eight
 * particles) lead, one per lane. from: array with a value for each particle and mirror image. Unless the kind of the
 * column is COLUMN_FREE, the indices j are consecutive and the values are loaded as one vector; else they are
 * gathered. */
static ALWAYS_INLINE lanes bond_column_gather_neighbour_values(const struct bond_column_view column, const real *from)
{
    return column.kind
               ? lanes_load(from + column.first)
               : lanes_load_or_gather(from, (int32_t)column.first, column.b->nbr + bond_column_first_bond(column));
}

/* Returns component `axis` of the reference bond vectors X_j - X_i [m] of the eight bonds of `column` (one bond of each
 * of eight particles of p). X: component `axis` of the reference positions X_i of the eight particles to which these
 * bonds belong [m]. */
static ALWAYS_INLINE lanes bond_column_reference_vector_component(const struct bond_column_view column,
                                                                  const struct particles *p, int axis, lanes X)
{
    return column.stencil ? lanes_broadcast(column.stencil->xi[axis])
                          : bond_column_gather_neighbour_values(column, p->X[axis]) - X;
}

/* Returns component `axis` of the reference bond vector times the weight (factor on the force) [m] of each of the eight
 * bonds of `column` (one bond of each of eight particles). w: weights of the bonds [1]; reference_vector: component
 * `axis` of their reference vectors [m]. */
static ALWAYS_INLINE lanes bond_column_weighted_vector_component(const struct bond_column_view column, int axis,
                                                                 lanes w, lanes reference_vector)
{
    return column.kind == COLUMN_WHOLE  ? lanes_broadcast(column.stencil->w_xi[axis])
           : column.kind == COLUMN_UNIT ? reference_vector
                                        : w * reference_vector;
}

/* Returns the inverse reference lengths 1/|X_j - X_i| [1/m] of the eight bonds of `column` (one bond of each of eight
 * particles); negative for some broken bonds. */
static ALWAYS_INLINE lanes bond_column_inverse_lengths(const struct bond_column_view column)
{
    if (column.stencil) return lanes_broadcast(column.stencil->inverse_length);
    const struct bond_column *c = &column.b->common[column.number];
    return column.kind ? lanes_add_ulps(column.b->shell_length[c->shell].inverse, c->excess + column.part)
                       : lanes_load(column.b->inverse_length + bond_column_first_bond(column));
}

/* Returns eight bits: bit l (0 to 7) is set if the bond of particle l in `column` (one bond of each of eight particles)
 * is intact. */
static ALWAYS_INLINE uint8_t bond_column_intact_bits(const struct bond_column_view column)
{
    return (column.stencil ? column.stencil->intact : column.b->common[column.number].intact) >> column.part;
}

/* Returns the weights (factors on the bond forces) [1] of the eight bonds of `column` (one bond of each of eight
 * particles), 0 for broken bonds. */
static ALWAYS_INLINE lanes bond_column_weights(const struct bond_column_view column)
{
    if (column.kind == COLUMN_UNIT) return lanes_broadcast(1);
    if (column.kind == COLUMN_WHOLE) return lanes_broadcast(column.stencil->w);
    if (column.kind == COLUMN_STENCIL) return lanes_load(column.w);
    const struct bond_column *c = &column.b->common[column.number];
    return column.kind == COLUMN_ALIKE
               ? lanes_zero_unless_selected((uint8_t)(c->intact >> column.part), lanes_broadcast(c->w))
               : lanes_load(column.b->w + bond_column_first_bond(column));
}

/* Computes the stretch |y|/|xi| - 1 of a bond from its length |y| and inverse reference length, rounded to a multiple
 * of 2^-49 by passing through the range 8 to 16. Rounding makes the stretch exactly 0 where nothing has moved, so that
 * undeformed bonds have no force and their particles stay at rest (active_set.h). Half of the unit, 8 units of 2^-53,
 * exceeds the largest round-off of one bond: 3.5 units for the stored inverse (three squares, root, division), 1.5 for
 * three squares, 2.1 for the root and 2 for products. Broken bonds may have a negative inverse length, which gives
 * -|y|/|xi| - 1. */
#define STRETCH_OF(LENGTH, INVERSE_LENGTH) (((LENGTH) * (INVERSE_LENGTH) + 8.0) - 9.0)

/* Returns in each lane the larger of a and `other` if the bond of `column` in that lane is intact, else a; a column
 * holds one bond of each of eight particles, one particle per lane. In columns of the kind COLUMN_FREE no mask is
 * needed: their broken bonds have negative lengths, which make `other` smaller than a. */
static ALWAYS_INLINE lanes bond_column_max_where_intact(const struct bond_column_view column, lanes a, lanes other)
{
    return column.kind == COLUMN_FREE || column.kind >= COLUMN_WHOLE
               ? lanes_max(a, other)
               : lanes_max_selected(bond_column_intact_bits(column), a, other);
}

/* Returns in each lane the smaller of a and `other` if the bond of `column` in that lane is intact, else a; a column
 * holds one bond of each of eight particles, one particle per lane. */
static ALWAYS_INLINE lanes bond_column_min_where_intact(const struct bond_column_view column, lanes a, lanes other)
{
    return column.kind >= COLUMN_WHOLE ? lanes_min(a, other)
                                       : lanes_min_selected(bond_column_intact_bits(column), a, other);
}

/* Loads the positions x[dim] [m] of the particles of WIDE rows of b, from row `first` on. p: all particles. */
static ALWAYS_INLINE void bond_rows_load_positions_of_their_particles(const struct bonds *b, const struct particles *p,
                                                                      int64_t first, lanes *x, const int dim)
{
    const int32_t *row = b->particle + first, own = b->aligned[first / LANES] ? row[0] : -1;
    for (int d = 0; d < dim; d++) x[d] = lanes_load_or_gather(p->x[d], own, row);
}

/* Stores `value`, one value for each particle of WIDE rows, in the particle array `to`. row: indices of these
 * particles; rows_left: number of rows from there to the end of all rows, less than WIDE or negative in the last
 * block; aligned: true if the indices are consecutive, so that all values are stored at once. */
static ALWAYS_INLINE void bond_rows_store_values_of_their_particles(real *to, const int32_t *row, int rows_left,
                                                                    bool aligned, lanes value)
{
    if (aligned)
        lanes_store(to + row[0], value);
    else
        for (int l = 0; l < WIDE && l < rows_left; l++) to[row[l]] = value[l];
}

#endif
