/* Levels of the multigrid preconditioner, and the steps that make and visit them. */
#ifndef CLEAVE_MULTIGRID_PARTS
#define CLEAVE_MULTIGRID_PARTS

#include "solver/multigrid.h"

enum { LEVELS_MOST = 12, WIDTH_MOST = 6 };

/* A sparse matrix between the nodes of a level and those of the next coarser one. */
struct transfer {
    int64_t *first;  /* [rows + 1] */
    int32_t *column; /* [first[rows]] ascending in a row */
    float *block;    /* [first[rows]][rows' width][columns' width] [1] */
};

struct level {
    int width, modes;     /* components of a node; rigid motions, components of a coarser node */
    int64_t n, coarse;    /* nodes; nodes of the next level */
    const int64_t *first; /* [n + 1] */
    const int32_t *column;
    const float *single;      /* [first[n]][width width] finest level: borrowed [N/m]                 */
    float *rest;              /* [n][width width] sum of a row of the finest level, but for rounding [N/m] */
    real *block;              /* [first[n]][width width] coarser levels: the matrix [N/m]             */
    real *diagonal;           /* [n][width width] blocks of the diagonal [N/m]                        */
    real *inverse;            /* [n][width width] their inverses, 0 where held [m/N]                  */
    real *scale;              /* [n] stiffness of a component on the finest level; 0: held [N/m]      */
    uint8_t *held;            /* [n] finest level: bit d: component d is constrained; else NULL       */
    uint8_t *loose;           /* [n] nothing holds the piece; finest level: nothing holds the node    */
    real *mode;               /* [n][width][modes] rigid motions                                      */
    int32_t *aggregate;       /* [n] node of the next level, -1: none                                 */
    real *tentative;          /* [n][width][modes] rigid motions orthonormal in an aggregate          */
    real largest;             /* eigenvalue of inverse x matrix, at least [1]                         */
    struct transfer down, up; /* prolongator, rows are nodes of this level; its transpose             */
    real *b, *x, *y, *d, *t;  /* [n][width] load, solution, its other buffer, correction, residual    */
};

/* The coarsest level, or NULL: U'DU of the whole matrix. */
struct dense {
    int64_t n;     /* unknowns */
    real *upper;   /* [n][n] unit upper triangle, row major [1] */
    real *inverse; /* [n] of the pivots [m/N] */
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

/* The block of entry q of row i, [w][w]. */
static ALWAYS_INLINE void level_entry(const struct level *l, int64_t i, int64_t q, const int w, real *entry)
{
    const bool own = l->column[q] == i;
    for (int k = 0; k < w * w; k++)
        entry[k] = own         ? l->diagonal[i * w * w + k]
                   : l->single ? (real)l->single[q * w * w + k]
                               : l->block[q * w * w + k];
}

/* Rows from which on calling a team takes less time than it saves. */
enum { ROWS_MANY = 200 };

/* The loop over rows stands in the instance, so that widths are literals there. */
#define ROWS(N, CALL)                                                                                                  \
    do {                                                                                                               \
        TEAM_LOOP((N) > ROWS_MANY, for (int64_t i = 0; i < (N); i++) CALL;);                                           \
    } while (0)

/* The same for every pair of widths of `l` and the next level, as the last two arguments. */
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

/* A pivot that is not above this part of `scale` is a motion without stiffness: of pieces that nothing holds more, as
 * springs rounded to floats resist rotations by 6e-8 of their stiffness. */
static inline real pivot_least(const struct level *l, int64_t i) { return l->loose[i] || l->single ? 1e-6 : 1e-13; }
/* Inverses of the blocks of the diagonal. A pivot of no stiffness becomes `scale`. */
void level_invert(struct level *l);
/* next->loose. */
void level_loose(const struct level *l, struct level *next);
/* largest, by powers of the scaled matrix. */
void level_largest(struct level *l);
/* aggregate and coarse: nodes with their neighbours. */
void level_aggregate(struct level *l);
/* tentative, and the modes of the next level; of `l` tentative, of `next` n, width, scale and mode are made. */
void level_modes(struct level *l, struct level *next);
/* down and up: the tentative motions, smoothed by a step of the scaled matrix. */
void level_transfer(struct level *l);
/* next: the matrix up x matrix x down. */
void level_galerkin(const struct level *l, struct level *next);

void dense_make(struct dense *d, const struct level *l);
void dense_solve(const struct dense *d, const real *b, real *x);
void dense_free(struct dense *d);

/* t = b - K x. */
void level_residual(struct level *l);
/* y = x + d, d = keep d + step D^-1 (b - K x), D the blocks of the diagonal; x and y are then swapped. `zero`: x and d
 * are taken for 0. */
void level_relax(struct level *l, real keep, real step, bool zero);
/* next->b = up t; x += down next->x. */
void level_restrict(const struct level *l, struct level *next);
void level_prolong(struct level *l, const struct level *next);

#endif
