/* Loop over the active blocks of eight rows (rows of bonds of eight particles) that computes forces and moves a
 * particle as soon as no later row reads its position. Bonds reach at most b->reach blocks, so a block is moved once
 * the loop is that far beyond it: its data are still in the nearest cache, and positions, velocities and forces travel
 * to memory once per step. Blocks near the ends of a thread's part are moved after a barrier. Results are bitwise equal
 * to those of all forces first, then all motion. */
#ifndef CLEAVE_KERNELS_SWEEP
#define CLEAVE_KERNELS_SWEEP

#include <omp.h>

#include "pd_move.h"

enum {
    PIECE = 64,       /* blocks of eight rows between two calls of bond_sweep_advance_finished_particles */
    AHEAD = 16,       /* prefetch distance in blocks of eight rows: about a microsecond */
    FETCHED = 1 << 15 /* smallest number of blocks of eight rows for prefetching (smaller bodies fit in caches): saves
                         15 % of a step there, costs 2 % below */
};

/* The part of the list of active blocks of eight rows (bonds of eight particles, not at rest) that one thread
 * processes, and its progress in moving particles. diverged: true if a moved particle is too fast or not finite. */
struct bond_sweep {
    const int32_t *row_block; /* active blocks of eight rows, ascending */
    int64_t first, end, all;  /* entries first .. end-1 of `all` entries are this thread's */
    /* first entry that may be moved before other threads have finished their forces; next entry to move */
    int64_t early, next;
    bool diverged;
};

/* Returns the part of the list of active (not resting) blocks of eight rows of b that the calling thread processes. A
 * block holds the bonds of eight particles. The threads of the team get equal parts of the list in order, as by
 * schedule(static). */
static ALWAYS_INLINE struct bond_sweep bond_sweep_get_row_blocks_of_thread(const struct bonds *b)
{
    const int64_t threads = omp_get_num_threads(), t = omp_get_thread_num(), all = b->active.active;
    const int64_t each = all / threads, more = all % threads;
    struct bond_sweep s = {.row_block = b->active.list, .first = t * each + (t < more ? t : more), .all = all};
    s.end = s.first + each + (t < more);
    for (s.early = s.first; t > 0 && s.early < s.end && s.row_block[s.early] - b->reach < s.row_block[s.first];)
        s.early++;
    s.next = s.early;
    return s;
}

/* Advances the particles of entry k (from 0) in the list of active blocks of eight rows of b (bonds of eight particles
 * of p) by a leap-frog step with the step sizes of m. Sets s->diverged if one of the particles has diverged, i.e. is
 * too fast or not finite. */
static ALWAYS_INLINE void bond_sweep_advance_particles_of_row_block(struct bond_sweep *s, const struct bonds *b,
                                                                    struct particles *p, int64_t k,
                                                                    const struct pd_motion *m, const int dim)
{
    const int64_t g = s->row_block[k];
    s->diverged |= pd_advance_up_to_eight_particles(
        p, b->particle + g * LANES, count_of_next_eight_indices_below_limit(g * LANES, b->rows), m->loaded, m, dim);
}

/* Prefetches the data of b and p that the loop over active blocks of eight rows (bonds of eight particles each) needs
 * next. s: part of the list of this thread; k: index of the present block in the list. Fetched are the forces and
 * breaking limits of the block AHEAD entries further on, the positions of its farthest neighbours, and mass and
 * velocities of the block that is moved next. Hardware prefetching follows consecutive lines within a page, but not a
 * dozen arrays. */
static ALWAYS_INLINE void bond_sweep_prefetch_next_blocks(const struct bond_sweep *s, const struct bonds *b,
                                                          const struct particles *p, int64_t k, const int dim)
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

/* Advances in time the particles of p whose positions no later block of eight rows (bonds of eight particles each) of
 * this thread reads. s: part of the list of active blocks of b that this thread processes; k: present entry of the list
 * of active blocks; the forces of this entry and of all entries before it must be complete. m: step sizes. */
static ALWAYS_INLINE void bond_sweep_advance_finished_particles(struct bond_sweep *s, const struct bonds *b,
                                                                struct particles *p, int64_t k,
                                                                const struct pd_motion *m, const int dim)
{
    const int64_t until = k + 1 < s->all ? s->row_block[k + 1] - b->reach : INT64_MAX;
    for (; s->next <= k && s->row_block[s->next] < until; s->next++)
        bond_sweep_advance_particles_of_row_block(s, b, p, s->next, m, dim);
}

/* Advances in time those particles of p of this thread's blocks of eight rows (bonds of eight particles in b, part s of
 * the list) that have not been moved yet: the first blocks, whose positions the previous thread may have read, and the
 * last ones. To be called when all threads have finished their forces. m: step sizes. */
static ALWAYS_INLINE void bond_sweep_advance_remaining_particles(struct bond_sweep *s, const struct bonds *b,
                                                                 struct particles *p, const struct pd_motion *m,
                                                                 const int dim)
{
    for (int64_t k = s->first; k < s->early; k++) bond_sweep_advance_particles_of_row_block(s, b, p, k, m, dim);
    for (; s->next < s->end; s->next++) bond_sweep_advance_particles_of_row_block(s, b, p, s->next, m, dim);
}

/* Defines the body of a force kernel, with the return statement: a parallel loop over the active blocks of eight rows
 * of B. FORCE: expression that computes the forces of `row_block` and returns the number of bonds broken; M: step sizes
 * with which particles of P are moved in the same loop (D dimensions), NULL: none is moved. The kernel returns the
 * number of bonds broken, each counted once for each of its particles, and sets M->diverged if a particle has
 * diverged. */
#define SWEEP(B, P, M, D, FORCE)                                                                                       \
    int64_t broken = 0, diverged = 0;                                                                                  \
    _Pragma("omp parallel reduction(+ : broken, diverged)")                                                            \
    {                                                                                                                  \
        struct bond_sweep s = bond_sweep_get_row_blocks_of_thread(B);                                                  \
        for (int64_t k = s.first; k < s.end; k++) {                                                                    \
            const int64_t row_block = s.row_block[k];                                                                  \
            if (M) bond_sweep_prefetch_next_blocks(&s, B, P, k, D);                                                    \
            broken += FORCE;                                                                                           \
            if (M && k % PIECE == 0) bond_sweep_advance_finished_particles(&s, B, P, k, M, D);                         \
        }                                                                                                              \
        if (M) {                                                                                                       \
            if (omp_get_num_threads() > 1) {                                                                           \
                _Pragma("omp barrier")                                                                                 \
            }                                                                                                          \
            bond_sweep_advance_remaining_particles(&s, B, P, M, D);                                                    \
            diverged += s.diverged;                                                                                    \
        }                                                                                                              \
    }                                                                                                                  \
    if (M) (M)->diverged |= diverged > 0;                                                                              \
    return broken

#endif
