/* What the parts of `cleave bench sif` share. */
#ifndef CLEAVE_BENCH_SIF_BENCH
#define CLEAVE_BENCH_SIF_BENCH

#include "bench/common/bench_goals.h"
#include "output/history.h"

/* ---- sif_edge.c: an edge crack at rest, finer and finer ---------------------------------------------------------- */

enum { EDGE_RINGS = 3 };
struct edge_row {
    int model; /* edge_model */
    int side;  /* particles */
    bool relaxed;
    double K, spread, steps, seconds, peak; /* [Pa m^0.5] [1] [1] [s] [bytes] */
    double ring[EDGE_RINGS];                /* K_I on 30, 50, 70 spacings */
};
enum { EDGE_ROWS_MAX = 32 };
struct edge_table {
    int n;
    struct edge_row row[EDGE_ROWS_MAX];
};
status edge_bench(struct bench_goals *asked, bool quick);

/* ---- sif_inclined.c: both modes ---------------------------------------------------------------------------------- */

status inclined_bench(struct bench_goals *asked, bool quick);

/* ---- sif_moving.c: plane waves load a crack at rest or on its way ------------------------------------------------ */

status moving_bench(struct bench_goals *asked, bool quick);

/* ---- sif_fading.c: reactions and paths --------------------------------------------------------------------------- */

status cracks_bench(struct bench_goals *asked);

#endif
