/* `cleave bench threads`: strong scaling (one block on more and more threads) and weak scaling (a block for
 * each thread), beside what the memory gives that many threads. Every team makes the engine that it runs, so that
 * pages lie where they are used; teams take turns, the fastest repetition counts. */
#include <math.h>
#include <stdio.h>

#include "bench/common/bench.h"
#include "plot/gnuplot.h"
#include "base/memory.h"
#include "step/report.h"

enum { TEAMS_MAX = 24, DIM_OF_WAYS = 2, STEPS_WARM = 3, PIECES = 4, SCALINGS = 2 };
static const char *const scaling_name[SCALINGS] = {"strong", "weak"};

struct threads_bench {
    int teams, team[TEAMS_MAX];
    double triad[TEAMS_MAX];                        /* [byte/s] */
    double step[BENCH_BLOCKS][SCALINGS][TEAMS_MAX]; /* [s]; fastest */
    double particles[BENCH_BLOCKS][SCALINGS][TEAMS_MAX];
};

static bool power_of_two(int t) { return (t & (t - 1)) == 0; }

/* 1, 2, 3, 4, 6, 8, 12, 16 ... and all cores there are. */
static void choose_teams(struct threads_bench *b, int cores)
{
    for (int t = 1; t < cores && b->teams < TEAMS_MAX - 1; t = t == 1 ? 2 : power_of_two(t) ? t / 2 * 3 : t / 3 * 4)
        b->team[b->teams++] = t;
    b->team[b->teams++] = cores;
}

static double cost(const struct threads_bench *b, int way, int scaling, int t)
{
    return b->step[way][scaling][t] / b->particles[way][scaling][t];
}

/* Of `t` threads against one: how much of their number a step gains. */
static double efficiency(const struct threads_bench *b, int way, int scaling, int t)
{
    return cost(b, way, scaling, 0) / (b->team[t] * cost(b, way, scaling, t));
}

static status time_block(struct threads_bench *b, int way, int scaling, int t, double particles, int64_t steps)
{
    struct scene s;
    struct run e;
    double *best = &b->step[way][scaling][t];
    team_make(b->team[t]);
    TRY(bench_block_make(&e, &s, &bench_blocks[way], particles, STEPS_WARM + PIECES * steps, 0, NULL));
    b->particles[way][scaling][t] = (double)e.part.n;
    status ran = bench_engine_run(&e, STEPS_WARM, NULL);
    for (int k = 1; k <= PIECES && ran == OK; k++) {
        const double before = e.report->loop_seconds;
        ran = bench_engine_run(&e, STEPS_WARM + k * steps, NULL);
        *best = fmin(*best, (e.report->loop_seconds - before) / (double)steps);
    }
    bench_engine_free(&e, &s);
    return ran;
}

static status threads_time_way(struct threads_bench *b, int way, bool quick)
{
    const double whole = quick ? 1e4 : 1e6, each = quick ? 5e3 : 2.5e5;
    for (int r = 0; r < (quick ? 1 : 2); r++)
        for (int t = 0; t < b->teams; t++) {
            TRY(time_block(b, way, 0, t, whole, quick ? 2 : 5));
            TRY(time_block(b, way, 1, t, each * b->team[t], quick ? 2 : 10));
        }
    for (int c = 0; c < SCALINGS; c++) {
        printf("  %-20s %-7s", bench_blocks[way].name, scaling_name[c]);
        for (int t = 0; t < b->teams; t++)
            printf("  %9.3f ms %5.2f", 1e3 * b->step[way][c][t], efficiency(b, way, c, t));
        putchar('\n');
    }
    fflush(stdout);
    return OK;
}

static void time_memory(struct threads_bench *b)
{
    for (int t = 0; t < b->teams; t++) {
        team_make(b->team[t]);
        struct microbench_triad *probe = microbench_triad_make();
        for (int k = 0; k < 5; k++) b->triad[t] = fmax(b->triad[t], microbench_triad_run(probe));
        microbench_triad_free(probe);
    }
    printf("  %-28s", "memory (triad)");
    for (int t = 0; t < b->teams; t++)
        printf("  %7.1f GB/s %5.2f", 1e-9 * b->triad[t], b->triad[t] / (b->team[t] * b->triad[0]));
    putchar('\n');
}

static bool is_way(int way) { return bench_blocks[way].dim == DIM_OF_WAYS; }

static status threads_write_tables(const struct threads_bench *b)
{
    struct bench_table table[2];
    bench_table_make(&table[0], "", "method,scaling,threads,particles,step_seconds,ns_per_particle_step,efficiency");
    bench_table_make(&table[1], "memory", "threads,triad_bytes_per_second,efficiency");
    for (int way = 0; way < BENCH_BLOCKS; way++)
        for (int c = 0; c < SCALINGS && is_way(way); c++)
            for (int t = 0; t < b->teams; t++) {
                bench_text(&table[0], bench_blocks[way].name), bench_text(&table[0], scaling_name[c]);
                bench_number(&table[0], b->team[t]), bench_number(&table[0], b->particles[way][c][t]);
                bench_number(&table[0], b->step[way][c][t]), bench_number(&table[0], 1e9 * cost(b, way, c, t));
                bench_number(&table[0], efficiency(b, way, c, t));
            }
    for (int t = 0; t < b->teams; t++) {
        bench_number(&table[1], b->team[t]), bench_number(&table[1], b->triad[t]);
        bench_number(&table[1], b->triad[t] / (b->team[t] * b->triad[0]));
    }
    status s = bench_write("threads", table, COUNT_OF(table));
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
            for (int way = 0; way < BENCH_BLOCKS; way++)
                if (is_way(way)) fprintf(to, " %.6g", efficiency(b, way, c, t));
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
        for (int way = 0, colour = 0; way < BENCH_BLOCKS; way++)
            if (is_way(way))
                fprintf(to, ", $d%d using 1:%d with linespoints pt 7 lw 2 lc rgb '%s' title '%s'", c, column++,
                        curve_colour[colour++], bench_blocks[way].name);
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
    time_memory(b);
    for (int way = 0; way < BENCH_BLOCKS; way++)
        if (is_way(way)) TRY(threads_time_way(b, way, quick));
    team_make(0);
    TRY(threads_write_tables(b));
    return bench_draw("threads", 1200, 500, threads_draw, b);
}

status bench_threads(bool quick)
{
    struct threads_bench *b = NEW("bench.threads", 1, struct threads_bench);
    for (int way = 0; way < BENCH_BLOCKS; way++)
        for (int c = 0; c < SCALINGS; c++)
            for (int t = 0; t < TEAMS_MAX; t++) b->step[way][c][t] = INFINITY;
    printf("threads\n");
    const int most = team_make(0);
    bench_print_machine(most);
    choose_teams(b, most);
    status s = threads_measure(b, quick);
    memory_free(b);
    return s;
}
