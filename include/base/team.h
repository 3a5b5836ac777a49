/* Threads, and sums that do not depend on their number. Only team.c uses hwloc (info.c reads its version). */
#ifndef CLEAVE_TEAM
#define CLEAVE_TEAM

#include "base.h"

struct machine {
    int cores, threads_allowed; /* physical cores; hardware threads in the process's mask */
    int64_t cache[4];           /* bytes of one L1d, L2, L3 cache (1..3), 0 if unknown */
    int64_t memory;             /* bytes that the process may use, 0 if unknown */
    char model[128];            /* the processor's name */
};

/* Sets the number of threads: `threads` if > 0, else OMP_NUM_THREADS, else the physical cores in the mask. Binds
 * helper thread k >= 1 to the k-th core of the mask, if there is one for each, unless the user set OMP_PROC_BIND or
 * OMP_PLACES; the calling thread goes to the first core and keeps the mask. Returns the number in use. */
int team_make(int threads);
struct machine team_machine(void);
int64_t team_memory(void);           /* of the machine, or what limits leave of it [byte]; read by team_make */
const char *team_memory_limit(void); /* what sets it: "memory of the machine", "ulimit -v", ... */

/* Physical cores that the process may use. */
int team_cores(void);
/* The cores in equal shares, for processes that run side by side; NULL where there are too few for a share each. A
 * share is taken by the calling thread, from which processes inherit it; -1 gives back what it had. */
struct core_shares *core_shares_make(int shares);
void core_share_take(const struct core_shares *s, int share);
void core_shares_free(struct core_shares *s);

/* Wall clock [s]. */
double team_clock(void);

/* Adds `n` terms in fixed blocks of SUM_BLOCK and the blocks in their order: the same bits on any number
 * of threads. `term(context, i)` must not write. */
enum { SUM_BLOCK = 1024, TERMS_MAX = 8 };
real team_sum(int64_t n, real (*term)(const void *context, int64_t i), const void *context);

/* Several sums in one pass: `block` adds the terms of first .. end-1 to the `terms` <= TERMS_MAX sums it is handed. */
void team_sums(int64_t n, int terms, void (*block)(const void *context, int64_t first, int64_t end, real *sum),
               const void *context, real *sum);

/* Where the time of a step goes. */
enum lap { LAP_BONDS, LAP_SCATTER, LAP_GRID, LAP_GATHER, LAP_CONVERT, LAP_SAMPLE, LAP_OUTPUT, LAPS };
extern const char *const lap_name[LAPS];
struct laps {
    double last, spent[LAPS];
}; /* [s] */
void laps_start(struct laps *l);
void lap(struct laps *l, enum lap which); /* books the time since the last lap (or start) on `which` */

#endif
