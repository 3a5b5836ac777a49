/* Reads TIFF with libtiff from the bytes in memory. Pages with 8 or 16 bits per sample, grey or RGB, are read by
 * sample; others (palettes, fewer bits, YCbCr) as RGBA with 8 bits. */
#include <stdio.h>
#include <tiffio.h>

#include "base/memory.h"
#include "pages.h"

/* ---- callbacks that let libtiff read from memory ----------------------------------------------------------------- */

/* Callback of libtiff for reading: copies up to n bytes of the file `handle` to `to`. Returns their number, 0 at the
 * end of the file. */
static tmsize_t tiff_take(thandle_t handle, void *to, tmsize_t n)
{
    struct geometry_file *file = handle;
    const int64_t rest = file->length - file->at, taken = n < rest ? n : rest;
    if (taken <= 0) return 0;
    array_copy(to, file->text + file->at, taken, 1);
    file->at += taken;
    return taken;
}

/* Callback of libtiff for writing n bytes, which never happens. Ignores all arguments and returns -1, for failure. */
static tmsize_t tiff_write(thandle_t handle, void *from, tmsize_t n)
{
    (void)handle, (void)from, (void)n;
    return -1;
}

/* Callback of libtiff for seeking: sets the reading position of the file `handle`. whence: origin of the offset
 * (SEEK_SET, SEEK_CUR, SEEK_END). Returns the position, or -1 if it is outside the file. */
static toff_t tiff_seek(thandle_t handle, toff_t offset, int whence)
{
    struct geometry_file *file = handle;
    const int64_t base = whence == SEEK_SET   ? 0
                         : whence == SEEK_CUR ? file->at
                                              : file->length,
                  to = base + (int64_t)offset;
    if (to < 0 || to > file->length) return (toff_t)-1;
    file->at = to;
    return (toff_t)to;
}

/* Callback of libtiff for closing the file `handle`. Does nothing and returns 0, since the caller owns the bytes. */
static int tiff_close(thandle_t handle) { return (void)handle, 0; }

/* Returns the size of the file `handle` [byte], as the callback of libtiff for this. */
static toff_t tiff_size(thandle_t handle) { return (toff_t)((struct geometry_file *)handle)->length; }

/* ---- pages ------------------------------------------------------------------------------------------------------- */

/* Returns the value of the 16-bit tag `tag` of the current page of `tiff`. If the page does not have the tag, returns
 * its default, or 0 without a default. */
static int tag_of(TIFF *tiff, uint32_t tag)
{
    uint16_t value = 0;
    return TIFFGetFieldDefaulted(tiff, tag, &value) ? value : 0;
}

enum { SAMPLES_MOST = 64, TILE_MOST = 1 << 22 }; /* samples per pixel; pixels of a tile of a small image */

/* Describes how the samples (grey or colour values) of one page of a TIFF file are stored. Made by samples_of from the
 * tags of the page; integers are values of the TIFF format. */
struct samples {
    int bits, format, photometric, count,
        orientation;       /* bits and type of a sample; meaning; samples per pixel; order */
    bool tiled, separate;  /* stored in tiles; each sample in its own plane */
    int64_t width, height; /* size of the page [pixel] */
};

