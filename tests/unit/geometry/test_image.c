/* Tests images and stacks of images: grey values from every type of PNG and TIFF file, distances from the boundary of
 * voxel solids compared with a search over all pairs of voxels, and damaged files. */
#include <math.h>
#include <png.h>
#include <stdlib.h>
#include <tiffio.h>
#include <unistd.h>

#include "tests/support/near.h"

#include "base/memory.h"
#include "geometry/image.h"
#include "../src/geometry/pages.h"

enum { WIDE = 7, HIGH = 5, MOST = 1 << 16 };

/* Returns the grey value of the pixel in row `row` (0 at the top) and column `column` of page `page` of the test
 * images. */
static int value_at(int row, int column, int page) { return (37 * row + 11 * column + 50 * page + 3) % 256; }

/* Writes the PNG file `name`. kind: colour type of libpng; bits: 1, 8 or 16 per sample. Colour images have three equal
 * samples, palettes have the grey value as an entry. */
static void write_png(const char *name, int kind, int bits)
{
    FILE *file = fopen(name, "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_byte row[8 * WIDE];
    png_color palette[256];
    for (int k = 0; k < 256; k++) palette[k] = (png_color){(png_byte)k, (png_byte)k, (png_byte)k};
    png_init_io(png, file);
    png_set_IHDR(png, info, WIDE, HIGH, bits, kind, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (kind == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 256);
    png_write_info(png, info);
    const int samples = kind == PNG_COLOR_TYPE_RGB_ALPHA    ? 4
                        : kind == PNG_COLOR_TYPE_RGB        ? 3
                        : kind == PNG_COLOR_TYPE_GRAY_ALPHA ? 2
                                                            : 1;
    for (int j = 0; j < HIGH; j++) {
        memset(row, 0, sizeof row);
        for (int i = 0; i < WIDE; i++) {
            const int value = value_at(j, i, 0);
            for (int c = 0; c < samples && bits == 8; c++) row[samples * i + c] = (png_byte)value;
            for (int c = 0; c < samples && bits == 16; c++)
                row[2 * (samples * i + c)] = (png_byte)value, row[2 * (samples * i + c) + 1] = 7;
            if (bits == 1 && value > 127) row[0] = (png_byte)(row[0] | 0x80 >> i);
        }
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

/* Writes the TIFF file `name` of `pages` pages. bits: per sample; samples: per pixel; compression: as in libtiff;
 * white: true if 0 is white (photometric interpretation MINISWHITE). */
static void write_tiff(const char *name, int pages, int bits, int samples, int compression, bool white)
{
    TIFF *tiff = TIFFOpen(name, "w");
    for (int p = 0; p < pages; p++) {
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, WIDE);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, HIGH);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
        const int grey = white ? PHOTOMETRIC_MINISWHITE : PHOTOMETRIC_MINISBLACK;
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, samples > 1 ? PHOTOMETRIC_RGB : grey);
        TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, HIGH);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression);
        for (int j = 0; j < HIGH; j++) {
            uint8_t row[8 * WIDE];
            uint16_t wide[WIDE];
            for (int i = 0; i < WIDE; i++) {
                for (int c = 0; c < samples; c++) row[samples * i + c] = (uint8_t)value_at(j, i, p);
                wide[i] = (uint16_t)(value_at(j, i, p) * 256 + 7);
                if (white) row[i] = UINT8_MAX - row[i], wide[i] = UINT16_MAX - wide[i];
            }
            assert_int_equal(TIFFWriteScanline(tiff, bits == 16 ? (void *)wide : row, (uint32_t)j, 0), 1);
        }
        TIFFWriteDirectory(tiff);
    }
    TIFFClose(tiff);
}

static const real size[] = {2, 2, 3}, from[] = {10, 20, 30};

static void check_values(const char *name, int dim, int pages, int bits)
{
    struct voxels v;
    char path[32], *const paths[] = {path};
    snprintf(path, sizeof path, "%s", name);
    assert_ok(image_read_voxels(&v, 1, paths, dim, size, from));
    assert_int_equal(v.n[0], WIDE), assert_int_equal(v.n[1], HIGH), assert_int_equal(v.n[2], pages);
    for (int p = 0; p < pages; p++)
        for (int j = 0; j < HIGH; j++)
            for (int i = 0; i < WIDE; i++) {
                const int value = value_at(j, i, p);
                const real X[] = {10 + 2 * i + 0.7, 20 + 2 * (HIGH - 1 - j) + 1.2, 30 + 3 * p + 2.9};
                assert_int_equal(voxels_grey_value(&v, X), bits == 16  ? value * 256 + 7
                                                           : bits == 1 ? value / 128 * 255
                                                                       : value);
            }
    assert_int_equal(voxels_grey_value(&v, (real[]){9.9, 25, 31}), -1);
    assert_int_equal(voxels_grey_value(&v, (real[]){12, 30, 31}), -1);
    /* Between two voxels but for round-off: the grey value is that of the upper voxel. */
    assert_int_equal(voxels_grey_value(&v, (real[]){12 - 1e-12, 20, 30}),
                     voxels_grey_value(&v, (real[]){12.5, 20.5, 30.5}));
    voxels_free(&v);
}

