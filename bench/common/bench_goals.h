/* Runs as parallel separate processes; results compared with goals (bench_goals.c). */
#ifndef CLEAVE_BENCH_GOALS
#define CLEAVE_BENCH_GOALS

#include "bench/common/bench.h"

/* A run of a scene as a separate process. path: scene file; overrides: of its keys. */
struct bench_job {
    const char *path;
    struct bench_overrides overrides;
    void *row; /* argument of `take` */
    /* Reads the output of the run in `folder` and prints a line about it. */
    status (*take)(void *row, const char *folder);
};

/* Runs the jobs job[job_count] as separate processes and calls `take` of each after its end, in the order of the jobs.
 * parallel_jobs: number of jobs in parallel, with one thread each; 1: one after another, each with all threads. Returns
 * FAILED if a run fails, else the first status of a `take` that is not OK. */
status bench_jobs_run(struct bench_job *job, int job_count, int parallel_jobs);

/* Returns the number called `key` (names joined by dots) of the file summary.json in `folder`, the folder of a run; NAN
 * if there is no such number. */
double bench_summary_figure(const char *folder, const char *key);

/* A measured result of a bench and its goal, the largest value that it should have. */
struct bench_goal {
    char name[96], unit[8]; /* "%": value [1] that is printed times 100 */
    double measured, asked; /* measured value; largest value that meets the goal */
};
enum { BENCH_GOALS_MAX = 32 };
struct bench_goals {
    int n;
    struct bench_goal goal[BENCH_GOALS_MAX];
};

/* Adds a goal to the table *t. unit: unit of the values, "%" for values that are printed times 100; measured: measured
 * value; asked: largest value that meets the goal; name: name of the goal, a format of printf followed by its
 * arguments. */
void bench_add_goal(struct bench_goals *t, const char *unit, double measured, double asked, const char *name, ...)
    __attribute__((format(printf, 5, 6)));

/* Prints all goals to standard output with measured and required values, and marks the goals that are missed. */
void bench_goals_print(const struct bench_goals *goals);

/* Writes the goals to results/bench/NAME.csv and .json, where NAME is `bench_name`, and draws a bar for each in
 * NAME.png and .svg. Returns FAILED if a file cannot be written. */
status bench_goals_write(const char *bench_name, const struct bench_goals *goals);

#endif
