/* Tests variables of scenes: use in every kind of number, overrides, scenes as written out, refusals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <math.h>
#include <cmocka.h>

#include "scene/scene.h"
#include "scene/scene_read.h"

#define SCENE                                                                                                          \
    "space: plane stress\n"                                                                                            \
    "thickness: a\n"                                                                                                   \
    "duration: L/speed\n"                                                                                              \
    "method: mpm\n"                                                                                                    \
    "material: {young: E, poisson: nu, density: rho, yield_stress: E*2 %, yield_hardening: E/10}\n"                    \
    "body: {box: {from: [0, -b/2], to: [L, b/2]}}\n"                                                                   \
    "particles: {spacing: a/n, seed: 3*n, horizon: 3 + 0.015}\n"                                                       \
    "initial:\n"                                                                                                       \
    "  - {region: {ball: {centre: [L/2, 0], radius: b/4}}, velocity_gradient: [[0, 100/ms], [-1/2 us/ms^2, 0]]}\n"     \
    "boundary:\n"                                                                                                      \
    "  - {face: x+, traction: [2*MPa*n, 0], time: {table: [[0, 0], [tau, 1/n], [2*tau, 1]]}}\n"                        \
    "  - {region: {box: {from: [-inf, -inf], to: [a, inf]}}, velocity: [speed, free], time: {ramp: {until: tau}}}\n"   \
    "output: {times: [tau, 2*tau], samples: 10*n}\n"

static const char scene_text[] = "variables:\n"
                                 "  b: 2*a + 4 mm\n"
                                 "  a: 3 mm\n"
                                 "  n: 4\n"
                                 "  L: 10*b\n"
                                 "  E: 190 GPa\n"
                                 "  nu: 1/4\n"
                                 "  rho: 7.8 g/cm^3\n"
                                 "  c: sqrt(E/rho)\n"
                                 "  speed: c/1000\n"
                                 "  tau: L/c\n" SCENE;

static struct scene read_with(const struct scene_override *o, int n)
{
    struct scene s;
    if (scene_read_text(&s, scene_text, strlen(scene_text), "v.yaml", o, n) != OK) fail_msg("%s", status_message());
    return s;
}

static void every_number_may_contain_them(void **state)
{
    (void)state;
    struct scene s = read_with(NULL, 0);
    const real a = 3e-3, b = 2 * a + 4e-3, L = 10 * b, c = sqrt(190e9 / 7800), tau = L / c, speed = c / 1000;
    assert_true(s.thickness == a && s.spacing == a / 4 && s.seed == 12 && s.horizon == 3.015 && s.samples == 40);
    assert_true(s.duration == L / speed && s.material->young == 190e9 && s.material->poisson == 0.25);
    assert_true(s.material->density == 7800 && s.material->yield_stress == 190e9 * 0.02);
    assert_true(s.body->shape.solid->from[1] == -b / 2 && s.body->shape.solid->to[0] == L);
    assert_true(s.initial->region.solid->centre[0] == L / 2 && s.initial->region.solid->radius == b / 4);
    assert_true(s.initial->velocity_gradient[1] == 100 / 1e-3);
    assert_true(s.boundary[0].value[0] == 8e6 && s.boundary[0].time.t[1] == tau && s.boundary[0].time.value[1] == 0.25);
    assert_true(s.boundary[0].time.t[2] == 2 * tau && s.boundary[1].value[0] == speed);
    assert_true(s.boundary[1].region.solid->to[0] == a && s.boundary[1].time.until == tau);
    assert_true(s.times.n == 2 && s.times.value[0] == tau && s.times.value[1] == 2 * tau);
    scene_free(&s);
}

/* Checks that the scene as written out contains numbers only, which are read back bitwise. */
static void the_scene_as_run_holds_numbers(void **state)
{
    (void)state;
    struct scene s = read_with(NULL, 0), again;
    assert_null(strstr(s.text, "variables"));
    assert_null(strstr(s.text, "tau"));
    if (scene_read_text(&again, s.text, strlen(s.text), "again.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_string_equal(s.text, again.text);
    assert_true(s.duration == again.duration && s.boundary[0].time.t[1] == again.boundary[0].time.t[1]);
    scene_free(&again);
    scene_free(&s);
}

static void overrides_set_them(void **state)
{
    (void)state;
    static const struct scene_override sizes[] = {{"variables.a", "4 mm"}, {"thickness", "2*(a + 1 mm)"}},
                                       other[] = {{"variables.d", "a/8"}, {"particles.spacing", "d"}},
                                       count[] = {{"variables.a", "n*1 mm"}};
    struct scene s = read_with(sizes, 2);
    assert_true(s.spacing == 1e-3 && s.thickness == 2 * (4e-3 + 1e-3));
    assert_true(s.body->shape.solid->to[0] == 10 * (2 * 4e-3 + 4e-3));
    scene_free(&s);
    s = read_with(other, 2);
    assert_true(s.spacing == 3e-3 / 8);
    scene_free(&s);
    s = read_with(count, 1);
    assert_true(s.thickness == 4e-3);
    scene_free(&s);
}

/* Definitions of variables that are refused, with the message. */
static const struct {
    const char *line, *message;
} wrong[] = {
    {"a: b/2",
     "2:3: b: 2*a + 4 mm needs b, which depends on itself, directly or through other variables; change one of them"},
    {"a: a",
     "2:3: b: 2*a + 4 mm needs a, which depends on itself, directly or through other variables; change one of them"},
    {"a: 3 s", "2:3: b: 2*a + 4 mm combines a time and a length by + (character 5); give both operands the same unit"},
    {"a: 3",
     "2:3: b: 2*a + 4 mm combines a plain number and a length by + (character 5); give both operands the same unit"},
    {"aa: 3 mm", "2:3: b: 2*a + 4 mm has an unknown name a; did you mean the variable aa?"},
    {"a: 3 mm\n  a: 2 mm", "4:3: a: is given twice, first in line 3; remove one of the two"},
    {"a: 3 mm\n  s: 1", "4:3: s: means a unit in expressions; choose another name, such as s1"},
    {"a: 3 mm\n  m2: 1", "4:3: m2: means a unit in expressions; choose another name, such as m21"},
    {"a: 3 mm\n  x: 1", "4:3: x: means a coordinate in expressions; choose another name, such as x1"},
    {"a: 3 mm\n  t: 1", "4:3: t: means the time in expressions; choose another name, such as t1"},
    {"a: 3 mm\n  exp: 1", "4:3: exp: means the name of a function in expressions; choose another name, such as exp1"},
    {"a: 3 mm\n  pi: 3", "4:3: pi: means a number in expressions; choose another name, such as pi1"},
    {"a: 3 mm\n  a-b: 3",
     "4:3: a-b: cannot be the name of a variable; use up to 40 letters, digits and _, and begin with a letter"},
    {"a: 3 mm\n  2a: 3",
     "4:3: 2a: cannot be the name of a variable; use up to 40 letters, digits and _, and begin with a letter"},
    {"a: 3 mm\n  d: [1]", "4:3: d: a list is not allowed here; give a number or an expression"},
    {"a: 3 mm\n  d: x", "4:3: d: x contains x, on which this key cannot depend; remove it"},
    {"a: 3 mm\n  d: red", "4:3: d: red has an unknown name red; did you mean the variable rho?"},
    {"a: 1/0*1 mm", "2:3: b: 2*a + 4 mm needs a, which divides by 0 (character 2); change the divisor"},
    {"a: 1e40 mm", "2:3: b: 2*a + 4 mm needs a, which is above 1e30 in SI units"},
};

/* Checks that each line of `wrong` in place of `a: 3 mm` is refused with its message, and refused overrides of
 * variables. */
static void wrong_ones_are_refused(void **state)
{
    (void)state;
    static const struct {
        struct scene_override o;
        const char *message;
    } override[] = {
        {{"thickness", "E"}, "-s thickness=E: thickness: E is a stress; give a length, such as 0.5 mm"},
        {{"thickness", "n"}, "v.yaml:8:1: "},
        {{"thickness", "2*aa"},
         "-s thickness=2*aa: thickness: 2*aa has an unknown name aa; did you mean the variable a?"},
        {{"thickness", "a - a"},
         "-s thickness=a - a: thickness: a - a is out of range; give a length above 0, such as 0.5 mm"},
        {{"output.samples", "n/3"}, "-s output.samples=n/3: samples: n/3 is 1.33333; give a whole number"},
        {{"output.samples", "-n"},
         "-s output.samples=-n: samples: -n is out of range; give a whole number from 1 to 10000000"},
        {{"particles.seed", "-n"},
         "-s particles.seed=-n: seed: -n is not a seed; give a whole number from 0 to 18446744073709551615"},
        {{"variables.aa", "3 mm"},
         "-s variables.aa=3 mm: aa: no value of the scene uses this variable; did you mean a?"},
        {{"variables", "3 mm"},
         "-s variables=3 mm: variables: 3 mm is not allowed here; give a mapping such as {a: 3 mm, b: 2*a}"},
        {{"variables.a", "t*m/s"},
         "v.yaml:2:3: b: 2*a + 4 mm needs a, which contains t, on which this key cannot depend; remove it"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        struct scene s;
        char text[sizeof scene_text + 100], message[400];
        const int before = (int)(strstr(scene_text, "a: 3 mm") - scene_text);
        const int length = snprintf(text, sizeof text, "%.*s%s%s", before, scene_text, wrong[k].line,
                                    scene_text + before + strlen("a: 3 mm"));
        snprintf(message, sizeof message, "v.yaml:%s", wrong[k].message);
        if (scene_read_text(&s, text, (size_t)length, "v.yaml", NULL, 0) != REFUSED) fail_msg("%s", wrong[k].line);
        assert_string_equal(status_message(), message);
    }
    for (size_t k = 0; k < COUNT_OF(override); k++) {
        struct scene s;
        const status read = scene_read_text(&s, scene_text, strlen(scene_text), "v.yaml", &override[k].o, 1);
        if (strcmp(override[k].message, "v.yaml:8:1: ") == 0) { /* a number without a unit is SI: 4 m */
            assert_int_equal(read, OK);
            assert_true(s.thickness == 4);
            scene_free(&s);
            continue;
        }
        if (read != REFUSED) fail_msg("%s=%s", override[k].o.key, override[k].o.value);
        assert_string_equal(status_message(), override[k].message);
    }
}

/* Checks that a chain of definitions that is too long for the stack is refused. */
static void chains_are_bounded(void **state)
{
    (void)state;
    char text[40000] = "variables: {v0: 1 mm";
    struct scene s;
    size_t used = strlen(text);
    for (int k = 1; k < 900; k++) used += (size_t)sprintf(text + used, ", v%d: v%d + 1 mm", k, k - 1);
    strcpy(text + used, "}\nspace: line\n");
    assert_int_equal(scene_read_text(&s, text, strlen(text), "v.yaml", NULL, 0), REFUSED);
    assert_non_null(strstr(status_message(), "duration: missing")); /* each is defined before the next needs it */
    used = strlen(strcpy(text, "variables: {"));
    for (int k = 0; k < 900; k++) used += (size_t)sprintf(text + used, "v%d: v%d, ", k, k + 1);
    strcpy(text + used, "}\nspace: line\n");
    assert_int_equal(scene_read_text(&s, text, strlen(text), "v.yaml", NULL, 0), REFUSED);
    assert_non_null(strstr(status_message(), "a chain of more than 32"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_number_may_contain_them),
        cmocka_unit_test(the_scene_as_run_holds_numbers),
        cmocka_unit_test(overrides_set_them),
        cmocka_unit_test(wrong_ones_are_refused),
        cmocka_unit_test(chains_are_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
