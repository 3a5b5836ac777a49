/* Panels of pictures that contain an image. */
#ifndef CLEAVE_MAPS_PARTS
#define CLEAVE_MAPS_PARTS

#include "plot/plot.h"

/* Size of a picture with panels in rows and columns, and where the panels are in it. */
struct layout {
    int columns, rows;
    int panel_width, panel_height; /* [pixel] */
    int width, height;             /* size of the picture [pixel] */
    int left, above, below, gap;   /* margins of the panels; distance of columns [pixel] */
    int right;                     /* width of the colour bar or key on the right [pixel] */
};

/* Writes the gnuplot commands that set the margins of one panel of a picture. The size of the panel is that of the
 * layout. left, above: distances of its upper left corner from the left and the upper edge of the picture [pixel]. */
void panel_write_margins(FILE *to, const struct layout *layout, double left, double above);

/* Writes the gnuplot commands for tics and labels of a panel that shows a plane body or a slice. c: particles of the
 * panel; metre: unit of the axes; column: column of the panel, from 0 (the vertical axis has labels in column 0 only);
 * lowest: true if no panel is below it, so that its lower axis has labels. */
void panel_write_axes(FILE *to, const struct layout *layout, const struct view *view, const struct plotted_particles *c,
                      const struct unit *metre, int column, bool lowest);

/* Writes the gnuplot commands that draw, below a panel with a view of a three-dimensional body from outside, its
 * coordinate axes as arrows and a bar of known length. metre: unit of the axes of the panel; left, above: distances of
 * its upper left corner from the left and upper edge of the picture [pixel]. */
void panel_write_axis_arrows(FILE *to, const struct layout *layout, const struct view *view,
                             const struct plotted_particles *c, const struct unit *metre, double left, double above);

/* Writes the gnuplot commands and data that plot the image pixel[height * width], rows from bottom to top. from[2]:
 * lower left corner of the image; step[2]: width and height of a pixel, both in units of the axes. more: further
 * elements of the plot command, each preceded by a comma, or "". */
void panel_write_image(FILE *to, const struct colour *pixel, int width, int height, const double *from,
                       const double *step, const char *more);

#endif
