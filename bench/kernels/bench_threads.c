/* `cleave bench threads`: strong scaling (one block on more and more threads) and weak scaling (a block per thread),
 * compared with the memory bandwidth of that many threads. Every team creates its own run, so that pages are local to
 * the threads that use them; teams alternate, the fastest repetition counts. */
#include <math.h>
#include <stdio.h>

#include "bench/common/bench.h"
#include "plot/gnuplot.h"
#include "base/memory.h"
#include "step/report.h"

/* TEAMS_MAX: largest number of teams of threads that are measured; DIM_SHOWN: dimension of the blocks that are
 * drawn; STEPS_WARM: steps before the timed ones; PIECES: pieces of timed steps; SCALINGS: number of scalings
 * (scaling_name). */
enum { TEAMS_MAX = 24, DIM_SHOWN = 2, STEPS_WARM = 3, PIECES = 4, SCALINGS = 2 };
static const char *const scaling_name[SCALINGS] = {"strong", "weak"};

struct threads_bench {
    int teams, team[TEAMS_MAX];
    double triad[TEAMS_MAX];                        /* [byte/s] */
    double step[BENCH_BLOCKS][SCALINGS][TEAMS_MAX]; /* time of a step, fastest [s] */
    double particles[BENCH_BLOCKS][SCALINGS][TEAMS_MAX];
};

static bool power_of_two(int t) { return (t & (t - 1)) == 0; }

/* Stores the numbers of threads that are measured in b->team[]: 1, 2, 3, 4, 6, 8, 12, 16 and so on, and all `cores`
 * cores. */
static void choose_teams(struct threads_bench *b, int cores)
{
    for (int t = 1; t < cores && b->teams < TEAMS_MAX - 1; t = t == 1 ? 2 : power_of_two(t) ? t / 2 * 3 : t / 3 * 4)
        b->team[b->teams++] = t;
    b->team[b->teams++] = cores;
}

static double cost(const struct threads_bench *b, int which, int scaling, int t)
{
    return b->step[which][scaling][t] / b->particles[which][scaling][t];
}

/* Returns the parallel efficiency with b->team[t] threads [1]: the time per particle on one thread, over the product of
 * time per particle and number of threads. which: index in bench_blocks; scaling: index in scaling_name. */
static double efficiency(const struct threads_bench *b, int which, int scaling, int t)
{
    return cost(b, which, scaling, 0) / (b->team[t] * cost(b, which, scaling, t));
}

static status time_block(struct threads_bench *b, int which, int scaling, int t, double particles, int64_t steps)
{
    struct scene s;
    struct run e;
    double *best = &b->step[which][scaling][t];
    threads_set_count_and_bind_to_cores(b->team[t]);
    TRY(bench_block_make(&e, &s, &bench_blocks[which], particles, STEPS_WARM + PIECES * steps, 0, NULL));
    b->particles[which][scaling][t] = (double)e.part.n;
    status ran = bench_engine_run(&e, STEPS_WARM, NULL);
    for (int k = 1; k <= PIECES && ran == OK; k++) {
        ran = bench_engine_run(&e, STEPS_WARM + k * steps, NULL);
        *best = fmin(*best, report_wall_clock_times(e.report, &e.timers).loop / (double)steps);
    }
    bench_engine_free(&e, &s);
    return ran;
}

static status threads_time_scalings(struct threads_bench *b, int which, bool quick)
{
    const double whole = quick ? 1e4 : 1e6, each = quick ? 5e3 : 2.5e5;
    for (int r = 0; r < (quick ? 1 : 2); r++)
        for (int t = 0; t < b->teams; t++) {
            TRY(time_block(b, which, 0, t, whole, quick ? 2 : 5));
            TRY(time_block(b, which, 1, t, each * b->team[t], quick ? 2 : 10));
        }
    for (int c = 0; c < SCALINGS; c++) {
        printf("  %-20s %-7s", bench_blocks[which].name, scaling_name[c]);
        for (int t = 0; t < b->teams; t++)
            printf("  %9.3f ms %5.2f", 1e3 * b->step[which][c][t], efficiency(b, which, c, t));
        putchar('\n');
    }
    fflush(stdout);
    return OK;
}

static void time_memory(struct threads_bench *b, bool quick)
{
    for (int t = 0; t < b->teams; t++) {
        threads_set_count_and_bind_to_cores(b->team[t]);
        struct microbench_triad *probe = microbench_triad_make(quick);
        for (int k = 0; k < 5; k++) b->triad[t] = fmax(b->triad[t], microbench_triad_run(probe));
        microbench_triad_free(probe);
    }
    printf("  %-28s", "memory (triad)");
    for (int t = 0; t < b->teams; t++)
        printf("  %7.1f GB/s %5.2f", 1e-9 * b->triad[t], b->triad[t] / (b->team[t] * b->triad[0]));
    putchar('\n');
}

