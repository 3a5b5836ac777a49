/* Pictures of the cost-accuracy table: one per problem with a panel for each case.
 *
 * A dot is a run, at its time on one thread. Runs on the Pareto front (no other is better in both time and error) have
 * the colour of their family, and a label if there is space. All others are small and grey. A cross at the upper edge
 * is an unstable run. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "accuracy.h"
#include "plot/gnuplot.h"
#include "base/memory.h"

/* ---- points ------------------------------------------------------------------------------------------------------ */

/* Writes the label of `point`, a run of the cost-accuracy table, into text[capacity]: method and resolution, and
 * horizon and time step if they are not the usual ones. */
void accuracy_label(const struct accuracy_point *point, char *text, size_t capacity)
{
    char more[48] = "", *end = more;
    if (point->horizon > 0 && point->horizon != ACCURACY_HORIZON) end += snprintf(more, 24, ", h %.4g", point->horizon);
    if (point->step != ACCURACY_STEP) snprintf(end, 24, ", dt %.3g", point->step);
    snprintf(text, capacity, "%s %d%s", point->method->name, point->resolution, more);
}

static bool same_but_case(const struct accuracy_point *a, const struct accuracy_point *b)
{
    return a->problem == b->problem && a->method == b->method && a->resolution == b->resolution &&
           a->horizon == b->horizon && a->step == b->step;
}

/* Returns time and error of the result r for a picture: its time on one thread [s], and its error or, for part >= 0,
 * the magnitude of this part of the error [1]. An unstable run has the error NAN. A part that is exactly 0 becomes
 * 1e-9, for the logarithmic axis. */
static struct accuracy_dot dot_of(const struct accuracy_result *r, int part)
{
    const double error = part < 0 ? r->error : fmax(fabs(r->part[part]), 1e-9);
    return (struct accuracy_dot){r->seconds[0], r->stable ? error : NAN};
}

/* Computes *worst, the largest error and the longest time of the method of point p over all cases of its problem in the
 * plan. part: number of the part of the error, or -1 for the whole. Returns false if a case has not been run or does
 * not apply to the method. */
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
    return cases == accuracy_case_count(p->problem);
}

int accuracy_collect_times_and_errors(const struct accuracy_plan *plan, const struct accuracy_problem *problem,
                                      int case_index, int part_index, struct accuracy_dot *dot,
                                      const struct accuracy_entry **dot_entry)
{
    int n = 0;
    for (int k = 0; k < plan->n; k++) {
        const struct accuracy_entry *entry = &plan->entry[k];
        if (entry->point.problem != problem || entry->point.at != (case_index < 0 ? 0 : case_index) ||
            !entry->result.known)
            continue;
        dot[n] = dot_of(&entry->result, part_index);
        if (case_index >= 0 || worst_dot(plan, &entry->point, part_index, &dot[n])) dot_entry[n++] = entry;
    }
    return n;
}

/* ---- one panel --------------------------------------------------------------------------------------------------- */

/* Runs of one panel with their times and errors, its Pareto front, and the ends of its axes. */
struct panel {
    int n, front_n, *front, number;
    struct accuracy_dot *dot;
    const struct accuracy_entry **of;
    double least, most;     /* ends of the axis of errors */
    double soonest, latest; /* ends of the axis of times, with space for labels on the left */
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
    q->least /= 2, q->most = fmin(q->most * 1.5, 5);
    q->latest *= 1.5, q->soonest *= pow(q->soonest / q->latest, 0.8);
}

static void panel_make(struct panel *q, const struct accuracy_plan *plan, const struct accuracy_problem *problem,
                       int at, int part)
{
    q->dot = NEW("bench.dot", plan->n, struct accuracy_dot), q->front = NEW("bench.front", plan->n, int);
    q->of = NEW("bench.of", plan->n, const struct accuracy_entry *);
    q->n = accuracy_collect_times_and_errors(plan, problem, at, part, q->dot, q->of);
    q->front_n = accuracy_find_pareto_front(q->dot, q->n, q->front);
    panel_range(q);
}

