/* Draws curves of a run against time: crack growth, share of peridynamic particles, and energies. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "output/history.h"
#include "base/memory.h"
#include "output/pictures.h"
#include "curves_parts.h"
#include "run/ledger.h"

enum { POINTS_MAX = 4000 }; /* largest number of points of a curve */

double history_largest_magnitude(const struct history *history, int column_index)
{
    double largest = 0;
    for (int64_t i = 0; i < history->rows; i++) {
        double a = fabs(history_value_at(history, i, column_index));
        if (a > largest && isfinite(a)) largest = a;
    }
    return largest;
}

struct value_range history_value_range(const struct history *history, const int *column_index, int column_count)
{
    struct value_range e = {INFINITY, -INFINITY};
    for (int k = 0; k < column_count; k++)
        for (int64_t i = 0; i < history->rows; i++) {
            const double a = history_value_at(history, i, column_index[k]);
            if (isfinite(a)) e.low = fmin(e.low, a), e.high = fmax(e.high, a);
        }
    return e;
}

bool history_curves_coincide(const struct history *history, const int column_index[2], const double shift[2],
                             double axis_extent)
{
    /* LINE_WIDE: width of a line divided by the length of an axis; PART: share of the samples [1] */
    static const double LINE_WIDE = 0.004, PART = 0.25;
    const double wide = LINE_WIDE * axis_extent;
    int64_t apart = 0, hidden = 0;
    for (int64_t i = 0; i < history->rows; i++) {
        double value[2];
        for (int k = 0; k < 2; k++) value[k] = history_value_at(history, i, column_index[k]) - shift[k];
        if (isfinite(value[0]) != isfinite(value[1]) || fabs(value[1] - value[0]) > wide) apart++;
        if (fabs(value[1] - value[0]) <= wide && fabs(value[0]) > 3 * wide) hidden++;
    }
    return hidden > 0 && (apart == 0 || (double)hidden > PART * (double)history->rows);
}

void curves_write_gnuplot_data_block(FILE *gnuplot, const struct series *series, const int *column_index,
                                     const double *factor, int column_count)
{
    int64_t stride = series->h->rows / POINTS_MAX + 1;
    fputs("$data << EOD\n", gnuplot);
    for (int64_t i = 0; i < series->h->rows; i++) {
        if (i % stride != 0 && i != series->h->rows - 1) continue;
        fprintf(gnuplot, "%.9g", history_value_at(series->h, i, series->time) / series->second.factor);
        for (int k = 0; k < column_count; k++) {
            double a = history_value_at(series->h, i, column_index[k]) / factor[k];
            if (isfinite(a))
                fprintf(gnuplot, " %.9g", a);
            else
                fputs(" NaN", gnuplot);
        }
        putc('\n', gnuplot);
    }
    fputs("EOD\n", gnuplot);
}

void curve_colour_write_by_time_order(char text[COLOUR_ROOM], int curve_index, int curve_count)
{
    const double lightest = 0.82; /* yellow is not visible on white */
    const struct colour c = colour_on_sequential_scale(lightest * curve_index / fmax(curve_count - 1, 1));
    snprintf(text, COLOUR_ROOM, "#%02x%02x%02x", c.red, c.green, c.blue);
}

void curves_write_time_axis(FILE *gnuplot, const struct series *series)
{
    double end = history_value_at(series->h, series->h->rows - 1, series->time) / series->second.factor;
    const bool in_time = series->second.name[0] != 0;
    fprintf(gnuplot, "set xrange [0:%.9g]\nset xlabel '%s%s%s' textcolor rgb '#333333'\n", end > 0 ? end : 1,
            in_time ? "time [" : "load step", series->second.name, in_time ? "]" : "");
}

/* ---- crack ------------------------------------------------------------------------------------------------------- */

/* Writes the gnuplot commands for the vertical axis `axis` ("y" or "y2") from 0 to `top`, with label and tics in the
 * colour of its curve. colour: index of the colour in curve_colour; pixels: height of the panel [pixel]. */
