/* Tests pictures by the values and pixels that are drawn. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "run/ledger.h"
#include "plot/plot.h"
#include "plot/scene_picture.h"
#include "scene/words.h"
#include "tests/support/frame_block.h"

static float value_of(struct output_frame *f, const char *name)
{
    const struct plot_field *field;
    float *value = NULL;
    assert_int_equal(plot_field_find_by_name(&field, name, f->dim), OK);
    assert_int_equal(plot_field_read(&value, field, f, "nowhere"), OK);
    const float first = value[0];
    memory_free(value);
    return first;
}

/* Checks plane stress of 30 and 10 with a shear of 10: principal stresses 20 +- sqrt(200) (Mohr 1882). */
static void fields_follow_from_stress(void **state)
{
    (void)state;
    struct output_frame f = block_make(2, 2, 1, 2);
    f.stress[0][0] = 30, f.stress[1][0] = 10, f.stress[2][0] = 10;
    f.v[0][0] = 3, f.v[1][0] = -4;
    assert_float_equal(value_of(&f, "principal_stress"), 20 + sqrt(200), 1e-4);
    assert_float_equal(value_of(&f, "principal_stress_3"), 0, 1e-4); /* the out-of-plane stress */
    assert_float_equal(value_of(&f, "pressure"), -40.0 / 3, 1e-4);
    assert_float_equal(value_of(&f, "von_mises"), sqrt(30 * 30 + 10 * 10 - 30 * 10 + 3 * 10 * 10), 1e-3);
    assert_float_equal(value_of(&f, "speed"), 5, 1e-5);
    frame_free(&f);
}

static void unknown_fields_are_refused(void **state)
{
    (void)state;
    const struct plot_field *field;
    assert_int_equal(plot_field_find_by_name(&field, "van_mises", 2), REFUSED);
    assert_non_null(strstr(status_message(), "von_mises"));
    assert_int_equal(plot_field_find_by_name(&field, "velocity_z", 2), REFUSED);
    assert_int_equal(plot_field_find_by_name(&field, "stress_zz", 2), OK);
    assert_int_equal(plot_field_find_by_name(&field, "stress_yy", 1), REFUSED);
}

/* Checks that the legend colour of rigid bodies is lighter in pictures of cracks, where bodies are faded. */
static void rigid_bodies_are_faded_behind_cracks(void **state)
{
    (void)state;
    const struct colour full = rigid_body_colour(MAP_DAMAGE), faded = rigid_body_colour(MAP_CRACKS);
    assert_true(faded.red > full.red + 50 && faded.green > full.green + 50 && faded.blue > full.blue + 50);
}

/* Checks that a vector field is its component along the axis for a bar, and its magnitude in other spaces. */
static void labels_say_component_or_magnitude(void **state)
{
    (void)state;
    static const struct {
        const char *name, *label;
        int dim;
    } want[] = {{"velocity", "velocity x", 1},
                {"displacement", "displacement x", 1},
                {"speed", "speed", 1},
                {"velocity", "speed", 2},
                {"displacement", "displacement magnitude", 3}};
    for (size_t k = 0; k < COUNT_OF(want); k++) {
        const struct plot_field *field;
        char label[NAME_MAX_LENGTH];
        assert_int_equal(plot_field_find_by_name(&field, want[k].name, want[k].dim), OK);
        plot_field_write_label(label, sizeof label, field);
        assert_string_equal(label, want[k].label);
    }
}

/* Checks the component index that belongs to a field's name, in the order of frames: xx, yy, zz, then xy, yz, zx. */
static void fields_name_components(void **state)
{
    (void)state;
    static const struct {
        const char *name, *stored;
        int component;
    } want[] = {{"displacement_y", "displacement", 1},
                {"velocity_x", "velocity", 0},
                {"velocity_z", "velocity", 2},
                {"stress_yy", "stress", 1},
                {"stress_zz", "stress", 2},
                {"stress_xy", "stress", 3},
                {"stress_yz", "stress", 4},
                {"stress_zx", "stress", 5},
                {"strain_zz", "strain", 2},
                {"strain_xy", "strain", 3},
                {"strain_yz", "strain", 4},
                {"strain_zx", "strain", 5},
                {"principal_stress", "principal_stress", 0},
                {"principal_stress_3", "principal_stress", 2},
                {"principal_directions_1_y", "principal_directions", 1},
                {"principal_directions_3_x", "principal_directions", 6}};
    for (size_t k = 0; k < COUNT_OF(want); k++) {
        const struct plot_field *field;
        assert_int_equal(plot_field_find_by_name(&field, want[k].name, 3), OK);
        assert_string_equal(field->stored, want[k].stored);
        assert_int_equal(field->component, want[k].component);
    }
}

