/* Pictures of the cost-accuracy table: a panel for each case of a problem, and one page with all problems.
 *
 * A point is a run: its time on one thread, a thin line to that on two. Lines join the resolutions of a method;
 * small marks are other horizons and steps; a cross at the upper edge is a run that was unstable. The broad grey
 * line is the front. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "accuracy.h"
#include "plot/gnuplot.h"
#include "base/memory.h"

/* ---- points ------------------------------------------------------------------------------------------------------ */

static bool is_usual(const struct accuracy_point *p)
{
    return p->step == ACCURACY_STEP && (p->horizon == 0 || p->horizon == ACCURACY_HORIZON);
}

void accuracy_label(const struct accuracy_point *p, char *text, size_t size)
{
    char more[48] = "", *end = more;
    if (p->horizon > 0 && p->horizon != ACCURACY_HORIZON) end += snprintf(more, 24, ", h %.4g", p->horizon);
    if (p->step != ACCURACY_STEP) snprintf(end, 24, ", dt %.3g", p->step);
    snprintf(text, size, "%s %d%s", p->method->name, p->resolution, more);
}

static bool same_but_case(const struct accuracy_point *a, const struct accuracy_point *b)
{
    return a->problem == b->problem && a->method == b->method && a->resolution == b->resolution &&
           a->horizon == b->horizon && a->step == b->step;
}

/* A part that is exactly 0 has no place on the axis of a logarithm: 1e-9. */
static struct accuracy_dot dot_of(const struct accuracy_result *r, int part)
{
    const double error = part < 0 ? r->error : fmax(fabs(r->part[part]), 1e-9);
    return (struct accuracy_dot){r->seconds[0], r->stable ? error : NAN};
}

/* The worst error and the longest time of all cases; false: one of them is not known yet, or not for this method. */
static bool worst_dot(const struct accuracy_plan *plan, const struct accuracy_point *p, int part,
                      struct accuracy_dot *worst)
{
    int cases = 0;
    *worst = (struct accuracy_dot){0};
    for (int k = 0; k < plan->n; k++) {
        const struct accuracy_entry *entry = &plan->entry[k];
        if (!same_but_case(p, &entry->point)) continue;
        if (!entry->result.known) return false;
        const struct accuracy_dot one = dot_of(&entry->result, part);
        cases++;
        worst->time = fmax(worst->time, one.time);
        worst->error = isfinite(one.error) && isfinite(worst->error) ? fmax(worst->error, one.error) : NAN;
    }
    return cases == accuracy_cases(p->problem);
}

int accuracy_dots(const struct accuracy_plan *plan, const struct accuracy_problem *problem, int at, int part,
                  struct accuracy_dot *dot, const struct accuracy_entry **of)
{
    int n = 0;
    for (int k = 0; k < plan->n; k++) {
        const struct accuracy_entry *entry = &plan->entry[k];
        if (entry->point.problem != problem || entry->point.at != (at < 0 ? 0 : at) || !entry->result.known) continue;
        dot[n] = dot_of(&entry->result, part);
        if (at >= 0 || worst_dot(plan, &entry->point, part, &dot[n])) of[n++] = entry;
    }
    return n;
}

/* ---- one panel --------------------------------------------------------------------------------------------------- */

struct panel {
    int n, front_n, *front, number;
    struct accuracy_dot *dot;
    const struct accuracy_entry **of;
    double least, most;          /* error: ends of the axis */
    double soonest, latest;      /* the same of time; on the left there is room for labels */
};

static void panel_range(struct panel *q)
{
    q->least = q->soonest = INFINITY, q->most = q->latest = 0;
    for (int k = 0; k < q->n; k++) {
        const struct accuracy_dot *d = &q->dot[k];
        if (isfinite(d->time)) q->soonest = fmin(q->soonest, d->time), q->latest = fmax(q->latest, d->time);
        if (isfinite(d->error)) q->least = fmin(q->least, d->error), q->most = fmax(q->most, d->error);
    }
    if (!isfinite(q->least)) q->least = 1e-3, q->most = 1;
    if (!isfinite(q->soonest)) q->soonest = 1e-3, q->latest = 1;
    q->least /= 1.5, q->most = fmin(q->most * 1.5, 5);
    q->latest *= 1.5, q->soonest *= pow(q->soonest / q->latest, 0.52);
}

static void panel_make(struct panel *q, const struct accuracy_plan *plan, const struct accuracy_problem *problem,
                       int at, int part)
{
    q->dot = NEW("bench.dot", plan->n, struct accuracy_dot), q->front = NEW("bench.front", plan->n, int);
    q->of = NEW("bench.of", plan->n, const struct accuracy_entry *);
    q->n = accuracy_dots(plan, problem, at, part, q->dot, q->of);
    q->front_n = accuracy_front(q->dot, q->n, q->front);
    panel_range(q);
}

