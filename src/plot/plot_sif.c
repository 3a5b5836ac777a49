/* Pictures of stress-intensity factors over time, and of the paths of crack tips. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "output/pictures.h"
#include "plot/plot.h"
#include "output/summary_read.h"

/* Largest numbers of probes and of crack paths that are drawn; least number of samples for a picture. */
enum { PROBES_SHOWN = 3, PATHS_SHOWN = 6, LEAST_ROWS = 3 };

/* Finds the columns of the history whose names end in `quantity`, for example ".K_I". Stores the parts of the names
 * before it, the names of the probes, in name[most]. Returns their number, at most `most`. */
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

struct factors {
    int n;
    char name[PROBES_SHOWN][NAME_MAX_LENGTH];
    int column[2 * PROBES_SHOWN], spread[PROBES_SHOWN]; /* columns of K_I and K_II of each probe; of contour_spread */
    double factor[2 * PROBES_SHOWN], percent[PROBES_SHOWN];
    struct unit unit;
};

/* Finds the columns of K_I, K_II and contour_spread of the first PROBES_SHOWN probes of stress-intensity factors, and a
 * unit for the largest factor. */
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
        for (int m = 0; m < 2; m++) largest = fmax(largest, history_largest_magnitude(h, f->column[2 * k + m]));
    }
    f->unit = unit_for_largest_value(largest, "Pa√m");
    for (int k = 0; k < 2 * f->n; k++) f->factor[k] = f->unit.factor;
}

/* Plots the stress-intensity factors. With one probe each mode has a colour; with several probes each probe has a
 * colour, and K_II is dashed. */
static void plot_factors(FILE *to, const struct factors *f)
{
    fputs("plot 0 with lines lw 0.8 lc rgb '#888888'", to);
    for (int k = 0; k < f->n; k++)
        for (int m = 0; m < 2; m++)
            fprintf(to, ", $data using 1:%d with lines lw %s%s lc rgb '%s' title '%s%sK_%s'", 2 + 2 * k + m,
                    m == 0 ? "2.4" : "2", m == 1 && f->n > 1 ? " dt (9,4)" : "", curve_colour[f->n > 1 ? k : m],
                    f->n > 1 ? f->name[k] : "", f->n > 1 ? ": " : "", m == 0 ? "I" : "II");
    putc('\n', to);
}

/* Plots the relative differences between the integration contours of each probe. More than 1/2 indicates waves or a
 * kink of the crack within the contours. */
static void plot_spread(FILE *to, const struct series *s, const struct factors *f)
{
    curves_write_time_axis(to, s);
    fputs("unset label\nunset key\nset format x '%g'\nset tmargin at screen 0.29\nset bmargin at screen 0.105\n"
          "set logscale y\nset yrange [0.1:100]\nset ytics ('0.1' 0.1, '1' 1, '10' 10, '100' 100)\nset format y '%g'\n"
          "set ylabel 'contours differ by [%]'\nplot ",
          to);
    for (int k = 0; k < f->n; k++)
        fprintf(to, "%s$data using 1:%d with lines lw 1.6 lc rgb '%s'", k > 0 ? ", " : "", k + 2,
                curve_colour[f->n > 1 ? k : CURVE_COLOURS - 1]);
    putc('\n', to);
}

status sif_curves_draw(const char *folder, const char *title, const struct series *s)
{
    struct factors f;
    struct gnuplot g;
    find_factors(&f, s->h);
    const struct path path = picture_path(folder, DRAWN_SIF, picture_ending[s->format]);
    if (f.n == 0) return OK;
    if (s->h->rows < LEAST_ROWS)
        return report_nothing_to_draw(path.text, "the run has one equilibrium; summary.json has its K_I and K_II");
    double spread = 0;
    for (int k = 0; k < f.n; k++) spread = fmax(spread, history_largest_magnitude(s->h, f.spread[k]));
    TRY(gnuplot_open(&g, path.text, s->format, 1000, spread > 0 ? 760 : 600));
    curves_write_data(g.to, s, f.column, f.factor, 2 * f.n);
    curves_write_title(g.to, title, "stress-intensity factors");
    curves_write_time_axis(g.to, s);
    fprintf(g.to,
            "set lmargin at screen 0.1\nset rmargin at screen 0.86\nset key at screen 0.875,0.9 left top\n"
            "set ylabel 'K [%s]'\nset offsets graph 0, graph 0, graph 0.04, graph 0.04\n"
            "set tmargin at screen 0.905\n",
            f.unit.name);
    if (spread > 0) fputs("set multiplot\nset bmargin at screen 0.35\nset format x ''\nunset xlabel\n", g.to);
    plot_factors(g.to, &f);
    if (spread > 0) {
        fputs("set offsets\nundefine $data\n", g.to);
        curves_write_data(g.to, s, f.spread, f.percent, f.n);
        plot_spread(g.to, s, &f);
        fputs("unset multiplot\n", g.to);
    }
    return gnuplot_close(&g);
}

