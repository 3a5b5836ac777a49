/* Counts blank edges of pictures. `test_margins FILE...` prints a line for each PNG: the number of blank pixels at its
 * left, right, upper and lower edge, its width and its height [pixels]. Text that is cut off leaves 0 blank pixels.
 * Without a file the program tests itself. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>
#include <png.h>

/* A pixel is ink if its smallest channel of red, green and blue is below this value, so that light grey counts as
 * blank. */
#define INK 235

struct margins {
    unsigned left, right, upper, lower, width, height;
};

/* Returns the margins of the picture pixel[4 width height], 4 bytes a pixel: red, green, blue and opacity. The four
 * margins are 0 if the picture has no ink. */
static struct margins margins_of(const uint8_t *pixel, unsigned width, unsigned height)
{
    struct margins m = {width, width, height, height, width, height};
    for (unsigned y = 0; y < height; y++)
        for (unsigned x = 0; x < width; x++, pixel += 4) {
            if (pixel[0] >= INK && pixel[1] >= INK && pixel[2] >= INK) continue;
            if (x < m.left) m.left = x;
            if (width - 1 - x < m.right) m.right = width - 1 - x;
            if (y < m.upper) m.upper = y;
            if (height - 1 - y < m.lower) m.lower = height - 1 - y;
        }
    if (m.left == width) m.left = m.right = m.upper = m.lower = 0;
    return m;
}

/* Reads the PNG `path` and stores the margins of its picture in *m. Returns 0, or prints the error and returns -1. */
static int margins_of_file(const char *path, struct margins *m)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, path)) return printf("%s: %s\n", path, image.message), -1;
    image.format = PNG_FORMAT_RGBA;
    uint8_t *pixel = malloc(PNG_IMAGE_SIZE(image));
    const int read = pixel && png_image_finish_read(&image, NULL, pixel, 0, NULL);
    if (read)
        *m = margins_of(pixel, image.width, image.height);
    else
        printf("%s: %s\n", path, image.message);
    png_image_free(&image);
    free(pixel);
    return read ? 0 : -1;
}

/* Checks the margins of a white picture of 9 x 7 pixels with two pixels of ink and one of light grey, which is blank. A
 * truncated file must not be read. */
static void margins_are_those_of_the_ink(void **state)
{
    char path[] = "/tmp/test_margins.XXXXXX";
    const int fd = mkstemp(path);
    uint8_t pixel[7 * 9 * 3];
    png_image image = {.version = PNG_IMAGE_VERSION, .width = 9, .height = 7, .format = PNG_FORMAT_RGB};
    struct margins m;
    (void)state;
    assert_true(fd >= 0);
    close(fd);
    memset(pixel, 255, sizeof pixel);
    memset(pixel, 240, 3);
    pixel[3 * (9 * 1 + 4)] = 0;       /* row 1, column 4 */
    pixel[3 * (9 * 3 + 2) + 1] = 200; /* row 3, column 2 */
    assert_true(png_image_write_to_file(&image, path, 0, pixel, 0, NULL));
    assert_int_equal(margins_of_file(path, &m), 0);
    const struct margins wanted = {2, 4, 1, 3, 9, 7};
    assert_memory_equal(&m, &wanted, sizeof m);
    memset(pixel, 255, sizeof pixel);
    assert_true(png_image_write_to_file(&image, path, 0, pixel, 0, NULL));
    assert_int_equal(margins_of_file(path, &m), 0);
    assert_int_equal(m.left + m.right + m.upper + m.lower, 0);
    assert_int_equal(truncate(path, 50), 0);
    assert_int_equal(margins_of_file(path, &m), -1);
    unlink(path);
}

int main(int argc, char **argv)
{
    static const struct CMUnitTest tests[] = {cmocka_unit_test(margins_are_those_of_the_ink)};
    int bad = 0;
    if (argc < 2) return cmocka_run_group_tests(tests, NULL, NULL);
    for (int k = 1; k < argc; k++) {
        struct margins m;
        if (margins_of_file(argv[k], &m))
            bad = 1;
        else
            printf("%u %u %u %u %u %u\n", m.left, m.right, m.upper, m.lower, m.width, m.height);
    }
    return bad;
}
