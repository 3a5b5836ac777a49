/* `cleave bench accuracy`: error against computing time of every method on problems with known solutions. Declarations
 * shared by its files.
 *
 *   METHOD   row of a table: a name and the scene keys that select the method
 *   PROBLEM  row of a table: cases, applicable methods and resolutions, a function that writes the scene of a point,
 *            and one that measures the error of the finished run
 *   POINT    one run: problem, case, method, resolution, horizon, fraction of the critical time step
 *
 * To add a problem: write its two functions in a file of its own, and add a line to accuracy_problem[]
 * (accuracy_plan.c). */
#ifndef CLEAVE_BENCH_ACCURACY
#define CLEAVE_BENCH_ACCURACY

#include "bench/common/bench.h"

/* ---- methods (accuracy_methods.c) -------------------------------------------------------------------------------- */

/* Families of methods, as bits; a problem states which apply. */
enum accuracy_family {
    ACCURACY_BONDS = 1,     /* bond-based peridynamics */
    ACCURACY_STATES = 2,    /* state-based peridynamics: plane and solid problems */
    ACCURACY_POINTS = 4,    /* material points in the current frame */
    ACCURACY_REFERENCE = 8, /* material points in the reference frame */
    ACCURACY_COUPLED = 16,  /* a fixed region is peridynamic: the scene sets pd.region */
    ACCURACY_ADAPTIVE = 32  /* the scene converts material points adaptively */
};
enum {
    ACCURACY_PD = ACCURACY_BONDS | ACCURACY_STATES,
    ACCURACY_MPM = ACCURACY_POINTS | ACCURACY_REFERENCE,
    ACCURACY_SETTINGS = 5
};

/* A numerical method that is compared (bonds, material points, or both): its name and the scene keys that select it. */
struct accuracy_method {
    const char *name; /* name in tables */
    enum accuracy_family family;
    bool quick;                                   /* also run with --quick */
    struct scene_override set[ACCURACY_SETTINGS]; /* scene keys; ends with key NULL */
};
extern const struct accuracy_method accuracy_method[];
extern const int accuracy_methods;

/* ---- problems (accuracy_plan.c) ---------------------------------------------------------------------------------- */

/* Largest numbers of entries of the lists in struct accuracy_problem: cases, resolutions, further horizons or time
 * steps (variations), parts of the error, and remarks. */
enum {
    ACCURACY_CASES = 6,
    ACCURACY_RESOLUTIONS = 6,
    ACCURACY_VARIATIONS = 3,
    ACCURACY_PARTS = 3,
    ACCURACY_REMARKS = 5
};

struct accuracy_problem;

/* A run of the bench: the problem that it solves, by which method, and with which discretisation. */
struct accuracy_point {
    const struct accuracy_problem *problem;
    const struct accuracy_method *method;
    int at;         /* index of the case */
    int resolution; /* in the units of the problem */
    double horizon; /* horizon [spacings]; 0: no bonds */
    double step;    /* time.safety: time step divided by the critical one */
};

/* Scene of a point: a file or a text, and overrides; keys of the method, the horizon and the time step are added
 * later. */
struct accuracy_scene {
    char path[64]; /* path of the file; "": use `text` */
    char text[4096];
    struct bench_overrides set;
};

/* A problem with known solution, on which methods are compared, and the functions that the run and measure it. */
struct accuracy_problem {
    const char *name, *title;
    const char *error;                    /* definition of the error, for captions */
    const char *part[ACCURACY_PARTS];     /* names of the parts of the error; NULL: not split */
    bool levels;                          /* methods with coarse cells also apply */
    bool draws_parts;                     /* pictures have panels for the parts, each with the worst of all cases */
    const char *cases[ACCURACY_CASES];    /* names of the cases, a panel each; ends with NULL */
    const char *counts;                   /* unit of the resolutions */
    int families;                         /* bit set of the applicable families */
    int dim;                              /* dimension, which determines how work grows with resolution */
    int resolution[ACCURACY_RESOLUTIONS]; /* in ascending order; ends with 0 */
    int quick_resolutions;                /* number of resolutions run with --quick */
    /* Further horizons for pure peridynamics besides 3.015: the first at every resolution, others at one; ends with
     * 0. */
    double horizon[ACCURACY_VARIATIONS];
    double step[ACCURACY_VARIATIONS];     /* further time steps besides 0.8, at one resolution; ends with 0 */
    bool steps;                           /* run the first of them at every resolution and with --quick */
    int varied;                           /* 1 + index of that resolution; 0: the second */
    const char *remark[ACCURACY_REMARKS]; /* remarks on notable results for the overview page */
    int samples;                          /* number of evaluations of crack tips; 0: one */
    double seconds, quick_seconds;        /* predicted duration of all points [s], replaced by measured times */
    /* Writes the scene of a point. */
    void (*scene)(const struct accuracy_point *p, struct accuracy_scene *s);
    /* Runs a point; NULL: run_advance_to_end_time. */
    status (*run)(const struct accuracy_point *p, struct run *e);
    /* Computes the relative error and its parts of a finished run. */
    status (*measure)(const struct accuracy_point *p, struct run *e, double *error, double *part);
    /* Returns true if a point of the applicable families is possible; NULL: always. */
    bool (*applies)(const struct accuracy_point *p);
};
extern const struct accuracy_problem *const accuracy_problem[];
extern const int accuracy_problems;

