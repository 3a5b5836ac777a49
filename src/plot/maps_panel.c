/* Draws the panels of pictures of maps: frame, axes and image. */
#include <math.h>
#include <stdio.h>

#include "curves_parts.h"
#include "maps_parts.h"

/* Least distance of the tics (labelled marks) of a vertical axis, in usual and in narrow pictures [pixel]. */
enum { TICS_Y = 36, TICS_Y_NARROW = 22 };
/* Printf format of the numbers at axes, with many digits, because the coordinates of a small body far from the origin
 * differ only in the last ones. */
#define TIC_NUMBERS "%.9g"
enum { NUMBERS_APART = 14, NUMBERS_APART_LEAST = 8 };     /* blank between numbers of a horizontal axis [pixel] */
enum { BESIDE_NUMBERS = 50, BESIDE_NUMBERS_NARROW = 44 }; /* label of a vertical axis beside its numbers [pixel] */

void plot_box_write_margins(FILE *gnuplot, const struct maps_layout *layout, double left_edge, double upper_edge,
                            double width, double height)
{
    fprintf(gnuplot, "set lmargin at screen %.9g\nset rmargin at screen %.9g\n", left_edge / layout->width,
            (left_edge + width) / layout->width);
    fprintf(gnuplot, "set tmargin at screen %.9g\nset bmargin at screen %.9g\n", 1 - upper_edge / layout->height,
            1 - (upper_edge + height) / layout->height);
}

void panel_write_margins(FILE *gnuplot, const struct maps_layout *l, double left_edge, double upper_edge)
{
    plot_box_write_margins(gnuplot, l, left_edge, upper_edge, l->panel_width, l->panel_height);
}

void panel_write_image(FILE *gnuplot, const struct colour *pixel, int pixel_columns, int pixel_rows,
                       const double *lower_left_corner, const double *pixel_size, const char *further_plot_elements)
{
    fprintf(gnuplot,
            "plot '-' binary array=(%d,%d) dx=%.12g dy=%.12g origin=(%.12g,%.12g) format='%%uchar' "
            "with rgbimage notitle%s\n",
            pixel_columns, pixel_rows, pixel_size[0], pixel_size[1], lower_left_corner[0] + 0.5 * pixel_size[0],
            lower_left_corner[1] + 0.5 * pixel_size[1], further_plot_elements);
    for (int64_t q = 0; q < (int64_t)pixel_columns * pixel_rows; q++)
        fwrite((uint8_t[]){pixel[q].red, pixel[q].green, pixel[q].blue}, 1, 3, gnuplot);
}

double axis_longest_tic_number_width(double low, double high, double tics, const char *format)
{
    int longest = 0;
    for (double k = ceil(low / tics - 1e-6); k * tics <= high; k++) {
        char number[32];
        const int length = snprintf(number, sizeof number, format, fabs(k) < 0.5 ? 0 : k * tics);
        if (length > longest) longest = length;
    }
    return (picture_size_is_too_narrow_for_side_legend() ? 7.4 : 9) * longest;
}

/* Returns the number of tics (labelled marks of an axis) from `low` to `high`, placed at all multiples of `tics`. */
static double tics_within(double low, double high, double tics) { return floor(high / tics) - ceil(low / tics) + 1; }

double horizontal_axis_choose_tic_distance(double low, double high, double axis_width)
{
    double apart = 20, tics = axis_choose_tic_distance(high - low, axis_width, apart);
    const double pixels = axis_width / (high - low);
    while (apart < axis_width &&
           axis_longest_tic_number_width(low, high, tics, TIC_NUMBERS) + NUMBERS_APART > tics * pixels)
        tics = axis_choose_tic_distance(high - low, axis_width, apart *= 1.3);
    if (tics_within(low, high, tics) > 1) return tics;
    const double single = tics;
    while (apart > 1 && tics_within(low, high, tics) < 2)
        tics = axis_choose_tic_distance(high - low, axis_width, apart /= 1.3);
    if (tics_within(low, high, 2 * tics) > 1) tics *= 2;
    const bool touch =
        axis_longest_tic_number_width(low, high, tics, TIC_NUMBERS) + NUMBERS_APART_LEAST > tics * pixels;
    return touch && tics_within(low, high, single) > 0 ? single : tics;
}

