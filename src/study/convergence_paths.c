/* Draws the crack paths of all runs of a convergence study. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/history.h"
#include "output/picture_file.h"
#include "convergence_units.h"
#include "study_axis.h"
#include "study_internal.h"

enum { TIPS_MOST = 16 }; /* largest number of crack tips followed in one run */
#define SMOOTH 2.0       /* half of the growth over which positions of a path are averaged [spacings] */
#define FLICKER 3.0      /* largest apparent motion of a tip that does not grow [spacings] */

struct path convergence_picture_path(const char *folder, const char *key)
{
    char name[PICTURE_NAME_ROOM];
    study_picture_compose_file_name(name, key);
    return path_join(path_join(folder, "pictures").text, name);
}

/* Path of the longest crack tip of a run, one entry for each of n samples at which it has grown. x, y: positions [m];
 * grown: growth [m]; crack: number of its crack; tip[k]: index of the tip that was the longest at sample k, 0 to
 * tips - 1. It is reconstructed because the history does not identify the branches of a crack. */
struct longest {
    int64_t n;
    double *x, *y, *grown, *crack;
    int *tip, tips;
};

/* Bounding box of the drawn crack paths along x and y [m]. */
struct extent {
    double low[2], high[2];
};

/* Returns the index of the crack tip to which position i of *l belongs, or a new index (l->tips) if it belongs to none
 * of the tips so far. The history contains only the position of the longest crack, which is not always the same branch.
 * Among the tips of the same crack that can have moved to this position, it is the one whose last position is nearest:
 * since position k, a tip can have moved by at most 2 (l->grown[i] - l->grown[k]) + FLICKER * spacing. At most
 * TIPS_MOST tips are distinguished. spacing: lattice spacing of the run [m]. */
static int tip_drawn(const struct longest *l, int64_t i, double spacing)
{
    bool seen[TIPS_MOST] = {false};
    double nearest = INFINITY;
    int best = l->tips;
    for (int64_t k = i - 1; k >= 0; k--) {
        if (seen[l->tip[k]] || l->crack[k] != l->crack[i]) continue;
        seen[l->tip[k]] = true;
        const double off = hypot(l->x[i] - l->x[k], l->y[i] - l->y[k]);
        if (off > 2 * (l->grown[i] - l->grown[k]) + FLICKER * spacing || off > nearest) continue;
        nearest = off;
        best = l->tip[k];
    }
    return best < TIPS_MOST ? best : TIPS_MOST - 1;
}

static void longest_find(struct longest *l, const struct history *h, double spacing)
{
    const int x = history_find_column(h, "tip_x"), y = history_find_column(h, "tip_y");
    const int length = history_find_column(h, "crack_length"), number = history_find_column(h, "crack_number");
    *l = (struct longest){.x = NEW("study.x", h->rows, double),
                          .y = NEW("study.y", h->rows, double),
                          .grown = NEW("study.grown", h->rows, double),
                          .crack = NEW("study.crack", h->rows, double),
                          .tip = NEW("study.tip", h->rows, int)};
    for (int64_t i = 0; i < h->rows; i++) {
        const double grown = history_value_at(h, i, length), last = l->n > 0 ? l->grown[l->n - 1] : 0;
        if (!(grown > last) || !isfinite(history_value_at(h, i, x)) || !isfinite(history_value_at(h, i, y))) continue;
        l->x[l->n] = history_value_at(h, i, x), l->y[l->n] = history_value_at(h, i, y), l->grown[l->n] = grown;
        l->crack[l->n] = number < 0 ? 0 : history_value_at(h, i, number);
        l->tip[l->n] = tip_drawn(l, l->n, spacing);
        if (l->tip[l->n] == l->tips) l->tips++;
        l->n++;
    }
}

static void longest_free(struct longest *l)
{
    memory_free(l->x);
    memory_free(l->y);
    memory_free(l->grown);
    memory_free(l->crack);
    memory_free(l->tip);
}

/* Smooths the drawn crack path: computes the mean of all positions of the crack tip to which position i of *l belongs
 * at which the crack was at most `reach` [m] shorter or longer, into at[2] [m]. Near the ends of the path the reach is
 * smaller, so that the ends do not move. */
static void path_mean(const struct longest *l, int64_t i, double reach, double *at)
{
    double first = INFINITY, last = -INFINITY, sum[2] = {0};
    int n = 0;
    for (int64_t k = 0; k < l->n; k++)
        if (l->tip[k] == l->tip[i]) first = fmin(first, l->grown[k]), last = fmax(last, l->grown[k]);
    reach = fmin(reach, fmin(l->grown[i] - first, last - l->grown[i]));
    for (int64_t k = 0; k < l->n; k++)
        if (l->tip[k] == l->tip[i] && fabs(l->grown[k] - l->grown[i]) <= reach)
            sum[0] += l->x[k], sum[1] += l->y[k], n++;
    for (int d = 0; d < 2; d++) at[d] = sum[d] / n;
}

