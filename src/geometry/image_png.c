/* Reads PNG with libpng, which reports errors by longjmp: what must be freed afterwards is kept in volatile variables
 * outside setjmp. */
#include <png.h>
#include <setjmp.h>
#include <stdio.h>

#include "base/memory.h"
#include "pages.h"

/* Callback of libpng for reading: copies the next n bytes of the file to `to`. Reports an error to libpng if the file
 * ends before. png: state of libpng, which has the file. */
static void bytes_next(png_structp png, png_bytep to, size_t n)
{
    struct geometry_file *file = png_get_io_ptr(png);
    if ((int64_t)n > file->length - file->at) png_error(png, "it is cut off");
    memcpy(to, file->text + file->at, n);
    file->at += (int64_t)n;
}

/* Callback of libpng for errors: stores the message `what` in the state `png` of libpng and jumps back to
 * png_read_pages. */
static void fault_kept(png_structp png, png_const_charp what)
{
    snprintf(png_get_error_ptr(png), 128, "%s", what);
    png_longjmp(png, 1);
}

/* Callback of libpng for warnings: ignores the message `what` in the state `png` of libpng. */
static void warning_dropped(png_structp png, png_const_charp what) { (void)png, (void)what; }

/* Makes libpng convert any kind of image to grey values of 8 or 16 bits, big-endian. png, info: the image, whose header
 * has been read. */
static void make_grey(png_structp png, png_infop info)
{
    const int colour = png_get_color_type(png, info);
    if (colour == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
    if (colour == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png, info) < 8) png_set_expand_gray_1_2_4_to_8(png);
    if (colour & PNG_COLOR_MASK_COLOR) png_set_rgb_to_gray_fixed(png, 1, -1, -1);
    png_set_strip_alpha(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
}

/* Reads the image png, info into a new page of p. file: the file. *rows, *bytes: working memory, which the caller
 * frees, also after a failure. Returns REFUSED, with a message, for an image of another size than the other pages, or
 * of an unsupported kind. */
static status page_read(png_structp png, png_infop info, struct image_pages *p, const struct geometry_file *file,
                        png_bytep *volatile *rows, png_bytep volatile *bytes)
{
    uint16_t *page;
    png_read_info(png, info);
    const int64_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
    TRY(image_pages_append_page(p, file, width, height, &page));
    make_grey(png, info);
    const int64_t row = (int64_t)png_get_rowbytes(png, info);
    const bool wide = png_get_bit_depth(png, info) == 16;
    if (row != width * (wide ? 2 : 1))
        return status_set(REFUSED, "%s: this kind of PNG is not supported; save it with grey values of 8 or 16 bits",
                          file->path);
    *bytes = memory_new_uninitialised("image.rows", row * height, 1);
    *rows = BARE("image.rows", height, png_bytep);
    for (int64_t j = 0; j < height; j++) (*rows)[j] = *bytes + j * row;
    png_read_image(png, *rows);
    for (int64_t k = 0; k < width * height; k++)
        page[k] = wide ? (uint16_t)((*bytes)[2 * k] << 8 | (*bytes)[2 * k + 1]) : (*bytes)[k];
    return OK;
}

status png_read_pages(struct image_pages *p, struct geometry_file *file)
{
    char what[128] = "";
    png_bytep *volatile rows = NULL;
    png_bytep volatile bytes = NULL;
    volatile status result = FAILED;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, what, fault_kept, warning_dropped);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_read_struct(&png, NULL, NULL);
        return status_set(FAILED, "%s: libpng cannot start, probably for lack of memory; free memory and try again",
                          file->path);
    }
    if (setjmp(png_jmpbuf(png)) == 0) {
        png_set_read_fn(png, file, bytes_next);
        png_set_user_limits(png, INT32_MAX, INT32_MAX);
        png_set_chunk_malloc_max(png, 1 << 24);
        result = page_read(png, info, p, file, &rows, &bytes);
    } else {
        text_replace_control_characters(what);
        result = status_set(REFUSED, "%s: the PNG file is incomplete or damaged (%s); save it again", file->path, what);
    }
    memory_free((void *)rows);
    memory_free(bytes);
    png_destroy_read_struct(&png, &info, NULL);
    return result;
}
