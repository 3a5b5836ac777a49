/* Draws stress-intensity factors against time, and the paths of crack tips. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "output/pictures.h"
#include "curves_parts.h"
#include "output/summary_read.h"

/* PROBES_SHOWN, PATHS_SHOWN: largest numbers of probes and of crack paths that are drawn. */
enum { PROBES_SHOWN = 3, PATHS_SHOWN = 6 };

/* Finds the probes whose values of `quantity` are in the history h: for each there is a column called by the name of
 * the probe followed by `quantity`, such as ".K_I". Stores the names of the first `most` probes in name[]. Returns how
 * many names are stored. */
static int probes_with(const struct history *h, const char *quantity, char name[][NAME_MAX_LENGTH], int most)
{
    const size_t tail = strlen(quantity);
    int n = 0;
    for (int k = 0; k < h->columns && n < most; k++) {
        const size_t length = strlen(h->name[k]);
        if (length <= tail || length - tail >= NAME_MAX_LENGTH) continue;
        if (strcmp(h->name[k] + length - tail, quantity) != 0) continue;
        snprintf(name[n++], NAME_MAX_LENGTH, "%.*s", (int)(length - tail), h->name[k]);
    }
    return n;
}

static int plot_sif_column_of(const struct history *h, const char *probe, const char *quantity)
{
    char name[2 * NAME_MAX_LENGTH];
    snprintf(name, sizeof name, "%.63s.%.63s", probe, quantity);
    return history_find_column(h, name);
}

/* ---- factors over time ------------------------------------------------------------------------------------------- */

/* Stress-intensity factors of a history that are drawn, of n probes, and the unit of the axis. */
struct factors {
    int n;
    char name[PROBES_SHOWN][NAME_MAX_LENGTH];
    int column[2 * PROBES_SHOWN], spread[PROBES_SHOWN]; /* columns of K_I and K_II of each probe; of contour_spread */
    /* factors from the columns to the unit of the axis; to per cent */
    double factor[2 * PROBES_SHOWN], percent[PROBES_SHOWN];
    bool shown[2 * PROBES_SHOWN]; /* the factor is not 0 throughout */
    struct unit unit;
};

/* Finds the columns of K_I, K_II and contour_spread (relative difference between integration contours) of the first
 * PROBES_SHOWN probes of stress-intensity factors in the history h, and a unit for the largest factor; stores them in
 * *f. */
static void find_factors(struct factors *f, const struct history *h)
{
    double largest = 0;
    *f = (struct factors){0};
    f->n = probes_with(h, ".K_I", f->name, PROBES_SHOWN);
    for (int k = 0; k < f->n; k++) {
        f->column[2 * k] = plot_sif_column_of(h, f->name[k], "K_I");
        f->column[2 * k + 1] = plot_sif_column_of(h, f->name[k], "K_II");
        f->spread[k] = plot_sif_column_of(h, f->name[k], "contour_spread");
        f->percent[k] = 0.01;
        for (int m = 2 * k; m < 2 * k + 2; m++) {
            const double own = history_largest_magnitude(h, f->column[m]);
            largest = fmax(largest, own);
            f->shown[m] = own > 0;
        }
    }
    f->unit = unit_with_si_prefix_for_largest_value(largest, "Pa√m");
    for (int k = 0; k < 2 * f->n; k++) f->factor[k] = f->unit.factor;
}

/* Returns true if factor number k (from 0) of f is shown on the curve of one before, such as those of both ends of a
 * crack in a symmetric body. h: history with the values; extent: extent of the axis [Pa m^(1/2)]. */
static bool factor_hides_another(const struct factors *f, const struct history *h, int k, double extent)
{
    for (int m = 0; m < k; m++)
        if (f->shown[m] && history_curves_coincide(h, (int[]){f->column[m], f->column[k]}, (double[]){0, 0}, extent))
            return true;
    return false;
}

