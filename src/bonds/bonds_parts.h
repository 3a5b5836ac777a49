/* Shared by the files bonds*.c: one row of bonds under construction, row blocks, columns, stencils. */
#ifndef CLEAVE_BONDS_PARTS
#define CLEAVE_BONDS_PARTS

#include "bonds/bonds.h"
#include "bonds/sites.h"

/* One row of bonds under construction; arrays have room for all neighbours of a particle. */
struct row {
    int n;                /* number of bonds */
    int32_t *nbr;         /* [n] neighbours, ascending */
    real *inverse_length; /* [n] 1/r; negative: broken [1/m] */
    real *w;              /* [n] weights; 0: broken or cut [1] */
    struct bond_plasticity *plastic;
    real trigger;                   /* stretch above which the vector test reports a bond [1] */
    real family_volume, cut_volume; /* volume of the family; of neighbours behind cut or broken bonds [m^3] */
};

/* Micro-moduli of all pairs of materials over that of material 0 [materials^2] [1]. */
struct pair_table {
    real *ratio;
    int materials;
};

/* Allocates a row for `room` bonds. Release with row_room_free. */
void row_room_make(struct row *row, int room);

/* Releases the arrays of a row. */
void row_room_free(struct row *row);

/* Lists the neighbours of particle or image i within the cutoff that no void hides, ascending, by the site map l where
 * possible (NULL: none), else by search. Returns their number; if it exceeds `room`, the list is incomplete. */
int family_of(const struct site_map *l, const struct bond_source *s, const struct particles *p, int32_t i,
              int32_t *found, int room);

/* Inputs for making rows. */
struct row_maker {
    struct bonds *old; /* previous rows; NULL: none */
    const struct bond_source *source;
    const struct particles *p;
    const struct pair_table *pairs;
    const uint8_t *fresh;       /* [n] 1: the neighbours may differ from those in `old` */
    const struct site_map *map; /* `at` NULL: particles are not on a lattice */
    int room;                   /* largest number of bonds of a row */
};

/* Returns true if the row of particle i is unchanged: it already had its whole family, or its neighbours are
 * unchanged. */
static inline bool row_lasts(const struct row_maker *m, int64_t i)
{
    const int64_t before = m->old ? m->old->row_of[i] : -1;
    return before >= 0 && ((m->old->whole[before] && m->p->kind[i] == KIND_PD) || !m->fresh[i]);
}

/* Finds the neighbours of particle i. */
void row_find(struct row *row, const struct row_maker *m, int32_t i);

/* Computes lengths and weights of the bonds to the neighbours found, and carries over the broken and yielded state. */
void row_finish(struct row *row, const struct row_maker *m, int32_t i);

/* Returns the previous row block equal to row block g, -1 if it has changed (bonds_keep.c). */
int64_t row_block_kept(const struct bonds *b, const struct row_maker *m, int64_t g);

/* Copies row block `from` of `old` to row block g. */
void row_block_keep(struct bonds *b, const struct bonds *old, int64_t g, int64_t from);

/* Neighbours found for the rows of a row block, kept between the two passes. */
struct row_block_found {
    real family_volume[LANES]; /* [m^3] */
    int32_t n[LANES], nbr[];   /* number of neighbours of each row; neighbours, row after row */
};

/* Copies the neighbours of rows to a new allocation. Release with memory_free. */
struct row_block_found *row_block_found_make(const struct row *row, int rows);

/* Restores the neighbours of rows from a copy. */
void row_block_found_take(const struct row_block_found *found, struct row *row, int rows);

/* Assigns columns to all row blocks and allocates them. kept: [row blocks] previous row block that is kept in place,
 * -1: row block is rebuilt, in a hole if one is large enough (bonds_columns.c). */
void columns_place(struct bonds *b, const struct row_maker *m, const int64_t *kept);

/* Detaches the arrays that b has taken over from the previous rows. */
void columns_leave(struct bonds *old, const struct bonds *b);

/* Returns true if a crack or a void may cut a bond of particle i. */
bool cuts_near(const struct bond_source *s, const struct particles *p, int64_t i);

/* Returns the stretch above which the vector test reports a bond of these particles: its limit less a tolerance [1]. */
real row_trigger(const struct bond_source *s, const struct particles *p, int32_t i, int32_t j);

/* Returns true if one index distance per column (a lattice) is worth its padding, else rows are packed without gaps. */
static inline bool columns_by_offset(int offsets, int longest) { return offsets <= longest + longest / 3; }

/* Families of eight consecutive particles on a lattice, by index distance in ascending order. */
struct regular_bonds {
    int n;              /* number of index distances */
    bool full;          /* every lane has a neighbour at every distance */
    int32_t *offset;    /* [n] index distances */
    uint8_t *from, *to; /* [n] first and last lane with a neighbour at the distance */
    uint8_t *bonds;     /* [n] bit l: lane l has a bond at the distance: one of both particles is peridynamic */
    struct stencil_cache *stencil_cache;
};

/* Allocates room for the most index distances that the site map can have. Release with regular_bonds_free. */
void regular_bonds_make(struct regular_bonds *to, const struct site_map *l);

/* Releases the arrays. */
void regular_bonds_free(struct regular_bonds *to);

/* Computes the families of particles i .. i + 7 from the site map. Returns false if a search is required. */
bool regular_bonds(const struct site_map *l, const struct particles *p, int64_t i, struct regular_bonds *to);

