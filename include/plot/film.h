/* Films: PNG pictures of all frames, joined by ffmpeg. */
#ifndef CLEAVE_FILM
#define CLEAVE_FILM

#include "plot/plot.h"

/* REFUSED where ffmpeg is missing: one line that says so. */
status film_possible(void);
/* One picture a cloud in a folder of its own beside the film, which is removed. */
status film_draw(struct sheet sheet, const char *title, enum map map, const struct view *view,
                 const struct cloud *cloud, int clouds);

#endif
