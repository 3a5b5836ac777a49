/* Cells of two spacings in which no particles are created, since they are wholly inside the body and part of coarse
 * cells of the mesh (mesh/levels.h), far from bonds, loads and faces of pre-cracks. */
#ifndef CLEAVE_HOLLOW
#define CLEAVE_HOLLOW

#include "data/grid.h"

/* Cells of two spacings in which no particles are made, because they are wholly inside the body and belong to coarse
 * cells of the mesh (mesh/levels.h). */
struct cells_without_particles {
    struct grid box; /* its cells, equal to those of the mesh; no nodal arrays */
    uint8_t *whole;  /* [box.n] 1: the particles are dispensable: all are in the body, and no load, probe or pre-crack
                        needs them; NULL: unknown */
    uint8_t *absent; /* [box.n] 1: the particles are not made; NULL: all are made */
    bool restored;   /* true: restored from a checkpoint, and not to be determined anew at the start of the run */
};

/* Releases the arrays of `hollow`, the cells in which no particles are made. */
void cells_without_particles_free(struct cells_without_particles *hollow);

/* Returns true if the particle at the reference position X [m] is not created, because its cell is part of a coarser
 * cell (mesh/levels.h), which needs no particles. hollow: the cells without particles; NULL: all particles are created.
 */
static inline bool cells_without_particles_contain(const struct cells_without_particles *hollow, const real *X)
{
    int64_t cell = 0;
    if (!hollow || !hollow->absent) return false;
    for (int d = 0; d < hollow->box.dim; d++) {
        const int64_t k = grid_cell_index_at(&hollow->box, d, X[d]) - hollow->box.first[d];
        if (k < 0 || k >= hollow->box.count[d]) return false;
        cell += k * hollow->box.stride[d];
    }
    return hollow->absent[cell];
}

#endif
