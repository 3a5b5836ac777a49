/* Computes the share of each lattice cell that a body, or its part of one material, covers (check_cover.c). */
#ifndef CLEAVE_CHECK_COVER
#define CLEAVE_CHECK_COVER

#include "scene/scene.h"

/* A body, or its part of one material. */
struct piece {
    const struct scene *scene;
    int body, material; /* index into scene.material; ANY_MATERIAL: the whole body */
};
enum { ANY_MATERIAL = -1 };

/* Returns true if the piece contains X [m]. The shape of the body is enlarged by `tolerance` [m]. */
bool piece_contains(const struct piece *p, const real *X, real tolerance);

/* Computes a bounding box of the piece [m]. Returns false if the piece is unbounded, or has no known point. */
bool piece_bounding_box(const struct piece *p, real lower[DIM_MAX], real upper[DIM_MAX]);

/* Lattice cells of the bounding box of a piece, one per particle position; x varies fastest. */
struct cover {
    int dim;
    int64_t n[DIM_MAX], cells;
    real first[DIM_MAX], spacing; /* centre of cell 0, edge of a cell [m] */
    float *share;                 /* [cells] share of the cell inside the shape [1] */
    uint8_t *filled;              /* [cells] true if a particle is in the cell */
};

/* Computes the cells of a piece. Returns false, with nothing to release, for bodies in 1D or from a list, for
 * unbounded pieces, and for more cells than can be computed quickly. */
bool piece_cover_make(struct cover *c, const struct piece *piece);

/* Writes the indices of a cell along the axes to index[DIM_MAX]. */
void cover_cell_indices(const struct cover *c, int64_t cell, int64_t *index);

void piece_cover_free(struct cover *c);

#endif
