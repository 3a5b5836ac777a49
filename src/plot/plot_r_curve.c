/* Draws the energy release rate against crack growth (R-curve) of runs in load steps. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "output/summary_read.h"
#include "curves_parts.h"
#include "scene/scene_read.h"

enum { TOUGHNESSES_SHOWN = 3 };

/* Reads the critical energy release rates of the materials in the scene of the run in `folder` into value[] [J/m^2],
 * each value once. Returns their number; 0 if the scene cannot be read. */
static int toughnesses_of(const char *folder, double value[TOUGHNESSES_SHOWN])
{
    struct scene s;
    int n = 0;
    if (scene_read(&s, path_join(folder, "scene.yaml").text, NULL, 0) != OK) return 0;
    for (int m = 0; m < s.materials && n < TOUGHNESSES_SHOWN; m++) {
        const double own = s.material[m].energy_release_rate;
        bool known = !(own > 0) || !isfinite(own);
        for (int k = 0; k < n; k++) known |= value[k] == own;
        if (!known) value[n++] = own;
    }
    scene_free(&s);
    return n;
}

/* Sends the data block $data to gnuplot: crack area and energy release rate of each load step in which the crack has
 * grown. area, rate: indices of their columns in the history h; square: unit of area; factor: unit of the rate
 * [J/m^2]. */
static void release_send(FILE *to, const struct history *h, int area, int rate, struct unit square, double factor)
{
    double before = 0;
    fputs("$data << EOD\n", to);
    for (int64_t i = 0; i < h->rows; i++) {
        const double now = history_value_at(h, i, area);
        if (now > before && isfinite(history_value_at(h, i, rate)))
            fprintf(to, "%.9g %.9g\n", now / square.factor, history_value_at(h, i, rate) / factor);
        before = fmax(before, now);
    }
    fputs("EOD\n", to);
}

/* Writes to gnuplot the command that plots the energy release rate against the crack area. Also plots as horizontal
 * lines the mean rate `mean` [J/m^2] unless it is NAN, and the critical rates toughness[n] [J/m^2] of the materials.
 * rate: unit of the axis of rates. */
static void release_plot(FILE *to, const double *toughness, int n, double mean, struct unit rate)
{
    fprintf(to, "plot $data with linespoints lw 2 pt 7 ps 0.7 lc rgb '%s' title 'release rate'", curve_colour[0]);
    if (isfinite(mean))
        fprintf(to, ", %.9g with lines lw 1.6 dt (3,4) lc rgb '%s' title 'mean %.4g %s'", mean / rate.factor,
                curve_colour[0], mean / rate.factor, rate.name);
    for (int k = 0; k < n; k++)
        fprintf(to, ", %.9g with lines lw 1.8 dt (10,6) lc rgb '%s' title 'G_c = %.4g %s'", toughness[k] / rate.factor,
                curve_colour[1 + k], toughness[k] / rate.factor, rate.name);
    putc('\n', to);
}

status r_curve_draw(struct output_picture picture, const char *folder, const char *title, const struct history *history)
{
    const int area = history_find_column(history, "crack_area"), rate = history_find_column(history, "release_rate");
    const double grown = history_largest_magnitude(history, area);
    double toughness[TOUGHNESSES_SHOWN] = {0}, top = history_largest_magnitude(history, rate);
    struct gnuplot g;
    if (!(grown > 0)) return picture_report_not_drawn_and_remove_old(picture.path, "no crack has grown");
    const int n = toughnesses_of(folder, toughness);
    for (int k = 0; k < n; k++) top = fmax(top, toughness[k]);
    double mean; /* NAN before the run has ended */
    (void)summary_read_number(folder, "load_steps.release_rate", &mean);
    top = fmax(top, mean);
    const struct unit square = unit_for_area(grown), joule = unit_with_si_prefix_for_largest_value(top, "J/m²");
    TRY(gnuplot_open(&g, picture.path, picture.format, 1000, 640));
    release_send(g.to, history, area, rate, square, joule.factor);
    curves_write_title(&g, title, "energy released by the growing crack");
    const struct curves_layout l = curves_layout_make(&g, 2 + n, strlen("mean 123.4 kJ/m²"), false, 1);
    curves_write_margins_and_key(g.to, &l);
    fprintf(g.to,
            "set xrange [0:%.9g]\nset yrange [0:%.9g]\nset ylabel 'released over new area [%s]'\nset xlabel 'new crack "
            "area [%s]'\n",
            1.03 * grown / square.factor, 1.15 * top / joule.factor, joule.name, square.name);
    curves_write_horizontal_tics(g.to, &l, 0, 1.03 * grown / square.factor);
    curves_write_vertical_tics(g.to, "y", 0, top / joule.factor, curves_layout_height_of_all_panels(&l));
    release_plot(g.to, toughness, n, mean, joule);
    return gnuplot_close(&g);
}
