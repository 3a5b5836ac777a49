/* Picture of the long map: growth rate of the energy per step for every case, and the named scenes. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "energy_drift.h"

/* Columns of the table that are drawn. */
enum { GROUP = 0, LABEL = 1, STOPPED = 5, END = 6, LARGEST = 7, RATE = 10, VERDICT = 13, COLUMNS = 15 };
#define LEAST_RATE 1e-12                 /* smaller rates, from round-off and the fit, are drawn as zero */
#define MOST_RATE 10.0                   /* larger rates are drawn as this one */
enum { WIDTH = 1900, LINE_HEIGHT = 22 }; /* of the picture, and of a line in it [pixel] */

static const struct bench_cell *energy_drift_draw_cell_of(const struct bench_table *t, int64_t row, int k)
{
    return &t->cell[row * COLUMNS + k];
}
static const char *energy_drift_draw_text_of(const struct bench_table *t, int64_t row, int k)
{
    return energy_drift_draw_cell_of(t, row, k)->text;
}
static double energy_drift_draw_number_of(const struct bench_table *t, int64_t row, int k)
{
    return energy_drift_draw_cell_of(t, row, k)->number;
}
static int64_t energy_drift_draw_rows_of(const struct bench_table *t) { return t->cells / COLUMNS; }
static bool energy_drift_draw_is(const struct bench_table *t, int64_t row, const char *verdict)
{
    return !strcmp(energy_drift_draw_text_of(t, row, VERDICT), verdict);
}
static bool of_group(const struct bench_table *t, int64_t row, int g)
{
    return !strcmp(energy_drift_draw_text_of(t, row, GROUP), drift_group_name[g]);
}

/* Returns a growth rate per step on a logarithmic scale: log10(|rate|/LEAST_RATE) with the sign of the rate, where
 * |rate| is limited to LEAST_RATE .. MOST_RATE. Rates that are not finite are drawn as MOST_RATE. */
static double decades(double rate)
{
    if (!isfinite(rate)) return log10(MOST_RATE / LEAST_RATE);
    return copysign(log10(fmin(MOST_RATE, fmax(fabs(rate), LEAST_RATE)) / LEAST_RATE), rate);
}

/* Sends the growth rates of the cases of group g in table t to gnuplot as data blocks, one each for cases that hold,
 * fail and have stopped. at: position of the first case on the axis. Returns the position of the next group. */
static int put_group(FILE *to, const struct bench_table *t, int g, int at)
{
    static const char *const verdict[] = {"holds", "fails", "stopped"};
    for (int v = 0; v < 3; v++) {
        int x = at;
        fprintf(to, "$g%dv%d << EOD\nNaN NaN\n", g, v);
        for (int64_t r = 0; r < energy_drift_draw_rows_of(t); r++) {
            if (!of_group(t, r, g) || energy_drift_draw_is(t, r, "refused")) continue;
            x++;
            if (energy_drift_draw_is(t, r, verdict[v]))
                fprintf(to, "%d %.5g\n", x, decades(energy_drift_draw_number_of(t, r, RATE)));
        }
        fputs("EOD\n", to);
    }
    for (int64_t r = 0; r < energy_drift_draw_rows_of(t); r++)
        at += of_group(t, r, g) && !energy_drift_draw_is(t, r, "refused");
    return at + 3;
}

static void put_scale(FILE *to)
{
    fputs("set ytics (\"0\" 0", to);
    for (int k = 2; k <= 12; k += 2) fprintf(to, ", \"1e%d\" %d, \"-1e%d\" %d", k - 12, k, k - 12, -k);
    fprintf(to, ")\nset yrange [%g:%g]\n", -log10(MOST_RATE / LEAST_RATE), log10(MOST_RATE / LEAST_RATE) + 0.4);
}