struct unit panel_choose_length_unit_of_axes(const struct view *v)
{
    return unit_for_length(fmax(v->to[0] - v->from[0], v->to[1] - v->from[1]));
}

/* Ends of an axis of a panel and distance of its tics, in the unit of the axis. */
struct panel_scale {
    double low, high, tics;
};

static struct panel_scale panel_scale_of(const struct view *v, int axis, double length)
{
    const double factor = panel_choose_length_unit_of_axes(v).factor;
    struct panel_scale s = {v->from[axis] / factor, v->to[axis] / factor, 0};
    s.tics = axis == 0
                 ? horizontal_axis_choose_tic_distance(s.low, s.high, length)
                 : axis_choose_tic_distance(s.high - s.low, length,
                                            picture_size_is_too_narrow_for_side_legend() ? TICS_Y_NARROW : TICS_Y);
    return s;
}

double panel_horizontal_axis_longest_number_width(const struct view *view, double width)
{
    const struct panel_scale s = panel_scale_of(view, 0, width);
    return axis_longest_tic_number_width(s.low, s.high, s.tics, TIC_NUMBERS);
}

double panel_vertical_axis_labels_width(const struct view *view, double height)
{
    const struct panel_scale s = panel_scale_of(view, 1, height);
    return axis_longest_tic_number_width(s.low, s.high, s.tics, TIC_NUMBERS) +
           (picture_size_is_too_narrow_for_side_legend() ? BESIDE_NUMBERS_NARROW : BESIDE_NUMBERS);
}

void panel_write_axes(FILE *gnuplot, const struct maps_layout *l, const struct view *view,
                      const struct plotted_particles *particles, const struct unit *axis_unit, int column,
                      bool is_lowest)
{
    const int size[2] = {l->panel_width, l->panel_height};
    for (int k = 0; k < 2; k++) {
        const bool labelled = k == 0 ? is_lowest : column == 0;
        fprintf(gnuplot, "set %ctics %.9g format '%s'\nset %clabel '", 'x' + k, panel_scale_of(view, k, size[k]).tics,
                labelled ? TIC_NUMBERS : "", 'x' + k);
        if (labelled) fprintf(gnuplot, "%c [%s]", 'x' + particles->axis[k], axis_unit->name);
        fputs("'\n", gnuplot);
    }
}

void panel_write_axis_arrows(FILE *gnuplot, const struct maps_layout *l, const struct view *view,
                             const struct plotted_particles *particles, const struct unit *axis_unit, double left_edge,
                             double upper_edge)
{
    const double pixel = (view->to[0] - view->from[0]) / axis_unit->factor / l->panel_width, x = left_edge + 34;
    const double y = l->height - (upper_edge + l->panel_height + 46); /* above the lower edge of the picture [pixel] */
    const double length = axis_choose_tic_distance(300 * pixel, 300, 60) / pixel;
    const double end = fmax(left_edge + l->panel_width - 8, x + 60 + length); /* beside the arrows */
    for (int d = 0; d < 3; d++) {
        const double arrow[2] = {26 * particles->camera.right[d], 26 * particles->camera.up[d]};
        if (hypot(arrow[0], arrow[1]) < 2) continue;
        fprintf(
            gnuplot,
            "set arrow from screen %.6g,%.6g to screen %.6g,%.6g size screen 0.006,20 front lw 1.3 lc rgb '#333333'\n"
            "set label %d '%c' at screen %.6g,%.6g center front font ',11' textcolor rgb '#333333'\n",
            x / l->width, y / l->height, (x + arrow[0]) / l->width, (y + arrow[1]) / l->height, 40 + d, 'x' + d,
            (x + 1.45 * arrow[0]) / l->width, (y + 1.45 * arrow[1]) / l->height);
    }
    fprintf(
        gnuplot,
        "set arrow from screen %.6g,%.6g to screen %.6g,%.6g heads size screen 0.004,90 front lw 1.3 lc rgb '#333333'\n"
        "set label 43 '%.4g %s' at screen %.6g,%.6g center front font ',11' textcolor rgb '#333333'\n",
        (end - length) / l->width, (y + 10) / l->height, end / l->width, (y + 10) / l->height, length * pixel,
        axis_unit->name, (end - 0.5 * length) / l->width, (y + 22) / l->height);
}
