/* Tests solids in scenes: every kind is read, moved and repeated as specified, the scene as written out reads back
 * equal, names stand for their solids, and errors are reported with their position. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "scene/fill.h"
#include "tests/support/scene_texts.h"

static void scene_text(char *text, size_t room, int dim, const char *regions, const char *shape)
{
    snprintf(text, room,
             "space: %s\n%sduration: 1 us\nmethod: mpm\n"
             "material: {young: 1 GPa, density: 1000}\n"
             "%sbody: %s\n"
             "particles: {spacing: 0.5}\n",
             dim == 3 ? "solid" : "plane stress", dim == 3 ? "" : "thickness: 1\n", regions, shape);
}

/* ---- round trip -------------------------------------------------------------------------------------------------- */

/* Shapes that together use every key of solids, each with a position inside and a position outside. */
static const struct shown_shape {
    int dim;
    const char *regions, *shape;
    real in[3], out[3];
} shapes[] = {
    {2, "", "{polygon: {corners: [[0, 0], [4, 0], [4, 3], [2, 1], [0, 3]], round: 20 cm}}", {1, 1}, {2, 1.5}},
    {2, "", "{box: {from: [0, 0], to: [4, 1]}, rotate: {angle: 90 deg}}", {2, 2}, {0.5, 0.5}},
    {2,
     "",
     "{box: {from: [0, 0], to: [4, 1]}, rotate: {angle: 1.25 rad, about: [0, 0]}, move: [1, 0]}",
     {1.2, 1},
     {3, 0}},
    {2,
     "",
     "[{ellipse: {centre: [1, 0], radii: [3, 2]}}, {subtract: [{disc: {centre: [0, 0], radius: 0.5}}, "
     "{disc: {centre: [2, 0], radius: 0.5}}]}]",
     {-1.5, 0},
     {2, 0.2}},
    {2, "", "{ring: {centre: [0, 0], radius: 3, inner: 2}}", {2.5, 0}, {1, 1}},
    {2,
     "",
     "{intersect: [{disc: {centre: [0, 0], radius: 2}}, {box: {from: [0, -5], to: [5, 5]}}, "
     "{subtract: {disc: {centre: [1, 0], radius: 0.5}}}]}",
     {0.25, 1},
     {1, 0}},
    {2,
     "",
     "[{disc: {centre: [0, 0], radius: 2}}, {intersect: {half-space: {point: [0, 0], normal: [1, 1]}}}]",
     {-1, 0},
     {1, 0}},
    {2,
     "",
     "[{disc: {centre: [0, 0], radius: 10}}, {polygon: {corners: [[9, -1], [12, -0.5], [12, 0.5], [9, 1]]}, "
     "pattern: {ring: {count: 18, centre: [0, 0]}}}]",
     {10.806, 3.933},
     {0, 11.5}},
    {2,
     "",
     "{add: [{box: {from: [0, 0], to: [1, 1]}}, {disc: {centre: [2, 0], radius: 1}, mirror: {point: [0, 0], "
     "normal: [1, 0], keep: false}}], mirror: {point: [5, 0], normal: [1, 0]}, pattern: {grid: {count: [1, 3], "
     "step: [0, 4]}}}",
     {12, 8.5},
     {2, 0}},
    {2,
     "",
     "{disc: {centre: [3, 0], radius: 1}, pattern: {ring: {count: 2, centre: [0, 0], angle: 90 deg}}}",
     {0, 3},
     {-3, 0}},
    {2,
     "regions: {web: {box: {from: [0, 0], to: [2, 9]}}, both: [{region: web}, {region: web, move: [4, 0]}]}\n",
     "[{region: both}, {box: {from: [0, 9], to: [6, 10]}}]",
     {5, 5},
     {3, 5}},
    {2,
     "regions: {web: {box: {from: [0, 0], to: [4, 4]}}, hole: {disc: {centre: [2, 2], radius: 1}}}\n",
     "[{region: web}, {subtract: {region: hole}}, {add: {region: hole, move: [4, 0]}}]",
     {6, 2},
     {2, 2}},
    {2, "regions: {web: {box: {from: [0, 0], to: [4, 4]}}}\n", "web", {2, 2}, {5, 5}},
    {3, "", "{tube: {from: [0, 0, 0], to: [0, 0, 5], radius: 3, inner: 2}}", {2.5, 0, 1}, {0, 0, 1}},
    {3, "", "{cone: {from: [0, 0, 0], to: [0, 0, 4], from_radius: 3, to_radius: 1}}", {2.4, 0, 0.5}, {2.4, 0, 3}},
    {3, "", "{cone: {from: [0, 0, 0], to: [0, 0, 4], from_radius: 3}}", {0, 0, 3.9}, {1, 0, 3.9}},
    {3, "", "{torus: {centre: [0, 0, 0], axis: [0, 1, 0], radius: 3, section: 1}}", {3, 0, 0}, {0, 3, 0}},
    {3,
     "",
     "{ellipsoid: {centre: [0, 0, 0], radii: [3, 2, 1]}, rotate: {angle: 90 deg, axis: [0, 1, 0]}}",
     {0, 0, 2.9},
     {2.9, 0, 0}},
    {3,
     "",
     "{extrude: {shape: [{disc: {centre: [1, 2], radius: 3}}, {subtract: {ellipse: {centre: [1, 2], radii: "
     "[1, 2]}, rotate: {angle: 0.5 rad}}}], along: y, from: -2, to: 3}}",
     {3.5, 0, 2},
     {1, 0, 2}},
    {3,
     "sections: {web: [{disc: {centre: [1, 2], radius: 3}}, {subtract: {region: hole}}], hole: {disc: {centre: [1, "
     "2], radius: 1}}}\n",
     "[{extrude: {shape: web, from: 0, to: 1}}, {extrude: {shape: [{region: hole}, {region: hole, move: [9, 0]}], "
     "from: -3, to: -2}}]",
     {10, 2, -2.5},
     {1, 2, 0.5}},
    {3,
     "",
     "{cylinder: {from: [0, 0, 0], to: [0, 0, 4], radius: 1}, pattern: {ring: {count: 3, centre: [3, 0, 0], "
     "axis: [0, 0, 2]}}}",
     {3 + 1.5, 2.598, 1},
     {6, 0, 1}},
};