static void kinds_of_images(void **state)
{
    (void)state;
    static const struct {
        int kind, bits;
    } png[] = {{PNG_COLOR_TYPE_GRAY, 8},       {PNG_COLOR_TYPE_GRAY, 16},      {PNG_COLOR_TYPE_GRAY, 1},
               {PNG_COLOR_TYPE_RGB, 8},        {PNG_COLOR_TYPE_RGB_ALPHA, 8},  {PNG_COLOR_TYPE_PALETTE, 8},
               {PNG_COLOR_TYPE_RGB, 16},       {PNG_COLOR_TYPE_RGB_ALPHA, 16}, {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
               {PNG_COLOR_TYPE_GRAY_ALPHA, 16}};
    for (size_t k = 0; k < COUNT_OF(png); k++) {
        write_png("a.png", png[k].kind, png[k].bits);
        check_values("a.png", 2, 1, png[k].bits);
    }
    write_tiff("a.tif", 3, 8, 1, COMPRESSION_LZW, false);
    check_values("a.tif", 3, 3, 8);
    write_tiff("a.tif", 2, 16, 1, COMPRESSION_NONE, false);
    check_values("a.tif", 3, 2, 16);
    write_tiff("b.tif", 1, 8, 3, COMPRESSION_NONE, false);
    check_values("b.tif", 2, 1, 8);
    for (int bits = 8; bits <= 16; bits += 8) {
        write_tiff("b.tif", 1, bits, 1, COMPRESSION_NONE, true);
        check_values("b.tif", 2, 1, bits);
    }
}

/* Layout of the samples of a TIFF page. */
struct maps_layout {
    int bits, samples, planar, orientation, format;
    bool tiled, white;
};

/* Returns sample c of the pixel in row j and column i of a file with the layout a. An alpha sample, of 3/8, does not
 * affect the grey value. */
static int sample_at(const struct maps_layout *a, int j, int i, int c)
{
    const bool right = a->orientation == ORIENTATION_TOPRIGHT || a->orientation == ORIENTATION_BOTRIGHT;
    const int row = a->orientation >= ORIENTATION_BOTRIGHT ? HIGH - 1 - j : j, column = right ? WIDE - 1 - i : i;
    const int most = a->bits == 16 ? 65535 : 255;
    const int value = row < 0 || column < 0 || row >= HIGH || column >= WIDE ? 0
                      : a->bits == 16                                        ? value_at(row, column, 0) * 256 + 7
                                                                             : value_at(row, column, 0);
    return a->samples % 2 == 0 && c == a->samples - 1 ? most * 3 / 8 : a->white ? most - value : value;
}

/* Fills row[] with row j of the image or of a 16 x 16 tile, `wide` pixels wide, in the layout a. plane: index of the
 * sample if each sample has its own plane; -1: the samples of a pixel are contiguous. */
static void fill_row(const struct maps_layout *a, uint8_t *row, int j, int wide, int plane)
{
    const int n = plane < 0 ? a->samples : 1;
    for (int i = 0; i < wide; i++)
        for (int c = 0; c < n; c++) {
            const uint16_t value = (uint16_t)sample_at(a, j, i, plane < 0 ? c : plane);
            if (a->bits == 16)
                memcpy(row + 2 * (n * i + c), &value, 2);
            else
                row[n * i + c] = (uint8_t)value;
        }
}

static void write_layout(const char *name, const struct maps_layout *a)
{
    const uint16_t extra = EXTRASAMPLE_UNASSALPHA;
    TIFF *tiff = TIFFOpen(name, "w");
    uint8_t tile[16 * 16 * 8];
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, WIDE);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, HIGH);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, a->bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, a->samples);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
                 a->samples > 2 ? PHOTOMETRIC_RGB
                 : a->white     ? PHOTOMETRIC_MINISWHITE
                                : PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, a->planar);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, a->orientation);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, a->format);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, a->bits == 16 ? COMPRESSION_LZW : COMPRESSION_NONE);
    if (a->samples % 2 == 0) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &extra);
    if (a->tiled)
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 16), TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
    else
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 2);
    for (int c = 0; c < (a->planar == PLANARCONFIG_SEPARATE ? a->samples : 1); c++) {
        const int plane = a->planar == PLANARCONFIG_SEPARATE ? c : -1, wide = a->tiled ? 16 : WIDE;
        const int bytes = wide * (plane < 0 ? a->samples : 1) * a->bits / 8;
        for (int j = 0; j < (a->tiled ? 16 : HIGH); j++) {
            fill_row(a, tile + (a->tiled ? j * bytes : 0), j, wide, plane);
            if (!a->tiled) assert_int_equal(TIFFWriteScanline(tiff, tile, (uint32_t)j, (uint16_t)c), 1);
        }
        if (a->tiled) assert_true(TIFFWriteTile(tiff, tile, 0, 0, 0, (uint16_t)c) > 0);
    }
    TIFFClose(tiff);
}

