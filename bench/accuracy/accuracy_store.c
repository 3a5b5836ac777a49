/* File results/bench/accuracy.csv: reads earlier results and appends new ones point by point. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy.h"
#include "base/memory.h"
#include "output/output_files.h"

#define STORE BENCH_FOLDER "/accuracy.csv"
#define STORED "bench/accuracy/cost_accuracy.csv"
#define HEADER                                                                                                         \
    "problem,case,method,resolution,horizon,step,error,part_1,part_2,part_3,loop_1_thread,loop_2_threads,particles,"   \
    "steps,stable,version,settings"

/* Writes the columns that identify point p in the file of results into text[size]: problem, case, method, resolution,
 * horizon and time step. */
static void put_key(const struct accuracy_point *p, char *text, size_t size)
{
    snprintf(text, size, "%s,%s,%s,%d,%.9g,%.9g,", p->problem->name, p->problem->cases[p->at], p->method->name,
             p->resolution, p->horizon, p->step);
}

/* ---- reading ----------------------------------------------------------------------------------------------------- */

/* Returns the number in the column of a line at *at, or NAN if the column is empty, and advances *at to the next
 * column. */
static double next_number(const char **at)
{
    char *end;
    const double value = strtod(*at, &end);
    const bool empty = end == *at;
    *at = end + strcspn(end, ",\n");
    if (**at == ',') ++*at;
    return empty ? NAN : value;
}

static bool line_ends_with(const char *line, const char *tail)
{
    const size_t length = strcspn(line, "\n"), wanted = strlen(tail);
    return line[length] == '\n' && length >= wanted && strncmp(line + length - wanted, tail, wanted) == 0;
}

/* Reads the result of a point from a line of the file of results into *r. Does nothing unless the line ends with the
 * present program version and the settings r->settings; incomplete lines thus do not count either. key: length of the
 * first columns, which identify the point and are skipped. */
static void take_line(struct accuracy_result *r, const char *line, size_t key)
{
    char tail[64];
    const char *at = line + key;
    snprintf(tail, sizeof tail, ",%s,%s", CLEAVE_VERSION, r->settings);
    if (!line_ends_with(line, tail)) return;
    r->known = true;
    r->error = next_number(&at);
    for (int k = 0; k < ACCURACY_PARTS; k++) r->part[k] = next_number(&at);
    for (int k = 0; k < 2; k++) r->seconds[k] = next_number(&at);
    r->particles = next_number(&at), r->steps = next_number(&at);
    r->stable = next_number(&at) > 0;
}

/* Reads the result of a point from a line of the stored table cost_accuracy.csv into *r: error, time on one thread,
 * particles and steps. key: length of the columns that identify the point, which are skipped. */
static void take_stored_line(struct accuracy_result *r, const char *line, size_t key)
{
    const char *at = line + key;
    *r = (struct accuracy_result){.known = true, .stable = true, .part = {NAN, NAN, NAN}, .seconds = {NAN, NAN}};
    r->error = next_number(&at), r->seconds[0] = next_number(&at);
    r->particles = next_number(&at), r->steps = next_number(&at);
}

/* For each point of the plan, finds the lines of `text` that begin with the columns that identify it, and calls
 * take(result of the point, line, length of these columns). */
static void take_lines(struct accuracy_plan *plan, const char *text,
                       void (*take)(struct accuracy_result *r, const char *line, size_t key))
{
    char key[256];
    for (int k = 0; k < plan->n; k++) {
        put_key(&plan->entry[k].point, key, sizeof key);
        const size_t wanted = strlen(key);
        for (const char *line = text; line; line = strchr(line, '\n'), line = line ? line + 1 : NULL)
            if (strncmp(line, key, wanted) == 0) take(&plan->entry[k].result, line, wanted);
    }
}

status accuracy_read_recorded_results(struct accuracy_plan *plan)
{
    char *text;
    size_t length;
    TRY(file_read_whole(STORED, &text, &length));
    take_lines(plan, text, take_stored_line);
    memory_free(text);
    return OK;
}

bool accuracy_results_file_exists(void) { return path_is_file(STORE); }

