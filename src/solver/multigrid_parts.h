/* Levels of the multigrid preconditioner, and the functions that build and apply them. */
#ifndef CLEAVE_MULTIGRID_PARTS
#define CLEAVE_MULTIGRID_PARTS

#include "solver/multigrid.h"

enum { LEVELS_MOST = 12, WIDTH_MOST = 6 };

/* A sparse matrix between the nodes of a level and those of the next coarser level. */
struct transfer {
    int64_t *first;  /* [rows + 1] */
    int32_t *column; /* [first[rows]] ascending in a row */
    float *block;    /* [first[rows]][rows' width][columns' width] [1] */
};

struct level {
    int width, modes;     /* components of a node; rigid motions, which are the components of a coarser node */
    int64_t n, coarse;    /* number of nodes; number of nodes of the next level */
    const int64_t *first; /* [n + 1] */
    const int32_t *column;
    const float *single;      /* [first[n]][width width] finest level: matrix, kept by reference [N/m] */
    float *rest;              /* [n][width width] finest level: row sum of the matrix without rounding errors [N/m] */
    real *block;              /* [first[n]][width width] coarser levels: matrix [N/m] */
    real *diagonal;           /* [n][width width] diagonal blocks [N/m] */
    real *inverse;            /* [n][width width] inverse diagonal blocks, 0 on held components [m/N] */
    real *scale;              /* [n] mean stiffness of a component on the finest level; 0 if the node is held [N/m] */
    uint8_t *held;            /* [n] finest level: bit d is set if component d is constrained; else NULL */
    uint8_t *unconstrained;   /* [n] the node belongs to an unconstrained fragment; finest level: neither the node nor a
                                 neighbour is constrained */
    real *mode;               /* [n][width][modes] rigid motions                                      */
    int32_t *aggregate;       /* [n] node of the next level; -1 if none */
    real *tentative;          /* [n][width][modes] rigid motions, orthonormal in an aggregate */
    real largest;             /* largest eigenvalue of inverse x matrix, a lower bound [1] */
    struct transfer down, up; /* prolongation, a row for each node of this level; its transpose */
    real *b, *x, *y, *d, *t;  /* [n][width] load, solution, buffer of the solution, correction, residual */
};

/* The coarsest level: U'DU factorisation of its matrix; n is 0 if there is none. */
struct dense {
    int64_t n;     /* number of unknowns */
    real *upper;   /* [n][n] unit upper triangle, row major [1] */
    real *inverse; /* [n] reciprocal pivots [m/N] */
};

struct multigrid {
    int levels;
    struct level level[LEVELS_MOST];
    struct dense dense;
};

typedef real pair __attribute__((vector_size(16)));

static ALWAYS_INLINE pair pair_load(const real *from)
{
    pair a;
    memcpy(&a, from, sizeof a);
    return a;
}

/* Copies the block of entry q of row i to entry [w][w]. */
static ALWAYS_INLINE void level_entry(const struct level *l, int64_t i, int64_t q, const int w, real *entry)
{
    const bool own = l->column[q] == i;
    for (int k = 0; k < w * w; k++)
        entry[k] = own         ? l->diagonal[i * w * w + k]
                   : l->single ? (real)l->single[q * w * w + k]
                               : l->block[q * w * w + k];
}

/* Number of rows above which a parallel loop is faster than a serial one. */
enum { ROWS_MANY = 200 };

/* Loops over N rows. The loop is expanded in the caller, so that widths are literals in CALL. */
#define ROWS(N, CALL)                                                                                                  \
    do {                                                                                                               \
        TEAM_LOOP((N) > ROWS_MANY, for (int64_t i = 0; i < (N); i++) CALL;);                                           \
    } while (0)

/* Loops over N rows of NAME with the widths of `l` and of the next level as last two arguments, as literals. */
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

/* Returns the share of `scale` below which a pivot is a motion without stiffness. It is larger for unconstrained
 * fragments: springs rounded to floats resist rotations by 6e-8 of their stiffness. */
static inline real pivot_least(const struct level *l, int64_t i)
{
    return l->unconstrained[i] || l->single ? 1e-6 : 1e-13;
}

/* Inverts the diagonal blocks. Pivots without stiffness are replaced by `scale`. */
void level_invert(struct level *l);

/* Marks the nodes of the next level that belong to fragments without constrained nodes (next->unconstrained). */
void level_unconstrained(const struct level *l, struct level *next);

/* Estimates `largest` by Lanczos iterations. */
void level_largest(struct level *l);

/* Groups the nodes of a level and their neighbours into aggregates, the nodes of the next level: sets aggregate and
 * coarse. */
void level_aggregate(struct level *l);

/* Makes the rigid motions of `l` orthonormal in each aggregate (l->tentative), and sets n, width, scale and mode of the
 * next level. */
void level_modes(struct level *l, struct level *next);

/* Computes down and up: the tentative motions, smoothed by a step with the scaled matrix. */
void level_transfer(struct level *l);

/* Computes the matrix of the next level, up x matrix x down. */
void level_galerkin(const struct level *l, struct level *next);

/* Factorises the matrix of level l. Pivots without stiffness are replaced by its `scale`. */
void dense_make(struct dense *d, const struct level *l);

/* Solves for x [n] with load b [n]. */
void dense_solve(const struct dense *d, const real *b, real *x);

/* Frees the factorisation. */
void dense_free(struct dense *d);

/* Computes t = b - K x. */
void level_residual(struct level *l);

/* Computes d = keep d + step D^-1 (b - K x) and y = x + d, with D the diagonal blocks, and swaps x and y. zero: x
 * and d are 0 on entry. */
void level_relax(struct level *l, real keep, real step, bool zero);

/* Computes next->b = up t. */
void level_restrict(const struct level *l, struct level *next);

/* Computes x += down next->x. */
void level_prolong(struct level *l, const struct level *next);

#endif