/* Sends the paths of the longest crack tips of the run k of the study s to gnuplot's stream `to`, as the data block $wK
 * (K is the number k) [m], each path as a separate line, without the steps from one row of bonds to the next. Extends
 * the bounding box *e [m] by them. Returns false if the run has no path of two positions, or no readable history. */
static bool send_path(FILE *to, const struct convergence_study *s, int k, struct extent *e)
{
    struct history h;
    struct longest l;
    const struct path folder = study_case_folder(&s->study, &s->study.at[k]);
    if (!path_is_file(path_join(folder.text, "history.csv").text) || history_read(&h, folder.text) != OK) return false;
    longest_find(&l, &h, s->point[k].spacing);
    fprintf(to, "$w%d << EOD\n", k);
    bool sent = false;
    for (int tip = 0; tip < l.tips; tip++) {
        int64_t positions = 0;
        for (int64_t i = 0; i < l.n; i++) positions += l.tip[i] == tip;
        if (positions < 2) continue;
        if (sent) fputs("\n", to);
        sent = true;
        for (int64_t i = 0; i < l.n; i++) {
            if (l.tip[i] != tip) continue;
            double at[2];
            path_mean(&l, i, SMOOTH * s->point[k].spacing, at);
            fprintf(to, "%.7g %.7g\n", at[0], at[1]);
            for (int d = 0; d < 2; d++) e->low[d] = fmin(e->low[d], at[d]), e->high[d] = fmax(e->high[d], at[d]);
        }
    }
    fputs("EOD\n", to);
    longest_free(&l);
    history_free(&h);
    return sent;
}

/* Extends the bounding box *e of the crack paths on all sides by a margin, which is positive even if all paths are
 * straight lines along an axis. */
static void extent_widen(struct extent *e)
{
    const double longer = fmax(e->high[0] - e->low[0], e->high[1] - e->low[1]);
    for (int d = 0; d < 2; d++) {
        const double centre = 0.5 * (e->low[d] + e->high[d]);
        const double half = fmax(0.55 * (e->high[d] - e->low[d]), 0.1 * longer);
        e->low[d] = centre - half, e->high[d] = centre + half;
    }
}

/* Width and greatest height of a picture of crack paths, and the margins of its panel [pixel]. *_NARROW: of a narrow
 * picture, which has the key (legend) below the panel; PATHS_ENTRY: width of an entry of the key; PATHS_KEY_ROW: height
 * of a line of the key. */
enum { PATHS_WIDE = 900, PATHS_LEFT = 90, PATHS_RIGHT = 160, PATHS_ABOVE = 50, PATHS_BELOW = 70, PATHS_HIGH = 900 };
enum { PATHS_LEFT_NARROW = 74, PATHS_RIGHT_NARROW = 18, PATHS_ABOVE_NARROW = 40, PATHS_BELOW_NARROW = 60 };
enum { PATHS_KEY_ROW = 20, PATHS_ENTRY = 118 };

/* Margins of the panel of a picture of crack paths [pixel], and numbers of columns and lines of its key (legend). */
struct paths_layout {
    double left, right, above, below;
    int key_columns, key_lines;
};

/* Returns the layout of a picture of crack paths. levels: number of spacings, each with an entry of the key
 * (legend). */
static struct paths_layout paths_layout_make(int levels)
{
    if (!picture_size_is_too_narrow_for_side_legend())
        return (struct paths_layout){PATHS_LEFT, PATHS_RIGHT, PATHS_ABOVE, PATHS_BELOW, 1, levels};
    struct paths_layout l = {PATHS_LEFT_NARROW, PATHS_RIGHT_NARROW, PATHS_ABOVE_NARROW, PATHS_BELOW_NARROW, 1, 1};
    l.key_columns = (int)fmax((picture_size_get_process_wide().width - l.left - l.right) / PATHS_ENTRY, 1);
    l.key_lines = (levels + l.key_columns - 1) / l.key_columns;
    l.below += PATHS_KEY_ROW * l.key_lines;
    return l;
}

/* Returns the height [pixel], at most PATHS_HIGH, of a picture of crack paths in which the bounding box e of the paths
 * fills the panel. l: margins; width: width of the picture [pixel]. */
static int paths_height(const struct extent *e, const struct paths_layout *l, int width)
{
    const double aspect = (e->high[1] - e->low[1]) / (e->high[0] - e->low[0]);
    const double height = (width - l->left - l->right) * aspect + l->above + l->below;
    return isfinite(height) ? (int)fmin(height, PATHS_HIGH) : PATHS_HIGH / 2;
}

/* Returns the width [pixel], at most PATHS_WIDE, of a picture of usual size in which the paths with the bounding box e
 * fill the panel. l: margins. */
static int paths_width(const struct extent *e, const struct paths_layout *l)
{
    const double aspect = (e->high[0] - e->low[0]) / (e->high[1] - e->low[1]);
    const double width = (PATHS_HIGH - l->above - l->below) * aspect + l->left + l->right;
    return isfinite(width) ? (int)fmin(fmax(width, PATHS_WIDE / 2), PATHS_WIDE) : PATHS_WIDE;
}

