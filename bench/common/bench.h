/* Declarations shared by the benches: tables written as CSV and JSON, and runs for timing. */
#ifndef CLEAVE_BENCH_BENCH
#define CLEAVE_BENCH_BENCH

#include "engine/engine.h"
#include "kernels/microbench/microbench.h"

/* Runs `cleave bench`. argv: words after `cleave`, starting with "bench". */
status command_bench(int argc, char **argv);

#define BENCH_FOLDER "results/bench"

/* ---- bench_output.c: tables -------------------------------------------------------------------------------------- */

/* A cell of a table: a text, or a number if `text` is empty. */
struct bench_cell {
    char text[NAME_MAX_LENGTH];
    double number;
};

/* A table of results. */
struct bench_table {
    const char *name;   /* "" for the main table of a bench */
    const char *header; /* names of the columns, separated by commas */
    int columns;
    int64_t cells;
    struct bench_cell *cell; /* [cells] row by row */
};

/* Initialises an empty table with the columns in `header`. Release with bench_table_free. */
void bench_table_make(struct bench_table *t, const char *name, const char *header);

/* Appends a text as the next cell, row by row. In files commas and quotation marks become semicolons. */
void bench_text(struct bench_table *t, const char *text);

/* Appends a number as the next cell. In files a number that is not finite is left out. */
void bench_number(struct bench_table *t, double number);

/* Releases the memory of t. */
void bench_table_free(struct bench_table *t);

/* Creates the folder results/bench. */
status bench_folder_make(void);

/* Checks that a bench may write its files. REFUSED if results/bench has a file NAME.json, or without it a table or
 * picture of this name, that no bench wrote. */
status bench_guard(const char *name);

/* Creates results/bench and, unless it exists, a NAME.json without rows, by which later files of the bench are
 * recognised. REFUSED as bench_guard; FAILED if the file cannot be written. */
status bench_begin(const char *name);

/* Writes results/bench/NAME.csv (the table named ""), NAME_<table>.csv for others and NAME.json with all tables. */
status bench_write(const char *name, const struct bench_table *table, int tables);

/* Draws results/bench/NAME.png and .svg of width x height pixels. draw: writes the commands to gnuplot; context: its
 * argument. */
status bench_draw(const char *name, int width, int height, void (*draw)(FILE *to, const void *context),
                  const void *context);

/* Prints a line about the processor and one about the program. */
void bench_print_machine(int threads);

/* ---- bench_results.c: figures in bench/results ------------------------------------------------------------------- */

/* Standard output while it is kept, and the lines that precede results. */
struct bench_results {
    FILE *printed;
    int output;
    char head[1024];
};
/* Starts to keep what is printed and the tables that are written. Makes the folder bench/results. REFUSED outside a
 * source tree. */
status bench_results_begin(struct bench_results *r, const char *name, bool quick);
/* Prints what was kept; writes it to bench/results/NAME.txt if the bench succeeded (`measured` is OK). */
status bench_results_end(struct bench_results *r, const char *name, status measured);
/* Writes a table (CSV of at most 250 lines) to bench/results/FILE as well, while results are kept. */
status bench_results_table(const char *file, const char *text);

/* ---- bench_scene.c: runs for timing ------------------------------------------------------------------------------ */

/* Reads a scene from `text`, or from the file `path` if `text` is NULL, with override[overrides], and creates its run
 * without output. s: must stay valid and at its address until bench_engine_free. */
status bench_engine_make(struct run *e, struct scene *s, const char *path, const char *text,
                         const struct scene_override *override, int overrides);

/* Releases the run and the scene. */
void bench_engine_free(struct run *e, struct scene *s);

/* Computes the velocity v [m/s] at X [m]. */
typedef void bench_field(const void *context, const real *X, real *v);

/* Sets the velocities of all particles, and of the nodes of the reference frame, to field(context, X). */
void bench_engine_start(struct run *e, bench_field *field, const void *context);

/* Runs to the end of step `until`, or of the next step at which all levels of coarse cells have the same time; between
 * such steps the energy is not balanced, and a sample would disturb the run. The last step is a sample. spent: the
 * times of the sections of a step are added; may be NULL. */
