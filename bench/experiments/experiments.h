/* `cleave bench experiments`: compares cracks with published experiments and other codes. Declarations shared by its
 * files. */
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

/* Results of `cleave bench experiments` so far, numbers and curves for the pictures. */
struct experiments {
    bool quick;
    int n, paths, curves;
    struct experiment_row row[EXPERIMENT_ROWS_MOST];
    struct experiment_paths path[EXPERIMENT_PATHS_MOST];
    struct experiment_curve curve[EXPERIMENT_CURVES_MOST];
    char folder[64];
};

/* Appends a copy of `result`, a measured quantity with its required range, to x and prints it. */
void experiment_add_and_print_result(struct experiments *x, struct experiment_row result);

/* Adds an empty curve to x. picture: name of the picture in which it is drawn; name: title of the curve, a format of
 * printf followed by its arguments. Returns the curve, which is part of x. */
struct experiment_curve *experiment_add_empty_curve(struct experiments *x, const char *picture, const char *name, ...)
    __attribute__((format(printf, 3, 4)));

/* Appends the point (x, y) to the curve c. error_bar_half_height: half height of the error bar of the point, in the
 * unit of y; NAN: no error bar. */
void experiment_curve_append_point(struct experiment_curve *c, double x, double y, double error_bar_half_height);

/* ---- experiments_draw.c: pictures -------------------------------------------------------------------------------- */

/* Draws all pictures from the results, curves and crack paths of x. Returns FAILED if a picture cannot be drawn. */
status experiments_draw_all_pictures(struct experiments *x);

/* ---- experiments_study.c: a scene at three spacings, with variations that have no physical meaning --------------- */

/* A quantity that is measured in every run of a study: the number `key` of its summary.json or, if `key` is NULL, the
 * return value of measure(folder of the run, spacing [m]), times `scale`. NAN: the run does not have it. low, high:
 * required range, both NAN for none; source: of the range. */
struct experiment_figure {
    const char *name, *unit, *key;
    double (*measure)(const char *folder, double spacing);
    double scale, low, high;
    const char *source;
};
enum { EXPERIMENT_FIGURES_MOST = 8, EXPERIMENT_PAIRS_MOST = 8 };

/* A scene, and the quantities that are measured in its convergence study. pair: overrides of the scene. */
struct experiment_case {
    const char *experiment, *variant;
    const char *path, *text; /* path of a scene in inputs/, or its text */
    struct scene_override pair[EXPERIMENT_PAIRS_MOST];
    const char *spacing[2]; /* finest of three spacings: normally, with --quick */
    int runs[2];            /* number of runs at each spacing */
    bool quick, drawn;      /* also run with --quick; crack paths are drawn */
    struct experiment_figure figure[EXPERIMENT_FIGURES_MOST];
};

/* Makes the convergence study of the case c, with runs at three spacings and variations without physical meaning, and
 * adds its results to x. Returns REFUSED or FAILED if the study does. */
status experiment_make_convergence_study(struct experiments *x, const struct experiment_case *c);

/* Computes the mean of the finite values of value[value_count], their standard deviation, and half of the 95 %
 * confidence interval of the mean, and stores them in *mean, *deviation and *interval. Returns the number of finite
 * values. */
int experiment_compute_mean_and_interval(const double *value, int value_count, double *mean, double *deviation,
                                         double *interval);

/* ---- experiments_branch.c: crack branching ----------------------------------------------------------------------- */

/* Branching of a crack along x. The crack has branched where, over the next 4 mm, nine of ten columns of particles have
 * damage at two or more positions with a distance above 3.5 spacings. x: coordinate of the first such column [m], NAN
 * if there is none; angle: between the outermost branches from 2 to 10 mm beyond x [degree]; branches: largest number
 * of branches of a column. */
struct branching {
    double x, angle;
    int branches;
};

/* Finds where and at which angle a crack along x has branched, from the damage in a frame, and returns it. spacing:
 * spacing of the particles [m]. */
struct branching branching_find_in_frame(const struct output_frame *frame, double spacing);

