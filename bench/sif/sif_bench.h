/* What the parts of `cleave bench sif` share. */
#ifndef CLEAVE_BENCH_SIF_BENCH
#define CLEAVE_BENCH_SIF_BENCH

#include "bench/common/bench.h"
#include "output/history.h"

/* ---- bench_sif.c: runs, and figures beside their targets --------------------------------------------------------- */

/* A run of a scene as a process of its own. */
struct sif_bench_job {
    const char *path;
    struct bench_overrides overrides;
    void *row;
    /* Reads what the run left in `folder`, says it in a line. */
    status (*take)(void *row, const char *folder);
};
/* Runs jobs, `at_once` side by side with a thread each (1: one after the other with all threads). Takes what they leave
 * in the order of the jobs. */
status sif_bench_run(struct sif_bench_job *job, int n, int at_once);

/* A number of the summary, NAN where it has none. */
double sif_bench_figure(const char *folder, const char *key);

/* A target. */
struct sif_bench_target {
    char name[96];
    double measured, asked;              /* [1]: at most */
};
enum { TARGETS_MAX = 32 };
struct sif_bench_targets {
    int n;
    struct sif_bench_target target[TARGETS_MAX];
};
void sif_bench_ask(struct sif_bench_targets *t, double measured, double asked, const char *name, ...)
    __attribute__((format(printf, 4, 5)));

/* ---- sif_edge.c: an edge crack at rest, finer and finer ---------------------------------------------------------- */

enum { EDGE_RINGS = 3 };
struct edge_row {
    int model;                           /* edge_model */
    int side;                            /* particles */
    bool relaxed;
    double K, spread, steps, seconds, peak; /* [Pa m^0.5] [1] [1] [s] [bytes] */
    double ring[EDGE_RINGS];             /* K_I on 30, 50, 70 spacings */
};
enum { EDGE_ROWS_MAX = 32 };
struct edge_table {
    int n;
    struct edge_row row[EDGE_ROWS_MAX];
};
status edge_bench(struct sif_bench_targets *asked, bool quick);

/* ---- sif_inclined.c: both modes ---------------------------------------------------------------------------------- */

status inclined_bench(struct sif_bench_targets *asked, bool quick);

/* ---- sif_moving.c: plane waves load a crack at rest or on its way ------------------------------------------------ */

status moving_bench(struct sif_bench_targets *asked, bool quick);

/* ---- sif_fading.c: reactions and paths --------------------------------------------------------------------------- */

status cracks_bench(struct sif_bench_targets *asked);

#endif
