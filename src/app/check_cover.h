/* Computes the share of each lattice cell that a body, or its part of one material, covers (check_cover.c). */
#ifndef CLEAVE_CHECK_COVER
#define CLEAVE_CHECK_COVER

#include "scene/scene.h"

/* A piece of a scene: a body, or the part of a body that consists of one material. body: index into scene.body. */
struct body_piece {
    const struct scene *scene;
    int body, material; /* index into scene.material; ANY_MATERIAL: the whole body */
};
enum { ANY_MATERIAL = -1 }; /* piece.material: all materials of the body */

/* Returns true if the piece p (a body, or its part of one material) contains the point X[dim] [m]. The shape of the
 * body is enlarged by `tolerance` [m] for this test. */
bool body_piece_contains_point(const struct body_piece *p, const real *X, real tolerance);

/* Computes a bounding box of the piece p (a body, or its part of one material). Stores its lower and upper corners [m]
 * in `lower` and `upper`. Returns false if the piece is unbounded, or empty as far as the boxes of its regions show. */
bool body_piece_compute_bounding_box(const struct body_piece *p, real lower[DIM_MAX], real upper[DIM_MAX]);

/* The lattice cells in the bounding box of a piece (a body, or its part of one material), one cell per possible
 * particle position. n[d]: number of cells along axis d; in the arrays, the index along x varies fastest. */
struct cell_coverage {
    int dim;
    int64_t n[DIM_MAX], cells;
    real first[DIM_MAX], spacing; /* centre of cell 0, edge of a cell [m] */
    float *share;                 /* [cells] share of the cell inside the shape [1] */
    uint8_t *filled;              /* [cells] true if a particle is in the cell */
};

/* Initialises c with the lattice cells in the bounding box of a piece (a body, or its part of one material): the share
 * of each cell that the piece covers, and whether the cell contains a particle. Release with cell_coverage_free.
 * Returns false, with nothing to release, for bodies in 1D or from a particle list, for unbounded pieces, and for more
 * cells than can be computed quickly. */
bool cell_coverage_compute_for_body_piece(struct cell_coverage *c, const struct body_piece *piece);

/* Computes the indices index[DIM_MAX] along the axes of cell number `cell` (0 .. c->cells - 1) of the lattice cells c.
 */
void cell_coverage_compute_lattice_indices_of_cell(const struct cell_coverage *c, int64_t cell, int64_t *index);

/* Frees the arrays of the covered cells *c, which cell_coverage_compute_for_body_piece has allocated. */
void cell_coverage_free(struct cell_coverage *c);

#endif
