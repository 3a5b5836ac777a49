/* `cleave bench coupling`: measures the effect of an interface between material points and bonds on waves and on
 * uniform strain. Declarations shared by its files. */
#ifndef CLEAVE_BENCH_COUPLING
#define CLEAVE_BENCH_COUPLING

#include "bench/common/bench.h"

#define COUPLING_BAR "inputs/bar_pulse.yaml"
#define COUPLING_PLATE "inputs/plate_pulse.yaml"

enum {
    VARIANT_DAMPED,
    VARIANT_UNDAMPED,
    VARIANT_HANDSHAKE,
    VARIANT_PM,
    VARIANT_PG,
    VARIANT_PMG,
    VARIANT_PGG,
    VARIANTS
};

/* A coupling of material points and bonds: its name, and the values of the scene keys that select it. */
struct coupling_variant {
    const char *name, *coupling;
    const char *damping; /* value of interface_damping; NULL: default */
};
extern const struct coupling_variant coupling_variant[VARIANTS];

/* Appends the overrides that select the coupling coupling_variant[variant] to *overrides. */
void coupling_variant_append_overrides(struct bench_overrides *overrides, int variant);

/* Effect of an interface on a pulse [1]: reflected and transmitted amplitude, divided by the incident amplitude; change
 * of energy, divided by the incident energy. */
struct pulse_result {
    double reflected, transmitted, energy_change;
};

/* ---- bench_coupling.c: the bar ----------------------------------------------------------------------------------- */

/* One run of a pulse in a bar of material points and bonds: how they are coupled, and the effect on the pulse. */
struct bar_run {
    int variant;
    double width; /* width of the pulse [spacings] */
    int cell;     /* size of the grid cells [spacings] */
    double place; /* distance of the interface from the next grid node [cells] */
    const char *transfer;
    struct pulse_result result;
};

enum { BAR_RUNS_MAX = 128 };
struct bar_table {
    int n;
    struct bar_run run[BAR_RUNS_MAX];
};

/* ---- coupling_patch.c: uniform strain across an interface -------------------------------------------------------- */

/* A result of the patch test: largest nodal force, divided by the stress and the area of a cell face [1], which should
 * be 0. shape, load: of the interface and of the uniform strain; coupling, weights: values of the scene keys. on_node:
 * result with a grid node at the interface (at its corner or centre); largest: largest result for all positions of the
 * grid. */
struct patch_row {
    const char *shape, *load, *coupling, *weights;
    int cell; /* size of the grid cells [spacings] */
    double on_node, largest;
};

enum { PATCH_ROWS_MAX = 64 };
struct patch_table {
    int n;
    struct patch_row row[PATCH_ROWS_MAX];
};

/* Makes the patch test: measures the nodal forces under uniform strain for all shapes of the interface, couplings and
 * loads, and adds them to the table. quick: one load and fewer positions of the grid. Returns FAILED or REFUSED if a
 * run does. */
status patch_test_measure_nodal_forces(struct patch_table *table, bool quick);

/* Prints the results of the patch test in `table` to standard output. */
void patch_print(const struct patch_table *table);

/* Initialises `rows`, a table for files, with the results of the patch test in `table`. Release it with
 * bench_table_free. */
void patch_test_fill_file_table(const struct patch_table *table, struct bench_table *rows);

/* ---- coupling_plane.c: a plane wave meets a flat and an oblique interface ---------------------------------------- */

/* Result of a plane wave that meets an interface between material points and bonds in two or three dimensions. */
struct plane_row {
    const char *interface, *weights, *transfer;
    int variant;
    double width; /* [spacings] */
    struct pulse_result result;
    double wave; /* reflected amplitude resolved by the grid: of means over 4 x 4 spacings */
};

enum { PLANE_ROWS_MAX = 64 };
struct plane_table {
    int n;
    struct plane_row row[PLANE_ROWS_MAX];
};

/* Runs a plane wave towards flat and inclined interfaces with all couplings and weights, and adds the results to the
 * table. quick: one interface and width only. Returns FAILED or REFUSED if a run does. */
status plane_wave_measure_reflections(struct plane_table *table, bool quick);

/* Prints the results for plane waves in `table` to standard output. */
void plane_print(const struct plane_table *table);

/* Initialises `rows`, a table for files, with the results for plane waves in `table`. Release it with bench_table_free.
 */
void plane_wave_fill_file_table(const struct plane_table *table, struct bench_table *rows);

/* ---- coupling_draw.c: pictures ----------------------------------------------------------------------------------- */

/* All results of `cleave bench coupling`, which one picture shows. */
struct coupling_figures {
    struct bar_table pulses, places, variants;
    struct patch_table patch;
    struct plane_table plane;
};

/* Writes the gnuplot commands of the picture with all results to the stream `gnuplot`. figures: a struct
 * coupling_figures. */
void coupling_write_picture_commands(FILE *gnuplot, const void *figures);

/* Runs a pulse through the bar with the couplings handshake and partial stress and draws its velocities as
 * results/bench/coupling_pulse.png and .svg. Returns FAILED or REFUSED if a run or the picture fails. */
status coupling_draw_picture_of_pulse(void);

#endif
