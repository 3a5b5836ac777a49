/* TIFF by libtiff, from the bytes of the file: pages of grey values of 8 or 16 bits, others by their colours. */
#include <stdio.h>
#include <tiffio.h>

#include "base/memory.h"
#include "pages.h"

/* ---- libtiff reads from memory ----------------------------------------------------------------------------------- */

static tmsize_t tiff_take(thandle_t handle, void *to, tmsize_t n)
{
    struct source *s = handle;
    const int64_t rest = s->length - s->at, taken = n < rest ? n : rest;
    if (taken <= 0) return 0;
    array_copy(to, s->text + s->at, taken, 1);
    s->at += taken;
    return taken;
}

static tmsize_t tiff_write(thandle_t handle, void *from, tmsize_t n)
{
    (void)handle, (void)from, (void)n;
    return -1;
}

static toff_t tiff_seek(thandle_t handle, toff_t offset, int whence)
{
    struct source *s = handle;
    const int64_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? s->at : s->length, to = base + (int64_t)offset;
    if (to < 0 || to > s->length) return (toff_t)-1;
    s->at = to;
    return (toff_t)to;
}

static int tiff_close(thandle_t handle) { return (void)handle, 0; }
static toff_t tiff_size(thandle_t handle) { return (toff_t)((struct source *)handle)->length; }

/* ---- pages ------------------------------------------------------------------------------------------------------- */

static int tag_of(TIFF *tiff, uint32_t tag)
{
    uint16_t value = 0;
    return TIFFGetFieldDefaulted(tiff, tag, &value) ? value : 0;
}

/* Rows of single grey values of one or two bytes, in strips. */
static bool plain_rows(TIFF *tiff, int bits, int64_t width)
{
    return (bits == 8 || bits == 16) && tag_of(tiff, TIFFTAG_SAMPLESPERPIXEL) == 1 && !TIFFIsTiled(tiff) &&
           tag_of(tiff, TIFFTAG_PHOTOMETRIC) <= PHOTOMETRIC_MINISBLACK && TIFFScanlineSize(tiff) == width * bits / 8;
}

static bool rows_read(TIFF *tiff, uint16_t *page, int64_t width, int64_t height, int bits)
{
    const bool white = tag_of(tiff, TIFFTAG_PHOTOMETRIC) == PHOTOMETRIC_MINISWHITE;
    uint8_t *row = memory_bare("image.row", TIFFScanlineSize(tiff), 1);
    bool good = true;
    for (int64_t j = 0; j < height && good; j++) {
        good = TIFFReadScanline(tiff, row, (uint32_t)j, 0) == 1;
        for (int64_t i = 0; i < width && good; i++) {
            uint16_t grey = row[bits == 8 ? i : 0];
            if (bits == 16) memcpy(&grey, row + 2 * i, 2);
            page[j * width + i] = white ? (uint16_t)((bits == 8 ? UINT8_MAX : UINT16_MAX) - grey) : grey;
        }
    }
    memory_free(row);
    return good;
}

static bool colours_read(TIFF *tiff, uint16_t *page, int64_t width, int64_t height)
{
    uint32_t *colour = BARE("image.colours", width * height, uint32_t);
    const bool good =
        TIFFReadRGBAImageOriented(tiff, (uint32_t)width, (uint32_t)height, colour, ORIENTATION_TOPLEFT, 1);
    for (int64_t k = 0; k < width * height && good; k++) {
        const int red = TIFFGetR(colour[k]), green = TIFFGetG(colour[k]), blue = TIFFGetB(colour[k]);
        page[k] = (uint16_t)luminance(red, green, blue);
    }
    memory_free(colour);
    return good;
}

static status tiff_page(TIFF *tiff, struct pages *p, const struct source *s)
{
    uint32_t width = 0, height = 0;
    uint16_t *page;
    const int bits = tag_of(tiff, TIFFTAG_BITSPERSAMPLE), format = tag_of(tiff, TIFFTAG_SAMPLEFORMAT);
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
    if (format == SAMPLEFORMAT_IEEEFP || bits > 16)
        return status_set(REFUSED, "%s: values of %d bits or with fractions; grey values of 8 or 16 bits are expected",
                          s->path, bits);
    TRY(pages_add(p, s, width, height, &page));
    const bool good = plain_rows(tiff, bits, width) ? rows_read(tiff, page, width, height, bits)
                                                    : colours_read(tiff, page, width, height);
    return good ? OK
                : status_set(REFUSED, "%s: page %lld cannot be read; it is cut off or of a kind that is not read",
                             s->path, (long long)p->n);
}

status tiff_read_pages(struct pages *p, struct source *s)
{
    TIFFSetErrorHandler(NULL), TIFFSetWarningHandler(NULL);
    TIFF *tiff = TIFFClientOpen(s->path, "rm", s, tiff_take, tiff_write, tiff_seek, tiff_close, tiff_size, NULL, NULL);
    status result = tiff ? OK : status_set(REFUSED, "%s: no TIFF", s->path);
    while (result == OK) {
        result = tiff_page(tiff, p, s);
        if (result != OK || !TIFFReadDirectory(tiff)) break;
    }
    if (tiff) TIFFClose(tiff);
    return result;
}
