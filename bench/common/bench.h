/* Declarations shared by the benches: tables written as CSV and JSON, and runs for timing. */
#ifndef CLEAVE_BENCH_BENCH
#define CLEAVE_BENCH_BENCH

#include "engine/engine.h"
#include "kernels/microbench/microbench.h"

/* Runs `cleave bench`. argv[argc]: words of the command line after `cleave`, starting with "bench". Returns REFUSED if
 * a name is unknown or a bench cannot run here, FAILED if a bench fails. */
status command_bench(int argc, char **argv);

#define BENCH_FOLDER "results/bench"

/* ---- bench_output.c: tables -------------------------------------------------------------------------------------- */

/* A cell of a table: a text, or a number if `text` is empty. */
struct bench_cell {
    char text[NAME_MAX_LENGTH];
    double number;
};

/* A table of results of a bench: its name, the names of its columns, and its cells. */
struct bench_table {
    const char *name;   /* "" for the main table of a bench */
    const char *header; /* names of the columns, separated by commas */
    int columns;
    int64_t cells;
    struct bench_cell *cell; /* [cells] row by row */
};

/* Initialises t as an empty table. name: "" for the main table of a bench, else part of the file name; header: names of
 * the columns, separated by commas. Both texts are kept by reference. Release with bench_table_free. */
void bench_table_make(struct bench_table *t, const char *name, const char *header);

/* Appends a text as the next cell of table t; cells are filled row by row. In files commas and quotation marks become
 * semicolons. */
void bench_table_append_text(struct bench_table *t, const char *text);

/* Appends a number as the next cell of table t. A number that is not finite is an empty cell in CSV files and null in
 * JSON. */
void bench_table_append_number(struct bench_table *t, double number);

/* Releases the cells of the table t (bench_table_make). */
void bench_table_free(struct bench_table *t);

/* Creates the folder results/bench unless it exists. Returns REFUSED if it is a symbolic link, FAILED if it cannot be
 * created. */
status bench_create_results_folder(void);

/* Checks that the bench `bench_name` (NAME) may write its files, so that no file of a user is overwritten. Returns
 * REFUSED if results/bench has a file NAME.json that no bench wrote, or, without NAME.json, such a NAME.csv, .png or
 * .svg. */
status bench_check_files_may_be_replaced(const char *bench_name);

/* Prepares the files of the bench `bench_name` (NAME): creates results/bench and, unless it exists, a NAME.json without
 * rows, by which files of the bench are recognised later. Returns REFUSED if files with these names were not written by
 * a bench, FAILED if the file cannot be written. */
status bench_prepare_result_files(const char *bench_name);

/* Writes the results of the bench `bench_name` (NAME) to results/bench: NAME.csv for the table named "",
 * NAME_<table>.csv for others and NAME.json with all of table[table_count]. Returns REFUSED if files with these names
 * were not written by a bench, FAILED if a file cannot be written. */
status bench_write_result_tables(const char *bench_name, const struct bench_table *table, int table_count);

/* Draws the pictures results/bench/NAME.png and NAME.svg of the bench `bench_name` (NAME), width x height pixels.
 * draw(to, context): writes the commands of the picture to gnuplot. Returns FAILED if gnuplot fails. */
status bench_draw(const char *bench_name, int width, int height, void (*draw)(FILE *to, const void *context),
                  const void *context);

/* Prints a line with the processor, the version of the program, its kernels and the number of threads, `thread_count`.
 */
void bench_print_machine(int thread_count);

/* ---- bench_results.c: results in bench/results ------------------------------------------------------------------- */

/* State while the standard output of a bench is collected. printed: temporary file that receives it; output: copy of
 * the descriptor of the standard output; head: lines that precede the results. */
struct bench_results {
    FILE *printed;
    int output;
    char head[1024];
};

/* Begins to collect what the bench `bench_name` prints and the tables that it writes, and makes the folder
 * bench/results. Stores the state of the collection in *r. quick: true if the bench runs with --quick, which is stated
 * in the results. Returns REFUSED outside a source tree, FAILED if a file cannot be created. */
status bench_results_begin(struct bench_results *r, const char *bench_name, bool quick);

/* Ends the collection r that bench_results_begin began and prints the collected output. If the bench succeeded
 * (`bench_status` is OK), also writes the output to bench/results/NAME.txt with NAME = bench_name. Returns
 * `bench_status` if it is not OK, else FAILED if the file cannot be written, else OK. */
