/* What a run leaves and says, and when. */
#ifndef CLEAVE_REPORT
#define CLEAVE_REPORT

#include <signal.h>

#include "output/output.h"
#include "run/run.h"

/* A sample that is being taken: it describes t_n, and its parts are taken between the phases of the step from t_n
 * (sample.h). */
struct sampling {
    bool due;
    real kinetic, work, constraint_work, absorbed; /* [J] before the step */
    real *before[DIM_MAX];                         /* velocities at its begin, where something is on the grid [m/s] */
    struct energy energy;                          /* of the positions of t_n; kinetic comes last */
    real rigid, rigid_work;                        /* of rigid bodies: kinetic at the begin; work up to t_n [J] */
    int64_t pd, bonds;                             /* peridynamic particles and directed bonds at t_n */
    real t_velocity, momentum[DIM_MAX]; /* time of the velocities before the step [s]; momentum then [kg m/s] */
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
    bool excerpt; /* the first steps of a run, for the export: no word on its balance */
    bool quiet;
    char note[96];               /* of load steps, for the progress line */
    const struct error_bar *bar; /* borrowed, for the summary; NULL: no study is at hand */
    int bars;
    const volatile sig_atomic_t *stop; /* set by a signal: checkpoint and leave; NULL: never */
};

/* Returns how many frames of the body follow the one of t = 0. */
int64_t report_frames(const struct scene *s, const struct run_clock *clock);

/* Returns the step after which frame k of the body is written, k = 0 at t = 0. */
int64_t report_frame_step(const struct scene *s, const struct run_clock *clock, int64_t k);

/* Returns bits of the series, 0 the body's, of which a frame is due once `step` steps are done; 0 without files (out
 * NULL). With solvers that are not explicit, frames are due at the start and at the end. */
unsigned report_frames_due(const struct output *out, const struct scene *s, const struct run_clock *clock,
                           int64_t step);

/* Is the step to come one of those that samples are spread over? */
bool report_sample_due(const struct scene *s, const struct run_clock *clock);
/* Before the first step of this process: history file, frame 0, first checkpoint; a restart has the last two already.
 */
status report_start(struct run *e);
/* After every step: frame, checkpoint and progress line if due; INTERRUPTED after a checkpoint if a signal came. */
status report_step(struct run *e);
/* After the last step. */
status report_end(struct run *e);
/* Returns the share of all particles that are at rest now (data/active_set.h) [1]. */
real report_inactive_share(const struct bonds *b, const struct mesh *mesh, const struct particles *p);
/* Warnings at the end: of energy and angular momentum that were not kept; of bonds that have yielded. */
void say_balance(struct run *e);
void say_yielding(struct run_report *r, const struct bonds *b, const struct scene *s, struct warnings *to);
/* What a frame is asked for that particles do not keep: made once all particles are up to date and extra->more is
 * known; freed when the frame has been begun. */
void fields_make(struct run *e, unsigned asked, struct frame_extra *extra);
void fields_free(struct frame_extra *extra);

#endif
