/* The active set: blocks of particles or nodes that are still at rest are skipped, with bitwise equal
 * results.
 *
 * A block is the unit of the loops over bonds and nodes: eight bond rows, or eight nodes of a mesh along x.
 * It is inactive while its particles have the positions at which their forces were last computed, these
 * forces are 0, and no load moves them, since its forces would be 0 again. It becomes active when a particle
 * within its reach moves, and stays active. Activity level of a block:
 *
 *     0        inactive: neither forces nor motion are computed
 *     1        active: its forces are computed, and it moves
 *     most     it has moved, or a load moves it; its neighbours have one level less, and so on */
#ifndef CLEAVE_ACTIVE_SET
#define CLEAVE_ACTIVE_SET

#include "base/archive.h"

/* Activity levels of blocks (eight particles or eight nodes), and the list of the blocks that computations visit. All
 * other blocks are still at rest. All arrays are owned. */
struct active_set {
    bool is_current;               /* `level` is up to date; until then all blocks are active */
    int64_t blocks, active, empty; /* number of blocks; active ones; ones without particles */
    uint8_t *level, *moved;        /* [blocks + LANES] activity level of a block; [blocks] working memory */
    int32_t *list;                 /* [active] ascending: the blocks that the hot loops visit */
    bool resumed;                  /* all blocks are visited in the first step after a restart */
    bool over; /* blocks of bonds: all active blocks have moved already, so that no other one becomes active */
};

/* Allocates the active set of `block_count` blocks (each of eight particles or nodes) and makes all blocks active, so
 * that computations include every block. Release with active_set_free. */
void active_set_make_with_all_blocks_active(struct active_set *set, int64_t block_count);

/* Releases all arrays of the active set r. */
void active_set_free(struct active_set *set);

/* Rebuilds set->list, the ascending list of the blocks (eight particles or nodes) that computations visit, i.e. blocks
 * with an activity level above 0, and sets set->active to the number of these blocks. To be called after set->level has
 * changed. */
void active_set_rebuild_active_block_list(struct active_set *set);

/* Saves the activity levels of the blocks (groups of eight particles or nodes) of `set` to the archive `a` under the
 * name `name` if a->saving, else restores them. After restoring, computations include all blocks in the next step,
 * because the forces of inactive blocks are not stored. Returns FAILED if the archive cannot be read or written. */
status active_set_save_or_load(struct active_set *set, const char *name, struct archive *a);

/* Returns the fraction (0 to 1) of the blocks of `set` that are still at rest and skipped by computations. A block is a
 * group of eight particles or nodes; blocks without particles are not counted. */
static inline real active_set_inactive_fraction(const struct active_set *set)
{
    const int64_t blocks = set->blocks - set->empty;
    return blocks > 0 && set->active < blocks ? 1 - (real)set->active / (real)blocks : 0;
}

#endif
