/* Makes the rows of bonds (a row: all bonds of one particle): selects the particles that have rows, forms blocks of
 * eight rows and fills their columns (column k: the k-th bonds of the eight rows). */
#include "bonds_parts.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static const real never[UINT8_MAX + 1] = {[0 ... UINT8_MAX] = INFINITY};
const struct bond_limit bond_limit_never = {.critical_stretch = never};

/* Returns true if particle i of p has a complete row (list of bonds) in the previous bonds `old`, with bonds to all
 * particles within the cutoff, as peridynamic particles have (rows of material points have bonds to peridynamic
 * neighbours only). For a mirror image, the row of the particle that it mirrors is tested. s: list of the mirror
 * images. */
static bool was_whole_row(const struct bonds *old, const struct bond_source *s, const struct particles *p, int64_t i)
{
    i = mirror_image_source_particle(p, s->image, i);
    return old->row_of[i] >= 0 && old->whole[old->row_of[i]];
}

/* Returns true if rows (lists of bonds of one particle) of the previous bonds `old` can be used again: `old` is not
 * NULL, and no particle that was peridynamic in `old`, with bonds to all its neighbours, is a material point in p now.
 */
static bool rows_reusable(const struct bonds *old, const struct particles *p)
{
    if (!old) return false;
    for (int64_t r = 0; r < old->rows; r++)
        if (old->whole[r] && p->kind[old->particle[r]] != KIND_PD) return false;
    return true;
}

/* Marks particle or mirror image i of p and all particles within its cutoff by 1: in wanted[(particles + 7)/8] the sets
 * of eight consecutive particles that contain one of them, which get rows of bonds; in fresh[particles] these particles
 * themselves, whose neighbours must be searched again. map: map from lattice sites to particles; found[capacity]:
 * working memory for the indices of neighbours; s: cutoff and cells of the search. */
static void mark_family(const struct bond_source *s, const struct particles *p, const struct lattice_site_map *map,
                        int64_t i, int32_t *found, int capacity, uint8_t *wanted, uint8_t *fresh)
{
    const int n = particle_find_neighbours_within_cutoff(map, s, p, (int32_t)i, found, capacity);
    if (i < p->n) wanted[i / LANES] = fresh[i] = 1;
    for (int k = 0; k < n; k++)
        if (found[k] < p->n) wanted[found[k] / LANES] = fresh[found[k]] = 1;
}

/* Marks by 1 in wanted[(n + 7)/8] the sets of eight consecutive particles of p that get rows (lists of bonds): sets
 * with a peridynamic particle or with a material point that has a peridynamic neighbour. Rows of other particles of a
 * marked set have no bonds. Whole sets are used, since a block of eight rows keeps its eight particles for as long as
 * it exists. Marks in fresh[n] the particles to be searched again: those that have become peridynamic and all within
 * their cutoff. old: previous bonds or NULL; map: map from lattice sites to particles; s: data from which bonds are
 * made; capacity: largest number of neighbours of a particle. */
static void mark_rows(const struct bond_source *s, const struct particles *p, const struct bonds *old,
                      const struct lattice_site_map *map, int capacity, uint8_t *wanted, uint8_t *fresh)
{
    const bool last = rows_reusable(old, p);
    if (!last) array_fill_bytes(fresh, 1, p->n, 1);
    if (p->n_of[KIND_PD] == p->n && !last) {
        array_fill_bytes(wanted, 1, (p->n + LANES - 1) / LANES, 1);
        return;
    }
    for (int64_t r = 0; last && r < old->rows; r += LANES) wanted[old->particle[r] / LANES] = 1;
    int32_t *found = NEW("bonds.found", capacity, int32_t);
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++)
        if (!last || !was_whole_row(old, s, p, p->list[KIND_PD][k]))
            mark_family(s, p, map, p->list[KIND_PD][k], found, capacity, wanted, fresh);
    for (int64_t i = p->n; i < p->n_all; i++)
        if (p->kind[i] == KIND_PD && !(last && was_whole_row(old, s, p, i)))
            mark_family(s, p, map, i, found, capacity, wanted, fresh);
    memory_free(found);
}

