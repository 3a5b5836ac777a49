/* floor 2: a sweep over the groups of rows that are awake, in which particles move as soon as nobody reads their places any
 * more. Rows see others at most b->reach groups away, so a group moves when the sweep has come so far beyond it: what was read
 * for its forces is still in the nearest cache, and neither places, velocities nor forces travel to memory twice in a step.
 * Who is near the ends of a thread's part waits for all threads. The same bits as first all forces, then all motion. */
#ifndef CLEAVE_SWEEP_H
#define CLEAVE_SWEEP_H

#include <omp.h>

#include "pd_move.h"

enum {
    PIECE = 64,                          /* groups whose forces are computed in a row, and that move in a row       */
    AHEAD = 16,                          /* groups until what is asked from memory is needed: about a microsecond   */
    FETCHED = 1 << 15                    /* groups from which on that pays: caches hold less. Then 15 % of a step, else -2 % */
};

/* A thread's part of the list of groups. */
struct sweep {
    const int32_t *group;                /* who is awake, ascending                                          */
    int64_t first, end, all;             /* its part; of all                                                 */
    int64_t early, next;                 /* the first that may move before the others are done; that moves next */
    bool wild;
};

/* The part that a static schedule would give it. */
static ALWAYS_INLINE struct sweep sweep_make(const struct bonds *b)
{
    const int64_t threads = omp_get_num_threads(), t = omp_get_thread_num(), all = b->rest.awake;
    const int64_t each = all / threads, more = all % threads;
    struct sweep s = {.group = b->rest.list, .first = t * each + (t < more ? t : more), .all = all};
    s.end = s.first + each + (t < more);
    for (s.early = s.first; t > 0 && s.early < s.end && s.group[s.early] - b->reach < s.group[s.first];) s.early++;
    s.next = s.early;
    return s;
}

static ALWAYS_INLINE void sweep_move(struct sweep *s, const struct bonds *b, struct particles *p, int64_t k,
                                     const struct pd_motion *m, const int dim)
{
    const int64_t g = s->group[k];
    s->wild |= pd_move_eight(p, b->particle + g * LANES, eight_at(g * LANES, b->rows), m->loaded, m, dim);
}

/* Asks memory for what the sweep will touch first: places at its reach, forces, velocities of who moves next. The machine does so
 * by itself within a page, but a sweep has a dozen arrays. */
static ALWAYS_INLINE void sweep_fetch(const struct sweep *s, const struct bonds *b, const struct particles *p, int64_t k,
                                      const int dim)
{
    const int64_t next = s->next + k % PIECE;
    if (b->groups < FETCHED || k + AHEAD >= s->end || next >= s->end) return;
    const int64_t group = s->group[k + AHEAD];
    const int32_t i = b->particle[group * LANES], far = i + b->reach * LANES;
    const int32_t moves = b->particle[(int64_t)s->group[next] * LANES];
    __builtin_prefetch(b->trigger + group * LANES);
    __builtin_prefetch(p->mass + moves);
    for (int d = 0; d < dim; d++) {
        __builtin_prefetch(p->x[d] + far);
        __builtin_prefetch(p->f[d] + i, 1);
        __builtin_prefetch(p->v[d] + moves, 1);
    }
}

/* The k-th has its forces, and all before it: moves who is far enough behind. */
static ALWAYS_INLINE void sweep_follow(struct sweep *s, const struct bonds *b, struct particles *p, int64_t k,
                                       const struct pd_motion *m, const int dim)
{
    const int64_t until = k + 1 < s->all ? s->group[k + 1] - b->reach : INT64_MAX;
    for (; s->next <= k && s->group[s->next] < until; s->next++) sweep_move(s, b, p, s->next, m, dim);
}

/* All threads have the forces of their parts: moves who is left. */
static ALWAYS_INLINE void sweep_finish(struct sweep *s, const struct bonds *b, struct particles *p, const struct pd_motion *m,
                                       const int dim)
{
    for (int64_t k = s->first; k < s->early; k++) sweep_move(s, b, p, k, m, dim);
    for (; s->next < s->end; s->next++) sweep_move(s, b, p, s->next, m, dim);
}

/* The body of a kernel: FORCE computes the forces of `group` and tells how many bonds broke; M NULL: nobody moves. */
#define SWEEP(B, P, M, D, FORCE)                                                        \
    int64_t broken = 0, wild = 0;                                                       \
    _Pragma("omp parallel reduction(+ : broken, wild)")                                 \
    {                                                                                   \
        struct sweep s = sweep_make(B);                                                 \
        for (int64_t k = s.first; k < s.end; k++) {                                     \
            const int64_t group = s.group[k];                                           \
            if (M) sweep_fetch(&s, B, P, k, D);                                         \
            broken += FORCE;                                                            \
            if (M && k % PIECE == 0) sweep_follow(&s, B, P, k, M, D);                   \
        }                                                                               \
        if (M) {                                                                        \
            if (omp_get_num_threads() > 1) { _Pragma("omp barrier") }                   \
            sweep_finish(&s, B, P, M, D);                                               \
            wild += s.wild;                                                             \
        }                                                                               \
    }                                                                                   \
    if (M) (M)->wild |= wild > 0;                                                       \
    return broken

#endif
