/* Axes of the pictures of a study. */
#ifndef CLEAVE_STUDY_AXIS
#define CLEAVE_STUDY_AXIS

#include <stdbool.h>
#include <stdio.h>

/* Axis of a panel: its smallest and largest value, INFINITY and -INFINITY if there is none; whether it is logarithmic,
 * as axes of positive values over more than two decades are. */
struct study_axis {
    double low, high;
    bool logarithmic;
};

/* Returns the number of characters of the longest number at the axis if its tics divide it into at most `most`
 * intervals. */
int study_axis_number_length(const struct study_axis *axis, int most);

/* Sends kind (linear or logarithmic), range, tics and format of the numbers of an axis to gnuplot, with so many digits
 * that the numbers are distinct. name: `x`, `y`, or `cb` for the colour bar of a map; most: largest number of intervals
 * between tics. */
void study_axis_send(FILE *gnuplot, const char *name, const struct study_axis *axis, int most);

#endif
