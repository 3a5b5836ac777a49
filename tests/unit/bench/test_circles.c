/* Tests of `cleave bench circles`: its table of cases, verdicts, and bodies on a turned lattice. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "bench/circles/circles.h"

/* Returns the verdict (a static text) of circle_verdict on the value `found` of the case c at the spacing `spacing`
 * [mm]. */
static const char *verdict_on(const struct circle_case *c, double spacing, double found)
{
    return circle_verdict(&(struct circle_run){.of = c, .spacing = spacing, .found = found});
}

/* Checks circle_verdict. A value at the edge of the tolerance holds; a value beyond it and a missing value are missed.
 * A notch of 0.5 mm has no verdict above a spacing of 0.0553 mm, where it is shorter than three horizons. A case with a
 * limit of its own (horizon of 0.345 crack lengths) has none above this limit, 0.0501 mm. */
static void verdicts_follow_the_tolerance(void **state)
{
    (void)state;
    const struct circle_case c = {.expected = 27, .tolerance = 1},
                             notch = {.expected = 17.83, .tolerance = 0.89, .crack = 0.5},
                             limited = {.expected = 35, .tolerance = 5, .crack = 0.1, .horizon = 0.345};
    assert_string_equal(verdict_on(&c, 0.1, 28), "holds");
    assert_string_equal(verdict_on(&c, 0.1, 26), "holds");
    assert_string_equal(verdict_on(&c, 0.1, 28.01), "MISSED");
    assert_string_equal(verdict_on(&c, 0.1, 25.99), "MISSED");
    assert_string_equal(verdict_on(&c, 0.1, NAN), "MISSED");
    assert_string_equal(verdict_on(&notch, 0.056, 17.83), "-");
    assert_string_equal(verdict_on(&notch, 0.055, 17.83), "holds");
    assert_string_equal(verdict_on(&notch, 0.055, 12), "MISSED");
    assert_string_equal(verdict_on(&limited, 0.051, 12), "-");
    assert_string_equal(verdict_on(&limited, 0.05, 12), "MISSED");
    assert_string_equal(verdict_on(&limited, 0.05, 30), "holds");
}

/* Checks that each of the nine circles has a case, and each case has runs from coarse to fine or a reason for none. */
static void each_circle_has_runs_or_a_reason(void **state)
{
    (void)state;
    bool seen[10] = {false};
    for (int k = 0; k < circle_cases_count; k++) {
        const struct circle_case *c = &circle_cases[k];
        seen[c->circle[0] - '0'] = true;
        const bool runs = circle_has_runs(c);
        assert_true(runs || c->why);
        assert_true(!runs || (c->expected > 0 && c->tolerance > 0 && c->tolerance < 0.15 * c->expected));
        for (int j = 1; j < CIRCLE_SPACINGS; j++) {
            assert_true(c->spacing[j] < c->spacing[j - 1] || c->spacing[j] == 0);
            assert_true(c->turned[j] < c->turned[j - 1] || c->turned[j] == 0);
        }
        assert_true(c->turned[0] == 0 || circle_specimen[c->specimen].text);
    }
    for (int k = 1; k <= 9; k++) assert_true(seen[k]);
}

/* Writes a specimen as a list of particles on a lattice of the spacing `spacing` [m] turned by `degrees` about (middle,
 * 0) [m], and stores the sizes of the body in *list. Checks that the particles are on the lattice and none is on y = 0.
 * Returns the sum of their volumes [m^3]. */
static double volume_of_list(const struct circle_specimen *specimen, double spacing, int degrees, double middle,
                             struct circle_list *list)
{
    const double c = cos(degrees * M_PI / 180), s = sin(degrees * M_PI / 180);
    char path[] = "/tmp/test_circles_XXXXXX", line[128];
    const int file = mkstemp(path);
    assert_true(file >= 0 && close(file) == 0);
    assert_int_equal(circle_write_particle_list(path, specimen, spacing, degrees, middle, list), OK);
    FILE *from = fopen(path, "r");
    double x, y, volume, sum = 0;
    assert_non_null(fgets(line, sizeof line, from));
    assert_string_equal(line, "x,y,volume\n");
    while (fscanf(from, "%lf,%lf,%lf", &x, &y, &volume) == 3) {
        const double along = (c * (x - middle) + s * y) / spacing, across = (c * y - s * (x - middle)) / spacing;
        assert_true(fabs(along - floor(along) - 0.5) < 1e-9);
        assert_true(fabs(across - round(across)) < 1e-9);
        assert_true(fabs(y) > (degrees == 45 ? 0.3 : 1e-4) * spacing);
        sum += volume;
    }
    fclose(from), remove(path);
    return sum;
}

/* Checks that a body on a turned lattice has the volume of the specimen within 1 %. */
static void turned_bodies_have_their_volume(void **state)
{
    (void)state;
    const double spacing = 0.1e-3, thickness = 1e-3;
    const int degrees[] = {20, 45};
    const enum circle_specimens specimen[] = {CIRCLE_STRIP, CIRCLE_DISC};
    const double area[] = {5e-3 * 12e-3, M_PI * 2.5e-3 * 2.5e-3};
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < 2; j++) {
            struct circle_list list;
            const double volume = volume_of_list(&circle_specimen[specimen[k]], spacing, degrees[j], 0, &list);
            assert_true(fabs(volume / (area[k] * thickness) - 1) < 0.01);
            assert_true(list.layer == 1);
        }
}

/* Checks the sections of bodies on a lattice turned by 45 degrees, whose rows are spacing/sqrt(2) apart, in numbers of
 * rows. Spacing 0.1 mm, with a gap in the middle: a strip 5 mm wide has 70 rows, 0.99 of its section. A strip with a
 * notch of 1 mm has 14 rows in the notch, 57 beside it, and 7 in the loaded layer of 0.5 mm. */
static void turned_bodies_tell_their_section(void **state)
{
    (void)state;
    struct circle_list list;
    const double row = 0.1e-3 / sqrt(2);
    volume_of_list(&circle_specimen[CIRCLE_STRIP], 0.1e-3, 45, 0, &list);
    assert_true(fabs(list.section / (70 * row / 5e-3) - 1) < 1e-3); /* sum over rows in place of the integral */
    volume_of_list(&circle_specimen[CIRCLE_NOTCH], 0.1e-3, 45, 1e-3, &list);
    assert_true(fabs(list.section / (71 * row / 5e-3) - 1) < 1e-3);
    assert_true(fabs(list.layer / (71 * row / 5e-3 * 7 * row / 0.5e-3) - 1) < 5e-3); /* rows have unequal numbers */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(verdicts_follow_the_tolerance),
        cmocka_unit_test(each_circle_has_runs_or_a_reason),
        cmocka_unit_test(turned_bodies_have_their_volume),
        cmocka_unit_test(turned_bodies_tell_their_section),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
