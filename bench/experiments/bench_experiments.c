/* `cleave bench experiments`: compares cracks with experiments and with other codes, including their scatter. Every
 * quoted value states its source. */
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "experiments.h"
#include "output/output_files.h"
#include "plot/gnuplot.h"

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Returns true if the result r is compared with a range of values, which an experiment or another code gives. */
static bool experiment_is_asked(const struct experiment_row *r) { return !isnan(r->low); }

static bool experiment_is_held(const struct experiment_row *r) { return r->value >= r->low && r->value <= r->high; }

static void experiment_row_print(const struct experiment_row *r)
{
    printf("  %-19s %-11s %-24s", r->experiment, r->variant, r->figure);
    if (isfinite(r->value))
        printf(" %9.4g %-6s", r->value, r->unit);
    else
        printf(" %9s %-6s", "none", "");
    if (!isnan(r->deviation))
        printf(" %8.2g %2d", r->deviation, r->runs);
    else
        printf(" %8s %2s", "", "");
    if (!isnan(r->interval))
        printf(" %8.2g", r->interval);
    else
        printf(" %8s", "");
    if (experiment_is_asked(r))
        printf("  %s %.4g .. %.4g (%s)", experiment_is_held(r) ? "holds" : "SHORT", r->low, r->high, r->source);
    if (r->coarser) printf("  [");
    for (int k = 0; k < r->coarser; k++)
        if (isfinite(r->coarse[k][1]))
            printf("%s%.3g mm: %.4g +- %.2g", k ? ", " : "", r->coarse[k][0], r->coarse[k][1], r->coarse[k][2]);
        else
            printf("%s%.3g mm: none", k ? ", " : "", r->coarse[k][0]);
    puts(r->coarser ? "]" : "");
    fflush(stdout);
}

void experiment_add_and_print_result(struct experiments *x, struct experiment_row result)
{
    INVARIANT(x->n < EXPERIMENT_ROWS_MOST);
    x->row[x->n++] = result;
    experiment_row_print(&result);
}

struct experiment_curve *experiment_add_empty_curve(struct experiments *x, const char *picture, const char *name, ...)
{
    va_list more;
    INVARIANT(x->curves < EXPERIMENT_CURVES_MOST);
    struct experiment_curve *c = &x->curve[x->curves++];
    c->picture = picture;
    va_start(more, name);
    vsnprintf(c->name, sizeof c->name, name, more);
    va_end(more);
    return c;
}

void experiment_curve_append_point(struct experiment_curve *c, double x, double y, double error_bar_half_height)
{
    GROW("bench.curve", c->x, c->n + 1);
    GROW("bench.curve", c->y, c->n + 1);
    GROW("bench.curve", c->error, c->n + 1);
    c->x[c->n] = x, c->y[c->n] = y, c->error[c->n++] = error_bar_half_height;
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Writes the results and the curves of x as the tables experiments.csv and experiments_curves.csv in results/bench.
 * Returns FAILED if a file cannot be written. */
static status experiments_write(const struct experiments *x)
{
    struct bench_table t[2];
    bench_table_make(&t[0], "",
                     "experiment,variant,figure,unit,value,deviation,runs,interval,asked_low,asked_high,source,verdict,"
                     "spacing_mm,spacing_1_mm,value_1,deviation_1,spacing_2_mm,value_2,deviation_2");
    bench_table_make(&t[1], "curves", "picture,name,x,y,error");
    for (int k = 0; k < x->n; k++) {
        const struct experiment_row *r = &x->row[k];
        bench_table_append_text(&t[0], r->experiment), bench_table_append_text(&t[0], r->variant),
            bench_table_append_text(&t[0], r->figure);
        bench_table_append_text(&t[0], r->unit[0] ? r->unit : "1");
        const double number[] = {r->value, r->deviation, r->runs, r->interval, r->low, r->high};
        for (size_t c = 0; c < COUNT_OF(number); c++) bench_table_append_number(&t[0], number[c]);
        bench_table_append_text(&t[0], r->source && r->source[0] ? r->source : "-");
        bench_table_append_text(&t[0], r->verdict && r->verdict[0] ? r->verdict : "-");
        bench_table_append_number(&t[0], r->spacing);
        for (int l = 0; l < 2; l++)
            for (int c = 0; c < 3; c++) bench_table_append_number(&t[0], l < r->coarser ? r->coarse[l][c] : NAN);
    }
    for (int k = 0; k < x->curves; k++)
        for (int64_t i = 0; i < x->curve[k].n; i++) {
            bench_table_append_text(&t[1], x->curve[k].picture), bench_table_append_text(&t[1], x->curve[k].name);
            bench_table_append_number(&t[1], x->curve[k].x[i]), bench_table_append_number(&t[1], x->curve[k].y[i]);
            bench_table_append_number(&t[1], x->curve[k].error[i]);
        }
    const status s = bench_write_result_tables("experiments", t, 2);
    bench_table_free(&t[0]), bench_table_free(&t[1]);
    return s;
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Releases all results, curves and crack paths of x, and removes its folder. */
static void experiments_free(struct experiments *x)
{
    for (int k = 0; k < x->paths; k++)
        memory_free(x->path[k].level), memory_free(x->path[k].y), memory_free(x->path[k].x);
    for (int k = 0; k < x->curves; k++)
        memory_free(x->curve[k].error), memory_free(x->curve[k].y), memory_free(x->curve[k].x);
    bench_folder_remove(x->folder);
    memory_free(x);
}

/* Prints how many results of x are outside their required ranges, and lists these results. */
static void experiments_summary(const struct experiments *x)
{
    int asked = 0, held = 0;
    for (int k = 0; k < x->n; k++)
        asked += experiment_is_asked(&x->row[k]),
            held += experiment_is_asked(&x->row[k]) && experiment_is_held(&x->row[k]);
    printf("\n  %d of %d figures that something is asked of fall short%s\n", asked - held, asked,
           asked > held ? ":" : "");
    for (int k = 0; k < x->n; k++)
        if (experiment_is_asked(&x->row[k]) && !experiment_is_held(&x->row[k])) experiment_row_print(&x->row[k]);
}

status bench_experiments(bool quick)
{
    static status (*const part[])(struct experiments *) = {
        experiments_run_plates, experiments_run_surfing_crack, experiments_run_strip,
        experiments_run_vortex, experiments_run_notched_beam,  experiments_run_compressed_disc};
    struct experiments *x = NEW("bench.experiments", 1, struct experiments);
    status s = bench_create_results_folder();
    x->quick = quick;
    strcpy(x->folder, BENCH_FOLDER "/experiments-XXXXXX");
    printf("experiments\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    if (s == OK && !mkdtemp(x->folder)) s = file_report_write_failure(x->folder, errno), x->folder[0] = 0;
    printf("  %-19s %-11s %-24s %9s %-6s %8s %2s %8s  asked (source)  [coarser spacings]\n", "experiment", "variant",
           "figure", "mean", "", "one run", "n", "95 %");
    for (size_t k = 0; k < COUNT_OF(part) && s == OK; k++) s = part[k](x);
    if (s == OK) experiments_summary(x);
    if (s == OK) s = experiments_write(x);
    if (s == OK) s = experiments_draw_all_pictures(x);
    experiments_free(x);
    return s;
}