/* Checks that the default slice through a solid is that with the largest damage, else the one nearest to the middle. A
 * requested position selects the nearest layer, or is refused outside the body. */
static void slices_show_damage(void **state)
{
    (void)state;
    struct output_frame f = block_make(6, 6, 4, 3);
    struct plotted_particles c;
    for (int64_t i = 0; i < f.n; i++)
        if (f.X[2][i] > 1e-3F && f.X[0][i] > 0) f.damage[i] = 0.4F;
    plotted_particles_select_from_frame(&c, &f, NULL);
    assert_int_equal(c.normal, 2);
    assert_int_equal(c.n, 36);
    assert_float_equal(c.layer, 1.5e-3, 1e-8);
    plotted_particles_free(&c);
    memset(f.damage, 0, (size_t)f.n * sizeof *f.damage);
    plotted_particles_select_from_frame(&c, &f, NULL);
    assert_float_equal(fabs(c.layer), 0.5e-3, 1e-8);
    plotted_particles_free(&c);
    struct projection projection = {.normal = 0, .placed = true, .layer = 1.9e-3};
    assert_int_equal(projection_choose_slice_normal_and_position(&projection, &f, NULL), OK);
    assert_float_equal(projection.layer, 1.5e-3, 1e-8);
    projection.layer = 9e-3;
    assert_int_equal(projection_choose_slice_normal_and_position(&projection, &f, NULL), REFUSED);
    assert_non_null(strstr(status_message(), "-2.5 to 2.5 mm"));
    frame_free(&f);
}

/* Checks that among slices whose damage is within 2 % of the largest the one nearest to the middle is used; a slice
 * with 0.9 of the largest damage is not. Also checks that the spacing of a frame with several sizes is the smallest. */
static void slices_are_near_the_middle(void **state)
{
    (void)state;
    static const float damage[] = {0, 0.5F, 0.496F, 0.45F, 0, 0, 0.1F, 0};
    struct output_frame f = block_make(9, 9, 8, 3);
    for (int64_t i = 0; i < f.n; i++) f.damage[i] = damage[i / 81];
    struct projection projection = {.normal = 2};
    assert_int_equal(projection_choose_slice_normal_and_position(&projection, &f, NULL), OK);
    assert_float_equal(projection.layer, -1.5e-3, 1e-8);
    f.spacing = NEW("test.spacing", f.n, float);
    for (int64_t i = 0; i < f.n; i++) f.spacing[i] = i == 37 ? 0.7e-3F : 2.8e-3F;
    assert_float_equal(frame_particle_spacing(&f), 0.7e-3, 1e-9);
    frame_free(&f);
}

/* Checks that axes have the SI prefix with which their numbers are between 1 and 1000. */
static void axes_have_prefixes(void **state)
{
    (void)state;
    static const struct {
        double largest, factor;
        const char *name;
    } axis[] = {{3.2e9, 1e9, "GPa"},    {3.2e-5, 1e-6, "µPa"}, {0, 1, "Pa"},        {-5e4, 1e3, "kPa"},
                {1.67e17, 1e15, "PPa"}, {9e-16, 1e-18, "aPa"}, {2e27, 1e24, "YPa"}, {INFINITY, 1, "Pa"}};
    for (size_t k = 0; k < COUNT_OF(axis); k++) {
        const struct unit u = unit_with_si_prefix_for_largest_value(axis[k].largest, "Pa");
        assert_true(fabs(u.factor / axis[k].factor - 1) < 1e-12);
        assert_string_equal(u.name, axis[k].name);
    }
    assert_true(unit_for_length(0.04).factor == 1e-3 && unit_for_length(6).factor == 1);
    assert_true(unit_for_length(6.4e6).factor == 1e3 && unit_for_length(4e-5).factor == 1e-6);
    assert_string_equal(unit_with_si_prefix_if_unit_allows_it("s", 3e-5).name, "µs");
    assert_string_equal(unit_with_si_prefix_if_unit_allows_it("m", 0.02).name, "mm");
    assert_string_equal(unit_with_si_prefix_if_unit_allows_it("m^2", 3.5e-11).name, "µm²");
    assert_true(unit_for_area(1e-3).factor == 1e-6 && unit_for_area(3e6).factor == 1e6);
    assert_string_equal(unit_with_si_prefix_if_unit_allows_it("kg/m³", 2440).name, "kg/m³");
}

