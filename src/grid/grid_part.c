/* Registers the background grid with the engine: defines part_grid, its entry in the table of modules (struct part),
 * with the functions that free its memory and write or read its restart data. */
#include "grid/grid_part.h"
#include "base/memory.h"
#include "run/part.h"

static void grid_free_all(struct run *run)
{
    struct grid_method *g = run->grid;
    active_points_free(&g->active), corotating_groups_free(&g->turning), grid_coupled_free(&g->coupled);
    for (int k = 0; k < g->fields; k++) {
        struct grid_field *f = &g->field[k];
        grid_free(&f->grid), transfer_order_free(&f->order);
        memory_free(f->held.held), memory_free(f->list);
    }
    memory_free(g->field), memory_free(g->transfer.dilatation), grid_contact_free(&g->contact);
}

static status grid_state(struct run *run, struct archive *a)
{
    return run->grid->fields > 1 ? grid_contact_save_or_load(&run->grid->contact, a) : OK;
}

const struct part part_grid = {PART(grid, grid_method), .free = grid_free_all, .state = grid_state};
