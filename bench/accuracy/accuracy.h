/* What the parts of `cleave bench accuracy` share: error against loop time of every method on problems with
 * known solutions.
 *
 *   a METHOD is a row of a table: a name and the scene keys that make it
 *   a PROBLEM is a row of a table: its cases, which methods and resolutions apply, a function that writes the scene of
 *   a
 *     point and one that measures the error of the finished run
 *   a POINT is one run: problem, case, method, resolution, horizon, share of the critical time step
 *
 * To add a problem: write its two functions in a file of its own, and a line in accuracy_problem[]
 * (accuracy_plan.c). */
#ifndef CLEAVE_BENCH_ACCURACY
#define CLEAVE_BENCH_ACCURACY

#include "bench/common/bench.h"

/* ---- methods (accuracy_methods.c) -------------------------------------------------------------------------------- */

/* Kinds of methods; a problem says which apply (bits). */
enum accuracy_family {
    ACCURACY_BONDS = 1,     /* bond-based peridynamics                                  */
    ACCURACY_STATES = 2,    /* state-based: plane and solid                             */
    ACCURACY_POINTS = 4,    /* material points in the current frame                     */
    ACCURACY_REFERENCE = 8, /* material points in the reference frame                   */
    ACCURACY_COUPLED = 16,  /* a fixed region is peridynamic: the scene gives pd.region */
    ACCURACY_ADAPTIVE = 32  /* the scene converts                                       */
};
enum {
    ACCURACY_PD = ACCURACY_BONDS | ACCURACY_STATES,
    ACCURACY_MPM = ACCURACY_POINTS | ACCURACY_REFERENCE,
    ACCURACY_SETTINGS = 5
};

struct accuracy_method {
    const char *name; /* as printed */
    enum accuracy_family family;
    bool quick;                                   /* also with --quick */
    struct scene_override set[ACCURACY_SETTINGS]; /* key NULL: no more */
};
extern const struct accuracy_method accuracy_method[];
extern const int accuracy_methods;

/* ---- problems (accuracy_plan.c) ---------------------------------------------------------------------------------- */

enum {
    ACCURACY_CASES = 6,
    ACCURACY_RESOLUTIONS = 6,
    ACCURACY_VARIATIONS = 3,
    ACCURACY_PARTS = 3,
    ACCURACY_REMARKS = 5
};

struct accuracy_problem;

struct accuracy_point {
    const struct accuracy_problem *problem;
    const struct accuracy_method *method;
    int at;         /* its case */
    int resolution; /* as the problem counts */
    double horizon; /* [spacings]; 0: it has no bonds */
    double step;    /* time.safety: share of the critical step */
};

/* The scene of a point: a file or a text, and overrides. Those of the method, the horizon and the step are added. */
struct accuracy_scene {
    char path[64]; /* "": the text */
    char text[4096];
    struct bench_overrides set;
};

struct accuracy_problem {
    const char *name, *title;
    const char *error;                    /* what the error is, in words */
    const char *part[ACCURACY_PARTS];     /* what it is split into; NULL: nothing */
    bool levels;                          /* methods with coarse cells apply, too */
    bool draws_parts;                     /* they have panels, of the worst of all cases */
    const char *cases[ACCURACY_CASES];    /* a table has a panel for each; NULL ends */
    const char *counts;                   /* what its resolutions count */
    int families;                         /* that apply */
    int dim;                              /* of its space: how work grows with resolution */
    int resolution[ACCURACY_RESOLUTIONS]; /* ascending; 0 ends */
    int quick_resolutions;                /* the first few */
    /* of pure peridynamics beside 3.015: the first at every resolution, others at one; 0 ends */
    double horizon[ACCURACY_VARIATIONS];
    double step[ACCURACY_VARIATIONS];     /* beside 0.8, at that one; 0 ends */
    bool steps;                           /* the first of them at every resolution, and with --quick */
    int varied;                           /* 1 + its place; 0: the second */
    const char *remark[ACCURACY_REMARKS]; /* for the page: what stands out and why */
    int samples;                          /* its tips are looked at so often; 0: once */
    double seconds, quick_seconds;        /* it takes about, until measured */
    void (*scene)(const struct accuracy_point *p, struct accuracy_scene *s);
    status (*run)(const struct accuracy_point *p, struct run *e); /* NULL: engine_run */
    /* Relative error and its parts, of a run that reached its end. */
    status (*measure)(const struct accuracy_point *p, struct run *e, double *error, double *part);
    bool (*applies)(const struct accuracy_point *p); /* NULL: every point of the families */
};
extern const struct accuracy_problem *const accuracy_problem[];
extern const int accuracy_problems;

#define ACCURACY_HORIZON 3.015
#define ACCURACY_STEP 0.8

