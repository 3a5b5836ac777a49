/* Cells that lie wholly in a body: their particles need not be made. */
#include "base/memory.h"
#include "scene/fill.h"

#define CLEARLY 1e-6                     /* of a cell: places on a surface are left to the fill */

/* Are all places of the particles of the cell with indices k in the shape? */
static bool cell_inside(const struct hollow *h, const struct region *shape, const int64_t *k)
{
    for (int c = 0; c < 1 << h->dim; c++) {
        real X[DIM_MAX] = {0};
        for (int d = 0; d < h->dim; d++)
            X[d] = h->anchor[d] + ((real)(h->first[d] + k[d]) + (c >> d & 1 ? 0.75 : 0.25)) * h->h;
        if (!region_contains(shape, X, h->dim, -CLEARLY * h->h)) return false;
    }
    return true;
}

void fill_whole(struct hollow *h, const struct scene *s, int body)
{
    h->whole = NEW("hollow.whole", h->n, uint8_t);
#pragma omp parallel for schedule(dynamic, 4096)
    for (int64_t I = 0; I < h->n; I++) {
        int64_t k[DIM_MAX] = {0};
        for (int d = 0; d < h->dim; d++) k[d] = I / h->stride[d] % h->count[d];
        h->whole[I] = cell_inside(h, &s->body[body].shape, k);
    }
}
