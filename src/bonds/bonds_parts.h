/* Declarations shared by the files bonds*.c. A row holds all bonds of one particle, a block of eight rows the rows of
 * eight particles. A column of a block holds one bond of each of its eight rows. A stencil is a list of columns that
 * many blocks of a lattice have in common. */
#ifndef CLEAVE_BONDS_PARTS
#define CLEAVE_BONDS_PARTS

#include "bonds/bonds.h"
#include "bonds/sites.h"

/* A row under construction, i.e. all bonds of one particle. The arrays are allocated for the largest possible number of
 * neighbours. */
struct bond_row {
    int n;                /* number of bonds */
    int32_t *nbr;         /* [n] neighbours, ascending */
    real *inverse_length; /* [n] 1/r; negative: broken [1/m] */
    real *w;              /* [n] weights; 0: broken or cut [1] */
    struct bond_plasticity *plastic;
    struct bond_softening_state *soft; /* [n] only where bonds soften */
    real trigger;                      /* stretch above which the vector test reports a bond [1] */
    real family_volume, cut_volume;    /* volume of the neighbourhood; of neighbours behind cut or broken bonds [m^3] */
};

/* Relative micro-moduli of bonds by pair of materials: ratio[a * materials + b] is the micro-modulus of bonds between
 * the materials a and b (numbers from 0), divided by that of bonds within material 0 [1]. */
struct material_pair_table {
    real *ratio;
    int materials;
};

/* Allocates the arrays of `row` (the bonds of one particle under construction) for up to `capacity` bonds. Release with
 * bond_row_buffer_free. */
void bond_row_buffer_make(struct bond_row *row, int capacity);

/* Releases the arrays of `row`, the bonds of one particle under construction. */
void bond_row_buffer_free(struct bond_row *row);

/* Lists in neighbour[capacity] the neighbours within the cutoff of the particle or mirror image (copy beyond a plane of
 * symmetry) number `particle` of p, in ascending order. Particles behind a void (a narrow gap of the body) are left
 * out. source: inputs of the bonds (horizon, materials, cracks, mirrors); map: from lattice sites to particles, used
 * where possible instead of a search; NULL: always search. Returns the number of neighbours; if this number exceeds
 * `capacity`, the list is incomplete. */
int particle_find_neighbours_within_cutoff(const struct lattice_site_map *map, const struct bond_source *source,
                                           const struct particles *p, int32_t particle, int32_t *neighbour,
                                           int capacity);

/* Inputs from which rows (each with all bonds of one particle of p) are made. source: inputs of the bonds; pairs:
 * micro-moduli by pair of materials. All pointers are borrowed. */
struct bond_row_inputs {
    struct bonds *old; /* previous rows; NULL: none */
    const struct bond_source *source;
    const struct particles *p;
    const struct material_pair_table *pairs;
    const uint8_t *fresh;               /* [n] 1: the neighbours may differ from those in `old` */
    const struct lattice_site_map *map; /* `at` NULL: particles are not on a lattice */
    int room;                           /* largest number of bonds of a row */
};

/* Returns the weight (factor on the stiffness, [1]) that an intact bond between the particles `particle` and
 * `other_particle` of p has. source: inputs of the bonds; pairs: micro-moduli by pair of materials. Exchanging the
 * particles changes no bit. */
real bond_weight_of_pair(const struct bond_source *source, const struct particles *p,
                         const struct material_pair_table *pairs, int32_t particle, int32_t other_particle);

/* Allocates the softening data (largest stretch, onset and end of softening) of the bonds b of the particles p. Does
 * nothing if all bonds are brittle. bonds_free releases the data. previous: bonds before a rebuild, whose softening is
 * kept, NULL if there are none; source: inputs of the bonds (horizon, materials, cracks, mirrors). */
void bonds_allocate_softening_state(struct bonds *b, const struct bonds *previous, const struct bond_source *source,
                                    const struct particles *p);

/* Sets the softening state of all bonds in `row`, the bonds of the particle with index `particle`. Bonds that exist in
 * inputs->old, the previous bonds, keep their state; new bonds have not begun to soften. The neighbours row->nbr must
 * be set. */
void bond_row_set_softening_state(struct bond_row *row, const struct bond_row_inputs *inputs, int32_t particle);