/* Arguments of gnuplot's command `plot` for the crack paths of all runs. used: length of the text [byte]; drawn: number
 * of paths. */
struct path_plots {
    char text[16384];
    size_t used;
    int drawn;
};

/* Sends the crack paths of all runs of a study to the stream `to`, and appends the gnuplot arguments that plot them to
 * *p. In these, the gnuplot variable `metre` is the unit of the axes. Extends the bounding box *e [m] by the paths.
 * Paths for which *p has no room are left out. s: the study. */
static void paths_send(FILE *to, const struct convergence_study *s, struct extent *e, struct path_plots *p)
{
    bool named[LEVELS_MOST] = {false};
    const struct unit metre = convergence_study_choose_spacing_unit(s);
    for (int k = 0; k < s->study.n; k++) {
        const int level = s->point[k].level;
        if (level < 0 || !send_path(to, s, k, e)) continue;
        char title[64] = "";
        if (!named[level])
            snprintf(title, sizeof title, "title '%.4g %s'", s->spacings.at[level][0] / metre.factor, metre.name);
        const int more =
            snprintf(p->text + p->used, sizeof p->text - p->used,
                     "%s$w%d using ($1/metre):($2/metre) with lines lw 1.6 lc rgb '%s' %s", p->drawn > 0 ? ", " : "", k,
                     curve_colour[level % CURVE_COLOURS], named[level] ? "notitle" : title);
        if (more < 0 || p->used + (size_t)more >= sizeof p->text) break;
        p->used += (size_t)more;
        named[level] = true;
        p->drawn++;
    }
}

/* Sends the gnuplot commands for the panel of crack paths to g: margins of the layout l, ranges of the axes (one scale
 * for both, such that the bounding box e is visible), labels, tics so far apart that numbers do not touch, and position
 * of the key (legend). */
static void paths_write_axes(const struct gnuplot *g, const struct extent *e, const struct paths_layout *l)
{
    const bool narrow = picture_size_is_too_narrow_for_side_legend();
    const double range[2] = {e->high[0] - e->low[0], e->high[1] - e->low[1]};
    const double wide = g->width - l->left - l->right, high = g->height - l->above - l->below;
    const double scale = fmin(wide / range[0], high / range[1]);
    const struct unit metre = unit_for_length(fmax(range[0], range[1]));
    fprintf(g->to, "metre = %g\n", metre.factor);
    for (int d = 0; d < 2; d++) {
        const double low = e->low[d] / metre.factor, end = e->high[d] / metre.factor;
        fprintf(g->to, "set %crange [%.7g:%.7g]\nset %ctics %.9g\nset %clabel '%c [%s]'\n", "xy"[d], low, end, "xy"[d],
                axis_tick_distance(end - low, (int)fmax(scale * range[d] / (d ? 24 : 52), 1)), "xy"[d], "xy"[d],
                metre.name);
    }
    fprintf(g->to,
            "set size ratio -1\nset title 'paths of the longest tip, all runs, means over 4 spacings'\nset lmargin at "
            "screen %.4f\n"
            "set rmargin at screen %.4f\nset tmargin at screen %.4f\nset bmargin at screen %.4f\n",
            l->left / g->width, 1 - l->right / g->width, 1 - l->above / g->height, l->below / g->height);
    fprintf(g->to, "set key at screen %.4f,%.4f left top horizontal maxcols %d maxrows %d\n",
            narrow ? 8.0 / g->width : 1 - (l->right - 8) / g->width,
            narrow ? (PATHS_KEY_ROW * l->key_lines + 6.0) / g->height : 1 - l->above / g->height, l->key_columns,
            l->key_lines);
}

status convergence_draw_crack_paths(const struct convergence_study *s)
{
    const struct path picture = convergence_picture_path(s->study.folder, "path");
    struct gnuplot g;
    struct extent e = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    struct path_plots plots = {.used = 0};
    char *data = NULL;
    size_t length = 0;
    FILE *to = memory_stream_open(&data, &length);
    if (!to) return status_set(FAILED, "%s: out of memory", picture.text);
    paths_send(to, s, &e, &plots);
    if (fclose(to) != 0) {
        free(data);
        return status_set(FAILED, "%s: out of memory", picture.text);
    }
    if (plots.drawn > 0) extent_widen(&e);
    const struct paths_layout l = paths_layout_make(s->spacings.levels);
    const int width =
        picture_size_is_too_narrow_for_side_legend() ? picture_size_get_process_wide().width : paths_width(&e, &l);
    status done =
        gnuplot_open(&g, picture.text, picture_size_get_process_wide().format, width, paths_height(&e, &l, width));
    if (done == OK) {
        fputs(data, g.to);
        if (plots.drawn > 0) {
            paths_write_axes(&g, &e, &l);
            fprintf(g.to, "plot %s\n", plots.text);
        } else
            fputs("set xrange [0:1]\nset yrange [0:1]\nset label 'no crack grew' at 0.5,0.5 center\nplot NaN notitle\n",
                  g.to);
        done = gnuplot_close(&g);
    }
    free(data);
    return done;
}
