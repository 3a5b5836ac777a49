/* Finds blocks of eight bond rows whose particles are at rest, so that their bond forces need not be computed, and
 * activates these blocks when motion reaches them. */
#include "loads/active_rows.h"

#include <string.h>

/* Returns the highest activity level, which blocks of eight bond rows with moving particles have. It is 1 plus the
 * number of horizons over which forces spread in a step: 3 for state-based models, 2 for bond-based ones. b: bonds of
 * the body. */
static int most_of(const struct bonds *b) { return b->state.modulus ? 3 : 2; }

/* Returns true if a particle of block `row_block` of eight rows of b (LANES rows of bonds stored together, one row for
 * each particle) has left its reference position: its coordinates x and X in p differ in any bit. */
static bool has_moved(const struct bonds *b, const struct particles *p, int64_t row_block)
{
    for (int64_t row = row_block * LANES; row < b->rows && row < (row_block + 1) * LANES; row++)
        for (int d = 0; d < p->dim; d++)
            if (!reals_are_bitwise_equal(p->x[d][b->particle[row]], p->X[d][b->particle[row]])) return true;
    return false;
}

/* Returns true if block `row_block` of eight rows of b (LANES rows of bonds stored together, one for each particle) is
 * at rest: displacements, velocities and forces of its particles in p are zero, and no load of l, grid or mesh can move
 * them. */
static bool active_set_is_inactive(const struct bonds *b, const struct particles *p, const struct loads *l,
                                   int64_t row_block)
{
    for (int64_t row = row_block * LANES; row < b->rows && row < (row_block + 1) * LANES; row++) {
        const int32_t i = b->particle[row];
        if (particle_is_loaded(l, i) || particle_is_moved_by_grid_or_mesh_nodes(p, i)) return false;
        for (int d = 0; d < p->dim; d++)
            if (!reals_are_bitwise_equal(p->v[d][i], 0) || p->f[d][i] != 0) return false;
    }
    return !has_moved(b, p, row_block);
}

/* Returns the block of eight bond rows of b (one row for each particle of p) that contains the row of the neighbour at
 * the end of one bond. For a neighbour that is a mirror image, it is the block of the particle that the image copies.
 * column: one bond of each of the LANES rows of a block; lane: number of the row in this block, from 0; l: loads with
 * the mirror images. Returns -1 if the bond is padding or the neighbour has no row. */
static int64_t row_block_of(const struct bonds *b, const struct particles *p, const struct loads *l,
                            const struct column_copy *column, int lane)
{
    if (column->inverse_length[lane] == 0) return -1;
    const int32_t row = b->row_of[mirror_image_source_particle(p, l->image, column->nbr[lane])];
    return row < 0 ? -1 : row / LANES;
}

/* Raises the activity level of block `row_block` of eight rows of b to `level`, and recursively those of the blocks of
 * its neighbours to level - 1, down to 1. Levels are never lowered here. A block (LANES rows of bonds stored together,
 * one for each particle of p) has level 0 while it is inactive: its bond forces are not computed. l: loads with the
 * mirror images. */
static void row_block_activate(struct bonds *b, const struct particles *p, const struct loads *l, int64_t row_block,
                               int level)
{
    if (b->active.level[row_block] >= level) return;
    b->active.level[row_block] = (uint8_t)level;
    for (int64_t k = 0; k < bond_row_block_bond_slots_per_particle(b, row_block) && level > 1; k++) {
        struct column_copy column;
        bond_column_read_eight_bonds(&column, b, row_block, k);
        for (int lane = 0; lane < LANES; lane++) {
            const int64_t next = row_block_of(b, p, l, &column, lane);
            if (next >= 0) row_block_activate(b, p, l, next, level - 1);
        }
    }
}

/* Returns true if a particle of block `row_block` of eight rows of b (LANES rows of bonds stored together, one for each
 * particle of p) has a bond to a particle whose block has exactly the activity level `level`. l: loads with the mirror
 * images. */
