/* Declares the axes of the pictures of a study. */
#ifndef CLEAVE_STUDY_AXIS
#define CLEAVE_STUDY_AXIS

#include <stdbool.h>
#include <stdio.h>

/* Axis of a panel of a picture. low, high: smallest and largest value, INFINITY and -INFINITY if there is none;
 * logarithmic: the scale is logarithmic, as for positive values over two decades and more. */
struct study_axis {
    double low, high;
    bool logarithmic;
};

/* Returns the number of characters of the longest number that is written at the tics of `axis`, if the tics divide the
 * axis into at most `max_intervals` intervals. */
int study_axis_longest_tick_label_length(const struct study_axis *axis, int max_intervals);

/* Sends kind (linear or logarithmic), range, tics and format of the numbers of an axis to gnuplot, with so many digits
 * that the numbers are distinct. name: `x`, `y`, or `cb` for the colour bar of a map; max_intervals: largest number of
 * intervals between tics. */
void study_axis_write_to_gnuplot(FILE *gnuplot, const char *name, const struct study_axis *axis, int max_intervals);

#endif
