/* `cleave bench accuracy`: error against computing time of every method on problems with known solutions. Runs the
 * unknown points of the table one by one, then writes tables, charts and the overview page. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "accuracy.h"
#include "base/memory.h"
#include "step/report.h"

/* ---- results of a run -------------------------------------------------------------------------------------------- */

/* Returns the quantity called `quantity` of the probe called `probe` of the finished run; NAN if there is none. */
double accuracy_probe_value_of_run(const struct run *run, const char *probe, const char *quantity)
{
    struct bench_figure figure = {probe, quantity, NAN};
    bench_figures_read_from_probes(run, &figure, 1);
    return figure.value;
}

/* ---- one point --------------------------------------------------------------------------------------------------- */

enum { RUNS_MOST = 3 };  /* largest number of runs of a point */
#define RUNS_SECONDS 0.3 /* total time within which short runs are repeated to measure their duration [s] */

/* Returns the processor time of this thread [s]. It excludes the time taken by other programs. */
static double processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Runs the point `entry` of the cost-accuracy table once on team + 1 threads. Lowers seconds[team] of its result to the
 * time of the time loop [s] if that is shorter than in earlier runs. Measures the error if it is not known yet. A run
 * that stops as unstable is a result, too, and OK is returned. Returns REFUSED or FAILED if the scene is invalid. */
static status accuracy_run_once(struct accuracy_entry *entry, int team)
{
    struct run e;
    struct scene s;
    struct accuracy_scene from;
    const struct accuracy_point *p = &entry->point;
    struct accuracy_result *r = &entry->result;
    accuracy_compose_scene_of_point(p, &from);
    threads_set_count_and_bind_to_cores(team + 1);
    TRY(bench_engine_make(&e, &s, from.path[0] ? from.path : p->problem->name, from.path[0] ? NULL : from.text,
                          bench_overrides_as_array(&from.set), from.set.n));
    const double before = processor_seconds();
    status ran = p->problem->run ? p->problem->run(p, &e) : run_advance_to_end_time(&e);
    const double busy = team == 0 ? processor_seconds() - before : INFINITY;
    r->seconds[team] = fmin(r->seconds[team], fmin(report_wall_clock_times(e.report, &e.timers).loop, busy));
    r->particles = (double)e.part.n, r->steps = (double)e.clock.step, r->stable = ran == OK;
    if (ran == OK && !r->known) ran = p->problem->measure(p, &e, &r->error, r->part);
    bench_engine_free(&e, &s);
    r->known = true;
    return ran == FAILED ? OK : ran;
}

/* Runs the point `entry` of the cost-accuracy table on one thread and, unless it is 1D, on two threads. Repeats short
 * runs up to RUNS_MOST times, and appends the result to the file of results. The error is measured once, since it does
 * not depend on the number of threads. A run that fails is a result, too. Returns the first status that is not OK. */
static status run_point(struct accuracy_entry *entry)
{
    struct accuracy_result *r = &entry->result;
    char settings[sizeof r->settings];
    memcpy(settings, r->settings, sizeof settings);
    *r = (struct accuracy_result){.error = NAN, .part = {NAN, NAN, NAN}, .seconds = {INFINITY, INFINITY}};
    memcpy(r->settings, settings, sizeof settings);
    double spent = 0;
    for (int run = 0; run < RUNS_MOST && spent < RUNS_SECONDS; run++)
        for (int team = 0; team < (entry->point.problem->dim > 1 ? 2 : 1); team++) {
            TRY(accuracy_run_once(entry, team));
            spent += r->seconds[team];
        }
    if (!isfinite(r->error)) r->stable = false;
    return accuracy_append_result_to_file(entry);
}

/* ---- all points -------------------------------------------------------------------------------------------------- */

/* Returns the predicted time of all repetitions of point p [s], for comparison with other points of its problem: 100 ns
 * per particle and step, more for long horizons, plus set-up. The absolute value is only approximate. */
static double work_of(const struct accuracy_point *p)
{
    const int dim = p->problem->dim;
    const double particles = pow(p->resolution, dim), steps = p->resolution / p->step;
    const double run = particles * (1e-7 * steps * (1 + 0.3 * pow(p->horizon / 3, dim)) + 3e-6) + 0.01;
    return run * (dim > 1 ? 2 : 1) * (run < 0.5 * RUNS_SECONDS ? RUNS_MOST : 1);
}

enum { PROBLEMS_MAX = 16 };
/* Times of the points of each problem. spent: measured so far [s]; done: predicted by work_of for the finished
 * points; asked: predicted for all points that are to be run. */
struct progress {
    double spent[PROBLEMS_MAX], done[PROBLEMS_MAX], asked[PROBLEMS_MAX];
};

static int accuracy_number_of(const struct accuracy_problem *q)
{
    int k = 0;
    while (accuracy_problem[k] != q) k++;
    return k;
}