static void panel_free(struct panel *q) { memory_free(q->dot), memory_free(q->front), memory_free(q->of); }

/* ---- families ---------------------------------------------------------------------------------------------------- */

/* Families of methods with the colours of their dots. The colours are dark enough for letters and distinguishable with
 * any colour vision (Okabe & Ito 2008; Tol 2021). */
enum { BOND, STATE, CURRENT_FRAME, REFERENCE_FRAME, COARSE, COUPLED_HERE, ADAPTIVE_MESH, ADAPTIVE_GRID, GROUPS };
static const struct {
    const char *name, *colour;
} group[GROUPS] = {
    [BOND] = {"bonds", "#0072b2"},
    [STATE] = {"state-based bonds", "#009e73"},
    [CURRENT_FRAME] = {"material points, current frame", "#d55e00"},
    [REFERENCE_FRAME] = {"material points, reference frame", "#111111"},
    [COARSE] = {"coarse cells, converting or not", "#aa3377"},
    [COUPLED_HERE] = {"coupled in a fixed region", "#997700"},
    [ADAPTIVE_MESH] = {"adaptive, reference frame", "#6a3d9a"},
    [ADAPTIVE_GRID] = {"adaptive, current frame", "#cc6677"},
};

static int group_of(const struct accuracy_point *p)
{
    const enum accuracy_family family = p->method->family;
    if (accuracy_method_has_coarse_cells(p->method)) return COARSE;
    if (family == ACCURACY_BONDS) return BOND;
    if (family == ACCURACY_STATES) return STATE;
    if (family == ACCURACY_COUPLED) return COUPLED_HERE;
    if (family == ACCURACY_ADAPTIVE) return accuracy_point_uses_reference_frame(p) ? ADAPTIVE_MESH : ADAPTIVE_GRID;
    return family == ACCURACY_REFERENCE ? REFERENCE_FRAME : CURRENT_FRAME;
}

/* Returns true if a run of family g of methods (an index of group[]) is on the Pareto front of panel q. */
static bool has_group(const struct panel *q, int g)
{
    for (int k = 0; k < q->front_n; k++)
        if (group_of(&q->of[q->front[k]]->point) == g) return true;
    return false;
}

/* ---- content of a panel ------------------------------------------------------------------------------------------ */

/* Sends two data blocks of panel q to gnuplot: the runs that are not on its Pareto front, and the unstable runs, drawn
 * at the upper edge. Each block ends with a point without position, since gnuplot refuses empty blocks. */
static void put_others(FILE *to, const struct panel *q)
{
    for (int unstable = 0; unstable < 2; unstable++) {
        fprintf(to, "$p%d_%s << EOD\n", q->number, unstable ? "unstable" : "others");
        for (int k = 0; k < q->n; k++) {
            if (isfinite(q->dot[k].error) == unstable) continue;
            fprintf(to, "%.4g %.4g\n", q->dot[k].time, 100 * (unstable ? q->most : fmin(q->dot[k].error, q->most)));
        }
        fputs("NaN NaN\nEOD\n", to);
    }
}

/* Sends the Pareto front of panel q to gnuplot as data blocks: first all its points for a line, then for each family of
 * methods its points with their labels. From the most accurate point on, a point gets its label if the label does not
 * overlap with the previous one; else an empty text. */