static void test_round_trip_of_solids(void **state)
{
    (void)state;
    char text[2000];
    for (size_t k = 0; k < COUNT_OF(shapes); k++) {
        const struct shown_shape *q = &shapes[k];
        struct scene b;
        scene_text(text, sizeof text, q->dim, q->regions, q->shape);
        struct scene a = read_ok(text, NULL, 0);
        if (!region_contains(&a.body->shape, q->in, q->dim, 0) || region_contains(&a.body->shape, q->out, q->dim, 0))
            fail_msg("%s", q->shape);
        if (scene_read_text(&b, a.text, strlen(a.text), "again.yaml", NULL, 0) != OK)
            fail_msg("%s in\n%s", status_message(), a.text);
        assert_string_equal(a.text, b.text);
        for (int i = 0; i < 500; i++) { /* bitwise equal */
            const real X[] = {i % 8 * 1.7 - 6.3, i / 8 % 8 * 1.6 - 5.1, i / 64 - 3.3};
            assert_true(region_level_set_value(&a.body->shape, X, q->dim) ==
                        region_level_set_value(&b.body->shape, X, q->dim));
        }
        scene_free(&a);
        scene_free(&b);
    }
}

/* ---- filling ----------------------------------------------------------------------------------------------------- */

/* Returns the number of particles of a body with the shape `shape` and the named regions `regions` in `dim`
 * dimensions. */
static int64_t filled(const char *regions, const char *shape, int dim)
{
    char text[2000];
    struct particles p;
    scene_text(text, sizeof text, dim, regions, shape);
    struct scene s = read_ok(text, NULL, 0);
    if (bodies_fill_with_particles(&p, &s, NULL, 0) != OK) fail_msg("%s in\n%s", status_message(), text);
    const int64_t n = p.n;
    particles_free(&p);
    scene_free(&s);
    return n;
}

/* Checks that a body rotated by quarter turns contains the same lattice positions as the unrotated one, also on its
 * surface. */
static void test_filled_alike(void **state)
{
    (void)state;
    static const char *const same[][2] = {
        {"{box: {from: [0, 0], to: [6, 2]}}", "{box: {from: [0, 0], to: [2, 6]}, rotate: {angle: 90 deg}}"},
        {"{disc: {centre: [0.1, 0.7], radius: 3.25}}",
         "{disc: {centre: [0.1, 0.7], radius: 3.25}, rotate: {angle: 180 deg, about: [0.3, 0.2]}}"},
        {"[{box: {from: [0, 0], to: [6, 6]}}, {subtract: [{box: {from: [1, 1], to: [2.25, 2.25]}}, {box: {from: [3.75, "
         "1], to: [5, 2.25]}}]}]",
         "[{box: {from: [0, 0], to: [6, 6]}}, {subtract: {box: {from: [1, 1], to: [2.25, 2.25]}, mirror: {point: "
         "[3, 0], normal: [1, 0]}}}]"},
        {"{box: {from: [0, 0], to: [4, 4]}}", "{polygon: {corners: [[4, 4], [4, 0], [0, 0], [0, 4]]}}"},
        {"{box: {from: [0, 0], to: [4, 2]}}",
         "{box: {from: [0, 0], to: [2, 1]}, pattern: {grid: {count: [2, 2], step: [2, 1]}}}"},
    };
    for (size_t k = 0; k < COUNT_OF(same); k++) assert_int_equal(filled("", same[k][0], 2), filled("", same[k][1], 2));
}