/* ---- all rows ---------------------------------------------------------------------------------------------------- */

/* Returns a table of the micro-moduli c of bonds for all pairs of materials of s, divided by the modulus of material 0
 * [1]: c = 2 c_a c_b/(c_a + c_b) between materials a and b; all entries are 1 for state-based models. The caller frees
 * the array `ratio` of the table with memory_free. */
struct material_pair_table material_pair_table_compute_micro_moduli(const struct bond_source *s)
{
    struct material_pair_table t = {NEW("bonds.pairs", square(s->materials), real), s->materials};
    real *c = NEW("bonds.moduli", s->materials, real);
    for (int m = 0; m < s->materials; m++) c[m] = family_micro_modulus(&s->family, &s->material[m]);
    /* springs in series across a material interface; equal ones without round-off */
    for (int a = 0; a < s->materials; a++)
        for (int b = 0; b < s->materials; b++)
            t.ratio[a * s->materials + b] =
                s->modulus ? 1 : (c[a] == c[b] ? c[a] : 2 * (c[a] * c[b]) / (c[a] + c[b])) / c[0];
    memory_free(c);
    return t;
}

/* Returns an array [n] for the row (list of bonds) of each particle, with all entries -1 (no row). If the previous
 * bonds `old` (or NULL) have a spare array of this kind, it is taken from them instead of allocating one. The caller
 * owns the array. */
static int32_t *row_of_make(struct bonds *old, int64_t n)
{
    int32_t *row_of = old ? old->no_rows : NULL;
    if (row_of) {
        old->no_rows = NULL;
        return row_of;
    }
    row_of = BARE("bonds.row_of", n, int32_t);
    array_fill_bytes(row_of, 0xff, n, sizeof *row_of);
    return row_of;
}

/* Makes rows (lists of bonds, empty so far) for the particles of p in all sets of eight consecutive ones that are
 * marked in wanted[sets]: sets b->particle (particle of each row) and b->row_of (row of each particle, -1 without one).
 * Rows are used in blocks of eight; unused rows of the last block repeat its last particle. old: previous bonds, from
 * which a spare array for b->row_of is taken if they have one; or NULL. */
static void rows_list(struct bonds *b, struct bonds *old, const struct particles *p, const uint8_t *wanted)
{
    const int64_t eights = (p->n + LANES - 1) / LANES;
    int32_t row = 0;
    b->rows = 0;
    for (int64_t e = 0; e < eights; e++)
        b->rows += wanted[e] ? count_of_next_eight_indices_below_limit(e * LANES, p->n) : 0;
    b->row_blocks = (b->rows + LANES - 1) / LANES;
    b->particle = NEW("bonds.particle", b->row_blocks * LANES, int32_t);
    b->row_of = row_of_make(old, p->n_all);
    for (int64_t e = 0; e < eights; e++)
        for (int l = 0; wanted[e] && l < count_of_next_eight_indices_below_limit(e * LANES, p->n); l++, row++)
            b->particle[row] = (int32_t)(e * LANES) + l, b->row_of[e * LANES + l] = row;
    for (int64_t r = b->rows; r < b->row_blocks * LANES; r++) b->particle[r] = b->particle[b->rows - 1];
}

/* Allocates the arrays of b with an entry for each row (bonds of one particle) or each block of eight rows (the bonds
 * of eight particles). The arrays with an entry for each bond are allocated later. Call it after rows_list. */