static void set_axis(FILE *to, const char *axis, const char *label, int colour, double top, double pixels)
{
    fprintf(to,
            "set %slabel '%s' textcolor rgb '%s'\nset %stics nomirror textcolor rgb '%s'\n"
            "set %srange [0:%.9g]\n",
            axis, label, curve_colour[colour], axis, curve_colour[colour], axis, top > 0 ? top : 1);
    curves_write_vertical_tics(to, axis, 0, top, pixels);
}

/* Largest value of the upper end of the axis for the share of peridynamic particles [%]. */
static const double SHARE_TOP = 104;

/* Returns true if the values in a column of the history are not all equal. h: history of the run. */
static bool column_varies(const struct history *h, int column)
{
    for (int64_t i = 1; i < h->rows; i++)
        if (history_value_at(h, i, column) != history_value_at(h, 0, column)) return true;
    return false;
}

/* Draws the growth of the longest crack and the share of peridynamic particles in the history s against time, each only
 * if it changes. sheet: file and size of the picture; title: its title. The crack growth of a bar is never drawn.
 * Prints a message if neither changes. Returns FAILED if gnuplot fails. */
static status draw_crack(struct output_picture sheet, const char *title, const struct series *s)
{
    const int column[2] = {history_find_column(s->h, "crack_length"), history_find_column(s->h, "pd_share")};
    const double largest[2] = {history_largest_magnitude(s->h, column[0]), history_largest_magnitude(s->h, column[1])};
    const bool shown[2] = {largest[0] > 0 && !s->bar, column_varies(s->h, column[1])};
    const struct unit metre = unit_for_length(largest[0]);
    const double factor[2] = {metre.factor, 0.01}; /* the share in percent */
    char label[64];
    struct gnuplot g;
    if (!shown[0] && !shown[1])
        return picture_report_not_drawn_and_remove_old(
            sheet.path, s->bar ? "a crack of a bar has no length; profiles show the damage"
                               : "no crack grows, and no particle becomes peridynamic");
    TRY(gnuplot_open(&g, sheet.path, sheet.format, 1000, 600));
    curves_write_gnuplot_data_block(g.to, s, column, factor, 2);
    curves_write_title(&g, title, "crack");
    curves_write_time_axis(g.to, s);
    const bool both = shown[0] && shown[1];
    const struct curves_layout l = curves_layout_make(&g, both ? 2 : 0, strlen("peridynamic share (right)"), both, 1);
    curves_write_margins_and_key(g.to, &l);
    const double pixels = curves_layout_height_of_all_panels(&l);
    snprintf(label, sizeof label, "crack growth [%s]", metre.name);
    if (shown[0]) set_axis(g.to, "y", label, 0, 1.08 * largest[0] / factor[0], pixels);
    if (shown[1])
        set_axis(g.to, shown[0] ? "y2" : "y", "peridynamic share [%]", 1,
                 fmin(1.25 * largest[1] / factor[1], SHARE_TOP), pixels);
    fprintf(g.to, "set border %d\n%splot ", both ? 11 : 3, both ? "" : "unset key\n");
    if (shown[0])
        fprintf(g.to, "$data using 1:2 with lines lw 2.4 lc rgb '%s' title 'crack growth (left)'%s", curve_colour[0],
                both ? ", " : "\n");
    if (shown[1])
        fprintf(g.to,
                "$data using 1:3 axes x1%s with lines lw 2.4 dt (12,5) lc rgb '%s' title 'peridynamic share (right)'\n",
                both ? "y2" : "y1", curve_colour[1]);
    return gnuplot_close(&g);
}

/* ---- energies ---------------------------------------------------------------------------------------------------- */

/* Energies that a picture shows as curves. Energy k is in column[k] of the history and is drawn less the constant
 * shift[k] [J]. low, high: range of the vertical axis [J]. */
struct energies {
    int column[LEDGER_ROWS];
    const struct ledger_row *row[LEDGER_ROWS];
    double factor[LEDGER_ROWS], shift[LEDGER_ROWS], low, high;
    char label[LEDGER_ROWS][96];
    int n;
    struct unit joule;
};

/* Energies below this fraction of the largest one are not drawn: their curves coincide with the axis. */
#define ENERGY_SHOWN 5e-4
#define WORK_COLOUR "#c8c8c8" /* of the external work */

