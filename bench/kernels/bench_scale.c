/* `cleave bench scale`: time and memory per particle from 1e4 to 1e7 (2D) and 1e6 (3D) particles, set-up time in units
 * of steps of full peridynamics, and the cost of output every 100 steps. Sizes that exceed the memory of the machine
 * are left out and listed. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "bench/common/bench.h"
#include "plot/gnuplot.h"
#include "base/memory.h"
#include "output/output_files.h"
#include "step/report.h"

/* SIZES: sizes of a block; DIMS: dimensions; STEPS_WARM: steps before the timed ones; PIECES: pieces of timed steps;
 * FRAME_EVERY: steps between frames; FRAMES: frames of a run. */
enum { SIZES = 4, DIMS = 2, STEPS_WARM = 2, PIECES = 4, FRAME_EVERY = 100, FRAMES = 6 };
static const double size_of[SIZES] = {1e4, 1e5, 1e6, 1e7};

/* Largest values that meet the goals: ratio of times per step over the sizes [1], set-up time [steps], cost of
 * output over that of steps [1]. */
#define SPREAD_ASKED 1.15
#define SETUP_ASKED 50.0
#define OUTPUT_ASKED 0.03

struct size_result {
    bool known;
    double particles, bonds, setup, step, bytes; /* numbers [1]; set-up, step [s]; memory [byte] */
    double frame, frame_bytes;                   /* time for which a frame stops the loop [s]; size of a frame [byte
                                                  * per particle] */
};

struct scale_bench {
    struct size_result at[BENCH_BLOCKS][SIZES];
};

/* ---- memory ------------------------------------------------------------------------------------------------------ */

/* Resets the high-water mark of the memory of this process, so that it can be read after a following task. Returns the
 * current memory [byte]; NAN if the system does not allow the reset. */
static double memory_from_here(void)
{
#ifdef __GLIBC__
    malloc_trim(0); /* returns freed memory to the system */
#endif
    FILE *f = fopen("/proc/self/clear_refs", "w");
    if (!f) return NAN;
    const bool put = fputs("5", f) >= 0;
    return fclose(f) == 0 && put ? (double)memory_peak_resident_size() : NAN;
}

/* Returns true if a block of `particles` particles fits into 0.7 of the memory of the machine, with the most expensive
 * method and while a frame is being written. block: its dimension. */
