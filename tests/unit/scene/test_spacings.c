/* Tests spacings that fit the lengths of a scene: integer numbers of spacings in edges, gaps and cracks, and some
 * spacings in each length that must be resolved. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "scene/scene_read.h"
#include "scene/spacings.h"

#define PLANE                                                                                                          \
    "space: plane stress\nthickness: 1 mm\nduration: 1 us\nmaterial: {young: 2e11, poisson: 1/3, density: 8000}\n"     \
    "particles: {spacing: 10 mm}\n"

/* Reads the valid scene `text` into s. */
static void read_sound(struct scene *s, const char *text)
{
    if (scene_read_text(s, text, strlen(text), "spacings.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
}

/* Checks the spacing nearest to a given one for which crack ends and edges are between particles and, with cells of two
 * spacings, the body ends at a cell. */
static void spacings_divide_lengths(void **state)
{
    (void)state;
    struct scene s;
    read_sound(&s, PLANE "body: {box: {from: [0, 0], to: [60, 40]}}\ncracks: [{from: [-1, 20], to: [30, 20]}]\n");
    assert_true(fabs(spacing_that_fits_box_edges(&s, 1, false) - 1) < 1e-12);
    /* The lengths 60, 40, 30 and 20 need a divisor of 10. */
    assert_true(fabs(spacing_that_fits_box_edges(&s, 0.99, false) - 10.0 / 11) < 1e-12);
    assert_true(fabs(spacing_that_fits_box_edges(&s, 3.4, true) - 10.0 / 3) <
                1e-12); /* 60 and 40 over 20/3: 9 and 6 pairs */
    assert_true(fabs(spacing_that_fits_box_edges(&s, 1e-3, true) - 1e-3) < 1e-12);
    scene_free(&s);
}

/* Checks that the first body, a disc, has no edges to fit. The spacing is unchanged if no spacing divides the edges of
 * the other body. */
static void a_disc_has_no_edges(void **state)
{
    (void)state;
    struct scene s;
    read_sound(&s, PLANE "method: pd\nbodies:\n  - {name: a, shape: {disc: {centre: [-1, 0], radius: 0.5}}}\n"
                         "  - {name: b, shape: {box: {from: [0, 0], to: [1, 0.7071]}}}\n");
    assert_true(spacing_that_fits_box_edges(&s, 0.3, false) == 0.3);
    scene_free(&s);
}

/* Checks the spacing that resolves thickness, cracks and pulses with some spacings each. It divides the height of the
 * body, except in the second scene. */
static void each_length_has_a_few_spacings(void **state)
{
    (void)state;
    static const struct {
        const char *body, *more;
        double least, most;
    } scene[] = {
        {"{box: {from: [0, 0], to: [40 mm, 20 mm]}}", "", 0.4e-3, 0.52e-3}, /* 3000 particles */
        {"{box: {from: [0, 0], to: [40 mm, 2 mm]}}", "", 0.1e-3, 0.2e-3},   /* ten across */
        {"{box: {from: [0, 0], to: [40 mm, 20 mm]}}", "cracks: [{from: [-1 mm, 10 mm], to: [2 mm, 10 mm]}]\n", 0.2e-3,
         0.26e-3}, /* eight from its end to the face */
        {"{box: {from: [0, 0], to: [40 mm, 20 mm]}}",
         "initial: [{pulse: {at: [2 mm, 0], direction: [1, 0], width: 1 mm, velocity: 1}}]\n", 0.11e-3, 0.13e-3},
    };
    for (size_t k = 0; k < COUNT_OF(scene); k++) {
        char text[1024];
        struct scene s;
        snprintf(text, sizeof text, PLANE "method: mpm\nbody: %s\n%s", scene[k].body, scene[k].more);
        read_sound(&s, text);
        const double h = spacing_that_resolves_all_lengths(&s), across = 20e-3 / h;
        assert_true(h > scene[k].least && h < scene[k].most);
        if (k != 1) assert_true(fabs(across - round(across)) < 1e-6 * across);
        scene_free(&s);
    }
}

/* Checks that the spacing is 0 for particles from a list, which have no length that determines it. */
static void there_may_be_no_length(void **state)
{
    (void)state;
    struct scene s;
    read_sound(&s, PLANE "bodies: [{name: a, particles: a.csv}]\ncracks: [{from: [-1, 20], to: [30, 20]}]\n");
    assert_true(spacing_that_resolves_all_lengths(&s) == 0);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spacings_divide_lengths),
        cmocka_unit_test(a_disc_has_no_edges),
        cmocka_unit_test(each_length_has_a_few_spacings),
        cmocka_unit_test(there_may_be_no_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
