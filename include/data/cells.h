/* The search for near particles, of the body and images: fixed cells over reference positions (families of bonds). */
#ifndef CLEAVE_CELLS
#define CLEAVE_CELLS

#include "particles.h"

struct cells {
    int dim;
    int64_t count[DIM_MAX], n; /* cells per direction, in all */
    real origin[DIM_MAX];      /* lower corner [m] */
    real edge, width;          /* largest radius that is meant; of a cell [m] */
    int32_t *start;            /* particles of cell c: order[start[c] .. start[c+1]-1] */
    int32_t *order;            /* ascending inside a cell */
};

void cells_make(struct cells *c, const struct particles *p, real edge);
void cells_free(struct cells *c);

/* Particles (body and images) within `radius` <= edge of the point X, ascending; `skip` is left out (-1: none).
 * Writes at most `room` indices; returns how many there are. */
int cells_near(const struct cells *c, const struct particles *p, const real *X, real radius, int32_t skip,
               int32_t *found, int room);

/* At least as many as cells_near finds round any of the particles, themselves included; at most the count in the
 * bounding square. Cheap: it counts cells. */
int cells_most(const struct cells *c, real radius);

/* Particles near particle i, itself included if wanted, in a list that grows as needed; NULL to begin with, freed by
 * the caller. */
struct near {
    int32_t *at;
    int n, room;
};
void near_find(struct near *near, const struct cells *c, const struct particles *p, int64_t i, real radius,
               bool itself);
/* The same in the order of cells: a little faster where there are images, and as good where order does not matter. */
void near_find_any(struct near *near, const struct cells *c, const struct particles *p, int64_t i, real radius,
                   bool itself);

#endif
