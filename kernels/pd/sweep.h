/* A sweep over the active row blocks in which particles move as soon as no row still to come reads their places.
 * Rows reach at most b->reach row blocks away, so a row block moves when the sweep has come so far beyond it: its
 * data are still in the nearest cache, and neither places, velocities nor forces travel to memory twice per step.
 * Row blocks near the ends of a thread's part move after a barrier. The bits are those of all forces first, then all
 * motion. */
#ifndef CLEAVE_KERNELS_SWEEP
#define CLEAVE_KERNELS_SWEEP

#include <omp.h>

#include "pd_move.h"

enum {
    PIECE = 64,       /* row blocks whose forces are computed in a row, and that move in a row */
    AHEAD = 16,       /* row blocks of prefetch distance: about a microsecond                      */
    FETCHED = 1 << 15 /* row blocks from which on that pays: caches hold less. Then 15 % of a step, else -2 % */
};

/* A thread's part of the list of row blocks. */
struct sweep {
    const int32_t *row_block; /* active row blocks, ascending */
    int64_t first, end, all;  /* its part; of all */
    int64_t early, next;      /* the first that may move before the others are done; that moves next */
    bool diverged;
};

/* The part that a static schedule would give it. */
static ALWAYS_INLINE struct sweep sweep_make(const struct bonds *b)
{
    const int64_t threads = omp_get_num_threads(), t = omp_get_thread_num(), all = b->active.active;
    const int64_t each = all / threads, more = all % threads;
    struct sweep s = {.row_block = b->active.list, .first = t * each + (t < more ? t : more), .all = all};
    s.end = s.first + each + (t < more);
    for (s.early = s.first; t > 0 && s.early < s.end && s.row_block[s.early] - b->reach < s.row_block[s.first];)
        s.early++;
    s.next = s.early;
    return s;
}

static ALWAYS_INLINE void sweep_move(struct sweep *s, const struct bonds *b, struct particles *p, int64_t k,
                                     const struct pd_motion *m, const int dim)
{
    const int64_t g = s->row_block[k];
    s->diverged |= pd_move_eight(p, b->particle + g * LANES, eight_at(g * LANES, b->rows), m->loaded, m, dim);
}

/* Prefetches what the sweep will touch first: places at its reach, forces, velocities of the row block that moves
 * next. The processor does so by itself within a page, but a sweep has a dozen arrays. */
static ALWAYS_INLINE void sweep_fetch(const struct sweep *s, const struct bonds *b, const struct particles *p,
                                      int64_t k, const int dim)
{
    const int64_t next = s->next + k % PIECE;
    if (b->row_blocks < FETCHED || k + AHEAD >= s->end || next >= s->end) return;
    const int64_t row_block = s->row_block[k + AHEAD];
    const int32_t i = b->particle[row_block * LANES], far = i + b->reach * LANES;
    const int32_t moves = b->particle[(int64_t)s->row_block[next] * LANES];
    __builtin_prefetch(b->trigger + row_block * LANES);
    __builtin_prefetch(p->mass + moves);
    for (int d = 0; d < dim; d++) {
        __builtin_prefetch(p->x[d] + far);
        __builtin_prefetch(p->f[d] + i, 1);
        __builtin_prefetch(p->v[d] + moves, 1);
    }
}

/* The k-th row block and all before it have their forces: moves those that are far enough behind. */
static ALWAYS_INLINE void sweep_follow(struct sweep *s, const struct bonds *b, struct particles *p, int64_t k,
                                       const struct pd_motion *m, const int dim)
{
    const int64_t until = k + 1 < s->all ? s->row_block[k + 1] - b->reach : INT64_MAX;
    for (; s->next <= k && s->row_block[s->next] < until; s->next++) sweep_move(s, b, p, s->next, m, dim);
}

/* All threads have the forces of their parts: moves the rest. */
static ALWAYS_INLINE void sweep_finish(struct sweep *s, const struct bonds *b, struct particles *p,
                                       const struct pd_motion *m, const int dim)
{
    for (int64_t k = s->first; k < s->early; k++) sweep_move(s, b, p, k, m, dim);
    for (; s->next < s->end; s->next++) sweep_move(s, b, p, s->next, m, dim);
}

/* The body of a kernel: FORCE computes the forces of `row block` and returns how many bonds broke; M NULL: nothing
 * moves. */
#define SWEEP(B, P, M, D, FORCE)                                                                                       \
    int64_t broken = 0, diverged = 0;                                                                                  \
    _Pragma("omp parallel reduction(+ : broken, diverged)")                                                            \
    {                                                                                                                  \
        struct sweep s = sweep_make(B);                                                                                \
        for (int64_t k = s.first; k < s.end; k++) {                                                                    \
            const int64_t row_block = s.row_block[k];                                                                  \
            if (M) sweep_fetch(&s, B, P, k, D);                                                                        \
            broken += FORCE;                                                                                           \
            if (M && k % PIECE == 0) sweep_follow(&s, B, P, k, M, D);                                                  \
        }                                                                                                              \
        if (M) {                                                                                                       \
            if (omp_get_num_threads() > 1) {                                                                           \
                _Pragma("omp barrier")                                                                                 \
            }                                                                                                          \
            sweep_finish(&s, B, P, M, D);                                                                              \
            diverged += s.diverged;                                                                                    \
        }                                                                                                              \
    }                                                                                                                  \
    if (M) (M)->diverged |= diverged > 0;                                                                              \
    return broken

#endif