/* Writes the gnuplot command that plots the stress-intensity factors f to `to`. With one probe each mode has a colour;
 * with several probes each probe has a colour, and K_II is dashed, as is a curve that coincides with one before. h:
 * history with the values; extent: extent of the axis [Pa m^(1/2)]. */
static void plot_factors(FILE *to, const struct factors *f, const struct history *h, double extent)
{
    fputs("plot 0 with lines lw 0.8 lc rgb '#888888'", to);
    for (int k = 0; k < f->n; k++)
        for (int m = 0; m < 2; m++) {
            if (!f->shown[2 * k + m]) continue;
            fprintf(to, ", $data using 1:%d with lines lw %s%s lc rgb '%s' title '%s%sK_%s'", 2 + 2 * k + m,
                    m == 0 ? "2.4" : "2",
                    factor_hides_another(f, h, 2 * k + m, extent) ? " " DASHES_OVER_CURVE
                    : m == 1 && f->n > 1                          ? " dt (9,4)"
                                                                  : "",
                    curve_colour[f->n > 1 ? k : m], f->n > 1 ? f->name[k] : "", f->n > 1 ? ": " : "",
                    m == 0 ? "I" : "II");
        }
    putc('\n', to);
}

/* Writes the gnuplot commands that plot the relative differences of K between the integration contours of each probe to
 * `to`. The scale is logarithmic, in percent. Values above 50 % indicate waves, or a kink of the crack, within the
 * contours. s: history and its column of the time; l: layout of the picture; f: columns of the probes. */
static void plot_spread(FILE *to, const struct series *s, const struct curves_layout *l, const struct factors *f)
{
    const struct two_panel_edges two = curves_layout_edges_of_two_panels(l);
    curves_write_time_axis(to, s);
    curves_write_panel_margins(to, l, two.lower_from, two.lower_end);
    fprintf(to,
            "unset label\nunset key\nset format x '%%g'\nset logscale y\nset yrange [0.1:100]\n"
            "set ytics ('0.1' 0.1, '1' 1, '10' 10, '100' 100)\nset format y '%%g'\nset ylabel '%sspread [%%]'\nplot ",
            picture_size_is_too_narrow_for_side_legend() ? "" : "contour ");
    for (int k = 0; k < f->n; k++)
        fprintf(to, "%s$data using 1:%d with lines lw 1.6 lc rgb '%s'", k > 0 ? ", " : "", k + 2,
                curve_colour[f->n > 1 ? k : CURVE_COLOURS - 1]);
    putc('\n', to);
}

status sif_curves_draw(const char *title, const struct series *series)
{
    struct factors f;
    struct gnuplot g;
    find_factors(&f, series->h);
    const struct path path = picture_path(series->pictures, DRAWN_SIF, picture_ending[series->format]);
    if (f.n == 0) return OK;
    if (series->equilibrium)
        return picture_report_not_drawn_and_remove_old(
            path.text, "a single equilibrium has no curves over time; summary.json has its K_I and K_II");
    double spread = 0;
    for (int k = 0; k < f.n; k++) spread = fmax(spread, history_largest_magnitude(series->h, f.spread[k]));
    TRY(gnuplot_open(&g, path.text, series->format, 1000, spread > 0 ? 760 : 600));
    curves_write_gnuplot_data_block(g.to, series, f.column, f.factor, 2 * f.n);
    curves_write_title(&g, title, "stress-intensity factors");
    curves_write_time_axis(g.to, series);
    size_t longest = 0; /* of the names of several probes, which are before those of the factors */
    for (int k = 0; k < f.n && f.n > 1; k++) longest = strlen(f.name[k]) > longest ? strlen(f.name[k]) : longest;
    const struct curves_layout l = curves_layout_make(&g, 2 * f.n, longest + strlen(": K_II"), false, 1);
    curves_write_margins_and_key(g.to, &l);
    fprintf(g.to, "set ylabel 'K [%s]'\nset offsets graph 0, graph 0, graph 0.04, graph 0.04\n", f.unit.name);
    const double end =
        spread > 0 ? curves_layout_edges_of_two_panels(&l).upper_end : curves_layout_height_of_all_panels(&l);
    const struct value_range of = history_value_range(series->h, f.column, 2 * f.n);
    curves_write_panel_margins(g.to, &l, 0, end);
    curves_write_vertical_tics(g.to, "y", fmin(of.low, 0) / f.unit.factor, fmax(of.high, 0) / f.unit.factor, end);
    if (spread > 0) fputs("set multiplot\nset format x ''\nunset xlabel\n", g.to);
    plot_factors(g.to, &f, series->h, fmax(of.high, 0) - fmin(of.low, 0));
    if (spread > 0) {
        fputs("set offsets\nundefine $data\n", g.to);
        curves_write_gnuplot_data_block(g.to, series, f.spread, f.percent, f.n);
        plot_spread(g.to, series, &l, &f);
        fputs("unset multiplot\n", g.to);
    }
    return gnuplot_close(&g);
}

