/* Active set of the mesh of the undeformed body: finds blocks of eight nodes along x that are at rest, so that
 * computations skip them, and activates these blocks when motion reaches them. */
#include "mesh/active_nodes.h"

#include <string.h>

enum { MOVED = 2 }; /* forces on a node come from adjacent cells: at most one block on every side */

/* Returns the index of the first node of a block of the mesh: eight consecutive nodes along x. */
static int64_t nodes_first(const struct mesh *mesh, int64_t block)
{
    return block / mesh->segments * mesh->grid.count[0] + block % mesh->segments * LANES;
}

/* Returns the index one past the last node of a block of the mesh: eight consecutive nodes along x, or fewer at the end
 * of a row. */
static int64_t nodes_end(const struct mesh *mesh, int64_t block)
{
    const int64_t end = nodes_first(mesh, block) + LANES, row = (block / mesh->segments + 1) * mesh->grid.count[0];
    return end < row ? end : row;
}

/* Returns true if no node of a block of the mesh (eight nodes along x) has mass and no extra node of a slit belongs to
 * the block. (A slit is a gap between cells, along which nodes are doubled.) */
static bool nodes_empty(const struct mesh *mesh, int64_t block)
{
    if (mesh->slits.linked && mesh->slits.linked[block]) return false; /* cells there may have extra nodes */
    for (int64_t I = nodes_first(mesh, block); I < nodes_end(mesh, block); I++)
        if (mesh->inverse_mass[I] != 0) return false;
    return true;
}

static void mesh_activate(struct mesh *mesh, int64_t block);

/* Activates the blocks of nodes (eight along x) of `mesh` to which motion spreads from block `near` across slits. At a
 * slit (a gap between cells) several nodes have one position: a regular node and extra nodes. Raises blocks with extra
 * nodes that belong to regular nodes of `near` to at least activity level 1. If moves is true (the nodes of `near`
 * move), also activates the blocks with the regular nodes of extra nodes of `near`. */
static void slits_activate(struct mesh *mesh, int64_t near, bool moves)
{
    const struct mesh_slits *s = &mesh->slits;
    if (!s->linked || !s->linked[near]) return;
    for (int64_t k = 0; k < s->links; k++) {
        uint8_t *level = &mesh->active.level[s->link[k].extra];
        if (s->link[k].base == near && *level == 0) *level = 1;
        if (s->link[k].extra == near && moves) mesh_activate(mesh, s->link[k].base);
    }
}

/* Activates a block of nodes (eight along x) of `mesh` that moves, and those neighbouring blocks that have nodes with
 * mass. Inactive blocks are at rest and left out of computations. */
static void mesh_activate(struct mesh *mesh, int64_t block)
{
    struct active_set *set = &mesh->active;
    const int dim = mesh->grid.dim;
    const int64_t far[DIM_MAX] = {1, mesh->segments, dim > 2 ? mesh->segments * mesh->grid.count[1] : 0};
    if (set->level[block] == MOVED) return;
    set->level[block] = MOVED;
    for (int q = 0; q < (dim == 1 ? 3 : dim == 2 ? 9 : 27); q++) {
        int64_t near = block;
        for (int d = 0, active = q; d < dim; d++, active /= 3) near += (active % 3 - 1) * far[d];
        if (near < 0 || near >= set->blocks) continue;
        if (set->level[near] == 0 && !nodes_empty(mesh, near)) set->level[near] = 1;
        slits_activate(mesh, near, near == block);
    }
}

/* Returns true if a node of a block of the mesh (eight nodes along x) is displaced from its reference position. */
static bool nodes_moved(const struct mesh *mesh, int64_t block)
{
    for (int d = 0; d < mesh->grid.dim; d++)
        for (int64_t I = nodes_first(mesh, block); I < nodes_end(mesh, block); I++)
            if (mesh->displacement[d][I] != 0) return true;
    return false;
}

/* Returns true if the nodes of a block (eight along x) of `mesh` have neither displacement nor velocity nor force. */
static bool nodes_inactive(const struct mesh *mesh, int64_t block)
{
    for (int d = 0; d < mesh->grid.dim; d++)
        for (int64_t I = nodes_first(mesh, block); I < nodes_end(mesh, block); I++)
            if (!reals_are_bitwise_equal(mesh->grid.velocity[d][I], 0) || mesh->grid.force[d][I] != 0) return false;
    return !nodes_moved(mesh, block);
}

/* Returns true if w, a prescribed velocity component of a node, is 0 in the whole run: if it belongs to a plane of
 * symmetry of l, or to a boundary that prescribes the value 0. */
static bool wall_is_fixed(const struct loads *l, const struct wall *w)
{
    const struct boundary *b = l->load[w->load].boundary;
    return b->kind == BOUNDARY_MIRROR || b->value[w->component] == 0;
}

void active_nodes_activate_at_bonded_or_loaded_points(struct mesh *mesh)
{
    const int dim = mesh->grid.dim;
    for (int64_t k = 0; k < mesh->exposed && mesh->active.is_current; k++)
        for (int c = 0; c < 1 << dim; c++)
            mesh_activate(mesh, mesh_block_of_node(mesh, mesh_cell_corner_node(mesh, mesh->exposed_list[k].cell, c)));
    active_set_rebuild_active_block_list(&mesh->active);
}

void active_nodes_activate_all_node_blocks(struct mesh *mesh)
{
    mesh->active.is_current = false;
    array_fill_bytes(mesh->active.level, 1, mesh->active.blocks, 1);
}

/* Recomputes which blocks of nodes (eight along x) of the mesh are active. These are blocks with a node that moves or
 * carries a force, blocks with a node whose velocity the loads l prescribe as other than 0, the neighbours of both, and
 * blocks around exposed points (points whose motion is needed in every step). */
static void mesh_find_levels(struct mesh *mesh, const struct loads *l)
{
    struct active_set *set = &mesh->active;
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < set->blocks; k++) set->moved[k] = !nodes_inactive(mesh, k);
    array_fill_bytes(set->level, 0, set->blocks, 1);
    set->is_current = true, set->empty = 0;
    for (int64_t k = 0; k < set->blocks; k++) set->empty += nodes_empty(mesh, k);
    for (int64_t k = 0; k < set->blocks; k++)
        if (set->moved[k]) mesh_activate(mesh, k);
    for (int64_t k = 0; k < mesh->grid.walls; k++)
        if (!wall_is_fixed(l, &mesh->grid.wall[k]))
            mesh_activate(mesh, mesh_block_of_node(mesh, mesh->grid.wall[k].node));
    active_nodes_activate_at_bonded_or_loaded_points(mesh); /* makes the list */
}

void active_nodes_update_list_of_active_node_blocks(struct mesh *mesh, const struct loads *l)
{
    struct active_set *set = &mesh->active;
    if (!set->is_current) {
        mesh_find_levels(mesh, l);
        return;
    }
    bool moved = false;
#pragma omp parallel for schedule(static) reduction(|| : moved)
    for (int64_t k = 0; k < set->active; k++) {
        const int32_t block = set->list[k];
        set->moved[block] = set->level[block] == 1 && nodes_moved(mesh, block);
        moved = moved || set->moved[block];
    }
    for (int64_t k = 0; k < set->active && moved; k++)
        if (set->moved[set->list[k]]) mesh_activate(mesh, set->list[k]);
    if (moved || set->resumed) active_set_rebuild_active_block_list(set);
    set->resumed = false;
}