status bench_engine_run(struct run *e, int64_t until, struct timers *spent);

/* Overrides whose texts are composed one by one; the pointers in `at` are set by bench_overrides_ready. */
enum { OVERRIDES_MAX = 24, OVERRIDE_LENGTH = 160 };
struct bench_overrides {
    int n;
    struct scene_override at[OVERRIDES_MAX];
    char value[OVERRIDES_MAX][OVERRIDE_LENGTH];
};

/* Appends an override. value: format of printf; key: borrowed. */
void bench_override(struct bench_overrides *o, const char *key, const char *value, ...)
    __attribute__((format(printf, 3, 4)));

/* Sets the pointers and returns the overrides as arguments for scene readers; valid until the next bench_override. */
const struct scene_override *bench_overrides_ready(struct bench_overrides *o);

/* A quantity of a probe. */
struct bench_figure {
    const char *probe, *quantity;
    double value;
};

/* Stores the values of those quantities figure[n] that probes of the run have; others keep their value. */
void bench_figures_take(const struct run *e, struct bench_figure *figure, int n);

/* Runs a scene to its end, and its counterpart with material points only if a pulse probe compares with it. Stores
 * quantities of its probes in figure[n]; NAN if a probe has none. path, text: as for bench_engine_make. */
status bench_figures(const char *path, const char *text, struct bench_overrides *o, struct bench_figure *figure, int n);

/* Returns true if the scene file exists; else prints a line about it. */
bool bench_scene_exists(const char *path);

/* Checks that all scene files path[n] of a bench exist. REFUSED if one is missing. */
status bench_scenes_needed(const char *bench, const char *const *path, size_t n);

/* Removes a folder with its contents. */
void bench_folder_remove(const char *folder);

/* A run as a separate process (`cleave run`). Its output remains in `folder` until bench_child_free. */
struct bench_child {
    int process;      /* process id; 0: not running */
    char folder[64];  /* "": none */
    double processor; /* processor time of all its threads, after its end [s] */
};

/* Starts a run of the scene `path` with override[overrides] on `threads` threads. FAILED if no process can be
 * started. */
status bench_child_start(struct bench_child *c, const char *path, const struct scene_override *override, int overrides,
                         int threads);

/* Waits for the run. FAILED unless it exited with status 0. */
status bench_child_wait(struct bench_child *c);
/* Waits for the run if it has not ended, and removes its folder. */
void bench_child_free(struct bench_child *c);
/* Runs a scene as a separate process on one thread, reads n numbers of its summary.json by key[n] into value[n], and
 * removes its output. */
status bench_child_figures(const char *path, const struct scene_override *override, int overrides,
                           const char *const *key, double *value, int n);

/* Returns a pseudo-random number, uniform in [-1, 1) and equal on all machines, from a linear congruential generator,
 * which suffices to perturb particles. seed: state. */
static inline double bench_random(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-52 - 1;
}

/* ---- bench_blocks.c: blocks of any size -------------------------------------------------------------------------- */

/* A method on a square or a cube. */
struct bench_block {
    const char *name;
    int dim;
    const char *method, *frame; /* values of scene keys */
};
enum { BENCH_BLOCKS = 10 };
extern const struct bench_block bench_blocks[BENCH_BLOCKS];

/* Creates a run with about `particles` particles, at least 12 along an edge. out: may be NULL. Release with
 * bench_engine_free. */
status bench_block_make(struct run *e, struct scene *s, const struct bench_block *b, double particles, int64_t steps,
                        int frames, struct output *out);

/* ---- the benches ------------------------------------------------------------------------------------------------- */

/* Measures every kernel instance relative to the limits of the machine, and the targets. quick: few repetitions. */
status bench_kernels(bool quick);

/* Number of threads of the performance targets (bench_targets.c), which are measured for inputs/kalthoff_winkler.yaml
 * at a spacing of 0.5 mm. */
enum { TARGET_THREADS = 2 };

/* A measured quantity and its target: measured / limit <= asked, or >= asked if `at_least`. factor: from SI to the
 * printed unit. */
struct target_figure {
    const char *name, *unit;
    double factor, measured, limit, asked;
    bool at_least;
};
enum { SPEED_TARGETS_MAX = 8 };

