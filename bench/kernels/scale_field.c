/* `cleave bench scale=field`: coarse cells and absorbing faces in the far field of a crack. A plane tensile pulse from
 * one edge hits a crack of 10 mm in the middle of a plate of 0.4 m x 0.4 m, a hundred times the area of the 40 mm x 40
 * mm around the crack. K_I(t) of runs with coarse cells far from the crack, and of a part of the plate between
 * absorbing faces, is compared with direct runs: bonds everywhere, and cells of two spacings everywhere. No bond
 * breaks. Half of the plate is modelled, with a mirror.
 *
 * All runs have the same time step, the same samples and one thread; each is a separate process. Loop times are
 * multiplied by the share of a processor that the process received, to exclude the load of other programs. In the part
 * the wave starts nearer to the crack, and its time is shifted accordingly. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench/common/bench.h"
#include "base/memory.h"
#include "output/history.h"
#include "output/output_files.h"
#include "output/summary_read.h"
#include "plot/gnuplot.h"

#define SCENE BENCH_FOLDER "/run-field.yaml"
#define K_AIM 0.02          /* largest allowed difference over the largest K of the direct run */
#define TIME_AIM 20.0       /* required ratio of the loop times of the direct run and a run */
#define HALF 200.0          /* half edge of the plate [mm] */
#define NEAR 40.0           /* distance of the absorbing faces from the crack [mm] */
#define WIDE 70.0           /* half width of the part; reflections from there arrive late [mm] */
#define PULSE_SPACINGS 32.0 /* duration of the pulse [us] over the spacing [mm]: the pulse is 190 spacings long */
#define STEP_SPACINGS 0.16  /* time step [us] over the spacing [mm] */
#define SEEN 0.9            /* share of the pulse that is compared: before the crack closes */

static const double young = 72e9, poisson = 0.25, density = 2440;

static const struct field_run {
    const char *name, *method;
    int levels; /* levels of coarse cells; -1: no cells */
    bool part;
} field_runs[] = {{"bonds everywhere", "pd", -1, false},     {"cells of 2 spacings", "adaptive", 0, false},
                  {"cells up to 4", "adaptive", 1, false},   {"cells up to 8", "adaptive", 2, false},
                  {"cells up to 16", "adaptive", 3, false},  {"cells up to 32", "adaptive", 4, false},
                  {"part, cells of 2", "adaptive", 0, true}, {"part, cells up to 8", "adaptive", 2, true}};
enum { FIELD_RUNS = COUNT_OF(field_runs), DIRECT = 2, FIELD_SAMPLES = 100 };

struct field_row {
    double made, body, bytes, seconds, sampling, timer[TIMERS];
    int64_t n;
    double t[FIELD_SAMPLES + 2], K[FIELD_SAMPLES + 2], peak; /* time [s]; K [Pa m^0.5] */
    double off[DIRECT];                                      /* difference from each direct run [1] */
};

struct field_bench {
    double spacing, speed, pulse; /* [mm] [m/s] [s] */
    struct field_row at[FIELD_RUNS];
};

/* ---- scene ------------------------------------------------------------------------------------------------------- */

/* Writes the scene of the whole plate or, if `part` is true, of a part of it between absorbing faces. The load of the
 * part has twice the stress of the wave, since it acts on an absorbing face, which takes up half of it. b: spacing,
 * wave speed and pulse. Returns FAILED if the file cannot be written. */