extern const struct accuracy_problem accuracy_bar, accuracy_wave, accuracy_square, accuracy_cube, accuracy_hole,
    accuracy_cracks, accuracy_sudden, accuracy_spall, accuracy_fracture, accuracy_beam, accuracy_rod;

/* `cleave bench accuracy=reference`: prints the lines of accuracy_reference.h, finer and finer. */
status accuracy_reference(bool quick);
/* accuracy_hole.c: displacement [m] and stress xx, yy, xy [Pa] of the pulled plate with a hole of radius 1. */
void accuracy_hole_exact(const double X[2], double u[2], double stress[3]);

/* Material points of its method keep to the reference frame; it can relax to rest (solver: relaxation). */
bool accuracy_is_reference(const struct accuracy_point *p);
bool accuracy_relaxes(const struct accuracy_point *p);
/* It has coarse cells (mpm.levels). */
bool accuracy_is_coarse(const struct accuracy_method *method);
/* How its method finds rest: by a static solver, or in the reference frame under a load that grows slowly. */
const char *accuracy_solver(const struct accuracy_point *p);

/* Helps for `measure`: a figure of a probe (NAN: none), in memory. */
double accuracy_figure(const struct run *e, const char *probe, const char *quantity);

/* ---- results ----------------------------------------------------------------------------------------------------- */

struct accuracy_result {
    bool known; /* measured, now or before */
    bool stable;
    double error, part[ACCURACY_PARTS]; /* [1]; NAN: none */
    double seconds[2];                  /* in the loop on one thread and on two, least of some runs */
    double particles, steps;
    char settings[20]; /* of scene and machine, as a number */
};

/* A point of the whole table and what is known of it. */
struct accuracy_entry {
    struct accuracy_point point;
    struct accuracy_result result;
    bool quick; /* belongs to the short table, too */
};

/* accuracy_plan.c: every point of the whole table, and the scene that it is. */
struct accuracy_plan {
    int n;
    struct accuracy_entry *entry;
    struct machine machine;
};
status accuracy_plan_make(struct accuracy_plan *plan);
void accuracy_plan_free(struct accuracy_plan *plan);
void accuracy_scene_make(const struct accuracy_point *p, struct accuracy_scene *s);

/* accuracy_store.c: results/bench/accuracy.csv. Read: what it holds of points with the same settings and program
 * version. Append: one line, at once. Write: all that is known, with what goes with it. */
status accuracy_store_read(struct accuracy_plan *plan);
status accuracy_store_append(const struct accuracy_entry *entry);
status accuracy_store_write(const struct accuracy_plan *plan);

/* Header of cost_accuracy.csv. `keys`: the scene keys that make the method, key=value;key=value, beside spacing,
 * horizon and step. */
#define ACCURACY_TABLE_HEADER "problem,case,method,resolution,horizon,step,error,seconds,particles,steps,keys"
/* Writes results/bench/cost_accuracy.csv: the known points of all lines that reach the front of their family in some
 * case (accuracy_table.c). bench/accuracy/cost_accuracy.csv is a copy of the last full measurement. */
status accuracy_table_write(const struct accuracy_plan *plan);

/* ---- accuracy_front.c: what a cloud of points says --------------------------------------------------------------- */

/* Time [s] and error [1] of a point; either not finite: it does not count. */
struct accuracy_dot {
    double time, error;
};

/* Points that no other beats in both, by ascending time (and so descending error), into `front`; returns how many. Of
 * equal points the first. */
int accuracy_front(const struct accuracy_dot *dot, int n, int *front);
/* The point of least time with at most this error; -1: none. */
int accuracy_cheapest(const struct accuracy_dot *dot, int n, double error);

/* ---- accuracy_draw.c, accuracy_page.c ---------------------------------------------------------------------------- */

/* `pd bond 100`, with `h` the horizon and `dt` the share of the critical step where they are not the usual ones. */
void accuracy_label(const struct accuracy_point *p, char *text, size_t size);
/* results/bench/accuracy_<problem>.png for every problem with known points, and accuracy.png with all of them. */
status accuracy_draw(const struct accuracy_plan *plan);
/* results/bench/accuracy.md, and the same table to standard output. */
status accuracy_page(const struct accuracy_plan *plan);
/* Dots of one case (or the worst of all cases: at < 0) of a problem, of its error (part < 0) or of the size of a part,
 * and the entry that each stands for. */
int accuracy_dots(const struct accuracy_plan *plan, const struct accuracy_problem *problem, int at, int part,
                  struct accuracy_dot *dot, const struct accuracy_entry **of);
/* Names of the cases: how many. */
int accuracy_cases(const struct accuracy_problem *problem);

#endif
