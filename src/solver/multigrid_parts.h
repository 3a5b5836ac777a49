/* Declares the levels of the multigrid preconditioner, and the functions that build and apply them. */
#ifndef CLEAVE_MULTIGRID_PARTS
#define CLEAVE_MULTIGRID_PARTS

#include "solver/multigrid.h"

/* MULTIGRID_LEVELS_MOST: largest number of levels. WIDTH_MOST: largest number of components of a node, which are
 * displacements on the finest level and may be rigid motions on coarser levels. */
enum { MULTIGRID_LEVELS_MOST = 12, WIDTH_MOST = 6 };

/* A sparse matrix of blocks between the nodes of a level and those of the next coarser level: the prolongation or its
 * transpose, the restriction. */
struct transfer {
    int64_t *first;  /* [rows + 1] the blocks of row r are first[r] .. first[r + 1] - 1 */
    int32_t *column; /* [first[rows]] node of the other level, ascending in a row */
    float *block;    /* [first[rows]][components of a row node][components of a column node] [1] */
};

/* One level of the multigrid preconditioner; level 0, the finest, has the nodes of the solver. A node of the next level
 * is an aggregate of nodes, whose rigid motions are its components. Arrays are owned unless noted. */
struct multigrid_level {
    int width, modes;         /* components of a node; rigid motions, which are the components of a coarser node */
    int64_t n, coarse;        /* number of nodes; number of nodes of the next level */
    const int64_t *first;     /* [n + 1] the matrix entries of node i are first[i] .. first[i + 1] - 1 */
    const int32_t *column;    /* [first[n]] neighbouring node of each entry, ascending in a row */
    const float *single;      /* [first[n]][width width] finest level: matrix, kept by reference [N/m] */
    float *rest;              /* [n][width width] finest level: row sum of the matrix without rounding errors [N/m] */
    real *block;              /* [first[n]][width width] coarser levels: matrix [N/m] */
    real *diagonal;           /* [n][width width] diagonal blocks [N/m] */
    real *inverse;            /* [n][width width] inverse diagonal blocks, 0 on held components [m/N] */
    real *scale;              /* [n] mean stiffness of a component on the finest level; 0 if the node is held [N/m] */
    uint8_t *held;            /* [n] finest level: bit d is set if component d is constrained; else NULL */
    uint8_t *unconstrained;   /* [n] the node belongs to an unconstrained fragment; finest level: neither the node nor a
                                 neighbour is constrained */
    real *mode;               /* [n][width][modes] rigid motions at the node */
    int32_t *aggregate;       /* [n] index of the aggregate, a node of the next level; -1: none */
    real *tentative;          /* [n][width][modes] rigid motions, made orthonormal within each aggregate */
    real largest;             /* largest eigenvalue of inverse x matrix, a lower bound [1] */
    struct transfer down, up; /* prolongation, a row for each node of this level; its transpose */
    real *b, *x, *y, *d, *t;  /* [n][width] load, solution, buffer of the solution, correction, residual */
};

/* Factorised matrix U^T D U of the coarsest level of a multigrid preconditioner, with the unit upper triangular matrix
 * U and the diagonal matrix D. n is 0 if the level has no matrix. Owned by struct multigrid. */
struct dense_factorisation {
    int64_t n;     /* number of unknowns */
    real *upper;   /* [n][n] unit upper triangle, row major [1] */
    real *inverse; /* [n] reciprocal pivots [m/N] */
};

/* One multigrid preconditioner: its levels, of which level[0] is the finest, and the factorised matrix of the coarsest
 * level. Owned by the solver that uses it. */
struct multigrid {
    int levels;
    struct multigrid_level level[MULTIGRID_LEVELS_MOST];
    struct dense_factorisation dense;
};

typedef real pair __attribute__((vector_size(16)));

/* Returns two consecutive values from memory as a vector; `values` need not be aligned. */
static ALWAYS_INLINE pair lane_pair_load(const real *values)
{
    pair a;
    memcpy(&a, values, sizeof a);
    return a;
}

/* Copies the matrix block in row `row`, at entry `column_entry` of l->column, to `block`: width x width values row by
 * row [N/m]. width: number of components of a node of level l. The diagonal block is read from l->diagonal, others from
 * l->single or l->block. */
static ALWAYS_INLINE void multigrid_copy_matrix_block(const struct multigrid_level *l, int64_t row,
                                                      int64_t column_entry, const int width, real *block)
{
    const bool own = l->column[column_entry] == row;
    for (int k = 0; k < width * width; k++)
        block[k] = own         ? l->diagonal[row * width * width + k]
                   : l->single ? (real)l->single[column_entry * width * width + k]
                               : l->block[column_entry * width * width + k];
}

/* Number of rows above which a loop on all threads is faster than one in a single thread. */
enum { ROWS_MANY = 200 };

/* Executes the expression or statement CALL for the rows i = 0 .. N - 1, on all threads if there are more than
 * ROWS_MANY rows. The loop is expanded in the caller, so that the compiler knows constant arguments of CALL. */
#define ROWS(N, CALL)                                                                                                  \
    do {                                                                                                               \
        TEAM_LOOP((N) > ROWS_MANY, for (int64_t i = 0; i < (N); i++) CALL;);                                           \
    } while (0)

/* Calls NAME(..., w, m) in a loop over N rows with l->width = w and l->modes = m, the numbers of components of a node
 * of level l and of the next coarser level. Both are passed as constants (1 1, 2 3, 3 6, 3 3 or 6 6), for which the
 * compiler unrolls loops. */
