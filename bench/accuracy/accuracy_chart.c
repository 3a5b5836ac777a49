/* The picture accuracy.png: error against time on all problems, with the fronts of peridynamics, material points and
 * both together. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "accuracy.h"
#include "base/memory.h"
#include "plot/gnuplot.h"

/* Classes of methods, with colours that are distinguishable with any colour vision (Okabe & Ito 2008). */
enum { CLASS_PD, CLASS_MPM, CLASS_BOTH, CLASSES };
static const struct {
    unsigned families;
    const char *name, *colour, *symbol;
} class_of[CLASSES] = {
    {ACCURACY_PD, "pd: bonds alone", "#0072b2", "7"},
    {ACCURACY_MPM, "mpm: material points alone", "#d55e00", "5"},
    {ACCURACY_COUPLED | ACCURACY_ADAPTIVE, "adaptive: both, coupled or converting", "#009e73", "9"},
};

/* COLUMNS: charts in a row; CHARTS_MAX: largest number of charts; WIDTH, HEIGHT: size of a chart, HEADING, FOOT:
 * heights of the heading of the page and of the space below the charts [pixel]. */
enum { COLUMNS = 3, CHARTS_MAX = 16, WIDTH = 480, HEIGHT = 380, HEADING = 88, FOOT = 16 };
/* Margins of a chart [pixel]. */
enum { LEFT = 92, RIGHT = 14, ABOVE = 40, BELOW = 58 };
static const double asked[] = {0.05, 0.01}; /* errors at which methods are compared */

/* Runs of one problem for its chart, and those of each class of methods. */
struct chart {
    const struct accuracy_problem *problem;
    int n, of_class[CLASSES];
    struct accuracy_dot *dot, *own[CLASSES];
    double least, most, soonest, latest; /* ends of the axes: errors, times [s] */
};

struct charts {
    int n, rows;
    struct chart chart[CHARTS_MAX];
};

static void chart_make(struct chart *c, const struct accuracy_plan *plan, const struct accuracy_problem *problem)
{
    const struct accuracy_entry **of = NEW("bench.of", plan->n, const struct accuracy_entry *);
    *c = (struct chart){.problem = problem, .least = INFINITY, .soonest = INFINITY};
    c->dot = NEW("bench.dot", plan->n, struct accuracy_dot);
    c->n = accuracy_collect_times_and_errors(plan, problem, -1, -1, c->dot, of);
    for (int g = 0; g < CLASSES; g++) {
        c->own[g] = NEW("bench.dot", plan->n, struct accuracy_dot);
        for (int k = 0; k < c->n; k++)
            if (of[k]->point.method->family & class_of[g].families) c->own[g][c->of_class[g]++] = c->dot[k];
    }
    for (int k = 0; k < c->n; k++) {
        if (!isfinite(c->dot[k].error)) continue;
        c->least = fmin(c->least, c->dot[k].error / 1.6), c->most = fmax(c->most, fmin(c->dot[k].error, 1) * 1.3);
        c->soonest = fmin(c->soonest, c->dot[k].time / 1.6), c->latest = fmax(c->latest, c->dot[k].time * 1.6);
    }
    memory_free(of);
}

/* Returns the height of the picture of all charts p [pixel]. */
static int charts_height(const struct charts *p) { return p->rows * HEIGHT + HEADING + FOOT; }

static void charts_free(struct charts *p)
{
    for (int k = 0; k < p->n; k++) {
        memory_free(p->chart[k].dot);
        for (int g = 0; g < CLASSES; g++) memory_free(p->chart[k].own[g]);
    }
}

/* Returns the class of methods that reaches the error `error` [1] in the least time on the problem of chart c; -1 if no
 * class does. */
static int winner_of(const struct chart *c, double error)
{
    int best = -1;
    double least = INFINITY;
    for (int g = 0; g < CLASSES; g++) {
        const int k = accuracy_index_of_fastest_point(c->own[g], c->of_class[g], error);
        if (k >= 0 && c->own[g][k].time < least) least = c->own[g][k].time, best = g;
    }
    return best;
}

