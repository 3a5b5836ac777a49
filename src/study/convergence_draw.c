/* Pictures of a convergence study: figures over the spacing, and the crack paths of all runs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/history.h"
#include "output/output_files.h"
#include "output/picture_file.h"
#include "plot/plot.h"
#include "study/convergence_study.h"
#include "study_internal.h"

/* Largest number of figures that are drawn, and of panels side by side; largest number of crack tips that are
 * followed. */
enum { SHOWN_MOST = 6, SHOWN_WIDE = 3, TIPS_MOST = 16 };
#define FLICKER 3.0 /* largest apparent motion of a tip that does not grow [spacings] */

/* Returns the path of picture `key` of the study in `folder`, with the ending of the format that was chosen. */
static struct path convergence_picture(const char *folder, const char *key)
{
    char name[PICTURE_NAME_ROOM];
    study_picture_name(name, key);
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

/* ---- figures over the spacing ------------------------------------------------------------------------------------ */

/* Returns the unit in which a figure (a number in summary.json of the runs) is drawn. */
static struct unit figure_unit(const struct scalar_result_study *f)
{
    return unit_for_largest_value_if_prefixable(f->unit,
                                                fmax(fabs(f->c.level[0].mean), fabs(f->c.level[f->c.levels - 1].mean)));
}

/* Sends three data blocks to gnuplot for the figure f, a number in summary.json. Their names are $r, $m and $e followed
 * by the number `panel`. $r: spacing [mm] and figure of every run. $m: spacing [mm], mean and half-width of the 95 %
 * interval of every spacing level. $e: spacing 0, the extrapolated figure, and mean and half-width of the finest
 * level. */
static void send_figure(FILE *to, const struct convergence_study *s, const struct scalar_result_study *f, int panel)
{
    const int at = study_index_of_result(&s->table, f->name);
    const double factor = figure_unit(f).factor;
    fprintf(to, "$r%d << EOD\n", panel);
    for (int k = 0; k < s->study.n; k++)
        if (s->point[k].level >= 0 && isfinite(s->table.value[at][k]))
            fprintf(to, "%.8g %.10g\n", 1e3 * s->point[k].spacing, s->table.value[at][k] / factor);
    fprintf(to, "EOD\n$m%d << EOD\n", panel);
    for (int k = 0; k < f->c.levels; k++)
        fprintf(to, "%.8g %.10g %.10g\n", 1e3 * f->c.level[k].spacing, f->c.level[k].mean / factor,
                f->c.uncertainty[k] / factor);
    fprintf(to, "EOD\n$e%d << EOD\n0 %.10g %.10g %.10g\nEOD\n", panel, f->c.extrapolated / factor,
            f->c.level[0].mean / factor, f->c.uncertainty[0] / factor);
}

static void plot_figure(FILE *to, const struct scalar_result_study *f, int panel)
{
    const struct convergence *c = &f->c;
    const struct unit unit = figure_unit(f);
    const bool seen = (c->verdict == VERDICT_CONVERGES || c->verdict == VERDICT_SLOW) && isfinite(c->order_likely);
    char title[256];
    snprintf(title, sizeof title, *f->unit ? "%.200s [%s]" : "%.200s%s", f->name, unit.name);
    fputs("set title ", to);
    gnuplot_write_quoted_string(to, title);
    fputs("\nplot ", to);
    if (seen) {
        fprintf(to, "x < 0 ? NaN : %.10g + %.10g*(x/%.10g)**%.6g with lines lw 1.6 dt (6,4) lc rgb '%s' notitle, ",
                c->extrapolated / unit.factor, (c->level[0].mean - c->extrapolated) / unit.factor,
                1e3 * c->level[0].spacing, c->order_likely, curve_colour[1]);
        fprintf(to, "$e%d using 1:2 with points pt 6 ps 1.3 lw 2 lc rgb '%s' title 'extrapolated', ", panel,
                curve_colour[1]);
    }
    fprintf(to,
            "$e%d using 1:3:4 with yerrorbars pt 0 lw 5 lc rgb '#bbbbbb' title 'finest mean', "
            "$r%d using 1:2 with points pt 7 ps 0.5 lc rgb '%s' title 'runs', "
            "$m%d using 1:2:3 with yerrorbars pt 7 ps 0.9 lw 1.8 lc rgb '%s' title 'means, 95 %% intervals'\n",
            panel, panel, curve_colour[5], panel, curve_colour[0]);
}

/* Returns the distance of tics of an axis, 1, 2 or 5 times a power of ten, with which three to seven tics are between 0
 * and `most`. */
static double tics_apart(double most)
{
    const double decade = pow(10, floor(log10(most / 3))), lead = most / 3 / decade;
    return decade * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

/* Layout of the panels of figures [pixel]: size of the picture; columns of panels, and the width and height of one with
 * its texts; the margins of a panel for these. The key is on the right or, in narrow pictures, below the panels. */
struct figures_layout {
    int width, height, columns, rows;
    double cell_wide, cell_high, left, right, title, below;
};

/* Sizes of the key, and of a panel with its texts in the usual picture [pixel]. */
enum { KEY_WIDE = 250, KEY_HIGH = 52, CELL_WIDE = 420, CELL_HIGH = 360 };

/* Computes the layout of a picture with `shown` panels: its size, the size and margins of a panel, and the number of
 * columns. In a picture of a given size the number of columns is chosen such that the panels are as large as possible.
 * g: size of the picture, or NULL for a size that follows from the number of panels. */
static struct figures_layout figures_layout_make(int shown, const struct gnuplot *g)
{
    const bool narrow = picture_is_too_narrow_for_key();
    const int wide = shown < SHOWN_WIDE ? shown : SHOWN_WIDE, rows = (shown + SHOWN_WIDE - 1) / SHOWN_WIDE;
    struct figures_layout best = {.width = g ? g->width : KEY_WIDE + CELL_WIDE * wide, .columns = wide};
    double largest = 0;
    best.height = g ? g->height : CELL_HIGH * rows;
    best.left = narrow ? 76 : 106, best.right = narrow ? 16 : 24, best.title = narrow ? 34 : 44,
    best.below = narrow ? 52 : 68;
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

/* Writes the gnuplot commands for the margins of panel number k, and with panel 0 the position of the key, which serves
 * all panels. */
static void figure_place(FILE *to, const struct figures_layout *l, int k)
{
    const double x = k % l->columns * l->cell_wide, y = l->height - k / l->columns * l->cell_high;
    fprintf(to,
            "set lmargin at screen %.5f\nset rmargin at screen %.5f\nset tmargin at screen %.5f\n"
            "set bmargin at screen %.5f\n",
            (x + l->left) / l->width, (x + l->cell_wide - l->right) / l->width, (y - l->title) / l->height,
            (y - l->cell_high + l->below) / l->height);
    if (k > 0)
        fputs("unset key\n", to);
    else if (picture_is_too_narrow_for_key())
        fprintf(to, "set key at screen %.5f,%.5f left top horizontal maxcols 2 maxrows 2 width -3\n", 8.0 / l->width,
                (KEY_HIGH - 4.0) / l->height);
    else
        fprintf(to, "set key at screen %.5f,%.5f left top\n", 1 - (double)KEY_WIDE / l->width,
                1 - l->title / l->height);
}

static status draw_figures(const struct convergence_study *s, const struct scalar_result_study *figure, int figures)
{
    const int shown = figures < SHOWN_MOST ? figures : SHOWN_MOST;
    const struct figures_layout usual = figures_layout_make(shown, NULL);
    struct gnuplot g;
    const struct path picture = convergence_picture(s->study.folder, "convergence");
    const double coarsest = 1e3 * s->spacings.at[s->spacings.levels - 1][0]; /* [mm] */
    TRY(gnuplot_open(&g, picture.text, picture_size_get().format, usual.width, usual.height));
    const struct figures_layout l = figures_layout_make(shown, &g);
    for (int k = 0; k < shown; k++) send_figure(g.to, s, &figure[k], k);
    fprintf(g.to,
            "set multiplot\nset format y '%%.4g'\nset xrange [%.6g:*]\nset samples 200\nset pointintervalbox 0\n"
            "set offsets 0, graph 0.06, graph 0.1, graph 0.1\nset xlabel 'spacing [mm]'\nset xtics %g\n",
            -0.05 * coarsest, tics_apart(coarsest));
    for (int k = 0; k < shown; k++) {
        figure_place(g.to, &l, k);
        plot_figure(g.to, &figure[k], k);
    }
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

/* ---- paths ------------------------------------------------------------------------------------------------------- */

/* Positions x[n], y[n] [m] of the longest crack tip at each sample at which it has grown, and its growth grown[n] [m].
 * tip[k]: index of the tip at sample k among the `tips` tips that were the longest in turn; it is reconstructed because
 * the history does not identify tips. */
struct longest {
    int64_t n;
    double *x, *y, *grown;
    int *tip, tips;
};

/* Bounding box of the drawn paths [m]. */
struct extent {
    double low[2], high[2];
};

/* Returns the index of the crack tip to which the i-th position of *l belongs. The history contains only the position
 * of the longest tip, which is not always the same one. It is the tip whose last position is nearest, among those that
 * can have moved to position i: from its last position, k, it can have moved by 2 (l->grown[i] - l->grown[k]) + FLICKER
 * * spacing. If there is none, returns a new index. spacing: lattice spacing of the run [m]. */
static int tip_drawn(const struct longest *l, int64_t i, double spacing)
{
    bool seen[TIPS_MOST] = {false};
    double nearest = INFINITY;
    int best = l->tips;
    for (int64_t k = i - 1; k >= 0; k--) {
        if (seen[l->tip[k]]) continue;
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
    const int length = history_find_column(h, "crack_length");
    *l = (struct longest){.x = NEW("study.x", h->rows, double),
                          .y = NEW("study.y", h->rows, double),
                          .grown = NEW("study.grown", h->rows, double),
                          .tip = NEW("study.tip", h->rows, int)};
    for (int64_t i = 0; i < h->rows; i++) {
        const double grown = history_value_at(h, i, length), last = l->n > 0 ? l->grown[l->n - 1] : 0;
        if (!(grown > last) || !isfinite(history_value_at(h, i, x)) || !isfinite(history_value_at(h, i, y))) continue;
        l->x[l->n] = history_value_at(h, i, x), l->y[l->n] = history_value_at(h, i, y), l->grown[l->n] = grown;
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
    memory_free(l->tip);
}

/* Sends the paths of the longest crack tips of run k to gnuplot as the data block $wK (K is the number k) [mm], each
 * path as a separate line. Extends the bounding box *e [m] by them. Returns false if the run has no path. */
static bool send_path(FILE *to, const struct convergence_study *s, int k, struct extent *e)
{
    struct history h;
    struct longest l;
    const struct path folder = study_case_folder(&s->study, &s->study.at[k]);
    if (!path_is_file(path_join(folder.text, "history.csv").text) || history_read(&h, folder.text) != OK) return false;
    longest_find(&l, &h, s->point[k].spacing);
    fprintf(to, "$w%d << EOD\n", k);
    for (int tip = 0; tip < l.tips; tip++) {
        for (int64_t i = 0; i < l.n; i++) {
            if (l.tip[i] != tip) continue;
            fprintf(to, "%.7g %.7g\n", 1e3 * l.x[i], 1e3 * l.y[i]);
            e->low[0] = fmin(e->low[0], l.x[i]), e->high[0] = fmax(e->high[0], l.x[i]);
            e->low[1] = fmin(e->low[1], l.y[i]), e->high[1] = fmax(e->high[1], l.y[i]);
        }
        if (tip + 1 < l.tips) fputs("\n", to);
    }
    fputs("EOD\n", to);
    const bool sent = l.n > 1;
    longest_free(&l);
    history_free(&h);
    return sent;
}

/* Extends the bounding box *e of the crack paths on all sides by a margin, which is positive even if all paths are
 * straight along an axis. */
static void extent_widen(struct extent *e)
{
    const double longer = fmax(e->high[0] - e->low[0], e->high[1] - e->low[1]);
    for (int d = 0; d < 2; d++) {
        const double centre = 0.5 * (e->low[d] + e->high[d]);
        const double half = fmax(0.55 * (e->high[d] - e->low[d]), 0.1 * longer);
        e->low[d] = centre - half, e->high[d] = centre + half;
    }
}

/* Height of a picture of paths, PATHS_WIDE wide, and the margins of its panel [pixel]. */
enum { PATHS_WIDE = 900, PATHS_LEFT = 90, PATHS_RIGHT = 150, PATHS_ABOVE = 50, PATHS_BELOW = 70, PATHS_HIGH = 900 };
enum { PATHS_LEFT_NARROW = 74, PATHS_RIGHT_NARROW = 100, PATHS_ABOVE_NARROW = 40, PATHS_BELOW_NARROW = 54 };

static int paths_height(const struct extent *e)
{
    const double aspect = (e->high[1] - e->low[1]) / (e->high[0] - e->low[0]);
    const double height = (PATHS_WIDE - PATHS_LEFT - PATHS_RIGHT) * aspect + PATHS_ABOVE + PATHS_BELOW;
    return isfinite(height) ? (int)fmin(height, PATHS_HIGH) : PATHS_HIGH / 2;
}

/* Arguments of gnuplot's command `plot` for the paths of all runs. used: length of the text; drawn: number of paths. */
struct path_plots {
    char text[16384];
    size_t used;
    int drawn;
};

/* Sends the crack paths of all runs of a study to the stream `to`, and appends the gnuplot arguments that plot them to
 * *p. Extends the bounding box *e by the paths. */
static void paths_send(FILE *to, const struct convergence_study *s, struct extent *e, struct path_plots *p)
{
    bool named[LEVELS_MOST] = {false};
    for (int k = 0; k < s->study.n; k++) {
        const int level = s->point[k].level;
        if (level < 0 || !send_path(to, s, k, e)) continue;
        char title[64] = "";
        if (!named[level]) snprintf(title, sizeof title, "title '%.4g mm'", 1e3 * s->spacings.at[level][0]);
        const int more = snprintf(p->text + p->used, sizeof p->text - p->used,
                                  "%s$w%d with lines lw 1.6 lc rgb '%s' %s", p->drawn > 0 ? ", " : "", k,
                                  curve_colour[level % CURVE_COLOURS], named[level] ? "notitle" : title);
        if (more < 0 || p->used + (size_t)more >= sizeof p->text) break;
        p->used += (size_t)more;
        named[level] = true;
        p->drawn++;
    }
}

/* Writes the ranges of the axes of the paths, which have one scale, and their tics, so far apart that numbers do not
 * touch. wide, high: room of the panel [pixel]. */
static void paths_write_axes(FILE *to, const struct extent *e, double wide, double high)
{
    const double range[2] = {e->high[0] - e->low[0], e->high[1] - e->low[1]};
    const double scale = fmin(wide / range[0], high / range[1]);
    for (int d = 0; d < 2; d++) {
        const double low = 1e3 * e->low[d], high_end = 1e3 * e->high[d], numbers = scale * range[d] / (d ? 20 : 52);
        fprintf(to, "set %crange [%.7g:%.7g]\nset %ctics %.9g\n", "xy"[d], low, high_end, "xy"[d],
                axis_tick_distance(high_end - low, (int)fmax(numbers, 1)));
    }
}

/* Draws the crack paths of all runs in one picture. Their data are composed before the picture is opened, since their
 * extent determines its height. Returns FAILED without memory or if gnuplot fails. */
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
    if (fclose(to) != 0) return status_set(FAILED, "%s: out of memory", picture.text);
    if (plots.drawn > 0) extent_widen(&e);
    const int height = paths_height(&e);
    status done = gnuplot_open(&g, picture.text, picture_size_get().format, PATHS_WIDE, height);
    if (done == OK) {
        const bool narrow = picture_is_too_narrow_for_key();
        const double left = narrow ? PATHS_LEFT_NARROW : PATHS_LEFT, above = narrow ? PATHS_ABOVE_NARROW : PATHS_ABOVE;
        const double right = narrow ? PATHS_RIGHT_NARROW : PATHS_RIGHT,
                     below = narrow ? PATHS_BELOW_NARROW : PATHS_BELOW;
        fputs(data, g.to);
        fprintf(g.to,
                "set size ratio -1\nset xlabel 'x [mm]'\nset ylabel 'y [mm]'\nset title 'paths of the longest tip, all "
                "runs'\nset lmargin at screen %.4f\nset rmargin at screen %.4f\nset tmargin at screen %.4f\n"
                "set bmargin at screen %.4f\n",
                left / g.width, 1 - right / g.width, 1 - above / g.height, below / g.height);
        if (plots.drawn > 0) paths_write_axes(g.to, &e, g.width - left - right, g.height - above - below);
        fprintf(g.to,
                plots.drawn > 0 ? "plot %s\n"
                                : "set xrange [0:1]\nset yrange [0:1]\nset label 'no crack grew' at 0.5,0.5 "
                                  "center\nplot NaN notitle%s\n",
                plots.text);
        done = gnuplot_close(&g);
    }
    free(data);
    return done;
}

status scalar_results_draw(const struct convergence_study *s, const struct scalar_result_study *figure, int figures)
{
    TRY(folder_make(path_join(s->study.folder, "pictures").text));
    TRY(draw_figures(s, figure, figures));
    return s->scene.dim > 1 && study_index_of_result(&s->table, "crack.length_end") >= 0 ? draw_paths(s) : OK;
}
