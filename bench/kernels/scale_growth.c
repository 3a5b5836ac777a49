/* `cleave bench scale=growth`: growth of cost with resolution. Measures particles, memory and time of Kalthoff's plate
 * in 2D and 3D, in adaptive runs with coarse cells, and with full peridynamics where that is affordable. Each run is a
 * separate process on one thread: its memory is the high-water mark of that process, its time that of the loop times
 * the share of a processor that the process received, to exclude the load of other programs; for short loops the least
 * of three.
 *
 * Coarse cells are at most 2 mm at any spacing, as `mpm.levels: auto` chooses in a plate of this size under a sudden
 * load if it has enough particles. Time steps are proportional to the spacing. Exponents are per halving of the
 * spacing, by least squares of the logarithms; without coarse cells the exponent of particles and bytes is the
 * dimension, that of time one more. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench/common/bench.h"
#include "bench/common/bench_goals.h"
#include "base/memory.h"
#include "output/summary_read.h"
#include "plot/gnuplot.h"

/* SPACINGS: largest number of spacings of a series; TIMERS_SHOWN: sections of a step that are printed; SERIES:
 * number of series; AIMS: quantities with required exponents; REPEATED: repetitions of a run. */
enum { SPACINGS = 5, TIMERS_SHOWN = TIMER_OUTPUT, SERIES = 4, AIMS = 3, REPEATED = 3 };
#define SHORT 3.0          /* loops shorter than this are repeated [s] */
#define QUICK_DURATION 6.0 /* end of quick runs [us] */
#define STEP_PER_MM 0.05   /* time step at a spacing of 1 mm [us] */

/* A method and a plate at several spacings, from coarse to fine. */
struct growth_series {
    const char *name, *path, *method;
    int dim;
    double spacing[SPACINGS]; /* [mm]; ends with 0 */
    int quick, usual;         /* number of spacings with --quick, and without the finest */
    double aim[AIMS];         /* required exponents of particles, bytes, time; NAN: none */
};
#define PLATE "inputs/kalthoff_winkler.yaml"
#define HALF_PLATE "inputs/kalthoff_3d_fine.yaml"
static const struct growth_series series[SERIES] = {
    {"adaptive", PLATE, "adaptive", 2, {1, 0.5, 0.25, 0.125}, 3, 4, {1.3, 1.3, 2.3}},
    {"pd", PLATE, "pd", 2, {1, 0.5, 0.25}, 2, 3, {NAN, NAN, NAN}},
    {"adaptive", HALF_PLATE, "adaptive", 3, {2, 1, 0.5, 0.25, 0.125}, 2, 4, {2.3, 2.3, 3.3}},
    {"pd", HALF_PLATE, "pd", 3, {2, 1, 0.5}, 2, 3, {NAN, NAN, NAN}},
};

struct growth_row {
    bool known;
    double spacing;                                   /* [mm] */
    double made, body, bonded, bytes, seconds, share; /* numbers [1], memory [byte], loop time [s], fraction of the
                                                       * critical step */
    double timer[TIMERS_SHOWN];                       /* [s] */
    double start, angle;                              /* start [s] and angle [degree] of the crack */
};

struct growth_fit {
    double of[AIMS], last[AIMS];        /* exponents: over all rows, over the last two */
    enum timer binds;                   /* section of the step that exceeds the goal for time most */
    double binds_exponent, binds_share; /* exponent of that section; its share of the loop at the finest spacing */
};

struct growth_bench {
    struct growth_row at[SERIES][SPACINGS];
    struct growth_fit fit[SERIES];
};

/* ---- one run ----------------------------------------------------------------------------------------------------- */

/* Returns the number of levels of coarse grid cells with which the largest cells are at most 2 mm: cells have two
 * spacings, and each level doubles them. spacing: of the particles [mm]. */
static int mesh_levels_of(double spacing)
{
    int levels = 0;
    while ((4 << levels) * spacing <= 2 * (1 + 1e-9)) levels++;
    return levels;
}

/* Appends the overrides of a run of the series s to *o. spacing: of the particles [mm]; until: end of the run [us], or
 * 0 for that of the scene. */