/* ---- paths of tips ----------------------------------------------------------------------------------------------- */

struct tip_path {
    char name[NAME_MAX_LENGTH];
    int x, y, length;                    /* columns                                                         */
    double from[2], to[2], grown;        /* start and end [m]; length [m] */
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

/* Finds the paths of the crack tips that have grown and stores them in w[PATHS_SHOWN]. Returns their number. folder:
 * folder of the run; h: its history. */
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

/* Sends the k-th path w as the data block $wK: the tip position of each sample, without repeated positions. factor:
 * unit of length [m]. */
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

/* Computes the end of the line that shows the crack angle of an experiment, end[2] [m]. The line begins at the start of
 * the path w, is as long as the path has grown, and is on the side to which the path has turned. Returns false if the
 * path has no experiment. */
static bool ray_of(const struct tip_path *w, double end[2])
{
    const double pi = 3.14159265358979323846, along = w->direction * pi / 180;
    const double across = cos(along) * (w->to[1] - w->from[1]) - sin(along) * (w->to[0] - w->from[0]);
    const double angle = along + (across < 0 ? -1 : 1) * w->experiment * pi / 180;
    end[0] = w->from[0] + w->grown * cos(angle), end[1] = w->from[1] + w->grown * sin(angle);
    return isfinite(angle);
}

/* Size of the picture of paths [pixel], and its margins. */
enum {
    PATH_WIDE = 940,
    PATH_LEFT = 94,
    PATH_KEY = 244,
    PATH_ABOVE = 76,
    PATH_BELOW = 80,
    PATH_HIGH = 760,
    PATH_LOW = 200
};

/* Computes the rectangle low[2]..high[2] [m] that contains the ends of the n paths w and the lines of experiments, with
 * a margin. Each of its sides is at least a quarter of the longest one. */
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

/* Opens the picture of crack paths and sets the ranges of its axes in one scale. The picture is as high as the
 * rectangle low[2]..high[2] [m] requires. Returns FAILED if gnuplot cannot be started. */
static status paths_open(struct gnuplot *g, const char *path, const struct series *s, const double *low,
                         const double *high, const struct unit *metre)
{
    const double wide = PATH_WIDE - PATH_LEFT - PATH_KEY, aspect = (high[1] - low[1]) / (high[0] - low[0]);
    const double high_most = PATH_HIGH - PATH_ABOVE - PATH_BELOW;
    const double inner = fmax(fmin(wide, high_most / aspect), PATH_LOW), tall = fmin(inner * aspect, high_most);
    const double width = inner + PATH_LEFT + PATH_KEY, height = tall + PATH_ABOVE + PATH_BELOW;
    TRY(gnuplot_open(g, path, s->format, (int)width, (int)height));
    for (int d = 0; d < 2; d++)
        fprintf(g->to, "set %crange [%.9g:%.9g]\nset %clabel '%c [%s]'\n", "xy"[d], low[d] / metre->factor,
                high[d] / metre->factor, "xy"[d], "xy"[d], metre -> name);
    fprintf(g->to,
            "set size ratio -1\nset lmargin at screen %.4f\nset rmargin at screen %.4f\nset tmargin at screen %.4f\n"
            "set bmargin at screen %.4f\nset key at screen %.4f,%.4f left top\nset samples 2\n",
            PATH_LEFT / width, 1 - PATH_KEY / width, 1 - PATH_ABOVE / height, PATH_BELOW / height,
            1 - (PATH_KEY - 14) / width, 1 - PATH_ABOVE / height);
    return OK;
}

/* Plots the initial cracks, the lines at the angles of experiments, and the n paths w. metre: unit of length. */
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
        gnuplot_quote(to, text);
        fputs(k + 1 < n ? ", " : "\n", to);
    }
    for (int k = 0; k < n; k++)
        if (ray_of(&w[k], end))
            fprintf(to, "%.9g %.9g\n%.9g %.9g\ne\n", w[k].from[0] / metre->factor, w[k].from[1] / metre->factor,
                    end[0] / metre->factor, end[1] / metre->factor);
}

status crack_paths_draw(const char *folder, const char *title, const struct series *s)
{
    const struct history *h = s->h;
    struct tip_path path[PATHS_SHOWN];
    struct gnuplot g;
    const int n = find_tip_paths(path, folder, h);
    if (n == 0) return OK;
    const struct unit metre = unit_for_length(fmax(fabs(path[0].to[0]), fabs(path[0].to[1])));
    double low[2], high[2];
    paths_extent(path, n, low, high);
    TRY(paths_open(&g, picture_path(folder, DRAWN_PATH, picture_ending[s->format]).text, s, low, high, &metre));
    curves_write_title(g.to, title, "path of the crack");
    for (int k = 0; k < n; k++) send_tip_path(g.to, h, &path[k], k, metre.factor);
    plot_tip_paths(g.to, path, n, &metre);
    return gnuplot_close(&g);
}