/* Checks that units of results from files are shown with SI prefixes, as those of fields and curves are. */
static void units_of_files_are_shown_alike(void **state)
{
    (void)state;
    static const struct {
        const char *given, *name;
        double largest, factor;
    } unit[] = {{"J/m^2", "kJ/m²", 5e3, 1e3}, {"J/m²", "kJ/m²", 5e3, 1e3},
                {"J/m^3", "MJ/m³", 2e6, 1e6}, {"Pa m^(1/2)", "MPa√m", 3e7, 1e6},
                {"N/m", "kN/m", 4e4, 1e3},    {"kg m^2/s", "kg m²/s", 3e-6, 1},
                {"degree", "°", 63, 1},       {"m²", "mm²", 4e-5, 1e-6}};
    for (size_t k = 0; k < COUNT_OF(unit); k++) {
        const struct unit u = unit_with_si_prefix_if_unit_allows_it(unit[k].given, unit[k].largest);
        assert_string_equal(u.name, unit[k].name);
        assert_true(fabs(u.factor / unit[k].factor - 1) < 1e-12);
    }
}

/* Checks that a distant particle, counted as outside, changes neither the drawn rectangle nor the colour range. */
static void one_particle_sets_no_scale(void **state)
{
    (void)state;
    struct output_frame f = block_make(40, 20, 1, 2);
    struct plotted_particles c;
    float *value = NEW("test.value", f.n, float);
    for (int64_t i = 0; i < f.n; i++) value[i] = (float)(i % 10);
    f.u[0][17] = 5, value[17] = 1e6F;
    const struct plot_field *field;
    assert_int_equal(plot_field_find_by_name(&field, "speed", 2), OK);
    plotted_particles_select_from_frame(&c, &f, &(struct projection){.normal = -1, .field = field, .value = value});
    struct view v = view_make_around_particles(&c, 1);
    view_set_field_and_colour_range(&v, field, &c, 1);
    assert_true(v.to[0] < 30e-3 && v.from[0] > -25e-3);
    assert_int_equal(v.outside, 1);
    assert_true(v.low == 0 && v.high <= 9);
    assert_int_equal(plot_field_find_by_name(&field, "velocity_x", 2), OK);
    view_set_field_and_colour_range(&v, field, &c, 1);
    assert_true(v.low == -v.high);
    for (int64_t i = 0; i < f.n; i++) value[i] = -value[i];
    plotted_particles_free(&c);
    plotted_particles_select_from_frame(&c, &f, &(struct projection){.normal = -1, .field = field, .value = value});
    view_set_field_and_colour_range(&v, field, &c, 1);
    assert_true(v.low == -v.high && v.high > 7 && v.high <= 9);
    plotted_particles_free(&c), memory_free(value), frame_free(&f);
}

enum { PIXELS = 120 };

