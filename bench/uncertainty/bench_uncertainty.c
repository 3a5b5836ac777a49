/* `cleave bench uncertainty`: tests the error bars of `cleave converge`. Scenes with known results are studied with
 * several methods and spacings: how often the interval of a nominal probability contains the exact value, and its width
 * over the true error. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "output/output_files.h"
#include "plot/gnuplot.h"
#include "base/memory.h"
#include "study/convergence_study.h"
#include "uncertainty.h"

/* ROWS_MOST: largest number of rows; RUNS, RUNS_QUICK: runs at each spacing without and with --quick; TEXT_ROOM:
 * capacity of a scene [byte]. */
enum { ROWS_MOST = 512, RUNS = 5, RUNS_QUICK = 3, TEXT_ROOM = 2048 };
#define BUDGET 600.0 /* allowed duration of a study, never reached in practice [s] */

struct known_row {
    const struct known_scene *scene;
    const char *variant, *spacing, *figure;
    double exact;
    struct convergence c;
};

struct known_rows {
    int n;
    struct known_row at[ROWS_MOST];
};

static const double share[] = {0.50, 0.6827, 0.80, 0.90, 0.95, 0.99};
enum { SHARES = COUNT_OF(share) };

/* ---- one study --------------------------------------------------------------------------------------------------- */

/* Writes the scene k with additional keys and the given spacing to the file `path`. variant: the keys as lines, and
 * optionally @ and the horizon [spacings]; spacing: number with unit. Returns FAILED if the file cannot be written. */
static status scene_text_write(const char *path, const struct known_scene *k, const char *variant, const char *spacing)
{
    char text[TEXT_ROOM];
    const char *at = strchr(variant, '@');
    const int lines = at ? (int)(at - variant) : (int)strlen(variant);
    const int length =
        snprintf(text, sizeof text, "%s%.*sparticles: {spacing: %s%s%s}\noutput: {frames: 0, samples: 20}\n", k->text,
                 lines, variant, spacing, at ? ", horizon: " : "", at ? at + 1 : "");
    INVARIANT(length < TEXT_ROOM);
    remove(path); /* written for the previous study, and no longer needed */
    return file_write_whole(path, text, (size_t)length);
}

static status study_of(struct known_rows *rows, const struct known_scene *k, const char *const *variant,
                       const char *spacing, const char *folder, bool quick)
{
    struct convergence_study s;
    const struct path scene = path_join(folder, "scene.yaml.in"), into = path_join(folder, "study");
    const struct convergence_request wish = {.scene = scene.text,
                                             .folder = into.text,
                                             .levels = LEVELS_LEAST,
                                             .runs = quick ? RUNS_QUICK : RUNS,
                                             .budget = BUDGET,
                                             .options.quiet = true};
    TRY(scene_text_write(scene.text, k, variant[1], spacing));
    TRY(convergence_study_run(&s, &wish));
    for (int f = 0; f < KNOWN_FIGURES_MOST && k->figure[f].name; f++) {
        struct scalar_result_study *figure = NULL;
        int n = 0;
        if (scalar_results_determine_convergence(&s, &k->figure[f].name, 1, &figure, &n) == OK && rows->n < ROWS_MOST)
            rows->at[rows->n++] =
                (struct known_row){k, variant[0], spacing, k->figure[f].name, k->figure[f].exact, figure[0].c};
        else
            printf("  %s, %s: %s\n", k->name, variant[0], status_message());
        memory_free(figure);
    }
    convergence_study_free(&s);
    bench_folder_remove(into.text);
    return OK;
}

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Returns the absolute difference between the mean of result r at the finest spacing and its exact value. */
static double true_error(const struct known_row *r) { return fabs(r->c.level[0].mean - r->exact); }

/* Returns the share of the values in rows [1] whose error interval contains the exact value. nominal: probability with
 * which it should. */
static double covered(const struct known_rows *rows, double nominal)
{
    int held = 0;
    for (int k = 0; k < rows->n; k++) {
        const struct known_row *r = &rows->at[k];
        held += true_error(r) <= convergence_confidence_interval_half_width(&r->c, r->c.level[0].mean, nominal);
    }
    return (double)held / rows->n;
}

/* Returns the median over all results in rows of half the width of their 95 % interval over their true error [1]. */
static double width_median(const struct known_rows *rows)
{
    double ratio[ROWS_MOST];
    for (int k = 0; k < rows->n; k++) ratio[k] = rows->at[k].c.uncertainty[0] / true_error(&rows->at[k]);
    return median_by_sorting(ratio, rows->n);
}

static void row_print(const struct known_row *r)
{
    const double size = r->exact != 0 ? fabs(r->exact) : fabs(r->c.level[0].mean), error = true_error(r);
    printf("  %-18s %-20s %-8s %-28s %7.3f %% %7.3f %% %6.2f  %-16s %s\n", r->scene->name, r->variant, r->spacing,
           r->figure, 100 * error / size, 100 * r->c.uncertainty[0] / size, r->c.uncertainty[0] / error,
           verdict_name[r->c.verdict], error <= r->c.uncertainty[0] ? "" : "missed");
    fflush(stdout);
}

