/* Films: PNG pictures of all frames, encoded by ffmpeg. */
#ifndef CLEAVE_FILM
#define CLEAVE_FILM

#include "plot/plot.h"

/* Checks that ffmpeg can be started. REFUSED, with a message that names the package, if it cannot. */
status film_possible(void);

/* Draws one picture per cloud and encodes the pictures as a film, sheet.path. title, map, view: as for maps_draw. The
 * pictures are drawn in a temporary folder beside the film, which is removed. FAILED if gnuplot or ffmpeg fails. */
status film_draw(struct sheet sheet, const char *title, enum map map, const struct view *view,
                 const struct cloud *cloud, int clouds);

#endif
