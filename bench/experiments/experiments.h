/* What the files of `cleave bench experiments` share: figures beside what laboratories and other codes have measured,
 * each with its scatter. */
#ifndef CLEAVE_EXPERIMENTS_BENCH
#define CLEAVE_EXPERIMENTS_BENCH

#include "bench/common/bench.h"
#include "output/output.h"

/* ---- bench_experiments.c: figures ---------------------------------------------------------------------------------
 */

/* A figure, in `unit`, and what is asked of it. */
struct experiment_row {
    char experiment[48], variant[48], figure[48];
    const char *unit, *source, *verdict; /* of the source: authors, year; verdict of a study of convergence, or "" */
    double spacing;                      /* the finest [mm] */
    double value, deviation, interval;   /* mean; standard, of one run; half of the 95 % interval; NAN: not known */
    double low, high;                    /* asked; NAN both: nothing is */
    int runs;                            /* of the mean */
    int coarser;                         /* the same at coarser spacings: [mm], mean, deviation */
    double coarse[2][3];
};
enum { EXPERIMENT_ROWS_MOST = 160, EXPERIMENT_PATHS_MOST = 8, EXPERIMENT_CURVES_MOST = 16 };

/* Damaged particles at the end of all runs of a study. */
struct experiment_paths {
    char title[96];
    int64_t n;
    int levels;
    double spacing[8]; /* of each level [mm] */
    float *x, *y;      /* [n] [mm] */
    uint8_t *level;    /* [n] */
};

/* Points of a curve. */
struct experiment_curve {
    char name[64];
    const char *picture;
    int64_t n;
    double *x, *y, *error;
};

struct experiments {
    bool quick;
    int n, paths, curves;
    struct experiment_row row[EXPERIMENT_ROWS_MOST];
    struct experiment_paths path[EXPERIMENT_PATHS_MOST];
    struct experiment_curve curve[EXPERIMENT_CURVES_MOST];
    char folder[64];
};

/* Adds a row and prints it. */
void experiment_add(struct experiments *x, struct experiment_row row);
/* A curve of a picture; its points. */
struct experiment_curve *experiment_curve_begin(struct experiments *x, const char *picture, const char *name, ...)
    __attribute__((format(printf, 3, 4)));
void experiment_curve_add(struct experiment_curve *c, double x, double y, double error);

/* ---- experiments_draw.c: pictures ---------------------------------------------------------------------------------
 */

status experiments_draw(struct experiments *x);

/* ---- experiments_study.c: the same scene at three spacings, with what changes nothing physical ------------------- */

/* A figure of a study: a key of summary.json, or what `measure` finds in the folder of a run (NAN: it has none), times
 * `scale`. */
struct experiment_figure {
    const char *name, *unit, *key;
    double (*measure)(const char *folder, double spacing);
    double scale, low, high;
    const char *source;
};
enum { EXPERIMENT_FIGURES_MOST = 8, EXPERIMENT_PAIRS_MOST = 8 };

struct experiment_case {
    const char *experiment, *variant;
    const char *path, *text; /* a scene of inputs/, or its text */
    struct scene_override pair[EXPERIMENT_PAIRS_MOST];
    const char *spacing[2]; /* the finest of three: in all, with --quick */
    int runs[2];            /* at each */
    bool quick, drawn;      /* is in --quick; paths are kept for the picture */
    struct experiment_figure figure[EXPERIMENT_FIGURES_MOST];
};
status experiment_study(struct experiments *x, const struct experiment_case *c);
/* Mean, standard deviation and half of the 95 % interval of the mean of those of n values that are finite; how many. */
int experiment_mean(const double *value, int n, double *mean, double *deviation, double *interval);

/* ---- experiments_branch.c: where a crack branches ---------------------------------------------------------------- */

/* The first column from which on damage lies in two or more places, more than `apart` spacings from each other, over
 * the 4 mm that follow [m]; NAN: none. The angle between the outermost branches from 2 to 10 mm behind it [degree];
 * how many there are at most. */
struct branching {
    double x, angle;
    int branches;
};
struct branching branching_find(const struct frame *f, double spacing);
double branching_place(const char *folder, double spacing);
double branching_angle(const char *folder, double spacing);
double branching_count(const char *folder, double spacing);
/* Reads the last frame of a run; free with frame_free. */
status experiment_last_frame(struct frame *f, const char *folder);
enum { EXPERIMENT_DAMAGED = 35 }; /* [%], as tips are found */

/* ---- the experiments ----------------------------------------------------------------------------------------------
 */

/* Kalthoff's plate; branching in glass. A crack through a strip that is held apart. A crack that follows a moving
 * field. A vortex whose force is chosen for it. A notched beam, a squeezed disc. */
status experiments_plates(struct experiments *x);
status experiments_strip(struct experiments *x);
status experiments_surfing(struct experiments *x);
/* What broken bonds take over the new area [J/m^2], and the mean speed over that of the field, at a spacing [m] while
 * the field (A_I K^2/E = `share` G_c) moves at `speed` c_R; c_R [m/s]. G_c is 40 J/m^2. */
struct surf_figures {
    double taken, speed;
};
status surf_run(double spacing, double share, double speed, double safety, struct surf_figures *found,
                double *rayleigh);
status experiments_vortex(struct experiments *x);
/* Error of displacements over their size at the end, at a spacing [m]. */
enum vortex_way { VORTEX_MESH, VORTEX_PD, VORTEX_PD_FAR, VORTEX_WAYS };
status vortex_run(enum vortex_way way, double spacing, double *error);
status experiments_beam(struct experiments *x);
status experiments_disc(struct experiments *x);

#endif
