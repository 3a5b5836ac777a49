/* Stability bench: cases and observed limits. Declarations shared by its files. */
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
    double heavier; /* density of one half over that of the other; 0: one material */
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

/* Limits of a case; time steps in seconds. */
struct stability_limits {
    double automatic, critical; /* automatic time step; critical one predicted by Cleave */
    double observed, offset;    /* observed limit of growth, least over the offsets; its offset */
    double largest;             /* largest over the offsets */
    double gershgorin, silling; /* estimates for bonds: block-Gershgorin; Silling & Askari 2005 */
    double unit;                /* D/c for peridynamics and coupled bodies, h/c for points [s] */
    /* Outcome of full runs at the automatic step, below and above the limit. */
    enum { RUN_NONE, RUN_STAYS, RUN_GROWS } automatic_run, below, above;
};

/* Determines the limits of a case. steps: length of a growth run; long_steps: length of the three full runs, 0: none.
 * REFUSED, with the reason, if the scene is. */
status stability_observe(const struct stability_case *c, int steps, int long_steps, struct stability_limits *to);

/* Initial motion: random velocities `speed` and translation `drift`, both over the wave speed; number of steps. */
struct stability_shake {
    double speed, drift;
    int steps;
};

/* Determines whether a body at rest with this initial motion remains bounded with the time step dt [s]; 0: the
 * automatic step. */
status stability_stays(const struct stability_case *c, double dt, struct stability_shake how, bool *stays);

/* Determines the number of steps after which a run with `times` the observed limit stops with position, step and
 * remedy; infinite if it runs 1000 steps or the message is incomplete (limits_time_step.c). */
status stability_caught(const struct stability_case *c, double times, double *step);

/* Writes the scene of a case: its own text, or that of its block (stability_scene.c). text: capacity `size` [byte]. */
void stability_text(const struct stability_case *c, char *text, size_t size);

/* Composes the label of a case. text: capacity `size` [byte]. */
void stability_label(const struct stability_case *c, char *text, size_t size);

/* Receives a case. context: argument of stability_cases. */
typedef status stability_take(void *context, const struct stability_case *c);

/* Calls `take` for all cases (stability_cases.c). quick: fewer of them. */
status stability_cases(bool quick, stability_take *take, void *context);

/* A row of the map. */
struct stability_row {
    struct stability_case c;
    struct stability_limits l;
    char label[128], refusal[NAME_MAX_LENGTH]; /* refusal: reason; "": not refused */
};
enum { STABILITY_ROWS_MAX = 400 };

/* All rows. */
struct stability_map {
    int n;
    struct stability_row row[STABILITY_ROWS_MAX];
};

/* Required range of the automatic time step over the observed limit. */
#define STABILITY_LEAST 0.6
#define STABILITY_MOST 0.95

/* Draws the map. map: struct stability_map (stability_draw.c). */
void stability_draw(FILE *to, const void *map);

/* Measures and prints the scenes in which methods fail (limits.h) and adds them to a table (stability_scenes.c). */
status stability_scenes(struct bench_table *t);

/* Draws the picture of this table (stability_scenes.c). */
status stability_scenes_draw(const struct bench_table *t);

#endif
