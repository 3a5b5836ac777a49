/* What the files bonds*.c share: one row of bonds while it is made. */
#ifndef CLEAVE_BONDS_PARTS
#define CLEAVE_BONDS_PARTS

#include "bonds/bonds.h"
#include "bonds/sites.h"

struct row {
    int n;
    int32_t *nbr;
    real *inverse_length;
    real *w;
    struct bond_plasticity *plastic;
    real trigger, family_volume, cut_volume;
};

/* Micro-moduli of all pairs of materials over that of material 0. */
struct pair_table {
    real *ratio;
    int materials;
};

/* Room for a row of `room` bonds. */
void row_room_make(struct row *row, int room);
void row_room_free(struct row *row);

/* The same, by the map of sites (NULL: none) where it can tell. */
int family_of(const struct site_map *l, const struct bond_source *s, const struct particles *p, int32_t i,
              int32_t *found, int room);

/* What rows are made of. `fresh`: particles whose neighbours may differ from those in `old`. */
struct row_maker {
    struct bonds *old; /* NULL: none before */
    const struct bond_source *source;
    const struct particles *p;
    const struct pair_table *pairs;
    const uint8_t *fresh;       /* [n] */
    const struct site_map *map; /* `at` NULL: particles do not stand on one */
    int room;                   /* bonds a row may have */
};

/* True if the row of a particle is unchanged: it held its whole family before, or its neighbours are the same. */
static inline bool row_lasts(const struct row_maker *m, int64_t i)
{
    const int64_t before = m->old ? m->old->row_of[i] : -1;
    return before >= 0 && ((m->old->whole[before] && m->p->kind[i] == KIND_PD) || !m->fresh[i]);
}

/* The neighbours of particle i; then their lengths and weights, and what load has done to the bonds it held. */
void row_find(struct row *row, const struct row_maker *m, int32_t i);
void row_finish(struct row *row, const struct row_maker *m, int32_t i);

/* The row block of old rows that row block g is, as it was, -1: it has changed (bonds_keep.c). */
int64_t row_block_kept(const struct bonds *b, const struct row_maker *m, int64_t g);
void row_block_keep(struct bonds *b, const struct bonds *old, int64_t g, int64_t from);
/* Neighbours found for the rows of a row block, kept from one pass to the next. */
struct row_block_found {
    real family_volume[LANES];
    int32_t n[LANES], nbr[];
};
struct row_block_found *row_block_found_make(const struct row *row, int rows);
void row_block_found_take(const struct row_block_found *found, struct row *row, int rows);

/* Where each row block is stored, and the arrays: old row block kept[g], -1: made anew, stays where it is if there is
 * room for the others. Then old rows leave what the new ones have taken over (bonds_columns.c). */
void columns_place(struct bonds *b, const struct row_maker *m, const int64_t *kept);
void columns_leave(struct bonds *old, const struct bonds *b);

/* Can a crack or a void cut any bond of particle i? */
bool cuts_near(const struct bond_source *s, const struct particles *p, int64_t i);
/* No bond of these materials breaks below this stretch. */
real row_trigger(const struct bond_source *s, const struct particles *p, int32_t i, int32_t j);
/* Is one index distance to a column (a lattice) worth its padding? Else the rows are simply packed. */
static inline bool columns_by_offset(int offsets, int longest) { return offsets <= longest + longest / 3; }

/* Families of eight consecutive particles: lanes `from` to `to` have a neighbour at this index distance; distances
 * ascend. `full`: every lane has one at every distance. `bonds`: bit l is set where lane l has a bond to it, one end
 * of which is peridynamic (row_block_regular). */
struct regular_bonds {
    int n;
    bool full;
    int32_t *offset;
    uint8_t *from, *to, *bonds;
    struct stencil_cache *stencil_cache;
};
void regular_bonds_make(struct regular_bonds *to, const struct site_map *l);
void regular_bonds_free(struct regular_bonds *to);
/* The bonds of particles i .. i + 7, if a neighbour exists at each distance; else false: they are to be searched. */
bool regular_bonds(const struct site_map *l, const struct particles *p, int64_t i, struct regular_bonds *to);
/* A thread's memory of such (bonds_stencil_cache.c). */
struct stencil_cache *stencil_cache_make(const struct site_map *l);
void stencil_cache_free(struct stencil_cache *t);
/* First particle of an earlier row block with bitwise equal bonds to those of i .. i + 7: lengths, weights and their
 * sums, if none is cut. -1: none, and this row block is stored. `weights`: what these follow from beside
 * the sites (NULL: nothing). */
