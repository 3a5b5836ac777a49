/* Pictures of a study of convergence: figures over the spacing, and the paths of all cracks over each other. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "output/history.h"
#include "output/output_files.h"
#include "plot/gnuplot.h"
#include "study/convergence_study.h"

enum { SHOWN_MOST = 6, SHOWN_WIDE = 3 };

static struct path convergence_picture(const struct convergence_study *s, const char *name)
{
    return path_join(path_join(s->study.folder, "pictures").text, name);
}

/* ---- figures over the spacing ------------------------------------------------------------------------------------ */

/* $r: every run; $m: means with the errors of the means; $e: what they converge to, with the interval, at spacing 0. */
static void send_figure(FILE *to, const struct convergence_study *s, const struct figure_study *f, int panel)
{
    const int at = study_figure(&s->table, f->name);
    fprintf(to, "$r%d << EOD\n", panel);
    for (int k = 0; k < s->study.n; k++)
        if (s->point[k].level >= 0 && isfinite(s->table.value[at][k]))
            fprintf(to, "%.8g %.10g\n", 1e3 * s->point[k].spacing, s->table.value[at][k]);
    fprintf(to, "EOD\n$m%d << EOD\n", panel);
    for (int k = 0; k < f->c.levels; k++)
        fprintf(to, "%.8g %.10g %.10g\n", 1e3 * f->c.level[k].spacing, f->c.level[k].mean, f->c.level[k].error);
    fprintf(to, "EOD\n$e%d << EOD\n0 %.10g %.10g %.10g\nEOD\n", panel, f->c.extrapolated, f->c.level[0].mean,
            f->c.uncertainty[0]);
}

static void plot_figure(FILE *to, const struct figure_study *f, int panel)
{
    const struct convergence *c = &f->c;
    const bool seen = c->verdict == VERDICT_CONVERGES || c->verdict == VERDICT_SLOW;
    fputs("set title ", to);
    gnuplot_quote(to, f->name);
    fputs("\nplot ", to);
    if (seen) {
        const double h = 1e3 * c->level[0].spacing, p = log((c->level[LEVELS_LEAST - 1].mean - c->extrapolated) /
                                                            (c->level[0].mean - c->extrapolated)) /
                                                        log(c->level[LEVELS_LEAST - 1].spacing / c->level[0].spacing);
        fprintf(to, "%.10g + %.10g*(x/%.10g)**%.6g with lines lw 1.6 dt (6,4) lc rgb '%s' notitle, ", c->extrapolated,
                c->level[0].mean - c->extrapolated, h, p, curve_colour[1]);
        fprintf(to, "$e%d using 1:2 with points pt 6 ps 1.3 lw 2 lc rgb '%s' title 'extrapolated', ", panel,
                curve_colour[1]);
    }
    fprintf(to,
            "$e%d using 1:3:4 with yerrorbars pt 0 lw 5 lc rgb '#bbbbbb' title '95 %% interval', "
            "$r%d using 1:2 with points pt 7 ps 0.5 lc rgb '%s' title 'runs', "
            "$m%d using 1:2:3 with yerrorbars pt 7 ps 0.9 lw 1.8 lc rgb '%s' title 'means'\n",
            panel, panel, curve_colour[5], panel, curve_colour[0]);
}

