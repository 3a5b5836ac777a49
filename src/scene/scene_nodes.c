/* Allocates the memory of the reader of an input file (scene) in arenas, and links the nodes of its YAML tree. */
#include "scene_internal.h"

#include <string.h>

#include "base/memory.h"

enum { ARENA_BLOCK = 32768 }; /* usual size of a block of an arena [byte] */

/* ---- memory of one reading --------------------------------------------------------------------------------------- */

/* A block of an arena: memory from which nodes and texts are taken, all released together. next: previous block; used,
 * room: number of bytes in use, and in all. */
struct arena_block {
    struct arena_block *next;
    size_t used, room;
    _Alignas(16) char bytes[];
};

void *arena_allocate_zeroed(struct reader *r, size_t byte_count)
{
    byte_count = (byte_count + 15) & ~(size_t)15;
    struct arena_block *block = r->arena;
    if (!block || block->room - block->used < byte_count) {
        size_t room = byte_count > ARENA_BLOCK ? byte_count : ARENA_BLOCK;
        block = memory_new("scene", (int64_t)(sizeof *block + room), 1);
        *block = (struct arena_block){.next = r->arena, .room = room};
        r->arena = block;
    }
    void *place = block->bytes + block->used;
    block->used += byte_count;
    return place;
}

char *arena_copy_text(struct reader *r, const char *text, size_t length)
{
    char *copy = arena_allocate_zeroed(r, length + 1);
    memcpy(copy, text, length);
    return copy;
}

void arena_free(struct reader *r)
{
    while (r->arena) {
        struct arena_block *next = r->arena->next;
        memory_free(r->arena);
        r->arena = next;
    }
}

/* ---- nodes ------------------------------------------------------------------------------------------------------- */

/* Appends the node `child` to the entries of `parent`, a list or a mapping. */
void yaml_node_append(struct yaml_node *parent, struct yaml_node *child)
{
    child->parent = parent;
    child->next = NULL;
    if (parent->last)
        parent->last->next = child;
    else
        parent->first = child;
    parent->last = child;
    parent->n++;
}

void yaml_node_remove(struct yaml_node *parent, struct yaml_node *child)
{
    struct yaml_node *before = NULL;
    for (struct yaml_node *n = parent->first; n != child; n = n->next) before = n;
    if (before)
        before->next = child->next;
    else
        parent->first = child->next;
    if (parent->last == child) parent->last = before;
    parent->n--;
}

struct yaml_node *yaml_node_find(const struct yaml_node *map, const char *key)
{
    if (!map || map->kind != NODE_MAP) return NULL;
    for (struct yaml_node *child = map->first; child; child = child->next)
        if (strcmp(child->key, key) == 0) return child;
    return NULL;
}
