/* Duration of load steps: a hundred steps of a notched plate of 100,000 particles on all threads, and one equilibrium
 * of it with all solvers. */
#include <math.h>
#include <stdlib.h>

#include "slow.h"

#define PLATE "inputs/edge_crack_grips.yaml"

struct speed_row {
    double particles, seconds, steps;
};

static status speed_take(void *row, const char *folder)
{
    struct speed_row *r = row;
    r->particles = bench_summary_figure(folder, "particles");
    r->seconds = bench_summary_figure(folder, "loop_seconds");
    r->steps = bench_summary_figure(folder, "steps");
    return OK;
}

static void speed_put(struct bench_table *t, const char *name, const struct speed_row *r)
{
    printf("  %-36s %9.0f %8.0f %9.2f\n", name, r->particles, r->steps, r->seconds);
    fflush(stdout);
    bench_table_append_text(t, name);
    bench_table_append_number(t, r->particles), bench_table_append_number(t, r->steps),
        bench_table_append_number(t, r->seconds);
}

static status hundred_steps(struct bench_table *t, struct bench_goals *asked, bool quick)
{
    struct speed_row r = {0};
    struct bench_job job = {.path = PLATE, .row = &r, .take = speed_take};
    bench_overrides_append(&job.overrides, "particles.spacing", "40/%d mm", quick ? 40 : 180);
    bench_overrides_append(&job.overrides, "steps.number", "%d", quick ? 5 : 100);
    bench_overrides_append(&job.overrides, "output.frames", "0");
    TRY(bench_jobs_run(&job, 1, 1));
    speed_put(t, "load steps, the crack grows", &r);
    if (!quick)
        bench_add_goal(asked, "s", r.seconds, 300, "100 load steps of 100,000 particles, %d threads",
                       threads_set_count_and_bind_to_cores(0));
    return OK;
}

/* Computes one equilibrium of a notched plate with each solver to the tolerance of the scene, and adds particles, steps
 * and times to the table t. quick: the coarse plate only. Returns FAILED if a run fails. */
static status solvers(struct bench_table *t, bool quick)
{
    static const char *const solver[] = {"static", "cg", "relaxation"};
    for (int fine = 1; fine <= (quick ? 1 : 3); fine += 2)
        for (size_t k = 0; k < COUNT_OF(solver); k++) {
            struct speed_row r = {0};
            char name[64];
            struct bench_job job = {.path = PLATE, .row = &r, .take = speed_take};
            bench_overrides_append(&job.overrides, "particles.spacing", "%.9g mm", 40.0 / (60 * fine));
            bench_overrides_append(&job.overrides, "solver", "%s", solver[k]);
            bench_overrides_append(&job.overrides, "steps", "%s", k == 0 ? "{number: 1}" : "{}");
            bench_overrides_append(&job.overrides, "boundary.0.displacement", "[0, 0.02 mm]");
            bench_overrides_append(&job.overrides, "output.frames", "0");
            TRY(bench_jobs_run(&job, 1, 1));
            snprintf(name, sizeof name, "one equilibrium, solver %s", solver[k]);
            speed_put(t, name, &r);
        }
    return OK;
}

status slow_time_load_steps(struct bench_goals *goals, bool quick)
{
    struct bench_table t;
    bench_table_make(&t, "", "case,particles,steps,loop_seconds");
    printf("\n  %-36s %9s %8s %9s\n", "time", "particles", "steps", "s");
    status s = hundred_steps(&t, goals, quick);
    if (s == OK) s = solvers(&t, quick);
    if (s == OK) s = bench_write_result_tables("slow_speed", &t, 1);
    bench_table_free(&t);
    return s;
}
