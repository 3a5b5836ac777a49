/* Room `step`: one step in time, its samples, reports, checks of stability. It knows every part but load steps; those
 * and the engine call it. */
#ifndef CLEAVE_REPORT
#define CLEAVE_REPORT

#include <signal.h>

#include "output/output.h"
#include "run/run.h"

/* A sample that is being taken: it describes t_n, and its parts are taken between the phases of the step from t_n
 * (engine_report.h). */
struct sampling {
    bool due;
    real kinetic, work, constraint_work, absorbed; /* [J] before the step */
    real *before[DIM_MAX];                         /* velocities at its begin, where something is on the grid [m/s] */
    struct energy energy;                          /* of the positions of t_n; kinetic comes last */
    real rigid, rigid_work;                        /* of rigid bodies: kinetic at the begin; work up to t_n [J] */
    int64_t pd, bonds;                             /* peridynamic particles and directed bonds at t_n */
    real t_velocity, momentum[DIM_MAX]; /* time of the velocities before the step [s]; momentum then [kg m/s] */
    real *motion;                       /* [scene->rigids, 2 DIM_MAX] centres [m] and velocities [m/s] at t_n */
};

/* Half-width of the 95 % interval of a figure of the summary, from a study of convergence (study/uncertainty.h). */
struct error_bar {
    char figure[NAME_MAX_LENGTH];
    double half_width;
};
enum { ERROR_BARS_MOST = 128 };

/* What a run leaves and says, and when. */
struct run_report {
    struct output *out; /* borrowed; NULL: a run without files (tests, benches) */
    struct sampling sampling;
    real *record;                  /* one line of history.csv */
    status history_status;         /* of the last line written */
    int64_t particle_steps[KINDS]; /* updates done, by kind */
    int64_t bond_visits;
    real inactive; /* inactive share of the body, summed over the steps ... */
    struct {
        real inactive;
        int64_t step;
    } sampled;                        /* ... and over those before the last sample */
    double loop_seconds, loop_before; /* in the loop, without output; by processes before a restart [s] */
    double began, started, last_progress, last_checkpoint; /* wall clock: made, first step of this process, ... [s] */
    double checkpoint_seconds;                             /* of the longest checkpoint so far */
    int64_t step_started;                                  /* first step of this process */
    bool yield_said;                                       /* bonds have yielded, and it was said how they do */
    bool trial;            /* steps are taken on trial: warnings are stored, not printed */
    struct particles more; /* points of coarse cells in the last frame, and their spacings [m] */
    real *more_spacing;
    real *more_gradient[DIM_MAX * DIM_MAX]; /* of their displacement, where frames are asked for strain [1] */
    bool excerpt;                           /* the first steps of a run, for the export: no word on its balance */
    bool quiet;
    const struct error_bar *bar; /* borrowed, for the summary; NULL: no study is at hand */
    int bars;
    const volatile sig_atomic_t *stop; /* set by a signal: checkpoint and leave; NULL: never */
};

#endif