static void growth_overrides(struct bench_overrides *o, const struct growth_series *s, double spacing, double until)
{
    const double width = 3 * spacing;
    if (until > 0) bench_overrides_append(o, "duration", "%g us", until);
    bench_overrides_append(o, "method", "%s", s->method);
    bench_overrides_append(o, "particles.spacing", "%g mm", spacing);
    bench_overrides_append(o, "time.step", "%.9g us", STEP_PER_MM * spacing);
    bench_overrides_append(o, "output.frames", "0");
    if (s->dim == 2) {
        bench_overrides_append(o, "body[1].add.box.from", "[-%g mm, -25 mm]", width);
        bench_overrides_append(o, "boundary[0].region.box.from", "[-%g mm, -25 mm]", width);
        bench_overrides_append(o, "pd.surface", "none");
    } else {
        bench_overrides_append(o, "body[1].add.box.from", "[-%g mm, 0, 0]", width);
        bench_overrides_append(o, "boundary[0].region.box.from", "[-%g mm, 0, 0]", width);
    }
    if (strcmp(s->method, "pd") == 0) {
        if (s->dim == 3) bench_overrides_append(o, "mpm", "%s", "");
        return;
    }
    bench_overrides_append(o, "mpm.levels", "%d", mesh_levels_of(spacing));
    bench_overrides_append(o, "mpm.fill", "needed");
}

static status growth_read(struct growth_row *r, const char *folder, double processor)
{
    double step, critical, wall, share;
    char key[64];
    const struct {
        const char *key;
        double *value;
    } figure[] = {{"particles_made", &r->made},      {"particles", &r->body},       {"particles_pd_end", &r->bonded},
                  {"memory_peak_bytes", &r->bytes},  {"loop_seconds", &r->seconds}, {"time_step", &step},
                  {"time_step_critical", &critical}, {"wall_seconds", &wall}};
    for (size_t k = 0; k < COUNT_OF(figure); k++) TRY(summary_read_number(folder, figure[k].key, figure[k].value));
    r->start = bench_summary_figure(folder, "crack.start_time");
    r->angle = bench_summary_figure(folder, "crack.angle_deg");
    share = r->seconds < SHORT ? 1 : fmin(1, processor / wall); /* short loops are repeated instead */
    for (int k = 0; k < TIMERS_SHOWN; k++) {
        snprintf(key, sizeof key, "laps.%s", timer_name[k]);
        TRY(summary_read_number(folder, key, &r->timer[k]));
        r->timer[k] *= share;
    }
    r->seconds *= share;
    r->share = step / critical, r->known = true;
    return OK;
}

static status growth_run(struct growth_row *r, const struct growth_series *s, double spacing, double until)
{
    struct bench_overrides o = {0};
    struct bench_child c;
    r->spacing = spacing;
    growth_overrides(&o, s, spacing, until);
    status ran = bench_child_start(&c, s->path, bench_overrides_as_array(&o), o.n, 1);
    if (ran == OK) ran = bench_child_wait(&c);
    if (ran == OK) ran = growth_read(r, c.folder, c.processor);
    bench_child_wait_and_remove_output(&c);
    return ran;
}

/* Makes a run of the series s at a spacing [mm] and stores its results in *least. Runs shorter than SHORT are repeated,
 * and the fastest one is stored. quick: true for one run of the first microseconds. Returns FAILED if a run fails. */
static status growth_time(struct growth_row *least, const struct growth_series *s, double spacing, bool quick)
{
    const int repeated = quick ? 1 : REPEATED;
    for (int k = 0; k < repeated && (k == 0 || least->seconds < SHORT); k++) {
        struct growth_row r = {0};
        TRY(growth_run(&r, s, spacing, quick ? QUICK_DURATION : 0));
        if (k == 0 || r.seconds < least->seconds) *least = r;
    }
    return OK;
}

/* ---- exponents --------------------------------------------------------------------------------------------------- */

/* Returns the slope of log2(y) over -log2(spacing), thus the exponent of y per halving of the spacing, by least squares
 * over row[first] to row[n - 1]. y(row, which): returns quantity number `which` of a row. */
static double exponent_of(const struct growth_row *row, int first, int n, double (*y)(const struct growth_row *, int),
                          int which)
{
    double x1 = 0, y1 = 0, xx = 0, xy = 0;
    for (int k = first; k < n; k++) {
        const double x = -log2(row[k].spacing), value = log2(y(&row[k], which));
        x1 += x, y1 += value, xx += x * x, xy += x * value;
    }
    const double count = n - first;
    return (count * xy - x1 * y1) / (count * xx - x1 * x1);
}

static double cost_of(const struct growth_row *r, int which)
{
    return which == 0 ? r->made : which == 1 ? r->bytes : r->seconds;
}

static double timer_of(const struct growth_row *r, int which) { return fmax(r->timer[which], 1e-6); }

