/* Runs as parallel separate processes; results compared with goals (bench_goals.c). */
#ifndef CLEAVE_BENCH_GOALS
#define CLEAVE_BENCH_GOALS

#include "bench/common/bench.h"

/* A run of a scene as a separate process. */
struct bench_job {
    const char *path;
    struct bench_overrides overrides;
    void *row; /* argument of `take` */
    /* Reads the output of the run in `folder` and prints a line about it. */
    status (*take)(void *row, const char *folder);
};

/* Runs n jobs, `at_once` in parallel with one thread each (1: one after another with all threads). Calls `take` in the
 * order of the jobs. */
status bench_jobs_run(struct bench_job *job, int n, int at_once);

/* Returns a number of the summary in `folder`, NAN if it has none. */
double bench_summary_figure(const char *folder, const char *key);

/* A result and its goal. */
struct bench_goal {
    char name[96], unit[8]; /* "%": value [1] that is printed times 100 */
    double measured, asked; /* measured value; largest value that meets the goal */
};
enum { BENCH_GOALS_MAX = 32 };
struct bench_goals {
    int n;
    struct bench_goal goal[BENCH_GOALS_MAX];
};

/* Adds a goal. name: format of printf. */
void bench_ask(struct bench_goals *t, const char *unit, double measured, double asked, const char *name, ...)
    __attribute__((format(printf, 5, 6)));

/* Prints all goals and whether they are met. */
void bench_goals_print(const struct bench_goals *t);

/* Writes results/bench/NAME.csv and draws its bars. */
status bench_goals_write(const char *name, const struct bench_goals *t);

#endif
