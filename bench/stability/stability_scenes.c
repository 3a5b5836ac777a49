/* Second part of `cleave bench stability`: scenes in which methods fail, with measured quantities, thresholds and
 * remedies. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "limits.h"
#include "plot/gnuplot.h"
#include "stability.h"

/* ---- measuring --------------------------------------------------------------------------------------------------- */

/* Columns of the table, in the order of its header. */
enum { SCENE, METHOD, QUANTITY, THRESHOLD, MEASURED, VERDICT, REMEDY, COLUMNS };
static const char header[] = "scene,method,quantity,threshold,measured,verdict,remedy";

/* Measures all quantities of scene s with the method of row r, prints them, and adds a row with verdict and remedy for
 * each to the table t. Returns FAILED or REFUSED if the scene cannot be run. */
static status stability_scenes_take(struct bench_table *t, const struct limits_scene *s, const struct limits_row *r)
{
    double figure[FAILING_FIGURES];
    char label[128];
    TRY(limits_measure(s, r, figure));
    limits_label(s, r, label, sizeof label);
    printf("  %-48s", label);
    for (int k = 0; k < limits_quantity_count(s); k++) {
        const bool holds = figure[k] <= s->figure[k].threshold;
        bench_table_append_text(t, s->name);
        bench_table_append_text(t, label);
        bench_table_append_text(t, s->figure[k].quantity);
        bench_table_append_number(t, s->figure[k].threshold);
        bench_table_append_number(t, figure[k]);
        bench_table_append_text(t, holds ? "holds" : "fails");
        bench_table_append_text(t, holds ? "-" : r->remedy ? r->remedy : "none yet");
        printf(" %10.3g%s", figure[k], holds ? "  " : " !");
    }
    printf("%s%s\n", r->remedy ? "  remedy: " : "", r->remedy ? r->remedy : "");
    fflush(stdout);
    return OK;
}

status stability_measure_failing_scenes(struct bench_table *table)
{
    bench_table_make(table, "scenes", header);
    for (int k = 0; k < FAILING_SCENES; k++) {
        const struct limits_scene *s = limits_scene[k];
        printf("\n  %s:", s->name);
        for (int f = 0; f < limits_quantity_count(s); f++)
            printf("%s %s, at most %.3g", f ? ";" : "", s->figure[f].quantity, s->figure[f].threshold);
        putchar('\n');
        for (int r = 0; r < s->rows; r++) TRY(stability_scenes_take(table, s, &s->row[r]));
    }
    return OK;
}

/* ---- the picture ------------------------------------------------------------------------------------------------- */

#define LEAST 1e-4                       /* relative to the threshold; smaller values are drawn there */
#define MOST 1e4                         /* larger values are drawn there */
enum { LINE_HEIGHT = 19, WIDTH = 1900 }; /* of a line and of the picture [pixel] */

static const struct bench_cell *stability_scenes_cell_of(const struct bench_table *t, int64_t row, int k)
{
    return &t->cell[row * COLUMNS + k];
}
static const char *stability_scenes_text_of(const struct bench_table *t, int64_t row, int k)
{
    return stability_scenes_cell_of(t, row, k)->text;
}
static double stability_scenes_number_of(const struct bench_table *t, int64_t row, int k)
{
    return stability_scenes_cell_of(t, row, k)->number;
}
static int64_t stability_scenes_rows_of(const struct bench_table *t) { return t->cells / COLUMNS; }
static bool fails(const struct bench_table *t, int64_t row)
{
    return !strcmp(stability_scenes_text_of(t, row, VERDICT), "fails");
}

/* Returns true if a scene begins in row number `row` of table t: the previous row belongs to another scene, or there is
 * none. */
static bool begins(const struct bench_table *t, int64_t row)
{
    return row == 0 || strcmp(stability_scenes_text_of(t, row, SCENE), stability_scenes_text_of(t, row - 1, SCENE));
}

static double share(const struct bench_table *t, int64_t row)
{
    const double threshold = stability_scenes_number_of(t, row, THRESHOLD),
                 measured = stability_scenes_number_of(t, row, MEASURED);
    if (!(measured <= threshold)) return threshold > 0 ? fmin(MOST, measured / threshold) : MOST;
    return threshold > 0 ? fmax(LEAST, measured / threshold) : LEAST;
}

/* Returns the number of lines of text in the picture of the table t: one for each scene, and one for each quantity that
 * exceeds its threshold. */
static int lines_of(const struct bench_table *t)
{
    int n = 0;
    for (int64_t r = 0; r < stability_scenes_rows_of(t); r++) n += begins(t, r) + fails(t, r);
    return n;
}

