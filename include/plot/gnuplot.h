/* A gnuplot process that draws one picture. Commands and binary data are written to its standard input; the picture
 * gets its final name only when it is complete. */
#ifndef CLEAVE_GNUPLOT
#define CLEAVE_GNUPLOT

#include <stdio.h>

#include "output/picture_file.h"

/* Endings of the file names of the picture formats, such as "png"; index: enum picture_format. */
extern const char *const picture_ending[PICTURE_FORMATS];

/* Returns true if `format` is a format of films (plot/film.h), which are made from PNG pictures of single frames. */
static inline bool picture_format_is_video(enum picture_format format) { return format >= PICTURE_MP4; }

/* A running gnuplot process that draws one picture. */
struct gnuplot {
    FILE *to;         /* standard input of gnuplot */
    FILE *complaints; /* standard error of gnuplot */
    int process;
    enum picture_format format;
    bool untitled;      /* its title is empty (gnuplot_write_title), so that panels begin at its upper edge */
    int width, height;  /* size of the picture in which positions are given [pixel] */
    char *aside, *path; /* temporary and final path of the picture */
};

/* Colours of the curves of a picture, in gnuplot's notation. They can be distinguished with any colour vision (Okabe &
 * Ito 2008). */
enum { CURVE_COLOURS = 7 };
extern const char *const curve_colour[CURVE_COLOURS];

/* Finds the picture format whose file names have the ending `ending`, such as png, and stores it in *format. Returns
 * false if no format has this ending. */
bool picture_format_find_by_ending(enum picture_format *format, const char *ending);

/* Size of all pictures that this process draws, and the format of those of studies. */
struct picture_size {
    enum picture_format format; /* of pictures of studies; those of runs have their own */
    int width, height; /* [pixel]; 0: the usual size of each picture; height 0 beside a width: what each needs */
    double dpi;        /* pixels of a PNG per inch, at PICTURE_DPI pixels of its size */
};

/* Resolution for which pictures are laid out [pixel per inch]: a picture of 1000 pixels is as wide as a text page, with
 * letters of the size of the text. */
enum { PICTURE_DPI = 144 };

/* Sets the size of all pictures that this process draws from now on. size: width and height [pixel], resolution and,
 * for pictures of studies, the format. */
void picture_size_set_process_wide(struct picture_size size);

/* Returns the size that picture_size_set_process_wide has set; width and height are 0 if it was not called. */
struct picture_size picture_size_get_process_wide(void);

/* Starts gnuplot to draw the picture `path` of `format`, width x height pixels, and stores the process in *g. A size
 * that was set by picture_size_set_process_wide replaces width and height. Sends the style common to all pictures: thin
 * grey axes at the bottom and left, sans-serif font, key outside on the right. Returns REFUSED if the path has control
 * characters or is a file that must not be replaced, FAILED if gnuplot cannot be started. Close g with gnuplot_close.
 */
status gnuplot_open(struct gnuplot *g, const char *path, enum picture_format format, int width, int height);

/* Starts gnuplot to draw the picture `path` of `format`, which is laid out for width x height pixels, and stores the
 * process in *g. If a size was set by picture_size_set_process_wide, the whole picture, letters and lines included, is
 * scaled from width x height to that size. Sends the style common to all pictures. Returns REFUSED if the path has
 * control characters or is a file that must not be replaced, FAILED if gnuplot cannot be started. Close g with
 * gnuplot_close. */
status gnuplot_open_scaled_to_process_wide_size(struct gnuplot *g, const char *path, enum picture_format format,
                                                int width, int height);

/* Returns the number of pixels with which an image inside a picture of `format` is computed along an edge that takes
 * `layout_pixels` pixels in the layout of the picture. It is larger for pictures of a finer resolution, and for vector
 * formats, since these are enlarged by viewers. */
int gnuplot_image_pixel_count_along_edge(enum picture_format format, int layout_pixels);

/* Returns true if the picture size set by picture_size_set_process_wide is too narrow for a key (legend) beside the
 * panels, so that the key must be below them. */
bool picture_size_is_too_narrow_for_side_legend(void);

/* Returns the estimated width of the first `byte_count` bytes of `text` (UTF-8) in pixels, divided by the size of the
 * letters in points. The estimate uses mean widths of classes of letters of Helvetica. In narrow pictures, where
 * letters are drawn smaller than stated, the estimate is reduced accordingly. */
double text_estimate_width_in_pixels_per_font_point(const char *text, size_t byte_count);

/* Returns REFUSED, with a message, if no font of this machine has a letter of the title `text`: gnuplot would draw
 * another letter instead. Returns OK if all letters are available, or if the list of fonts (program fc-list) is not. */
status fonts_check_letters_of_title_available(const char *text);

/* Writes the commands for the title `text` of the picture to g. The title begins `left_margin` pixels from the left
 * edge of the picture. It is broken into two lines if it is too long for one line of letters of legible size. */
void gnuplot_write_title(struct gnuplot *g, const char *text, double left_margin);

/* Ends the input of the gnuplot process g, waits until the picture is complete, and renames it from its temporary name
 * to its final path. Returns FAILED if gnuplot is missing (the message names the package to install), or if the picture
 * is missing or incomplete (the message contains that of gnuplot). An existing picture at the final path then
 * remains. */
status gnuplot_close(struct gnuplot *g);

/* Copies the last line that is not blank from `file`, a file with the error messages of a program, to text[size], cut
 * to size - 1 bytes. Writes `it gave no reason` if there is no such line. The file is read from its beginning. */
void program_error_output_read_last_line(FILE *file, char *text, size_t size);

/* Writes `text` to the file `file` as a quoted gnuplot string in which no character has a special meaning. */
void gnuplot_write_quoted_string(FILE *file, const char *text);

#endif