/* Returns the coordinate x [m] at which the crack branches, in the last frame of the run in `run_folder`; NAN if it
 * does not branch. spacing: spacing of the particles [m]. */
double branching_x_coordinate(const char *run_folder, double spacing);

/* Returns the angle between the outermost branches of the crack, in the last frame of the run in `run_folder` [degree];
 * NAN if it does not branch. spacing: spacing of the particles [m]. */
double branching_angle_in_degrees(const char *run_folder, double spacing);

/* Returns the largest number of branches of the crack, in the last frame of the run in `run_folder`; 0 if there is no
 * such frame. spacing: spacing of the particles [m]. */
double branching_largest_branch_count(const char *run_folder, double spacing);

/* Reads the last frame of the run in `run_folder` into *frame. Returns FAILED if there is none or it cannot be read.
 * Release with frame_free in either case. */
status experiment_read_last_frame(struct output_frame *frame, const char *run_folder);
enum { EXPERIMENT_DAMAGED = 35 }; /* damage that counts as crack, as for crack tips [%] */

/* ---- the experiments --------------------------------------------------------------------------------------------- */

/* Runs Kalthoff's plate and the branching of a crack in glass, and adds their results to the results x of the bench.
 * Returns REFUSED or FAILED if a study does. */
status experiments_run_plates(struct experiments *x);

/* Runs a crack through a strip with displaced faces under several loads, and adds speed, stress-intensity factor and
 * energy to the results x of the bench. Returns REFUSED or FAILED if a study does. */
status experiments_run_strip(struct experiments *x);

/* Runs a crack that follows a prescribed moving displacement field (surfing, Hossain et al. 2014), and adds the energy
 * per crack area to the results x of the bench. Returns REFUSED or FAILED if a run does. */
status experiments_run_surfing_crack(struct experiments *x);

/* Results of surf_run_and_measure_crack. taken: energy of broken bonds, divided by the new crack area [J/m^2]; speed:
 * mean crack speed, divided by the speed of the prescribed field [1]. */
struct surf_figures {
    double taken, speed;
};

/* Runs a mode I crack under the displacements of a steadily moving crack, prescribed at the edge of the plate. The
 * field has the energy release rate energy_share * G_c with G_c = 40 J/m^2 and moves at `speed_ratio` times the
 * Rayleigh speed. spacing: particle spacing [m]; time_step_fraction: fraction of the critical time step. Stores the
 * results in *measured and the Rayleigh speed [m/s] in *rayleigh_speed. Returns REFUSED or FAILED if the run does. */
status surf_run_and_measure_crack(double spacing, double energy_share, double speed_ratio, double time_step_fraction,
                                  struct surf_figures *measured, double *rayleigh_speed);

/* Runs a vortex with a manufactured body force, after Kamojjala et al. 2015, at several spacings, and adds its errors
 * and their order of convergence to the results x of the bench. Returns REFUSED or FAILED if a run does. */
status experiments_run_vortex(struct experiments *x);

/* Numerical methods of the vortex: material points in the reference frame, whose centre rotates by 1 rad; peridynamics,
 * 0.5 rad; peridynamics, 1 rad (VORTEX_PD_FAR). */
enum vortex_method { VORTEX_MESH, VORTEX_PD, VORTEX_PD_FAR, VORTEX_METHODS };

/* Runs the vortex (experiments_run_vortex) with the numerical method `method` at the particle spacing `spacing` [m].
 * Stores in *error the root mean square of the error of the displacements at the end, divided by the root mean square
 * of the displacements. Returns REFUSED or FAILED if the run does. */
status vortex_run_and_measure_error(enum vortex_method method, double spacing, double *error);

/* Runs the notched beam of John & Shah 1990 and adds its results to the results x of the bench. Returns REFUSED or
 * FAILED if a run does. */
status experiments_run_notched_beam(struct experiments *x);

/* Runs a disc that is compressed across its diameter, and adds its stress and its largest load, each divided by the
 * closed form, to the results x of the bench. Returns REFUSED or FAILED if a run does. */
status experiments_run_compressed_disc(struct experiments *x);

#endif