static void stability_scenes_put_label(FILE *to, const char *text, double x, int line, const char *style)
{
    fputs("set label ", to);
    gnuplot_write_quoted_string(to, text);
    fprintf(to, " at screen %g, first %d %s\n", x, -line, style);
}

/* Writes the failure in row r of table t as line number `line` of the picture: method, quantity, measured value,
 * threshold and remedy. */
static void put_failure(FILE *to, const struct bench_table *t, int64_t r, int line)
{
    char text[256];
    snprintf(text, sizeof text, "%s: %s", stability_scenes_text_of(t, r, METHOD),
             stability_scenes_text_of(t, r, QUANTITY));
    stability_scenes_put_label(to, text, 0.335, line, "right textcolor rgb '#8a3b12'");
    snprintf(text, sizeof text, "%.3g, at most %.3g", stability_scenes_number_of(t, r, MEASURED),
             stability_scenes_number_of(t, r, THRESHOLD));
    stability_scenes_put_label(to, text, 0.60, line, "left textcolor rgb '#333333'");
    stability_scenes_put_label(to, stability_scenes_text_of(t, r, REMEDY), 0.745, line, "left textcolor rgb '#1b6b3a'");
}

/* Writes the name of the scene that begins in row r of table t, and how many of its quantities meet their thresholds,
 * as line number `line` of the picture. */
static void put_scene(FILE *to, const struct bench_table *t, int64_t r, int line)
{
    char text[128];
    int holding = 0, all = 0;
    for (int64_t k = r; k < stability_scenes_rows_of(t) && (k == r || !begins(t, k)); k++)
        all++, holding += !fails(t, k);
    stability_scenes_put_label(to, stability_scenes_text_of(t, r, SCENE), 0.012, line, "left textcolor rgb '#000000'");
    snprintf(text, sizeof text, "%d of %d figures hold", holding, all);
    stability_scenes_put_label(to, text, 0.60, line, "left textcolor rgb '#777777'");
}

static void put_points(FILE *to, const struct bench_table *t)
{
    for (int failing = 0; failing < 2; failing++) {
        int line = -1, scene = 0;
        fprintf(to, "$points%d << EOD\nNaN NaN\n", failing);
        for (int64_t r = 0; r < stability_scenes_rows_of(t); r++) {
            if (begins(t, r)) scene = ++line;
            if (fails(t, r)) line++;
            if (fails(t, r) == (failing == 1)) fprintf(to, "%.5g %d\n", share(t, r), failing ? -line : -scene);
        }
        fputs("EOD\n", to);
    }
}

static void stability_scenes_picture(FILE *to, const void *table)
{
    const struct bench_table *t = table;
    int line = -1;
    for (int64_t r = 0; r < stability_scenes_rows_of(t); r++) {
        if (begins(t, r)) put_scene(to, t, r, ++line);
        if (fails(t, r)) put_failure(to, t, r, ++line);
    }
    put_points(to, t);
    fprintf(
        to,
        "set title 'scenes in which methods fail: figures over their thresholds, and the remedies'\n"
        "set lmargin at screen 0.345\nset rmargin at screen 0.59\nset tmargin at screen %g\nset bmargin at screen %g\n"
        "set logscale x\nset xrange [%g:%g]\nset yrange [%g:0.8]\nunset ytics\nset format x '1e%%T'\n"
        "set xtics (\"0\" %g, \"0.001\" 0.001, \"0.01\" 0.01, "
        "\"0.1\" 0.1, \"1\" 1, \"10\" 10, \"100\" 100, \"1000\" 1000)\n"
        "set xlabel 'measured/threshold'\nunset key\nset grid x\n"
        "set object 1 rectangle from %g, graph 0 to 1, graph 1 fc rgb '#e8f3ea' fs solid noborder behind\n"
        "set object 2 rectangle from 1, graph 0 to %g, graph 1 fc rgb '#f9e4dc' fs solid noborder behind\n"
        "plot $points0 using 1:2 with points pt 7 ps 0.8 lc rgb '#1b6b3a', "
        "$points1 using 1:2 with points pt 7 ps 1 lc rgb '#c0392b'\n",
        1 - 2.0 / (line + 7), 4.0 / (line + 7), 0.7 * LEAST, 1.5 * MOST, -line - 0.8, LEAST, 0.7 * LEAST, 1.5 * MOST);
}

status stability_draw_failing_scenes(const struct bench_table *table)
{
    return bench_draw("stability_scenes", WIDTH, (lines_of(table) + 6) * LINE_HEIGHT, stability_scenes_picture, table);
}
