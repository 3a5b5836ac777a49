/* Combines eight rows (a row: all bonds of one particle) to a block: selects the bonds of each column (the k-th bonds
 * of the rows), and stores the columns, or a stencil that many blocks share. */
#include <string.h>

#include "bonds_parts.h"
#include "base/memory.h"

/* Returns true if the neighbours of `particle` in *row are exactly the n particles particle + offset[0], .., particle +
 * offset[n - 1], in this order. */
static bool offsets_are(const int32_t *offset, int n, const struct bond_row *row, int32_t particle)
{
    int32_t other = 0;
    if (row->n != n) return false;
    for (int k = 0; k < n; k++) other |= row->nbr[k] - particle - offset[k];
    return other == 0;
}

/* Lists the distinct index distances (neighbour minus particle) of all bonds of a block of eight rows (the bonds of
 * eight particles) in g->offset, ascending, and returns their number. particle[rows]: its particles, up to eight; g:
 * working memory, with the bonds of these particles in g->row[rows]. */
static int row_block_offsets(struct bond_row_block_buffer *g, const int32_t *particle, int rows)
{
    int n = g->row[0].n;
    for (int k = 0; k < n; k++) g->offset[k] = g->row[0].nbr[k] - particle[0];
    for (int l = 1; l < rows; l++)
        for (int k = 0, at = 0; k < g->row[l].n && (k > 0 || !offsets_are(g->offset, n, &g->row[l], particle[l]));
             k++) {
            int32_t offset = g->row[l].nbr[k] - particle[l];
            while (at < n && g->offset[at] < offset) at++;
            if (at < n && g->offset[at] == offset) continue;
            array_copy(g->offset + at + 1, g->offset + at, n - at, sizeof *g->offset);
            g->offset[at] = offset, n++;
        }
    return n;
}

/* Returns the number of columns of a block of eight rows (the bonds of eight particles), whose bonds are in
 * buffer->row. *one_offset_per_column: receives how the bonds are arranged: true if all bonds of a column have one
 * index distance (neighbour minus particle), false if each row has its bonds in the first columns, without gaps. The
 * latter is used off a lattice, where columns by distance would be mostly padding. particle[row_count]: particles of
 * the rows, 1 to 8. */
int block_of_eight_bond_rows_count_columns(struct bond_row_block_buffer *buffer, const int32_t *particle, int row_count,
                                           bool *one_offset_per_column)
{
    int longest = 0;
    for (int l = 0; l < row_count; l++)
        if (buffer->row[l].n > longest) longest = buffer->row[l].n;
    int offsets = row_block_offsets(buffer, particle, row_count);
    *one_offset_per_column = eight_bond_rows_are_compact_as_lattice_columns(offsets, longest);
    return *one_offset_per_column ? offsets : longest;
}

/* Returns the index of the pair of materials of particles i and j of p in the tables of b->yield. */
static int32_t pair_of(const struct bonds *b, const struct particles *p, int32_t i, int32_t j)
{
    return p->material[i] * b->yield.materials + p->material[j];
}

/* Stores the plastic state of the bond with index q in the bond arrays of b. pair: index of its pair of materials in
 * b->yield. */
static void plastic_put(struct bonds *b, int64_t q, struct bond_plasticity plastic, int32_t pair)
{
    b->plastic_stretch[q] = plastic.stretch;
    b->plastic_path[q] = plastic.path;
    b->pair[q] = pair;
}

/* Stores properties of block g of eight rows (the bonds of eight particles) in b: whether its particles are
 * consecutive, and for each of its `rows` rows the smallest stretch at which a bond may break, the volume of all
 * neighbours and that of the neighbours whose bonds are broken. room: has the rows. */
static void row_block_note(struct bonds *b, const struct bond_row_block_buffer *room, int64_t g, int rows)
{
    bool aligned = rows == LANES;
    for (int l = 1; l < rows; l++) aligned = aligned && b->particle[g * LANES + l] == b->particle[g * LANES] + l;
    b->aligned[g] = aligned;
    for (int l = 0; l < rows; l++) {
        int64_t r = g * LANES + l;
        b->trigger[r] = room->row[l].trigger;
        b->family_volume[r] = (float)room->row[l].family_volume;
        b->broken_volume[r] = (float)room->row[l].cut_volume;
    }
    for (int l = rows; l < LANES; l++) b->trigger[g * LANES + l] = INFINITY;
}

