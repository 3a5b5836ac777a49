/* `cleave bench experiments`: declarations shared by its files. */
#ifndef CLEAVE_EXPERIMENTS_BENCH
#define CLEAVE_EXPERIMENTS_BENCH

#include "bench/common/bench.h"
#include "output/output.h"

/* ---- bench_experiments.c: results -------------------------------------------------------------------------------- */

/* A result, its unit and the range required by an experiment or another code. */
struct experiment_row {
    char experiment[48], variant[48], figure[48];
    const char *unit, *source, *verdict; /* unit; source (authors, year); verdict of the convergence study, or "" */
    double spacing;                      /* the finest spacing [mm] */
    double value, deviation, interval;   /* mean; standard deviation of a run; half of the 95 % interval of the mean;
                                          * NAN: unknown */
    double low, high;                    /* required range; both NAN: none */
    int runs;                            /* number of runs in the mean */
    int coarser;                         /* number of results at coarser spacings, coarse[]: spacing [mm], mean,
                                          * deviation */
    double coarse[2][3];
};
enum { EXPERIMENT_ROWS_MOST = 160, EXPERIMENT_PATHS_MOST = 8, EXPERIMENT_CURVES_MOST = 16 };

/* Positions of damaged particles at the end of all runs of a study. */
struct experiment_paths {
    char title[96];
    int64_t n;
    int levels;
    double spacing[8]; /* spacing of each level [mm] */
    float *x, *y;      /* [n] position [mm] */
    uint8_t *level;    /* [n] level of the run */
};

/* Points of a curve in a picture; error: half height of the error bar. */
struct experiment_curve {
    char name[64];
    const char *picture;
    int64_t n;
    double *x, *y, *error;
};

/* State of the bench. */
struct experiments {
    bool quick;
    int n, paths, curves;
    struct experiment_row row[EXPERIMENT_ROWS_MOST];
    struct experiment_paths path[EXPERIMENT_PATHS_MOST];
    struct experiment_curve curve[EXPERIMENT_CURVES_MOST];
    char folder[64];
};

/* Adds a result and prints it. */
void experiment_add(struct experiments *x, struct experiment_row row);

/* Starts a curve of a picture. name: format of printf. Returns the curve, owned by x. */
struct experiment_curve *experiment_curve_begin(struct experiments *x, const char *picture, const char *name, ...)
    __attribute__((format(printf, 3, 4)));

/* Appends a point to a curve. */
void experiment_curve_add(struct experiment_curve *c, double x, double y, double error);

/* ---- experiments_draw.c: pictures -------------------------------------------------------------------------------- */

/* Draws all pictures. */
status experiments_draw(struct experiments *x);

/* ---- experiments_study.c: a scene at three spacings, with variations that have no physical meaning --------------- */

/* A result of a study: the value of a key of summary.json, or the return value of `measure` (NAN: none), times
 * `scale`. */
struct experiment_figure {
    const char *name, *unit, *key;
    double (*measure)(const char *folder, double spacing);
    double scale, low, high;
    const char *source;
};
enum { EXPERIMENT_FIGURES_MOST = 8, EXPERIMENT_PAIRS_MOST = 8 };

/* A scene and the results to be measured. */
struct experiment_case {
    const char *experiment, *variant;
    const char *path, *text; /* path of a scene in inputs/, or its text */
    struct scene_override pair[EXPERIMENT_PAIRS_MOST];
    const char *spacing[2]; /* finest of three spacings: normally, with --quick */
    int runs[2];            /* number of runs at each spacing */
    bool quick, drawn;      /* also run with --quick; crack paths are drawn */
    struct experiment_figure figure[EXPERIMENT_FIGURES_MOST];
};

/* Makes the convergence study of a case and adds its results. */
status experiment_study(struct experiments *x, const struct experiment_case *c);

/* Computes mean, standard deviation and half of the 95 % interval of the mean of the finite ones of n values. Returns
 * the number of finite values. */
int experiment_mean(const double *value, int n, double *mean, double *deviation, double *interval);

/* ---- experiments_branch.c: crack branching ----------------------------------------------------------------------- */

/* Branching of a crack: position x of the first column of particles from which on, over 4 mm, there is damage at two or
 * more positions with a distance above BRANCH_APART [m], NAN: none; angle between the outermost branches from 2 to 10
 * mm beyond x [degree]; largest number of branches. */
struct branching {
    double x, angle;
    int branches;
};

/* Finds the branching in a frame. spacing: of the particles [m]. */
struct branching branching_find(const struct output_frame *f, double spacing);

/* Returns the position x of the branching in the last frame of a run [m]. */
double branching_place(const char *folder, double spacing);

/* Returns the angle of the branching in the last frame of a run [degree]. */
double branching_angle(const char *folder, double spacing);

/* Returns the number of branches in the last frame of a run. */
double branching_count(const char *folder, double spacing);

/* Reads the last frame of a run. Release with frame_free. */
status experiment_last_frame(struct output_frame *f, const char *folder);
enum { EXPERIMENT_DAMAGED = 35 }; /* damage that counts as crack, as for crack tips [%] */

/* ---- the experiments --------------------------------------------------------------------------------------------- */

/* Runs Kalthoff's plate, and branching in glass. */
status experiments_plates(struct experiments *x);

/* Runs a crack through a strip whose faces are displaced apart. */
status experiments_strip(struct experiments *x);

/* Runs a crack that follows a moving field (surfing). */
status experiments_surfing(struct experiments *x);

/* Measured by surf_run: energy of broken bonds over the new crack area [J/m^2]; mean crack speed over that of the
 * field. */
struct surf_figures {
    double taken, speed;
};

/* Runs a crack in a field with A_I K^2/E = share * G_c that moves at `speed` times the Rayleigh speed. spacing: [m];
 * safety: fraction of the critical time step. Stores the results in *found and the Rayleigh speed [m/s] in *rayleigh.
 * G_c is 40 J/m^2. */
status surf_run(double spacing, double share, double speed, double safety, struct surf_figures *found,
                double *rayleigh);

/* Runs a vortex with manufactured body force. */
status experiments_vortex(struct experiments *x);

/* Numerical methods of the vortex. */
enum vortex_method { VORTEX_MESH, VORTEX_PD, VORTEX_PD_FAR, VORTEX_METHODS };

/* Runs the vortex at a spacing [m]. error: receives the displacement error at the end over the displacements. */
status vortex_run(enum vortex_method method, double spacing, double *error);

/* Runs a notched beam. */
status experiments_beam(struct experiments *x);

/* Runs a compressed disc. */
status experiments_disc(struct experiments *x);

#endif
