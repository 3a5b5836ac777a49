/* Runs as processes of their own, side by side; figures beside what is asked of them (bench_goals.c). */
#ifndef CLEAVE_BENCH_GOALS
#define CLEAVE_BENCH_GOALS

#include "bench/common/bench.h"

/* A run of a scene as a process of its own. */
struct bench_job {
    const char *path;
    struct bench_overrides overrides;
    void *row;
    /* Reads what the run left in `folder`, says it in a line. */
    status (*take)(void *row, const char *folder);
};
/* Runs jobs, `at_once` side by side with a thread each (1: one after the other with all threads). Takes what they leave
 * in the order of the jobs. */
status bench_jobs_run(struct bench_job *job, int n, int at_once);

/* A number of the summary, NAN where it has none. */
double bench_summary_figure(const char *folder, const char *key);

/* A figure and what is asked of it. */
struct bench_goal {
    char name[96], unit[8]; /* "%": of numbers [1], which are printed times 100 */
    double measured, asked; /* at most */
};
enum { BENCH_GOALS_MAX = 32 };
struct bench_goals {
    int n;
    struct bench_goal goal[BENCH_GOALS_MAX];
};
void bench_ask(struct bench_goals *t, const char *unit, double measured, double asked, const char *name, ...)
    __attribute__((format(printf, 5, 6)));
void bench_goals_print(const struct bench_goals *t);
/* Writes results/bench/NAME.csv and draws its bars. */
status bench_goals_write(const char *name, const struct bench_goals *t);

#endif