/* Checks that a wheel with slots all around has equal numbers of particles in each quadrant. */
static void test_filled_symmetrically(void **state)
{
    (void)state;
    char text[2000];
    struct particles p;
    int64_t quarter[4] = {0};
    scene_text(text, sizeof text, 2, "",
               "[{disc: {centre: [1.1, 0.3], radius: 10}}, {subtract: {box: {from: [7.1, -0.2], to: [12, 0.8]}, "
               "pattern: {ring: {count: 12, centre: [1.1, 0.3]}}}}]");
    struct scene s = read_ok(text, NULL, 0);
    assert_int_equal(bodies_fill_with_particles(&p, &s, NULL, 0), OK);
    for (int64_t i = 0; i < p.n; i++) quarter[(p.X[0][i] > 1.1) + 2 * (p.X[1][i] > 0.3)]++;
    for (int k = 1; k < 4; k++) assert_int_equal(quarter[k], quarter[0]);
    particles_free(&p);
    scene_free(&s);
}

/* ---- names ------------------------------------------------------------------------------------------------------- */

/* Checks that a name can be used in place of its solids in loads and probes. */
static void test_names(void **state)
{
    (void)state;
    struct scene s = read_ok("space: plane stress\nthickness: 1\nduration: 1 us\nmethod: pd\n"
                             "material: {young: 1 GPa, density: 1000}\n"
                             "regions:\n  grip: {box: {from: [-inf, 0], to: [1, inf]}}\n"
                             "  both: [{region: grip}, {region: grip, move: [9, 0]}]\n"
                             "bodies:\n  - {name: bar, shape: {box: {from: [0, 0], to: [9, 3]}}}\n"
                             "particles: {spacing: 1}\n"
                             "boundary:\n  - {region: both, fixed: all}\n"
                             "initial:\n  - {region: [{all: true}, {subtract: {region: grip}}], velocity: [1, 0]}\n"
                             "probes:\n  - energy: {region: grip}\n",
                             NULL, 0);
    assert_int_equal(s.regions, 2);
    assert_string_equal(s.named[1].name, "both");
    assert_int_equal(s.probe->region.n, 1);
    assert_true(solid_is_untransformed_and_of_kind(s.probe->region.solid, SOLID_BOX) &&
                s.probe->region.solid->to[0] == 1);
    assert_true(region_contains(&s.boundary->region, (real[]){9.5, 1, 0}, 2, 0));
    assert_false(region_contains(&s.boundary->region, (real[]){11, 1, 0}, 2, 0));
    assert_false(region_contains(&s.initial->region, (real[]){0.5, 1, 0}, 2, 0));
    scene_free(&s);
}

/* ---- refusals ---------------------------------------------------------------------------------------------------- */