/* HEAVY: initial kinetic energy, divided by the largest later change of any energy, above which it is subtracted in the
 * picture, since it would flatten the curves (as of a heavy hammer). NOTHING: largest change, divided by the initial
 * kinetic energy, that counts as round-off; the energy is then not subtracted. */
enum { HEAVY = 10 };
#define NOTHING 1e-6

/* Returns the values of column number `column` of the history h less `shift`: lowest and highest [J]; 0 to 0 if there
 * is no such column. */
static struct value_range shifted_range(const struct history *h, int column, double shift)
{
    if (column < 0) return (struct value_range){0, 0};
    const struct value_range r = history_value_range(h, &column, 1);
    return (struct value_range){r.low - shift, r.high - shift};
}

static double largest_magnitude_of(struct value_range r) { return fmax(fabs(r.low), fabs(r.high)); }

/* Returns the kinetic energy at the start of the history h [J] if it exceeds HEAVY times the largest magnitude of all
 * other energies and of its own change, so that it would flatten their curves; else 0. Also 0 if all of these are
 * round-off (NOTHING). */
static double flattening_energy(const struct history *h)
{
    const int kinetic = history_find_column(h, "kinetic");
    const double start = kinetic < 0 ? 0 : history_value_at(h, 0, kinetic);
    double most = largest_magnitude_of(shifted_range(h, kinetic, start));
    for (int k = 0; k < LEDGER_ROWS; k++) {
        const int column = history_find_column(h, ledger[k].name);
        if (column != kinetic) most = fmax(most, largest_magnitude_of(shifted_range(h, column, 0)));
    }
    return start > HEAVY * most && most > NOTHING * start ? start : 0;
}

/* Selects in e for drawing the energies whose largest value in the history h is at least ENERGY_SHOWN times the largest
 * one of all, and chooses their unit. */
static void choose_energies(struct energies *e, const struct history *h)
{
    const double start = flattening_energy(h);
    const struct unit joule = unit_with_si_prefix_for_largest_value(start, "J");
    struct value_range range[LEDGER_ROWS];
    double shift[LEDGER_ROWS], largest = 0;
    *e = (struct energies){0};
    for (int k = 0; k < LEDGER_ROWS; k++) {
        shift[k] = strcmp(ledger[k].name, "kinetic") == 0 ? start : 0;
        range[k] = shifted_range(h, history_find_column(h, ledger[k].name), shift[k]);
        largest = fmax(largest, largest_magnitude_of(range[k]));
    }
    for (int k = 0; k < LEDGER_ROWS; k++) {
        if (!(largest_magnitude_of(range[k]) > ENERGY_SHOWN * largest)) continue;
        char less[64] = "";
        if (shift[k] > 0) snprintf(less, sizeof less, " - %.4g %s", start / joule.factor, joule.name);
        snprintf(e->label[e->n], sizeof *e->label, "%.24s%s", ledger[k].label, less);
        e->low = fmin(e->low, range[k].low), e->high = fmax(e->high, range[k].high);
        e->shift[e->n] = shift[k];
        e->column[e->n] = history_find_column(h, ledger[k].name);
        e->row[e->n++] = &ledger[k];
    }
    e->joule = unit_with_si_prefix_for_largest_value(largest, "J");
    for (int k = 0; k < e->n; k++) e->factor[k] = e->joule.factor;
}

/* Writes to gnuplot's stream `to` the expression for energy number k (from 0) of e: column k + 2 of its data, less the
 * initial energy shift[k] if this is subtracted in the picture. */
static void write_energy(FILE *to, const struct energies *e, int k)
{
    fprintf(to, "$%d", k + 2);
    if (e->shift[k] > 0) fprintf(to, "-%.12g", e->shift[k] / e->joule.factor);
}

/* Returns true if the curve of energy number k (from 0) of e, which is not the external work, coincides with one that
 * is drawn before. h: history with the values. */
