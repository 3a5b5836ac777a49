/* Boxes, axes and images of the panels of pictures of maps. */
#include <math.h>
#include <stdio.h>

#include "curves_parts.h"
#include "maps_parts.h"

/* Least distance of tics of the vertical axis [pixel]. */
enum { TICS_Y = 36, TICS_Y_NARROW = 22 };

void box_write_margins(FILE *to, const struct layout *l, double left, double above, double width, double height)
{
    fprintf(to, "set lmargin at screen %.9g\nset rmargin at screen %.9g\n", left / l->width, (left + width) / l->width);
    fprintf(to, "set tmargin at screen %.9g\nset bmargin at screen %.9g\n", 1 - above / l->height,
            1 - (above + height) / l->height);
}

void panel_write_margins(FILE *to, const struct layout *l, double left_edge, double above)
{
    box_write_margins(to, l, left_edge, above, l->panel_width, l->panel_height);
}

void panel_write_image(FILE *to, const struct colour *pixel, int width, int height, const double *from,
                       const double *step, const char *further_elements)
{
    fprintf(to,
            "plot '-' binary array=(%d,%d) dx=%.12g dy=%.12g origin=(%.12g,%.12g) format='%%uchar' "
            "with rgbalpha notitle%s\n",
            width, height, step[0], step[1], from[0] + 0.5 * step[0], from[1] + 0.5 * step[1], further_elements);
    fwrite(pixel, sizeof *pixel, (size_t)width * (size_t)height, to);
}

double numbers_width(double low, double high, double tics, const char *format)
{
    int longest = 0;
    for (double k = ceil(low / tics - 1e-6); k * tics <= high; k++) {
        char number[32];
        const int length = snprintf(number, sizeof number, format, fabs(k) < 0.5 ? 0 : k * tics);
        if (length > longest) longest = length;
    }
    return (picture_is_too_narrow_for_key() ? 7.4 : 9) * longest;
}

/* Returns the number of multiples of `tics` between `low` and `high`. */
static double tics_within(double low, double high, double tics) { return floor(high / tics) - ceil(low / tics) + 1; }

double tics_across(double low, double high, double pixels)
{
    double apart = 20, tics = tic_distance(high - low, pixels, apart);
    while (apart < pixels && numbers_width(low, high, tics, "%g") + 14 > tics / (high - low) * pixels)
        tics = tic_distance(high - low, pixels, apart *= 1.3);
    if (tics_within(low, high, tics) > 1) return tics;
    while (apart > 1 && tics_within(low, high, tics) < 2) tics = tic_distance(high - low, pixels, apart /= 1.3);
    return tics_within(low, high, 2 * tics) < 2 ? tics : 2 * tics;
}

void panel_write_axes(FILE *to, const struct layout *l, const struct view *view, const struct plotted_particles *c,
                      const struct unit *metre, int column, bool lowest)
{
    const int size[2] = {l->panel_width, l->panel_height};
    for (int k = 0; k < 2; k++) {
        const double low = view->from[k] / metre->factor, high = view->to[k] / metre->factor;
        const bool labelled = k == 0 ? lowest : column == 0;
        const double tics =
            k == 0 ? tics_across(low, high, size[0])
                   : tic_distance(high - low, size[1], picture_is_too_narrow_for_key() ? TICS_Y_NARROW : TICS_Y);
        fprintf(to, "set %ctics %.9g format '%s'\nset %clabel '", 'x' + k, tics, labelled ? "%g" : "", 'x' + k);
        if (labelled) fprintf(to, "%c [%s]", 'x' + c->axis[k], metre->name);
        fputs("'\n", to);
    }
}

void panel_write_axis_arrows(FILE *to, const struct layout *l, const struct view *view,
                             const struct plotted_particles *c, const struct unit *metre, double left_edge,
                             double above)
{
    const double pixel = (view->to[0] - view->from[0]) / metre->factor / l->panel_width, x = left_edge + 34;
    const double y = l->height - (above + l->panel_height + 46); /* above the lower edge of the picture [pixel] */
    const double length = tic_distance(300 * pixel, 300, 60) / pixel;
    const double end = fmax(left_edge + l->panel_width - 8, x + 60 + length); /* beside the arrows */
    for (int d = 0; d < 3; d++) {
        const double arrow[2] = {26 * c->camera.right[d], 26 * c->camera.up[d]};
        if (hypot(arrow[0], arrow[1]) < 2) continue;
        fprintf(
            to,
            "set arrow from screen %.6g,%.6g to screen %.6g,%.6g size screen 0.006,20 front lw 1.3 lc rgb '#333333'\n"
            "set label %d '%c' at screen %.6g,%.6g center front font ',11' textcolor rgb '#333333'\n",
            x / l->width, y / l->height, (x + arrow[0]) / l->width, (y + arrow[1]) / l->height, 40 + d, 'x' + d,
            (x + 1.45 * arrow[0]) / l->width, (y + 1.45 * arrow[1]) / l->height);
    }
    fprintf(
        to,
        "set arrow from screen %.6g,%.6g to screen %.6g,%.6g heads size screen 0.004,90 front lw 1.3 lc rgb '#333333'\n"
        "set label 43 '%.4g %s' at screen %.6g,%.6g center front font ',11' textcolor rgb '#333333'\n",
        (end - length) / l->width, (y + 10) / l->height, end / l->width, (y + 10) / l->height, length * pixel,
        metre->name, (end - 0.5 * length) / l->width, (y + 22) / l->height);
}