/* Returns true if column k of a block of eight rows (the k-th bonds of eight particles) must contain bond number `used`
 * of row l (0 to 7), the first bond of this row that has no column yet. by_offset: true if all bonds of column k must
 * have the index distance room->offset[k] (neighbour minus particle), false if a column accepts any bond. particle[8]:
 * particles of the rows. */
static bool row_has(const struct bond_row_block_buffer *room, const int32_t *particle, int l, int used, bool by_offset,
                    int k)
{
    const struct bond_row *row = &room->row[l];
    return used < row->n && (!by_offset || row->nbr[used] - particle[l] == room->offset[k]);
}

/* Stores the softening of the bonds of block g of eight rows of b (the bonds of eight particles) if one of them has
 * begun to soften; else only records in b that none has. buffer: has the rows, and the columns (k-th bonds of all rows)
 * in which bond_row_block_fill_columns_from_rows has stored the bonds; rows: number of rows in use. */
static void row_block_fill_softness(struct bonds *b, const struct bond_row_block_buffer *buffer, int64_t g, int rows)
{
    bool begun = false;
    int used[LANES] = {0};
    for (int l = 0; l < rows; l++)
        for (int k = 0; k < buffer->row[l].n; k++) begun |= buffer->row[l].soft[k].onset < SOFTENING_NEVER;
    b->soft.begun[g] = begun;
    for (int k = 0; k < b->column_count[g] && begun; k++)
        for (int l = 0; l < LANES; l++)
            bond_softening_state_write(b, (b->column[g] + k) * LANES + l,
                                       buffer->column[k].inverse_length[l] == 0 ? bond_softness_none
                                                                                : buffer->row[l].soft[used[l]++]);
}

void bond_row_block_fill_columns_from_rows(struct bonds *b, struct bond_row_block_buffer *buffer, int64_t g,
                                           int row_count, bool one_offset_per_column, const struct particles *p)
{
    const int32_t *particle = b->particle + g * LANES;
    int used[LANES] = {0}, columns = b->column_count[g];
    for (int k = 0; k < columns; k++) {
        struct column_copy *column = &buffer->column[k];
        for (int l = 0; l < LANES; l++) {
            const struct bond_row *row = &buffer->row[l];
            const int64_t other =
                one_offset_per_column ? particle[l] + (l < row_count ? buffer->offset[k] : 0) : particle[l];
            /* padding may point to any particle */
            column->nbr[l] = other < 0 || other >= p->n_all ? particle[l] : (int32_t)other;
            column->inverse_length[l] = column->w[l] = 0;
            if (l >= row_count || !row_has(buffer, particle, l, used[l], one_offset_per_column, k)) continue;
            const int n = used[l]++;
            column->nbr[l] = row->nbr[n], column->inverse_length[l] = row->inverse_length[n], column->w[l] = row->w[n];
            if (b->plastic_stretch)
                plastic_put(b, (b->column[g] + k) * LANES + l, row->plastic[n],
                            pair_of(b, p, particle[l], row->nbr[n]));
        }
        bool consecutive = true;
        for (int l = 1; l < LANES; l++) consecutive = consecutive && column->nbr[l] == column->nbr[0] + l;
        column->first = consecutive ? column->nbr[0] : -1;
    }
    if (b->soft.curve) row_block_fill_softness(b, buffer, g, row_count);
    row_block_note(b, buffer, g, row_count);
    bond_row_block_store_columns_or_stencil(b, buffer, g, p);
}

/* Makes room->stencil for block g of eight rows of b (the bonds of eight particles of p) from its columns in `room`
 * (column k: the k-th bonds of its particles). A stencil describes each column by its index distance (neighbour minus
 * particle) and the properties that its eight bonds share. Returns false if the block must store its columns: its
 * particles are not consecutive, bonds are plastic or changed, or a column has unequal bonds. */
static bool stencil_of(const struct bonds *b, struct bond_row_block_buffer *room, int64_t g, const struct particles *p)
{
    const int columns = b->column_count[g];
    room->stencil.columns = 0;
    if (!b->aligned[g] || columns == 0 || b->plastic_stretch || b->changed[g]) return false;
    for (int k = 0; k < columns; k++)
        if (!stencil_add_column(&room->stencil, b, p, b->particle[g * LANES], &room->column[k])) return false;
    return true;
}

