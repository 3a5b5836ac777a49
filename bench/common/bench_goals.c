/* Runs as parallel separate processes; results compared with goals. */
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "bench_goals.h"
#include "base/memory.h"
#include "output/summary_read.h"

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Starts the run of a job as a separate process on `threads` threads. child: receives the process. Returns FAILED if
 * no process can be started. */
static status job_start(struct bench_job *job, struct bench_child *child, int threads)
{
    return bench_child_start(child, job->path, bench_overrides_as_array(&job->overrides), job->overrides.n, threads);
}

static status job_end(struct bench_job *job, struct bench_child *child)
{
    TRY(bench_child_wait(child));
    TRY(job->take(job->row, child->folder));
    fflush(stdout);
    return OK;
}

status bench_jobs_run(struct bench_job *job, int job_count, int parallel_jobs)
{
    const int threads = parallel_jobs > 1 ? 1 : threads_set_count_and_bind_to_cores(0);
    struct bench_child *child = NEW("bench.children", job_count, struct bench_child);
    status s = OK;
    int started = 0;
    for (int k = 0; k < job_count && s == OK; k++) {
        while (started < job_count && started < k + parallel_jobs && s == OK)
            s = job_start(&job[started], &child[started], threads), started++;
        if (s == OK) s = job_end(&job[k], &child[k]);
        bench_child_wait_and_remove_output(&child[k]);
    }
    for (int k = 0; k < started; k++) bench_child_wait_and_remove_output(&child[k]);
    memory_free(child);
    return s;
}

double bench_summary_figure(const char *folder, const char *key)
{
    double value;
    return summary_read_number(folder, key, &value) == OK ? value : NAN;
}

/* ---- goals ------------------------------------------------------------------------------------------------------- */

/* Adds a goal to the table *goals. unit: unit of the printed values; measured: measured value; largest_allowed: largest
 * value that meets the goal, in the unit of `measured`; name: name of the goal, a format of printf with its arguments.
 */
void bench_add_goal(struct bench_goals *goals, const char *unit, double measured, double largest_allowed,
                    const char *name, ...)
{
    va_list more;
    INVARIANT(goals->n < BENCH_GOALS_MAX);
    struct bench_goal *new = &goals->goal[goals->n++];
    va_start(more, name);
    vsnprintf(new->name, sizeof new->name, name, more);
    va_end(more);
    snprintf(new->unit, sizeof new->unit, "%s", unit);
    new->measured = measured, new->asked = largest_allowed;
}

void bench_goals_print(const struct bench_goals *goals)
{
    printf("\n  what is asked%-46s %10s %10s\n", "", "measured", "at most");
    for (int k = 0; k < goals->n; k++) {
        const struct bench_goal *g = &goals->goal[k];
        const double factor = strcmp(g->unit, "%") == 0 ? 100 : 1;
        printf("  %-59s %8.2f %s %8.2f %s%s\n", g->name, factor * g->measured, g->unit, factor * g->asked, g->unit,
               g->measured <= g->asked ? "" : "   missed");
    }
}

static status goals_write(const char *name, const struct bench_goals *t)
{
    struct bench_table rows;
    bench_table_make(&rows, "", "figure,unit,measured,asked_at_most");
    for (int k = 0; k < t->n; k++) {
        bench_table_append_text(&rows, t->goal[k].name);
        bench_table_append_text(&rows, strcmp(t->goal[k].unit, "%") == 0 ? "1" : t->goal[k].unit);
        bench_table_append_number(&rows, t->goal[k].measured);
        bench_table_append_number(&rows, t->goal[k].asked);
    }
    status s = bench_write_result_tables(name, &rows, 1);
    bench_table_free(&rows);
    return s;
}

/* Sends gnuplot commands that draw a bar for each goal: measured value over the largest value that meets the goal.
 * context: a struct bench_goals. */
static void goals_draw(FILE *to, const void *context)
{
    const struct bench_goals *t = context;
    fputs("$bars << EOD\n", to);
    for (int k = 0; k < t->n; k++)
        fprintf(to, "%d %.6g \"%s\"\n", t->n - k, t->goal[k].measured / t->goal[k].asked, t->goal[k].name);
    fprintf(to,
            "EOD\nset lmargin at screen 0.5\nset xrange [0:1.6]\nset yrange [0.3:%g]\nset boxwidth 0.6\nset key off\n"
            "set ytics scale 0\nset xlabel 'deviation over what is asked'\n"
            "set arrow 1 from 1, graph 0 to 1, graph 1 nohead lw 2 lc rgb '#3d3d3d' front\n"
            "plot $bars using (0.5*$2):1:(0.5*$2):(0.3):ytic(3) with boxxy fs solid 0.85 noborder lc rgb '#0072b2'\n",
            t->n + 0.7);
}

status bench_goals_write(const char *bench_name, const struct bench_goals *goals)
{
    TRY(goals_write(bench_name, goals));
    return bench_draw(bench_name, 1100, 120 + 32 * goals->n, goals_draw, goals);
}