static void rows_arrays(struct bonds *b)
{
    int64_t padded = b->row_blocks * LANES;
    b->column = NEW("bonds.column", b->row_blocks, int64_t);
    b->column_count = NEW("bonds.column_count", b->row_blocks, int32_t);
    b->made = NEW("bonds.made", b->row_blocks, int32_t);
    b->aligned = NEW("bonds.aligned", b->row_blocks, uint8_t);
    b->whole = NEW("bonds.whole", padded, uint8_t);
    b->trigger = NEW("bonds.trigger", padded, real);
    b->family_volume = NEW("bonds.family_volume", padded, float);
    b->broken_volume = NEW("bonds.broken_volume", padded, float);
    b->fracture_energy = NEW("bonds.fracture_energy", padded, real);
    b->plastic_work = NEW("bonds.plastic_work", padded, real);
    b->broken = NEW("bonds.broken", padded, int32_t);
    b->stencil = NEW("bonds.stencil", b->row_blocks, const struct stencil *);
    b->implicit = NEW("bonds.implicit", b->row_blocks, uint8_t);
    b->changed = NEW("bonds.changed", b->row_blocks, uint8_t);
    active_set_make_with_all_blocks_active(&b->active, b->row_blocks);
}

/* Inputs and results of the two passes over the blocks of eight rows (the bonds of eight particles) in one construction
 * of bonds. The first pass counts the columns of each block (column k: the k-th bonds of the eight rows), the second
 * fills them. */
struct rows_pass {
    struct bonds *b;
    struct bond_row_inputs inputs;
    struct bond_row_block_neighbours *
        *found;       /* [row_blocks] neighbours found by search in the first pass, NULL: not kept */
    int64_t *kept;    /* [row_blocks] previous block of eight rows that is taken over, -1: the block is made */
    int64_t n, *list; /* [n] blocks of eight rows that are made, in ascending order */
    bool count;       /* first pass: columns are only counted */
};

/* Returns true if the new rows of the particles particle[rows] inherit changed weights: one of these particles had its
 * row in a block of eight rows (the bonds of eight particles) of the previous bonds `old` in which a bond has broken or
 * softened. Returns false if `old` is NULL. */
static bool row_block_inherits(const struct bonds *old, const int32_t *particle, int rows)
{
    bool changed = false;
    for (int l = 0; old && l < rows; l++) {
        const int32_t row = old->row_of[particle[l]];
        changed = changed || (row >= 0 && old->changed[row / LANES]);
    }
    return changed;
}

/* Returns true if the bonds of block g of eight rows (the bonds of eight particles) can be made from the map of lattice
 * sites, without a search: its particles are consecutive, on a regular part of the lattice, and have no changed
 * weights. In this case stores the bonds in room->regular. pass: the bonds and the data from which they are made; room:
 * working memory of the thread. */
static bool is_regular(const struct rows_pass *pass, struct bond_row_block_buffer *room, int64_t g)
{
    const struct bond_row_inputs *inputs = &pass->inputs;
    const int32_t *particle = pass->b->particle + g * LANES;
    return inputs->map->at && !pass->b->changed[g] && bond_row_block_row_count(pass->b, g) == LANES &&
           particle[LANES - 1] - particle[0] == LANES - 1 &&
           lattice_bonds_compute_unless_near_crack(inputs->map, inputs->source, inputs->p, particle[0], &room->regular);
}

/* Increases *reach, the largest difference of indices so far, to |distance| if that is larger. */
static void reach_widen(int32_t *reach, int32_t distance)
{
    if (abs(distance) > *reach) *reach = abs(distance);
}

/* Increases room->reach to the largest difference of the indices of two bonded particles in block g of eight rows (the
 * bonds of eight particles). Mirror images do not count, as they have no rows. regular: true if the bonds are in
 * room->regular (found from the lattice map), false if they are in room->row (found by search). pass: the bonds. */
static void note_reach(const struct rows_pass *pass, struct bond_row_block_buffer *room, int64_t g, bool regular)
{
    const int32_t *particle = pass->b->particle + g * LANES, n = (int32_t)pass->inputs.p->n;
    for (int k = 0; regular && k < room->regular.n; k++)
        if (particle[0] + room->regular.offset[k] < n) reach_widen(&room->reach, room->regular.offset[k]);
    for (int l = 0; !regular && l < bond_row_block_row_count(pass->b, g); l++)
        for (int k = 0; k < room->row[l].n; k++)
            if (room->row[l].nbr[k] < n) reach_widen(&room->reach, room->row[l].nbr[k] - particle[l]);
}