static bool is_next_to(const struct bonds *b, const struct particles *p, const struct loads *l, int64_t row_block,
                       int level)
{
    for (int64_t k = 0; k < bond_row_block_bond_slots_per_particle(b, row_block); k++) {
        struct column_copy column;
        bond_column_read_eight_bonds(&column, b, row_block, k);
        for (int lane = 0; lane < LANES; lane++) {
            const int64_t next = row_block_of(b, p, l, &column, lane);
            if (next >= 0 && b->active.level[next] == level) return true;
        }
    }
    return false;
}

/* Recomputes the activity levels b->active.level of all blocks of eight rows of b (LANES rows of bonds stored together,
 * one for each particle of p). Blocks in motion have the highest level. A block with a bond to these has one level
 * less, and so on from neighbour to neighbour down to level 0: inactive, no forces computed. l: loads that may move
 * particles. Must be called after rows were rebuilt. */
static void row_levels_find(struct bonds *b, const struct particles *p, const struct loads *l)
{
    struct active_set *set = &b->active;
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < set->blocks; k++)
        set->level[k] = active_set_is_inactive(b, p, l, k) ? 0 : (uint8_t)most_of(b);
    for (int level = most_of(b) - 1; level > 0; level--) {
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < set->blocks; k++)
            set->moved[k] = set->level[k] == 0 && is_next_to(b, p, l, k, level + 1);
        for (int64_t k = 0; k < set->blocks; k++)
            if (set->moved[k]) set->level[k] = (uint8_t)level;
    }
    array_fill_bytes(set->moved, 0, set->blocks, 1);
    set->is_current = true;
}

/* Updates the activity levels of blocks of eight rows of b (LANES rows of bonds stored together, one for each particle
 * of p) after a step. Blocks that have begun to move since the last call get the highest level, and the levels of their
 * neighbours are raised. Then rebuilds the list of active blocks. Tests only active blocks below the highest level,
 * since motion reaches others only through these; sets b->active.over if there are no such blocks. l: loads with the
 * mirror images. */
static void active_set_follow(struct bonds *b, const struct particles *p, const struct loads *l)
{
    struct active_set *set = &b->active;
    const int most = most_of(b);
    int64_t still = 0, moved = 0;
    if (set->over) return;
#pragma omp parallel for schedule(static) reduction(+ : still, moved)
    for (int64_t k = 0; k < set->active; k++) {
        if (set->level[set->list[k]] >= most) continue;
        set->moved[set->list[k]] = has_moved(b, p, set->list[k]);
        moved += set->moved[set->list[k]], still++;
    }
    set->over = still == 0 && !set->resumed;
    if (moved == 0 && !set->resumed) return;
    for (int64_t k = 0; k < set->active; k++)
        if (set->moved[set->list[k]]) row_block_activate(b, p, l, set->list[k], most);
    active_set_rebuild_active_block_list(set);
    set->resumed = false;
}

void active_bond_row_blocks_update_after_step(struct bonds *b, const struct particles *p, const struct loads *l)
{
    if (b->active.is_current) {
        active_set_follow(b, p, l);
        return;
    }
    row_levels_find(b, p, l);
    active_set_rebuild_active_block_list(&b->active);
}

void active_bond_row_blocks_activate_for_particles(struct bonds *b, const struct particles *p, const struct loads *l,
                                                   const int32_t *particle_list, int64_t particle_count)
{
    bool any = false;
    if (!b->active.is_current) return;
    for (int64_t k = 0; k < particle_count; k++) {
        const int32_t row = b->row_of[particle_list[k]];
        if (row < 0 || b->active.level[row / LANES] >= most_of(b)) continue;
        row_block_activate(b, p, l, row / LANES, most_of(b));
        any = true;
    }
    if (!any) return;
    b->active.over = false;
    active_set_rebuild_active_block_list(&b->active);
}