/* ---- paths of tips ----------------------------------------------------------------------------------------------- */

/* Path of one crack tip, as recorded in a history by a probe: columns of its positions, its ends, and its angles
 * compared with those of an experiment. */
struct tip_path {
    char name[NAME_MAX_LENGTH];
    int x, y, length;                    /* columns of the position and of the length */
    double from[2], to[2], grown;        /* start and end [m]; length of growth [m] */
    double angle, experiment, direction; /* angle of the chord, of an experiment, of the initial direction; NAN:
                                          * unknown [degree] */
};

static double plot_sif_figure_of(const char *folder, const char *probe, const char *quantity)
{
    char key[3 * NAME_MAX_LENGTH];
    double value = NAN;
    snprintf(key, sizeof key, "probes.%.63s.%.63s", probe, quantity);
    return summary_read_number(folder, key, &value) == OK ? value : NAN;
}

/* Finds the crack paths for the picture: for each of the first PATHS_SHOWN probes with a column NAME.K_eq in the
 * history h whose crack has grown, stores in w[PATHS_SHOWN] the columns of the tip position, its first and last value,
 * and the angles that summary.json in `folder`, the folder of the run, states. Returns the number of paths. */
static int find_tip_paths(struct tip_path *w, const char *folder, const struct history *h)
{
    char name[PATHS_SHOWN][NAME_MAX_LENGTH];
    const int found = probes_with(h, ".K_eq", name, PATHS_SHOWN);
    int n = 0;
    for (int k = 0; k < found; k++) {
        struct tip_path *a = &w[n];
        *a = (struct tip_path){.x = plot_sif_column_of(h, name[k], "x"),
                               .y = plot_sif_column_of(h, name[k], "y"),
                               .length = plot_sif_column_of(h, name[k], "length")};
        strcpy(a->name, name[k]);
        a->grown = history_value_at(h, h->rows - 1, a->length);
        if (!(a->grown > 0)) continue;
        for (int e = 0; e < 2; e++) {
            double *at = e == 0 ? a->from : a->to;
            at[0] = history_value_at(h, e * (h->rows - 1), a->x), at[1] = history_value_at(h, e * (h->rows - 1), a->y);
        }
        a->angle = plot_sif_figure_of(folder, name[k], "angle_deg");
        a->experiment = plot_sif_figure_of(folder, name[k], "experiment_deg");
        a->direction = plot_sif_figure_of(folder, name[k], "direction_deg");
        n++;
    }
    return n;
}

/* Writes the path w from history h to the gnuplot input `to` as the data block $wK (K is the number k): the tip
 * position of each sample, without repeated positions. factor: unit of length [m], by which positions are divided. */