void bond_row_block_store_columns_or_stencil(struct bonds *b, struct bond_row_block_buffer *buffer, int64_t g,
                                             const struct particles *p)
{
    b->stencil[g] =
        stencil_of(b, buffer, g, p) ? stencil_find_or_add(b->stencils, &buffer->stencil, buffer->likely) : NULL;
    b->implicit[g] = b->stencil[g] != NULL;
    if (b->implicit[g]) buffer->likely = b->stencil[g];
    for (int k = 0; k < b->column_count[g] && !b->implicit[g]; k++)
        bond_column_write_eight_bonds(b, b->column[g] + k, &buffer->column[k]);
}

/* Returns which of the particles i .. i + 7 of p are peridynamic: bit l is set if particle i + l is. */
static uint8_t peridynamic(const struct particles *p, int64_t i)
{
    unsigned bits = 0;
    for (int l = 0; l < LANES; l++) bits |= (unsigned)(p->kind[i + l] == KIND_PD) << l;
    return (uint8_t)bits;
}

bool lattice_bonds_compute_unless_near_crack(const struct lattice_site_map *map, const struct bond_source *s,
                                             const struct particles *p, int64_t first_particle,
                                             struct lattice_bonds *found_bonds)
{
    int bonds[LANES] = {0}, columns = 0, longest = 0;
    if (!lattice_bonds_list_neighbours_by_offset(map, p, first_particle, found_bonds)) return false;
    for (int l = 0; l < LANES; l++)
        if (particle_is_near_precrack_or_void(s, p, first_particle + l)) return false;
    const uint8_t own = peridynamic(p, first_particle);
    if (own == UINT8_MAX && found_bonds->full) {
        array_fill_bytes(found_bonds->bonds, UINT8_MAX, found_bonds->n, 1);
        return eight_bond_rows_are_compact_as_lattice_columns(found_bonds->n, found_bonds->n);
    }
    for (int k = 0; k < found_bonds->n; k++) {
        const unsigned family = (2u << found_bonds->to[k]) - (1u << found_bonds->from[k]);
        found_bonds->bonds[k] =
            (uint8_t)(family &
                      (own == UINT8_MAX ? own : own | peridynamic(p, first_particle + found_bonds->offset[k])));
        for (int l = 0; l < LANES; l++) bonds[l] += found_bonds->bonds[k] >> l & 1;
        columns += found_bonds->bonds[k] != 0;
    }
    for (int l = 0; l < LANES; l++) longest = bonds[l] > longest ? bonds[l] : longest;
    return eight_bond_rows_are_compact_as_lattice_columns(columns, longest);
}

int lattice_bonds_count_storage_columns(const struct lattice_bonds *bonds)
{
    int columns = 0;
    for (int k = 0; k < bonds->n; k++) columns += bonds->bonds[k] != 0;
    return columns;
}

int lattice_bonds_count_directed_bonds(const struct lattice_bonds *bonds)
{
    int sum = 0;
    for (int k = 0; k < bonds->n; k++) sum += __builtin_popcount(bonds->bonds[k]);
    return sum;
}

/* Fills *column with the bonds from particle i + l to particle j + l, l = 0 .. 7: neighbours, inverse lengths and
 * weights. inputs: data from which rows are made; bonds: bit l is set if the bond of particle i + l exists. Other bonds
 * become padding, with inverse length and weight 0. */
static void fill_column(struct column_copy *column, const struct bond_row_inputs *inputs, int32_t i, int32_t j,
                        unsigned bonds)
{
    const struct bond_source *s = inputs->source;
    column->first = j;
    lattice_bonds_compute_eight_lengths_and_weights(s, inputs->p, inputs->pairs, i, j, column->inverse_length,
                                                    column->w);
    for (int l = 0; l < LANES; l++) {
        column->nbr[l] = j + l;
        if (!(bonds >> l & 1)) column->inverse_length[l] = column->w[l] = 0;
    }
}

/* Computes trigger[l] for particle i + l, l = 0 .. 7: the smallest stretch at which one of its bonds may break or begin
 * to soften [1]; INFINITY without bonds. bonds: neighbours of these eight particles; inputs->source, inputs->p:
 * critical stretches of the materials and relative strengths of the particles. */
