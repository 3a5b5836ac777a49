/* Panels of pictures that contain an image. */
#ifndef CLEAVE_MAPS_PARTS
#define CLEAVE_MAPS_PARTS

#include "plot/plot.h"

/* Arrangement of the panels of a picture. */
struct layout {
    int columns, rows;
    int panel_width, panel_height; /* [pixel] */
    int width, height;             /* size of the picture [pixel] */
    int right;                     /* width of the colour bar or key on the right [pixel] */
};

/* Sets the margins of a panel from the position of its upper left corner [pixel]. */
void panel_place(FILE *to, const struct layout *l, double left, double above);

/* Sets tics and labels of a flat panel. metre: unit of the axes. column: column of the panel; lowest: there is no panel
 * below it. */
void panel_axes(FILE *to, const struct layout *l, const struct view *view, const struct cloud *c,
                const struct unit *metre, int column, bool lowest);

/* Draws the axes of an outside view as arrows at the lower left corner of the panel, and a bar of known length. */
void panel_directions(FILE *to, const struct layout *l, const struct view *view, const struct cloud *c,
                      const struct unit *metre);

/* Plots an image. from: its lower left corner; step: size of a pixel, both in units of the axes. more: further elements
 * of the plot command, each preceded by a comma. */
void panel_image(FILE *to, const struct colour *pixel, int width, int height, const double *from, const double *step,
                 const char *more);

#endif
