/* Computes the axes of the pictures of a study: their range, whether they are logarithmic, tics and digits of their
 * numbers. */
#include <math.h>
#include <stdio.h>

#include "study_picture.h"

/* An axis is logarithmic if its values are positive and the largest is at least DECADES times the smallest.
 * DIGITS_LEAST, DIGITS_MOST: limits of the number of significant digits at an axis. */
enum { DECADES = 100, DIGITS_LEAST = 4, DIGITS_MOST = 12 };

/* STEPS_MOST: largest number of intervals between the tics (labelled marks) of a horizontal axis. TICS_UP: least
 * distance of the tics of a vertical axis [pixel]. */
enum { STEPS_MOST = 4, TICS_UP = 31 };

/* Largest deviation of the distances between values, relative to the distance, at which the values count as evenly
 * spaced [1]. */
static const double EVEN = 1e-6;

/* Margin of an axis at either end, as a fraction of the range of its values, or of the logarithm of this range [1]. */
static const double MARGIN = 0.06;

double study_picture_horizontal_position_of_value(const struct study_picture *p, int value_index)
{
    const char *unit;
    return p->numbers ? value_text_split_number_and_unit(p->key[p->across].shown.value[value_index], &unit)
                      : value_index;
}

/* Returns true if panel number `panel` of the picture p has a point at value v (from 0) of the key along the horizontal
 * axis. */
static bool value_is_drawn(const struct study_picture *p, int panel, int v)
{
    const int values = p->key[p->across].shown.values;
    for (int l = 0; l < p->lines; l++)
        if (p->point[panel][l * values + v].runs > 0) return true;
    return false;
}

/* Returns true if the values of an axis from `low` to `high` are positive and extend over two decades. */
static bool over_decades(double low, double high) { return low > 0 && high >= DECADES * (1 - EVEN) * low; }

/* Returns the horizontal axis of panel number `panel` of the picture p for the values of the key along it: for all of
 * them if `all` is true, else for those that have points in the panel. */
static struct study_axis axis_of_values(const struct study_picture *p, int panel, bool all)
{
    struct study_axis axis = {INFINITY, -INFINITY, false};
    double before = NAN, distance = NAN;
    bool even = true;
    for (int v = 0; v < p->key[p->across].shown.values; v++) {
        if (!all && !value_is_drawn(p, panel, v)) continue;
        const double here = study_picture_horizontal_position_of_value(p, v), step = here - before;
        if (!isnan(step) && !isnan(distance)) even = even && fabs(step - distance) <= EVEN * fabs(distance);
        distance = step, before = here;
        axis.low = fmin(axis.low, here), axis.high = fmax(axis.high, here);
    }
    axis.logarithmic = p->numbers && !even && over_decades(axis.low, axis.high);
    return axis;
}

struct study_axis study_panel_get_horizontal_axis(const struct study_picture *p, int panel)
{
    const struct study_axis all = axis_of_values(p, panel, true);
    return all.logarithmic ? all : axis_of_values(p, panel, false);
}

struct study_axis study_panel_get_vertical_axis(const struct study_picture *p, int panel)
{
    struct study_axis axis = {INFINITY, -INFINITY, false};
    study_panel_find_range_of_plotted_values(p, panel, &axis.low, &axis.high);
    axis.logarithmic = over_decades(axis.low, axis.high);
    return axis;
}

/* Returns the distance between the tics (labelled marks) of an axis, for a logarithmic axis the factor between them.
 * Returns 0 if all values are equal or there are none. most: largest number of intervals between tics. */
static double tic_step(const struct study_axis *axis, int most)
{
    if (!(axis->high > axis->low)) return 0;
    if (axis->logarithmic) return pow(10, fmax(ceil(log10(axis->high / axis->low) / most), 1));
    return axis_tick_distance(axis->high - axis->low, most);
}

static double first_power_of_ten(const struct study_axis *axis) { return pow(10, ceil(log10(axis->low) - EVEN)); }

/* Returns the number of significant digits with which the numbers at the tics (labelled marks) of an axis are distinct.
 * most: largest number of intervals between tics. */
static int digits_of(const struct study_axis *axis, int most)
{
    const double step = tic_step(axis, most), largest = fmax(fabs(axis->low), fabs(axis->high));
    if (!(step > 0) || axis->logarithmic) return DIGITS_LEAST;
    return (int)fmin(fmax(1 + floor(log10(largest) + EVEN) - floor(log10(step) + EVEN), DIGITS_LEAST), DIGITS_MOST);
}

int study_axis_longest_tick_label_length(const struct study_axis *axis, int max_intervals)
{
    const int digits = digits_of(axis, max_intervals);
    const double step = tic_step(axis, max_intervals);
    int longest = 0;
    for (int k = 0; k <= max_intervals && axis->high >= axis->low; k++) {
        const double at = axis->logarithmic ? first_power_of_ten(axis) * pow(step, k)
                          : step > 0        ? (ceil(axis->low / step) + k) * step
                                            : axis->low;
        if (at <= axis->high) longest = (int)fmax(longest, snprintf(NULL, 0, "%.*g", digits, at));
    }
    return longest;
}

int study_panel_max_vertical_axis_intervals(const struct study_picture *p) { return (int)fmax(p->high / TICS_UP, 2); }

int study_panel_max_horizontal_axis_intervals(const struct study_picture *p, const struct study_axis *axis)
{
    int most = STEPS_MOST;
    while (most > 1 &&
           most * (study_axis_longest_tick_label_length(axis, most) + 2) * study_picture_character_width_in_pixels() >
               p->wide)
        most--;
    return most;
}

/* Sends the range of the axis called `name` (`x`, `y` or `cb`, the colour bar) to gnuplot's input stream. A
 * logarithmic axis and a horizontal one get the range of the data extended by a margin, the colour bar without margin.
 * Of other linear axes gnuplot chooses the range, except that a vertical axis whose data begin at 0 begins at 0. */
static void range_send(FILE *gnuplot, const char *name, const struct study_axis *axis)
{
    const double margin = *name == 'c' ? 0 : MARGIN * log10(axis->high / axis->low);
    if (axis->logarithmic)
        fprintf(gnuplot, "set %srange [%.10g:%.10g]\n", name, axis->low * pow(10, -margin),
                axis->high * pow(10, margin));
    else if (*name == 'x' && axis->high > axis->low)
        fprintf(gnuplot, "set xrange [%.15g:%.15g]\n", axis->low - MARGIN * (axis->high - axis->low),
                axis->high + MARGIN * (axis->high - axis->low)); /* gnuplot would include values without a result */
    else if (*name != 'x' && axis->low == 0)
        fprintf(gnuplot, "set %srange [0:*]\n", name);
    else
        fprintf(gnuplot, "set %srange [*:*]\n", name);
}

void study_axis_write_to_gnuplot(FILE *gnuplot, const char *name, const struct study_axis *axis, int max_intervals)
{
    const double step = tic_step(axis, max_intervals);
    fprintf(gnuplot, "unset logscale %s\n", name);
    range_send(gnuplot, name, axis);
    if (axis->logarithmic) fprintf(gnuplot, "set logscale %s\n", name);
    fprintf(gnuplot, "set format %s '%%.%dg'\nset %stics norotate ", name, digits_of(axis, max_intervals), name);
    if (axis->logarithmic)
        fprintf(gnuplot, "%.10g,%.10g\n", first_power_of_ten(axis), step);
    else if (step > 0)
        fprintf(gnuplot, "%.10g\n", step);
    else
        fputs("autofreq\n", gnuplot);
}