static bool energy_hides_another(const struct energies *e, const struct history *h, int k)
{
    for (int m = 0; m < k; m++)
        if (e->row[m] != &ledger[LEDGER_WORK] &&
            history_curves_coincide(h, (int[]){e->column[m], e->column[k]}, (double[]){e->shift[m], e->shift[k]},
                                    e->high - e->low))
            return true;
    return false;
}

/* Writes to gnuplot the command that plots all energies selected in e, and as a dashed line their sum without the
 * external work. The external work, which the sum covers where the energy balance closes, is a broad band below all
 * other curves. A kinetic energy from which the start is subtracted is named so in the key (legend), and its start is
 * missing in the sum, too. A curve that coincides with one drawn before is dashed. h: history with the values. */
static void plot_energies(FILE *to, const struct energies *e, const struct history *h)
{
    fputs("plot ", to);
    for (int work = 1; work >= 0; work--)
        for (int k = 0; k < e->n; k++)
            if ((e->row[k] == &ledger[LEDGER_WORK]) == work) {
                fputs("$data using 1:(", to);
                write_energy(to, e, k);
                fprintf(to, ") with lines lw %s%s lc rgb '%s' title '%s', ", work ? "6" : "2.2",
                        !work && energy_hides_another(e, h, k) ? " " DASHES_OVER_CURVE : "",
                        work ? WORK_COLOUR : e->row[k]->colour, e->label[k]);
            }
    fputs("$data using 1:(0", to);
    for (int k = 0; k < e->n; k++)
        if (e->row[k] != &ledger[LEDGER_WORK]) {
            fputs("+", to);
            write_energy(to, e, k);
        }
    fputs(") with lines lw 1.6 dt (6,4) lc rgb '#000000' title 'sum'\n", to);
}

/* Returns a distance between tics (labelled marks), 1, 2 or 5 times a power of ten, with which an axis from 0 to `top`
 * has one or two tics above 0. */
