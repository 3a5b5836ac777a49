/* What the parts of `cleave bench coupling` share. */
#ifndef CLEAVE_BENCH_COUPLING
#define CLEAVE_BENCH_COUPLING

#include "bench/common/bench.h"

#define COUPLING_BAR "inputs/bar_pulse.yaml"
#define COUPLING_PLATE "inputs/plate_pulse.yaml"

/* A coupling, and what is written beside `coupling` in the scene. */
enum { WAY_DAMPED, WAY_UNDAMPED, WAY_HANDSHAKE, WAY_PM, WAY_PG, WAY_PMG, WAY_PGG, WAYS };
struct coupling_way {
    const char *name, *coupling;
    const char *damping; /* value of interface_damping; NULL: the default */
};
extern const struct coupling_way coupling_way[WAYS];
void coupling_way_override(struct bench_overrides *o, int way);

/* What an interface did to a pulse: shares of the incident amplitude, and of the incident energy [1]. */
struct pulse_result {
    double reflected, transmitted, energy_change;
};

/* ---- bench_coupling.c: the bar ----------------------------------------------------------------------------------- */

/* One run of the bar. */
struct bar_run {
    int way;
    double width; /* [spacings] */
    int cell;     /* [spacings] */
    double place; /* of a node of the grid from the interface, in cells */
    const char *transfer;
    struct pulse_result result;
};

enum { BAR_RUNS_MAX = 128 };
struct bar_table {
    int n;
    struct bar_run run[BAR_RUNS_MAX];
};

/* ---- coupling_patch.c: uniform strain across an interface -------------------------------------------------------- */

/* Largest nodal force over stress times cell face: with the interface (its corners, its centre) on a node, and over
 * positions of the grid. */
struct patch_row {
    const char *shape, *load, *coupling, *weights;
    int cell; /* [spacings] */
    double on_node, largest;
};

enum { PATCH_ROWS_MAX = 64 };
struct patch_table {
    int n;
    struct patch_row row[PATCH_ROWS_MAX];
};
status patch_measure(struct patch_table *t, bool quick);
void patch_print(const struct patch_table *t);
void patch_fill(const struct patch_table *t, struct bench_table *rows);

/* ---- coupling_plane.c: a plane wave meets a flat and an oblique interface ---------------------------------------- */

struct plane_row {
    const char *interface, *weights, *transfer;
    int way;
    double width; /* [spacings] */
    struct pulse_result result;
    double wave; /* reflected share of what the grid can see: of means over 4 x 4 spacings */
};

enum { PLANE_ROWS_MAX = 64 };
struct plane_table {
    int n;
    struct plane_row row[PLANE_ROWS_MAX];
};
status plane_measure(struct plane_table *t, bool quick);
void plane_print(const struct plane_table *t);
void plane_fill(const struct plane_table *t, struct bench_table *rows);

/* ---- coupling_draw.c: pictures ----------------------------------------------------------------------------------- */

struct coupling_figures {
    struct bar_table pulses, places, variants;
    struct patch_table patch;
    struct plane_table plane;
};
void coupling_draw(FILE *to, const void *figures);
/* Runs the bar once more with two couplings and draws results/bench/coupling_pulse.png and .svg. */
status coupling_pulse_picture(void);

#endif
