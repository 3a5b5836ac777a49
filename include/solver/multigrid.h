/* A preconditioner for conjugate gradients on stiffness matrices of particles and meshes: algebraic multigrid by
 * smoothed aggregation with the rigid motions of bodies as coarse motions (Vanek, Mandel, Brezina, Computing 56, 1996).
 * Aggregates follow the entries of the matrix, so that none spans a crack. */
#ifndef CLEAVE_MULTIGRID
#define CLEAVE_MULTIGRID

#include "base/base.h"

/* A symmetric matrix of dim x dim blocks, one row of blocks for each node. */
struct block_matrix {
    int dim;         /* 1, 2, 3 */
    int64_t n;       /* nodes */
    int64_t *first;  /* [n + 1] */
    int32_t *column; /* [first[n]] ascending in a row, the diagonal included */
    float *block;    /* [first[n]][dim dim] row major [N/m] */
};

struct multigrid;

/* `place` [dim][n] of the nodes [m]; `held` [n] bit d: component d is constrained, and so are nodes without stiffness:
 * their rows and columns do not count. Pieces that nothing holds are allowed: their rigid motions have no or little
 * resistance, and get none from here. The matrix is borrowed until multigrid_free; `place` and `held` are not. Where
 * bonds break, their entries may become 0 in place (and leave the diagonal): M stays positive definite, and needs some
 * more iterations, 3 for a crack that is 8 spacings longer, until it is made anew. FAILED: an entry is not finite or
 * stiffness on the diagonal negative. */
status multigrid_make(struct multigrid **m, const struct block_matrix *a, real *const *place, const uint8_t *held);

/* z = M^-1 r: a cycle, the same bits on any number of threads; M is symmetric and, on components that are not held,
 * positive definite. r [N], z [m] [dim][n]; r is only read; z is 0 where `held`. */
void multigrid_apply(struct multigrid *m, real *const *r, real *const *z);

void multigrid_free(struct multigrid *m);

#endif