/* Usual horizon [spacings] and usual fraction of the critical time step. */
#define ACCURACY_HORIZON 3.015
#define ACCURACY_STEP 0.8

extern const struct accuracy_problem accuracy_bar, accuracy_wave, accuracy_square, accuracy_cube, accuracy_hole,
    accuracy_cracks, accuracy_sudden, accuracy_spall, accuracy_fracture, accuracy_beam, accuracy_rod;

/* Runs the cracks of the problem `fracture` with bond-based peridynamics at increasing resolution and prints the
 * results as the lines of the table in accuracy_reference.h (`cleave bench accuracy=reference`). quick: true for the
 * two coarsest resolutions only. Returns FAILED if a run fails. */
status accuracy_compute_reference_cracks(bool quick);

/* Computes the displacement [m] and the stress components xx, yy, xy [Pa] at `position` [m] in a plate under tension
 * along y with a hole of radius 1 m around the origin (accuracy_hole.c). */
void accuracy_hole_compute_exact_solution(const double position[2], double displacement[2], double stress[3]);

/* Returns true if the material points in the run of `point` use the reference frame (mpm.frame: reference). */
bool accuracy_point_uses_reference_frame(const struct accuracy_point *point);

/* Returns true if the method of `point` can reach equilibrium by relaxation (solver: relaxation). */
bool accuracy_point_can_use_relaxation(const struct accuracy_point *point);

/* Returns true if the method has coarse grid cells besides the finest ones (mpm.levels: 1 or 2). */
bool accuracy_method_has_coarse_cells(const struct accuracy_method *method);

/* Returns the value of the scene key `solver` with which the method of `point` reaches equilibrium: "cg" for
 * peridynamics, "explicit" in the reference frame, where the load grows slowly, else "relaxation". */
const char *accuracy_solver_of_point(const struct accuracy_point *point);

/* Returns the result called `quantity` of the probe called `probe` of the finished run, in SI units; NAN if there is
 * no such result. */
double accuracy_probe_value_of_run(const struct run *run, const char *probe, const char *quantity);

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Result of one run of the bench: its error and its cost. */
struct accuracy_result {
    bool known;                         /* measured, now or earlier */
    bool stable;                        /* the run reached its end */
    double error, part[ACCURACY_PARTS]; /* relative error and its parts [1]; NAN: none */
    double seconds[2];                  /* time of the loop on one and on two threads, least of several runs [s] */
    double particles, steps;
    char settings[20]; /* hash of scene and machine; results with another hash are not reused */
};

/* A run of the complete table (point) and its result. */
struct accuracy_entry {
    struct accuracy_point point;
    struct accuracy_result result;
    bool quick; /* also in the table of --quick */
};

/* The complete table: entry[n], one for each run, and the machine on which the runs are timed. */
struct accuracy_plan {
    int n;
    struct accuracy_entry *entry;
    struct machine machine;
};

/* Creates the list of all points of the table (a point is one run) in *plan, and computes the hash of the scene of each
 * point (accuracy_plan.c). Returns REFUSED or FAILED if a scene cannot be read. Release with accuracy_plan_free. */
status accuracy_plan_make(struct accuracy_plan *plan);

/* Releases the entries of the plan, the complete table of runs. */
void accuracy_plan_free(struct accuracy_plan *plan);

/* Composes the scene of the run `point` in *scene: the scene of its problem, with the keys of its method, its horizon
 * and its time step. */
void accuracy_compose_scene_of_point(const struct accuracy_point *point, struct accuracy_scene *scene);

/* Reads earlier results from results/bench/accuracy.csv into the points of the plan, as far as the settings (scene and
 * machine) and the program version are unchanged, and writes the file again without other lines (accuracy_store.c).
 * Returns FAILED if the file cannot be read or written. */
