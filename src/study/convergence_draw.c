/* Draws the scalar results of a convergence study against the spacing. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "output/picture_file.h"
#include "convergence_units.h"
#include "study_axis.h"
#include "study_internal.h"

/* SHOWN_MOST, SHOWN_WIDE: largest numbers of drawn scalar results, and of panels side by side. TICS_MOST: largest
 * number of intervals of an axis of spacings. */
enum { SHOWN_MOST = 6, SHOWN_WIDE = 3, TICS_MOST = 7 };

status convergence_study_check_output_files_replaceable(const char *folder)
{
    static const char *const begin[] = {"figure,unit,"};
    if (study_folder_check_is_usable(folder) != OK) return OK; /* study_lock_folder reports the fault */
    TRY(file_check_has_known_beginning(path_join(folder, "converge.csv").text, begin, COUNT_OF(begin)));
    TRY(picture_check_replaceable(convergence_picture_path(folder, "convergence").text));
    return picture_check_replaceable(convergence_picture_path(folder, "path").text);
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
    study_panel_compose_title(title, sizeof title, f->name, *f->unit ? unit.name : "");
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
    const struct path picture = convergence_picture_path(s->study.folder, "convergence");
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

status scalar_results_draw_over_spacing(const struct convergence_study *s, const struct scalar_result_study *results,
                                        int result_count)
{
    TRY(folder_create_with_parents(path_join(s->study.folder, "pictures").text));
    TRY(draw_figures(s, results, result_count));
    return s->scene.dim > 1 && study_table_index_of_result(&s->table, "crack.length_end") >= 0
               ? convergence_draw_crack_paths(s)
               : OK;
}
