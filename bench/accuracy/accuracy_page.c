/* Overview page of the cost-accuracy table: the cheapest method for errors of 5 %, 1 % and 0.3 % in every problem. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"

static const double wanted[] = {0.05, 0.01, 0.003};

/* ---- the table --------------------------------------------------------------------------------------------------- */

/* Writes a cell of a table: method, resolution, time and error of the fastest run with an error of at most `error` [1];
 * a dash if there is none. dot[n]: time and error of the runs; of[n]: their entries in the table. */
static void put_cheapest(FILE *to, const struct accuracy_dot *dot, const struct accuracy_entry *const *of, int n,
                         double error)
{
    const int k = accuracy_index_of_fastest_point(dot, n, error);
    char label[96];
    if (k < 0) {
        fputs(" – |", to);
        return;
    }
    accuracy_label(&of[k]->point, label, sizeof label);
    fprintf(to, " %s: %.2g s (%.2g %%) |", label, dot[k].time, 100 * dot[k].error);
}

static void put_row(FILE *to, const struct accuracy_plan *plan, const struct accuracy_problem *q, int at)
{
    struct accuracy_dot *dot = NEW("bench.dot", plan->n, struct accuracy_dot);
    const struct accuracy_entry **of = NEW("bench.of", plan->n, const struct accuracy_entry *);
    const int n = accuracy_collect_times_and_errors(plan, q, at, -1, dot, of);
    if (n > 0) {
        fprintf(to, "| %s | %s |", q->name, at < 0 ? "worst of all" : q->cases[at]);
        for (size_t k = 0; k < COUNT_OF(wanted); k++) put_cheapest(to, dot, of, n, wanted[k]);
        fputc('\n', to);
    }
    memory_free(dot);
    memory_free(of);
}

static void accuracy_page_put_table(FILE *to, const struct accuracy_plan *plan)
{
    fputs("| problem | case |", to);
    for (size_t k = 0; k < COUNT_OF(wanted); k++) fprintf(to, " %g %% |", 100 * wanted[k]);
    fputs("\n|---|---|---|---|---|\n", to);
    for (int k = 0; k < accuracy_problems; k++) {
        const int cases = accuracy_case_count(accuracy_problem[k]);
        for (int at = 0; at < cases; at++) put_row(to, plan, accuracy_problem[k], at);
        if (cases > 1) put_row(to, plan, accuracy_problem[k], -1);
    }
}

/* ---- the page ---------------------------------------------------------------------------------------------------- */

/* Returns true if the plan has a known result of the problem q. */
static bool has_points(const struct accuracy_plan *plan, const struct accuracy_problem *q)
{
    for (int k = 0; k < plan->n; k++)
        if (plan->entry[k].point.problem == q && plan->entry[k].result.known) return true;
    return false;
}

static void put_unstable(FILE *to, const struct accuracy_plan *plan)
{
    int n = 0;
    for (int k = 0; k < plan->n; k++) {
        const struct accuracy_entry *entry = &plan->entry[k];
        char label[96];
        if (!entry->result.known || entry->result.stable) continue;
        accuracy_label(&entry->point, label, sizeof label);
        fprintf(to, "%s- %s, %s: %s, after %.0f steps\n", n++ ? "" : "\nUnstable:\n\n", entry->point.problem->name,
                entry->point.problem->cases[entry->point.at], label, entry->result.steps);
    }
}

static void put_page(FILE *to, const struct accuracy_plan *plan)
{
    fprintf(to,
            "# Speed against accuracy\n\n%s, %d cores; cleave %s. Times are those of the step loop on one thread.\n\n"
            "![All problems](accuracy.png)\n\n## The cheapest way to an error\n\n",
            plan->machine.model, plan->machine.cores, CLEAVE_VERSION);
    accuracy_page_put_table(to, plan);
    put_unstable(to, plan);
    fputs("\n## The problems\n", to);
    for (int k = 0; k < accuracy_problems; k++) {
        const struct accuracy_problem *q = accuracy_problem[k];
        if (!has_points(plan, q)) continue;
        fprintf(to, "\n### %s\n\nError: %s. Resolution: %s.\n\n![%s](accuracy_%s.png)\n\n", q->title, q->error,
                q->counts, q->title, q->name);
        for (int r = 0; r < ACCURACY_REMARKS && q->remark[r]; r++) fprintf(to, "- %s\n", q->remark[r]);
    }
}

status accuracy_write_overview_page(const struct accuracy_plan *plan)
{
    char *text = NULL;
    size_t length = 0;
    FILE *to = memory_stream_open(&text, &length);
    if (!to) return status_set(FAILED, "bench accuracy: out of memory");
    put_page(to, plan);
    status s = fclose(to) == 0 ? file_write_whole(BENCH_FOLDER "/accuracy.md", text, length)
                               : status_set(FAILED, "bench accuracy: out of memory");
    free(text);
    puts("\n  the cheapest way to an error: method and resolution, loop time on one thread, error reached\n");
    accuracy_page_put_table(stdout, plan);
    puts("");
    return s;
}
