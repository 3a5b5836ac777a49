/* `cleave bench sif`: compares stress-intensity factors with closed forms and published tables. Declarations shared by
 * its files. */
#ifndef CLEAVE_BENCH_SIF_BENCH
#define CLEAVE_BENCH_SIF_BENCH

#include "bench/common/bench_goals.h"
#include "output/history.h"

/* ---- sif_edge.c: a static edge crack at increasing resolution ---------------------------------------------------- */

enum { EDGE_RINGS = 3 };

/* Result of a run of a plate with an edge crack: its stress-intensity factor and its cost. */
struct edge_row {
    int model; /* index in edge_model */
    int side;  /* particles along an edge */
    bool relaxed;
    double K, spread, steps, seconds, peak; /* K_I [Pa m^0.5], spread of the contours [1], steps [1], time [s], peak
                                             * memory [byte] */
    double ring[EDGE_RINGS];                /* K_I on rings of radius 30, 50, 70 spacings [Pa m^0.5] */
};
enum { EDGE_ROWS_MAX = 32 };
struct edge_table {
    int n;
    struct edge_row row[EDGE_ROWS_MAX];
};

/* Runs a static edge crack with all peridynamic models at increasing resolution, prints K_I beside the closed form, and
 * adds the goals for its error to *goals. quick: coarse resolutions only. Returns FAILED if a run or a file fails. */
status edge_crack_bench(struct bench_goals *goals, bool quick);

/* ---- sif_inclined.c: an inclined crack, both modes --------------------------------------------------------------- */

/* Runs cracks at several angles to the load, prints K_I and K_II beside values from boundary collocation, and adds the
 * goals for their errors to *goals. quick: coarse spacing. Returns FAILED if a run or a file fails. */
status inclined_crack_bench(struct bench_goals *goals, bool quick);

/* ---- sif_moving.c: plane waves load a stationary or moving crack ------------------------------------------------- */

/* Runs a stationary and a moving crack under plane waves, prints K_I(t) beside Freund's solution, and adds the goals
 * for its error to *goals. quick: two runs only. Returns FAILED if a run or a file fails. */
status moving_crack_bench(struct bench_goals *goals, bool quick);

/* ---- sif_fading.c: reactions and paths --------------------------------------------------------------------------- */

/* Runs cracks that grow with gradual release of bonds, prints reactions and paths, and adds the goals for them to
 * *goals. Returns FAILED if a run or a file fails. */
status growing_cracks_bench(struct bench_goals *goals);

#endif
