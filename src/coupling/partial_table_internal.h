/* The table for partial stress on a lattice: made by partial_table.c, filled with bond responses and summed by
 * partial_responses.c. */
#ifndef CLEAVE_PARTIAL_TABLE_INTERNAL
#define CLEAVE_PARTIAL_TABLE_INTERNAL

#include "partial_parts.h"

/* Largest number of bond vectors of a table times parts of a response: a table with more remains empty. */
enum { VECTORS_MOST = 2048 };

/* Fraction of the length of a bond that is inside the cell of a point, for one bond that crosses the cell. vector,
 * direction: numbers of the vector and of the direction of the bond. Crossings are listed by the site at which the bond
 * starts. */
struct crossing {
    int16_t vector, direction;
    real share;
};

/* A lattice site that is within the length of a bond from a point, or the site of the point itself. place: number of
 * the site; at: offset from the point [spacings]. */
struct near_place {
    int16_t place, at[DIM_MAX];
};

/* Responses to strain (struct bond_strain_response) of the bonds of all rows of material points, in one entry per row,
 * by the number of the bond's vector. The values of a row are valid until one of its bonds changes. */
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