static status field_scene_write(const struct field_bench *b, bool part)
{
    const double high = part ? NEAR : HALF, wide = part ? WIDE : HALF;
    TRY(bench_create_results_folder());
    FILE *to = fopen(SCENE, "w");
    if (!to) return file_report_write_failure(SCENE, errno);
    fprintf(to, "space: plane strain\nthickness: 1 mm\nduration: %.9g\nmethod: adaptive\n",
            1e-3 * high / b->speed + SEEN * b->pulse);
    fprintf(to, "material: {young: %g, poisson: %g, density: %g}\n", young, poisson, density);
    fprintf(to, "body: {box: {from: [0, -%g mm], to: [%g mm, %g mm]}}\n", high, wide, high);
    fprintf(to, "particles: {spacing: %g mm}\ntime: {step: %.9g us}\n", b->spacing, STEP_SPACINGS * b->spacing);
    fprintf(to, "cracks: [{from: [-1 mm, 0], to: [5 mm, 0]}]\nboundary:\n  - {mirror: {axis: x, at: 0}}\n");
    fprintf(to, "  - {mirror: {axis: x, at: %g mm}}\n", wide);
    fprintf(to, "  - {traction: [0, %g MPa], face: y-, time: {pulse: {until: %.9g}}}\n", part ? -2.0 : -1.0, b->pulse);
    if (part) fputs("  - {absorbing: true, face: y-}\n  - {absorbing: true, face: y+}\n", to);
    fprintf(to, "output: {frames: 0, samples: %d}\nprobes: [sif: {contours: [4 mm]}]\n", FIELD_SAMPLES);
    return fclose(to) == 0 ? OK : file_report_write_failure(SCENE, errno);
}

/* ---- one run ----------------------------------------------------------------------------------------------------- */

/* Reads number of particles, memory, times and the curve K_I(t) from the results of a run into *r. folder: of the run;
 * later: added to the times of the curve [s], as the wave starts nearer to the crack in a part of the plate; processor:
 * processor time of the run, by which its times are corrected for other load [s]. Returns FAILED if a file cannot be
 * read. */
static status field_read(struct field_row *r, const char *folder, double later, double processor)
{
    struct history h = {0};
    double wall;
    const struct {
        const char *key;
        double *value;
    } figure[] = {{"particles_made", &r->made},
                  {"particles", &r->body},
                  {"memory_peak_bytes", &r->bytes},
                  {"loop_seconds", &r->seconds},
                  {"wall_seconds", &wall}};
    for (size_t k = 0; k < COUNT_OF(figure); k++) TRY(summary_read_number(folder, figure[k].key, figure[k].value));
    for (int k = 0; k < TIMERS; k++) {
        char key[64];
        snprintf(key, sizeof key, "laps.%s", timer_name[k]);
        TRY(summary_read_number(folder, key, &r->timer[k]));
        r->timer[k] *= fmin(1, processor / wall);
    }
    r->seconds *= fmin(1, processor / wall);
    TRY(history_read(&h, folder));
    const int time = history_find_column(&h, "time"), K = history_find_column(&h, "sif.K_I");
    for (int64_t k = 0; k < h.rows && r->n < FIELD_SAMPLES + 2; k++, r->n++) {
        r->t[r->n] = history_value_at(&h, k, time) + later, r->K[r->n] = history_value_at(&h, k, K);
        if (isnan(r->K[r->n])) r->K[r->n] = 0; /* before anything has moved */
        r->peak = fmax(r->peak, fabs(r->K[r->n]));
    }
    history_free(&h);
    return OK;
}

static status field_run(struct field_bench *b, int k)
{
    struct bench_overrides o = {0};
    struct bench_child c;
    const double later = field_runs[k].part ? 1e-3 * (HALF - NEAR) / b->speed : 0;
    TRY(field_scene_write(b, field_runs[k].part));
    bench_overrides_append(&o, "method", "%s", field_runs[k].method);
    if (field_runs[k].levels >= 0) bench_overrides_append(&o, "mpm.levels", "%d", field_runs[k].levels);
    if (field_runs[k].levels > 0) bench_overrides_append(&o, "mpm.fill", "needed");
    status ran = bench_child_start(&c, SCENE, bench_overrides_as_array(&o), o.n, 1);
    if (ran == OK) ran = bench_child_wait(&c);
    if (ran == OK) ran = field_read(&b->at[k], c.folder, later, c.processor);
    bench_child_wait_and_remove_output(&c);
    remove(SCENE);
    return ran;
}

/* ---- differences ------------------------------------------------------------------------------------------------- */

/* Returns K_I of the run r at time t [s], interpolated linearly between samples [Pa m^0.5]. */
static double intensity_at(const struct field_row *r, double t)
{
    int64_t k = 1;
    while (k < r->n - 1 && r->t[k] < t) k++;
    return r->K[k - 1] + (r->K[k] - r->K[k - 1]) * (t - r->t[k - 1]) / (r->t[k] - r->t[k - 1]);
}

