/* Tests drawing of particle lists with two spacings, of long rigid bodies, and of narrow cracks, by counting pixels. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <cmocka.h>

#include <math.h>

#include "base/memory.h"
#include "plot/plot.h"
#include "tests/support/frame_block.h"

enum { PIXELS = 120, FINE = 8 * PIXELS };

/* Paints `plotted` into a picture of a square of edge 2 x `half` around the origin [m]. Returns the number of pixels
 * with a particle. */
static int painted_around(const struct plotted_particles *plotted, double half)
{
    struct colour *pixel = NEW("test.pixel", PIXELS * PIXELS, struct colour);
    const struct view v = {.from = {-half, -half}, .to = {half, half}, .top = 1};
    int painted = 0;
    image_paint_particles_in_plane(pixel, PIXELS, PIXELS, &v, plotted, MAP_DAMAGE);
    for (int q = 0; q < PIXELS * PIXELS; q++) painted += pixel[q].alpha > 0;
    memory_free(pixel);
    return painted;
}

/* Rearranges the block f of 20 x 30 particles as a graded list: 20 x 20 at half the spacing left of the middle, 10 x 10
 * at the full spacing right of it. Sets f->n to their number. */
static void block_grade(struct output_frame *f)
{
    int64_t n = 0;
    for (int k = 0; k < 20 * 20; k++, n++)
        f->X[0][n] = (k % 20 - 19.5) * 0.5 * SPACING, f->X[1][n] = (k / 20 - 9.5) * 0.5 * SPACING;
    for (int k = 0; k < 10 * 10; k++, n++) f->X[0][n] = (k % 10 + 0.5) * SPACING, f->X[1][n] = (k / 10 - 4.5) * SPACING;
    f->n = n;
}

/* Checks that a list whose left half has half the spacing is drawn without gaps and within 3 % of its area. Without a
 * list in the scene, the same particles are drawn with one size. */
static void graded_lists_are_closed(void **state)
{
    (void)state;
    char file[] = "graded.csv";
    struct scene_body body = {.file = file};
    struct scene scene = {.dim = 2, .bodies = 1, .body = &body};
    struct output_frame f = block_make(20, 30, 1, 2);
    struct plotted_particles c;
    block_grade(&f);
    plotted_particles_select_from_frame(&c, &f, &(struct projection){.normal = -1, .scene = &scene});
    assert_int_equal(painted_around(&c, 4.5 * SPACING), PIXELS * PIXELS);
    const double body_pixels = 20.0 * 10 / (24 * 24) * PIXELS * PIXELS;
    assert_true(fabs(painted_around(&c, 12 * SPACING) - body_pixels) < 0.03 * body_pixels);
    for (int64_t i = 0; i < c.n; i++) assert_true(fabs(c.size[i] - (f.X[0][i] < 0 ? 0.5 : 1) * SPACING) < 1e-8);
    plotted_particles_free(&c);
    scene.bodies = 0;
    plotted_particles_select_from_frame(&c, &f, &(struct projection){.normal = -1, .scene = &scene});
    assert_null(c.size);
    plotted_particles_free(&c), frame_free(&f);
}

/* Checks that pictures of one frame and of six show the same part of a rigid plate much longer than the body, 0.3 of
 * the width of the body on each side. A section through a solid that misses the plate is not enlarged by it. */