static double coarse_tic_distance(double top)
{
    const double decade = pow(10, floor(log10(top))), lead = top / decade;
    return decade * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

/* Distance of the label of the balance error from the left edge of the picture, in usual and in narrow pictures
 * [pixel]. It leaves space for wide numbers at the axis. */
static const double LABEL_AT = 16, LABEL_AT_NARROW = 10;

/* Least extent of the axis of the balance error in both directions [%]; smaller errors are round-off. */
static const double BALANCE_LEAST = 0.0012;

/* Plots the relative error of the energy balance in the history s against time in a panel below the energies. l: layout
 * of the picture; largest: largest magnitude of the error [1]. */
static void plot_balance(FILE *to, const struct series *s, const struct curves_layout *l, double largest)
{
    const struct two_panel_edges two = curves_layout_edges_of_two_panels(l);
    const double top = fmax(120 * largest, BALANCE_LEAST); /* percent; 20 % above the largest value */
    curves_write_time_axis(to, s);
    curves_write_panel_margins(to, l, two.lower_from, two.lower_end);
    fprintf(to,
            "unset label\nunset key\nset format x '%%g'\n"
            "set yrange [%.9g:%.9g]\nset ytics %.9g\nset format y '%%.2g'\nunset ylabel\n"
            "set label '%serror [%%]' at screen %.6g,%.6g center rotate by 90 textcolor rgb '#333333'\n"
            "plot $data using 1:2 with lines lw 1.8 lc rgb '%s'\n",
            -top, top, coarse_tic_distance(top), picture_size_is_too_narrow_for_side_legend() ? "" : "balance ",
            (picture_size_is_too_narrow_for_side_legend() ? LABEL_AT_NARROW : LABEL_AT) / l->width,
            1 - (l->above + 0.5 * (two.lower_from + two.lower_end)) / l->height, curve_colour[6]);
}

/* Draws the energies of the history s against time, and below them the balance error if the history has it. sheet: file
 * and size of the picture; title: its title. Prints a message if all energies are 0 or the run has one equilibrium.
 * Returns FAILED if gnuplot fails. */
static status draw_energy(struct output_picture sheet, const char *title, const struct series *s)
{
    struct energies e;
    struct gnuplot g;
    int balance = history_find_column(s->h, "balance_error");
    const double percent = 0.01;
    if (s->equilibrium)
        return picture_report_not_drawn_and_remove_old(
            sheet.path, "a single equilibrium has no curves over time; summary.json has its energies");
    choose_energies(&e, s->h);
    if (e.n == 0) return picture_report_not_drawn_and_remove_old(sheet.path, "all energies are 0");
    TRY(gnuplot_open(&g, sheet.path, sheet.format, 1000, balance >= 0 ? 760 : 600));
    curves_write_gnuplot_data_block(g.to, s, e.column, e.factor, e.n);
    curves_write_title(&g, title, "energy");
    curves_write_time_axis(g.to, s);
    size_t longest = 3; /* sum */
    for (int k = 0; k < e.n; k++) longest = strlen(e.label[k]) > longest ? strlen(e.label[k]) : longest;
    const struct curves_layout l = curves_layout_make(&g, e.n + 1, longest, false, 1);
    curves_write_margins_and_key(g.to, &l);
    fprintf(g.to, "set ylabel 'energy [%s]'\n", e.joule.name);
    const double end =
        balance >= 0 ? curves_layout_edges_of_two_panels(&l).upper_end : curves_layout_height_of_all_panels(&l);
    curves_write_panel_margins(g.to, &l, 0, end);
    curves_write_vertical_tics(g.to, "y", e.low / e.joule.factor, e.high / e.joule.factor, end);
    if (balance >= 0) fputs("set multiplot\nset format x ''\nunset xlabel\n", g.to);
    plot_energies(g.to, &e, s->h);
    if (balance >= 0) {
        fputs("undefine $data\n", g.to);
        curves_write_gnuplot_data_block(g.to, s, &balance, &percent, 1);
        plot_balance(g.to, s, &l, history_largest_magnitude(s->h, balance));
        fputs("unset multiplot\n", g.to);
    }
    return gnuplot_close(&g);
}

/* Draws the pictures of the history s, which must have at least two samples, with the title `title`. in_steps: the
 * history has a row for each load step instead of times. Returns FAILED, with a message, if gnuplot fails. */
static status draw_curves(const struct plot_request *r, const char *title, const struct series *s, bool in_steps)
{
    const char *ending = picture_ending[r->format];
    const struct path crack = picture_path(r->pictures, DRAWN_CRACK, ending),
                      energy = picture_path(r->pictures, DRAWN_ENERGY, ending),
                      load = picture_path(r->pictures, DRAWN_LOAD, ending),
                      r_curve = picture_path(r->pictures, DRAWN_R_CURVE, ending);
    TRY(draw_crack((struct output_picture){crack.text, r->format}, title, s));
    TRY(draw_energy((struct output_picture){energy.text, r->format}, title, s));
    TRY(sif_curves_draw(title, s));
    TRY(crack_paths_draw(r->folder, title, s));
    TRY(s->equilibrium
            ? picture_report_not_drawn_and_remove_old(
                  load.text, "a single equilibrium has no curves over time; history.csv has its forces")
            : load_displacement_draw((struct output_picture){load.text, r->format}, title, s->h, s->spacing));
    return in_steps ? r_curve_draw((struct output_picture){r_curve.text, r->format}, r->folder, title, s->h) : OK;
}

status history_curves_draw(const struct plot_request *request, const char *title)
{
    struct history h;
    TRY(history_read(&h, request->folder));
    const bool in_steps = history_find_column(&h, "load_time") >= 0;
    const struct scene *scene = request->projection.scene;
    struct series s = {.h = &h,
                       .time = history_find_column(&h, in_steps ? "step" : "time"),
                       .second = {1, ""},
                       .format = request->format,
                       .pictures = request->pictures,
                       .bar = scene && scene->dim == 1,
                       .spacing = scene ? scene->spacing : 0,
                       .equilibrium = scene && scene_is_single_equilibrium(scene)};
    status result = OK;
    if (s.time >= 0 && h.rows > 1) {
        if (!in_steps) s.second = unit_with_si_prefix_for_largest_value(history_value_at(&h, h.rows - 1, s.time), "s");
        result = draw_curves(request, title, &s, in_steps);
    }
    history_free(&h);
    return result;
}