/* Returns true if the bond with index `bond` in the arrays of b has ended by softening and presses (closing.h).
 * row_block: block of eight rows (the bonds of eight particles) that contains the bond. */
static inline bool bond_ended_by_softening_transmits_compression(const struct bonds *b, int64_t row_block, int64_t bond)
{
    return bond_row_block_has_begun_softening(b, row_block) && b->soft.settled && !b->soft.whole && b->w[bond] != 0 &&
           !bond_is_softening(b, row_block, bond) && b->soft.settled[bond] > 0;
}

/* Fraction of the least strain on a strength surface [1] from which on the stretch of a bond counts as near the
 * surface: its block of eight rows (bonds of eight particles) is then marked for an exact test (bonds_strength.c). */
#define SURFACE_NEAR 0.8

/* Copies the softening state of the bonds in row `previous_row` of `previous_bonds` to row `row` of b, the row of the
 * same particle. new_index: index in p of each particle and mirror image of `previous_bonds`, -1 if it is not in p;
 * limit: critical stretches and softening by pair of materials. */
void bonds_copy_softening_state_of_row(struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                                       int64_t row, const struct bonds *previous_bonds, int64_t previous_row,
                                       const int32_t *new_index);

/* Saves the softening state of all bonds b to the archive `a` if a->saving, else restores it from there. Marks of each
 * block of eight rows (bonds of eight particles) are included: whether a bond of the block has begun to soften, and
 * whether one may begin before the next computation of forces. When restoring, first restore the stored bond weights
 * (factors on the stiffness), which determine the number of bonds per block. Returns FAILED if an entry is missing or
 * its size differs. Does nothing if all bonds are brittle. */
status bonds_save_or_load_softening_states(struct bonds *b, struct archive *a);

/* Returns true if the row of particle i in the previous bonds inputs->old lists the present neighbours of this
 * particle, so that the neighbours need not be searched for. This requires that such a row exists, and either that
 * inputs->fresh[i] is 0 (1: neighbours may differ from those in inputs->old), or that the row has all neighbours and
 * the particle is peridynamic. */
static inline bool bond_row_previous_neighbours_are_valid(const struct bond_row_inputs *inputs, int64_t i)
{
    const int64_t before = inputs->old ? inputs->old->row_of[i] : -1;
    return before >= 0 && ((inputs->old->whole[before] && inputs->p->kind[i] == KIND_PD) || !inputs->fresh[i]);
}

/* Finds the neighbours of the particle with index `particle` and stores their indices in row->nbr (which must have
 * space for inputs->room), their number in row->n. inputs: inputs of the bonds and the previous bonds, from which
 * the neighbours are copied if they are still valid (bond_row_previous_neighbours_are_valid). */
void bond_row_find_neighbours(struct bond_row *row, const struct bond_row_inputs *inputs, int32_t particle);

/* Computes lengths and weights (factors on the stiffness) of the bonds from the particle with index `particle` to the
 * neighbours in row->nbr and stores them in `row`. inputs: inputs of the bonds and the previous bonds. Bonds that
 * are broken in the previous bonds inputs->old are broken in `row`, too; the plastic state of bonds is copied from
 * there. */
void bond_row_compute_lengths_and_weights(struct bond_row *row, const struct bond_row_inputs *inputs, int32_t particle);

/* Returns the number of the previous block of eight rows (bonds of eight particles) in inputs->old that equals block
 * `row_block` of b, so that its stored bonds can be used again; -1 if the particles or their neighbours have changed
 * (bonds_keep.c). */
int64_t bond_row_block_find_equal_in_previous_bonds(const struct bonds *b, const struct bond_row_inputs *inputs,
                                                    int64_t row_block);

/* Copies block `previous_row_block` of eight rows (the bonds of eight particles) of the bonds `previous_bonds` to block
 * `row_block` of b: the stencil (bond pattern of a lattice that blocks share), flags, breaking stretches and volumes.
 * Copies the stored bonds, too, unless b uses the bond arrays of `previous_bonds` itself (b->w == previous_bonds->w).
 */
void bond_row_block_copy_from_previous_bonds(struct bonds *b, const struct bonds *previous_bonds, int64_t row_block,
                                             int64_t previous_row_block);

/* Neighbours of the eight particles of a block of eight rows (the bonds of eight particles), stored between the pass
 * that counts columns and the pass that fills them. family_volume: volume of all neighbours. */
