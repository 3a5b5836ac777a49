/* Stiffness matrix of one cell of the mesh that has missing or unequal points, and the arguments of its computation. */
#ifndef CLEAVE_CELL_STIFFNESS
#define CLEAVE_CELL_STIFFNESS

#include "mesh_parts.h"

enum { TERMS_MAX = 3 }; /* largest number of terms of the strain field of a mode */

/* One term of the strain field of a deformation mode of a cell. It adds to symmetric component `row` of the strain:
 * `factor` times the amplitude of the mode, times the product of the signs of the coordinates along the axes in the bit
 * set `set`. */
struct mode_term {
    uint8_t row, set;
    real factor;
};
/* Strain field of one deformation mode of a cell: the sum of the n terms at[n]. */
struct mode_terms {
    int n;
    struct mode_term at[TERMS_MAX];
};

/* Arguments that the functions for stiffness matrices of cells with own stiffness have in common (cells with missing or
 * unequal points): mesh, particles, material data, and numbers of modes and strain components. Made by cell_maker_make.
 */
struct cell_maker {
    const struct mesh *mesh;
    const struct particles *p;
    const struct mesh_source *source;
    int dim, modes, columns; /* dimension; number of modes; columns of D: symmetric components */
    real (*whole)[SYM_MAX * SYM_MAX], (*isotropic)[SYM_MAX * SYM_MAX]; /* [materials] stress by strain */
    struct mode_terms in[MODES_MAX];                                   /* [modes] strain field of each mode */
};

/* Returns the parameters for computing the stiffness matrices of the cells with own stiffness of the mesh (cells with
 * missing points, partial stresses, several materials or doubled nodes) from particles p and material data s. Release
 * the member `whole` with memory_free. */
struct cell_maker cell_maker_make(const struct mesh *mesh, const struct particles *p, const struct mesh_source *s);

/* Strain of the points of a cell by its modes: [point][symmetric component][mode] [1]; shear strains are angles. */
typedef real point_strains[CORNERS_MAX][SYM_MAX][MODES_MAX];

/* Computes B, the strains of the points of cell I for unit amplitudes of its deformation modes. All points of a
 * material in the cell have their mean dilatation (mesh_law.h). c: mesh and particles. Returns false, without values,
 * if no material of the cell has a mean dilatation. */
bool cell_compute_averaged_strains(const struct cell_maker *c, int64_t I, point_strains B);

/* Computes the stiffness matrix of cell with own stiffness I (a cell with missing or unequal points, which has a
 * stiffness matrix of its own), in terms of its deformation modes [Pa], and stores its upper half row by row. c: mesh
 * and particles. K: address of the first entry; the next entries follow at distances of LANES, since the matrices of
 * LANES cells are interleaved. The lower half is not stored, since the matrix is symmetric up to round-off. */
void cell_compute_own_stiffness(const struct cell_maker *c, int64_t I, real *K);

#endif