#define BY_WIDTHS(N, NAME, ...)                                                                                        \
    do {                                                                                                               \
        const int kind_ = 10 * l->width + l->modes;                                                                    \
        if (kind_ == 11)                                                                                               \
            ROWS(N, NAME(__VA_ARGS__, 1, 1));                                                                          \
        else if (kind_ == 23)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 2, 3));                                                                          \
        else if (kind_ == 36)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 3, 6));                                                                          \
        else if (kind_ == 33)                                                                                          \
            ROWS(N, NAME(__VA_ARGS__, 3, 3));                                                                          \
        else                                                                                                           \
            ROWS(N, NAME(__VA_ARGS__, 6, 6));                                                                          \
    } while (0)

/* Returns the fraction of the mean stiffness l->scale below which a pivot of the diagonal block of node `node` counts
 * as zero, i.e. as a motion without stiffness. The fraction is larger on the finest level, whose stiffnesses are
 * rounded to floats, and in unconstrained fragments (parts of the body that no support holds): rounding to floats gives
 * their rotations a spurious stiffness of 6e-8 of the entries. */
static inline real multigrid_relative_zero_pivot_tolerance(const struct multigrid_level *l, int64_t node)
{
    return l->unconstrained[node] || l->single ? 1e-6 : 1e-13;
}

/* Computes l->inverse, the inverse of the diagonal block of each node of a level. Pivots without stiffness
 * (multigrid_relative_zero_pivot_tolerance) are replaced by the mean stiffness l->scale. */
void multigrid_invert_diagonal_blocks(struct multigrid_level *l);

/* Finds the nodes of the next coarser level, `coarser_level`, that belong to fragments without constrained nodes, from
 * those of level l, and stores them in coarser_level->unconstrained. */
void multigrid_find_unconstrained_coarse_nodes(const struct multigrid_level *l, struct multigrid_level *coarser_level);

/* Estimates l->largest, the largest eigenvalue of D^-1 K, by Lanczos iterations, whose result is a lower bound. K:
 * matrix of level l; D: its diagonal blocks. */
void multigrid_estimate_largest_eigenvalue(struct multigrid_level *l);

/* Groups the nodes of level l with their neighbours in the matrix into aggregates, each of which becomes a node of the
 * next coarser level: sets l->aggregate and l->coarse, the number of aggregates. */
void multigrid_aggregate_nodes(struct multigrid_level *l);

/* Makes the rigid motions of the nodes of level l orthonormal within each aggregate (l->tentative), and sets number,
 * width, scale and rigid motions of the nodes of the next coarser level, `coarser_level`. */
void multigrid_compute_coarse_rigid_motions(struct multigrid_level *l, struct multigrid_level *coarser_level);

/* Computes the prolongation l->down from the next coarser level to level l, and its transpose l->up, the restriction.
 * The prolongation is P - step D^-1 K P: the orthonormal rigid motions P of the aggregates of nodes, smoothed by one
 * step with the matrix K of the level and its diagonal blocks D. multigrid_free releases both. */
void multigrid_compute_prolongation_and_restriction(struct multigrid_level *l);

/* Computes the matrix of the next coarser level, `coarser_level`, by the Galerkin product: l->up times the matrix of
 * level l times l->down. multigrid_free releases it. */
void multigrid_compute_coarse_matrix(const struct multigrid_level *l, struct multigrid_level *coarser_level);

/* Factorises the matrix K of level l, the coarsest one, as K = U^T D U, with the upper triangular matrix U and the
 * diagonal matrix D, and stores U and D^-1 in *d. Pivots without stiffness are replaced by the mean stiffness l->scale.
 * Release with multigrid_free_coarsest_factorisation. */
void multigrid_factorise_coarsest_matrix(struct dense_factorisation *d, const struct multigrid_level *l);

/* Solves K x = b with the factorisation `d` of the matrix K by multigrid_factorise_coarsest_matrix. load: b, d->n
 * values; solution: receives x, d->n values. */
void multigrid_solve_coarsest_level(const struct dense_factorisation *d, const real *load, real *solution);

/* Frees the arrays of *d, the factorisation that multigrid_factorise_coarsest_matrix has made of the matrix of the
 * coarsest level. */
void multigrid_free_coarsest_factorisation(struct dense_factorisation *d);

/* Computes the residual l->t = l->b - K l->x of level l from the load l->b, the solution l->x and the matrix K of the
 * level. */
void multigrid_compute_residual(struct multigrid_level *l);

/* Does one step of a polynomial smoother on level l: d = previous_correction_factor d + residual_factor D^-1 (b - K x)
 * and x = x + d, with the load b = l->b, the solution x = l->x, the correction d = l->d, the matrix K of the level and
 * its diagonal blocks D. start_from_zero: true if x and d are 0 on entry, which saves the product K x. */
void multigrid_apply_polynomial_smoother_step(struct multigrid_level *l, real previous_correction_factor,
                                              real residual_factor, bool start_from_zero);

/* Computes the load of the next coarser level from the residual of level l: coarser_level->b = l->up l->t, with the
 * restriction matrix l->up. */
void multigrid_restrict_residual(const struct multigrid_level *l, struct multigrid_level *coarser_level);

/* Adds the solution of the next coarser level to the solution of level l: l->x += l->down coarser_level->x, with the
 * prolongation matrix l->down. */
void multigrid_prolong_correction(struct multigrid_level *l, const struct multigrid_level *coarser_level);

#endif