static status rows_write(const struct known_rows *rows)
{
    struct bench_table t[2];
    bench_table_make(
        &t[0], "",
        "scene,variant,spacing,figure,exact,value,uncertainty,scatter,discretisation,order,spacing_1,mean_1,error_1,"
        "spacing_2,mean_2,error_2,spacing_0,verdict");
    bench_table_make(&t[1], "covered", "nominal,covered");
    for (int k = 0; k < rows->n; k++) {
        const struct known_row *r = &rows->at[k];
        const double number[] = {r->exact,
                                 r->c.level[0].mean,
                                 r->c.uncertainty[0],
                                 r->c.level[0].error,
                                 r->c.discretisation[0],
                                 r->c.order,
                                 r->c.level[1].spacing,
                                 r->c.level[1].mean,
                                 r->c.level[1].error,
                                 r->c.level[2].spacing,
                                 r->c.level[2].mean,
                                 r->c.level[2].error,
                                 r->c.level[0].spacing};
        bench_table_append_text(&t[0], r->scene->name), bench_table_append_text(&t[0], r->variant);
        bench_table_append_text(&t[0], r->spacing), bench_table_append_text(&t[0], r->figure);
        for (size_t c = 0; c < COUNT_OF(number); c++) bench_table_append_number(&t[0], number[c]);
        bench_table_append_text(&t[0], verdict_name[r->c.verdict]);
    }
    for (int k = 0; k < SHARES; k++)
        bench_table_append_number(&t[1], share[k]), bench_table_append_number(&t[1], covered(rows, share[k]));
    const status s = bench_write_result_tables("uncertainty", t, 2);
    bench_table_free(&t[0]), bench_table_free(&t[1]);
    return s;
}

/* Sends the gnuplot commands of two panels: the observed over the nominal probability of intervals, and the half width
 * of the 95 % interval over the true error, both relative to the result. context: a struct known_rows. */
static void uncertainty_draw(FILE *to, const void *context)
{
    const struct known_rows *rows = context;
    fputs("$c << EOD\n", to);
    for (int k = 0; k < SHARES; k++) fprintf(to, "%g %g\n", 100 * share[k], 100 * covered(rows, share[k]));
    fputs("EOD\n$w << EOD\n", to);
    for (int k = 0; k < rows->n; k++) {
        const struct known_row *r = &rows->at[k];
        const double size = r->exact != 0 ? fabs(r->exact) : fabs(r->c.level[0].mean);
        fprintf(to, "%.6g %.6g\n", 100 * true_error(r) / size, 100 * r->c.uncertainty[0] / size);
    }
    fprintf(to,
            "EOD\nset multiplot layout 1,2 margins 0.08,0.97,0.13,0.9 spacing 0.1\nset key inside top left\n"
            "set xlabel 'nominal share of the interval [%%]'\nset ylabel 'held the answer [%%]'\n"
            "set xrange [45:100]\nset yrange [45:100]\nset title '%d figures with known answers'\n"
            "plot x with lines lw 1 dt (6,4) lc rgb '#888888' title 'as named', "
            "$c using 1:2 with linespoints lw 2.2 pt 7 ps 1 lc rgb '%s' title 'cleave converge'\n"
            "set xlabel 'true error [%%]'\nset ylabel 'half-width of the 95 %% interval [%%]'\nset logscale xy\n"
            "set xrange [*:*]\nset yrange [*:*]\nset title 'points above the dashed line held the answer'\n"
            "plot x with lines lw 1 dt (6,4) lc rgb '#888888' title 'as wide as the error', "
            "3*x with lines lw 1 dt (2,3) lc rgb '#888888' title '3 times as wide', "
            "$w using 1:2 with points pt 7 ps 0.8 lc rgb '%s' notitle\nunset multiplot\n",
            rows->n, curve_colour[0], curve_colour[0]);
}

/* ---- whole bench ------------------------------------------------------------------------------------------------- */

/* Makes the convergence studies of the scene k with all variants and spacings in `folder`, prints their results with
 * errors and intervals, and adds them to *rows. quick: one spacing only. Returns FAILED or REFUSED if a study does. */
static status known_scene_measure(struct known_rows *rows, const struct known_scene *k, const char *folder, bool quick)
{
    for (int v = 0; v < KNOWN_VARIANTS_MOST && k->variant[v][0]; v++)
        for (int h = 0; h < (quick ? 1 : KNOWN_SPACINGS_MOST) && k->spacing[h]; h++) {
            const int before = rows->n;
            TRY(study_of(rows, k, k->variant[v], k->spacing[h], folder, quick));
            for (int r = before; r < rows->n; r++) row_print(&rows->at[r]);
        }
    return OK;
}

status bench_uncertainty(bool quick)
{
    struct known_rows *rows = NEW("bench.known", 1, struct known_rows);
    char folder[] = BENCH_FOLDER "/study-XXXXXX";
    status s = bench_create_results_folder();
    printf("uncertainty\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(0));
    if (s == OK && !mkdtemp(folder)) s = file_report_write_failure(folder, errno);
    printf("  %-18s %-20s %-8s %-28s %9s %9s %6s  %s\n", "scene", "method", "spacing", "figure", "error", "+-",
           "+-/err", "verdict");
    for (int k = 0; k < known_scenes_n && s == OK; k++)
        if (!quick || known_scenes[k].quick) s = known_scene_measure(rows, &known_scenes[k], folder, quick);
    bench_folder_remove(folder);
    if (s == OK && rows->n == 0) s = status_set(FAILED, "bench uncertainty: no study has ended");
    if (s == OK) {
        printf("  %d figures: the 95 %% interval held the answer in %.0f %% (asked 90); its median half-width is %.2f "
               "true errors (asked at most 3)\n",
               rows->n, 100 * covered(rows, 0.95), width_median(rows));
        s = rows_write(rows);
    }
    if (s == OK) s = bench_draw("uncertainty", 1100, 520, uncertainty_draw, rows);
    memory_free(rows);
    return s;
}