static void send_tip_path(FILE *to, const struct history *h, const struct tip_path *w, int k, double factor)
{
    double last = -1;
    fprintf(to, "$w%d << EOD\n", k);
    for (int64_t i = 0; i < h->rows; i++) {
        const double length = history_value_at(h, i, w->length);
        if (length > last)
            fprintf(to, "%.7g %.7g\n", history_value_at(h, i, w->x) / factor, history_value_at(h, i, w->y) / factor);
        last = fmax(last, length);
    }
    fputs("EOD\n", to);
}

/* Computes the end point end[2] [m] of a line at the crack angle that an experiment measured. The line begins at the
 * start of the path w, is as long as the crack has grown, and turns from the initial direction of the crack to the same
 * side as the path. Returns false if the input file (scene) states no experiment for this path. */
static bool ray_of(const struct tip_path *w, double end[2])
{
    const double pi = 3.14159265358979323846, along = w->direction * pi / 180;
    const double across = cos(along) * (w->to[1] - w->from[1]) - sin(along) * (w->to[0] - w->from[0]);
    const double angle = along + (across < 0 ? -1 : 1) * w->experiment * pi / 180;
    end[0] = w->from[0] + w->grown * cos(angle), end[1] = w->from[1] + w->grown * sin(angle);
    return isfinite(angle);
}

/* PATH_WIDE, PATH_HIGH: largest width and height of the picture of crack paths; PATH_LOW: least width of its panel
 * [pixel]. */
enum { PATH_WIDE = 940, PATH_HIGH = 760, PATH_LOW = 200 };

/* Computes the corners low[2] and high[2] [m] of a rectangle that contains the ends of the n paths w and of the lines
 * at experimental angles, with a margin. Each of its sides is at least a quarter of the longest one. */
static void paths_extent(const struct tip_path *w, int n, double *low, double *high)
{
    double end[2], longer = 0;
    for (int d = 0; d < 2; d++) low[d] = INFINITY, high[d] = -INFINITY;
    for (int k = 0; k < n; k++)
        for (int d = 0; d < 2; d++) {
            low[d] = fmin(low[d], fmin(w[k].from[d], w[k].to[d]));
            high[d] = fmax(high[d], fmax(w[k].from[d], w[k].to[d]));
            if (ray_of(&w[k], end)) low[d] = fmin(low[d], end[d]), high[d] = fmax(high[d], end[d]);
        }
    for (int d = 0; d < 2; d++) longer = fmax(longer, high[d] - low[d]);
    for (int d = 0; d < 2; d++) {
        const double middle = 0.5 * (low[d] + high[d]),
                     half = fmax(0.5 * (high[d] - low[d]) + 0.1 * longer, longer / 8);
        low[d] = middle - half, high[d] = middle + half;
    }
}

/* Opens the picture of the crack paths of the history s, file `path`, and sets the ranges of its axes, both in one
 * scale. The height of the picture follows from the rectangle low[2]..high[2] [m]. metre: unit of the axes; entries:
 * number of entries of the key (legend); longest: number of letters of the longest entry. g: receives the gnuplot
 * process. Returns FAILED, with a message, if it cannot be started. */
static status paths_open(struct gnuplot *g, const char *path, const struct series *s, const double *low,
                         const double *high, const struct unit *metre, int entries, size_t longest)
{
    const struct gnuplot most = {.width = PATH_WIDE, .height = PATH_HIGH};
    const struct curves_layout usual = curves_layout_make(&most, entries, longest, false, 1);
    const double beside = usual.left + usual.right, aspect = (high[1] - low[1]) / (high[0] - low[0]);
    const double highest = curves_layout_height_of_all_panels(&usual),
                 inner = fmax(fmin(PATH_WIDE - beside, highest / aspect), PATH_LOW);
    const double height =
        PATH_HIGH - highest + fmin(fmax(inner * aspect, curves_key_height_beside_panel(entries)), highest);
    TRY(gnuplot_open(g, path, s->format, (int)(inner + beside), (int)height));
    const struct curves_layout l = curves_layout_make(g, entries, longest, false, 1);
    const double pixels[2] = {l.width - l.left - l.right, curves_layout_height_of_all_panels(&l)};
    const double scale = fmin(pixels[0] / (high[0] - low[0]), pixels[1] / (high[1] - low[1])); /* [pixel/m] */
    curves_write_margins_and_key(g->to, &l);
    for (int d = 0; d < 2; d++) {
        const double middle = 0.5 * (low[d] + high[d]), half = 0.5 * pixels[d] / scale;
        fprintf(g->to, "set %crange [%.9g:%.9g]\nset %clabel '%c [%s]'\nset %ctics %.9g\n", "xy"[d],
                (middle - half) / metre->factor, (middle + half) / metre->factor, "xy"[d], "xy"[d], metre -> name,
                "xy"[d], axis_choose_tic_distance(2 * half / metre->factor, pixels[d], d ? 30 : 50));
    }
    fputs("set samples 2\n", g->to);
    return OK;
}

