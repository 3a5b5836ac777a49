/* Draws the pictures of a convergence study: scalar results against the spacing, and the crack paths of all runs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/history.h"
#include "output/output_files.h"
#include "output/picture_file.h"
#include "convergence_units.h"
#include "study_axis.h"
#include "study_internal.h"

/* SHOWN_MOST, SHOWN_WIDE: largest numbers of drawn scalar results, and of panels side by side. TIPS_MOST: largest
 * number of crack tips followed in one run. TICS_MOST: largest number of intervals of an axis of spacings. */
enum { SHOWN_MOST = 6, SHOWN_WIDE = 3, TIPS_MOST = 16, TICS_MOST = 7 };
#define SMOOTH 2.0  /* half of the growth over which positions of a path are averaged [spacings] */
#define FLICKER 3.0 /* largest apparent motion of a tip that does not grow [spacings] */

/* Returns the path FOLDER/pictures/KEY.png of a picture of the study in `folder`, with KEY = key (the name of the
 * picture), or with the ending of another format that picture_size_set_process_wide has set. */
static struct path convergence_picture(const char *folder, const char *key)
{
    char name[PICTURE_NAME_ROOM];
    study_picture_write_file_name(name, key);
    return path_join(path_join(folder, "pictures").text, name);
}

status scalar_results_check_replaceable(const char *folder)
{
    static const char *const begin[] = {"figure,unit,"};
    if (study_folder_check_is_usable(folder) != OK) return OK; /* study_lock_folder reports the fault */
    TRY(file_check_is_from_cleave(path_join(folder, "converge.csv").text, begin, COUNT_OF(begin)));
    TRY(picture_check_replaceable(convergence_picture(folder, "convergence").text));
    return picture_check_replaceable(convergence_picture(folder, "path").text);
}

/* ---- results over the spacing ------------------------------------------------------------------------------------ */

/* Returns the lower end of the 95 % interval of the result f at spacing level k (runs with one particle spacing), in
 * the unit of the result: the mean less the uncertainty, as in converge.csv, also below 0. */
static double interval_begin(const struct scalar_result_study *f, int k)
{
    return f->c.level[k].mean - f->c.uncertainty[k];
}

/* Sends three data blocks of the result f, a number in summary.json of the runs of the study s, to gnuplot's stream
 * `to`. Their names are $r, $m and $e followed by the number `panel`. $r: spacing and result of every run. $m:
 * spacing, mean and ends of the 95 % interval of every spacing level (runs with one particle spacing). $e: spacing 0
 * and the extrapolated result. */
static void send_figure(FILE *to, const struct convergence_study *s, const struct scalar_result_study *f, int panel)
{
    const int at = study_table_index_of_result(&s->table, f->name);
    const double factor = scalar_result_study_choose_unit(f).factor,
                 metre = convergence_study_choose_spacing_unit(s).factor;
    fprintf(to, "$r%d << EOD\n", panel);
    for (int k = 0; k < s->study.n; k++)
        if (s->point[k].level >= 0 && isfinite(s->table.value[at][k]))
            fprintf(to, "%.8g %.10g\n", s->point[k].spacing / metre, s->table.value[at][k] / factor);
    fprintf(to, "EOD\n$m%d << EOD\n", panel);
    for (int k = 0; k < f->c.levels; k++)
        fprintf(to, "%.8g %.10g %.10g %.10g\n", f->c.level[k].spacing / metre, f->c.level[k].mean / factor,
                interval_begin(f, k) / factor, (f->c.level[k].mean + f->c.uncertainty[k]) / factor);
    fprintf(to, "EOD\n$e%d << EOD\n0 %.10g\nEOD\n", panel, f->c.extrapolated / factor);
}

/* Returns true if the picture shows a curve from the means of a scalar result to the extrapolated value at spacing 0:
 * if the result converges, even slowly, and its order is known. c: convergence of the result. */
static bool is_extrapolated(const struct convergence *c)
{
    return (c->verdict == VERDICT_CONVERGES || c->verdict == VERDICT_SLOW) && isfinite(c->order_likely);
}

/* Plots the result f (a scalar result) in panel number `panel` from the data blocks of send_figure: its runs, the means
 * with their intervals and, if it converges, the curve to spacing 0. to: gnuplot's stream; metre: unit of the spacings
 * [m]. */
