/* Draws the picture of the coupling bench: bar, plane wave, position of the interface in its cell, uniform strain. */
#include <math.h>
#include <string.h>

#include "coupling.h"
#include "plot/gnuplot.h"

/* ---- panels ------------------------------------------------------------------------------------------------------ */

/* Styles of the lines of each coupling in the picture, as options of gnuplot. */
static const char *const variant_style[VARIANTS] = {
    [VARIANT_DAMPED] = "lw 4.5 pt 7 ps 1.1 lc rgb '#0072b2'",
    [VARIANT_UNDAMPED] = "lw 2 pt 7 ps 0.8 lc rgb '#56b4e9'",
    [VARIANT_HANDSHAKE] = "lw 2 pt 5 ps 0.8 lc rgb '#d55e00'",
    [VARIANT_PM] = "lw 2.4 pt 9 ps 1 lc rgb '#009e73'",
    [VARIANT_PG] = "lw 2.4 pt 9 ps 1 dt (3,4) lc rgb '#e69f00'",
    [VARIANT_PMG] = "lw 2.4 pt 11 ps 1 lc rgb '#cc79a7'",
    [VARIANT_PGG] = "lw 2.4 pt 11 ps 1 dt (3,4) lc rgb '#3d3d3d'",
};
static const char *const variant_title[VARIANTS] = {
    [VARIANT_DAMPED] = "partial stress (default)",
    [VARIANT_UNDAMPED] = "  undamped",
    [VARIANT_HANDSHAKE] = "handshake",
    [VARIANT_PM] = "pm",
    [VARIANT_PG] = "pg",
    [VARIANT_PMG] = "pmg",
    [VARIANT_PGG] = "pgg",
};

/* Begins one of four panels of the picture, titled `title`, with its key on the right. column, row: its position, each
 * 0 or 1. */
static void coupling_draw_set_panel(FILE *to, int column, int row, const char *title)
{
    const double left = 0.055 + 0.5 * column, above = 0.945 - 0.5 * row;
    fprintf(to,
            "set lmargin at screen %g\nset rmargin at screen %g\nset tmargin at screen %g\nset bmargin at screen %g\n"
            "set key at screen %g,%g left top vertical maxrows 20\nset title '%s'\n",
            left, left + 0.285, above, above - 0.37, left + 0.29, above, title);
}

static void set_logarithmic(FILE *to)
{
    fputs("set logscale xy\nset xrange [14:146]\nset yrange [0.05:15]\nset xtics (16, 32, 64, 128)\n"
          "set ytics (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10)\nset xlabel 'width of the pulse [spacings]'\n"
          "set ylabel 'reflected share of the amplitude [%]'\n",
          to);
}

/* ---- the bar ----------------------------------------------------------------------------------------------------- */

/* Draws, from table t, the amplitude that the interface in the bar reflects over the width of the pulse, a line for
 * each coupling. */
static void draw_pulses(FILE *to, const struct bar_table *t)
{
    for (int variant = 0; variant < VARIANTS; variant++) {
        fprintf(to, "$bar%d << EOD\n", variant);
        for (int k = 0; k < t->n; k++)
            if (t->run[k].variant == variant)
                fprintf(to, "%g %.6g\n", t->run[k].width, 100 * t->run[k].result.reflected);
        fputs("EOD\n", to);
    }
    coupling_draw_set_panel(to, 0, 0, "a pulse in a bar, six couplings");
    set_logarithmic(to);
    fputs("plot ", to);
    for (int variant = VARIANTS - 1; variant >= 0; variant--) /* the default coupling is drawn last, on top, and is
                                                               * first in the key */
        fprintf(to, "$bar%d using 1:2 with linespoints %s notitle, ", variant, variant_style[variant]);
    for (int variant = 0; variant < VARIANTS; variant++)
        fprintf(to, "%sNaN with linespoints %s title '%s'", variant ? ", " : "", variant_style[variant],
                variant_title[variant]);
    fputc('\n', to);
}

/* ---- the plane wave ---------------------------------------------------------------------------------------------- */

/* Lines of the panel with plane waves. variant, interface, transfer: coupling, interface and transfer of its results;
 * style, title: for gnuplot. */