/* ---- writing ----------------------------------------------------------------------------------------------------- */

/* Writes the number `value` and a comma to a CSV file, or only the comma if it is not finite. */
static void accuracy_store_put_number(FILE *to, double value)
{
    if (isfinite(value)) fprintf(to, "%.9g", value);
    fputc(',', to);
}

static void put_line(FILE *to, const struct accuracy_entry *entry)
{
    const struct accuracy_result *r = &entry->result;
    char key[256];
    put_key(&entry->point, key, sizeof key);
    fputs(key, to);
    accuracy_store_put_number(to, r->error);
    for (int k = 0; k < ACCURACY_PARTS; k++) accuracy_store_put_number(to, r->part[k]);
    for (int k = 0; k < 2; k++) accuracy_store_put_number(to, r->seconds[k]);
    accuracy_store_put_number(to, r->particles), accuracy_store_put_number(to, r->steps);
    fprintf(to, "%d,%s,%s\n", r->stable, CLEAVE_VERSION, r->settings);
}

status accuracy_append_result_to_file(const struct accuracy_entry *entry)
{
    TRY(bench_prepare_result_files("accuracy"));
    const bool fresh = !path_is_file(STORE);
    FILE *to = fopen(STORE, "a");
    if (!to) return file_report_write_failure(STORE, errno);
    if (fresh) fputs(HEADER "\n", to);
    put_line(to, entry);
    return fclose(to) == 0 ? OK : file_report_write_failure(STORE, errno);
}

static void fill_points(struct bench_table *t, const struct accuracy_plan *plan)
{
    bench_table_make(t, "", HEADER);
    for (int k = 0; k < plan->n; k++) {
        const struct accuracy_point *p = &plan->entry[k].point;
        const struct accuracy_result *r = &plan->entry[k].result;
        if (!r->known) continue;
        const double figures[] = {r->error,      r->part[0],   r->part[1], r->part[2], r->seconds[0],
                                  r->seconds[1], r->particles, r->steps,   r->stable};
        bench_table_append_text(t, p->problem->name), bench_table_append_text(t, p->problem->cases[p->at]),
            bench_table_append_text(t, p->method->name);
        bench_table_append_number(t, p->resolution), bench_table_append_number(t, p->horizon),
            bench_table_append_number(t, p->step);
        for (size_t c = 0; c < COUNT_OF(figures); c++) bench_table_append_number(t, figures[c]);
        bench_table_append_text(t, CLEAVE_VERSION), bench_table_append_text(t, r->settings);
    }
}

static void fill_problems(struct bench_table *t)
{
    bench_table_make(t, "problems", "problem,title,error,part_1,part_2,part_3,resolution");
    for (int k = 0; k < accuracy_problems; k++) {
        const struct accuracy_problem *q = accuracy_problem[k];
        const char *const words[] = {q->name,
                                     q->title,
                                     q->error,
                                     q->part[0] ? q->part[0] : "-",
                                     q->part[1] ? q->part[1] : "-",
                                     q->part[2] ? q->part[2] : "-",
                                     q->counts};
        for (size_t c = 0; c < COUNT_OF(words); c++) bench_table_append_text(t, words[c]);
    }
}

status accuracy_write_all_results(const struct accuracy_plan *plan)
{
    struct bench_table table[2];
    fill_points(&table[0], plan);
    fill_problems(&table[1]);
    status s = bench_write_result_tables("accuracy", table, COUNT_OF(table));
    for (size_t k = 0; k < COUNT_OF(table); k++) bench_table_free(&table[k]);
    return s;
}

/* Reads the known results of all points of the plan from the file of results, and writes the file again with only the
 * lines that belong to a point of the plan. Does nothing if there is no such file. Returns FAILED if it cannot be read,
 * REFUSED or FAILED if it cannot be written. */
status accuracy_read_earlier_results(struct accuracy_plan *plan)
{
    char *text;
    size_t length;
    if (!accuracy_results_file_exists()) return OK;
    TRY(file_read_whole(STORE, &text, &length));
    take_lines(plan, text, take_line);
    memory_free(text);
    return accuracy_write_all_results(plan);
}