static void panel_free(struct panel *q)
{
    memory_free(q->dot), memory_free(q->front), memory_free(q->of);
}

/* time, time on two threads, error in percent. */
static void put_dot(FILE *to, const struct panel *q, int k)
{
    const double error = isfinite(q->dot[k].error) ? fmin(q->dot[k].error, q->most) : q->most;
    fprintf(to, "%.6g %.6g %.6g\n", q->dot[k].time, q->of[k]->result.seconds[1], 100 * error);
}

/* Marks of a method: its resolutions, its variations, what was unstable. A block must hold something. */
enum { USUAL, VARIED, UNSTABLE, SETS };

static int set_of(const struct panel *q, int k)
{
    return !isfinite(q->dot[k].error) ? UNSTABLE : is_usual(&q->of[k]->point) ? USUAL : VARIED;
}

static void put_sets(FILE *to, const struct panel *q)
{
    for (int m = 0; m < accuracy_methods; m++)
        for (int set = 0; set < SETS; set++) {
            fprintf(to, "$p%d_%d_%d << EOD\n", q->number, m, set);
            for (int k = 0; k < q->n; k++)
                if (q->of[k]->point.method == &accuracy_method[m] && set_of(q, k) == set) put_dot(to, q, k);
            fputs("NaN NaN NaN\nEOD\n", to);
        }
}

/* Labels from the most accurate point upwards, as many as do not lie on each other. */
static void put_front(FILE *to, const struct panel *q)
{
    const double line = 0.042 * log(q->most / q->least);
    double below = 0;
    fprintf(to, "$p%d_front << EOD\n", q->number);
    for (int k = q->front_n - 1; k >= 0; k--) {
        const struct accuracy_dot *d = &q->dot[q->front[k]];
        const bool room = log(d->error) - below > line || k == q->front_n - 1;
        char label[96] = "";
        if (room) accuracy_label(&q->of[q->front[k]]->point, label, sizeof label), below = log(d->error);
        fprintf(to, "%.6g %.6g \"%s\"\n", d->time, 100 * d->error, label);
    }
    fputs("NaN NaN \"\"\nEOD\n", to);
}

static bool has_method(const struct panel *q, int m)
{
    for (int k = 0; k < q->n; k++)
        if (q->of[k]->point.method == &accuracy_method[m]) return true;
    return false;
}

static void accuracy_draw_panel(FILE *to, const struct panel *q)
{
    fprintf(to, "set xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n"
            "plot $p%d_front using 1:2 with lines lw 9 lc rgb '#dddddd' notitle", q->soonest, q->latest, 100 * q->least,
            100 * q->most, q->number);
    for (int m = 0; m < accuracy_methods; m++) {
        const struct accuracy_method *a = &accuracy_method[m];
        if (!has_method(q, m)) continue;
        fprintf(to,
                ", $p%d_%d_0 using 1:3:($2-$1):(0) with vectors nohead lw 0.6 lc rgb '#bbbbbb' notitle"
                ", $p%d_%d_0 using 1:3 with linespoints lw 1 pt %d ps 0.9 lc rgb '%s' notitle"
                ", $p%d_%d_1 using 1:3 with points pt %d ps 0.45 lc rgb '%s' notitle"
                ", $p%d_%d_2 using 1:3 with points pt 2 ps 1.2 lw 1.6 lc rgb '%s' notitle",
                q->number, m, q->number, m, a->mark, a->colour, q->number, m, a->mark, a->colour, q->number, m,
                a->colour);
    }
    fprintf(to,
            ", $p%d_front using 1:2:3 with labels right offset -0.6,-0.5 font ',8' textcolor rgb '#222222' notitle\n",
            q->number);
}

/* The key is a panel without axes. */
static void plot_key(FILE *to, const struct panel *panel, int panels, double left)
{
    fprintf(to,
            "unset logscale\nunset border\nunset tics\nset title ''\nset xlabel ''\nset ylabel ''\nset grid noxtics "
            "noytics\n"
            "set lmargin at screen %g\nset rmargin at screen 0.995\nset tmargin at screen 0.96\nset bmargin at screen "
            "0.04\n"
            "set key at screen %g,0.95 left top vertical maxrows 40 Left reverse samplen 1.6 spacing 1 font "
            "',9.5'\nset xrange [0:1]\n"
            "set yrange [0:1]\nplot ",
            left, left);
    for (int m = 0; m < accuracy_methods; m++) {
        bool there = false;
        for (int k = 0; k < panels; k++) there = there || has_method(&panel[k], m);
        if (!there) continue;
        fprintf(to, "NaN with linespoints lw 1 pt %d ps 1 lc rgb '%s' title '%s', ", accuracy_method[m].mark,
                accuracy_method[m].colour, accuracy_method[m].name);
    }
    fputs("NaN with lines lw 9 lc rgb '#dddddd' title 'front', NaN with points pt 7 ps 0.45 lc rgb '#777777' title "
          "'other horizon or step', NaN with points pt 2 ps 1.2 lw 1.6 lc rgb '#777777' title 'unstable', NaN with "
          "lines lw "
          "0.6 lc rgb '#999999' title 'to two threads'\n",
          to);
}