/* Returns the largest difference of K_I(t) between the run r and a direct run, over the largest K_I of the direct run
 * [1]. It is evaluated at the samples of the direct run that are within the duration of r. A direct run has bonds, or
 * cells of two spacings, everywhere. */
static double field_off(const struct field_row *r, const struct field_row *direct)
{
    double most = 0;
    for (int64_t k = 0; k < direct->n; k++)
        if (direct->t[k] >= r->t[0] && direct->t[k] <= r->t[r->n - 1] * (1 + 1e-9))
            most = fmax(most, fabs(intensity_at(r, direct->t[k]) - direct->K[k]));
    return most / direct->peak;
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Returns how many of the largest cells of run k the rising front of the pulse of b spans; the front is half of the
 * length of the pulse. */
static double cells_in_front(const struct field_bench *b, int k)
{
    return 0.5 * b->pulse * b->speed / (1e-3 * b->spacing * (2 << field_runs[k].levels));
}

static double steps_of(const struct field_row *r) { return r->seconds - r->timer[TIMER_SAMPLE]; }

static void field_print_row(const struct field_bench *b, int k)
{
    const struct field_row *r = &b->at[k];
    char cells[16] = "-";
    if (field_runs[k].levels >= 0) snprintf(cells, sizeof cells, "%.1f", cells_in_front(b, k));
    printf("  %-20s %9.0f %9.0f %8.1f %8.3f %8.3f %9s %10.4g |", field_runs[k].name, r->made, r->body, 1e-6 * r->bytes,
           r->seconds, steps_of(r), cells, r->peak);
    for (int d = 0; d < DIRECT && d < k; d++)
        printf("  %6.2f %%  1/%-6.1f 1/%-6.1f", 100 * r->off[d], b->at[d].seconds / r->seconds,
               steps_of(&b->at[d]) / steps_of(r));
    putchar('\n');
    fflush(stdout);
}

static enum timer largest_timer(const struct field_row *r)
{
    int most = 0;
    for (int k = 0; k < TIMER_OUTPUT; k++)
        if (r->timer[k] > r->timer[most]) most = k;
    return (enum timer)most;
}

/* Prints the fastest of the runs of b whose K_I deviates by at most K_AIM from direct run number `direct`, and whether
 * its time is shorter by the required factor. part: true for runs of the part between absorbing faces, false for those
 * of the whole plate. */
static void field_print_aim(const struct field_bench *b, int direct, bool part)
{
    int best = -1;
    for (int k = DIRECT; k < FIELD_RUNS; k++)
        if (field_runs[k].part == part && b->at[k].off[direct] <= K_AIM &&
            (best < 0 || b->at[k].seconds < b->at[best].seconds))
            best = k;
    printf("    %s beside %s: ", part ? "a part of the plate" : "coarse cells", field_runs[direct].name);
    if (best < 0) {
        printf("MISSED: none within %.0f %% of K\n", 100 * K_AIM);
        return;
    }
    const struct field_row *r = &b->at[best];
    const double ratio = b->at[direct].seconds / r->seconds;
    printf("%s, %.2f %% of K in 1/%.1f of the time: ", field_runs[best].name, 100 * r->off[direct], ratio);
    if (ratio >= TIME_AIM)
        printf("met\n");
    else
        printf(
            "MISSED, the timer `%s` stands in the way with %.0f %% of the loop; of the steps without samples 1/%.1f\n",
            timer_name[largest_timer(r)], 100 * r->timer[largest_timer(r)] / r->seconds,
            steps_of(&b->at[direct]) / steps_of(r));
}

static void field_print_aims(const struct field_bench *b)
{
    printf("\n  asked: within %.0f %% of K of the direct run in 1/%.0f of its time\n", 100 * K_AIM, TIME_AIM);
    for (int part = 0; part < 2; part++)
        for (int d = 0; d < DIRECT; d++) field_print_aim(b, d, part);
    for (int k = DIRECT; k < FIELD_RUNS; k++)
        if (b->at[k].off[1] > K_AIM && field_runs[k].part)
            printf("    %s: %.1f %% off: scattered waves that are not normal to the faces come back\n",
                   field_runs[k].name, 100 * b->at[k].off[1]);
        else if (b->at[k].off[1] > K_AIM)
            printf("    %s: %.1f %% off: dispersion, as %.1f of its largest cells carry the front\n",
                   field_runs[k].name, 100 * b->at[k].off[1], cells_in_front(b, k));
}

static status field_write_table(const struct field_bench *b)
{
    struct bench_table t[2];
    bench_table_make(&t[0], "",
                     "run,levels,part,made,particles,bytes,seconds,steps_seconds,K_peak,off_bonds,off_cells");
    bench_table_make(&t[1], "history", "run,time,K_I");
    for (int k = 0; k < FIELD_RUNS; k++) {
        const struct field_row *r = &b->at[k];
        const double row[] = {field_runs[k].levels, field_runs[k].part, r->made, r->body,   r->bytes,
                              r->seconds,           steps_of(r),        r->peak, r->off[0], r->off[1]};
        bench_table_append_text(&t[0], field_runs[k].name);
        for (size_t c = 0; c < COUNT_OF(row); c++) bench_table_append_number(&t[0], row[c]);
        for (int64_t j = 0; j < r->n; j++)
            bench_table_append_text(&t[1], field_runs[k].name), bench_table_append_number(&t[1], r->t[j]),
                bench_table_append_number(&t[1], r->K[j]);
    }
    status s = bench_write_result_tables("scale_field", t, COUNT_OF(t));
    for (size_t k = 0; k < COUNT_OF(t); k++) bench_table_free(&t[k]);
    return s;
}

static void field_draw(FILE *to, const void *context)
{
    const struct field_bench *b = context;
    for (int k = 0; k < FIELD_RUNS; k++) {
        fprintf(to, "$w%d << EOD\n", k);
        for (int64_t j = 0; j < b->at[k].n; j++) fprintf(to, "%.6g %.6g\n", 1e6 * b->at[k].t[j], 1e-3 * b->at[k].K[j]);
        fputs("EOD\n", to);
    }
    fprintf(to,
            "set xlabel 'time [us]'\nset ylabel 'K_I [kPa √m]'\nset xrange [%g:*]\nset key inside top left\n"
            "plot ",
            0.98 * 1e3 * HALF / b->speed);
    for (int k = 0; k < FIELD_RUNS; k++)
        fprintf(to, "%s$w%d using 1:2 with lines lw 2 dt %d lc rgb '%s' title '%s'", k ? ", " : "", k,
                field_runs[k].part ? 2 : 1, curve_colour[k % CURVE_COLOURS], field_runs[k].name);
    fputc('\n', to);
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Makes all runs of b, prints a row for each with its differences from the direct runs (bonds, or cells of two
 * spacings, everywhere), and writes table and picture. Returns FAILED if a run or a file fails. */
static status field_measure(struct field_bench *b)
{
    printf("  spacing %g mm, half plate of %.0f by %.0f spacings; pulse of %.0f spacings, its front %.0f; %d samples; "
           "one thread\n",
           b->spacing, HALF / b->spacing, 2 * HALF / b->spacing, 1e3 * b->pulse * b->speed / b->spacing,
           500 * b->pulse * b->speed / b->spacing, FIELD_SAMPLES);
    printf("  %-20s %9s %9s %8s %8s %8s %9s %10s | %s\n", "", "made", "of body", "peak MB", "loop s", "steps s",
           "in front", "largest K", "beside bonds: K, loop, steps      beside cells of 2: K, loop, steps");
    for (int k = 0; k < FIELD_RUNS; k++) {
        TRY(field_run(b, k));
        for (int d = 0; d < DIRECT; d++) b->at[k].off[d] = d < k ? field_off(&b->at[k], &b->at[d]) : 0;
        field_print_row(b, k);
    }
    field_print_aims(b);
    TRY(field_write_table(b));
    return bench_draw("scale_field", 1000, 600, field_draw, b);
}

status bench_cost_of_coarse_far_field(bool quick)
{
    struct field_bench *b = NEW("bench.field", 1, struct field_bench);
    printf("scale: a far field\n");
    bench_print_machine(1);
    b->spacing = quick ? 0.625 : 0.25;
    b->speed = sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson) * density));
    b->pulse = 1e-6 * PULSE_SPACINGS * b->spacing;
    status s = field_measure(b);
    memory_free(b);
    return s;
}
