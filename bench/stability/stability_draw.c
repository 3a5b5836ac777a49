/* Picture of the stability map: limits over the horizon and over points per cell, and the automatic step of every case
 * over its limit. */
#include <math.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "stability.h"

/* Begins one of four panels of the picture, titled `title`, with its key on the right. column, row: its position, each
 * 0 or 1. */
static void stability_draw_set_panel(FILE *to, int column, int row, const char *title)
{
    const double left = 0.052 + 0.5 * column, above = 0.95 - 0.5 * row;
    fprintf(to,
            "set lmargin at screen %g\nset rmargin at screen %g\nset tmargin at screen %g\nset bmargin at screen %g\n"
            "set key at screen %g,%g left top vertical maxrows 20\nset title '%s'\n",
            left, left + 0.3, above, above - 0.38, left + 0.305, above, title);
}

/* ---- over the horizon -------------------------------------------------------------------------------------------- */

/* Lines of the panel with limits over the horizon: peridynamic model, dimension and title. */
static const struct {
    const char *model;
    int dim;
    const char *title;
} law[] = {{"bond", 1, "bonds, bar"},  {"bond", 2, "bonds, plate"},  {"bond", 3, "bonds, solid"},
           {"ospd", 2, "ospd, plate"}, {"mospd", 2, "mospd, plate"}, {"mospd", 3, "mospd, solid"}};
enum { LAWS = COUNT_OF(law) };

/* Returns true if row r of the map belongs to line k of the panel with limits over the horizon: a peridynamic case
 * without special property, with the model and dimension of law[k]. */
static bool of_law(const struct stability_row *r, int k)
{
    return r->c.group == GROUP_PD && !r->c.note && r->c.dim == law[k].dim && !strcmp(r->c.model, law[k].model);
}

static void draw_horizons(FILE *to, const struct stability_map *map)
{
    for (int k = 0; k < LAWS; k++) {
        fprintf(to, "$law%d << EOD\n", k);
        for (int r = 0; r < map->n; r++)
            if (of_law(&map->row[r], k))
                fprintf(to, "%g %.5g %.5g %.5g\n", map->row[r].c.horizon, map->row[r].l.observed / map->row[r].l.unit,
                        map->row[r].l.critical / map->row[r].l.unit, map->row[r].l.automatic / map->row[r].l.unit);
        fputs("EOD\n", to);
    }
    stability_draw_set_panel(to, 0, 0, "peridynamics: where runs begin to grow, and the automatic step");
    fputs("set xrange [0.8:6.3]\nset yrange [0:*]\nset xlabel 'horizon [spacings]'\n"
          "set ylabel 'time step [spacing/wave speed]'\nplot ",
          to);
    for (int k = 0; k < LAWS; k++)
        fprintf(to,
                "$law%d using 1:2 smooth unique with linespoints pt 7 ps 0.9 lw 2.4 lc rgb '%s' title '%s', "
                "$law%d using 1:4 with points pt 2 ps 0.9 lw 1.6 lc rgb '%s' notitle, ",
                k, curve_colour[k], law[k].title, k, curve_colour[k]);
    fputs("NaN with points pt 7 ps 0.9 lc rgb '#333333' title 'observed limit', "
          "NaN with points pt 2 ps 0.9 lc rgb '#333333' title 'automatic step'\n",
          to);
}

/* ---- over points a cell ------------------------------------------------------------------------------------------ */

/* Shape functions with a line in the panels over points per cell. */
static const char *const shape[] = {"linear", "gimp", "cpgimp", "quadratic", "cubic"};
enum { SHAPES_DRAWN = COUNT_OF(shape) };