struct bond_row_block_neighbours {
    real family_volume[LANES]; /* [m^3] */
    int32_t n[LANES], nbr[];   /* number of neighbours of each row; neighbours, row after row */
};

/* Returns a newly allocated copy of the neighbours listed in row[0] .. row[row_count - 1] (each row has the bonds of
 * one particle), so that a second pass over the rows, after the bonds were counted, need not search again
 * (bond_rows_restore_found_neighbours). Release with memory_free. */
struct bond_row_block_neighbours *bond_rows_save_found_neighbours(const struct bond_row *row, int row_count);

/* Copies the neighbours that bond_rows_save_found_neighbours has saved in `saved` back to row[0] .. row[row_count - 1]
 * (each row has the bonds of one particle). */
void bond_rows_restore_found_neighbours(const struct bond_row_block_neighbours *saved, struct bond_row *row,
                                        int row_count);

/* Assigns a range of columns of the arrays of stored bonds to every block of eight rows (the bonds of eight particles)
 * of b and allocates these arrays. A column has eight bonds, one of each particle. previous_row_block[row_blocks]:
 * number of the previous block in inputs->old whose columns are used again in place, -1 for a block that is rebuilt;
 * NULL if there are no previous bonds. Rebuilt blocks use columns of removed blocks if these are enough, else columns
 * behind all others (bonds_columns.c). */
void bonds_allocate_storage_for_row_blocks(struct bonds *b, const struct bond_row_inputs *inputs,
                                           const int64_t *previous_row_block);

/* Sets the pointers in `previous` to NULL for those arrays that b uses as well, so that they belong to b alone and
 * releasing `previous` does not release them. */
void bonds_disown_arrays_shared_with_new_bonds(struct bonds *previous, const struct bonds *b);

/* Returns true if a pre-crack or a void (a narrow gap of the body) may cut a bond of the particle with index `particle`
 * of p; false if all of them are too far away. source: inputs of the bonds, with pre-cracks and voids. */
bool particle_is_near_precrack_or_void(const struct bond_source *source, const struct particles *p, int64_t particle);

/* Returns the stretch [1] above which the fast vector test of breaking passes the bond between the particles `particle`
 * and `other_particle` of p on to the exact test: the critical stretch of the bond less a tolerance for round-off.
 * source: inputs of the bonds (horizon, materials, cracks, mirrors). */
real bond_stretch_threshold_of_exact_break_test(const struct bond_source *source, const struct particles *p,
                                                int32_t particle, int32_t other_particle);

/* Chooses how the bonds of eight particles are arranged in columns of eight bonds. Returns true for columns in which
 * all neighbours have one index distance, as on a lattice, since these need little padding; false for rows packed
 * without gaps. distinct_offsets: number of distinct index distances; longest_row: largest number of bonds of one of
 * the eight particles. */
static inline bool eight_bond_rows_are_compact_as_lattice_columns(int distinct_offsets, int longest_row)
{
    return distinct_offsets <= longest_row + longest_row / 3;
}

/* Bonds of eight consecutive particles of a lattice without a search for neighbours. Entry k of each array describes
 * the bonds whose neighbour has the index of the particle plus offset[k]; lane l (0 to 7) is the l-th of the eight
 * particles. Offsets are ascending. */
struct lattice_bonds {
    int n;              /* number of index distances */
    bool full;          /* every lane has a neighbour at every distance */
    int32_t *offset;    /* [n] index distances */
    int16_t *number;    /* [n] numbers of these neighbours in a full neighbourhood */
    uint8_t *from, *to; /* [n] first and last lane with a neighbour at the distance */
    uint8_t *bonds;     /* [n] bit l: lane l has a bond at the distance: one of both particles is peridynamic */
    struct stencil_cache *stencil_cache; /* bonds of recent blocks of eight rows of this thread */
};

/* Allocates the arrays of `bonds`, which list the bonds of eight lattice particles by index distance (index of the
 * neighbour less index of the particle), for the largest possible number of distances. map: sites of the lattice.
 * Release with lattice_bonds_free. */
void lattice_bonds_allocate_for_eight_particles(struct lattice_bonds *bonds, const struct lattice_site_map *map);

/* Releases the arrays of `bonds`, the bonds of eight lattice particles by index distance. */
void lattice_bonds_free(struct lattice_bonds *bonds);