/* Checks the messages for invalid solids in two and three dimensions. */
static void test_refusals(void **state)
{
    (void)state;
    static const struct {
        int dim;
        const char *regions, *shape, *message;
    } cases[] = {
        {2, "", "{polygon: {corners: [[0, 0], [1, 1], [1, 0], [0, 1]]}}", "a polygon without crossings"},
        {2, "", "{polygon: {corners: [[0, 0], [1, 0], [1, 1]], round: 1}}", "a smaller radius"},
        {2, "", "{polygon: {corners: [[0, 0], [1, 0]]}}", "has 2 items"},
        {2, "", "{polygon: {round: 1}}", "corners: missing in solid.polygon"},
        {2, "", "{tube: {from: [0, 0], to: [1, 1], radius: 1, inner: 0.5}}", "cannot be used in space plane stress"},
        {3, "", "{polygon: {corners: [[0, 0], [1, 0], [1, 1]]}}", "use extrude with a polygon as its shape"},
        {3, "", "{extrude: {shape: {ball: {centre: [0, 0, 0], radius: 1}}, from: 0, to: 1}}",
         "give 2 in the plane of extrude"},
        {2, "", "{ring: {centre: [0, 0], radius: 1, inner: 2}}", "is not below radius"},
        {2, "", "{box: {from: [0, 0], to: [1, 1]}, rotate: {angle: 30}}", "has no unit; give an angle"},
        {2, "", "{box: {from: [0, 0], to: [1, 1]}, rotate: {angle: 30 m}}", "has another unit"},
        {2, "", "{box: {from: [0, 0], to: [1, 1]}, rotate: {angle: 30 deg, axis: [0, 1]}}", "remove axis"},
        {2, "", "{box: {from: [0, 0], to: [1, 1]}, mirror: {point: [0, 0], normal: [0, 0]}}", "has the length 0"},
        {2, "", "{box: {from: [0, 0], to: [1, 1]}, pattern: {grid: {count: [1.5, 2], step: [1, 1]}}}", "whole number"},
        {2, "", "{box: {from: [0, 0], to: [1, 1]}, pattern: {grid: {count: [100, 100], step: [1, 1]}}}", "4096 copies"},
        {2, "", "{box: {from: [0, 0], to: [1, 1]}, disc: {centre: [0, 0], radius: 1}}", "has 2 solids"},
        {2, "", "{rotate: {angle: 30 deg}}", "has 0 solids"},
        {2, "", "{subtract: {box: {from: [0, 0], to: [1, 1]}}}", "has no solid before it from which to subtract"},
        {2, "", "{half-space: {point: [0, 0], normal: [1, 0]}}", "a body cannot be infinite"},
        {2, "", "grip", "the scene has no region of this name"},
        {2, "regions: {grip: {box: {from: [0, 0], to: [1, 1]}}, other: {region: grip}}\n", "girp",
         "there is no region girp; did you mean grip?"},
        {2, "regions: {a: {region: b}, b: [{region: c}], c: {region: a}}\n", "a",
         "region a is part of itself; remove this reference"},
        {2, "regions: {a: {box: {from: [0, 0], to: [-1, 1]}}}\n", "a", "from is not below to"},
        {2, "regions: {a: {box: {from: [0, 0], to: [1, 1]}}, a: {all: true}}\n", "a", "given twice"},
        {2, "regions: {'a b': {box: {from: [0, 0], to: [1, 1]}}}\n", "a b", "is not a name"},
        {2, "regions: 3\n", "a", "is not allowed here; give a mapping"},
        {2, "sections: {a: {box: {from: [0, 0], to: [1, 1]}}}\n", "{box: {from: [0, 0], to: [1, 1]}}",
         "cannot be used in space plane stress; use the key regions there"},
        {3, "regions: {a: {ball: {centre: [0, 0, 0], radius: 1}}}\n", "{extrude: {shape: a, from: 0, to: 1}}",
         "a is not a kind of solid, and the scene has no section of this name; define it by sections: {a: {box: ..}}"},
        {3, "sections: {a: {ball: {centre: [0, 0, 0], radius: 1}}}\n", "{extrude: {shape: a, from: 0, to: 1}}",
         "give 2 in the plane of extrude"},
        {3, "sections: {web: {disc: {centre: [0, 0], radius: 1}}}\n", "{extrude: {shape: wed, from: 0, to: 1}}",
         "there is no section wed; did you mean web?"},
        {3, "sections: {a: [{region: a}]}\n", "{extrude: {shape: a, from: 0, to: 1}}", "a is part of itself"},
    };
    char text[2000];
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        struct scene s;
        scene_text(text, sizeof text, cases[k].dim, cases[k].regions, cases[k].shape);
        assert_int_equal(scene_read_text(&s, text, strlen(text), "a.yaml", NULL, 0), REFUSED);
        if (!strstr(status_message(), cases[k].message))
            fail_msg("%s\nsays: %s\nshould say: %s", text, status_message(), cases[k].message);
        scene_free(&s);
    }
}

/* Checks that names that would expand to a hundred million solids are refused without expanding them. */
static void test_multiplied_names(void **state)
{
    (void)state;
    char text[4000];
    size_t n = (size_t)snprintf(text, sizeof text,
                                "space: plane stress\nregions:\n  a0: {disc: {centre: [0, 0], radius: 1}}\n");
    for (int k = 1; k < 9; k++) {
        n += (size_t)snprintf(text + n, sizeof text - n, "  a%d: [", k);
        for (int j = 0; j < 10; j++) n += (size_t)snprintf(text + n, sizeof text - n, "{region: a%d}, ", k - 1);
        n += (size_t)snprintf(text + n, sizeof text - n, "]\n");
    }
    struct scene s;
    assert_int_equal(scene_read_text(&s, text, n, "a.yaml", NULL, 0), REFUSED);
    assert_non_null(strstr(status_message(), "solids; remove some"));
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip_of_solids),
        cmocka_unit_test(test_filled_alike),
        cmocka_unit_test(test_filled_symmetrically),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_multiplied_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