static void plot_figure(FILE *to, const struct scalar_result_study *f, int panel, double metre)
{
    const struct convergence *c = &f->c;
    const struct unit unit = scalar_result_study_choose_unit(f);
    char title[256];
    study_write_panel_title(title, sizeof title, f->name, *f->unit ? unit.name : "");
    fputs("set title ", to);
    gnuplot_write_quoted_string(to, title);
    fputs("\nplot ", to);
    if (is_extrapolated(c)) {
        fprintf(to, "x < 0 ? NaN : %.10g + %.10g*(x/%.10g)**%.6g with lines lw 1.6 dt (6,4) lc rgb '%s' notitle, ",
                c->extrapolated / unit.factor, (c->level[0].mean - c->extrapolated) / unit.factor,
                c->level[0].spacing / metre, c->order_likely, curve_colour[1]);
        fprintf(to, "$e%d using 1:2 with points pt 6 ps 1.3 lw 2 lc rgb '%s' notitle, ", panel, curve_colour[1]);
    }
    fprintf(to,
            "$r%d using 1:2 with points pt 7 ps 0.5 lc rgb '%s' notitle, "
            "$m%d using 1:2:3:4 with yerrorbars pt 7 ps 0.9 lw 1.8 lc rgb '%s' notitle\n",
            panel, curve_colour[5], panel, curve_colour[0]);
}

/* Sends the distances between tics (labelled marks) of a panel that shows the result f (a scalar result) to gnuplot,
 * such that the numbers do not touch. to: gnuplot's stream; wide, high: size of the panel [pixel]; coarsest: coarsest
 * spacing, in the unit of the horizontal axis. */
static void send_tics_of_panel(FILE *to, const struct convergence_study *s, const struct scalar_result_study *f,
                               double coarsest, double wide, double high)
{
    const bool narrow = picture_size_is_too_narrow_for_side_legend();
    const double *value = s->table.value[study_table_index_of_result(&s->table, f->name)];
    double low = INFINITY, end = -INFINITY;
    for (int k = 0; k < f->c.levels; k++) {
        low = fmin(low, interval_begin(f, k));
        end = fmax(end, f->c.level[k].mean + f->c.uncertainty[k]);
    }
    for (int k = 0; k < s->study.n; k++)
        if (s->point[k].level >= 0 && isfinite(value[k])) low = fmin(low, value[k]), end = fmax(end, value[k]);
    const double factor = scalar_result_study_choose_unit(f).factor;
    const struct study_axis axis = {low / factor, isfinite(end - low) ? end / factor : low / factor, false};
    const int across = (int)fmin(fmax(wide / (narrow ? 46 : 60), 1), TICS_MOST),
              up = (int)fmax(high / (narrow ? 26 : 34), 2);
    fprintf(to, "set xtics %g\n", axis_tick_distance(1.1 * coarsest, across));
    study_axis_write_to_gnuplot(to, "y", &axis, up);
}

/* Layout of the panels of a picture of scalar results [pixel]. width, height: size of the picture; columns, rows:
 * numbers of panels; cell_wide, cell_high: size of a panel with its texts; left, right, title, below: margins of a
 * panel for these texts. The key (legend) is on the right or, in narrow pictures, below the panels. */
struct figures_layout {
    int width, height, columns, rows;
    double cell_wide, cell_high, left, right, title, below;
};

/* Size of the key (legend), and usual size of a panel with its texts [pixel]. */
enum { KEY_WIDE = 250, KEY_HIGH = 52, CELL_WIDE = 420, CELL_HIGH = 360 };

/* Returns the layout of a picture with `shown` panels: its size, the size and margins of a panel, and the number of
 * columns. In a picture of a given size the number of columns is chosen such that the panels are as large as possible.
 * g: gnuplot process with the size of the picture, or NULL for a size that follows from the number of panels. */
static struct figures_layout figures_layout_make(int shown, const struct gnuplot *g)
{
    const bool narrow = picture_size_is_too_narrow_for_side_legend();
    const int wide = shown < SHOWN_WIDE ? shown : SHOWN_WIDE, rows = (shown + SHOWN_WIDE - 1) / SHOWN_WIDE;
    struct figures_layout best = {.width = g ? g->width : KEY_WIDE + CELL_WIDE * wide, .columns = wide};
    double largest = 0;
    best.height = g ? g->height : CELL_HIGH * rows;
    best.left = narrow ? 76 : 106, best.right = narrow ? 20 : 24, best.title = narrow ? 40 : 44,
    best.below = narrow ? 56 : 68;
    if (narrow && !g) {
        best.width = picture_size_get_process_wide().width, best.columns = 1 + (shown > 2);
        best.rows = (shown + best.columns - 1) / best.columns;
        const double panel = (double)best.width / best.columns - best.left - best.right;
        best.height = (int)(KEY_HIGH + best.rows * (best.title + 0.6 * panel + best.below));
        return best;
    }
    for (int columns = 1; columns <= shown; columns++) {
        struct figures_layout l = best;
        l.columns = columns, l.rows = (shown + columns - 1) / columns;
        l.cell_wide = (double)(l.width - (narrow ? 0 : KEY_WIDE)) / columns;
        l.cell_high = (double)(l.height - (narrow ? KEY_HIGH : 0)) / l.rows;
        const double room[2] = {l.cell_wide - l.left - l.right, l.cell_high - l.title - l.below};
        const double size = room[0] > 0 && room[1] > 0 ? fmin(room[0], 1.5 * room[1]) : 0;
        if (columns > 1 && !(size > largest)) continue;
        largest = size;
        best = l;
    }
    return best;
}

