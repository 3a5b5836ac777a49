/* Cells of two spacings of which the particles are not made: they lie wholly in the body and are part of coarse cells
 * (mesh/levels.h), far from bonds, loads and faces of pre-cracks. */
#ifndef CLEAVE_HOLLOW
#define CLEAVE_HOLLOW

#include "data/grid.h"

struct hollow {
    struct grid box; /* its cells, those of the mesh; it has no nodal arrays */
    uint8_t *whole;  /* [box.n] 1: it may lack its particles: all would be in the body, and no load,
                      * probe or pre-crack needs them; NULL: nothing is known */
    uint8_t *absent; /* [box.n] 1: its particles are not made; NULL: all are */
    bool restored;   /* as a checkpoint has it, whatever the start wants */
};

void hollow_free(struct hollow *h);

/* Is the particle at X [m] not made? h NULL: all are. */
static inline bool hollow_absent(const struct hollow *h, const real *X)
{
    int64_t cell = 0;
    if (!h || !h->absent) return false;
    for (int d = 0; d < h->box.dim; d++) {
        const int64_t k = grid_cell(&h->box, d, X[d]) - h->box.first[d];
        if (k < 0 || k >= h->box.count[d]) return false;
        cell += k * h->box.stride[d];
    }
    return h->absent[cell];
}

#endif
