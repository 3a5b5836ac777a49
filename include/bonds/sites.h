#ifndef CLEAVE_SITES
#define CLEAVE_SITES

#include "bonds/bonds.h"

/* A row of consecutive lattice sites along the first axis that are within the cutoff of a particle. site: index of the
 * middle site of the row minus the index of the site of the particle; half: number of sites on each side of the
 * middle. */
struct stencil_row {
    int64_t site;
    int half;
};

/* Map from the sites of a lattice to the particles and mirror images at these sites, by which neighbours are found
 * without a search (bonds_site_map.c). All arrays are owned. */
struct lattice_site_map {
    int32_t *at;                /* [sites] particle + 1, 0: none; NULL: particles are not on a lattice */
    real low[DIM_MAX], spacing; /* position of the lowest site of the body; lattice spacing [m] */
    int64_t stride[DIM_MAX];    /* step of the site index along each axis */
    struct stencil_row *row;    /* [rows] rows of sites within the cutoff, ascending */
    int reach;                  /* cutoff, rounded down [sites] */
    int rows, most;             /* length of `row`; number of sites in these rows */
    int users;                  /* users of the map; the last one frees it */
    bool uniform; /* true: all particles are exactly on their sites and have equal volume, mass and material, so that
                     bonds follow from sites alone */
};

/* Returns the index in `map` of the lattice site at which the particle with index `particle` of p is in the reference
 * state; -1 if its position is not a site of the lattice. */
int64_t lattice_site_map_site_of_particle(const struct lattice_site_map *map, const struct particles *p,
                                          int64_t particle);

/* Creates the map `map` from lattice sites to the particles and mirror images (copies beyond planes of symmetry) of p.
 * source: inputs of the bonds (spacing, cutoff). Returns false, with nothing to release, if the particles are not on a
 * lattice. Release with lattice_site_map_free. */
bool lattice_site_map_make_if_particles_fit_lattice(struct lattice_site_map *map, const struct bond_source *source,
                                                    const struct particles *p);

/* Releases the arrays of `map`, a map from lattice sites to particles. */
void lattice_site_map_free(struct lattice_site_map *map);

/* Returns a map from lattice sites to particles for bonds that are rebuilt: `existing` with one more reference or, if
 * `existing` is NULL, a new map of the particles p. source: inputs of the bonds (horizon, materials, cracks, mirrors).
 * Release with lattice_site_map_release_reference. */
struct lattice_site_map *lattice_site_map_add_reference_or_make(struct lattice_site_map *existing,
                                                                const struct bond_source *source,
                                                                const struct particles *p);

/* Decreases the reference count of a map from lattice sites to particles that several sets of bonds use, and releases
 * the map when the count is 0. Does nothing if `map` is NULL. */
void lattice_site_map_release_reference(struct lattice_site_map *map);

/* Lists in neighbour[], ascending, the particles and mirror images (copies beyond planes of symmetry) of p within the
 * cutoff of the particle with index `particle`. map: map from lattice sites to particles, by which they are found. The
 * array `neighbour` must have at least map->most entries. Returns the number of neighbours. Returns -1 if images are
 * among them: these cannot be listed in ascending order, and the caller must search. */
int lattice_site_map_list_neighbours_of_particle(const struct lattice_site_map *map, const struct particles *p,
                                                 int32_t particle, int32_t *neighbour);

/* Returns true if a pre-crack of `source` (the inputs of the bonds) may cut a bond of the particle with index
 * `particle` of p; false if all pre-cracks are too far away. */
bool particle_is_near_precrack(const struct bond_source *source, const struct particles *p, int64_t particle);

/* Returns true if a bond of block `row_block` of eight rows of b (the bonds of eight particles of p) may lead to a
 * mirror image (copy of a particle beyond a plane of symmetry); false if certainly none does. In most blocks only the
 * last bonds are read. */
bool bond_row_block_may_have_bonds_to_mirror_images(const struct bonds *b, const struct particles *p,
                                                    int64_t row_block);

#endif