/* Checks that the axial view of a block is a rectangle, and that cracks inside are visible through the body. */
static void solids_are_seen_from_outside(void **state)
{
    (void)state;
    struct output_frame f = block_make(10, 10, 10, 3);
    struct plotted_particles c;
    struct colour *pixel = NEW("test.pixel", PIXELS * PIXELS, struct colour);
    f.damage[555] = 1; /* inside */
    const struct projection projection = {.outside = true, .camera = camera_along_axis(2, 1), .normal = -1};
    plotted_particles_select_from_frame(&c, &f, &projection);
    struct view v = {.from = {-6e-3, -6e-3}, .to = {6e-3, 6e-3}, .top = 1};
    int shown = 0, dark = 0;
    c.mirrors = 1, c.mirror[0] = (struct shown_mirror){.axis = 0, .at = 4.6e-3}; /* hides 0.4 spacings */
    image_paint_particles_as_cubes(pixel, PIXELS, PIXELS, &v, &c, MAP_DAMAGE);
    for (int q = 0; q < PIXELS * PIXELS; q++)
        shown += pixel[q].alpha > 0, dark += pixel[q].green < 100 && pixel[q].alpha;
    assert_true(abs(shown - 96 * 100) <= 2 * 101); /* less than ten of twelve spacings wide, and the gaps */
    assert_int_equal(dark, 0);                     /* its damage is hidden */
    image_paint_particles_as_cubes(pixel, PIXELS, PIXELS, &v, &c, MAP_CRACKS);
    for (int q = 0; q < PIXELS * PIXELS; q++) dark += pixel[q].green < 100 && pixel[q].alpha;
    assert_true(dark >= 100 && dark <= 144); /* one particle, ten pixels wide */
    memory_free(pixel), plotted_particles_free(&c), frame_free(&f);
}

/* Displaces the block f in 2D by u = H X with H = F - 1, the part above the middle by `open` along y in addition
 * [m]. */
static void block_deform(struct output_frame *f, const double H[2][2], double open)
{
    for (int64_t i = 0; i < f->n; i++)
        for (int d = 0; d < 2; d++)
            f->u[d][i] = (float)(H[d][0] * f->X[0][i] + H[d][1] * f->X[1][i] + (d == 1 && f->X[1][i] > 0 ? open : 0));
}

/* Counts the pixels of a square of edge 2 x `half` around the origin [m] *painted with a particle and *blank
 * without. */
static void pixels_count(const struct plotted_particles *plotted, double half, int *painted, int *blank)
{
    struct colour *pixel = NEW("test.pixel", PIXELS * PIXELS, struct colour);
    const struct view v = {.from = {-half, -half}, .to = {half, half}, .top = 1};
    *painted = *blank = 0;
    image_paint_particles_in_plane(pixel, PIXELS, PIXELS, &v, plotted, MAP_DAMAGE);
    for (int q = 0; q < PIXELS * PIXELS; q++) *(pixel[q].alpha ? painted : blank) += 1;
    memory_free(pixel);
}

/* Checks colour ranges set by the user, with units; values outside are counted, also outside the default range. */
static void ends_of_colours_are_counted(void **state)
{
    (void)state;
    struct output_frame f = block_make(40, 25, 1, 2);
    struct plotted_particles c;
    struct plot_request r = {.range = {"-1 kPa", "2 kPa"}, .projection.normal = -1};
    float *value = NEW("test.value", f.n, float);
    for (int64_t i = 0; i < f.n; i++) value[i] = (float)(i - 500) * 10; /* -5000 .. 4990 */
    r.projection.value = value;
    assert_int_equal(plot_field_find_by_name(&r.projection.field, "stress_xx", 2), OK);
    plotted_particles_select_from_frame(&c, &f, &r.projection);
    struct view v;
    assert_int_equal(view_make_for_request(&v, &r, &c, 1), OK);
    assert_true(v.low == -1000 && v.high == 2000 && v.beyond[0] == 400 && v.beyond[1] == 299);
    r.range[1] = "2 mm";
    assert_int_equal(view_make_for_request(&v, &r, &c, 1), REFUSED);
    r.range[0] = NULL;
    assert_int_equal(view_make_for_request(&v, &r, &c, 1), OK);
    assert_int_equal(v.beyond[0] + v.beyond[1], 3); /* 0.2 %, at least 3, of 1000 particles, of either sign */
    plotted_particles_free(&c), memory_free(value), frame_free(&f);
}

/* Returns the upper end of the colour range of `field` with 1000 particles. The first `spots` particles have the value
 * `spot`, the last `rest` have 0, and the others have values from 1 to 2. */