status bench_results_end(struct bench_results *r, const char *bench_name, status bench_status);

/* Writes the table `text` (CSV) to the file bench/results/FILE with FILE = file_name. Does nothing unless results are
 * being collected (bench_results_begin), or if the table has more than 250 lines. Returns FAILED if the file cannot be
 * written. */
status bench_results_copy_table(const char *file_name, const char *text);

/* ---- bench_scene.c: runs for timing ------------------------------------------------------------------------------ */

/* Reads a scene from `text` or, if `text` is NULL, from the file `path`, with the overrides override[override_count],
 * and creates its run in *run, without output. path: if `text` is given, the name of the scene in messages. s: receives
 * the scene and must keep its address until bench_engine_free. Returns REFUSED or FAILED if the scene is invalid or the
 * run cannot be created; *run and *s are then already released. */
status bench_engine_make(struct run *run, struct scene *s, const char *path, const char *text,
                         const struct scene_override *override, int override_count);

/* Releases the run and its scene s, which bench_engine_make has created. */
void bench_engine_free(struct run *run, struct scene *s);

/* Type of a function that computes the velocity v[dim] [m/s] at the reference position X[dim] [m]. context: the
 * argument `context` of bench_engine_set_velocities. */
typedef void bench_field(const void *context, const real *X, real *v);

/* Sets the velocities of all particles, and of the grid nodes of the reference frame, to the values of `velocity_field`
 * at their reference positions. context: passed to `velocity_field`. */
void bench_engine_set_velocities(struct run *run, bench_field *velocity_field, const void *context);

/* Continues the run to the end of step `last_step` or, if the mesh has coarse cells, which make longer time steps, to
 * the next step at which all cells have the same time: before, the energy is not balanced, and a sample of results
 * would disturb the run. The last step is sampled. section_times: receives, by addition, the times of the sections of a
 * step; may be NULL. Returns FAILED if a step fails. */
status bench_engine_run(struct run *run, int64_t last_step, struct timers *section_times);

/* Overrides of scene keys whose values are composed one by one. at[n]: keys, and pointers to the values that
 * bench_overrides_as_array sets; value[n]: the values. */
enum { OVERRIDES_MAX = 24, OVERRIDE_LENGTH = 160 };
struct bench_overrides {
    int n;
    struct scene_override at[OVERRIDES_MAX];
    char value[OVERRIDES_MAX][OVERRIDE_LENGTH];
};

/* Appends an override to *o. key: scene key, kept by reference; value: its value, a format of printf followed by its
 * arguments. */
void bench_overrides_append(struct bench_overrides *o, const char *key, const char *value, ...)
    __attribute__((format(printf, 3, 4)));

/* Sets the pointers to the values of the overrides in *list and returns them as an array of list->n entries, as
 * functions that read scenes expect it. The array is part of *list and valid until the next bench_overrides_append. */
const struct scene_override *bench_overrides_as_array(struct bench_overrides *list);

/* A result of a probe of a run: the names of the probe and of the quantity, and the value in SI units. */
struct bench_figure {
    const char *probe, *quantity;
    double value;
};

/* Stores the current values of probe results of the run in the entries of figure[figure_count] that name their probe
 * and quantity; entries for which the run has no such result keep their value. */
void bench_figures_read_from_probes(const struct run *run, struct bench_figure *figure, int figure_count);

/* Runs a scene to its end and stores quantities of its probes in figure[figure_count]; NAN if no probe has them. If a
 * pulse probe compares its results with those of material points alone, the scene is also run with material points
 * alone. The scene is `text` or, if `text` is NULL, the file `path`; overrides: overrides of the scene. Returns REFUSED
 * or FAILED if the scene is invalid or a step fails. */
status bench_run_scene_and_read_figures(const char *path, const char *text, struct bench_overrides *overrides,
                                        struct bench_figure *figure, int figure_count);

/* Returns true if the scene file `path` exists. Otherwise prints that the scene is left out and returns false. */
bool bench_scene_exists(const char *path);

/* Checks that all scene files path[path_count] exist. bench_name: name of the bench for the message. Returns REFUSED if
 * a file is missing. */
status bench_check_scenes_exist(const char *bench_name, const char *const *path, size_t path_count);

/* Removes a folder with its contents. Failures are ignored. */
void bench_folder_remove(const char *folder);

/* A run as a separate process (`cleave run`). Its output remains in `folder` until bench_child_wait_and_remove_output.
 */