static bool has_shown_dim(int which) { return bench_blocks[which].dim == DIM_SHOWN; }

static status threads_write_tables(const struct threads_bench *b)
{
    struct bench_table table[2];
    bench_table_make(&table[0], "", "method,scaling,threads,particles,step_seconds,ns_per_particle_step,efficiency");
    bench_table_make(&table[1], "memory", "threads,triad_bytes_per_second,efficiency");
    for (int which = 0; which < BENCH_BLOCKS; which++)
        for (int c = 0; c < SCALINGS && has_shown_dim(which); c++)
            for (int t = 0; t < b->teams; t++) {
                bench_table_append_text(&table[0], bench_blocks[which].name),
                    bench_table_append_text(&table[0], scaling_name[c]);
                bench_table_append_number(&table[0], b->team[t]),
                    bench_table_append_number(&table[0], b->particles[which][c][t]);
                bench_table_append_number(&table[0], b->step[which][c][t]),
                    bench_table_append_number(&table[0], 1e9 * cost(b, which, c, t));
                bench_table_append_number(&table[0], efficiency(b, which, c, t));
            }
    for (int t = 0; t < b->teams; t++) {
        bench_table_append_number(&table[1], b->team[t]), bench_table_append_number(&table[1], b->triad[t]);
        bench_table_append_number(&table[1], b->triad[t] / (b->team[t] * b->triad[0]));
    }
    status s = bench_write_result_tables("threads", table, COUNT_OF(table));
    for (size_t k = 0; k < COUNT_OF(table); k++) bench_table_free(&table[k]);
    return s;
}

static void threads_draw(FILE *to, const void *context)
{
    const struct threads_bench *b = context;
    for (int c = 0; c < SCALINGS; c++) {
        fprintf(to, "$d%d << EOD\n", c);
        for (int t = 0; t < b->teams; t++) {
            fprintf(to, "%d %.6g", b->team[t], b->triad[t] / (b->team[t] * b->triad[0]));
            for (int which = 0; which < BENCH_BLOCKS; which++)
                if (has_shown_dim(which)) fprintf(to, " %.6g", efficiency(b, which, c, t));
            fputc('\n', to);
        }
        fputs("EOD\n", to);
    }
    fprintf(to,
            "set multiplot layout 1,2\nset xlabel 'threads'\nset yrange [0:1.2]\nset xrange [0.5:%g]\n"
            "set key bottom left\nset xtics 1, %d\nset ylabel 'time on one / (threads x time)'\n",
            b->team[b->teams - 1] + 0.5, b->team[b->teams - 1] > 12 ? 3 : 1);
    for (int c = 0; c < SCALINGS; c++) {
        int column = 3;
        fprintf(to,
                "set title '%s scaling'\nplot 0.8 with lines dt (6,4) lw 1 lc rgb '#888888' notitle, "
                "$d%d using 1:2 with lines dt (2,3) lw 2 lc rgb '#555555' title 'memory (triad)'",
                scaling_name[c], c);
        for (int which = 0, colour = 0; which < BENCH_BLOCKS; which++)
            if (has_shown_dim(which))
                fprintf(to, ", $d%d using 1:%d with linespoints pt 7 lw 2 lc rgb '%s' title '%s'", c, column++,
                        curve_colour[colour++], bench_blocks[which].name);
        fputc('\n', to);
    }
    fputs("unset multiplot\n", to);
}

static status threads_measure(struct threads_bench *b, bool quick)
{
    printf("  time of a step and efficiency, 2D, on");
    for (int t = 0; t < b->teams; t++) printf(" %d", b->team[t]);
    printf(" threads; strong: %s particles, weak: %s for each thread\n", quick ? "1e4" : "1e6",
           quick ? "5e3" : "2.5e5");
    time_memory(b, quick);
    for (int which = 0; which < BENCH_BLOCKS; which++)
        if (has_shown_dim(which)) TRY(threads_time_scalings(b, which, quick));
    threads_set_count_and_bind_to_cores(0);
    TRY(threads_write_tables(b));
    return bench_draw("threads", 1200, 500, threads_draw, b);
}

status bench_threads(bool quick)
{
    struct threads_bench *b = NEW("bench.threads", 1, struct threads_bench);
    for (int which = 0; which < BENCH_BLOCKS; which++)
        for (int c = 0; c < SCALINGS; c++)
            for (int t = 0; t < TEAMS_MAX; t++) b->step[which][c][t] = INFINITY;
    printf("threads\n");
    const int most = threads_set_count_and_bind_to_cores(0);
    bench_print_machine(most);
    choose_teams(b, most);
    status s = threads_measure(b, quick);
    memory_free(b);
    return s;
}