static const struct series {
    int variant;
    const char *interface, *transfer, *style, *title;
} series[] = {
    {VARIANT_DAMPED, "flat", "flip", "lw 4.5 pt 7 ps 1.1 lc rgb '#0072b2'", "partial stress, flat"},
    {VARIANT_DAMPED, "45 degrees", "flip", "lw 4.5 pt 7 ps 1.1 dt (6,4) lc rgb '#0072b2'", "  at 45 degrees"},
    {VARIANT_DAMPED, "flat", "apic", "lw 2 pt 9 ps 1 lc rgb '#009e73'", "with APIC, flat"},
    {VARIANT_DAMPED, "45 degrees", "apic", "lw 2 pt 9 ps 1 dt (6,4) lc rgb '#009e73'", "  at 45 degrees"},
    {VARIANT_HANDSHAKE, "flat", "flip", "lw 2 pt 5 ps 0.8 lc rgb '#d55e00'", "handshake, flat"},
    {VARIANT_HANDSHAKE, "45 degrees", "flip", "lw 2 pt 5 ps 0.8 dt (6,4) lc rgb '#d55e00'", "  at 45 degrees"},
};
enum { SERIES = COUNT_OF(series) };

/* Returns true if row r of the results belongs to line s of the panel with plane waves: they have the same coupling,
 * interface and transfer, and the weights of the row are isotropic. */
static bool of_series(const struct plane_row *r, const struct series *s)
{
    return r->variant == s->variant && !strcmp(r->interface, s->interface) && !strcmp(r->transfer, s->transfer) &&
           !strcmp(r->weights, "isotropic");
}

/* Draws, from table t, a panel with the reflected amplitude over the width of the pulse, with a line for each entry of
 * `series`. The amplitude is that of means over blocks of particles, which can travel as a wave. */
static void draw_plane(FILE *to, const struct plane_table *t)
{
    bool there[SERIES] = {false};
    for (int k = 0; k < SERIES; k++) {
        fprintf(to, "$plane%d << EOD\n", k);
        for (int r = 0; r < t->n; r++)
            if (of_series(&t->row[r], &series[k])) {
                fprintf(to, "%g %.6g\n", t->row[r].width, 100 * t->row[r].wave);
                there[k] = true;
            }
        fputs("EOD\n", to);
    }
    coupling_draw_set_panel(to, 1, 0, "a plane pulse in a plate: what comes back as a wave");
    set_logarithmic(to);
    fputs("set xrange [14:73]\nplot ", to);
    for (int k = 0, n = 0; k < SERIES; k++)
        if (there[k])
            fprintf(to, "%s$plane%d using 1:2 with linespoints %s title '%s'", n++ ? ", " : "", k, series[k].style,
                    series[k].title);
    fputs("\nunset logscale\nset xlabel ''\nset ytics auto\nset xtics auto scale 0\n", to);
}

/* ---- bars -------------------------------------------------------------------------------------------------------- */

/* Sends the data of a bar of a bar chart to gnuplot: its position along the axis, its height `largest`, and the height
 * `on_node` at which a line is drawn across it. group: index of its group of bars; member: its index among the
 * `members` bars of the group. */
static void put_bar(FILE *to, int group, int member, int members, double on_node, double largest)
{
    fprintf(to, "%.4f %.6g %.6g\n", group + 0.8 * (member - 0.5 * (members - 1)) / members, largest, on_node);
}

static void plot_bars(FILE *to, const char *block, int members, const char *const *colour, const char *const *title)
{
    const double half = 0.4 / members * 0.92;
    fputs("plot ", to);
    for (int k = 0; k < members; k++)
        fprintf(to, "$%s%d using 1:(0.5*$2):(%g):(0.5*$2) with boxxy fs solid 0.85 noborder lc rgb '%s' title '%s', ",
                block, k, half, colour[k], title[k]);
    for (int k = 0; k < members; k++)
        fprintf(to, "$%s%d using ($1-%g):3:(%g):(0) with vectors nohead lw 3 lc rgb '#111111' title '%s', ", block, k,
                half, 2 * half, k ? "" : "on a node");
    fputs("NaN notitle\n", to);
}