static double end_of_colours(const char *field, int spots, double spot, int rest)
{
    struct output_frame f = block_make(40, 25, 1, 2);
    struct plotted_particles c;
    struct projection of = {.normal = -1};
    struct view v = {0};
    float *value = NEW("test.value", f.n, float);
    for (int64_t i = 0; i < f.n; i++) value[i] = (float)(i < spots ? spot : i >= f.n - rest ? 0 : 1 + 1e-3 * (double)i);
    of.value = value;
    assert_int_equal(plot_field_find_by_name(&of.field, field, 2), OK);
    plotted_particles_select_from_frame(&c, &f, &of);
    view_set_field_and_colour_range(&v, of.field, &c, 1);
    plotted_particles_free(&c), memory_free(value), frame_free(&f);
    return v.high;
}

/* Checks that extreme values at 0.8 % of the particles do not determine the colour range, also in a field of both
 * signs. A small yielded part of a body does determine the range of plastic strain. */
static void hot_spots_leave_colours(void **state)
{
    (void)state;
    assert_true(end_of_colours("von_mises", 8, 1e6, 0) < 3.1);
    assert_true(end_of_colours("pressure", 8, -1e6, 0) < 3.1);
    assert_true(end_of_colours("von_mises", 20, 2.5, 0) == 2.5); /* 2 % are a part of the body */
    assert_true(end_of_colours("plastic_strain", 10, 3, 990) == 3);
    assert_true(end_of_colours("plastic_strain", 40, 3, 900) > 2.9);
}

/* Checks that a body that is stretched by 30 %, sheared or rotated is drawn without gaps, with its area times det F
 * plus at most 3 % for the edges. If bonds across the middle are broken, the gap is blank over its whole width. */
static void stretched_bodies_are_closed(void **state)
{
    (void)state;
    static const double H[][2][2] = {{{0.3, 0}, {0, -0.1}}, {{0, 0.6}, {0, 0}}, {{-0.134, -0.5}, {0.5, -0.134}}};
    for (int k = 0; k < 4; k++) {
        struct output_frame f = block_make(24, 20, 1, 2);
        struct plotted_particles c;
        int painted, blank;
        block_deform(&f, H[k % 3], k == 3 ? 3 * SPACING : 0);
        for (int64_t i = 0; i < f.n && k == 3; i++) f.damage[i] = fabs(f.X[1][i]) < 1.1 * SPACING ? 0.4F : 0;
        plotted_particles_select_from_frame(&c, &f, NULL);
        pixels_count(&c, 5 * SPACING, &painted, &blank);
        if (k < 3) assert_int_equal(blank, 0);
        /* the gap is 3 spacings of 10 wide */
        else
            assert_true(abs(blank - PIXELS * PIXELS * 30 / 100) <= 2 * PIXELS);
        pixels_count(&c, 20 * SPACING, &painted, &blank);
        const double det = (1 + H[k % 3][0][0]) * (1 + H[k % 3][1][1]) - H[k % 3][0][1] * H[k % 3][1][0];
        const double body = 24.0 * 20 * det / (40 * 40) * PIXELS * PIXELS;
        assert_true(painted > body && painted < 1.03 * body + 2 * PIXELS);
        plotted_particles_free(&c), frame_free(&f);
    }
}

/* Checks that a solid stretched by 50 % along x is drawn 15 spacings wide from outside, without gaps. */
static void stretched_solids_are_closed(void **state)
{
    (void)state;
    struct output_frame f = block_make(10, 8, 6, 3);
    struct plotted_particles c;
    int painted, blank;
    for (int64_t i = 0; i < f.n; i++) f.u[0][i] = (float)(0.5 * f.X[0][i]);
    plotted_particles_select_from_frame(
        &c, &f, &(struct projection){.outside = true, .camera = camera_along_axis(2, 1), .normal = -1});
    pixels_count(&c, 10 * SPACING, &painted, &blank);
    const double body = 15.0 * 8 / (20 * 20) * PIXELS * PIXELS;
    assert_true(painted >= 0.99 * body && painted < 1.06 * body);
    pixels_count(&c, 3.9 * SPACING, &painted, &blank);
    assert_int_equal(blank, 0);
    plotted_particles_free(&c), frame_free(&f);
}

