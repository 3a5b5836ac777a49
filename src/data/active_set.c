/* Allocates, lists, saves and restores the active set: activity levels of blocks of eight bond rows or mesh nodes, and
 * the list of the blocks that computations visit. */
#include "data/active_set.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "data/particles.h"

void active_set_make_with_all_blocks_active(struct active_set *r, int64_t block_count)
{
    *r = (struct active_set){.blocks = block_count};
    r->level = NEW("active_set.level", block_count + LANES, uint8_t);
    r->moved = NEW("active_set.moved", block_count, uint8_t);
    r->list = NEW("active_set.list", block_count, int32_t);
    array_fill_bytes(r->level, 1, block_count, 1);
    active_set_rebuild_active_block_list(r);
}

void active_set_free(struct active_set *r)
{
    memory_free(r->level);
    memory_free(r->moved);
    memory_free(r->list);
}

void active_set_rebuild_active_block_list(struct active_set *r)
{
    r->active = 0;
    for (int64_t k = 0; k < r->blocks; k++)
        if (r->level[k] > 0) r->list[r->active++] = (int32_t)k;
}

/* Makes all blocks of the active set r active: lists their numbers in ascending order. A block is a fixed number of
 * consecutive elements. */
static void list_all(struct active_set *r)
{
    for (int64_t k = 0; k < r->blocks; k++) r->list[k] = (int32_t)k;
    r->active = r->blocks;
}

status active_set_save_or_load(struct active_set *r, const char *name, struct archive *a)
{
    char path[48];
    if (r->blocks == 0) return OK;
    snprintf(path, sizeof path, "active_set/%s_level", name);
    TRY(a->exchange(a, path, r->level, (size_t)r->blocks * sizeof *r->level));
    snprintf(path, sizeof path, "active_set/%s_settled", name);
    ARCHIVE_VALUE(a, path, r->is_current);
    snprintf(path, sizeof path, "active_set/%s_empty", name);
    ARCHIVE_VALUE(a, path, r->empty);
    if (a->saving) return OK;
    list_all(r);
    r->resumed = true;
    return OK;
}