static void long_rigid_bodies_are_cut_off(void **state)
{
    (void)state;
    static struct solid plate = {.kind = SOLID_BOX, .from = {-1, -8e-3, -9e-3}, .to = {1, -6e-3, -6e-3}};
    static const struct region shape = {.n = 1, .solid = &plate};
    for (int dim = 2; dim < 4; dim++) {
        struct output_frame f = block_make(10, 10, dim == 2 ? 1 : 4, dim);
        struct plotted_particles c, six[6];
        plotted_particles_select_from_frame(&c, &f, NULL);
        const struct view alone = view_make_around_particles(&c, 1);
        struct plotted_rigid_body *r = NEW("test.rigid", 1, struct plotted_rigid_body);
        *r = (struct plotted_rigid_body){.shape = &shape, .at.turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        r->bounded = region_compute_bounding_box_if_finite(&shape, dim, r->low, r->high);
        c.dim = dim, c.rigids = 1, c.rigid = r;
        for (int k = 0; k < 6; k++) six[k] = c;
        const struct view one = view_make_around_particles(&c, 1), all = view_make_around_particles(six, 6);
        assert_true(one.from[0] == all.from[0] && one.to[0] == all.to[0]);
        const double more = dim == 2 ? 0.3 * (alone.to[0] - alone.from[0]) : 0;
        assert_true(fabs(all.to[0] - alone.to[0] - more) < 1e-9);
        plotted_particles_free(&c), frame_free(&f);
    }
}

/* Checks that a crack through broken bonds that opens by 0.16 spacings is drawn with that width. A pre-crack at the
 * same position, whose faces are drawn as lines, is drawn open from 0.08 spacings. */
static void narrow_cracks_are_open(void **state)
{
    (void)state;
    real end[2][DIM_MAX] = {{-16e-3, 0}, {16e-3, 0}};
    struct crack slit = {.n = 2, .corner = end};
    struct scene scene = {.dim = 2, .cracks = 1, .crack = &slit};
    struct colour *pixel = NEW("test.pixel", FINE * FINE, struct colour);
    for (int k = 0; k < 3; k++) {
        struct output_frame f = block_make(30, 30, 1, 2);
        struct plotted_particles c;
        int blank = 0;
        const bool cut = k > 0;
        const double open = k == 2 ? 0.08 : 0.16;
        for (int64_t i = 0; i < f.n; i++) {
            f.u[1][i] = f.X[1][i] > 0 ? (float)(open * SPACING) : 0;
            f.damage[i] = fabs(f.X[1][i]) < SPACING ? 0.4F : 0;
        }
        scene.cracks = cut;
        plotted_particles_select_from_frame(&c, &f, &(struct projection){.normal = -1, .scene = &scene});
        const struct view v = {
            .from = {-14e-3, -14e-3}, .to = {14e-3, 14e-3}, .top = 1, .notches = cut, .notch = &slit};
        image_paint_particles_in_plane(pixel, FINE, FINE, &v, &c, MAP_DAMAGE);
        for (int q = 0; q < FINE * FINE; q++) blank += !pixel[q].alpha;
        assert_true(fabs((double)blank / FINE - (open * FINE / 28 - 1)) < 1.1); /* of a gap, less half a pixel a face */
        plotted_particles_free(&c), frame_free(&f);
    }
    memory_free(pixel);
}

/* Checks a crack that opens by 0.1 to 0.4 spacings, less than a pixel at 2.1 pixels per spacing. No pixel is blank, so
 * that it does not look dotted; at eight times the resolution many pixels are. */
static void gaps_below_a_pixel_are_closed(void **state)
{
    (void)state;
    struct colour *pixel = NEW("test.pixel", FINE * FINE, struct colour);
    struct output_frame f = block_make(30, 30, 1, 2);
    struct plotted_particles c;
    for (int64_t i = 0; i < f.n; i++) {
        f.u[1][i] = f.X[1][i] > 0 ? (float)(0.25 * SPACING + 0.01 * f.X[0][i]) : 0;
        f.damage[i] = fabs(f.X[1][i]) < SPACING ? 0.4F : 0;
    }
    plotted_particles_select_from_frame(&c, &f, NULL);
    const struct view v = {.from = {-14e-3, -14e-3}, .to = {14e-3, 14e-3}, .top = 1};
    for (int size = 60; size <= 480; size *= 8) {
        int blank = 0;
        image_paint_particles_in_plane(pixel, size, size, &v, &c, MAP_DAMAGE);
        for (int q = 0; q < size * size; q++) blank += !pixel[q].alpha;
        assert_true(size == 60 ? blank == 0 : blank > size);
    }
    memory_free(pixel), plotted_particles_free(&c), frame_free(&f);
}

/* Checks that both faces of an oblique pre-crack that opens by 1.5 spacings are drawn straight. The area of blank
 * pixels between them is right to 5 %, and fewer than five pixels elsewhere are wrong. */
static void oblique_cracks_are_open(void **state)
{
    (void)state;
    const double open = 1.5 * SPACING;
    real end[2][DIM_MAX] = {{-16e-3, -8e-3}, {16e-3, 8e-3}};
    struct crack slit = {.n = 2, .corner = end};
    struct scene scene = {.dim = 2, .cracks = 1, .crack = &slit};
    struct colour *pixel = NEW("test.pixel", FINE * FINE, struct colour);
    struct output_frame f = block_make(30, 30, 1, 2);
    struct plotted_particles c;
    int wrong = 0, blank = 0;
    for (int64_t i = 0; i < f.n; i++) f.u[1][i] = f.X[1][i] > 0.5 * f.X[0][i] ? (float)open : 0;
    plotted_particles_select_from_frame(&c, &f, &(struct projection){.normal = -1, .scene = &scene});
    const struct view v = {.from = {-10e-3, -10e-3}, .to = {10e-3, 10e-3}, .top = 1, .notches = 1, .notch = &slit};
    image_paint_particles_in_plane(pixel, FINE, FINE, &v, &c, MAP_DAMAGE);
    for (int q = 0; q < FINE * FINE; q++) {
        const double x = (q % FINE + 0.5) * 20e-3 / FINE - 10e-3, y = (q / FINE + 0.5) * 20e-3 / FINE - 10e-3;
        const double above = (y - 0.5 * x) / open; /* 0 on the lower face, 1 on the upper one */
        blank += !pixel[q].alpha;
        if (fabs(above) > 0.1 && fabs(above - 1) > 0.1)
            wrong += pixel[q].alpha ? above > 0 && above < 1 : above < 0 || above > 1;
    }
    assert_true(fabs(blank * 20e-3 / FINE / FINE / open - 1) < 0.05);
    assert_true(wrong < 5);
    memory_free(pixel), plotted_particles_free(&c), frame_free(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(graded_lists_are_closed), cmocka_unit_test(long_rigid_bodies_are_cut_off),
        cmocka_unit_test(narrow_cracks_are_open),  cmocka_unit_test(gaps_below_a_pixel_are_closed),
        cmocka_unit_test(oblique_cracks_are_open),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