struct bench_child {
    int process;      /* process id; 0: not running */
    char folder[64];  /* "": none */
    double processor; /* processor time of all its threads, after its end [s] */
};

/* Starts a run of the scene file `path` with override[override_count] on `thread_count` threads as a separate process,
 * whose output goes to a new folder child->folder. Returns FAILED if the folder or the process cannot be created.
 * Release with bench_child_wait_and_remove_output. */
status bench_child_start(struct bench_child *child, const char *path, const struct scene_override *override,
                         int override_count, int thread_count);

/* Waits for the end of the process `child` and stores its processor time in child->processor. Returns FAILED unless it
 * exited with status 0. */
status bench_child_wait(struct bench_child *child);

/* Waits for the process `child` if it has not ended, and removes its output folder. */
void bench_child_wait_and_remove_output(struct bench_child *child);

/* Runs the scene file `path` with the overrides override[override_count] as a separate process on one thread, reads the
 * numbers called key[value_count] of its summary.json into value[value_count], and removes the output of the run.
 * Returns FAILED if the run fails or a number is missing. */
status bench_child_run_and_read_summary(const char *path, const struct scene_override *override, int override_count,
                                        const char *const *key, double *value, int value_count);

/* Returns a pseudo-random number, uniform in [-1, 1) and equal on all machines, from a linear congruential generator,
 * which suffices to perturb particles. generator_state: state of the generator, which is advanced. */
static inline double bench_random(uint64_t *generator_state)
{
    *generator_state = *generator_state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*generator_state >> 11) * 0x1p-52 - 1;
}

/* ---- bench_blocks.c: blocks of any size -------------------------------------------------------------------------- */

/* A numerical method applied to a square (dim 2) or a cube (dim 3), for timing. */
struct bench_block {
    const char *name;
    int dim;
    const char *method, *frame; /* values of scene keys */
};
enum { BENCH_BLOCKS = 10 };
extern const struct bench_block bench_blocks[BENCH_BLOCKS];

/* Creates the run of a block for timing, with its scene in *s. b: method and dimension; approximate_particle_count:
 * approximate number of particles, at least 12 along an edge; step_count: number of time steps; frame_count: number of
 * frames in the output `output`, which may be NULL for a run without output. Returns REFUSED or FAILED if the scene is
 * invalid. Release with bench_engine_free. */
status bench_block_make(struct run *run, struct scene *s, const struct bench_block *b,
                        double approximate_particle_count, int64_t step_count, int frame_count, struct output *output);

/* ---- the benches ------------------------------------------------------------------------------------------------- */

/* Times every kernel and compares it with the limits of the machine (memory bandwidth and arithmetic), and compares
 * times and memory of whole runs with their targets (bench_kernels.c). quick: few repetitions. */
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

/* Measurements for the performance targets: all measured quantities, and the times of the sections of a step. */
struct targets {
    int figures;
    struct target_figure figure[SPEED_TARGETS_MAX]; /* [figures] */
    struct bench_table timers;
};

/* Runs scenes as separate processes, measures their peak memory per particle, and adds it with its target to *targets.
 * Call this function before this process allocates much memory, since a child process inherits the high-water mark of
 * its parent. Returns FAILED if a run fails. */
status bench_targets_measure_memory(struct targets *targets);

/* Measures the time per step of whole runs and the memory bandwidth, and adds them with their targets to *targets.
 * quick: few repetitions. Returns FAILED if a run fails. */
status bench_targets_measure_speed(struct targets *targets, bool quick);

/* Prints to standard output the measured quantities in `targets` beside their targets. */
void bench_targets_print(const struct targets *targets);

/* Adds a row for each measured quantity in `targets` to `table`. */
void bench_targets_add_to_table(const struct targets *targets, struct bench_table *table);

/* Measures the effect of an interface between material points and bonds on waves and on uniform strain
 * (bench_coupling.c). quick: fewer cases. */
status bench_coupling(bool quick);

/* Measures the error against the computing time of every method on problems with known solutions. Results of an
 * earlier, interrupted measurement are used (bench_accuracy.c). quick: coarse resolutions and few methods. */
status bench_accuracy(bool quick);

/* Runs a part of bench_accuracy. problem_name: NULL for all, the name of a problem, `chart` to draw the known results
 * without runs, or `reference` to recompute the cracks in accuracy_reference.h. quick: coarse resolutions and few
 * methods. Returns REFUSED if there is no such problem. */
status bench_accuracy_of_problem(const char *problem_name, bool quick);

