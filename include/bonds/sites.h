#ifndef CLEAVE_SITES
#define CLEAVE_SITES

#include "bonds/bonds.h"

/* Sites of a lattice that all particles and images stand on (bonds_site_map.c). */
struct stencil_row {
    int64_t site;
    int half;
}; /* its middle from a site; bonds reach that far either side */
struct site_map {
    int32_t *at; /* [sites] particle + 1, 0 without; NULL: no lattice */
    real low[DIM_MAX], spacing;
    int64_t stride[DIM_MAX];
    struct stencil_row *row;
    int reach, rows, most; /* most bonds that eight particles in a row can have columns for */
    int users;             /* of one that is kept: rows, and rows made anew from them */
    bool uniform;          /* exact places, one volume, mass and material: bonds follow from sites */
};
/* Of particle i, -1 where it stands on none. */
int64_t site_of(const struct site_map *l, const struct particles *p, int64_t i);
/* False, and nothing to free, where particles do not stand on one. */
bool site_map_make(struct site_map *l, const struct bond_source *s, const struct particles *p);
void site_map_free(struct site_map *l);
/* A map that rows hand on to those made anew from them, the one that there is or a new one; and back. */
struct site_map *site_map_keep(struct site_map *of, const struct bond_source *s, const struct particles *p);
void site_map_leave(struct site_map *l);
/* Particles and images of the body of particle i within the cutoff, ascending, by the map. Returns how many there are;
 * -1: an image is among them, which would come out of order. */
int site_map_family(const struct site_map *l, const struct particles *p, int32_t i, int32_t *found);

/* Can a crack cut any bond of particle i? */
bool cracks_near(const struct bond_source *s, const struct particles *p, int64_t i);

#endif
