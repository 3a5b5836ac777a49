/* The grid of the current frame, as a part of a run. */
#include "grid/grid_part.h"
#include "base/memory.h"
#include "run/part.h"

static void grid_free_all(struct run *e)
{
    struct grid_method *g = e->grid;
    active_points_free(&g->active), turning_free(&g->turning), grid_coupled_free(&g->coupled);
    for (int k = 0; k < g->fields; k++) {
        struct grid_field *f = &g->field[k];
        grid_free(&f->grid), transfer_order_free(&f->order);
        memory_free(f->held.held), memory_free(f->list);
    }
    memory_free(g->field), grid_contact_free(&g->contact);
}

const struct part part_grid = {PART(grid, grid_method), .free = grid_free_all};