/* Writes the gnuplot command that plots the initial cracks, the lines at the angles of experiments, and the paths w[n]
 * to `to`. metre: unit of length. */
static void plot_tip_paths(FILE *to, const struct tip_path *w, int n, const struct unit *metre)
{
    double end[2];
    fputs("plot ", to);
    for (int k = 0; k < n; k++) {
        const double m = metre->factor, direction = w[k].direction * 3.14159265358979323846 / 180;
        if (isfinite(direction)) /* the initial crack, up to the edge of the picture */
            fprintf(to, "'+' using (%.9g-%.9g*$0):(%.9g-%.9g*$0) every 1 with lines lw 5 lc rgb '#bbbbbb' title '%s', ",
                    w[k].from[0] / m, w[k].grown / m * cos(direction), w[k].from[1] / m,
                    w[k].grown / m * sin(direction), k == 0 ? "crack at the start" : "");
        if (ray_of(&w[k], end))
            fprintf(to, "'-' with lines lw 2 dt (10,6) lc rgb '%s' title 'experiment, %.3g°', ",
                    curve_colour[CURVE_COLOURS - 1], w[k].experiment);
        fprintf(to, "$w%d with lines lw 3 lc rgb '%s' title ", k, curve_colour[k]);
        char text[NAME_MAX_LENGTH + 32];
        snprintf(text, sizeof text, isfinite(w[k].angle) ? "%s, %.1f°" : "%s", w[k].name, w[k].angle);
        gnuplot_write_quoted_string(to, text);
        fputs(k + 1 < n ? ", " : "\n", to);
    }
    for (int k = 0; k < n; k++)
        if (ray_of(&w[k], end))
            fprintf(to, "%.9g %.9g\n%.9g %.9g\ne\n", w[k].from[0] / metre->factor, w[k].from[1] / metre->factor,
                    end[0] / metre->factor, end[1] / metre->factor);
}

status crack_paths_draw(const char *folder, const char *title, const struct series *series)
{
    const struct history *h = series->h;
    struct tip_path path[PATHS_SHOWN];
    struct gnuplot g;
    const int n = find_tip_paths(path, folder, h);
    if (n == 0) return OK;
    double low[2], high[2], low_end[2];
    paths_extent(path, n, low, high);
    const struct unit metre = unit_for_length(fmax(high[0] - low[0], high[1] - low[1]));
    size_t longest = strlen("crack at the start");
    int entries = 1;
    for (int k = 0; k < n; k++) {
        const size_t name = strlen(path[k].name) + strlen(", -123.4°");
        longest = name > longest ? name : longest;
        entries += 1 + ray_of(&path[k], low_end);
    }
    TRY(paths_open(&g, picture_path(series->pictures, DRAWN_PATH, picture_ending[series->format]).text, series, low,
                   high, &metre, entries, longest));
    curves_write_title(&g, title, "path of the crack");
    for (int k = 0; k < n; k++) send_tip_path(g.to, h, &path[k], k, metre.factor);
    plot_tip_paths(g.to, path, n, &metre);
    return gnuplot_close(&g);
}
