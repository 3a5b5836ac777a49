/* A gnuplot that draws one picture: commands and binary data go down a pipe, the picture appears under its
 * name only when it is whole. */
#ifndef CLEAVE_GNUPLOT
#define CLEAVE_GNUPLOT

#include <stdio.h>

#include "output/picture_file.h"

extern const char *const picture_ending[PICTURE_FORMATS];
/* The last two are films of PNG pictures (plot/film.h). */
static inline bool picture_moves(enum picture_format format) { return format >= PICTURE_MP4; }

struct gnuplot {
    FILE *to;         /* its standard input */
    FILE *complaints; /* its standard error */
    int process;
    enum picture_format format;
    char *aside, *path; /* name while it is drawn, name when it is whole */
};

/* Colours that people with any colour vision tell apart (Okabe & Ito 2008), as gnuplot writes them. */
enum { CURVE_COLOURS = 7 };
extern const char *const curve_colour[CURVE_COLOURS];

/* Starts gnuplot on the picture `path`, `width` x `height` pixels, in the house style: thin grey axes below and
 * left, clean font, key outside on the right. FAILED: gnuplot is missing (the message names the package) or
 * cannot be started. */
status gnuplot_open(struct gnuplot *g, const char *path, enum picture_format format, int width, int height);

/* Waits for the picture, syncs it and gives it its name. FAILED with gnuplot's own complaint if there is none, or if it
 * is cut short; an older picture stays then. */
status gnuplot_close(struct gnuplot *g);

/* Reads the last line that is not blank of what a program has printed to `from`; if there is none, `it gave no reason`.
 */
void complaint_read(FILE *from, char *text, size_t size);

/* Writes `text` as a gnuplot string of its own: nothing in it is interpreted. */
void gnuplot_quote(FILE *to, const char *text);

#endif