/* Lists the neighbours of the eight particles of p from `first_particle` on in `found_bonds`, by index distance (index
 * of the neighbour less index of the particle), from the map `map` of lattice sites. Returns true, or false if the map
 * does not contain all sites needed, so that the neighbours must be searched for. */
bool lattice_bonds_list_neighbours_by_offset(const struct lattice_site_map *map, const struct particles *p,
                                             int64_t first_particle, struct lattice_bonds *found_bonds);

/* Lists the neighbours of the eight particles of p from `first_particle` on in `found_bonds` as
 * lattice_bonds_list_neighbours_by_offset does, without regard to pre-cracks. source: inputs of the bonds (horizon,
 * materials, cracks, mirrors). Returns false also if one of the eight is a mirror image (copy beyond a plane of
 * symmetry) or near a void, or if `map` has no sites. */
bool lattice_bonds_list_neighbours_ignoring_cracks(const struct lattice_site_map *map, const struct bond_source *source,
                                                   const struct particles *p, int64_t first_particle,
                                                   struct lattice_bonds *found_bonds);

/* Returns a new, empty cache for one thread, which remembers the last blocks of eight rows (bonds of eight particles
 * each) that the thread has made. Later blocks are compared with them, so that equal bonds are copied instead of
 * computed (bonds_stencil_cache.c). map: from lattice sites to particles, kept by reference. Release with
 * stencil_cache_free. */
struct stencil_cache *stencil_cache_make_for_thread(const struct lattice_site_map *map);

/* Releases the cache t of blocks of eight rows. Does nothing if t is NULL. */
void stencil_cache_free(struct stencil_cache *t);

/* Searches the cache bonds->stencil_cache for eight consecutive particles whose bonds have the same bits (lengths,
 * weights, i.e. factors on the stiffness, and sums of weights) as `bonds`, the bonds of the eight particles from
 * `first_particle` on. None of these bonds may be cut by a pre-crack. Returns the index of the first of the eight
 * particles found; -1 if the cache has no such particles, or if the lattice is not uniform. If the lattice is uniform
 * and the search fails, adds `bonds` to the cache. weight_inputs: inputs besides lattice sites on which weights depend;
 * NULL if there are none. */
int64_t stencil_cache_find_or_add_lattice_bonds(const struct lattice_bonds *bonds,
                                                const struct bond_source *weight_inputs, int64_t first_particle);

/* Computes the inverse lengths inverse_length[8] [1/m] and weights weight[8] (factors on the stiffness, [1]) of the
 * bonds between the particles first_particle + l and first_neighbour + l of p, l = 0 to 7, without regard to cracks and
 * voids. source: inputs of the bonds (horizon, materials, cracks, mirrors); pairs: micro-moduli by pair of materials.
 */
void lattice_bonds_compute_eight_lengths_and_weights(const struct bond_source *source, const struct particles *p,
                                                     const struct material_pair_table *pairs, int64_t first_particle,
                                                     int64_t first_neighbour, real *inverse_length, real *weight);

/* Computes the bonds of the eight particles of p from `first_particle` on into `found_bonds`, by the map `map` from
 * lattice sites to particles. source: inputs of the bonds (horizon, materials, cracks, mirrors). Returns true, or false
 * if that is not possible, e.g. because a crack is near. */
bool lattice_bonds_compute_unless_near_crack(const struct lattice_site_map *map, const struct bond_source *source,
                                             const struct particles *p, int64_t first_particle,
                                             struct lattice_bonds *found_bonds);

/* Returns the number of columns (eight bonds, one of each particle) that `bonds`, the bonds of eight lattice particles,
 * need: one for each index distance (index of the neighbour less index of the particle) at which one of the particles
 * has a bond. */
int lattice_bonds_count_storage_columns(const struct lattice_bonds *bonds);

/* Returns the number of bonds of the eight lattice particles of `bonds` together. A bond between two of these particles
 * counts twice. */
int lattice_bonds_count_directed_bonds(const struct lattice_bonds *bonds);

/* Returns the micro-moduli of bonds for all pairs of materials, divided by that of bonds within material 0. s: inputs
 * of the bonds (horizon, materials, cracks, mirrors). Release the array `ratio` of the result with memory_free. */
struct material_pair_table material_pair_table_compute_micro_moduli(const struct bond_source *s);

