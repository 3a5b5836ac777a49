/* A gnuplot process that draws one picture. Commands and binary data are written to its standard input; the picture
 * gets its final name only when it is complete. */
#ifndef CLEAVE_GNUPLOT
#define CLEAVE_GNUPLOT

#include <stdio.h>

#include "output/picture_file.h"

/* Endings of the file names of the picture formats. */
extern const char *const picture_ending[PICTURE_FORMATS];

/* Returns true for the formats of films (plot/film.h), whose single pictures are PNG. */
static inline bool picture_moves(enum picture_format format) { return format >= PICTURE_MP4; }

/* A running gnuplot. */
struct gnuplot {
    FILE *to;         /* standard input of gnuplot */
    FILE *complaints; /* standard error of gnuplot */
    int process;
    enum picture_format format;
    char *aside, *path; /* temporary and final path of the picture */
};

/* Colours of curves in gnuplot's notation, distinguishable with any colour vision (Okabe & Ito 2008). */
enum { CURVE_COLOURS = 7 };
extern const char *const curve_colour[CURVE_COLOURS];

/* Starts gnuplot for the picture `path` of width x height pixels and sends the common style: thin grey axes at the
 * bottom and left, sans-serif font, key outside on the right. FAILED if gnuplot is missing (the message names the
 * package) or cannot be started. Close with gnuplot_close. */
status gnuplot_open(struct gnuplot *g, const char *path, enum picture_format format, int width, int height);

/* Ends the input of gnuplot, waits for the picture, syncs it and renames it to its final path. FAILED with gnuplot's
 * message if the picture is missing or incomplete; an existing picture stays then. */
status gnuplot_close(struct gnuplot *g);

/* Reads the last non-blank line of a program's messages from `from` into text[size]; if there is none, writes `it gave
 * no reason`. */
void complaint_read(FILE *from, char *text, size_t size);

/* Writes `text` as a quoted gnuplot string in which no character has a special meaning. */
void gnuplot_quote(FILE *to, const char *text);

#endif
