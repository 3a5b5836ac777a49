/* What the benches share: tables that become csv and json, the machine's own limits, and engines made for
 * timing. */
#ifndef CLEAVE_BENCH_BENCH
#define CLEAVE_BENCH_BENCH

#include "engine/engine.h"
#include "kernels/microbench/microbench.h"

/* `cleave bench`: words after `cleave`, its own name first. */
status command_bench(int argc, char **argv);

#define BENCH_FOLDER "results/bench"

/* ---- bench_output.c: tables -------------------------------------------------------------------------------------- */

/* A text, or a number where `text` is empty. */
struct bench_cell {
    char text[NAME_MAX_LENGTH];
    double number;
};

struct bench_table {
    const char *name;   /* "" for the main table of a bench */
    const char *header; /* names of the columns, separated by commas */
    int columns;
    int64_t cells;
    struct bench_cell *cell; /* row by row */
};

void bench_table_make(struct bench_table *t, const char *name, const char *header);
/* Fill cell after cell, row after row. In files commas and quotation marks of a text become semicolons. A number
 * that is not finite is left out of the files. */
void bench_text(struct bench_table *t, const char *text);
void bench_number(struct bench_table *t, double number);
void bench_table_free(struct bench_table *t);

status bench_folder_make(void); /* results/bench */
/* REFUSED if results/bench has a file NAME.json, or without it a table or picture of this name, that no bench wrote. */
status bench_guard(const char *name);
/* Makes results/bench and, if it is not there, a NAME.json without rows, by which later files of the bench are
 * recognised. REFUSED as bench_guard; FAILED if the file cannot be written. */
status bench_begin(const char *name);
/* Writes results/bench/NAME.csv (the table named ""), NAME_<table>.csv and, with all tables, NAME.json. */
status bench_write(const char *name, const struct bench_table *table, int tables);
/* Draws results/bench/NAME.png and .svg; `draw` sends gnuplot its commands. */
status bench_draw(const char *name, int width, int height, void (*draw)(FILE *to, const void *context),
                  const void *context);
/* One line about the processor, and one under it about the program. */
void bench_print_machine(int threads);

/* ---- bench_readme.c: figures in bench/README.md ------------------------------------------------------------------ */

/* Standard output while it is kept. */
struct bench_readme {
    FILE *printed;
    int output;
};
/* From `begin` to `end` what is printed is kept; `end` prints it and, if the bench (`measured`) is OK, puts it between
 * the marks of its name. REFUSED before anything is measured if the file or the marks are missing. */
status bench_readme_begin(struct bench_readme *r, const char *name);
status bench_readme_end(struct bench_readme *r, const char *name, bool quick, status measured);

/* ---- bench_scene.c: engines made for timing ---------------------------------------------------------------------- */

/* Reads a scene (`text` NULL: the file `path`) with overrides and makes its engine, without output. The scene must stay
 * where it is. */
status bench_engine_make(struct run *e, struct scene *s, const char *path, const char *text,
                         const struct scene_override *override, int overrides);
void bench_engine_free(struct run *e, struct scene *s);
/* Gives all particles, and the nodes of the reference frame, the velocity field(context, X) [m/s]. */
typedef void bench_field(const void *context, const real *X, real *v);
void bench_engine_start(struct run *e, bench_field *field, const void *context);
/* Goes on to the end of step `until`; the last step is a sample. Adds up laps over calls. */
status bench_engine_run(struct run *e, int64_t until, struct laps *spent);
/* Texts of overrides, made on the way; `at` points into them only once all are added (bench_overrides_ready). */
enum { OVERRIDES_MAX = 24, OVERRIDE_LENGTH = 160 };
struct bench_overrides {
    int n;
    struct scene_override at[OVERRIDES_MAX];
    char value[OVERRIDES_MAX][OVERRIDE_LENGTH];
};
/* `value` as printf writes it; `key` is borrowed. */
void bench_override(struct bench_overrides *o, const char *key, const char *value, ...)
    __attribute__((format(printf, 3, 4)));
/* The entries as readers of scenes take them. */
const struct scene_override *bench_overrides_ready(struct bench_overrides *o);
struct bench_figure {
    const char *probe, *quantity;
    double value;
};
/* Those that probes of a run have; the others keep their value. */
void bench_figures_take(const struct run *e, struct bench_figure *figure, int n);
/* Runs a scene to its end, and its twin on material points if a pulse probe compares with it, and reads figures of
 * its probes: NAN where it has none. */
status bench_figures(const char *path, const char *text, struct bench_overrides *o, struct bench_figure *figure, int n);
/* Says in one line that there is no such scene here, if so. */
bool bench_scene_exists(const char *path);
/* REFUSED unless all scenes that a bench needs are here. */
status bench_scenes_needed(const char *bench, const char *const *path, size_t n);
/* Removes a folder and all that is in it. */
void bench_folder_remove(const char *folder);
/* A scene run as a process of its own (`cleave run`); what it leaves lies in `folder` until bench_child_free. */
struct bench_child {
    int process;      /* 0: none that runs */
    char folder[64];  /* "": none */
    double processor; /* of all its threads, once it has ended [s] */
};
status bench_child_start(struct bench_child *c, const char *path, const struct scene_override *override, int overrides,
                         int threads);
