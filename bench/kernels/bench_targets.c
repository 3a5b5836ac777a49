/* Performance targets: whole steps of Kalthoff's plate compared with the limits of the machine, on one and on two
 * threads, and memory. Measurements of limits and runs alternate; the fastest repetition counts. Also measures the time
 * of each section of a step. */
#include <math.h>
#include <stdio.h>

#include "bench/common/bench.h"
#include "output/output_files.h"

#define SCENE "inputs/kalthoff_winkler.yaml"

/* STEPS_WARM: steps before the timed ones; STEPS_TIMED: steps of a timed piece; ROUNDS: timed pieces on one thread
 * and on two, alternately. A run ends before the crack starts. */
enum { STEPS_WARM = 4, STEPS_TIMED = 40, ROUNDS = 3 };

/* A run of the scene at 0.5 mm in which every step moves all particles; if it skipped particles at rest, the limits
 * of the machine would not apply. sampled: true for as many samples as the scene has, false for one in STEPS_TIMED
 * steps. */
struct target_run {
    const char *name;
    bool sampled;
    int overrides;
    struct scene_override override[5];
};

#define COMMON                                                                                                         \
    {"particles.spacing", "0.5mm"}, { "time.active_set", "false" }
#define POINTS(SHAPE)                                                                                                  \
    COMMON, {"method", "mpm"}, {"mpm.shape", SHAPE}, { "mpm.transfer", "flip" }

/* Runs whose time per step has a target. */
enum { RUN_PD, RUN_POINTS, RUN_GIMP, RUN_ADAPTIVE, RUN_PD_SAMPLED, RUN_ADAPTIVE_SAMPLED, RUNS };
static const struct target_run target_runs[RUNS] = {
    [RUN_PD] = {"pd", false, 3, {COMMON, {"method", "pd"}}},
    [RUN_POINTS] = {"mpm linear flip", false, 5, {POINTS("linear")}},
    [RUN_GIMP] = {"mpm gimp flip", false, 5, {POINTS("gimp")}},
    [RUN_ADAPTIVE] = {"adaptive", false, 3, {COMMON, {"method", "adaptive"}}},
    [RUN_PD_SAMPLED] = {"pd sampled as the scene asks", true, 3, {COMMON, {"method", "pd"}}},
    [RUN_ADAPTIVE_SAMPLED] = {"adaptive sampled as the scene asks", true, 3, {COMMON, {"method", "adaptive"}}},
};

/* Times of the fastest repetition of a run, by threads - 1. */
struct timing {
    double seconds[TARGET_THREADS];
    struct timers timers[TARGET_THREADS];
    double particles, bonds;
};

struct targets_bench {
    int threads; /* number of threads: 1 or 2 */
    struct timing run[RUNS];
    double cell_stencil[TARGET_THREADS], points[TARGET_THREADS];
};

/* ---- timing ------------------------------------------------------------------------------------------------------ */

/* Returns the sum of the timers of a time loop, without that of output [s]. l: times of the sections of a step. */
static double loop_of(const struct timers *l)
{
    double sum = 0;
    for (int k = 0; k < TIMERS; k++) sum += k == TIMER_OUTPUT ? 0 : l->spent[k];
    return sum;
}

static void keep_fastest(struct timing *t, int threads, const struct timers *spent)
{
    const double seconds = loop_of(spent) / STEPS_TIMED;
    if (seconds >= t->seconds[threads - 1]) return;
    t->seconds[threads - 1] = seconds;
    t->timers[threads - 1] = *spent;
}

static status targets_time_run(struct targets_bench *b, int which)
{
    const struct target_run *w = &target_runs[which];
    struct timing *t = &b->run[which];
    struct scene s;
    struct run e;
    threads_set_count_and_bind_to_cores(1);
    TRY(bench_engine_make(&e, &s, SCENE, NULL, w->override, w->overrides));
    const real rate = w->sampled ? (real)s.samples / (real)e.clock.steps : 0; /* samples per step */
    s.samples = 0;
    t->particles = (double)e.part.n, t->bonds = (double)e.bonds.n;
    status ran = bench_engine_run(&e, STEPS_WARM, NULL);
    for (int k = 0; k < ROUNDS * b->threads && ran == OK; k++) {
        const int threads = 1 + k % b->threads;
        struct timers spent = {0};
        threads_set_count_and_bind_to_cores(threads);
        s.samples = (int)(rate * (real)(e.clock.step + STEPS_TIMED)); /* in the piece, as the engine counts them */
        ran = bench_engine_run(&e, e.clock.step + STEPS_TIMED, &spent);
        if (ran == OK) keep_fastest(t, threads, &spent);
    }
    bench_engine_free(&e, &s);
    return ran;
}