/* Makes block g of eight rows (the bonds of eight particles): in the first pass (pass->count is true) counts its
 * columns, in the second fills them. Column k contains the k-th bonds of its eight particles. room: working memory of
 * the thread. Returns the number of bonds of the block. */
static int64_t row_block_pass(const struct rows_pass *pass, struct bond_row_block_buffer *room, int64_t g)
{
    struct bonds *b = pass->b;
    const struct bond_row_inputs *inputs = &pass->inputs;
    const int rows = bond_row_block_row_count(b, g);
    const int32_t *particle = b->particle + g * LANES;
    int64_t made = 0;
    bool by_offset;
    if (pass->count) b->changed[g] = row_block_inherits(inputs->old, particle, rows);
    if (is_regular(pass, room, g)) {
        if (pass->count)
            b->column_count[g] = lattice_bonds_count_storage_columns(&room->regular), note_reach(pass, room, g, true);
        else
            bond_row_block_fill_by_bonds_found_on_lattice(b, room, g, inputs);
        return lattice_bonds_count_directed_bonds(&room->regular);
    }
    if (pass->found && pass->found[g]) bond_rows_restore_found_neighbours(pass->found[g], room->row, rows);
    for (int l = 0; l < rows; l++) {
        if (!pass->found || !pass->found[g]) bond_row_find_neighbours(&room->row[l], inputs, particle[l]);
        if (!pass->count) bond_row_compute_lengths_and_weights(&room->row[l], inputs, particle[l]);
        made += room->row[l].n;
    }
    const int columns = block_of_eight_bond_rows_count_columns(room, particle, rows, &by_offset);
    if (pass->count)
        b->column_count[g] = columns, note_reach(pass, room, g, false);
    else
        bond_row_block_fill_columns_from_rows(b, room, g, rows, by_offset, inputs->p);
    if (pass->count && pass->found) pass->found[g] = bond_rows_save_found_neighbours(room->row, rows);
    return made;
}

/* Compares the new blocks of eight rows (the bonds of eight particles) with the previous ones. pass->kept[g]: receives
 * the previous block that is equal to new block g, so that its contents can be copied, or -1. pass->list: receives the
 * blocks without an equal one, which must be made; pass->n: their number. */
static void rows_pass_begin(struct rows_pass *pass)
{
    struct bonds *b = pass->b;
    const struct bond_row_inputs *inputs = &pass->inputs;
    pass->kept = BARE("bonds.kept", b->row_blocks, int64_t);
    pass->list = BARE("bonds.list", b->row_blocks, int64_t);
#pragma omp parallel for schedule(static)
    for (int64_t g = 0; g < b->row_blocks; g++) {
        const int64_t from = pass->kept[g] = bond_row_block_find_equal_in_previous_bonds(b, inputs, g);
        if (from >= 0) b->column_count[g] = inputs->old->column_count[from];
    }
    for (int64_t g = 0; g < b->row_blocks; g++)
        if (pass->kept[g] < 0) pass->list[pass->n++] = g;
}

/* Makes all blocks of eight rows (the bonds of eight particles) in pass->list in parallel: counts their columns (the
 * k-th bonds of eight rows) in the first pass, fills them in the second. In two passes the memory is known before it is
 * filled, and bonds are not stored twice. Increases b->reach to the largest distance between the blocks of two bonded
 * particles [blocks of eight rows]. */
