/* A preconditioner for stiffness matrices of particles and meshes: algebraic multigrid by smoothed aggregation, with
 * the rigid motions of bodies as coarse space (Vanek, Mandel & Brezina, Computing 56, 1996). Aggregates follow the
 * entries of the matrix, so that none crosses a crack. */
#ifndef CLEAVE_MULTIGRID
#define CLEAVE_MULTIGRID

#include "base/base.h"

/* A symmetric matrix of dim x dim blocks, one row of blocks for each node. */
struct block_matrix {
    int dim;         /* space dimension, 1 to 3 */
    int64_t n;       /* number of nodes */
    int64_t *first;  /* [n + 1] */
    int32_t *column; /* [first[n]] ascending in a row, including the diagonal */
    float *block;    /* [first[n]][dim dim] row-major [N/m] */
};

struct multigrid;

/* Builds the preconditioner M of a matrix. position [dim][n]: of the nodes [m]; held [n]: bit d is set if component
 * d is constrained. Constrained components and nodes without stiffness are left out. Unconstrained fragments are
 * allowed: M adds no resistance to their rigid motions. The matrix is kept by reference until multigrid_free,
 * position and held are copied. While bonds break, the caller may set their entries to 0 and correct the diagonal: M
 * stays positive definite, but solvers need a few more iterations (3 for a crack that grew by 8 spacings). Returns
 * FAILED, and *m is NULL, if an entry is not finite or a diagonal stiffness is negative. */
status multigrid_make(struct multigrid **m, const struct block_matrix *a, real *const *position, const uint8_t *held);

/* Computes z = M^-1 r by one V-cycle. r [dim][n, N] is not changed; z [dim][n, m] is 0 on held components. M is
 * symmetric and positive definite on the others, and bit-identical for any number of threads. */
void multigrid_apply(struct multigrid *m, real *const *r, real *const *z);

/* Frees a preconditioner, which may be NULL. */
void multigrid_free(struct multigrid *m);

#endif