/* Sends the runs of chart c, number `number`, to gnuplot as data blocks: $all<number> with all runs, then
 * $f<number>_<class> with the Pareto front of each class of methods. Each block ends with a point without position,
 * since gnuplot refuses empty blocks. */
static void chart_send(FILE *to, const struct chart *c, int number)
{
    int *front = NEW("bench.front", c->n + 1, int);
    fprintf(to, "$all%d << EOD\n", number);
    for (int k = 0; k < c->n; k++)
        if (isfinite(c->dot[k].error)) fprintf(to, "%.4g %.4g\n", c->dot[k].time, 100 * fmin(c->dot[k].error, 1));
    fputs("NaN NaN\nEOD\n", to);
    for (int g = 0; g < CLASSES; g++) {
        const int fronts = accuracy_find_pareto_front(c->own[g], c->of_class[g], front);
        fprintf(to, "$f%d_%d << EOD\n", number, g);
        for (int k = 0; k < fronts; k++)
            fprintf(to, "%.4g %.4g\n", c->own[g][front[k]].time, 100 * c->own[g][front[k]].error);
        fputs("NaN NaN\nEOD\n", to);
    }
    memory_free(front);
}

/* Writes one line of the heading, `text`, as label number `number` of gnuplot. above: its distance from the upper edge
 * [pixel]; height: of the picture [pixel]; font: name and size in the form "NAME,SIZE". */
static void heading_line_write(FILE *to, int number, const char *text, double above, int height, const char *font)
{
    fprintf(to, "set label %d ", number);
    gnuplot_write_quoted_string(to, text);
    fprintf(to, " at screen 0.5,%.5g center font '%s' textcolor rgb '#111111'\n", 1 - above / height, font);
}

/* Writes the heading of the picture with the charts p to gnuplot: the question, and as answer on how many problems each
 * class of methods is the cheapest for 5 % and 1 % error. */
static void heading_write(FILE *to, const struct charts *p)
{
    char text[256] = "";
    int length = 0;
    for (size_t e = 0; e < COUNT_OF(asked); e++) {
        int wins[CLASSES + 1] = {0}; /* the last: no class reaches the error */
        for (int k = 0; k < p->n; k++) {
            const int g = winner_of(&p->chart[k], asked[e]);
            wins[g < 0 ? CLASSES : g]++;
        }
        length += snprintf(text + length, sizeof text - (size_t)length,
                           "%s %g %% error: pd on %d of %d problems, mpm %d, adaptive %d", e ? "; at" : "At",
                           100 * asked[e], wins[CLASS_PD], p->n, wins[CLASS_MPM], wins[CLASS_BOTH]);
        if (wins[CLASSES] > 0)
            length += snprintf(text + length, sizeof text - (size_t)length, ", none %d", wins[CLASSES]);
    }
    heading_line_write(to, 1, "Which is cheapest: peridynamics, material points, or both together?", 28,
                       charts_height(p), "Liberation Sans:Bold,18");
    heading_line_write(to, 2, text, 60, charts_height(p), ",15");
}