/* Sends the gnuplot commands for the margins of panel number k, from 0, in the layout l, to the stream `to`. */
static void figure_place(FILE *to, const struct figures_layout *l, int k)
{
    const double x = k % l->columns * l->cell_wide, y = l->height - k / l->columns * l->cell_high;
    fprintf(to,
            "set lmargin at screen %.5f\nset rmargin at screen %.5f\nset tmargin at screen %.5f\n"
            "set bmargin at screen %.5f\n",
            (x + l->left) / l->width, (x + l->cell_wide - l->right) / l->width, (y - l->title) / l->height,
            (y - l->cell_high + l->below) / l->height);
}

/* Draws the common key (legend) of all panels, on their right or in a narrow picture below them, through gnuplot's
 * stream `to`. The key is drawn as a panel of its own, as large as the picture, because gnuplot makes no key wider than
 * its panel. l: layout of the picture; extrapolated: true if a panel has a curve to spacing 0. */
static void draw_figures_key(FILE *to, const struct figures_layout *l, bool extrapolated)
{
    fputs("unset border\nunset tics\nunset title\nunset xlabel\nunset grid\nset offsets\nset lmargin at screen 0\n"
          "set rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen 1\n",
          to);
    if (picture_size_is_too_narrow_for_side_legend())
        fprintf(to, "set key at screen %.5f,%.5f left top horizontal maxcols 2 maxrows 2\n", 8.0 / l->width,
                (KEY_HIGH - 4.0) / l->height);
    else
        fprintf(to, "set key at screen %.5f,%.5f left top\n", 1 - (double)KEY_WIDE / l->width,
                1 - l->title / l->height);
    fprintf(to,
            "$none << EOD\nNaN NaN NaN\nEOD\nplot [0:1] [0:1] $none with yerrorbars pt 7 ps 0.9 lw 1.8 lc rgb '%s' "
            "title 'means, 95 %% intervals', $none with points pt 7 ps 0.5 lc rgb '%s' title 'runs'",
            curve_colour[0], curve_colour[5]);
    if (extrapolated)
        fprintf(to, ", $none with points pt 6 ps 1.3 lw 2 lc rgb '%s' title 'extrapolated'", curve_colour[1]);
    putc('\n', to);
}

static status draw_figures(const struct convergence_study *s, const struct scalar_result_study *figure, int figures)
{
    const int shown = figures < SHOWN_MOST ? figures : SHOWN_MOST;
    bool extrapolated = false;
    const struct figures_layout usual = figures_layout_make(shown, NULL);
    struct gnuplot g;
    const struct path picture = convergence_picture(s->study.folder, "convergence");
    const struct unit metre = convergence_study_choose_spacing_unit(s);
    const double coarsest = s->spacings.at[s->spacings.levels - 1][0] / metre.factor;
    TRY(gnuplot_open(&g, picture.text, picture_size_get_process_wide().format, usual.width, usual.height));
    const struct figures_layout l = figures_layout_make(shown, &g);
    for (int k = 0; k < shown; k++) send_figure(g.to, s, &figure[k], k);
    fprintf(g.to,
            "set multiplot\nset xrange [%.6g:%.6g]\nset samples 200\nset pointintervalbox 0\n"
            "set offsets 0, 0, graph 0.1, graph 0.1\nset xlabel 'spacing [%s]'\n",
            -0.05 * coarsest, 1.1 * coarsest, metre.name);
    for (int k = 0; k < shown; k++) {
        figure_place(g.to, &l, k);
        send_tics_of_panel(g.to, s, &figure[k], coarsest, l.cell_wide - l.left - l.right,
                           l.cell_high - l.title - l.below);
        plot_figure(g.to, &figure[k], k, metre.factor);
        extrapolated |= is_extrapolated(&figure[k].c);
    }
    draw_figures_key(g.to, &l, extrapolated);
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

/* ---- paths ------------------------------------------------------------------------------------------------------- */

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

/* Sends the paths of the longest crack tips of run k of the study s to gnuplot's stream `to`, as the data block $wK (K
 * is the number k) [m], each path as a separate line, without the steps from one row of bonds to the next. Extends the
 * bounding box *e [m] by them. Returns false if the run has no path of two positions, or no readable history. */
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

/* Draws the crack paths of all runs of the study s in one picture. Their data are composed before the picture is
 * opened, since their extent determines its height. Returns FAILED, with a message, without memory or if gnuplot
 * fails. */
static status draw_paths(const struct convergence_study *s)
{
    const struct path picture = convergence_picture(s->study.folder, "path");
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

status scalar_results_draw_over_spacing(const struct convergence_study *s, const struct scalar_result_study *results,
                                        int result_count)
{
    TRY(folder_create_with_parents(path_join(s->study.folder, "pictures").text));
    TRY(draw_figures(s, results, result_count));
    return s->scene.dim > 1 && study_table_index_of_result(&s->table, "crack.length_end") >= 0 ? draw_paths(s) : OK;
}
