/* Points that turn in groups (data/turning.h), in the step. */
#include "base/memory.h"
#include "grid/grid_part.h"
#include "data/turning.h"

/* The first of the bodies that are one with body b on the grid: joined ones, or all of a single grid. */
static int first_of(const struct grid_method *grid, const struct scene *scene, int b)
{
    return grid->fields > 1 ? scene->body[b].joined : 0;
}

/* Marks the bodies whose particles a support holds; one that turns them keeps no body from turning. */
static void mark_held(const struct run *e, bool *held)
{
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *l = &e->loads.load[b];
        if (l->boundary->kind != BOUNDARY_VELOCITY || l->boundary->rotates) continue;
        for (int64_t k = 0; k < l->n; k++) held[first_of(e->grid, e->scene, e->part.body[l->particle[k]])] = true;
    }
}

/* Where groups are counted from, so that bodies that mirror each other have groups that do: planes of symmetry, else
 * the middle of all bodies. */
static void turning_middle(const struct particles *part, const struct scene *scene, real *middle)
{
    for (int d = 0; d < part->dim; d++) {
        real low, high;
        particles_extent(part, part->n, d, &low, &high);
        middle[d] = 0.5 * (low + high);
    }
    for (int b = 0; b < scene->boundaries; b++)
        if (scene->boundary[b].kind == BOUNDARY_MIRROR) middle[scene->boundary[b].axis] = scene->boundary[b].at;
}

void grid_turning_make(struct run *e)
{
    const struct scene *s = e->scene;
    if (e->part.dim < 2 || s->transfer != TRANSFER_FLIP || !scene_moves(s) || s->method == METHOD_PD ||
        coupling_moves_by_grid(e->coupling_kind) || coupling_unified(e->coupling_kind))
        return;
    bool *held = NEW("engine.held", s->bodies, bool), all = true;
    int *one = NEW("engine.one", s->bodies, int);
    real middle[DIM_MAX];
    mark_held(e, held);
    turning_middle(&e->part, e->scene, middle);
    for (int b = 0; b < s->bodies; b++) one[b] = first_of(e->grid, e->scene, b), all &= held[one[b]];
    if (!all) turning_make(&e->grid->turning, &e->part, s->spacing, middle, one, held);
    for (int c = 0; c < 3; c++) e->grid->transfer.turn[c] = e->grid->turning.turn[c];
    /* with it hand-shake gains 1e-7 of its energy a step */
    e->grid->transfer.second_map = e->grid->turning.groups > 0 && e->coupling_kind != COUPLING_HANDSHAKE;
    memory_free(held), memory_free(one);
}
