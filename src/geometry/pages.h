/* Declares the pages (images) of an image file or stack as grey values, and the readers of PNG and TIFF files. */
#ifndef CLEAVE_PAGES
#define CLEAVE_PAGES

#include "data/voxels.h"
#include "source.h"

/* Pages of an image or image stack as grey values, all of equal size. */
struct image_pages {
    int64_t width, height, n; /* pixels per row; rows; number of pages */
    uint16_t *grey;           /* [n][height][width], top row first */
};

/* Appends a page (one image of a stack) of width x height pixels to p and sets *grey_values to the first grey value of
 * the page; the caller fills the page. file: image file, for the message. Returns REFUSED, with a message, if the size
 * differs from that of earlier pages, or is too large for a file of this length (compressed at most 1100-fold) or for
 * the memory. */
status image_pages_append_page(struct image_pages *p, const struct geometry_file *file, int64_t width, int64_t height,
                               uint16_t **grey_values);

/* Returns the grey value (luminance) of a colour with the components `red`, `green` and `blue`, on the scale of these,
 * by the weights of ITU-R Rec. 709. */
int luminance(int red, int green, int blue);

/* Appends the image in the PNG file `file` to p as a page (one image of a stack). Returns REFUSED, with a message, if
 * the file is malformed or of an unsupported kind, FAILED if the PNG library cannot start. The caller releases p->grey
 * with memory_free, also after a failure. */
status png_read_pages(struct image_pages *p, struct geometry_file *file);

/* Appends all pages (images of a stack) of the TIFF file `file` to p. Returns REFUSED, with a message, if the file is
 * malformed or of an unsupported kind. The caller releases p->grey with memory_free, also after a failure. */
status tiff_read_pages(struct image_pages *p, struct geometry_file *file);

#endif
