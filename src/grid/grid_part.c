/* Row of the grid of the current frame in the table of parts, and its warning. */
#include "grid/grid_part.h"
#include "base/memory.h"
#include "run/part.h"

static void grid_free_all(struct run *e)
{
    struct grid_method *g = e->grid;
    active_points_free(&g->active), rotation_groups_free(&g->turning), grid_coupled_free(&g->coupled);
    for (int k = 0; k < g->fields; k++) {
        struct grid_field *f = &g->field[k];
        grid_free(&f->grid), transfer_order_free(&f->order);
        memory_free(f->held.held), memory_free(f->list);
    }
    memory_free(g->field), grid_contact_free(&g->contact);
}

/* Warns of mirrors that are neither on a node nor midway between two. Measured with inputs/bar_converge.yaml:
 * displacements are 11 to 24 % off if mirrors are 0.15 and 0.25 of a cell from a node, with 50 to 200 points per metre;
 * half the spacing reduces the error by at most a third. */
static void warn_of_mirrors(const struct run *e, struct warnings *to)
{
    const struct scene *s = e->scene;
    for (int b = 0; b < s->boundaries; b++)
        if (s->method != METHOD_PD && s->boundary[b].kind == BOUNDARY_MIRROR &&
            !mirror_plane_fits_grid_nodes(&s->boundary[b], &e->grid->field[0].grid, s->spacing))
            warnings_add(to,
                         "boundary %s: the mirror plane is neither on a grid node nor midway between two nodes: errors "
                         "of 15 to 20 %%, which refinement hardly reduces; move the nodes by mpm.origin or mpm.cell",
                         s->boundary[b].name);
}

static status grid_state(struct run *e, struct archive *a)
{
    return e->grid->fields > 1 ? grid_contact_save_or_load(&e->grid->contact, a) : OK;
}

const struct part part_grid = {PART(grid, grid_method), .free = grid_free_all, .state = grid_state,
                               .warn = warn_of_mirrors};
