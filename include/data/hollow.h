/* Cells of two spacings of which the particles are not made: they lie wholly in the body and are part of coarse cells
 * (mesh/levels.h), far from bonds, loads and faces of pre-cracks. */
#ifndef CLEAVE_HOLLOW
#define CLEAVE_HOLLOW

#include <math.h>

#include "base/base.h"

struct hollow {
    int dim;
    real anchor[DIM_MAX], h;             /* place of node 0, edge of a cell [m] */
    int64_t first[DIM_MAX], count[DIM_MAX], stride[DIM_MAX], n;   /* box of cells, x fastest */
    uint8_t *whole;                      /* [n] 1: all its particles would be in the body; NULL: nothing is known */
    uint8_t *absent;                     /* [n] 1: its particles are not made; NULL: all are */
    bool restored;                       /* as a checkpoint has it, whatever the start wants */
};

/* Number of the cell that holds X [m], -1: outside the box. */
static inline int64_t hollow_cell(const struct hollow *h, const real *X)
{
    int64_t cell = 0;
    for (int d = 0; d < h->dim; d++) {
        const int64_t k = (int64_t)floor((X[d] - h->anchor[d]) / h->h) - h->first[d];
        if (k < 0 || k >= h->count[d]) return -1;
        cell += k * h->stride[d];
    }
    return cell;
}

void hollow_free(struct hollow *h);

static inline bool hollow_absent(const struct hollow *h, const real *X)
{
    if (!h || !h->absent) return false;
    const int64_t cell = hollow_cell(h, X);
    return cell >= 0 && h->absent[cell];
}

#endif