status accuracy_read_earlier_results(struct accuracy_plan *plan);

/* Returns true if the file results/bench/accuracy.csv, the results of an earlier bench, exists. */
bool accuracy_results_file_exists(void);

/* Reads the results of bench/accuracy/cost_accuracy.csv into the points of the plan. This file is the stored copy of
 * the last complete measurement and has neither parts of errors nor times on two threads. Returns FAILED if it cannot
 * be read. */
status accuracy_read_recorded_results(struct accuracy_plan *plan);

/* Appends the result of the point `entry` (one run) to results/bench/accuracy.csv and closes the file, so that the
 * results of an interrupted bench are kept. Returns REFUSED or FAILED if the file cannot be written. */
status accuracy_append_result_to_file(const struct accuracy_entry *entry);

/* Writes all known results of the plan to results/bench/accuracy.csv and accuracy.json, and the problems with their
 * errors to accuracy_problems.csv. Returns REFUSED or FAILED if a file cannot be written. */
status accuracy_write_all_results(const struct accuracy_plan *plan);

/* Header of cost_accuracy.csv. keys: scene keys of the method besides spacing, horizon and step, as
 * key=value;key=value. */
#define ACCURACY_TABLE_HEADER "problem,case,method,resolution,horizon,step,error,seconds,particles,steps,keys"

/* Writes known points (runs) of the plan to results/bench/cost_accuracy.csv. Points of one method at one horizon and
 * time step form a line, related methods form a family (enum accuracy_family). A line is written if at least one of its
 * points is on the Pareto front of its family in some case. bench/accuracy/cost_accuracy.csv is a copy of the last
 * complete measurement. Returns FAILED if the file cannot be written. */
status accuracy_write_table_of_pareto_lines(const struct accuracy_plan *plan);

/* ---- Pareto front (accuracy_front.c) ----------------------------------------------------------------------------- */

/* Time [s] and error [1] of a point; ignored if one is not finite. */
struct accuracy_dot {
    double time, error;
};

/* Finds the Pareto front of dot[dot_count]: those entries for which no other entry is at least as good in both time and
 * error and better in one of them; of equal entries the first. Stores the indices of these entries in front[], which
 * has space for `dot_count` numbers, in the order of ascending time and thus descending error. Returns how many they
 * are. */
int accuracy_find_pareto_front(const struct accuracy_dot *dot, int dot_count, int *front);

/* Returns the index of the entry of dot[dot_count] with the least time among those with an error of at most
 * `largest_error` [1]; -1 if there is none. */
int accuracy_index_of_fastest_point(const struct accuracy_dot *dot, int dot_count, double largest_error);

/* ---- accuracy_draw.c, accuracy_page.c ---------------------------------------------------------------------------- */

/* Writes the label of the run `point` into text[capacity]: method and resolution, as in `pd bond 100`, followed by `h`
 * and the horizon, and by `dt` and the fraction of the critical time step, if these are not the usual ones. */
void accuracy_label(const struct accuracy_point *point, char *text, size_t capacity);

/* Draws results/bench/accuracy_<problem>.png for every problem of the plan with known points, and the overview
 * accuracy.png. Returns FAILED if a picture cannot be drawn. */
status accuracy_draw_all_pictures(const struct accuracy_plan *plan);

/* Draws results/bench/accuracy.png: for each problem of the plan the runs and the Pareto fronts of peridynamics, of
 * material points and of both together, and above them the number of problems on which each of the three is cheapest
 * (accuracy_chart.c). Returns FAILED if the picture cannot be drawn. */
status accuracy_draw_overview_chart(const struct accuracy_plan *plan);

/* Writes the overview page of the plan, results/bench/accuracy.md, and prints its table of the fastest methods. Returns
 * FAILED if the page cannot be written. */
status accuracy_write_overview_page(const struct accuracy_plan *plan);

/* Collects time and error of all known runs of a problem in dot[], and pointers to the entries of these runs in
 * dot_entry[]; both arrays have space for plan->n elements. case_index: index of the case; < 0: one dot for all cases
 * together, with the longest time and the largest error. part_index: number of the part of the error whose magnitude is
 * used; < 0: the whole error. Returns the number of dots. */
int accuracy_collect_times_and_errors(const struct accuracy_plan *plan, const struct accuracy_problem *problem,
                                      int case_index, int part_index, struct accuracy_dot *dot,
                                      const struct accuracy_entry **dot_entry);

/* Returns the number of cases (entries of problem->cases) of the problem `problem`. */
int accuracy_case_count(const struct accuracy_problem *problem);

#endif