static void regular_triggers(real trigger[LANES], const struct lattice_bonds *bonds,
                             const struct bond_row_inputs *inputs, int32_t i)
{
    const bool alike = inputs->source->limit.materials <= 1 && !inputs->p->strength;
    for (int l = 0; l < LANES; l++) {
        trigger[l] = INFINITY;
        for (int k = 0; k < bonds->n && !(alike && trigger[l] < INFINITY); k++)
            if (bonds->bonds[k] >> l & 1)
                trigger[l] = real_min(trigger[l], bond_stretch_threshold_of_exact_break_test(
                                                      inputs->source, inputs->p, i + l, i + bonds->offset[k] + l));
    }
}

/* Returns true if each of eight consecutive particles is bonded to all particles within its cutoff, as peridynamic
 * particles are. (Material points are bonded to peridynamic particles only.) bonds: neighbours and bonds of the eight
 * particles. */
static bool whole_families(const struct lattice_bonds *bonds)
{
    unsigned without = 0;
    for (int k = 0; k < bonds->n; k++) without |= bonds->bonds[k] ^ ((2u << bonds->to[k]) - (1u << bonds->from[k]));
    return without == 0;
}

/* Fills block g of eight rows (the bonds of eight particles) of b from the bonds in buffer->regular, which follow from
 * the map of lattice sites. If the particles have bonds to all their neighbours, and a recent block had equal bonds,
 * copies the stencil of that block and the sums over its bonds. inputs: data from which rows are made. */
void bond_row_block_fill_by_bonds_found_on_lattice(struct bonds *b, struct bond_row_block_buffer *buffer, int64_t g,
                                                   const struct bond_row_inputs *inputs)
{
    const struct lattice_bonds *bonds = &buffer->regular;
    const real *volume = inputs->p->volume0;
    const int32_t i = b->particle[g * LANES];
    const bool follows =
        whole_families(bonds) && bond_row_block_share_stencil_of_particle(
                                     b, g, stencil_cache_find_or_add_lattice_bonds(bonds, inputs->source, i));
    real family_volume[LANES] = {0};
    int columns = 0;
    if (!follows || inputs->p->strength) regular_triggers(b->trigger + g * LANES, bonds, inputs, i);
    if (follows) return;
    for (int k = 0; k < bonds->n; k++) {
        const int32_t j = i + bonds->offset[k], from = bonds->from[k], to = bonds->to[k];
        for (int l = 0; l < LANES; l++) family_volume[l] += l >= from && l <= to ? volume[j + l] : 0;
        if (bonds->bonds[k]) fill_column(&buffer->column[columns++], inputs, i, j, bonds->bonds[k]);
    }
    for (int l = 0; l < LANES; l++) b->family_volume[g * LANES + l] = (float)family_volume[l];
    b->aligned[g] = true;
    bond_row_block_store_columns_or_stencil(b, buffer, g, inputs->p);
}

/* Allocates *buffer, the working memory for blocks of eight rows (the bonds of eight particles) whose rows have up to
 * `capacity` bonds, for the worst case. Little of this memory is ever touched, as the arrays are not cleared. map: map
 * from lattice sites to particles. Release it with bond_row_block_buffer_free. */
void bond_row_block_buffer_make(struct bond_row_block_buffer *buffer, int capacity, const struct lattice_site_map *map)
{
    buffer->room = capacity;
    for (int l = 0; l < LANES; l++) bond_row_buffer_make(&buffer->row[l], capacity);
    buffer->offset = BARE("bonds.offset", (int64_t)LANES * capacity + 1, int32_t);
    lattice_bonds_allocate_for_eight_particles(&buffer->regular, map);
    stencil_allocate_columns(&buffer->stencil, LANES * capacity + 1);
    buffer->column = BARE("bonds.column_copy", (int64_t)LANES * capacity + 1, struct column_copy);
}

void bond_row_block_buffer_free(struct bond_row_block_buffer *buffer)
{
    for (int l = 0; l < LANES; l++) bond_row_buffer_free(&buffer->row[l]);
    memory_free(buffer->offset);
    lattice_bonds_free(&buffer->regular);
    stencil_free(&buffer->stencil);
    memory_free(buffer->column);
}