int64_t stencil_cache_find_row(const struct regular_bonds *b, const struct bond_source *weights, int64_t i);
/* 1/length and weight of the bonds from particles i .. i + 7 to j .. j + 7, none of them cut. */
void regular_weigh(const struct bond_source *s, const struct particles *p, const struct pair_table *pairs, int64_t i,
                   int64_t j, real *inverse, real *w);

/* Can the map of sites tell the bonds of particles i .. i + 7, none of them cut? Then `to` has them. */
bool row_block_regular(const struct site_map *map, const struct bond_source *s, const struct particles *p, int64_t i,
                       struct regular_bonds *to);
int row_block_regular_columns(const struct regular_bonds *bonds);
int row_block_regular_bonds(const struct regular_bonds *bonds);
struct pair_table pairs_make(const struct bond_source *s);
static inline int row_block_rows(const struct bonds *b, int64_t g) { return eight_at(g * LANES, b->rows); }

/* A thread's room for the eight rows of a row block. */
struct row_block_room {
    struct regular_bonds regular; /* without a search */
    int room;                     /* bonds a row may have */
    struct row row[LANES];
    int32_t *offset;              /* [LANES room] distinct index distances */
    struct column_copy *column;   /* [LANES room] of a row block */
    struct stencil stencil;       /* what they make */
    const struct stencil *likely; /* that of the row block before */
    int32_t reach;                /* farthest index distance so far */
};
void row_block_room_make(struct row_block_room *g, int room, const struct site_map *map);
void row_block_room_free(struct row_block_room *g);
/* Columns the row block needs, by index distance or simply packed; then fills them, and notes what is known of its
 * rows. */
int row_block_columns(struct row_block_room *g, const int32_t *particle, int rows, bool *by_offset);
void row_block_fill(struct bonds *b, struct row_block_room *room, int64_t g, int rows, bool by_offset,
                    const struct particles *p);
/* The same of whole rows on a lattice. */
void row_block_fill_regular(struct bonds *b, struct row_block_room *room, int64_t g, const struct row_maker *m);
/* After either of them: the row block follows the stencil that the columns in its room make, or stores them. */
void row_block_store(struct bonds *b, struct row_block_room *room, int64_t g, const struct particles *p);

/* Makes b->shell_length. */
void shell_lengths(struct bonds *b, real spacing);
/* Which of the lattice's lengths eight bonds have, up to the round-off of positions, which goes to `excess`; 0:
 * none. */
int shell_of(const struct bonds *b, const real *inverse, int16_t *excess);

/* Stencils (bonds_stencils.c): new ones, or those of rows made before. */
struct stencils *stencils_make(struct stencils *of);
void stencils_free(struct stencils *p);
void stencil_make(struct stencil *p, int columns);
void stencil_free(struct stencil *p);
/* One column more, of a row block that begins with particle i; those of its bonds without w and inverse length are
 * none. False: its neighbours are not in a row, or bonds differ in length, or are cut. */
bool stencil_add(struct stencil *to, const struct bonds *b, const struct particles *p, int64_t i,
                 const struct column_copy *from);
/* The one among all that is equal, the likely one first; NULL: there are too many to take it in. */
const struct stencil *stencil_find(struct stencils *all, const struct stencil *stencil, const struct stencil *likely);
/* Group g follows what its twin follows, the row block of particle `twin`, -1: it has none. False: nothing is
 * followed. */
bool row_block_follow(struct bonds *b, int64_t g, int64_t cached);
/* Into memory. */
void column_write(const struct bonds *b, int64_t column, const struct column_copy *from);

/* What state-based models keep: before rows are filled; then the rest, after the rows and their `whole`
 * (bonds_state.c). */
void state_start(struct bonds *b, const struct bond_source *s);
void state_make(struct bonds *b, const struct particles *p, const struct bond_source *s);
void state_free(struct bonds *b);

/* Bonds to images in clamped planes, once all rows are made (bonds_clamped.c). */
void clamped_make(struct bonds *b, const struct particles *p, const struct bond_source *s);
void clamped_free(struct bonds *b);

#endif
