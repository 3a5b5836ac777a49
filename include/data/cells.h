/* Search for the neighbours of a particle among particles and mirror images, with fixed cells over reference positions.
 * Bonds are made from its result. */
#ifndef CLEAVE_CELLS
#define CLEAVE_CELLS

#include "particles.h"

/* Search cells: equal squares (dim = 2) or cubes (dim = 3) that cover all particles, with a list of the particles in
 * each cell. All arrays are owned. */
struct cells {
    int dim;
    int64_t count[DIM_MAX], n; /* cells per direction; in all */
    real origin[DIM_MAX];      /* lower corner [m] */
    real edge, width;          /* largest search radius; size of a cell [m] */
    int32_t *start;            /* particles of cell c: order[start[c] .. start[c+1]-1] */
    int32_t *order;            /* ascending inside a cell */
};

/* Sorts the particles and mirror images (copies beyond planes of symmetry) of p into the search cells c by their
 * reference positions. Neighbours within a radius of up to `cell_edge` [m] can then be found. Release with
 * cells_free. */
void cells_make_for_neighbour_search(struct cells *c, const struct particles *p, real cell_edge);

/* Releases all arrays of the search cells c. */
void cells_free(struct cells *c);

/* Lists in `found`, ascending, the particles and mirror images (copies beyond planes of symmetry) of p near the point X
 * (dim components [m]): those within `radius` [m], at most c->edge. excluded_particle: index of a particle that is not
 * listed, -1 for none. Writes at most `capacity` indices. Returns the number of particles found, which may exceed
 * `capacity`. */
int cells_list_particles_near_point(const struct cells *c, const struct particles *p, const real *X, real radius,
                                    int32_t excluded_particle, int32_t *found, int capacity);

/* Returns an upper bound of the number of particles and mirror images (copies beyond planes of symmetry) within
 * `radius` [m] (at most c->edge) of any particle, including the particle itself. The bound is the largest number of
 * particles in a cell and the cells around it; no distances are computed. */
int cells_neighbour_count_upper_bound(const struct cells *c, real radius);

/* List of particle indices at[0 .. n - 1] that grows as needed; room: allocated length of `at`. Initialise it with {0}
 * and release `at` with memory_free. */
struct neighbour_list {
    int32_t *at;
    int n, room;
};

/* Lists the particles and mirror images of p within `radius` [m] of the particle with index `particle` in near->at, in
 * ascending order, and stores their number in near->n. Mirror images are copies beyond planes of symmetry. near->at is
 * enlarged if necessary. c: search cells, whose edge must be at least the radius; include_itself: true to include this
 * particle itself. */
void particles_list_neighbours_within_radius(struct neighbour_list *near, const struct cells *c,
                                             const struct particles *p, int64_t particle, real radius,
                                             bool include_itself);

/* Lists the particles and mirror images of p within `radius` [m] of the particle with index `particle` in near->at, and
 * stores their number in near->n. near->at is enlarged if necessary. The order is that of the search cells: slightly
 * faster than the ascending order of particles_list_neighbours_within_radius if there are images. c: search cells,
 * whose edge must be at least the radius; include_itself: true to include this particle itself. */
void particles_list_neighbours_unordered(struct neighbour_list *near, const struct cells *c, const struct particles *p,
                                         int64_t particle, real radius, bool include_itself);

#endif