/* Returns the number of rows in block `row_block` of eight rows of b, i.e. of the particles whose bonds the block
 * stores: eight, or fewer in the last block. */
static inline int bond_row_block_row_count(const struct bonds *b, int64_t row_block)
{
    return count_of_next_eight_indices_below_limit(row_block * LANES, b->rows);
}

/* Working memory in which one thread makes a block of eight rows (the bonds of eight particles). row: the bonds of each
 * particle. */
struct bond_row_block_buffer {
    struct lattice_bonds regular; /* bonds found without a search */
    int room;                     /* largest number of bonds of a row */
    struct bond_row row[LANES];
    int32_t *offset;              /* [LANES room] distinct index distances */
    struct column_copy *column;   /* [LANES room] columns of the block of eight rows */
    struct stencil stencil;       /* stencil of these columns */
    const struct stencil *likely; /* stencil of the previous block of eight rows */
    int32_t reach;                /* largest index distance so far */
};

/* Allocates the working memory `buffer` in which one thread makes blocks of eight rows (the bonds of eight particles
 * each). capacity: largest number of bonds of a particle; map: from lattice sites to particles. Release with
 * bond_row_block_buffer_free. */
void bond_row_block_buffer_make(struct bond_row_block_buffer *buffer, int capacity, const struct lattice_site_map *map);

/* Releases the arrays of `buffer`, the working memory in which blocks of eight rows are made. */
void bond_row_block_buffer_free(struct bond_row_block_buffer *buffer);

/* Returns the number of columns (one bond of each of eight particles) that the bonds in buffer->row[0] to
 * buffer->row[row_count - 1] need. particle[row_count]: indices of the particles of these rows. *one_offset_per_column
 * receives true if all neighbours in a column are to have one index distance from their particles, false if rows are
 * packed without gaps. */
int block_of_eight_bond_rows_count_columns(struct bond_row_block_buffer *buffer, const int32_t *particle, int row_count,
                                           bool *one_offset_per_column);

/* Fills block `row_block` of eight rows of b, which stores the bonds of eight particles, from the first `row_count`
 * rows in `buffer` (the bonds of one particle each): arranges the bonds in columns, one bond of each particle, and sets
 * breaking limits, neighbourhood volumes and the flag `aligned` of the block (1: its eight particles have consecutive
 * indices). p: particles; one_offset_per_column: true if the bonds of each column are to have the same offset on the
 * lattice, as block_of_eight_bond_rows_count_columns returns. */
void bond_row_block_fill_columns_from_rows(struct bonds *b, struct bond_row_block_buffer *buffer, int64_t row_block,
                                           int row_count, bool one_offset_per_column, const struct particles *p);

/* Fills block `row_block` of eight rows of b (the bonds of eight particles) from the bonds in buffer->regular, which
 * were found without a search, because its eight particles are consecutive on one lattice. inputs: inputs of the bonds
 * and the previous bonds. */
void bond_row_block_fill_by_bonds_found_on_lattice(struct bonds *b, struct bond_row_block_buffer *buffer,
                                                   int64_t row_block, const struct bond_row_inputs *inputs);

/* Stores the columns in `buffer` as columns of block `row_block` of eight rows of b (the bonds of eight particles of
 * p), or, if their bonds equal those of a known stencil (a bond pattern of the lattice), makes the block follow that
 * stencil and stores no columns. Called after the columns were filled. */
void bond_row_block_store_columns_or_stencil(struct bonds *b, struct bond_row_block_buffer *buffer, int64_t row_block,
                                             const struct particles *p);

/* Allocates b->shell_length and stores there the possible bond lengths of a lattice, spacing sqrt(k) for 0 < k <
 * BOND_SHELLS. spacing: lattice spacing [m]. bonds_free releases the table. */
void bonds_compute_lattice_shell_lengths(struct bonds *b, real spacing);

/* Finds the lattice shell of eight bonds with the inverse lengths inverse_length[8] [1/m], i.e. the whole number k > 0
 * for which the bonds have the length spacing sqrt(k). b: table of these lengths. Stores in round_off_units[LANES] by
 * how many units in the last place each inverse length differs from that of the shell, due to the round-off of
 * positions. Returns k, or 0 if the bonds have no common shell. */
int eight_bonds_find_common_squared_lattice_distance(const struct bonds *b, const real *inverse_length,
                                                     int16_t *round_off_units);