/* Creates a cache of row blocks for one thread (bonds_stencil_cache.c). Release with stencil_cache_free. */
struct stencil_cache *stencil_cache_make(const struct site_map *l);

/* Releases the cache. */
void stencil_cache_free(struct stencil_cache *t);

/* Returns the first particle of a previous row block whose bonds are bitwise equal to those of i .. i + 7 (lengths,
 * weights and their sums, none cut), or -1; the present row block is then remembered. weights: inputs of the weights
 * beside the sites (NULL: none). */
int64_t stencil_cache_find_row(const struct regular_bonds *b, const struct bond_source *weights, int64_t i);

/* Computes 1/length [1/m] and weight [1] of the bonds from particles i .. i + 7 to j .. j + 7, without cuts. */
void regular_weigh(const struct bond_source *s, const struct particles *p, const struct pair_table *pairs, int64_t i,
                   int64_t j, real *inverse, real *w);

/* Computes the bonds of particles i .. i + 7 from the site map. Returns false if it cannot, e.g. near cracks. */
bool row_block_regular(const struct site_map *map, const struct bond_source *s, const struct particles *p, int64_t i,
                       struct regular_bonds *to);

/* Returns the number of columns that the bonds need. */
int row_block_regular_columns(const struct regular_bonds *bonds);

/* Returns the number of directed bonds. */
int row_block_regular_bonds(const struct regular_bonds *bonds);

/* Returns the micro-moduli of all pairs of materials. Release `ratio` with memory_free. */
struct pair_table pairs_make(const struct bond_source *s);

/* Returns the number of rows in row block g, at most LANES. */
static inline int row_block_rows(const struct bonds *b, int64_t g) { return eight_at(g * LANES, b->rows); }

/* Working memory of one thread for the eight rows of a row block. */
struct row_block_room {
    struct regular_bonds regular; /* bonds found without a search */
    int room;                     /* largest number of bonds of a row */
    struct row row[LANES];
    int32_t *offset;              /* [LANES room] distinct index distances */
    struct column_copy *column;   /* [LANES room] columns of the row block */
    struct stencil stencil;       /* stencil of these columns */
    const struct stencil *likely; /* stencil of the previous row block */
    int32_t reach;                /* largest index distance so far */
};

/* Allocates the working memory. Release with row_block_room_free. */
void row_block_room_make(struct row_block_room *g, int room, const struct site_map *map);

/* Releases the working memory. */
void row_block_room_free(struct row_block_room *g);

/* Returns the number of columns that a row block needs. *by_offset: one index distance per column, else packed rows. */
int row_block_columns(struct row_block_room *g, const int32_t *particle, int rows, bool *by_offset);

/* Fills the columns of row block g from its rows, with their trigger, volumes and alignment. */
void row_block_fill(struct bonds *b, struct row_block_room *room, int64_t g, int rows, bool by_offset,
                    const struct particles *p);

/* Fills row block g from room->regular, without a search: its eight particles are consecutive on one lattice. */
void row_block_fill_regular(struct bonds *b, struct row_block_room *room, int64_t g, const struct row_maker *m);

/* Stores the columns in `room` as row block g, or lets it follow an equal stencil. Called after filling. */
void row_block_store(struct bonds *b, struct row_block_room *room, int64_t g, const struct particles *p);

/* Allocates and fills b->shell_length. */
void shell_lengths(struct bonds *b, real spacing);

/* Returns the shell of the lattice whose length eight bonds have up to the round-off of positions, which is stored in
 * excess[LANES]; 0: none. */
int shell_of(const struct bonds *b, const real *inverse, int16_t *excess);

/* Returns the stencils of previous rows with one more user, or new ones if `of` is NULL (bonds_stencils.c). Release
 * with stencils_free. */
struct stencils *stencils_make(struct stencils *of);

/* Releases the stencils; the last user frees them. */
void stencils_free(struct stencils *p);

/* Allocates a stencil for `columns` columns. Release with stencil_free. */
void stencil_make(struct stencil *p, int columns);

/* Releases the arrays of a stencil. */
void stencil_free(struct stencil *p);

/* Appends a column of a row block that begins with particle i; bonds with w = 0 and inverse_length = 0 do not exist.
 * Returns false if its neighbours are not consecutive, or bonds differ in length or are cut. */
bool stencil_add(struct stencil *to, const struct bonds *b, const struct particles *p, int64_t i,
                 const struct column_copy *from);

/* Returns the stored stencil equal to `stencil`, comparing `likely` first, and stores it if it is new; NULL if the
 * table is full. */
const struct stencil *stencil_find(struct stencils *all, const struct stencil *stencil, const struct stencil *likely);

/* Makes row block g follow the stencil of the row block of particle `cached` (-1: of row block g itself). Returns false
 * if there is no stencil. */
bool row_block_follow(struct bonds *b, int64_t g, int64_t cached);

/* Writes a column to the bond arrays. */
void column_write(const struct bonds *b, int64_t column, const struct column_copy *from);

/* Prepares the state of state-based models before rows are filled (bonds_state.c). */
void state_start(struct bonds *b, const struct bond_source *s);

/* Allocates the remaining state after the rows and `whole` are set. */
void state_make(struct bonds *b, const struct particles *p, const struct bond_source *s);

/* Releases the state. */
void state_free(struct bonds *b);

/* Lists the bonds to images in clamped planes after all rows are made (bonds_clamped.c). */
void clamped_make(struct bonds *b, const struct particles *p, const struct bond_source *s);

/* Releases the lists. */
void clamped_free(struct bonds *b);

#endif