static void chart_plot(FILE *to, const struct charts *p, int number)
{
    const struct chart *c = &p->chart[number];
    const double width = COLUMNS * WIDTH, height = charts_height(p);
    const double x = number % COLUMNS * WIDTH, y = HEADING + number / COLUMNS * HEIGHT;
    fprintf(to,
            "set lmargin at screen %.6g\nset rmargin at screen %.6g\nset tmargin at screen %.6g\nset bmargin at screen "
            "%.6g\nset xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\nset xlabel '%s'\nset label 3 '%s' at screen "
            "%.6g,%.6g center rotate\nset title ",
            (x + LEFT) / width, (x + WIDTH - RIGHT) / width, 1 - (y + ABOVE) / height,
            1 - (y + HEIGHT - BELOW) / height, c->soonest, c->latest, 100 * c->least, 100 * c->most,
            number + COLUMNS < p->n ? "" : "loop time on one thread", number % COLUMNS ? "" : "error [%]",
            (x + 16) / width, 1 - (y + 0.5 * (HEIGHT + ABOVE - BELOW)) / height);
    gnuplot_write_quoted_string(to, c->problem->title);
    fputs(" font 'Liberation Sans:Bold,14'\nplot ", to);
    for (size_t e = 0; e < COUNT_OF(asked); e++)
        fprintf(to, "%g with lines lw 1.2 dt (6,5) lc rgb '#999999' notitle, ", 100 * asked[e]);
    fprintf(to, "$all%d using 1:2 with points pt 7 ps 0.35 lc rgb '#cccccc' notitle", number);
    for (int g = 0; g < CLASSES; g++)
        fprintf(to, ", $f%d_%d using 1:2 with linespoints lw 2 pt %s ps 0.9 lc rgb '%s' notitle", number, g,
                class_of[g].symbol, class_of[g].colour);
    fputs("\nunset label 1\nunset label 2\nunset label 3\n", to);
}

/* Plots the legend in the first empty position among the charts p, as a panel without axes. */
static void legend_plot(FILE *to, const struct charts *p)
{
    const double width = COLUMNS * WIDTH, height = charts_height(p);
    const double x = p->n % COLUMNS * WIDTH + 40, y = HEADING + p->n / COLUMNS * HEIGHT + ABOVE;
    fprintf(
        to,
        "unset logscale\nunset border\nunset tics\nunset title\nunset xlabel\nunset ylabel\nunset grid\n"
        "set lmargin at screen %.6g\nset rmargin at screen 0.995\nset tmargin at screen %.6g\nset bmargin at screen "
        "0.01\nset key at screen %.6g,%.6g left top vertical maxrows 9 Left reverse samplen 3 spacing 1.5 font "
        "',14'\nset xrange [0:1]\nset yrange [0:1]\nplot ",
        x / width, 1 - y / height, x / width, 1 - y / height);
    for (int g = 0; g < CLASSES; g++)
        fprintf(to, "NaN with linespoints lw 2 pt %s ps 1.2 lc rgb '%s' title '%s', ", class_of[g].symbol,
                class_of[g].colour, class_of[g].name);
    fputs("NaN with points pt 7 ps 0.6 lc rgb '#bbbbbb' title 'every run; lines join those that no other run of', "
          "NaN with points pt 7 ps 0 lc rgb '#ffffff' title 'the same kind beats in both time and error', "
          "NaN with lines lw 1.2 dt (6,5) lc rgb '#999999' title '5 % and 1 % error'\n",
          to);
}

static void charts_draw(FILE *to, const void *context)
{
    const struct charts *p = context;
    for (int k = 0; k < p->n; k++) chart_send(to, &p->chart[k], k);
    fputs("set multiplot\nset logscale xy\nset format x '%.0s %cs'\nset format y '%g'\nunset key\n"
          "set ytics (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)\n",
          to);
    heading_write(to, p);
    for (int k = 0; k < p->n; k++) chart_plot(to, p, k);
    legend_plot(to, p);
    fputs("unset multiplot\n", to);
}

status accuracy_draw_overview_chart(const struct accuracy_plan *plan)
{
    struct charts p = {0};
    for (int k = 0; k < accuracy_problems; k++) {
        INVARIANT(p.n < CHARTS_MAX);
        chart_make(&p.chart[p.n], plan, accuracy_problem[k]);
        p.n++;
        if (p.chart[p.n - 1].n > 0) continue;
        struct charts empty = {.n = 1, .chart = {p.chart[--p.n]}};
        charts_free(&empty);
    }
    p.rows = p.n / COLUMNS + 1;
    const status s = p.n > 0 ? bench_draw("accuracy", COLUMNS * WIDTH, charts_height(&p), charts_draw, &p) : OK;
    charts_free(&p);
    return s;
}
