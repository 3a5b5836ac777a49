/* Pictures of `cleave bench experiments`: curves with measured values, and the crack paths of all runs. */
#include <math.h>
#include <string.h>

#include "experiments.h"
#include "plot/gnuplot.h"

/* ---- curves ------------------------------------------------------------------------------------------------------ */

/* A panel of a picture: name of the picture, title, gnuplot commands for its axes, and plot elements behind the
 * curves. */
struct experiment_panel {
    const char *picture, *title, *commands, *behind;
};
static const struct experiment_panel panels[] = {
    {"speed", "speed of a straight crack over its stress-intensity factor",
     "set xlabel 'K_I/K_c'\nset ylabel 'v/c_R'\nset xrange [0.9:*]\nset yrange [0:1.2]\nset key top left\n",
     "0.45 with lines lw 2 dt (6,4) lc rgb '#777777' title 'Homalite-100'"},
    {"taken", "energy that broken bonds take, over the new area",
     "set xlabel 'v/c_R'\nset ylabel 'over G_c'\nset xrange [0:*]\nset yrange [0.9:*]\nset key top left\n",
     "1 with lines lw 2 dt (6,4) lc rgb '#777777' title 'G_c', 1.02 with lines lw 1 dt (2,3) lc rgb '#777777' title "
     "'+- 2 %', 0.98 with lines lw 1 dt (2,3) lc rgb '#777777' notitle"},
    {"vortex", "vortex: error of displacements",
     "set xlabel 'spacing [m]'\nset ylabel 'over their size'\nset logscale xy\nset xrange [0.01:0.12]\n"
     "set yrange [*:*]\nset key top left\n",
     "10*x**2 with lines lw 2 dt (6,4) lc rgb '#777777' title 'order 2'"},
    {"branches at x", "where cracks branch (notch: 50 mm)",
     "set xlabel 'spacing [mm]'\nset ylabel 'x [mm]'\nset xrange [0:*]\nset yrange [60:110]\nset key top left\n", NULL},
};

static void experiment_put_curve(FILE *to, const struct experiment_curve *c, int k)
{
    fprintf(to, "$c%d << EOD\n", k);
    for (int64_t i = 0; i < c->n; i++)
        fprintf(to, "%.6g %.6g %.6g\n", c->x[i], c->y[i], isnan(c->error[i]) ? 0 : c->error[i]);
    fputs("EOD\n", to);
}

static void experiment_plot_panel(FILE *to, const struct experiments *x, const struct experiment_panel *p)
{
    int shown = 0;
    fprintf(to, "unset logscale\nset title '%s'\n%s", p->title, p->commands);
    for (int k = 0; k < x->curves; k++) {
        if (strcmp(x->curve[k].picture, p->picture) != 0 || x->curve[k].n == 0) continue;
        fprintf(to, "%s$c%d using 1:2:3 with yerrorlines lw 2 pt 7 ps 0.8 lc rgb '%s' title ",
                shown > 0 ? ", " : "plot ", k, curve_colour[shown % CURVE_COLOURS]);
        gnuplot_write_quoted_string(to, x->curve[k].name);
        shown++;
    }
    if (p->behind) fprintf(to, "%s%s", shown++ ? ", " : "plot ", p->behind);
    fputs(shown ? "\n" : "set multiplot next\n", to);
}

static void experiments_draw_curves(FILE *to, const void *context)
{
    const struct experiments *x = context;
    for (int k = 0; k < x->curves; k++) experiment_put_curve(to, &x->curve[k], k);
    fputs("set multiplot layout 2,2 margins 0.07,0.97,0.09,0.95 spacing 0.09,0.15\nset key inside\n", to);
    for (size_t k = 0; k < COUNT_OF(panels); k++) experiment_plot_panel(to, x, &panels[k]);
    fputs("unset multiplot\n", to);
}

/* Adds a curve to x for each study of a crack that branches: position of the branching over the spacing. */
static void experiments_curves(struct experiments *x)
{
    for (int k = 0; k < x->n && x->curves < EXPERIMENT_CURVES_MOST; k++) {
        const struct experiment_row *r = &x->row[k];
        if (strcmp(r->figure, "branches at x") || !strcmp(r->experiment, "strip")) continue;
        struct experiment_curve *c =
            experiment_add_empty_curve(x, "branches at x", "%s, %s", r->experiment, r->variant);
        if (isfinite(r->value)) experiment_curve_append_point(c, r->spacing, r->value, r->deviation);
        for (int l = 0; l < r->coarser; l++)
            if (isfinite(r->coarse[l][1]))
                experiment_curve_append_point(c, r->coarse[l][0], r->coarse[l][1], r->coarse[l][2]);
    }
}

enum { PATHS_WIDE = 4 }; /* panels in a row */

/* ---- paths ------------------------------------------------------------------------------------------------------- */

/* Sends the gnuplot commands of a picture: the crack paths of every study in a panel of its own, coloured by spacing.
 * context: a struct experiments. */
static void experiments_draw_paths(FILE *to, const void *context)
{
    const struct experiments *x = context;
    fprintf(to,
            "set multiplot layout %d,%d margins 0.08,0.98,0.06,0.86 spacing 0.05,0.2\nset size ratio -1\nset xtics 20\n"
            "unset key\nset xrange [45:100]\nset yrange [0:*]\n",
            (x->paths + PATHS_WIDE - 1) / PATHS_WIDE, PATHS_WIDE);
    for (int k = 0; k < x->paths; k++) {
        const struct experiment_paths *p = &x->path[k];
        fputs("$p << EOD\n", to);
        for (int64_t i = 0; i < p->n; i++) fprintf(to, "%g %g %d\n", p->x[i], p->y[i], p->level[i]);
        fprintf(to, "EOD\nset title \"%s [mm]\\n%.3g, %.3g, %.3g mm: blue, orange, green\" font ',9'\nplot ", p->title,
                p->spacing[0], p->spacing[1], p->spacing[2]);
        for (int l = p->levels; l-- > 0;)
            fprintf(to, "$p using ($3 == %d ? $1 : NaN):2 with points pt 7 ps 0.2 lc rgb '%s'%s", l,
                    curve_colour[l % CURVE_COLOURS], l ? ", " : "\n");
    }
    fputs("unset multiplot\n", to);
}

status experiments_draw_all_pictures(struct experiments *x)
{
    experiments_curves(x);
    if (x->paths > 0)
        TRY(bench_draw("experiments_paths", 1100, 340 * ((x->paths + PATHS_WIDE - 1) / PATHS_WIDE),
                       experiments_draw_paths, x));
    return bench_draw("experiments", 1100, 820, experiments_draw_curves, x);
}