/* Checks that grey values do not depend on bits per sample, transparency, colour, planes, tiles and order of rows. */
static void layouts_of_tiff(void **state)
{
    (void)state;
    for (int k = 0; k < 2 * 4 * 2 * 2 * 4 * 2; k++) {
        const struct maps_layout a = {.bits = k & 1 ? 16 : 8,
                                      .samples = 1 + k / 2 % 4,
                                      .tiled = k / 8 & 1,
                                      .planar = k / 16 & 1 ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG,
                                      .orientation = 1 + k / 32 % 4,
                                      .white = k / 128 && k / 2 % 4 < 2,
                                      .format = SAMPLEFORMAT_UINT};
        write_layout("a.tif", &a);
        check_values("a.tif", 2, 1, a.bits);
    }
}

/* Checks that signed and floating-point samples, unsupported numbers of bits, and transposed images are refused. */
static void samples_refused(void **state)
{
    (void)state;
    static const struct {
        struct maps_layout layout;
        const char *message;
    } bad[] = {{{.bits = 16, .format = SAMPLEFORMAT_INT},
                "a.tif: pixels are signed values of 16 bits; save unsigned grey values"
                ": add 32768 to each"},
               {{.bits = 8, .format = SAMPLEFORMAT_INT}, "a.tif: pixels are signed values of 8 bits"},
               {{.bits = 16, .format = SAMPLEFORMAT_IEEEFP}, "with fractions"},
               {{.bits = 12, .format = SAMPLEFORMAT_UINT},
                "a.tif: pixels of 12 bits are not supported; save it with grey values of 8 or 16"},
               {{.bits = 32, .format = SAMPLEFORMAT_UINT}, "pixels of 32 bits or with fractions"},
               {{.bits = 8, .format = SAMPLEFORMAT_UINT, .orientation = ORIENTATION_LEFTTOP},
                "its rows are stored as columns"}};
    struct voxels v;
    char name[] = "a.tif", *const paths[] = {name};
    for (size_t k = 0; k < COUNT_OF(bad); k++) {
        struct maps_layout a = bad[k].layout;
        a.samples = 1, a.planar = PLANARCONFIG_CONTIG;
        if (a.orientation == 0) a.orientation = ORIENTATION_TOPLEFT;
        write_layout(name, &a);
        assert_refused(image_read_voxels(&v, 1, paths, 2, size, from), bad[k].message);
    }
}

/* Checks stacks of slices from several files, PNG and TIFF mixed; in 2D only one slice is accepted. */
static void a_stack_of_files(void **state)
{
    (void)state;
    struct voxels v;
    char one[] = "a.png", two[] = "b.tif", *const paths[] = {one, two, one};
    write_png(one, PNG_COLOR_TYPE_GRAY, 8);
    assert_ok(image_read_voxels(&v, 3, paths, 3, size, from));
    assert_int_equal(v.n[2], 3);
    voxels_free(&v);
    assert_refused(image_read_voxels(&v, 2, paths, 2, size, from), "in plane spaces give a single one");
}

static void write_bytes(const char *name, const void *bytes, size_t n)
{
    FILE *file = fopen(name, "wb");
    assert_int_equal(fwrite(bytes, 1, n, file), n);
    fclose(file);
}

static size_t read_bytes(const char *name, unsigned char *bytes)
{
    FILE *file = fopen(name, "rb");
    const size_t n = fread(bytes, 1, MOST, file);
    fclose(file);
    return n;
}

static void refused(const unsigned char *bytes, size_t n, const char *message)
{
    struct voxels v;
    char name[] = "bad.png", *const paths[] = {name};
    write_bytes(name, bytes, n);
    assert_refused(image_read_voxels(&v, 1, paths, 2, size, from), message);
}