/* Returns the number of columns of the picture pixel[size size] in which a face of a pre-crack is drawn. */
static int columns_with_line(const struct colour *pixel, int size)
{
    int columns = 0;
    for (int x = 0; x < size; x++) {
        bool line = false;
        for (int y = 0; y < size; y++) line |= pixel[y * size + x].alpha && pixel[y * size + x].green < 100;
        columns += line;
    }
    return columns;
}

/* Checks a slit of the mesh, which causes no damage. It is drawn as a line from the edge of the body to its tip, and as
 * a wedge where it opens, over 12 of 30 spacings at any resolution. The body is 2.5 km from the origin. */
static void slits_are_lines_of_the_body(void **state)
{
    (void)state;
    real far = 2500, end[2][DIM_MAX] = {{far - 20e-3, 0.45e-3}, {far, 0.45e-3}};
    struct crack slit = {.n = 2, .corner = end};
    struct scene scene = {.dim = 2, .cracks = 1, .crack = &slit};
    struct colour *pixel = NEW("test.pixel", 64 * PIXELS * PIXELS, struct colour);
    for (int open = 0; open < 2; open++) {
        struct output_frame f = block_make(24, 20, 1, 2);
        struct plotted_particles c;
        int line = 0, blank = 0;
        for (int64_t i = 0; i < f.n; f.X[0][i++] += far)
            if (open && f.X[0][i] < 0 && f.X[1][i] > 0) f.u[1][i] = (float)(-0.3 * f.X[0][i]);
        plotted_particles_select_from_frame(&c, &f, &(struct projection){.normal = -1, .scene = &scene});
        const struct view v = {
            .from = {far - 15e-3, -15e-3}, .to = {far + 15e-3, 15e-3}, .top = 1, .notches = 1, .notch = &slit};
        image_paint_particles_in_plane(pixel, PIXELS, PIXELS, &v, &c, MAP_DAMAGE);
        for (int q = 0; q < PIXELS * PIXELS; q++) {
            line += pixel[q].alpha && pixel[q].green < 100 && abs(2 * (q / PIXELS) + 1 - PIXELS) == 1;
            blank += !pixel[q].alpha && q / PIXELS >= PIXELS / 2 && q / PIXELS < PIXELS * 3 / 5 && q % PIXELS > 20 &&
                     q % PIXELS < PIXELS / 2;
        }
        if (open)
            assert_true(blank > 150); /* a wedge 40 pixels long and up to 12 high, less the margins */
        else
            assert_true(blank == 0 && line >= 48 && line <= 2 * 50); /* 12 spacings of 4 pixels, 1 or 2 high */
        for (int size = 8 * PIXELS; size > 20; size /= 2) {          /* lines of more than 3 pixels to less than 2 */
            image_paint_particles_in_plane(pixel, size, size, &v, &c, MAP_DAMAGE);
            assert_true(abs(columns_with_line(pixel, size) - size * 12 / 30) <= 1 + (size <= PIXELS));
        }
        plotted_particles_free(&c), frame_free(&f);
    }
    memory_free(pixel);
}

/* Checks a rigid brick of 4 x 2 spacings, moved and rotated by 90 degrees, beside a block: its area in pixels and its
 * position, in a flat picture and from outside. The picture is enlarged to show it. */
