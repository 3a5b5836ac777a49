#ifndef CLEAVE_SITES
#define CLEAVE_SITES

#include "bonds/bonds.h"

/* Row of lattice sites within the cutoff: index of its middle site relative to the particle's, and half its length in
 * sites. */
struct stencil_row {
    int64_t site;
    int half;
};

/* Map of the sites of a lattice to particles and images (bonds_site_map.c). */
struct site_map {
    int32_t *at;                /* [sites] particle + 1, 0: none; NULL: particles are not on a lattice */
    real low[DIM_MAX], spacing; /* position of the lowest site of the body; lattice spacing [m] */
    int64_t stride[DIM_MAX];    /* step of the site index along each axis */
    struct stencil_row *row;    /* [rows] rows of sites within the cutoff, ascending */
    int reach;                  /* cutoff, rounded down [sites] */
    int rows, most;             /* length of `row`; number of sites in these rows */
    int users;                  /* users of the map; the last one frees it */
    bool uniform;               /* exact positions, one volume, mass and material: bonds follow from sites */
};

/* Returns the site of particle i, -1 if it is not at a site. */
int64_t site_of(const struct site_map *l, const struct particles *p, int64_t i);

/* Creates the map. Returns false, with nothing to release, if the particles are not on a lattice. */
bool site_map_make(struct site_map *l, const struct bond_source *s, const struct particles *p);

/* Releases the map. */
void site_map_free(struct site_map *l);

/* Returns the site map that rows share when they are rebuilt: `of` if it is not NULL, else a new one. Release with
 * site_map_leave. */
struct site_map *site_map_keep(struct site_map *of, const struct bond_source *s, const struct particles *p);

/* Releases a shared site map; the last user frees it. NULL: does nothing. */
void site_map_leave(struct site_map *l);

/* Lists the particles and images of the body of particle i within the cutoff, ascending, from the map. Returns their
 * number, or -1 if an image is among them, which would break the order. */
int site_map_family(const struct site_map *l, const struct particles *p, int32_t i, int32_t *found);

/* Returns true if a crack may cut a bond of particle i. */
bool cracks_near(const struct bond_source *s, const struct particles *p, int64_t i);

#endif
