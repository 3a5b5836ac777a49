/* A preconditioner for stiffness matrices of particles and meshes: algebraic multigrid by smoothed aggregation, with
 * the rigid motions of bodies as coarse space (Vanek, Mandel & Brezina, Computing 56, 1996). Aggregates follow the
 * entries of the matrix, so that none crosses a crack. */
#ifndef CLEAVE_MULTIGRID
#define CLEAVE_MULTIGRID

#include "base/base.h"

/* A sparse symmetric matrix of dim x dim blocks, one row of blocks for each node (particle or node of a mesh). Block k
 * is in row i if first[i] <= k < first[i + 1], and in the column column[k]. All arrays belong to the caller. */
struct block_matrix {
    int dim;         /* space dimension, 1 to 3 */
    int64_t n;       /* number of nodes */
    int64_t *first;  /* [n + 1] */
    int32_t *column; /* [first[n]] ascending in a row, including the diagonal */
    float *block;    /* [first[n]][dim dim] row-major [N/m] */
};

struct multigrid;

/* Builds a preconditioner M of a stiffness matrix and stores it in *m. matrix: symmetric matrix, kept by reference
 * until multigrid_free; position: positions of its n nodes, dim arrays of n [m], copied; constrained: n bytes, copied,
 * with bit d set if component d of a node is constrained. Constrained components and nodes without stiffness are left
 * out. Parts of the body without constraints are allowed: M adds no resistance to their rigid motions. While bonds
 * break, the caller may set their matrix entries to 0 and correct the diagonal: M stays positive definite, but solvers
 * need a few more iterations (3 for a crack that grew by 8 spacings). Returns FAILED, with *m = NULL and a message, if
 * an entry is not finite or a diagonal stiffness is negative. */
status multigrid_make(struct multigrid **m, const struct block_matrix *matrix, real *const *position,
                      const uint8_t *constrained);

/* Computes z = M^-1 r by one multigrid V-cycle of the preconditioner m, with M the approximate stiffness matrix of
 * multigrid_make. residual: r, dim arrays of n forces [N], unchanged; result: receives z, dim arrays of n displacements
 * [m], 0 on constrained components. M is symmetric and positive definite on all others. The result is bit-identical for
 * any number of threads. */
void multigrid_apply_v_cycle(struct multigrid *m, real *const *residual, real *const *result);

/* Frees the preconditioner m, which multigrid_make has allocated; does nothing if m is NULL. The stiffness matrix stays
 * with the caller. */
void multigrid_free(struct multigrid *m);

#endif