static void time_probes(struct targets_bench *b, struct microbench_lattice *cell_stencil,
                        struct microbench_points *points)
{
    for (int threads = 1; threads <= b->threads; threads++) {
        threads_set_count_and_bind_to_cores(threads);
        for (int k = 0; k < 20; k++) {
            b->cell_stencil[threads - 1] = fmin(b->cell_stencil[threads - 1], microbench_lattice_run(cell_stencil));
            b->points[threads - 1] = fmin(b->points[threads - 1], microbench_points_run(points));
        }
    }
}

static status time_everything(struct targets_bench *b, int repetitions)
{
    struct microbench_lattice *cell_stencil = microbench_lattice_make(2);
    struct microbench_points *points = microbench_points_make();
    status s = OK;
    for (int r = 0; r < repetitions && s == OK; r++)
        for (int w = 0; w < RUNS && s == OK; w++) {
            time_probes(b, cell_stencil, points);
            s = targets_time_run(b, w);
        }
    microbench_lattice_free(cell_stencil);
    microbench_points_free(points);
    threads_set_count_and_bind_to_cores(1);
    return s;
}

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Appends `figure`, a measured quantity with its target, to f, unless f is full. */
static void add_figure(struct targets *f, struct target_figure figure)
{
    if (f->figures < SPEED_TARGETS_MAX) f->figure[f->figures++] = figure;
}

static void add_speed(struct targets *f, const struct targets_bench *b)
{
    const struct timing *pd = &b->run[RUN_PD], *sampled = &b->run[RUN_PD_SAMPLED], *points = &b->run[RUN_POINTS];
    add_figure(f, (struct target_figure){"full PD, whole step, per directed bond", "ns", 1e9,
                                         pd->seconds[0] / pd->bonds, b->cell_stencil[0], 2.5, false});
    add_figure(f, (struct target_figure){"the same with all samples of the scene", "ns", 1e9,
                                         sampled->seconds[0] / sampled->bonds, b->cell_stencil[0], 2.5, false});
    add_figure(f, (struct target_figure){"all MPM (linear, FLIP), per particle", "ns", 1e9,
                                         points->seconds[0] / points->particles, b->points[0], 3, false});
    if (b->threads < 2) return;
    add_figure(f, (struct target_figure){"gain of two threads, full PD", "", 1, pd->seconds[0] / pd->seconds[1],
                                         b->cell_stencil[0] / b->cell_stencil[1], 0.9, true});
    add_figure(f, (struct target_figure){"gain of two threads, all MPM", "", 1, points->seconds[0] / points->seconds[1],
                                         b->points[0] / b->points[1], 0.9, true});
}

static void add_laps(struct targets *f, const struct targets_bench *b)
{
    bench_table_make(&f->timers, "laps", "method,threads,bonds_s,scatter_s,grid_s,gather_s,convert_s,watch_s,step_s");
    for (int w = 0; w < RUNS; w++)
        for (int threads = 1; threads <= b->threads; threads++) {
            const struct timing *t = &b->run[w];
            bench_table_append_text(&f->timers, target_runs[w].name);
            bench_table_append_number(&f->timers, threads);
            for (int k = 0; k < TIMER_OUTPUT; k++)
                bench_table_append_number(&f->timers, t->timers[threads - 1].spent[k] / STEPS_TIMED / t->particles);
            bench_table_append_number(&f->timers, t->seconds[threads - 1] / t->particles);
        }
}

status bench_targets_measure_speed(struct targets *targets, bool quick)
{
    struct targets_bench b = {.threads = machine_properties().threads_allowed < 2 ? 1 : 2};
    if (!path_is_file(SCENE)) return OK;
    for (int k = 0; k < TARGET_THREADS; k++) {
        b.cell_stencil[k] = b.points[k] = INFINITY;
        for (int w = 0; w < RUNS; w++) b.run[w].seconds[k] = INFINITY;
    }
    TRY(time_everything(&b, quick ? 1 : 4));
    add_speed(targets, &b);
    add_laps(targets, &b);
    return OK;
}