/* Draws, from table t, bars of the reflected amplitude for three couplings and each width of the pulse. A bar is the
 * maximum over all positions of the interface in its grid cell, with a line for the interface on a node. */
static void draw_places(FILE *to, const struct bar_table *t)
{
    static const int variant[] = {VARIANT_HANDSHAKE, VARIANT_DAMPED, VARIANT_UNDAMPED};
    static const char *const colour[] = {"#d55e00", "#0072b2", "#56b4e9"};
    static const char *const title[] = {"handshake", "partial stress", "  undamped"};
    int groups = 0;
    fputs("set xtics (", to);
    for (int k = 0; k < t->n && t->run[k].variant == t->run[0].variant; k++)
        if (t->run[k].place == 0) fprintf(to, "%s'%g' %d", groups ? ", " : "", t->run[k].width, groups), groups++;
    fputs(")\n", to);
    for (int m = 0; m < 3; m++) {
        double largest = 0, on_node = 0;
        fprintf(to, "$place%d << EOD\n", m);
        for (int k = 0, group = 0; k < t->n; k++) {
            if (t->run[k].variant != variant[m]) continue;
            const double share = 100 * t->run[k].result.reflected;
            if (t->run[k].place == 0) largest = on_node = share;
            largest = fmax(largest, share);
            if (k + 1 == t->n || t->run[k + 1].place == 0) put_bar(to, group++, m, 3, on_node, largest);
        }
        fputs("EOD\n", to);
    }
    coupling_draw_set_panel(to, 0, 1, "the interface anywhere in its cell: largest reflection");
    fprintf(to,
            "set xrange [-0.6:%g]\nset yrange [0:*]\nset xlabel 'width of the pulse [spacings]'\n"
            "set ylabel 'reflected share of the amplitude [%%]'\n",
            groups - 0.4);
    plot_bars(to, "place", 3, colour, title);
}

/* Draws, from table t, bars of the largest nodal force in the patch test, for each shape of the interface and each
 * coupling. A bar is the maximum over all loads and positions of the grid, with a line for the interface on a grid
 * node. */
static void draw_patch(FILE *to, const struct patch_table *t)
{
    static const char *const shape[] = {"flat", "45 degrees", "circle, r = 8 D", "square, 6 x 6 D"};
    static const char *const coupling[] = {"handshake", "partial stress", "partial stress"};
    static const char *const weights[] = {"uniform", "uniform", "isotropic"};
    static const char *const colour[] = {"#d55e00", "#56b4e9", "#0072b2"};
    static const char *const title[] = {"handshake", "partial stress", "  isotropic weights"};
    for (int m = 0; m < 3; m++) {
        fprintf(to, "$patch%d << EOD\n", m);
        for (int s = 0; s < 4; s++) {
            double on_node = 0, largest = 0;
            for (int k = 0; k < t->n; k++) {
                const struct patch_row *r = &t->row[k];
                if (strcmp(r->shape, shape[s]) || strcmp(r->coupling, coupling[m]) || strcmp(r->weights, weights[m]))
                    continue;
                on_node = fmax(on_node, 100 * r->on_node);
                largest = fmax(largest, 100 * r->largest);
            }
            put_bar(to, s, m, 3, on_node, largest);
        }
        fputs("EOD\n", to);
    }
    coupling_draw_set_panel(to, 1, 1, "uniform strain in a plate: largest force on a node");
    fputs("set xrange [-0.6:3.6]\nset xtics ('flat' 0, '45 degrees' 1, 'circle' 2, 'square' 3)\n"
          "set xlabel 'interface'\nset ylabel 'force over stress x cell face [%]'\n",
          to);
    plot_bars(to, "patch", 3, colour, title);
}

void coupling_write_picture_commands(FILE *gnuplot, const void *figures)
{
    const struct coupling_figures *all = figures;
    fputs("set multiplot\n", gnuplot);
    draw_pulses(gnuplot, &all->pulses);
    draw_plane(gnuplot, &all->plane);
    draw_places(gnuplot, &all->places);
    draw_patch(gnuplot, &all->patch);
    fputs("unset multiplot\n", gnuplot);
}