static void put_front(FILE *to, const struct panel *q)
{
    const double line = 0.052 * log(q->most / q->least);
    double below = -INFINITY;
    struct label {
        char text[96];
    } *label = NEW("bench.label", q->front_n, struct label);
    fprintf(to, "$p%d_front << EOD\n", q->number);
    for (int k = q->front_n - 1; k >= 0; k--) {
        const struct accuracy_dot *d = &q->dot[q->front[k]];
        fprintf(to, "%.4g %.4g\n", d->time, 100 * d->error);
        if (log(d->error) - below <= line) continue;
        accuracy_label(&q->of[q->front[k]]->point, label[k].text, sizeof label[k].text);
        below = log(d->error);
    }
    fputs("NaN NaN\nEOD\n", to);
    for (int g = 0; g < GROUPS; g++) {
        if (!has_group(q, g)) continue;
        fprintf(to, "$p%d_front%d << EOD\n", q->number, g);
        for (int k = 0; k < q->front_n; k++)
            if (group_of(&q->of[q->front[k]]->point) == g)
                fprintf(to, "%.4g %.4g \"%s\"\n", q->dot[q->front[k]].time, 100 * q->dot[q->front[k]].error,
                        label[k].text);
        fputs("EOD\n", to);
    }
    memory_free(label);
}

static void accuracy_draw_panel(FILE *to, const struct panel *q)
{
    fprintf(to,
            "set xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\n"
            "plot $p%d_others using 1:2 with points pt 7 ps 0.32 lc rgb '#c4c4c4' notitle"
            ", $p%d_unstable using 1:2 with points pt 2 ps 0.8 lw 1.2 lc rgb '#a0a0a0' notitle"
            ", $p%d_front using 1:2 with lines lw 1.4 lc rgb '#777777' notitle",
            q->soonest, q->latest, 100 * q->least, 100 * q->most, q->number, q->number, q->number);
    for (int g = 0; g < GROUPS; g++) {
        if (!has_group(q, g)) continue;
        fprintf(to,
                ", $p%d_front%d using 1:2 with points pt 7 ps 1 lc rgb '%s' notitle"
                ", $p%d_front%d using 1:2:3 with labels right offset -0.8,-0.35 font ',10.5' textcolor rgb '%s' "
                "notitle",
                q->number, g, group[g].colour, q->number, g, group[g].colour);
    }
    putc('\n', to);
}

/* Plots the key of a page of panels as a panel without axes. panel[panels]: panels whose families of methods are
 * listed; left, above: position of the upper left corner of the key, as shares of width and height of the picture
 * [1]. */
static void plot_key(FILE *to, const struct panel *panel, int panels, double left, double above)
{
    fprintf(to,
            "unset logscale\nunset border\nunset tics\nset title ''\nset xlabel ''\nset ylabel ''\nset grid noxtics "
            "noytics\n"
            "set lmargin at screen %g\nset rmargin at screen 0.995\nset tmargin at screen %g\nset bmargin at screen "
            "0.02\n"
            "set key at screen %g,%g left top vertical maxrows 40 Left reverse samplen 1.6 spacing 1.25 font "
            "',11.5'\nset xrange [0:1]\n"
            "set yrange [0:1]\nplot ",
            left, above, left, above);
    for (int g = 0; g < GROUPS; g++) {
        bool there = false;
        for (int k = 0; k < panels; k++) there = there || has_group(&panel[k], g);
        if (there) fprintf(to, "NaN with points pt 7 ps 1.2 lc rgb '%s' title '%s', ", group[g].colour, group[g].name);
    }
    fputs("NaN with lines lw 1.4 lc rgb '#777777' title 'front: none is better in both', NaN with points pt 7 ps "
          "0.5 lc rgb '#b4b4b4' title 'every other run', NaN with points pt 2 ps 1 lw 1.4 lc rgb '#a0a0a0' title "
          "'unstable'\n",
          to);
}

/* ---- a page of panels -------------------------------------------------------------------------------------------- */

/* COLUMNS: panels in a row; PANELS_MAX: largest number of panels; KEY_PIXELS: width of the key, PANEL_WIDTH,
 * PANEL_HEIGHT: size of a panel [pixel]. */
enum { COLUMNS = 2, PANELS_MAX = 16, KEY_PIXELS = 330, PANEL_WIDTH = 570, PANEL_HEIGHT = 380 };
enum { PANEL_LEFT = 108, PANEL_RIGHT = 14, PANEL_ABOVE = 40, PANEL_BELOW = 56 }; /* margins of a panel [pixel] */