/* Returns the layout of the samples of the current page of `tiff`, from its tags. */
static struct samples samples_of(TIFF *tiff)
{
    uint32_t width = 0, height = 0;
    uint16_t photometric = PHOTOMETRIC_MINISBLACK;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
    return (struct samples){.bits = tag_of(tiff, TIFFTAG_BITSPERSAMPLE),
                            .format = tag_of(tiff, TIFFTAG_SAMPLEFORMAT),
                            .photometric = photometric,
                            .count = tag_of(tiff, TIFFTAG_SAMPLESPERPIXEL),
                            .orientation = tag_of(tiff, TIFFTAG_ORIENTATION),
                            .tiled = TIFFIsTiled(tiff),
                            .separate = tag_of(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE,
                            .width = width,
                            .height = height};
}

/* Returns how many samples per pixel of a page with the layout a are read directly: 1 for grey, 3 for RGB (further ones
 * are transparency). Returns 0 for another kind, which libtiff converts to RGBA. */
static int samples_used(const struct samples *a)
{
    const int used = a->photometric <= PHOTOMETRIC_MINISBLACK ? 1 : a->photometric == PHOTOMETRIC_RGB ? 3 : 0;
    return (a->bits == 8 || a->bits == 16) && a->count >= used ? used : 0;
}

/* Returns REFUSED, with a message, unless the samples a of a page are unsigned integers of up to 16 bits that are
 * stored row by row. path: file of the page, for messages. */
static status check_samples(const struct samples *a, const char *path)
{
    if (a->format == SAMPLEFORMAT_IEEEFP || a->format == SAMPLEFORMAT_COMPLEXIEEEFP || a->bits > 16)
        return status_set(
            REFUSED,
            "%s: pixels of %d bits or with fractions are not supported; save it with grey values of 8 or 16 bits", path,
            a->bits);
    if (a->format == SAMPLEFORMAT_INT || a->format == SAMPLEFORMAT_COMPLEXINT)
        return status_set(REFUSED, "%s: pixels are signed values of %d bits; save unsigned grey values: add %d to each",
                          path, a->bits, 1 << (a->bits - 1));
    if (a->bits != 1 && a->bits != 2 && a->bits != 4 && a->bits != 8 && a->bits != 16)
        return status_set(REFUSED, "%s: pixels of %d bits are not supported; save it with grey values of 8 or 16 bits",
                          path, a->bits);
    if (a->bits == 16 && samples_used(a) == 0)
        return status_set(REFUSED,
                          "%s: an image with 16 bits must be grey or RGB, and this one is neither; save it as grey or "
                          "RGB, or with 8 bits",
                          path);
    if (a->orientation >= ORIENTATION_TOPLEFT && a->orientation <= ORIENTATION_BOTLEFT) return OK;
    return status_set(REFUSED, "%s: its rows are stored as columns (TIFF orientation %d); save it row by row", path,
                      a->orientation);
}

/* Pixel values of one page of a TIFF file while the page is read, and their layout in the file (`of`). Exists only in
 * samples_read. */
struct planes {
    const struct samples *of;
    int used;         /* samples per pixel that are kept */
    uint16_t *sample; /* [used][height][width], top row first, left to right */
};

/* Stores n pixels of row y of the file, from column x on, in p->sample, with the orientation of the page applied. from:
 * the pixels, `stride` samples each; first: number of the first sample in `from` (0 red, 1 green, 2 blue). */
static void planes_take(struct planes *p, const void *from, int64_t x, int64_t y, int64_t n, int stride, int first)
{
    const struct samples *a = p->of;
    const bool right = a->orientation == ORIENTATION_TOPRIGHT || a->orientation == ORIENTATION_BOTRIGHT;
    const bool bottom = a->orientation == ORIENTATION_BOTLEFT || a->orientation == ORIENTATION_BOTRIGHT;
    const uint8_t *narrow = from;
    const uint16_t *wide = from;
    for (int64_t i = 0; i < n && x + i < a->width && y < a->height; i++)
        for (int c = 0; c < stride && first + c < p->used; c++) {
            const int64_t column = right ? a->width - 1 - x - i : x + i, row = bottom ? a->height - 1 - y : y;
            const int value = a->bits == 8 ? narrow[stride * i + c] : wide[stride * i + c];
            p->sample[((first + c) * a->height + row) * a->width + column] = (uint16_t)value;
        }
}

/* Reads all rows or tiles of the current page of `tiff` into p->sample. stride: samples per pixel in the rows of the
 * file; first: number of the sample of a pixel (0 red, 1 green, 2 blue) with which the rows begin. Returns false if the
 * file is malformed. */
static bool planes_read(TIFF *tiff, struct planes *p, int stride, int first)
{
    const struct samples *a = p->of;
    uint32_t wide = (uint32_t)a->width, high = 1;
    if (a->tiled && !(TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &wide) && TIFFGetField(tiff, TIFFTAG_TILELENGTH, &high)))
        return false;
    if (a->count > SAMPLES_MOST || (int64_t)wide * high > 4 * a->width * a->height + TILE_MOST) return false;
    const int64_t bytes = (int64_t)wide * stride * a->bits / 8;
    const int64_t size = a->tiled ? TIFFTileSize(tiff) : TIFFScanlineSize(tiff);
    if (wide == 0 || high == 0 || size < bytes * high) return false;
    uint8_t *buffer = memory_new_uninitialised("image.row", size, 1);
    bool good = true;
    for (int64_t y = 0; y < a->height && good; y += high)
        for (int64_t x = 0; x < a->width && good; x += wide) {
            good = a->tiled ? TIFFReadTile(tiff, buffer, (uint32_t)x, (uint32_t)y, 0, (uint16_t)first) > 0
                            : TIFFReadScanline(tiff, buffer, (uint32_t)y, (uint16_t)first) == 1;
            for (uint32_t row = 0; row < high && good; row++)
                planes_take(p, buffer + row * bytes, x, y + row, wide, stride, first);
        }
    memory_free(buffer);
    return good;
}

