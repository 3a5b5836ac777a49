/* What the files of the stability bench share: its cases, and the limits that are observed. */
#ifndef CLEAVE_BENCH_STABILITY
#define CLEAVE_BENCH_STABILITY

#include "bench/common/bench.h"

enum stability_group { GROUP_PD, GROUP_SHEET, GROUP_POINTS, GROUP_COUPLED, GROUP_REFERENCE, STABILITY_GROUP };
extern const char *const stability_group_name[STABILITY_GROUP];

/* A free block of one method: what its scene says; NULL or 0: the scene's default. */
struct stability_case {
    enum stability_group group;
    const char *note; /* what is particular about it */
    int dim;
    const char *space; /* NULL: line, plane stress, solid by dim */
    const char *method, *model, *coupling, *shape, *transfer, *frame, *surface, *weights, *normalisation, *calibration;
    double cell;   /* points per cell and direction */
    double offset; /* of the nodes against the lattice's lower border [cells] */
    int offsets;   /* how many are tried between 0 and 1, 0: `offset` alone */
    double horizon, poisson, irregularity;
    bool contact;   /* faces of cracks meet */
    double heavier; /* density of the other half over that of the first; 0: one material */
    enum stability_region { HALF, ISLANDS, SPOTS, STRIP, SQUARE, DISC, CORNER, NOTCH } region;
    /* peridynamic (adaptive): one half; all but scattered balls; these balls; the middle
     * half; of each axis the middle half; a ball; the lower half of each axis; three
     * quarters of the middle half, with a crack up to the middle */
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
    /* nothing; a plane of symmetry at x = 0, at y = 0, both; the same clamped; a clamp at x
     * = 0 and a symmetry at y = 0; two rows of the far end in x held; moved along x for a
     * while, then held */
    const char *strain, *constants; /* of the reference frame */
    int edge;                       /* particles along it; 0: few */
    const char *text;               /* another scene than this block, at rest: the rest is not looked at; NULL: none */
    double quoted_low, quoted_high; /* limit of the design sheets in the case's unit, 0: none */
};

/* What came of it; steps in seconds. */
struct stability_limits {
    double automatic, critical; /* step that Cleave takes, and the one it calls critical */
    double observed, offset;    /* limit of growth, the least over the offsets, and where */
    double largest;             /* over the offsets */
    double gershgorin, silling; /* bounds of bonds: block-Gershgorin; Silling & Askari 2005 */
    double unit;                /* D/c of peridynamics and coupled bodies, h/c of points */
    enum { RUN_NONE, RUN_STAYS, RUN_GROWS } automatic_run, below, above; /* real runs at these steps */
};

/* Finds them; `steps` of a growth run, `long_steps` of the three real runs (0: none). REFUSED with the reason where the
 * scene is. */
status stability_observe(const struct stability_case *c, int steps, int long_steps, struct stability_limits *to);
/* Does a body at rest, shaken at random and carried along at shares of the wave speed, stay bounded for so many
 * steps of dt [s]? 0: the automatic step. */
struct stability_shake {
    double speed, drift;
    int steps;
};
status stability_stays(const struct stability_case *c, double dt, struct stability_shake how, bool *stays);
/* Steps until a run at so many times the observed limit was stopped with place, step and remedy; infinite if it went
 * on for 1000 or said less (limits_time_step.c). */
status stability_caught(const struct stability_case *c, double times, double *step);
/* Text of the case's scene: its own, or that of its block (stability_scene.c). */
void stability_text(const struct stability_case *c, char *text, size_t size);
/* Line that names it. */
void stability_label(const struct stability_case *c, char *text, size_t size);

/* All cases, one after the other (stability_cases.c). */
typedef status stability_take(void *context, const struct stability_case *c);
status stability_cases(bool quick, stability_take *take, void *context);

/* A row of the map. */
struct stability_row {
    struct stability_case c;
    struct stability_limits l;
    char label[128], refusal[NAME_MAX_LENGTH]; /* "": not refused */
};
enum { STABILITY_ROWS_MAX = 400 };
struct stability_map {
    int n;
    struct stability_row row[STABILITY_ROWS_MAX];
};

#define STABILITY_LEAST 0.6 /* what the automatic step may be of the observed limit */
#define STABILITY_MOST 0.95

/* Its picture (stability_draw.c). */
void stability_draw(FILE *to, const void *map);

/* Scenes in which methods fail (limits.h), measured, printed and put into a table; its picture (stability_scenes.c). */
status stability_scenes(struct bench_table *t);
status stability_scenes_draw(const struct bench_table *t);

#endif