/* ---- memory ------------------------------------------------------------------------------------------------------ */

/* Runs the scene of the benches for 1 us with the overrides of w as a separate process, and stores its peak memory per
 * particle in *peak [byte]. Returns FAILED if the run fails. */
static status peak_per_particle(const struct target_run *w, double *peak)
{
    static const char *const key[] = {"memory_peak_bytes", "particles"};
    struct scene_override override[8] = {{"output.frames", "0"}, {"output.samples", "10"}, {"duration", "1us"}};
    double value[2];
    for (int k = 0; k < w->overrides; k++) override[3 + k] = w->override[k];
    TRY(bench_child_run_and_read_summary(SCENE, override, 3 + w->overrides, key, value, 2));
    *peak = value[0] / value[1];
    return OK;
}

status bench_targets_measure_memory(struct targets *targets)
{
    static const struct {
        int run;
        const char *name;
        double asked;
    } asked[] = {{RUN_PD, "peak memory per particle, full PD", 1200},
                 {RUN_POINTS, "peak memory per particle, all MPM", 500}};
    if (!bench_scene_exists(SCENE)) return OK;
    for (size_t k = 0; k < COUNT_OF(asked); k++) {
        double peak;
        if (peak_per_particle(&target_runs[asked[k].run], &peak) != OK)
            printf("  %s: not measured: %s\n", asked[k].name, status_message());
        else
            add_figure(targets, (struct target_figure){asked[k].name, "B", 1, peak, 1, asked[k].asked, false});
    }
    return OK;
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Returns true if the quantity a meets its target. The ratio of the measured value to the limit of the machine must be
 * at most a->asked, or at least a->asked if a->at_least is true. */
static bool met(const struct target_figure *a)
{
    const double ratio = a->measured / a->limit;
    return a->at_least ? ratio >= a->asked : ratio <= a->asked;
}

static void print_timers(const struct bench_table *t)
{
    printf("  where a step goes, ns per particle (0.5 mm; one sample in %d steps unless said otherwise)\n    %-36s",
           STEPS_TIMED, "threads");
    for (int k = 0; k < TIMER_OUTPUT; k++) printf(" %8s", timer_name[k]);
    printf(" %8s\n", "step");
    for (int64_t row = 0; row < t->cells; row += t->columns) {
        printf("    %-34s %1.0f", t->cell[row].text, t->cell[row + 1].number);
        for (int c = 2; c < t->columns; c++) printf(" %8.2f", 1e9 * t->cell[row + c].number);
        printf("\n");
    }
    printf("\n");
}

void bench_targets_print(const struct targets *targets)
{
    printf("  targets: " SCENE " at 0.5 mm spacing, one thread; gains against the probes' own\n"
           "    %-42s %10s %10s %8s %8s\n",
           "", "measured", "limit", "ratio", "asked");
    for (int k = 0; k < targets->figures; k++) {
        const struct target_figure *a = &targets->figure[k];
        char beside[32] = ""; /* memory has no limit of the machine */
        if (a->limit != 1)
            snprintf(beside, sizeof beside, "%10.3f %8.3f", a->limit * a->factor, a->measured / a->limit);
        printf("    %-42s %7.3f %-2s %19s  %s %5.4g  %s\n", a->name, a->measured * a->factor, a->unit, beside,
               a->at_least ? ">=" : "<=", a->asked, met(a) ? "ok" : "NOT MET");
    }
    printf("\n");
    if (targets->timers.cells) print_timers(&targets->timers);
}

void bench_targets_add_to_table(const struct targets *targets, struct bench_table *table)
{
    bench_table_make(table, "targets", "figure,measured,limit,ratio,asked,met");
    for (int k = 0; k < targets->figures; k++) {
        const struct target_figure *a = &targets->figure[k];
        const double number[] = {a->measured, a->limit, a->measured / a->limit, a->asked, met(a)};
        char name[NAME_MAX_LENGTH];
        snprintf(name, sizeof name, "%s", a->name);
        for (char *c = name; *c; c++) *c = *c == ',' ? ';' : *c; /* a comma would end the cell */
        bench_table_append_text(table, name);
        for (size_t c = 0; c < COUNT_OF(number); c++) bench_table_append_number(table, number[c]);
    }
}