/* Compares stress-intensity factors, static and dynamic, with closed forms and published tables (bench_sif.c). quick:
 * fewer cases and coarse spacings. */
status bench_sif(bool quick);

/* Measures strong and weak scaling on 1 ... all cores (bench_threads.c). quick: small blocks and few steps. */
status bench_threads(bool quick);

/* Measures time and memory per particle, set-up time and the time of output for blocks of 1e4 to 1e7 particles
 * (bench_scale.c). quick: smaller blocks, two sizes only. */
status bench_scale(bool quick);

/* Measures how the numbers of particles, memory and time of Kalthoff's plate grow as the spacing decreases
 * (scale_growth.c). quick: few and short runs. */
status bench_growth_of_cost_with_resolution(bool quick);

/* Makes the measurements of `scale=growth` (Kalthoff's plate at decreasing spacing) including the finest spacing in 3D,
 * which takes long. quick: few and short runs. */
status bench_growth_of_cost_to_finest_spacing(bool quick);

/* Measures the cost of a crack in a large plate, whose area is a hundred times that of the region around the crack,
 * with coarse grid cells or absorbing faces far from the crack (scale_field.c). quick: coarse spacing. */
status bench_cost_of_coarse_far_field(bool quick);

/* Compares speed and results of a block and a plate in Cleave and in LAMMPS, if its program `lmp` is installed
 * (bench_peers.c). quick: small cases. */
status bench_peers(bool quick);

/* Times a copper Taylor bar of material points that yields and one that does not, prints both beside the recorded time
 * of MPM3D-F90 and writes peers_bar.csv (peers_bar.c). quick: coarse and short runs. Returns FAILED if a run or a file
 * fails. */
status bench_taylor_bar(bool quick);

/* Compares the observed critical time step with the predicted one for every method, and runs scenes in which methods
 * fail, with their thresholds and remedies (bench_stability.c). quick: fewer cases and steps. */
status bench_stability(bool quick);

/* Runs only the long runs of bench_stability, which measure the drift of the energy (energy_drift.c). case_name_part:
 * `lasting` for all cases, whose results are written to files, or a part of the names of the cases, whose results are
 * only printed. quick: shorter runs, of `lasting` only a quarter of the cases. */
status bench_stability_of_energy(const char *case_name_part, bool quick);

/* Compares the computing times of adaptive runs and of full peridynamics, and with Table 1 of Zeng et al. 2022
 * (bench_efficiency.c). quick: short scenes and one repetition. */
status bench_efficiency(bool quick);

/* Measures how far the crack tips at the end of runs differ between runs that differ only in the time step
 * (bench_sensitivity.c). quick: fewer scenes and time steps. */
status bench_sensitivity(bool quick);

/* Compares collisions of bodies with closed forms (bench_contact.c). quick: without the long runs. */
status bench_contact(bool quick);

/* Measures how much of a wave absorbing faces reflect (bench_absorbing.c). quick: fewer dimensions and angles. */
status bench_absorbing(bool quick);

/* Tests whether the error bars of `cleave converge` contain the exact values (bench_uncertainty.c). quick: one spacing
 * and fewer runs for each case. */
status bench_uncertainty(bool quick);

/* Tests whether `method: auto` reaches the requested accuracy (bench_pilot.c). quick: one accuracy only. */
status bench_pilot(bool quick);

/* Compares cracks with published experiments and other codes; takes hours (bench_experiments.c). quick: fewer cases and
 * spacings. */
status bench_experiments(bool quick);

/* Compares material laws with closed forms and published values (bench_laws.c). quick: only single elements, no
 * bodies. */
status bench_laws(bool quick);

/* Compares bonds that soften with the challenge problems of Kamarei et al. 2025 (bench_circles.c). quick: one spacing
 * only. */
status bench_circles(bool quick);

/* Runs and prints only those cases of bench_circles (bonds that soften, compared with challenge problems) whose name of
 * the problem contains `circle_name_part`, such as `notch 1.5`. quick: one spacing only. Returns REFUSED if there is no
 * such case. */
status bench_circles_of_name(const char *circle_name_part, bool quick);

/* Compares slow crack growth in load steps with linear elastic fracture mechanics (bench_slow.c). quick: fewer cases
 * and coarse spacings. */
status bench_slow(bool quick);

/* Measures how start time, length, angle and energy of cracks depend on the time step (bench_steps.c). quick: short
 * scenes and one model only. */
status bench_steps(bool quick);

#endif
