/* Cells that lie wholly in a body: their particles need not be made. */
#include "base/memory.h"
#include "scene/fill.h"

#define CLEARLY 1e-6 /* of a cell: places on a surface are left to the fill */

/* Are all places of the particles of cell I in the shape? */
static bool cell_inside(const struct grid *box, const struct region *shape, int64_t I)
{
    for (int c = 0; c < 1 << box->dim; c++) {
        real X[DIM_MAX] = {0};
        for (int d = 0; d < box->dim; d++) X[d] = grid_quarter(box, I, c, d);
        if (!region_contains(shape, X, box->dim, -CLEARLY * box->h)) return false;
    }
    return true;
}

void fill_whole(struct hollow *h, const struct scene *s, int body)
{
    h->whole = NEW("hollow.whole", h->box.n, uint8_t);
#pragma omp parallel for schedule(dynamic, 4096)
    for (int64_t I = 0; I < h->box.n; I++) h->whole[I] = cell_inside(&h->box, &s->body[body].shape, I);
}