static void put_cases(FILE *to, int last)
{
    const double most = decades(LASTING_RATE);
    fprintf(to,
            "set lmargin at screen 0.05\nset rmargin at screen 0.48\nset tmargin at screen 0.94\nset bmargin at screen "
            "0.27\n"
            "set title 'growth of energy per step at the automatic step'\nset key at screen 0.05,0.19 left top "
            "vertical maxrows 5\n"
            "set xrange [-2:%d]\nunset xtics\nset xlabel 'cases'\nset ylabel 'rate [1/step]'\nset grid y\n"
            "set object 1 rectangle from -2,%g to %d,%g fc rgb '#e8f3ea' fs solid noborder behind\n"
            "set object 2 rectangle from -2,%g to %d,%g fc rgb '#f9e4dc' fs solid noborder behind\nplot ",
            last, -most, last, most, most, last, log10(MOST_RATE / LEAST_RATE) + 0.4);
    for (int g = 0; g < LASTING_GROUP; g++)
        fprintf(to,
                "$g%dv0 using 1:2 with points pt 7 ps 0.7 lc rgb '%s' title '%s', $g%dv1 using 1:2 with points pt 6 ps "
                "1.2 lw 1.6 "
                "lc rgb '%s' notitle, $g%dv2 using 1:2 with points pt 2 ps 1.1 lw 1.8 lc rgb '%s' notitle, ",
                g, curve_colour[g], drift_group_name[g], g, curve_colour[g], g, curve_colour[g]);
    fprintf(to,
            "NaN with points pt 7 ps 0.7 lc rgb '#333333' title 'holds', NaN with points pt 6 ps 1.2 lw 1.6 lc rgb "
            "'#333333' title "
            "'more than %g %% in the run', NaN with points pt 2 ps 1.1 lw 1.8 lc rgb '#333333' title 'stopped'\n",
            100 * LASTING_ENERGY);
}

static void energy_drift_draw_put_label(FILE *to, const char *text, double x, double y, const char *style)
{
    fputs("set label ", to);
    gnuplot_write_quoted_string(to, text);
    fprintf(to, " at screen %g,%g %s\n", x, y, style);
}

/* Draws a line of text for each named scene of table t with its largest change of energy, growth rate and verdict. */
static void put_named(FILE *to, const struct bench_table *t)
{
    double y = 0.94;
    energy_drift_draw_put_label(to, "scenes that grew once", 0.53, 0.975, "left");
    energy_drift_draw_put_label(to, "energy, largest change", 0.85, 0.975, "right");
    energy_drift_draw_put_label(to, "rate a step", 0.92, 0.975, "right");
    for (int64_t r = 0; r < energy_drift_draw_rows_of(t); r++) {
        char text[96];
        if (!of_group(t, r, LASTING_NAMED)) continue;
        const bool holds = energy_drift_draw_is(t, r, "holds");
        const char *style = holds ? "left textcolor rgb '#1b6b3a'" : "left textcolor rgb '#c0392b'";
        energy_drift_draw_put_label(to, energy_drift_draw_text_of(t, r, LABEL), 0.53, y, style);
        snprintf(text, sizeof text, "%.2g",
                 fabs(energy_drift_draw_number_of(t, r, LARGEST)) > 1e-12 ? energy_drift_draw_number_of(t, r, LARGEST)
                                                                          : energy_drift_draw_number_of(t, r, END));
        energy_drift_draw_put_label(to, text, 0.85, y, "right textcolor rgb '#333333'");
        snprintf(text, sizeof text, "%.1e", energy_drift_draw_number_of(t, r, RATE));
        energy_drift_draw_put_label(to, text, 0.92, y, "right textcolor rgb '#333333'");
        if (energy_drift_draw_is(t, r, "stopped"))
            snprintf(text, sizeof text, "stopped at step %.0f", energy_drift_draw_number_of(t, r, STOPPED));
        else
            snprintf(text, sizeof text, "%s", energy_drift_draw_text_of(t, r, VERDICT));
        energy_drift_draw_put_label(to, text, 0.93, y, style);
        y -= 0.95 / (drift_named_count + 1);
    }
}

static void energy_drift_draw_picture(FILE *to, const void *table)
{
    int at = 0;
    for (int g = 0; g < LASTING_GROUP; g++) at = put_group(to, table, g, at);
    put_scale(to);
    put_named(to, table);
    put_cases(to, at);
}

status drift_draw(const struct bench_table *table)
{
    return bench_draw("stability_lasting", WIDTH, (drift_named_count + 2) * LINE_HEIGHT, energy_drift_draw_picture,
                      table);
}