static void draw_points(FILE *to, const struct stability_map *map, const char *transfer, int column, int row,
                        const char *title)
{
    for (int k = 0; k < SHAPES_DRAWN; k++) {
        fprintf(to, "$%s%d << EOD\nNaN NaN NaN NaN NaN\n", transfer, k);
        for (int n = 0; n < map->n; n++) {
            const struct stability_row *r = &map->row[n];
            if (r->c.group != GROUP_POINTS || r->c.dim != 2 || r->c.space || r->refusal[0]) continue;
            if (strcmp(r->c.shape, shape[k]) || strcmp(r->c.transfer, transfer)) continue;
            fprintf(to, "%g %.5g %.5g %.5g %.5g\n", r->c.cell + 0.1 * (k - 2), r->l.observed / r->l.unit,
                    r->l.largest / r->l.unit, r->l.critical / r->l.unit, r->l.automatic / r->l.unit);
        }
        fputs("EOD\n", to);
    }
    stability_draw_set_panel(to, column, row, title);
    fputs("set xrange [0.5:6.5]\nset yrange [0:*]\nset xtics 1\nset xlabel 'points a cell and direction'\n"
          "set ylabel 'time step [cell/wave speed]'\nplot ",
          to);
    for (int k = 0; k < SHAPES_DRAWN; k++)
        fprintf(to,
                "$%s%d using 1:2:(0):($3-$2) with vectors nohead lw 6 lc rgb '%s' title '%s', "
                "$%s%d using 1:2 with points pt 7 ps 0.9 lc rgb '%s' notitle, "
                "$%s%d using 1:5 with points pt 2 ps 0.9 lw 1.8 lc rgb '%s' notitle, ",
                transfer, k, curve_colour[k], shape[k], transfer, k, curve_colour[k], transfer, k, curve_colour[k]);
    fputs("NaN with lines lw 6 lc rgb '#333333' title 'limit by place', NaN with points pt 7 ps 0.9 lc rgb '#333333' "
          "title "
          "'  its least', NaN with points pt 2 ps 0.9 lc rgb '#333333' title 'automatic step'\n",
          to);
}

/* ---- every case -------------------------------------------------------------------------------------------------- */

/* Draws the automatic and the critical time step of every case of the map, over its observed limit. */
static void draw_shares(FILE *to, const struct stability_map *map)
{
    int at = 0;
    stability_draw_set_panel(to, 1, 1, "every case: steps as shares of its observed limit");
    for (int g = 0; g < STABILITY_GROUP; g++) {
        fprintf(to, "$group%d << EOD\nNaN NaN NaN\n", g);
        for (int k = 0; k < map->n; k++) {
            const struct stability_row *r = &map->row[k];
            if ((int)r->c.group != g || r->refusal[0]) continue;
            fprintf(to, "%d %.5g %.5g\n", ++at, r->l.automatic / r->l.observed, r->l.critical / r->l.observed);
        }
        fputs("EOD\n", to);
        at += 2;
    }
    fprintf(to,
            "set xrange [0:%d]\nset yrange [0:1.2]\nunset xtics\nset xlabel 'cases'\nset ylabel 'share of the observed "
            "limit'\n"
            "set object 1 rectangle from 0,%g to %d,%g fc rgb '#e8f3ea' fs solid noborder behind\n"
            "set object 2 rectangle from 0,1 to %d,1.2 fc rgb '#f9e4dc' fs solid noborder behind\nplot ",
            at, STABILITY_LEAST, at, STABILITY_MOST, at);
    for (int g = 0; g < STABILITY_GROUP; g++)
        fprintf(to,
                "$group%d using 1:3 with points pt 6 ps 0.6 lc rgb '%s' notitle, "
                "$group%d using 1:2 with points pt 7 ps 0.8 lc rgb '%s' title '%s', ",
                g, curve_colour[g], g, curve_colour[g], stability_group_name[g]);
    fputs("NaN with points pt 7 ps 0.8 lc rgb '#333333' title 'automatic step', NaN with points pt 6 ps 0.6 lc rgb "
          "'#333333' title "
          "'critical estimate', NaN with lines lw 8 lc rgb '#d5ead9' title 'asked: 0.60 - 0.95', NaN with lines lw 8 "
          "lc rgb '#f3cfc0' "
          "title 'grows'\n",
          to);
}

void stability_write_picture_commands(FILE *gnuplot, const void *context)
{
    const struct stability_map *map = context;
    fputs("set multiplot\n", gnuplot);
    draw_horizons(gnuplot, map);
    draw_points(gnuplot, map, "flip", 1, 0, "material points, FLIP, in the plane");
    draw_points(gnuplot, map, "apic", 0, 1, "material points, APIC, in the plane");
    draw_shares(gnuplot, map);
    fputs("unset multiplot\n", gnuplot);
}
