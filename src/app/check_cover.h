/* Share of each lattice cell that a body, or the part of it that is of one material, covers (check_cover.c). */
#ifndef CLEAVE_CHECK_COVER
#define CLEAVE_CHECK_COVER

#include "scene/scene.h"

/* The points of a body, or those of one of its materials. */
struct piece {
    const struct scene *scene;
    int body, material; /* index into scene.material; ANY_MATERIAL: the whole body */
};
enum { ANY_MATERIAL = -1 };

/* Does the piece contain X? The shape of the body is grown by `tolerance` [m]. */
bool piece_contains(const struct piece *p, const real *X, real tolerance);

/* Computes a box round the piece [m]. Returns false if the piece has no end, or no point of it is known. */
bool piece_bounds(const struct piece *p, real from[DIM_MAX], real to[DIM_MAX]);

/* Lattice cells of the box round a piece, each about the position of a particle; x varies fastest. */
struct cover {
    int dim;
    int64_t n[DIM_MAX], cells;
    real first[DIM_MAX], spacing; /* place of cell 0 [m] */
    float *share;                 /* [cells] that lies in the shape [1] */
    uint8_t *filled;              /* [cells] does a particle stand there? */
};

/* Computes the cells of a piece. Returns false, with nothing to free, for bodies in a line or from a list, for pieces
 * without an end, and for more cells than are quick to compute. */
bool cover_make(struct cover *c, const struct piece *p);
void cover_place(const struct cover *c, int64_t cell, int64_t *at);
void cover_free(struct cover *c);

#endif
