/* The active set of row blocks: finds inactive row blocks of bonds, and activates them when particles move. */
#include "loads/active_rows.h"

#include <string.h>

/* Returns the level of moving row blocks, i.e. one more than the number of neighbouring row blocks to which motion
 * spreads in a step: forces reach two horizons in state-based models, one in bond-based ones. */
static int most_of(const struct bonds *b) { return b->state.modulus ? 3 : 2; }

/* Returns true if a particle of the row block is not at its reference position. */
static bool has_moved(const struct bonds *b, const struct particles *p, int64_t row_block)
{
    for (int64_t row = row_block * LANES; row < b->rows && row < (row_block + 1) * LANES; row++)
        for (int d = 0; d < p->dim; d++)
            if (!bits_equal(p->x[d][b->particle[row]], p->X[d][b->particle[row]])) return true;
    return false;
}

/* Returns true if displacements, velocities and forces of a row block are zero, and only bonds can move its
 * particles. */
static bool active_set_is_inactive(const struct bonds *b, const struct particles *p, const struct loads *l,
                                   int64_t row_block)
{
    for (int64_t row = row_block * LANES; row < b->rows && row < (row_block + 1) * LANES; row++) {
        const int32_t i = b->particle[row];
        if (particle_is_loaded(l, i) || particle_moves_with_nodes(p, i)) return false;
        for (int d = 0; d < p->dim; d++)
            if (!bits_equal(p->v[d][i], 0) || p->f[d][i] != 0) return false;
    }
    return !has_moved(b, p, row_block);
}

/* Returns the row block of the neighbour in a lane of a column, -1 if there is none or it has no row. Padding may point
 * to any particle. */
static int64_t row_block_of(const struct bonds *b, const struct particles *p, const struct loads *l,
                            const struct column_copy *column, int lane)
{
    if (column->inverse_length[lane] == 0) return -1;
    const int32_t row = b->row_of[image_source_particle(p, l->image, column->nbr[lane])];
    return row < 0 ? -1 : row / LANES;
}

/* Raises the level of a row block to `level`, and recursively those of its neighbours to one less. Level 0 is
 * inactive. */
static void row_block_activate(struct bonds *b, const struct particles *p, const struct loads *l, int64_t row_block,
                               int level)
{
    if (b->active.level[row_block] >= level) return;
    b->active.level[row_block] = (uint8_t)level;
    for (int64_t k = 0; k < row_block_column_count(b, row_block) && level > 1; k++) {
        struct column_copy column;
        bond_column_read(&column, b, row_block, k);
        for (int lane = 0; lane < LANES; lane++) {
            const int64_t next = row_block_of(b, p, l, &column, lane);
            if (next >= 0) row_block_activate(b, p, l, next, level - 1);
        }
    }
}

/* Returns true if a neighbour of the row block has exactly this level. */
static bool is_next_to(const struct bonds *b, const struct particles *p, const struct loads *l, int64_t row_block,
                       int level)
{
    for (int64_t k = 0; k < row_block_column_count(b, row_block); k++) {
        struct column_copy column;
        bond_column_read(&column, b, row_block, k);
        for (int lane = 0; lane < LANES; lane++) {
            const int64_t next = row_block_of(b, p, l, &column, lane);
            if (next >= 0 && b->active.level[next] == level) return true;
        }
    }
    return false;
}

/* Recomputes the levels of all row blocks from their present motion. Rows are rebuilt after every conversion, so
 * inactive row blocks are searched, not active ones. */
static void row_levels_find(struct bonds *b, const struct particles *p, const struct loads *l)
{
    struct active_set *r = &b->active;
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < r->blocks; k++) r->level[k] = active_set_is_inactive(b, p, l, k) ? 0 : (uint8_t)most_of(b);
    for (int level = most_of(b) - 1; level > 0; level--) {
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < r->blocks; k++) r->moved[k] = r->level[k] == 0 && is_next_to(b, p, l, k, level + 1);
        for (int64_t k = 0; k < r->blocks; k++)
            if (r->moved[k]) r->level[k] = (uint8_t)level;
    }
    array_fill_bytes(r->moved, 0, r->blocks, 1);
    r->is_current = true;
}

/* Raises the levels of the row blocks that have begun to move since the last call, and of their neighbours. Only active
 * row blocks below the highest level are tested: no other one can have begun to move. */
static void active_set_follow(struct bonds *b, const struct particles *p, const struct loads *l)
{
    struct active_set *r = &b->active;
    const int most = most_of(b);
    int64_t still = 0, moved = 0;
    if (r->over) return;
#pragma omp parallel for schedule(static) reduction(+ : still, moved)
    for (int64_t k = 0; k < r->active; k++) {
        if (r->level[r->list[k]] >= most) continue;
        r->moved[r->list[k]] = has_moved(b, p, r->list[k]);
        moved += r->moved[r->list[k]], still++;
    }
    r->over = still == 0 && !r->resumed;
    if (moved == 0 && !r->resumed) return;
    for (int64_t k = 0; k < r->active; k++)
        if (r->moved[r->list[k]]) row_block_activate(b, p, l, r->list[k], most);
    active_set_rebuild_list(r);
    r->resumed = false;
}

void active_rows_update(struct bonds *b, const struct particles *p, const struct loads *l)
{
    if (b->active.is_current) {
        active_set_follow(b, p, l);
        return;
    }
    row_levels_find(b, p, l);
    active_set_rebuild_list(&b->active);
}

void active_rows_activate(struct bonds *b, const struct particles *p, const struct loads *l, const int32_t *list,
                          int64_t n)
{
    bool any = false;
    if (!b->active.is_current) return;
    for (int64_t k = 0; k < n; k++) {
        const int32_t row = b->row_of[list[k]];
        if (row < 0 || b->active.level[row / LANES] >= most_of(b)) continue;
        row_block_activate(b, p, l, row / LANES, most_of(b));
        any = true;
    }
    if (!any) return;
    b->active.over = false;
    active_set_rebuild_list(&b->active);
}