static int rows_of(const struct growth_row *row)
{
    int n = 0;
    while (n < SPACINGS && row[n].known) n++;
    return n;
}

/* Computes into *f the exponents by which particles, memory and time of the series s grow, and finds the section of a
 * step that exceeds its goal most. The goal for the finest run is the time of the section in the coarsest run,
 * extrapolated with the required exponent. row[]: runs of the series from coarse to fine. */
static void growth_fit_make(struct growth_fit *f, const struct growth_row *row, const struct growth_series *s)
{
    const int n = rows_of(row);
    double most = -INFINITY;
    for (int a = 0; a < AIMS; a++) {
        f->of[a] = n > 1 ? exponent_of(row, 0, n, cost_of, a) : NAN;
        f->last[a] = n > 1 ? exponent_of(row, n - 2, n, cost_of, a) : NAN;
    }
    for (int k = 0; k < TIMERS_SHOWN && n > 1; k++) {
        const struct growth_row *coarse = &row[0], *fine = &row[n - 1];
        const double asked = isfinite(s->aim[2]) ? s->aim[2] : s->dim + 1;
        const double beyond = fine->timer[k] - coarse->timer[k] * pow(coarse->spacing / fine->spacing, asked);
        if (beyond <= most) continue;
        most = beyond, f->binds = (enum timer)k;
        f->binds_exponent = exponent_of(row, 0, n, timer_of, k);
        f->binds_share = fine->timer[k] / fine->seconds;
    }
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Prints the header of the table of runs. */
static void growth_print_header(void)
{
    printf("  each run a process on one thread; largest cells 2 mm, time step %g us per mm of spacing, driven strip of "
           "three spacings\n",
           STEP_PER_MM);
    printf("  %-11s %8s %10s %10s %8s %9s %7s %8s %9s %7s |", "", "spacing", "made", "of body", "bonded", "peak MB",
           "byte/m", "of crit", "loop s", "angle");
    for (int k = 0; k < TIMERS_SHOWN; k++) printf(" %7s", timer_name[k]);
    printf("  [s]\n");
}

static void growth_print_row(const struct growth_series *s, const struct growth_row *r)
{
    printf("  %-8s %dD %5g mm %10.0f %10.0f %8.0f %9.1f %7.0f %8.3f %9.3f %7.1f |", s->name, s->dim, r->spacing,
           r->made, r->body, r->bonded, 1e-6 * r->bytes, r->bytes / r->made, r->share, r->seconds, r->angle);
    for (int k = 0; k < TIMERS_SHOWN; k++) printf(" %7.2f", r->timer[k]);
    putchar('\n');
    fflush(stdout);
}

static void growth_print_fits(const struct growth_bench *b)
{
    static const char *const name[AIMS] = {"particles", "bytes", "time"};
    printf("\n  exponents per halving of the spacing, by least squares, and of the last halving alone\n");
    for (int k = 0; k < SERIES; k++) {
        const struct growth_fit *f = &b->fit[k];
        if (rows_of(b->at[k]) < 2) continue;
        for (int a = 0; a < AIMS; a++) {
            const bool missed = f->of[a] > series[k].aim[a];
            printf("    %-8s %dD %-9s %5.2f  last %5.2f", series[k].name, series[k].dim, name[a], f->of[a], f->last[a]);
            if (isfinite(series[k].aim[a])) printf("  aim %.1f  %s", series[k].aim[a], missed ? "MISSED" : "met");
            if (missed && a == 2)
                printf(": the timer `%s` stands in the way (its exponent %.2f, %.0f %% of the finest loop)",
                       timer_name[f->binds], f->binds_exponent, 100 * f->binds_share);
            if (missed && a < 2)
                printf(": %s stands in the way",
                       f->of[0] > series[k].aim[0] ? "the number of particles made" : "memory beside the particles");
            putchar('\n');
        }
    }
}

static status growth_write_table(const struct growth_bench *b)
{
    struct bench_table t[2];
    bench_table_make(&t[0], "",
                     "method,dim,spacing,made,particles,pd_end,bytes,seconds,critical_share,angle_deg,bonds,scatter,"
                     "grid,gather,convert,sample");
    bench_table_make(&t[1], "fit",
                     "method,dim,particles,bytes,time,particles_last,bytes_last,time_last,particles_aim,bytes_aim,"
                     "time_aim");
    for (int k = 0; k < SERIES; k++) {
        for (int j = 0; j < rows_of(b->at[k]); j++) {
            const struct growth_row *r = &b->at[k][j];
            const double row[] = {series[k].dim, 1e-3 * r->spacing, r->made,  r->body, r->bonded,
                                  r->bytes,      r->seconds,        r->share, r->angle};
            bench_table_append_text(&t[0], series[k].name);
            for (size_t c = 0; c < COUNT_OF(row); c++) bench_table_append_number(&t[0], row[c]);
            for (int c = 0; c < TIMERS_SHOWN; c++) bench_table_append_number(&t[0], r->timer[c]);
        }
        if (rows_of(b->at[k]) < 2) continue;
        bench_table_append_text(&t[1], series[k].name), bench_table_append_number(&t[1], series[k].dim);
        for (int a = 0; a < AIMS; a++) bench_table_append_number(&t[1], b->fit[k].of[a]);
        for (int a = 0; a < AIMS; a++) bench_table_append_number(&t[1], b->fit[k].last[a]);
        for (int a = 0; a < AIMS; a++) bench_table_append_number(&t[1], series[k].aim[a]);
    }
    status s = bench_write_result_tables("scale_growth", t, COUNT_OF(t));
    for (size_t k = 0; k < COUNT_OF(t); k++) bench_table_free(&t[k]);
    return s;
}

/* Sends the gnuplot commands of the picture: number of particles, memory and time over the spacing, a panel each.
 * context: a struct growth_bench. */
static void growth_draw(FILE *to, const void *context)
{
    static const char *const title[AIMS] = {"particles made", "peak memory [MB]", "loop [s]"};
    const struct growth_bench *b = context;
    for (int k = 0; k < SERIES; k++) {
        fprintf(to, "$s%d << EOD\n", k);
        for (int j = 0; j < rows_of(b->at[k]); j++) {
            const struct growth_row *r = &b->at[k][j];
            fprintf(to, "%g %.6g %.6g %.6g\n", r->spacing, r->made, 1e-6 * r->bytes, r->seconds);
        }
        if (!rows_of(b->at[k])) fputs("NaN NaN NaN NaN\n", to);
        fputs("EOD\n", to);
    }
    fputs("set multiplot layout 1,3\nset logscale xy\nset xrange [3:0.1] reverse\n"
          "set xtics (2, 1, 0.5, 0.25, 0.125) font ',9'\n"
          "set xlabel 'spacing [mm]'\nset key inside top left\nset format y '%g'\n",
          to);
    for (int a = 0; a < AIMS; a++) {
        fprintf(to, "set title '%s'\nplot ", title[a]);
        for (int k = 0; k < SERIES; k++)
            fprintf(to, "%s$s%d using 1:%d with linespoints pt 7 lw 2 lc rgb '%s' title '%s %dD'", k ? ", " : "", k,
                    a + 2, curve_colour[k], series[k].name, series[k].dim);
        fputc('\n', to);
    }
    fputs("unset multiplot\n", to);
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Measures all series of runs into *b, prints a row for each spacing, fits the exponents, and writes table and picture.
 * quick: few and short runs; finest: true to include the finest spacings. Returns FAILED if a run or a file fails. */
static status growth_measure(struct growth_bench *b, bool quick, bool finest)
{
    bool any = false;
    growth_print_header();
    for (int k = 0; k < SERIES; k++) {
        const struct growth_series *s = &series[k];
        const int rows = quick ? s->quick : finest ? SPACINGS : s->usual;
        if (!bench_scene_exists(s->path)) continue;
        for (int j = 0; j < rows && j < SPACINGS && s->spacing[j] > 0; j++) {
            TRY(growth_time(&b->at[k][j], s, s->spacing[j], quick));
            growth_print_row(s, &b->at[k][j]);
        }
        growth_fit_make(&b->fit[k], b->at[k], s);
        any = true;
    }
    if (!any) return OK;
    growth_print_fits(b);
    TRY(growth_write_table(b));
    return bench_draw("scale_growth", 1400, 500, growth_draw, b);
}

static status growth_bench_run(bool quick, bool finest)
{
    struct growth_bench *b = NEW("bench.growth", 1, struct growth_bench);
    printf("scale: growth\n");
    bench_print_machine(1);
    status s = growth_measure(b, quick, finest);
    memory_free(b);
    return s;
}

status bench_growth_of_cost_with_resolution(bool quick) { return growth_bench_run(quick, false); }
status bench_growth_of_cost_to_finest_spacing(bool quick) { return growth_bench_run(quick, true); }