static bool machine_holds(const struct bench_block *block, double particles)
{
    const double each = block->dim == 2 ? 350 : 1000;
    return each * particles < 0.7 * (double)machine_memory_size();
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Runs a block of about `particles` particles that writes a frame every FRAME_EVERY steps. Stores the time for which a
 * frame stops the time loop [s] in r->frame and its size per particle [byte] in r->frame_bytes. Returns FAILED if the
 * run fails. */
static status time_frames(struct size_result *r, const struct bench_block *block, double particles)
{
    struct scene s;
    struct run e;
    struct output out = {0};
    struct bench_child folder = {0};
    TRY(bench_create_results_folder());
    strcpy(folder.folder, BENCH_FOLDER "/run-scale");
    TRY(bench_block_make(&e, &s, block, particles, FRAMES * FRAME_EVERY, FRAMES, &out));
    status ran = output_open(&out, folder.folder, s.text, OUTPUT_OVERWRITE, false);
    if (ran == OK) {
        ran = run_advance_to_end_time(&e);
        r->frame = e.timers.spent[TIMER_OUTPUT] / FRAMES;
        FILE *f = fopen(path_join(folder.folder, "frames/000001.hdf").text, "r");
        if (f && fseek(f, 0, SEEK_END) == 0) r->frame_bytes = (double)ftell(f) / (double)e.part.n;
        if (f) fclose(f);
    }
    output_close(&out);
    bench_engine_free(&e, &s);
    bench_child_wait_and_remove_output(&folder);
    return ran;
}

static double output_share(const struct size_result *r) { return r->frame / (FRAME_EVERY * r->step); }

/* ---- one size ---------------------------------------------------------------------------------------------------- */

/* Measures set-up time [s], time per step [s] and memory per particle [byte] of a block of about `particles` particles,
 * and stores them in *r. The steps are timed in PIECES pieces, of which the fastest counts. visits: number of particles
 * times number of steps of a piece. Returns FAILED if a step fails. */
static status time_size(struct size_result *r, const struct bench_block *block, double particles, double visits)
{
    struct scene s;
    struct run e;
    const int64_t steps = 2 + (int64_t)(visits / particles);
    const double before = memory_from_here(), start = wall_clock_seconds();
    TRY(bench_block_make(&e, &s, block, particles, STEPS_WARM + PIECES * steps, 0, NULL));
    *r = (struct size_result){.known = true, .setup = wall_clock_seconds() - start, .step = INFINITY};
    r->particles = (double)e.part.n, r->bonds = (double)e.bonds.n;
    status ran = bench_engine_run(&e, STEPS_WARM, NULL);
    for (int k = 1; k <= PIECES && ran == OK; k++) {
        ran = bench_engine_run(&e, STEPS_WARM + k * steps, NULL);
        r->step = fmin(r->step, report_wall_clock_times(e.report, &e.timers).loop / (double)steps);
    }
    r->bytes = ((double)memory_peak_resident_size() - before) / r->particles;
    r->frame = NAN;
    bench_engine_free(&e, &s);
    return ran;
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Returns the set-up time of a block of b over the time of a step of full peridynamics on a block of the same dimension
 * and size [1]. which: index in bench_blocks; size: index in size_of. */
static double setup_steps(const struct scale_bench *b, int which, int size)
{
    int pd = which;
    while (pd > 0 && bench_blocks[pd - 1].dim == bench_blocks[which].dim) pd--;
    return b->at[which][size].setup / b->at[pd][size].step;
}

static void print_size(const struct scale_bench *b, int which, int size)
{
    const struct size_result *r = &b->at[which][size];
    printf("  %-20s %dD %9.3g %10.2f %10.0f %12.1f", bench_blocks[which].name, bench_blocks[which].dim, r->particles,
           1e9 * r->step / r->particles, r->bytes, setup_steps(b, which, size));
    if (isfinite(r->frame)) printf(" %10.1f %9.1f %%", 1e3 * r->frame, 100 * output_share(r));
    putchar('\n');
    fflush(stdout);
}

static void print_spread(const struct scale_bench *b)
{
    printf("\n  largest over smallest from 1e4 on (asked %.2f), set-up (asked %.0f steps of pd), output every %d steps "
           "(asked %.0f %%)\n",
           SPREAD_ASKED, SETUP_ASKED, FRAME_EVERY, 100 * OUTPUT_ASKED);
    for (int which = 0; which < BENCH_BLOCKS; which++) {
        double time[2] = {INFINITY, 0}, bytes[2] = {INFINITY, 0}, setup = 0, output = NAN;
        for (int k = 0; k < SIZES; k++) {
            const struct size_result *r = &b->at[which][k];
            if (!r->known) continue;
            const double each = r->step / r->particles;
            time[0] = fmin(time[0], each), time[1] = fmax(time[1], each);
            bytes[0] = fmin(bytes[0], r->bytes), bytes[1] = fmax(bytes[1], r->bytes);
            setup = setup_steps(b, which, k);
            if (isfinite(r->frame)) output = output_share(r);
        }
        if (time[1] > 0)
            printf("    %-20s %dD  time %.2f  memory %.2f  set-up of the largest %.1f  output %.1f %%\n",
                   bench_blocks[which].name, bench_blocks[which].dim, time[1] / time[0], bytes[1] / bytes[0], setup,
                   100 * output);
    }
}

static status scale_write_table(const struct scale_bench *b)
{
    struct bench_table t;
    bench_table_make(&t, "",
                     "method,dim,particles,directed_bonds,step_seconds,ns_per_particle_step,bytes_per_particle,"
                     "setup_seconds,setup_pd_steps,frame_seconds,frame_bytes_per_particle,output_share");
    for (int which = 0; which < BENCH_BLOCKS; which++)
        for (int k = 0; k < SIZES; k++) {
            const struct size_result *r = &b->at[which][k];
            if (!r->known) continue;
            const double row[] = {bench_blocks[which].dim,
                                  r->particles,
                                  r->bonds,
                                  r->step,
                                  1e9 * r->step / r->particles,
                                  r->bytes,
                                  r->setup,
                                  setup_steps(b, which, k),
                                  r->frame,
                                  isfinite(r->frame) ? r->frame_bytes : NAN,
                                  output_share(r)};
            bench_table_append_text(&t, bench_blocks[which].name);
            for (size_t c = 0; c < COUNT_OF(row); c++) bench_table_append_number(&t, row[c]);
        }
    status s = bench_write_result_tables("scale", &t, 1);
    bench_table_free(&t);
    return s;
}

static void scale_draw_panel(FILE *to, int dim, bool memory)
{
    int colour = 0;
    fprintf(to, "set title '%s, %dD'\nset ylabel '%s'\nplot ", memory ? "memory" : "time", dim,
            memory ? "bytes per particle" : "ns per particle and step");
    for (int which = 0; which < BENCH_BLOCKS; which++)
        if (bench_blocks[which].dim == dim)
            fprintf(to, "%s$w%d using 1:%d with linespoints pt 7 lw 2 lc rgb '%s' title '%s'", colour ? ", " : "",
                    which, memory ? 3 : 2, curve_colour[colour], bench_blocks[which].name),
                colour++;
    fputc('\n', to);
}

static void scale_draw(FILE *to, const void *context)
{
    const struct scale_bench *b = context;
    for (int which = 0; which < BENCH_BLOCKS; which++) {
        fprintf(to, "$w%d << EOD\n", which);
        for (int k = 0; k < SIZES; k++) {
            const struct size_result *r = &b->at[which][k];
            if (r->known) fprintf(to, "%.6g %.6g %.6g\n", r->particles, 1e9 * r->step / r->particles, r->bytes);
        }
        fputs("EOD\n", to);
    }
    fputs(
        "set multiplot layout 2,2\nset logscale xy\nset xrange [2e3:2e7]\nset format x '1e%T'\nset xlabel 'particles'\n"
        "set key top right font ',8'\nset offsets graph 0, 0, graph 0.6, graph 0.2\n",
        to);
    for (int dim = 2; dim <= 3; dim++)
        for (int memory = 0; memory < 2; memory++) scale_draw_panel(to, dim, memory);
    fputs("unset multiplot\n", to);
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Measures the block bench_blocks[which] at the first `sizes` sizes, as far as the memory of the machine allows, stores
 * the results in *b and prints them. quick: small sizes. Returns FAILED if a run fails. */
static status measure_block(struct scale_bench *b, int which, int sizes, bool quick)
{
    const struct bench_block *block = &bench_blocks[which];
    for (int k = 0; k < sizes; k++) {
        const double particles = quick ? 2500 + 5000 * k : size_of[k];
        if (block->dim == 3 && k > (quick ? 0 : 2)) continue;
        if (!machine_holds(block, particles)) {
            printf("  %-20s %dD %9.3g  more than this machine's %.0f GB should be asked to hold: left out\n",
                   block->name, block->dim, particles, 1e-9 * (double)machine_memory_size());
            continue;
        }
        struct size_result *r = &b->at[which][k];
        TRY(time_size(r, block, particles, quick ? 2e4 : 4e5));
        if (k == (quick ? 0 : 2) && block->dim == 2) TRY(time_frames(r, block, particles));
        print_size(b, which, k);
    }
    return OK;
}

static status scale_measure(struct scale_bench *b, bool quick)
{
    printf("  %-20s    %9s %10s %10s %12s %10s %11s\n", "", "particles", "ns/step", "bytes", "set-up/step",
           "frame [ms]", "of 100 steps");
    for (int which = 0; which < BENCH_BLOCKS; which++) TRY(measure_block(b, which, quick ? 2 : SIZES, quick));
    print_spread(b);
    TRY(scale_write_table(b));
    return bench_draw("scale", 1200, 900, scale_draw, b);
}

status bench_scale(bool quick)
{
    struct scale_bench *b = NEW("bench.scale", 1, struct scale_bench);
    printf("scale\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    status s = scale_measure(b, quick);
    memory_free(b);
    return s;
}
