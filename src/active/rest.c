/* floor 3: who sleeps and who wakes. */
#include "active/rest.h"

#include <stdio.h>
#include <string.h>

#include "bonds/bonds.h"
#include "loads/loads.h"
#include "base/memory.h"
#include "mesh/mesh.h"

void rest_make(struct rest *r, int64_t blocks)
{
    *r = (struct rest){.blocks = blocks};
    r->level = NEW("rest.level", blocks, uint8_t);
    r->moved = NEW("rest.moved", blocks, uint8_t);
    r->list = NEW("rest.list", blocks, int32_t);
    memset(r->level, 1, (size_t)blocks);
    rest_list(r);
}

void rest_free(struct rest *r)
{
    memory_free(r->level);
    memory_free(r->moved);
    memory_free(r->list);
}

void rest_list(struct rest *r)
{
    r->awake = 0;
    for (int64_t k = 0; k < r->blocks; k++)
        if (r->level[k] > 0) r->list[r->awake++] = (int32_t)k;
}

static void list_all(struct rest *r)
{
    for (int64_t k = 0; k < r->blocks; k++) r->list[k] = (int32_t)k;
    r->awake = r->blocks;
}

status rest_archive(struct rest *r, const char *name, struct archive *a)
{
    char path[48];
    if (r->blocks == 0) return OK;
    snprintf(path, sizeof path, "rest/%s_level", name);
    TRY(a->exchange(a, path, r->level, (size_t)r->blocks * sizeof *r->level));
    snprintf(path, sizeof path, "rest/%s_settled", name);
    ARCHIVE_VALUE(a, path, r->settled);
    snprintf(path, sizeof path, "rest/%s_empty", name);
    ARCHIVE_VALUE(a, path, r->empty);
    if (a->saving) return OK;
    list_all(r);
    r->resumed = true;
    return OK;
}

/* ---- rows of bonds ----------------------------------------------------------------------------------------- */

/* What knows its family by places and tells it to its bonds is felt at two horizons. */
static int most_of(const struct bonds *b) { return b->state.modulus ? 3 : 2; }

static bool has_moved(const struct bonds *b, const struct particles *p, int64_t group)
{
    for (int64_t row = group * LANES; row < b->rows && row < (group + 1) * LANES; row++)
        for (int d = 0; d < p->dim; d++)
            if (!bits_equal(p->x[d][b->particle[row]], p->X[d][b->particle[row]])) return true;
    return false;
}

/* Neither places, velocities nor forces differ from nothing, and nothing but bonds will move its particles. */
static bool is_quiet(const struct bonds *b, const struct particles *p, const struct loads *l, int64_t group)
{
    for (int64_t row = group * LANES; row < b->rows && row < (group + 1) * LANES; row++) {
        const int32_t i = b->particle[row];
        if (is_loaded(l, i) || particle_on_grid(p, i)) return false;
        for (int d = 0; d < p->dim; d++)
            if (!bits_equal(p->v[d][i], 0) || p->f[d][i] != 0) return false;
    }
    return !has_moved(b, p, group);
}

/* Group of the neighbour in a lane of a slot; -1: there is none, or it has no row. Padding looks at anybody. */
static int64_t group_of(const struct bonds *b, const struct particles *p, const struct loads *l, const struct slot_copy *slot,
                        int lane)
{
    if (slot->inverse_length[lane] == 0) return -1;
    const int32_t row = b->row_of[image_root(p, l->image, slot->nbr[lane])];
    return row < 0 ? -1 : row / LANES;
}

/* Gives a group a level, and who is bonded to it one less, and so on. */
static void wake(struct bonds *b, const struct particles *p, const struct loads *l, int64_t group, int level)
{
    if (b->rest.level[group] >= level) return;
    b->rest.level[group] = (uint8_t)level;
    for (int64_t k = 0; k < b->slot_count[group] && level > 1; k++) {
        struct slot_copy slot;
        slot_read(&slot, b, group, k);
        for (int lane = 0; lane < LANES; lane++) {
            const int64_t next = group_of(b, p, l, &slot, lane);
            if (next >= 0) wake(b, p, l, next, level - 1);
        }
    }
}

static bool is_next_to(const struct bonds *b, const struct particles *p, const struct loads *l, int64_t group, int level)
{
    for (int64_t k = 0; k < b->slot_count[group]; k++) {
        struct slot_copy slot;
        slot_read(&slot, b, group, k);
        for (int lane = 0; lane < LANES; lane++) {
            const int64_t next = group_of(b, p, l, &slot, lane);
            if (next >= 0 && b->rest.level[next] == level) return true;
        }
    }
    return false;
}

/* Rows are made anew whenever somebody converts: what is looked at is who may sleep, not who is awake. */
static void settle(struct bonds *b, const struct particles *p, const struct loads *l)
{
    struct rest *r = &b->rest;
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < r->blocks; k++) r->level[k] = is_quiet(b, p, l, k) ? 0 : (uint8_t)most_of(b);
    for (int level = most_of(b) - 1; level > 0; level--) {
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < r->blocks; k++) r->moved[k] = r->level[k] == 0 && is_next_to(b, p, l, k, level + 1);
        for (int64_t k = 0; k < r->blocks; k++)
            if (r->moved[k]) r->level[k] = (uint8_t)level;
    }
    memset(r->moved, 0, (size_t)r->blocks);
    r->settled = true;
}