status bench_child_wait(struct bench_child *c); /* FAILED unless it ended well */
void bench_child_free(struct bench_child *c);   /* waits if it still runs, removes its folder */
/* Such a run on one thread, and n numbers of its summary.json; nothing is left of it. */
status bench_child_figures(const char *path, const struct scene_override *override, int overrides,
                           const char *const *key, double *value, int n);

/* Uniform in [-1, 1), the same everywhere: a linear congruence is random enough for shaking bodies. */
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
    const char *method, *frame; /* of the scene */
};
enum { BENCH_BLOCKS = 10 };
extern const struct bench_block bench_blocks[BENCH_BLOCKS];
/* About so many particles, at least 12 along an edge; `out` may be NULL. Free with bench_engine_free. */
status bench_block_make(struct run *e, struct scene *s, const struct bench_block *b, double particles, int64_t steps,
                        int frames, struct output *out);

/* ---- the benches ------------------------------------------------------------------------------------------------- */

/* Every kernel instance beside the machine's limits, and the targets; few repetitions with `quick`. */
status bench_kernels(bool quick);

/* bench_targets.c: targets for inputs/kalthoff_winkler.yaml at a spacing of 0.5 mm, beside the probes. */
enum { TARGET_THREADS = 2 };
struct target_figure {
    const char *name, *unit;
    double factor, measured, limit, asked;
    bool at_least;
};
enum { SPEED_TARGETS_MAX = 8 };
struct targets {
    int figures;
    struct target_figure
        figure[SPEED_TARGETS_MAX]; /* ratio = measured / limit <= target, or >= target; SI x factor: as printed */
    struct bench_table laps;
};
/* Peak memory: before anything large is allocated, since a child process inherits its parent's high-water mark. */
status bench_targets_memory(struct targets *f);
status bench_targets_speed(struct targets *f, bool quick);
void bench_targets_print(const struct targets *f);
void bench_targets_table(const struct targets *f, struct bench_table *t);

/* bench_coupling.c: what an interface of material points and bonds does to waves and uniform strain. */
status bench_coupling(bool quick);

/* bench_accuracy.c: error against loop time of every method on problems with known solutions; goes on where it was
 * broken off. Of one problem alone: NULL or its name; `chart`: writes what method auto chooses from, `auto`: tries
 * method auto, `reference`: finds the cracks of accuracy_reference.h anew. */
status bench_accuracy(bool quick);
status bench_accuracy_of(const char *only, bool quick);

/* bench_sif.c: stress-intensity factors at rest and in motion beside closed forms and published tables. */
status bench_sif(bool quick);

/* bench_threads.c: strong and weak scaling on 1 ... all cores. */
status bench_threads(bool quick);

/* bench_scale.c: time and memory per particle, set-up and output, over the number of particles. */
status bench_scale(bool quick);
/* scale_growth.c: particles, memory and time of Kalthoff's plate over its spacing; finest: with the finest in space. */
status bench_growth(bool quick);
status bench_growth_finest(bool quick);
/* scale_field.c: a crack in a plate of a hundred times the area that matters to it, with coarse cells far away. */
status bench_far_field(bool quick);

/* bench_peers.c: a block and a plate by this program and by LAMMPS, where `lmp` is installed. */
status bench_peers(bool quick);

/* bench_stability.c: the critical time step observed beside the predicted one, for every method; scenes in which
 * methods fail, with their thresholds and remedies. */
status bench_stability(bool quick);
/* Of its long map alone: all of it (`lasting`), or, on the screen only, the cases in whose name this is. */
status bench_stability_of(const char *only, bool quick);

/* bench_efficiency.c: the paper's Table 1 beside ours; one repetition with `quick`. */
status bench_efficiency(bool quick);

/* bench_sensitivity.c: how far the ends of cracks lie apart when nothing but the time step differs. */
status bench_sensitivity(bool quick);

/* bench_contact.c: bodies that meet. */
status bench_contact(bool quick);

/* bench_absorbing.c: what comes back from absorbing faces. */
status bench_absorbing(bool quick);

/* bench_uncertainty.c: are the error bars of `cleave converge` true? */
status bench_uncertainty(bool quick);
/* bench_pilot.c: does `method: auto` keep its word? */
status bench_pilot(bool quick);

/* bench_experiments.c: cracks beside laboratories and other codes. */
status bench_experiments(bool quick);

/* bench_slow.c: load steps beside linear elastic fracture mechanics. */
status bench_slow(bool quick);

/* bench_steps.c: start, length, angle and energy of cracks over the time step. */
status bench_steps(bool quick);

#endif