static void rows_pass(const struct rows_pass *pass)
{
    const struct bond_row_inputs *inputs = &pass->inputs;
    int32_t reach = 0;
#pragma omp parallel reduction(max : reach)
    {
        struct bond_row_block_buffer room = {0};
        bond_row_block_buffer_make(&room, inputs->room, inputs->map);
#pragma omp for schedule(static)
        for (int64_t k = 0; k < pass->n; k++)
            pass->b->made[pass->list[k]] = (int32_t)row_block_pass(pass, &room, pass->list[k]);
        reach = room.reach;
        bond_row_block_buffer_free(&room);
    }
    const int32_t row_blocks = (reach + LANES - 1) / LANES;
    if (row_blocks > pass->b->reach) pass->b->reach = row_blocks;
}

/* Copies those blocks of eight rows (the bonds of eight particles) that have not changed from the previous bonds,
 * pass->inputs.old, to the new ones, pass->b. Then sets pass->b->n, the number of directed bonds of all blocks. */
static void rows_pass_end(const struct rows_pass *pass)
{
    struct bonds *b = pass->b;
    int64_t made = 0;
#pragma omp parallel for schedule(static) reduction(+ : made)
    for (int64_t g = 0; g < b->row_blocks; g++) {
        if (pass->kept[g] >= 0) bond_row_block_copy_from_previous_bonds(b, pass->inputs.old, g, pass->kept[g]);
        made += b->made[g];
    }
    b->n = made;
}

/* Makes all blocks of eight rows (the bonds of eight particles) of b in two passes: the first counts their columns (the
 * k-th bonds of eight rows), the second fills them. inputs: input, with the previous bonds, if any. If there are
 * previous bonds, few blocks change; the neighbours that the first pass finds for these are then kept for the second
 * pass. */
static void bonds_rows_make(struct bonds *b, struct bond_row_inputs inputs)
{
    struct material_pair_table pairs = material_pair_table_compute_micro_moduli(inputs.source);
    inputs.pairs = &pairs;
    struct rows_pass pass = {.b = b,
                             .inputs = inputs,
                             .count = true,
                             .found = inputs.old ? NEW("bonds.found", b->row_blocks, struct bond_row_block_neighbours *)
                                                 : NULL};
    rows_pass_begin(&pass);
    rows_pass(&pass);
    bonds_allocate_storage_for_row_blocks(b, &pass.inputs, pass.kept);
    pass.count = false;
    rows_pass(&pass);
    rows_pass_end(&pass);
    for (int64_t k = 0; k < pass.n && pass.found; k++) memory_free(pass.found[pass.list[k]]);
    memory_free(pass.found);
    memory_free(pass.kept);
    memory_free(pass.list);
    memory_free(pairs.ratio);
}

/* Copies fracture energy, plastic work and number of broken bonds of each particle of b from its row in the previous
 * bonds `old`, if it had one. Other rows keep the value 0. */
static void rows_inherit(struct bonds *b, const struct bonds *old)
{
    for (int64_t r = 0; r < b->rows; r++) {
        int32_t before = old->row_of[b->particle[r]];
        if (before < 0) continue;
        b->fracture_energy[r] = old->fracture_energy[before];
        b->plastic_work[r] = old->plastic_work[before];
        b->broken[r] = old->broken[before];
    }
}