static void rigid_bodies_are_shown(void **state)
{
    (void)state;
    static struct solid brick = {.kind = SOLID_BOX, .from = {0, 0, -1e-3}, .to = {4e-3, 2e-3, 1e-3}};
    static const struct region shape = {.n = 1, .solid = &brick};
    struct colour *pixel = NEW("test.pixel", PIXELS * PIXELS, struct colour);
    for (int dim = 2; dim < 4; dim++) {
        struct output_frame f = block_make(10, 10, 2, 3);
        struct plotted_particles c;
        int rigid = 0, beside = 0;
        f.dim = dim;
        plotted_particles_select_from_frame(
            &c, &f, &(struct projection){.outside = true, .camera = camera_along_axis(2, 1), .normal = -1});
        struct plotted_rigid_body *r = NEW("test.rigid", 1, struct plotted_rigid_body);
        *r = (struct plotted_rigid_body){
            .shape = &shape,
            .at = {.centre = {2e-3, 1e-3, 0}, .x = {8e-3, 0, 0}, .turn = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}};
        r->bounded = region_compute_bounding_box_if_finite(&shape, dim, r->low, r->high);
        c.dim = dim, c.rigids = 1, c.rigid = r;
        assert_true(fabs(view_make_around_particles(&c, 1).to[0] - 9e-3) < 1.1 * SPACING);
        const struct view v = {.from = {-10e-3, -10e-3}, .to = {10e-3, 10e-3}, .top = 1};
        image_paint_particles_in_plane(pixel, PIXELS, PIXELS, &v, &c, MAP_DAMAGE);
        for (int q = 0; q < PIXELS * PIXELS; q++) {
            const double x = (q % PIXELS + 0.5) / 6 - 10, y = (q / PIXELS + 0.5) / 6 - 10; /* [spacing] */
            const bool here = pixel[q].alpha && pixel[q].red < 130;
            rigid += here, beside += here && !(fabs(x - 8) < 1.1 && fabs(y) < 2.1);
        }
        assert_true(abs(rigid - 4 * 2 * 36) <= 12 && beside == 0);
        plotted_particles_free(&c), frame_free(&f);
    }
    memory_free(pixel);
}

/* Checks that the axes of every view are right-handed unit vectors. */
static void cameras_are_right_handed(void **state)
{
    (void)state;
    for (int k = 0; k < 7; k++) {
        const struct camera c = k < 6 ? camera_along_axis(k / 2, k % 2 ? 1 : -1) : camera_isometric;
        for (int d = 0; d < 3; d++) {
            const int a = (d + 1) % 3, b = (d + 2) % 3;
            assert_float_equal(c.right[a] * c.up[b] - c.right[b] * c.up[a], c.towards[d], 1e-9);
        }
    }
}

/* Checks that the lightness of each colour scale of a quantity increases, so that its order is visible in grey print
 * and with any colour vision. */
static void colours_keep_their_order(void **state)
{
    (void)state;
    double before = -1;
    for (int k = 0; k <= 20; k++) {
        const struct colour c = colour_on_sequential_scale(k / 20.0);
        const double light = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
        assert_true(light > before);
        before = light;
    }
    for (int k = 0; k < LEDGER_ROWS; k++)
        for (int m = 0; m < k; m++) assert_string_not_equal(ledger[k].colour, ledger[m].colour);
    assert_int_equal(colour_on_diverging_scale(0.5).red, colour_on_diverging_scale(0.5).blue);
}

static void words_have_units(void **state)
{
    (void)state;
    const char *names[] = {"--field", "--times", "--slice"};
    char what[256];
    real value;
    assert_true(length_parse_with_unit(&value, "4mm", what, sizeof what) && value == 4e-3);
    assert_true(time_parse_with_unit(&value, "10us", what, sizeof what) && value == 10e-6);
    assert_false(time_parse_with_unit(&value, "10mm", what, sizeof what));
    assert_string_equal(word_propose_similar("--slcie", names, 3).text, "; did you mean --slice?");
    assert_string_equal(word_propose_similar("--palette", names, 3).text, ";");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_follow_from_stress),
        cmocka_unit_test(unknown_fields_are_refused),
        cmocka_unit_test(fields_name_components),
        cmocka_unit_test(labels_say_component_or_magnitude),
        cmocka_unit_test(rigid_bodies_are_faded_behind_cracks),
        cmocka_unit_test(slices_show_damage),
        cmocka_unit_test(slices_are_near_the_middle),
        cmocka_unit_test(axes_have_prefixes),
        cmocka_unit_test(units_of_files_are_shown_alike),
        cmocka_unit_test(one_particle_sets_no_scale),
        cmocka_unit_test(solids_are_seen_from_outside),
        cmocka_unit_test(cameras_are_right_handed),
        cmocka_unit_test(colours_keep_their_order),
        cmocka_unit_test(words_have_units),
        cmocka_unit_test(hot_spots_leave_colours),
        cmocka_unit_test(stretched_bodies_are_closed),
        cmocka_unit_test(stretched_solids_are_closed),
        cmocka_unit_test(slits_are_lines_of_the_body),
        cmocka_unit_test(rigid_bodies_are_shown),
        cmocka_unit_test(ends_of_colours_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
