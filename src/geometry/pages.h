/* Pages of images while they are read. */
#ifndef CLEAVE_PAGES
#define CLEAVE_PAGES

#include "data/voxels.h"
#include "source.h"

struct pages {
    int64_t width, height, n; /* of all; how many */
    uint16_t *grey;           /* [n][height][width], the upper row first */
};

/* Room for one more page; *page: its first value. REFUSED: another size than before, or too large for the file, which
 * compression does not make more than a thousand times smaller, or for the memory. */
status pages_add(struct pages *p, const struct source *s, int64_t width, int64_t height, uint16_t **page);
/* Rec. 709 */
int luminance(int red, int green, int blue);

status png_read_pages(struct pages *p, struct source *s);
status tiff_read_pages(struct pages *p, struct source *s);

#endif