/* ---- a page of panels -------------------------------------------------------------------------------------------- */

enum { COLUMNS = 3, PANELS_MAX = 16, KEY_PIXELS = 290, PANEL_WIDTH = 540, PANEL_HEIGHT = 480 };

struct page {
    int panels, columns, rows;
    struct panel panel[PANELS_MAX];
    char title[PANELS_MAX][128];
};

static int page_width(const struct page *p) { return p->columns * PANEL_WIDTH + KEY_PIXELS; }
static int page_height(const struct page *p) { return p->rows * PANEL_HEIGHT; }

static void add_panel(struct page *p, const struct accuracy_plan *plan, const struct accuracy_problem *problem, int at,
                      int part)
{
    struct panel *q = &p->panel[p->panels];
    assert(p->panels < PANELS_MAX);
    q->number = p->panels;
    panel_make(q, plan, problem, at, part);
    if (q->n == 0) {
        panel_free(q);
        return;
    }
    const char *more = part >= 0 ? problem->part[part] : at >= 0 ? problem->cases[at] : "";
    snprintf(p->title[p->panels++], sizeof p->title[0], "%s%s%s%s", problem->title, *more ? ": " : "", more,
             part >= 0 ? ", worst of all" : "");
    p->columns = p->panels < COLUMNS ? p->panels : COLUMNS;
    p->rows = (p->panels + COLUMNS - 1) / COLUMNS;
}

static void page_free(struct page *p)
{
    for (int k = 0; k < p->panels; k++) panel_free(&p->panel[k]);
}

static void draw_page(FILE *to, const void *context)
{
    const struct page *p = context;
    const double width = (double)p->columns * PANEL_WIDTH / page_width(p) / p->columns, height = 1.0 / p->rows;
    for (int k = 0; k < p->panels; k++) put_sets(to, &p->panel[k]), put_front(to, &p->panel[k]);
    fputs("set multiplot\nset logscale xy\nset format x '%.0s %cs'\nunset key\n"
          "set ytics ('0.001 %%' 0.001, '0.002 %%' 0.002, '0.005 %%' 0.005, '0.01 %%' 0.01, '0.02 %%' 0.02, '0.05 %%' "
          "0.05, "
          "'0.1 %%' 0.1, '0.2 %%' 0.2, '0.5 %%' 0.5, '1 %%' 1, '2 %%' 2, '5 %%' 5, '10 %%' 10, '20 %%' 20, '50 %%' 50, "
          "'100 %%' 100, "
          "'200 %%' 200, '500 %%' 500)\nset xlabel 'loop time on one thread'\n",
          to);
    for (int k = 0; k < p->panels; k++) {
        const double left = k % p->columns * width, above = 1 - k / p->columns * height;
        fprintf(
            to,
            "set lmargin at screen %g\nset rmargin at screen %g\nset tmargin at screen %g\nset bmargin at screen %g\n",
            left + 0.19 * width, left + 0.97 * width, above - 0.1 * height, above - 0.86 * height);
        fputs("set title ", to);
        gnuplot_quote(to, p->title[k]);
        fprintf(to, "\nset ylabel '%s' offset 0.8,0\n", k % p->columns ? "" : "error");
        accuracy_draw_panel(to, &p->panel[k]);
    }
    plot_key(to, p->panel, p->panels, p->columns * width + 0.01);
    fputs("unset multiplot\n", to);
}

static status draw_and_free(struct page *p, const char *name)
{
    status s = p->panels ? bench_draw(name, page_width(p), page_height(p), draw_page, p) : OK;
    page_free(p);
    return s;
}

status accuracy_draw(const struct accuracy_plan *plan)
{
    for (int k = 0; k < accuracy_problems; k++) {
        struct page one = {0};
        char name[64];
        for (int at = 0; at < accuracy_cases(accuracy_problem[k]); at++)
            add_panel(&one, plan, accuracy_problem[k], at, -1);
        for (int part = 0; part < ACCURACY_PARTS && accuracy_problem[k]->draws_parts; part++)
            if (accuracy_problem[k]->part[part]) add_panel(&one, plan, accuracy_problem[k], -1, part);
        snprintf(name, sizeof name, "accuracy_%s", accuracy_problem[k]->name);
        TRY(draw_and_free(&one, name));
    }
    struct page all = {0};
    for (int k = 0; k < accuracy_problems; k++) add_panel(&all, plan, accuracy_problem[k], -1, -1);
    return draw_and_free(&all, "accuracy");
}
