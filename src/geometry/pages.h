/* Image pages while they are read. */
#ifndef CLEAVE_PAGES
#define CLEAVE_PAGES

#include "data/voxels.h"
#include "source.h"

/* Pages of equal size. */
struct pages {
    int64_t width, height, n; /* pixels per row; rows; number of pages */
    uint16_t *grey;           /* [n][height][width], top row first */
};

/* Appends a page and sets *page to its first value; the caller fills it. REFUSED: size differs from earlier pages, or
 * too large for the file (at most 1100-fold compression) or for memory. */
status pages_add(struct pages *p, const struct source *s, int64_t width, int64_t height, uint16_t **page);

/* Returns the luminance of a colour (Rec. 709). */
int luminance(int red, int green, int blue);

/* Appends the image of a PNG file. REFUSED: malformed or of an unsupported kind. The caller frees p->grey, also after a
 * failure. */
status png_read_pages(struct pages *p, struct source *s);

/* Appends all pages of a TIFF file; failures and ownership as for png_read_pages. */
status tiff_read_pages(struct pages *p, struct source *s);

#endif