/* Only who is awake but has not moved can have done so now. */
static void follow(struct bonds *b, const struct particles *p, const struct loads *l)
{
    struct rest *r = &b->rest;
    const int most = most_of(b);
    int64_t still = 0, moved = 0;
    if (r->over) return;
#pragma omp parallel for schedule(static) reduction(+ : still, moved)
    for (int64_t k = 0; k < r->awake; k++) {
        if (r->level[r->list[k]] >= most) continue;
        r->moved[r->list[k]] = has_moved(b, p, r->list[k]);
        moved += r->moved[r->list[k]], still++;
    }
    r->over = still == 0 && !r->resumed;
    if (moved == 0 && !r->resumed) return;
    for (int64_t k = 0; k < r->awake; k++)
        if (r->moved[r->list[k]]) wake(b, p, l, r->list[k], most);
    rest_list(r);
    r->resumed = false;
}

void rest_rows(struct bonds *b, const struct particles *p, const struct loads *l)
{
    if (b->rest.settled) {
        follow(b, p, l);
        return;
    }
    settle(b, p, l);
    rest_list(&b->rest);
}

/* ---- nodes of a mesh --------------------------------------------------------------------------------------- */

enum { MOVED = 2 };                      /* forces on a node come from the cells round it: one block on every side at the most */

/* First node of a block, and the one behind its last. */
static int64_t nodes_first(const struct mesh *mesh, int64_t block)
{
    return block / mesh->segments * mesh->grid.count[0] + block % mesh->segments * LANES;
}

static int64_t nodes_end(const struct mesh *mesh, int64_t block)
{
    const int64_t end = nodes_first(mesh, block) + LANES, row = (block / mesh->segments + 1) * mesh->grid.count[0];
    return end < row ? end : row;
}

static bool nodes_empty(const struct mesh *mesh, int64_t block)
{
    for (int64_t I = nodes_first(mesh, block); I < nodes_end(mesh, block); I++)
        if (mesh->inverse_mass[I] != 0) return false;
    return true;
}

static void mesh_wake(struct mesh *mesh, int64_t block)
{
    struct rest *r = &mesh->rest;
    const int dim = mesh->grid.dim;
    const int64_t far[DIM_MAX] = {1, mesh->segments, dim > 2 ? mesh->segments * mesh->grid.count[1] : 0};
    if (r->level[block] == MOVED) return;
    r->level[block] = MOVED;
    for (int q = 0; q < (dim == 1 ? 3 : dim == 2 ? 9 : 27); q++) {
        int64_t near = block;
        for (int d = 0, rest = q; d < dim; d++, rest /= 3) near += (rest % 3 - 1) * far[d];
        if (near >= 0 && near < r->blocks && r->level[near] == 0 && !nodes_empty(mesh, near)) r->level[near] = 1;
    }
}

static bool nodes_moved(const struct mesh *mesh, int64_t block)
{
    for (int d = 0; d < mesh->grid.dim; d++)
        for (int64_t I = nodes_first(mesh, block); I < nodes_end(mesh, block); I++)
            if (mesh->displacement[d][I] != 0) return true;
    return false;
}

static bool nodes_quiet(const struct mesh *mesh, int64_t block)
{
    for (int d = 0; d < mesh->grid.dim; d++)
        for (int64_t I = nodes_first(mesh, block); I < nodes_end(mesh, block); I++)
            if (!bits_equal(mesh->grid.velocity[d][I], 0) || mesh->grid.force[d][I] != 0) return false;
    return !nodes_moved(mesh, block);
}

/* A wall that never moves holds nobody who does not move. */
static bool wall_rests(const struct loads *l, const struct wall *w)
{
    const struct boundary *b = l->load[w->load].boundary;
    return b->kind == BOUNDARY_MIRROR || b->value[w->component] == 0;
}

void rest_mesh_see(struct mesh *mesh)
{
    const int dim = mesh->grid.dim;
    for (int64_t k = 0; k < mesh->seen && mesh->rest.settled; k++)
        for (int c = 0; c < 1 << dim; c++) mesh_wake(mesh, mesh_block(mesh, mesh->see[k].cell + mesh->corner[c]));
    rest_list(&mesh->rest);
}

void rest_mesh_all(struct mesh *mesh)
{
    mesh->rest.settled = false;
    memset(mesh->rest.level, 1, (size_t)mesh->rest.blocks);
}

static void mesh_settle(struct mesh *mesh, const struct loads *l)
{
    struct rest *r = &mesh->rest;
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < r->blocks; k++) r->moved[k] = !nodes_quiet(mesh, k);
    memset(r->level, 0, (size_t)r->blocks);
    r->settled = true, r->empty = 0;
    for (int64_t k = 0; k < r->blocks; k++) r->empty += nodes_empty(mesh, k);
    for (int64_t k = 0; k < r->blocks; k++)
        if (r->moved[k]) mesh_wake(mesh, k);
    for (int64_t k = 0; k < mesh->grid.walls; k++)
        if (!wall_rests(l, &mesh->grid.wall[k])) mesh_wake(mesh, mesh_block(mesh, mesh->grid.wall[k].node));
    rest_mesh_see(mesh);                         /* makes the list */
}

void rest_mesh(struct mesh *mesh, const struct loads *l)
{
    struct rest *r = &mesh->rest;
    if (!r->settled) {
        mesh_settle(mesh, l);
        return;
    }
    bool moved = false;
#pragma omp parallel for schedule(static) reduction(|| : moved)
    for (int64_t k = 0; k < r->awake; k++) {
        const int32_t block = r->list[k];
        r->moved[block] = r->level[block] == 1 && nodes_moved(mesh, block);
        moved = moved || r->moved[block];
    }
    for (int64_t k = 0; k < r->awake && moved; k++)
        if (r->moved[r->list[k]]) mesh_wake(mesh, r->list[k]);
    if (moved || r->resumed) rest_list(r);
    r->resumed = false;
}
