/* Allocates, lists, saves and restores the active set: activity levels of blocks of eight bond rows or mesh nodes, and
 * the list of the blocks that computations visit. */
#include "data/active_set.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "data/particles.h"

void active_set_make_with_all_blocks_active(struct active_set *set, int64_t block_count)
{
    *set = (struct active_set){.blocks = block_count};
    set->level = NEW("active_set.level", block_count + LANES, uint8_t);
    set->moved = NEW("active_set.moved", block_count, uint8_t);
    set->list = NEW("active_set.list", block_count, int32_t);
    array_fill_bytes(set->level, 1, block_count, 1);
    active_set_rebuild_active_block_list(set);
}

void active_set_free(struct active_set *set)
{
    memory_free(set->level);
    memory_free(set->moved);
    memory_free(set->list);
}

void active_set_rebuild_active_block_list(struct active_set *set)
{
    set->active = 0;
    for (int64_t k = 0; k < set->blocks; k++)
        if (set->level[k] > 0) set->list[set->active++] = (int32_t)k;
}

/* Makes all blocks of the active set active: lists their numbers in ascending order. A block is a fixed number of
 * consecutive elements. */
static void list_all(struct active_set *set)
{
    for (int64_t k = 0; k < set->blocks; k++) set->list[k] = (int32_t)k;
    set->active = set->blocks;
}

status active_set_save_or_load(struct active_set *set, const char *name, struct archive *a)
{
    char path[48];
    if (set->blocks == 0) return OK;
    snprintf(path, sizeof path, "active_set/%s_level", name);
    TRY(a->exchange(a, path, set->level, (size_t)set->blocks * sizeof *set->level));
    snprintf(path, sizeof path, "active_set/%s_settled", name);
    ARCHIVE_VALUE(a, path, set->is_current);
    snprintf(path, sizeof path, "active_set/%s_empty", name);
    ARCHIVE_VALUE(a, path, set->empty);
    if (a->saving) return OK;
    list_all(set);
    set->resumed = true;
    return OK;
}
