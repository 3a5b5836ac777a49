/* Parts of pictures with panels that hold an image. */
#ifndef CLEAVE_MAPS_PARTS
#define CLEAVE_MAPS_PARTS

#include "plot/plot.h"

struct layout {
    int columns, rows;
    int panel_width, panel_height; /* [pixel] */
    int width, height;
    int right; /* room for the colour bar or the key [pixel] */
};

/* Margins of a panel whose upper left corner is there [pixel]. */
void panel_place(FILE *to, const struct layout *l, double left, double above);
/* Tics and labels of a flat panel in this column; `lowest`: no panel is below. */
void panel_axes(FILE *to, const struct layout *l, const struct view *view, const struct cloud *c,
                const struct unit *metre, int column, bool lowest);
/* A panel that is not flat has axes that lead away from its lower left corner, and a length for comparison. */
void panel_directions(FILE *to, const struct layout *l, const struct view *view, const struct cloud *c,
                      const struct unit *metre);
/* Plots an image whose lower left corner is `from`, with pixels of size `step`, and over it `more` elements, each with
 * a comma before it. */
void panel_image(FILE *to, const struct colour *pixel, int width, int height, const double *from, const double *step,
                 const char *more);

#endif