/* A picture that consists of several panels in columns and rows, with their titles. */
struct page {
    int panels, columns, rows;
    struct panel panel[PANELS_MAX];
    char title[PANELS_MAX][128];
};

/* Returns true if the last row of panels of page p has an empty position for the key; else the key is to the right of
 * all panels. */
static bool key_inside(const struct page *p) { return p->panels % p->columns != 0; }
static int page_width(const struct page *p) { return p->columns * PANEL_WIDTH + (key_inside(p) ? 0 : KEY_PIXELS); }
static int page_height(const struct page *p) { return p->rows * PANEL_HEIGHT; }

static void add_panel(struct page *p, const struct accuracy_plan *plan, const struct accuracy_problem *problem, int at,
                      int part)
{
    struct panel *q = &p->panel[p->panels];
    INVARIANT(p->panels < PANELS_MAX);
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
    for (int k = 0; k < p->panels; k++) put_others(to, &p->panel[k]), put_front(to, &p->panel[k]);
    fputs("set multiplot\nset logscale xy\nset format x '%.0s %cs'\nunset key\n"
          "set ytics ('0.001 %%' 0.001, '0.002 %%' 0.002, '0.005 %%' 0.005, '0.01 %%' 0.01, '0.02 %%' 0.02, '0.05 %%' "
          "0.05, "
          "'0.1 %%' 0.1, '0.2 %%' 0.2, '0.5 %%' 0.5, '1 %%' 1, '2 %%' 2, '5 %%' 5, '10 %%' 10, '20 %%' 20, '50 %%' 50, "
          "'100 %%' 100, "
          "'200 %%' 200, '500 %%' 500)\n",
          to);
    for (int k = 0; k < p->panels; k++) {
        const double left = k % p->columns * width, above = 1 - k / p->columns * height;
        fprintf(
            to,
            "set lmargin at screen %g\nset rmargin at screen %g\nset tmargin at screen %g\nset bmargin at screen %g\n",
            left + width * PANEL_LEFT / PANEL_WIDTH, left + width * (1 - (double)PANEL_RIGHT / PANEL_WIDTH),
            above - height * PANEL_ABOVE / PANEL_HEIGHT, above - height * (1 - (double)PANEL_BELOW / PANEL_HEIGHT));
        fputs("set title ", to);
        gnuplot_write_quoted_string(to, p->title[k]);
        fprintf(to, "\nset ylabel '%s' offset 0.8,0\nset xlabel '%s' offset 0,0.4\n", k % p->columns ? "" : "error",
                k + p->columns < p->panels ? "" : "loop time on one thread");
        accuracy_draw_panel(to, &p->panel[k]);
    }
    if (key_inside(p))
        plot_key(to, p->panel, p->panels, (p->columns - 1) * width + 0.08, height - 0.02);
    else
        plot_key(to, p->panel, p->panels, p->columns * width + 0.01, 0.96);
    fputs("unset multiplot\n", to);
}

static status draw_and_free(struct page *p, const char *name)
{
    status s = p->panels ? bench_draw(name, page_width(p), page_height(p), draw_page, p) : OK;
    page_free(p);
    return s;
}

status accuracy_draw_all_pictures(const struct accuracy_plan *plan)
{
    for (int k = 0; k < accuracy_problems; k++) {
        struct page one = {0};
        char name[64];
        for (int at = 0; at < accuracy_case_count(accuracy_problem[k]); at++)
            add_panel(&one, plan, accuracy_problem[k], at, -1);
        for (int part = 0; part < ACCURACY_PARTS && accuracy_problem[k]->draws_parts; part++)
            if (accuracy_problem[k]->part[part]) add_panel(&one, plan, accuracy_problem[k], -1, part);
        snprintf(name, sizeof name, "accuracy_%s", accuracy_problem[k]->name);
        TRY(draw_and_free(&one, name));
    }
    return accuracy_draw_overview_chart(plan);
}