/* Returns the predicted time of the remaining points of g [s]: from the measured rate for problems with results, and
 * from their tabulated durations for others. quick: true to use the durations with --quick. */
static double seconds_left(const struct progress *g, bool quick)
{
    double left = 0;
    for (int k = 0; k < accuracy_problems; k++) {
        const struct accuracy_problem *q = accuracy_problem[k];
        if (g->asked[k] <= 0) continue;
        const bool known = g->done[k] > 0.01 * g->asked[k];
        left += known ? g->spent[k] * (g->asked[k] / g->done[k] - 1) : quick ? q->quick_seconds : q->seconds;
    }
    return left;
}

static void print_point(const struct accuracy_entry *entry, const struct progress *g, bool quick)
{
    const struct accuracy_result *r = &entry->result;
    char label[96], what[32], two[32] = "";
    accuracy_label(&entry->point, label, sizeof label);
    snprintf(what, sizeof what, r->stable ? "%9.3g %%" : "   unstable", 100 * r->error);
    const int left = (int)seconds_left(g, quick);
    if (isfinite(r->seconds[1])) snprintf(two, sizeof two, "%9.3g s", r->seconds[1]);
    fprintf(stderr, "  %-8s %-10s %-34s %s %9.3g s %11s   left %d:%02d\n", entry->point.problem->name,
            entry->point.problem->cases[entry->point.at], label, what, r->seconds[0], two, left / 60, left % 60);
    fflush(stdout);
}

static bool is_asked(const struct accuracy_entry *entry, const char *only, bool quick)
{
    return !entry->result.known && (!quick || entry->quick) && (!only || strcmp(only, entry->point.problem->name) == 0);
}

static status accuracy_run_all(struct accuracy_plan *plan, const char *only, bool quick)
{
    struct progress g = {0};
    int asked = 0;
    INVARIANT(accuracy_problems <= PROBLEMS_MAX);
    for (int k = 0; k < plan->n; k++) {
        if (!is_asked(&plan->entry[k], only, quick)) continue;
        g.asked[accuracy_number_of(plan->entry[k].point.problem)] += work_of(&plan->entry[k].point), asked++;
    }
    printf("  %d points, %d of them to be run; error, loop time on one thread and on two\n", plan->n, asked);
    for (int k = 0; k < plan->n; k++) {
        if (!is_asked(&plan->entry[k], only, quick)) continue;
        const int problem = accuracy_number_of(plan->entry[k].point.problem);
        const double before = wall_clock_seconds();
        TRY(run_point(&plan->entry[k]));
        g.spent[problem] += wall_clock_seconds() - before, g.done[problem] += work_of(&plan->entry[k].point);
        print_point(&plan->entry[k], &g, quick);
    }
    return OK;
}

/* Writes tables and charts from the known results of the plan, without runs. If there are none, draws the charts of the
 * stored table. Returns the first status that is not OK. */
static status write_known(struct accuracy_plan *plan)
{
    TRY(accuracy_plan_make(plan));
    if (!accuracy_results_file_exists()) {
        TRY(accuracy_read_recorded_results(plan));
        return accuracy_draw_all_pictures(plan);
    }
    TRY(accuracy_read_earlier_results(plan));
    TRY(accuracy_write_table_of_pareto_lines(plan));
    return accuracy_draw_all_pictures(plan);
}

static status accuracy_measure_all(struct accuracy_plan *plan, const char *only, bool quick)
{
    TRY(accuracy_plan_make(plan));
    TRY(accuracy_read_earlier_results(plan));
    TRY(accuracy_run_all(plan, only, quick));
    threads_set_count_and_bind_to_cores(0);
    TRY(accuracy_write_all_results(plan));
    TRY(accuracy_write_table_of_pareto_lines(plan));
    TRY(accuracy_write_overview_page(plan));
    return accuracy_draw_all_pictures(plan);
}

static bool is_problem(const char *name)
{
    for (int k = 0; k < accuracy_problems; k++)
        if (strcmp(accuracy_problem[k]->name, name) == 0) return true;
    return false;
}

status bench_accuracy_of_problem(const char *problem_name, bool quick)
{
    struct accuracy_plan plan = {0};
    const bool chart = problem_name && strcmp(problem_name, "chart") == 0;
    if (problem_name && strcmp(problem_name, "reference") == 0) return accuracy_compute_reference_cracks(quick);
    if (problem_name && !chart && !is_problem(problem_name))
        return status_set(REFUSED, "bench accuracy: there is no problem %s", problem_name);
    printf("accuracy\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    const status s = chart ? write_known(&plan) : accuracy_measure_all(&plan, problem_name, quick);
    accuracy_plan_free(&plan);
    return s;
}

status bench_accuracy(bool quick) { return bench_accuracy_of_problem(NULL, quick); }