/* Fills page[height * width] with the grey values of the current page of `tiff`, whose samples a can be read directly
 * (grey or RGB). Returns false if the file is malformed. */
static bool samples_read(TIFF *tiff, uint16_t *page, const struct samples *a)
{
    const int64_t size = a->width * a->height;
    const int most = a->bits == 8 ? UINT8_MAX : UINT16_MAX;
    struct planes p = {.of = a, .used = samples_used(a)};
    p.sample = p.used == 1 ? page : BARE("image.colours", p.used * size, uint16_t);
    bool good = a->separate || planes_read(tiff, &p, a->count, 0);
    for (int c = 0; c < p.used && a->separate && good; c++) good = planes_read(tiff, &p, 1, c);
    for (int64_t k = 0; k < size && good; k++) {
        if (p.used == 3) page[k] = (uint16_t)luminance(p.sample[k], p.sample[size + k], p.sample[2 * size + k]);
        if (a->photometric == PHOTOMETRIC_MINISWHITE) page[k] = (uint16_t)(most - page[k]);
    }
    if (p.used == 3) memory_free(p.sample);
    return good;
}

/* Fills page[height * width] with the grey values of the current page of `tiff`, which libtiff converts to RGBA first.
 * Returns false if the file is malformed. */
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

/* Appends the current page of `tiff` to the pages p. file: the file. Returns REFUSED, with a message, if its samples
 * are not supported or it is malformed. */
static status tiff_page(TIFF *tiff, struct image_pages *p, const struct geometry_file *file)
{
    const struct samples a = samples_of(tiff);
    uint16_t *page;
    TRY(check_samples(&a, file->path));
    TRY(image_pages_append_page(p, file, a.width, a.height, &page));
    const bool good = samples_used(&a) > 0 ? samples_read(tiff, page, &a) : colours_read(tiff, page, a.width, a.height);
    return good ? OK
                : status_set(REFUSED,
                             "%s: page %lld cannot be read, because the file is cut off, or compressed by a method "
                             "that libtiff lacks; save it uncompressed",
                             file->path, (long long)p->n);
}

status tiff_read_pages(struct image_pages *p, struct geometry_file *file)
{
    TIFFSetErrorHandler(NULL), TIFFSetWarningHandler(NULL);
    TIFF *tiff =
        TIFFClientOpen(file->path, "rm", file, tiff_take, tiff_write, tiff_seek, tiff_close, tiff_size, NULL, NULL);
    status result =
        tiff ? OK : status_set(REFUSED, "%s: the file is damaged, or not a TIFF file; save it again", file->path);
    while (result == OK) {
        result = tiff_page(tiff, p, file);
        if (result != OK || !TIFFReadDirectory(tiff)) break;
    }
    if (tiff) TIFFClose(tiff);
    return result;
}
