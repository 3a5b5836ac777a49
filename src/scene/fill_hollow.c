/* Finds cells that are wholly inside a body, whose particles need not be created. */
#include "base/memory.h"
#include "scene/fill.h"

#define CLEARLY 1e-6 /* margin [cells]: positions closer to a surface are left to the fill */

/* Returns true if all 2^dim particles that would belong to cell I of the grid `box` are inside the shape, at least
 * CLEARLY cells from its boundary. */
static bool cell_inside(const struct grid *box, const struct region *shape, int64_t I)
{
    for (int c = 0; c < 1 << box->dim; c++) {
        real X[DIM_MAX] = {0};
        for (int d = 0; d < box->dim; d++) X[d] = grid_cell_quadrature_point_coordinate(box, I, c, d);
        if (!region_contains(shape, X, box->dim, -CLEARLY * box->h)) return false;
    }
    return true;
}

void body_flag_cells_with_all_lattice_sites_inside(struct cells_without_particles *empty_cells, const struct scene *s,
                                                   int body_index)
{
    empty_cells->whole = NEW("hollow.whole", empty_cells->box.n, uint8_t);
#pragma omp parallel for schedule(dynamic, 4096)
    for (int64_t I = 0; I < empty_cells->box.n; I++)
        empty_cells->whole[I] = cell_inside(&empty_cells->box, &s->body[body_index].shape, I);
}
