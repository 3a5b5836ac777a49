/* Writes results/bench/cost_accuracy.csv from the known points of the table. A line (all resolutions of a method at one
 * horizon and time step) is written if one of its points is on the Pareto front of its family in some case, because a
 * scene may exclude all families but one. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "accuracy.h"
#include "base/memory.h"
#include "output/output_files.h"

/* ---- selection of lines ------------------------------------------------------------------------------------------ */

/* Returns true if point e of the table has the known result of a stable run, with finite error and time. */
static bool is_usable(const struct accuracy_entry *e)
{
    return e->result.known && e->result.stable && isfinite(e->result.error) && isfinite(e->result.seconds[0]);
}

static bool accuracy_table_same_line(const struct accuracy_point *a, const struct accuracy_point *b)
{
    return a->problem == b->problem && a->method == b->method && a->horizon == b->horizon && a->step == b->step;
}

#define WORST 0.2 /* points with larger errors are ignored for the front */

/* Sets kept[k] to true for each point k of the plan that is on the Pareto front of the given families of methods in
 * case `at` of problem q, unless its error exceeds WORST; other entries of kept[] are left as they are. family: bit set
 * of enum accuracy_family. */
static void mark_front(const struct accuracy_plan *plan, const struct accuracy_problem *q, int at, int family,
                       bool *kept)
{
    struct accuracy_dot *dot = NEW("bench.chart", plan->n, struct accuracy_dot);
    int *of = NEW("bench.chart", plan->n, int), *front = NEW("bench.chart", plan->n, int), n = 0;
    for (int k = 0; k < plan->n; k++) {
        const struct accuracy_entry *e = &plan->entry[k];
        if (e->point.problem != q || e->point.at != at || !((int)e->point.method->family & family) || !is_usable(e))
            continue;
        dot[n] = (struct accuracy_dot){e->result.seconds[0], e->result.error};
        of[n++] = k;
    }
    const int found = accuracy_find_pareto_front(dot, n, front);
    for (int k = 0; k < found; k++) kept[of[front[k]]] |= dot[front[k]].error <= WORST;
    memory_free(dot), memory_free(of), memory_free(front);
}

static bool *kept_points(const struct accuracy_plan *plan)
{
    bool *marked = NEW("bench.chart", plan->n, bool), *kept = NEW("bench.chart", plan->n, bool);
    for (int k = 0; k < accuracy_problems; k++)
        for (int at = 0; at < accuracy_case_count(accuracy_problem[k]); at++)
            for (int family = ACCURACY_BONDS; family <= ACCURACY_ADAPTIVE; family *= 2)
                mark_front(plan, accuracy_problem[k], at, family, marked);
    for (int k = 0; k < plan->n; k++)
        for (int j = 0; j < plan->n && !kept[k]; j++)
            kept[k] = marked[j] && accuracy_table_same_line(&plan->entry[k].point, &plan->entry[j].point);
    memory_free(marked);
    return kept;
}

/* ---- lines of the file ------------------------------------------------------------------------------------------- */

/* Returns true if the scene key `key` is not written to the column `keys` of the table: it has a column of its own, or
 * it does not describe the method. */
static bool accuracy_table_is_apart(const char *key)
{
    return strncmp(key, "particles.", 10) == 0 || strncmp(key, "time.", 5) == 0 || strncmp(key, "output.", 7) == 0;
}

static void put_keys(FILE *to, const struct accuracy_point *p)
{
    struct accuracy_scene s;
    const char *between = "";
    accuracy_compose_scene_of_point(p, &s);
    for (int k = 0; k < s.set.n; k++) {
        bool again = accuracy_table_is_apart(s.set.at[k].key);
        for (int j = k + 1; j < s.set.n; j++) again |= strcmp(s.set.at[j].key, s.set.at[k].key) == 0;
        if (again) continue;
        fprintf(to, "%s%s=%s", between, s.set.at[k].key, s.set.value[k]);
        between = ";";
    }
}

static void put_entry(FILE *to, const struct accuracy_entry *e)
{
    const struct accuracy_point *p = &e->point;
    const struct accuracy_result *r = &e->result;
    fprintf(to, "%s,%s,%s,%d,%g,%g,%.3g,%.3g,%.9g,%.9g,", p->problem->name, p->problem->cases[p->at], p->method->name,
            p->resolution, p->horizon, p->step, r->error, r->seconds[0], r->particles, r->steps);
    put_keys(to, p);
    fputc('\n', to);
}

status accuracy_write_table_of_pareto_lines(const struct accuracy_plan *plan)
{
    static const char path[] = BENCH_FOLDER "/cost_accuracy.csv";
    TRY(bench_create_results_folder());
    FILE *to = fopen(path, "w");
    if (!to) return file_report_write_failure(path, errno);
    bool *kept = kept_points(plan);
    fputs(ACCURACY_TABLE_HEADER "\n", to);
    for (int k = 0; k < plan->n; k++)
        if (kept[k] && is_usable(&plan->entry[k])) put_entry(to, &plan->entry[k]);
    memory_free(kept);
    return fclose(to) == 0 ? OK : file_report_write_failure(path, errno);
}
