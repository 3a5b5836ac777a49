/* `cleave bench stability`: compares the automatic time step of many methods with the observed limit of stability.
 * Declarations shared by its files. */
#ifndef CLEAVE_BENCH_STABILITY
#define CLEAVE_BENCH_STABILITY

#include "bench/common/bench.h"

enum stability_group { GROUP_PD, GROUP_SHEET, GROUP_POINTS, GROUP_COUPLED, GROUP_REFERENCE, STABILITY_GROUP };
extern const char *const stability_group_name[STABILITY_GROUP];

/* A free block with one method: values of scene keys; NULL or 0: the default of the scene. */
struct stability_case {
    enum stability_group group;
    const char *note; /* special property of the case, for labels */
    int dim;
    const char *space; /* value of the key; NULL: line, plane stress or solid, by dim */
    const char *method, *model, *coupling, *shape, *transfer, *frame, *surface, *weights, *normalisation, *calibration;
    double cell;   /* points per cell and direction */
    double offset; /* position of the nodes relative to the lower border of the lattice [cells] */
    int offsets;   /* number of offsets tried between 0 and 1; 0: only `offset` */
    double horizon, poisson, irregularity;
    bool contact;   /* contact between crack faces */
    double heavier; /* density of one half divided by that of the other; 0: one material */
    /* Peridynamic region of adaptive cases: one half; all but scattered balls; these balls; the middle half; the middle
     * half along each axis; a ball; the lower half along each axis; three quarters of the middle half, with a crack up
     * to the middle. */
    enum stability_region { HALF, ISLANDS, SPOTS, STRIP, SQUARE, DISC, CORNER, NOTCH } region;
    /* Supports: none; symmetry plane at x = 0, at y = 0, both; clamp at x = 0, at y = 0; clamp at x = 0 and symmetry
     * plane at y = 0; two rows at the far end in x fixed; these driven along x for a time, then fixed. */
    enum stability_support {
        FREE,
        MIRROR,
        MIRROR_ACROSS,
        MIRRORS,
        CLAMP,
        CLAMP_ACROSS,
        CLAMP_MIRROR,
        FIXED,
        DRIVEN
    } support;
    const char *strain, *constants; /* values of the keys of the reference frame */
    int edge;                       /* particles along an edge; 0: few */
    const char *text;               /* text of another scene, at rest, instead of the block; NULL: none */
    double quoted_low, quoted_high; /* published limit in the unit of the case, 0: none */
};

/* Limits of the time step of a case, automatic, predicted and observed; time steps in seconds. */
struct stability_limits {
    double automatic, critical; /* automatic time step; critical one predicted by Cleave */
    double observed, offset;    /* observed limit of growth, least over the offsets; its offset */
    double largest;             /* largest over the offsets */
    double gershgorin, silling; /* estimates for bonds: block-Gershgorin; Silling & Askari 2005 */
    double unit;                /* D/c for peridynamics and coupled bodies, h/c for points [s] */
    /* Outcome of full runs at the automatic step, below and above the limit. */
    enum { RUN_NONE, RUN_STAYS, RUN_GROWS } automatic_run, below, above;
};

/* Determines the stability limits of the case c and stores them in *limits. trial_steps: number of steps of each trial
 * run; long_steps: number of steps of three further runs at and near the limit, 0 for none. Returns REFUSED, with the
 * reason as message, if the scene is refused. */
status stability_determine_limits(const struct stability_case *c, int trial_steps, int long_steps,
                                  struct stability_limits *limits);

/* Initial motion and length of a run. speed: largest random velocity, drift: velocity of a translation along each axis,
 * both divided by the wave speed; steps: number of steps. */
struct stability_shake {
    double speed, drift;
    int steps;
};

/* Runs the case c with the initial motion `initial_motion` and the time step `time_step` [s], or the automatic one if
 * `time_step` is 0, and sets *is_bounded to true if the motion remains bounded. Returns REFUSED or FAILED if the run
 * cannot be created. */
status stability_run_and_test_boundedness(const struct stability_case *c, double time_step,
                                          struct stability_shake initial_motion, bool *is_bounded);

/* Runs the case c with a time step of time_step_ratio times the observed stability limit, to test that an unstable run
 * stops by itself. Stores in *stop_step the number of steps after which the run stops with a message that states
 * position, step and remedy; INFINITY if it runs 1000 steps or the message is incomplete (limits_time_step.c). Returns
 * REFUSED or FAILED if the limit cannot be determined. */
status stability_find_step_of_automatic_stop(const struct stability_case *c, double time_step_ratio, double *stop_step);

/* Writes the scene of the case c into text[capacity]: its own text c->text if it has one, else that of a block
 * (stability_scene.c). */
void stability_write_scene_text(const struct stability_case *c, char *text, size_t capacity);

/* Writes the label of the case c, its method and special properties in words, to text[capacity]. */
void stability_label(const struct stability_case *c, char *text, size_t capacity);

/* Type of a function that stability_call_for_all_cases calls for each case c. context: the argument `context` of
 * stability_call_for_all_cases. A returned status that is not OK ends the calls. */
typedef status stability_take(void *context, const struct stability_case *c);

/* Calls callback(context, case) for all cases of the stability bench (stability_cases.c). quick: true for fewer cases.
 * Returns the first status that is not OK; OK if there is none. */
status stability_call_for_all_cases(bool quick, stability_take *callback, void *context);

/* A row of the map of stability limits: a free block with one method, and its limits of the time step. */
struct stability_row {
    struct stability_case c;
    struct stability_limits l;
    char label[128], refusal[NAME_MAX_LENGTH]; /* refusal: reason; "": not refused */
};
enum { STABILITY_ROWS_MAX = 400 };

/* The map of stability limits: n rows. */
struct stability_map {
    int n;
    struct stability_row row[STABILITY_ROWS_MAX];
};

/* Required range of the automatic time step divided by the observed limit of stability [1]. */
#define STABILITY_LEAST 0.6
#define STABILITY_MOST 0.95

/* Writes the gnuplot commands of the picture of all stability limits to the stream `gnuplot` (stability_draw.c). map: a
 * struct stability_map. */
void stability_write_picture_commands(FILE *gnuplot, const void *map);

/* Measures and prints the scenes in which methods fail (limits.h), and fills `table` with them (stability_scenes.c).
 * Returns REFUSED or FAILED if a scene cannot be run. */
status stability_measure_failing_scenes(struct bench_table *table);

/* Draws the picture of `table`, the results of the scenes in which methods fail (stability_scenes.c). Returns FAILED if
 * it cannot be drawn. */
status stability_draw_failing_scenes(const struct bench_table *table);

#endif