/* All measured quantities, and the times of the sections of a step. */
struct targets {
    int figures;
    struct target_figure figure[SPEED_TARGETS_MAX]; /* [figures] */
    struct bench_table timers;
};

/* Measures the peak memory. Call before anything large is allocated: a child process inherits the high-water mark of
 * its parent. */
status bench_targets_memory(struct targets *f);

/* Measures speed and bandwidth. quick: few repetitions. */
status bench_targets_speed(struct targets *f, bool quick);

/* Prints the quantities beside their targets. */
void bench_targets_print(const struct targets *f);

/* Adds the quantities to a table. */
void bench_targets_table(const struct targets *f, struct bench_table *t);

/* Measures the effect of an interface between material points and bonds on waves and on uniform strain
 * (bench_coupling.c). */
status bench_coupling(bool quick);

/* Measures error against computing time of every method on problems with known solutions; continues an interrupted
 * measurement (bench_accuracy.c). */
status bench_accuracy(bool quick);

/* Runs a part of bench_accuracy. only: NULL for all, the name of a problem, `chart` (writes the chart), `auto` (tests
 * method auto) or `reference` (recomputes the cracks of accuracy_reference.h). */
status bench_accuracy_of(const char *only, bool quick);

/* Compares stress-intensity factors, static and dynamic, with closed forms and published tables (bench_sif.c). */
status bench_sif(bool quick);

/* Measures strong and weak scaling on 1 ... all cores (bench_threads.c). */
status bench_threads(bool quick);

/* Measures time and memory per particle, set-up and output over the number of particles (bench_scale.c). */
status bench_scale(bool quick);

/* Measures particles, memory and time of Kalthoff's plate over its spacing (scale_growth.c). */
status bench_growth(bool quick);

/* Runs bench_growth including the finest spacing in 3D. */
status bench_growth_finest(bool quick);

/* Measures a crack in a plate with coarse cells far from the crack, a hundred times larger in area than the region
 * around the crack (scale_field.c). */
status bench_far_field(bool quick);

/* Compares a block and a plate in Cleave and in LAMMPS, if `lmp` is installed (bench_peers.c). */
status bench_peers(bool quick);

/* Times a copper Taylor bar of material points that yields and one that does not, prints both beside the recorded time
 * of MPM3D-F90 and writes peers_bar.csv (peers_bar.c). Returns FAILED if a run or a file fails. */
status bench_bar(bool quick);

/* Compares the observed critical time step with the predicted one for every method, and runs scenes in which methods
 * fail, with their thresholds and remedies (bench_stability.c). */
status bench_stability(bool quick);

/* Runs only the long map of bench_stability. only: `lasting` for all of it, or a part of the names of the cases, whose
 * results are only printed. */
status bench_stability_of(const char *only, bool quick);

/* Compares computing times with Table 1 of the paper (bench_efficiency.c). quick: one repetition. */
status bench_efficiency(bool quick);

/* Measures how far the ends of cracks differ between runs that differ only in the time step (bench_sensitivity.c). */
status bench_sensitivity(bool quick);

/* Compares collisions of bodies with closed forms (bench_contact.c). */
status bench_contact(bool quick);

/* Measures the reflection from absorbing faces (bench_absorbing.c). */
status bench_absorbing(bool quick);

/* Tests whether the error bars of `cleave converge` contain the true values (bench_uncertainty.c). */
status bench_uncertainty(bool quick);

/* Tests whether `method: auto` reaches the requested accuracy (bench_pilot.c). */
status bench_pilot(bool quick);

/* Compares cracks with experiments and other codes (bench_experiments.c). */
status bench_experiments(bool quick);

/* Compares laws of materials with closed forms and published values (bench_laws.c). quick: single elements only. */
status bench_laws(bool quick);

/* Compares bonds that soften with the challenge problems of Kamarei et al. 2025 (bench_circles.c). */
status bench_circles(bool quick);

/* Compares load steps with linear elastic fracture mechanics (bench_slow.c). */
status bench_slow(bool quick);

/* Measures start, length, angle and energy of cracks over the time step (bench_steps.c). */
status bench_steps(bool quick);

#endif