/* Returns a table of stencils (lists of columns shared by many blocks of eight rows): `existing`, its reference count
 * increased, or a new table if `existing` is NULL (bonds_stencils.c). Release with stencil_table_drop_reference. */
struct stencil_table *stencil_table_add_reference_or_make(struct stencil_table *existing);

/* Decreases the reference count of `stencils`, a table of bond patterns that many blocks of eight rows (bonds of eight
 * particles) of a lattice share, and releases the table when the count is 0. */
void stencil_table_drop_reference(struct stencil_table *stencils);

/* Allocates `stencil`, a bond pattern that blocks of eight rows of a lattice share, for up to `max_columns` columns.
 * Release with stencil_free. */
void stencil_allocate_columns(struct stencil *stencil, int max_columns);

/* Releases the arrays of `stencil`, a bond pattern for blocks of eight rows of a lattice. */
void stencil_free(struct stencil *stencil);

/* Appends a column, one bond of each of the eight consecutive particles from `first_particle` on, to `stencil`, which
 * must have space for it: a bond pattern that blocks of eight rows (bonds of eight particles) of a lattice share.
 * added_column: these bonds; weight (factor on the stiffness) and inverse length are 0 where a particle has none. b, p:
 * bonds and particles. Returns false, and leaves an unusable stencil, if the eight neighbours are not consecutive, or
 * if bonds differ in length or are cut. */
bool stencil_add_column(struct stencil *stencil, const struct bonds *b, const struct particles *p,
                        int64_t first_particle, const struct column_copy *added_column);

/* Returns the stencil (a bond pattern that blocks of eight rows of a lattice share) in the table `table` that is equal
 * to `stencil`; adds a copy to the table if there is none. first_guess: stencil of the table that is compared first,
 * NULL for none. Returns NULL if the table is full. */
const struct stencil *stencil_find_or_add(struct stencil_table *table, const struct stencil *stencil,
                                          const struct stencil *first_guess);

/* Makes block `row_block` of eight rows of b (the bonds of eight particles) use a stencil, a bond pattern that many
 * blocks of a lattice share, so that it needs no stored bonds: the stencil of the block that contains particle
 * `particle`, from which breaking limits and neighbourhood volumes are copied, too. If particle = -1, the block keeps
 * the stencil that it already has. Returns false, and changes nothing, if there is no stencil. */
bool bond_row_block_share_stencil_of_particle(struct bonds *b, int64_t row_block, int64_t particle);

/* Writes `bonds`, one bond of each of eight particles, to the entries of column number `column_number` (from 0) in the
 * bond arrays of b. */
void bond_column_write_eight_bonds(const struct bonds *b, int64_t column_number, const struct column_copy *bonds);

/* Sets the elastic moduli of the state-based model in b->state, and the rule by which they are divided by a weighted
 * volume Q, and allocates the volumes Q of all neighbourhoods there. source: inputs of the bonds (horizon, materials,
 * cracks, mirrors). Call before rows (bonds of particles) are filled (bonds_state.c). Does nothing for bond-based
 * models. */
void bonds_initialise_state_based_moduli(struct bonds *b, const struct bond_source *source);

/* Allocates the arrays of b->state, the data of state-based models for each row (the bonds of one particle of p),
 * stores of which particle each mirror image is a copy beyond a plane of symmetry, and computes the weighted volumes.
 * Release with bonds_free_state_based_arrays. source: geometry and material of the bonds. Call after all rows were
 * made. Does nothing for bond-based models. */
void bonds_make_state_based_arrays(struct bonds *b, const struct particles *p, const struct bond_source *source);

/* Releases the arrays of b->state, the data of neighbourhoods in state-based models. */
void bonds_free_state_based_arrays(struct bonds *b);

/* Lists in b->clamped the bonds of particles p to their mirror images in clamped planes (planes in which all motion is
 * prevented). source: inputs of the bonds (horizon, materials, cracks, mirrors). To be called after all rows were made
 * (bonds_clamped.c). */
void clamped_bonds_list_across_clamped_planes(struct bonds *b, const struct particles *p,
                                              const struct bond_source *source);

/* Releases the lists in b->clamped, the bonds to mirror images in clamped planes (planes in which all motion is
 * prevented). */
void clamped_bonds_free(struct bonds *b);

#endif