void bonds_make(struct bonds *b, struct bonds *previous_bonds, struct particles *p, const struct bond_source *s)
{
    memset(b, 0, sizeof *b);
    if (previous_bonds) b->reach = previous_bonds->reach; /* covers the blocks of eight rows that are kept */
    b->stencils = stencil_table_add_reference_or_make(previous_bonds ? previous_bonds->stencils : NULL);
    struct lattice_site_map *map =
        lattice_site_map_add_reference_or_make(previous_bonds ? previous_bonds->site_map : NULL, s, p);
    int most = bonds_neighbour_count_upper_bound(s);
    uint8_t *wanted = NEW("bonds.wanted", (p->n + LANES - 1) / LANES, uint8_t);
    uint8_t *fresh = NEW("bonds.fresh", p->n, uint8_t);
    mark_rows(s, p, previous_bonds, map, most, wanted, fresh);
    rows_list(b, previous_bonds, p, wanted);
    memory_free(wanted);
    rows_arrays(b);
    bonds_allocate_softening_state(b, previous_bonds, s, p);
    bonds_initialise_state_based_moduli(b, s);

    bonds_rows_make(b, (struct bond_row_inputs){
                           .old = previous_bonds, .source = s, .p = p, .fresh = fresh, .map = map, .room = most});
    memory_free(fresh);
    if (previous_bonds) rows_inherit(b, previous_bonds);
    if (p->n_of[KIND_PD] < p->n)
        b->site_map = map;
    else
        lattice_site_map_release_reference(map);
    bonds_disown_arrays_shared_with_new_bonds(previous_bonds, b);

    b->core = s->core;
    b->stiffness = family_micro_modulus(&s->family, &s->material[0]) * square(s->family.cell_volume);
#pragma omp parallel for schedule(static)
    for (int64_t r = 0; r < b->rows; r++) {
        b->whole[r] = p->kind[b->particle[r]] == KIND_PD;
        if (b->whole[r])
            p->damage[b->particle[r]] = b->family_volume[r] > 0 ? b->broken_volume[r] / b->family_volume[r] : 0;
    }
    bonds_make_state_based_arrays(b, p, s);
    clamped_bonds_list_across_clamped_planes(b, p, s);
#ifdef CLEAVE_ASSERT
    const char *fault = bonds_describe_first_inconsistency(b);
    if (fault) fprintf(stderr, "bonds_make: %s\n", fault), abort();
#endif
}

void mirror_images_copy_particle_kinds(struct particles *p, const struct bond_source *s)
{
    for (int64_t k = p->n; k < p->n_all; k++) p->kind[k] = p->kind[s->image[k - p->n].source];
}

void bonds_rebuild_after_particle_kind_change(struct bonds *b, struct particles *p, const struct bond_source *s)
{
    struct bonds old = *b;
    mirror_images_copy_particle_kinds(p, s);
    particles_rebuild_lists_by_kind(p);
    bonds_make(b, &old, p, s);
    for (int64_t row = 0; row < old.rows; row++) {
        const int32_t i = old.particle[row];
        for (int d = 0; d < p->dim && b->row_of[i] < 0; d++) p->f[d][i] = 0;
        old.row_of[i] = -1;
    }
    b->no_rows = old.row_of, old.row_of = NULL; /* spare array for the next rows */
    bonds_free(&old);
}

void bonds_free(struct bonds *b)
{
    memory_free(b->particle);
    memory_free(b->row_of);
    memory_free(b->no_rows);
    memory_free(b->column);
    memory_free(b->column_count);
    memory_free(b->made);
    memory_free(b->aligned);
    memory_free(b->whole);
    memory_free(b->first);
    memory_free(b->nbr);
    memory_free(b->inverse_length);
    memory_free(b->w);
    memory_free(b->common);
    memory_free(b->shell_length);
    memory_free(b->stencil);
    memory_free(b->implicit);
    memory_free(b->changed);
    memory_free(b->holes.hole);
    stencil_table_drop_reference(b->stencils);
    lattice_site_map_release_reference(b->site_map);
    memory_free(b->plastic_stretch);
    memory_free(b->plastic_path);
    memory_free(b->pair);
    memory_free(b->plastic_work);
    memory_free(b->soft.most), memory_free(b->soft.onset), memory_free(b->soft.end);
    memory_free(b->soft.whole);
    memory_free(b->soft.begun), memory_free(b->soft.due), memory_free(b->soft.near);
    memory_free(b->soft.settled);
    memory_free(b->soft.needed), memory_free(b->soft.dilatation), memory_free(b->soft.rate),
        memory_free(b->soft.beyond);
    bonds_free_state_based_arrays(b);
    clamped_bonds_free(b);
    active_set_free(&b->active);
    memory_free(b->trigger);
    memory_free(b->family_volume);
    memory_free(b->broken_volume);
    memory_free(b->fracture_energy);
    memory_free(b->broken);
    memset(b, 0, sizeof *b);
}
