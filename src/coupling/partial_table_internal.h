/* Defines the table for partial stress on a lattice (stress that bonds carry through the cells of material points). It
 * is made by partial_table.c, filled with strain responses of bonds and summed by partial_responses.c. */
#ifndef CLEAVE_PARTIAL_TABLE_INTERNAL
#define CLEAVE_PARTIAL_TABLE_INTERNAL

#include "partial_parts.h"

/* Largest product of the number of bond vectors of a table and the number of terms of a strain response (one or two). A
 * table with a larger product remains empty. */
enum { VECTORS_MOST = 2048 };

/* A bond that crosses the cell of a material point. vector, direction: indices of its vector and of its direction,
 * which a vector and its opposite have in common; share: fraction of its length inside the cell [1]. The table lists
 * crossings by the lattice site at which the bond starts. */
struct crossing {
    int16_t vector, direction;
    real share;
};

/* A lattice site within the length of a bond from a point, or the site of the point itself. place: number of the site
 * (see struct bond_fraction_table); at: offset from the point [spacings]. */
struct near_place {
    int16_t place, at[DIM_MAX];
};

/* Strain responses (struct bond_strain_response) of the bonds of material points. Each point with an intact bond has
 * one entry, which contains a response for each bond vector and is valid until a bond of the point changes. */
struct responses {
    int32_t *of;    /* [n] entry of a particle, -1: no row with an intact bond */
    real *response; /* [room][vectors][parts] */
    int64_t n, room, frees;
    int32_t *free; /* [room] unused entries, the first `frees` */
};

/* Table for one lattice: the fractions of all possible bonds inside the cell of a point, and the tensors of these
 * bonds. Sites are numbered like the cells of a cube with the point in the middle and `reach` cells on either side. */
struct bond_fraction_table {
    int dim, reach, parts, size; /* dimension; reach of bonds [cells]; parts of a response; values of a tensor */
    real spacing, per_spacing;   /* lattice spacing [m]; 1/spacing [1/m] */
    int vectors, directions;     /* vectors of bonds; directions, i.e. pairs of a vector and its opposite */
    struct near_place *near;     /* [vectors + 1] sites within the length of a bond, ascending by number */
    int16_t *vector;             /* [sites] number of the vector to a site, -1: no bond */
    int16_t *mirror;             /* [2^dim][vectors] number of the vector with reversed signs */
    int32_t *start;              /* [sites + 1] crossings of bonds from a site: start[k] .. start[k + 1] - 1 */
    struct crossing *crossing;   /* bonds that cross the cell of the point */
    real *tensor;                /* [directions][parts][size] tensors of unit responses */
    bool uniform;                /* all particles have the volume of a lattice cell */
    struct responses responses;
};

#endif