/* A round distance of tics, of which some five lie between 0 and `most`. */
static double tics_apart(double most)
{
    const double decade = pow(10, floor(log10(most / 3))), lead = most / 3 / decade;
    return decade * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

static status draw_figures(const struct convergence_study *s, const struct figure_study *figure, int figures)
{
    const int shown = figures < SHOWN_MOST ? figures : SHOWN_MOST, wide = shown < SHOWN_WIDE ? shown : SHOWN_WIDE;
    const int rows = (shown + SHOWN_WIDE - 1) / SHOWN_WIDE;
    struct gnuplot g;
    const struct path picture = convergence_picture(s, "convergence.png");
    TRY(gnuplot_open(&g, picture.text, PICTURE_PNG, 100 + 420 * wide, 80 + 360 * rows));
    for (int k = 0; k < shown; k++) send_figure(g.to, s, &figure[k], k);
    fprintf(g.to,
            "set multiplot layout %d,%d margins char 11, char 3, char 4, char 3 spacing char 12, char 6\n"
            "set format y '%%.4g'\nset xrange [0:*]\nset samples 200\nset key inside bottom right\n"
            "set offsets 0, graph 0.06, graph 0.1, graph 0.1\nset xlabel 'spacing [mm]'\nset xtics %g\n",
            rows, wide, tics_apart(1e3 * s->spacings.at[s->spacings.levels - 1][0]));
    for (int k = 0; k < shown; k++) {
        plot_figure(g.to, &figure[k], k);
        fputs("unset key\n", g.to);
    }
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

/* ---- paths ------------------------------------------------------------------------------------------------------- */

/* Sends the path of the longest crack of a run as $wK [mm]; false: it has none. */
static bool send_path(FILE *to, const struct convergence_study *s, int k)
{
    struct history h;
    const struct path folder = study_folder(&s->study, &s->study.at[k]);
    if (!path_is_file(path_join(folder.text, "history.csv").text) || history_read(&h, folder.text) != OK) return false;
    const int x = history_column(&h, "tip_x"), y = history_column(&h, "tip_y");
    const int length = history_column(&h, "crack_length");
    double last = 0;
    int sent = 0;
    fprintf(to, "$w%d << EOD\n", k);
    for (int64_t i = 0; x >= 0 && y >= 0 && length >= 0 && i < h.rows; i++) {
        const double grown = history_at(&h, i, length);
        if (!(grown > last) || !isfinite(history_at(&h, i, x))) continue;
        fprintf(to, "%.7g %.7g\n", 1e3 * history_at(&h, i, x), 1e3 * history_at(&h, i, y));
        last = grown;
        sent++;
    }
    fputs("EOD\n", to);
    history_free(&h);
    return sent > 1;
}

static status draw_paths(const struct convergence_study *s)
{
    struct gnuplot g;
    bool named[LEVELS_MOST] = {false};
    int drawn = 0;
    TRY(gnuplot_open(&g, convergence_picture(s, "path.png").text, PICTURE_PNG, 900, 720));
    fputs("set size ratio -1\nset xlabel 'x [mm]'\nset ylabel 'y [mm]'\n"
          "set title 'paths of the longest crack, all runs'\nset offsets graph 0.05, graph 0.05, graph 0.05, graph "
          "0.05\n",
          g.to);
    char plots[16384] = "";
    size_t used = 0;
    for (int k = 0; k < s->study.n; k++) {
        const int level = s->point[k].level;
        if (level < 0 || !send_path(g.to, s, k)) continue;
        char title[64] = "";
        if (!named[level]) snprintf(title, sizeof title, "title '%.4g mm'", 1e3 * s->spacings.at[level][0]);
        const int more =
            snprintf(plots + used, sizeof plots - used, "%s$w%d with lines lw 1.6 lc rgb '%s' %s",
                     drawn > 0 ? ", " : "", k, curve_colour[level % CURVE_COLOURS], named[level] ? "notitle" : title);
        if (more < 0 || used + (size_t)more >= sizeof plots) break;
        used += (size_t)more;
        named[level] = true;
        drawn++;
    }
    if (drawn > 0)
        fprintf(g.to, "plot %s\n", plots);
    else
        fputs("set xrange [0:1]\nset yrange [0:1]\nset label 'no crack grew' at 0.5,0.5 center\nplot NaN notitle\n",
              g.to);
    return gnuplot_close(&g);
}

status figures_draw(const struct convergence_study *s, const struct figure_study *figure, int figures)
{
    TRY(folder_make(path_join(s->study.folder, "pictures").text));
    TRY(draw_figures(s, figure, figures));
    return s->scene.dim > 1 && study_figure(&s->table, "crack.length_end") >= 0 ? draw_paths(s) : OK;
}