static void bad_images(void **state)
{
    (void)state;
    static unsigned char bytes[MOST];
    write_png("a.png", PNG_COLOR_TYPE_GRAY, 8);
    const size_t n = read_bytes("a.png", bytes);
    refused(bytes, n / 2, "bad.png: the PNG file is incomplete or damaged (");
    refused(bytes, 20, "incomplete or damaged (it is cut off)");
    refused((const unsigned char *)"GIF89a", 6, "neither PNG nor TIFF");
    refused((const unsigned char *)"II*\0abcd", 8, "not a TIFF file");
    bytes[20] ^= 1;
    refused(bytes, n, "incomplete or damaged (");
}

/* Compares the signed distance at each voxel centre with a search over all voxels: distance to the centre of the
 * nearest voxel of the other phase (or outside the image), less half a voxel. Also checks the sign at arbitrary
 * positions. */
static void distances(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        struct voxels v = {.dim = dim, .n = {9, 8, dim == 3 ? 6 : 1}, .size = {1, 1, 2}};
        const int64_t all = v.n[0] * v.n[1] * v.n[2];
        v.grey = NEW("test", all, uint16_t);
        for (int64_t k = 0; k < all; k++) v.grey[k] = (uint16_t)(k * k * 7 % 13 < 9 ? 200 : 10);
        struct voxel_solid part = {.of = &v, .ranges = 2, .range = {{100, 199}, {200, 255}}};
        voxel_solid_make_from_grey_value_ranges(&part);
        for (int64_t a = 0; a < all; a++) {
            real X[DIM_MAX], best = INFINITY, normal[DIM_MAX];
            const int64_t at[] = {a % v.n[0], a / v.n[0] % v.n[1], a / v.n[0] / v.n[1]};
            const bool in = v.grey[a] == 200;
            for (int d = 0; d < dim; d++) {
                X[d] = ((real)at[d] + 0.5) * v.size[d];
                if (in)
                    best = real_min(best,
                                    ((real)(at[d] < v.n[d] - 1 - at[d] ? at[d] : v.n[d] - 1 - at[d]) + 1) * v.size[d]);
            }
            for (int64_t b = 0; b < all; b++) {
                const int64_t other[] = {b % v.n[0], b / v.n[0] % v.n[1], b / v.n[0] / v.n[1]};
                real r2 = 0;
                for (int d = 0; d < dim; d++) r2 += square((real)(at[d] - other[d]) * v.size[d]);
                if ((v.grey[b] == 200) != in) best = real_min(best, sqrt(r2));
            }
            assert_near(voxel_solid_signed_distance(&part, X, normal), in ? 0.5 - best : best - 0.5, 1e-6);
        }
        assert_near(voxel_solid_signed_distance(&part, (real[]){-3, 4, 5}, NULL) > 3, 1, 0);
        voxel_solid_free(&part);
        voxels_free(&v);
    }
}

static void damaged(void **state)
{
    (void)state;
    static const char *const names[] = {"a.png", "a.tif", "b.tif"};
    static unsigned char bytes[MOST], copy[MOST];
    uint64_t seed = 7;
    char bad[] = "bad.png", *const paths[] = {bad};
    write_tiff("a.tif", 3, 8, 1, COMPRESSION_LZW, false);
    for (size_t k = 0; k < COUNT_OF(names); k++) {
        const size_t n = read_bytes(names[k], bytes);
        for (int round = 0; round < 700; round++) {
            size_t length = n;
            memcpy(copy, bytes, n);
            for (int change = 0; change < 1 + round % 4; change++) {
                seed = seed * 6364136223846793005u + 1442695040888963407u;
                copy[(seed >> 33) % n] = (unsigned char)(seed >> 56);
            }
            if (round % 5 == 0) length = 1 + (seed >> 35) % n;
            write_bytes(bad, copy, length);
            struct voxels v;
            if (image_read_voxels(&v, 1, paths, 2 + round % 2, size, from) == OK) voxels_free(&v);
        }
    }
}

static char folder[] = "/tmp/cleave_image_XXXXXX";
static int enter_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int leave_folder(void **state)
{
    (void)state;
    unlink("a.png"), unlink("a.tif"), unlink("b.tif"), unlink("bad.png");
    return chdir("/") != 0 || rmdir(folder) != 0;
}

/* Checks the grey values of colours by the luminance weights of ITU-R Rec. 709: green has the largest, blue the
 * smallest. */
static void colours_have_a_luminance(void **state)
{
    (void)state;
    assert_int_equal(luminance(250, 40, 90), 88);
    assert_int_equal(luminance(40, 250, 90), 194);
    assert_int_equal(luminance(40, 90, 250), 91);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kinds_of_images), cmocka_unit_test(a_stack_of_files),
        cmocka_unit_test(bad_images),      cmocka_unit_test(distances),
        cmocka_unit_test(damaged),         cmocka_unit_test(colours_have_a_luminance),
        cmocka_unit_test(layouts_of_tiff), cmocka_unit_test(samples_refused),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
