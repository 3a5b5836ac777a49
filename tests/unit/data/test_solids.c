/* Solids compared with independent formulas: areas and volumes, distances and their gradients, symmetric copies. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <math.h>
#include <cmocka.h>

#include "base/memory.h"
#include "data/region.h"

static const real pi = 3.14159265358979323846;

/* Returns a pseudo-random number, uniform in [0, 1) (Lehmer's generator modulo 2^31 - 1). *state: of the generator. */
static real random_next(uint64_t *state)
{
    *state = *state * 48271 % 2147483647;
    return (real)*state / 2147483647;
}

/* ---- one of each kind -------------------------------------------------------------------------------------------- */

/* Shapes of the examples: a polygon with and without rounded corners, and a ring. */
static real arrow[][2] = {{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}};
static struct polygon sharp = {5, arrow, 0, NULL, 0}, rounded = {5, arrow, 0.25, NULL, 0};
static struct solid washer = {.kind = SOLID_RING, .radius = 1, .inner = 0.4};

/* Returns the area of the arrow, reduced at each corner of interior angle a by rounding with r: r^2 (1/tan(a/2) - (pi -
 * a)/2). */
static real arrow_area(real r)
{
    real area = 0;
    for (int k = 0; k < 5; k++) {
        const real *a = arrow[(k + 4) % 5], *b = arrow[k], *c = arrow[(k + 1) % 5];
        const real in[] = {a[0] - b[0], a[1] - b[1]}, out[] = {c[0] - b[0], c[1] - b[1]};
        const real angle = acos((in[0] * out[0] + in[1] * out[1]) / hypot(in[0], in[1]) / hypot(out[0], out[1]));
        const real lost = r * r * (1 / tan(angle / 2) - (pi - angle) / 2);
        area += 0.5 * (b[0] * c[1] - b[1] * c[0]) - (k == 3 ? -lost : lost);
    }
    return area;
}

static struct example {
    struct solid s;
    int dim;
    real volume;
} examples[] = {
    {{.kind = SOLID_BOX, .from = {-1, 0, 0.5}, .to = {1, 0.5, 2}}, 3, 1.5},
    {{.kind = SOLID_BALL, .centre = {1, 2}, .radius = 1.5}, 2, 0},
    {{.kind = SOLID_CYLINDER, .from = {0, 0, 0}, .to = {1, 2, 2}, .radius = 0.7}, 3, 0},
    {{.kind = SOLID_ELLIPSOID, .centre = {0.5, -1}, .radii = {2, 0.7}}, 2, 0},
    {{.kind = SOLID_ELLIPSOID, .centre = {0.5, -1, 0}, .radii = {1, 0.5, 2}}, 3, 0},
    {{.kind = SOLID_ELLIPSOID, .radii = {1, 1, 0.3}}, 3, 0},
    {{.kind = SOLID_RING, .centre = {0.5, 0}, .radius = 2, .inner = 1.2}, 2, 0},
    {{.kind = SOLID_TUBE, .from = {0, 0, 0}, .to = {0, 1, 2}, .radius = 1, .inner = 0.6}, 3, 0},
    {{.kind = SOLID_CONE, .from = {0, 0, 0}, .to = {1, 0, 2}, .radius = 1, .inner = 0.4}, 3, 0},
    {{.kind = SOLID_CONE, .from = {0, 0, 0}, .to = {0, 0, 1}, .radius = 0, .inner = 1}, 3, 0},
    {{.kind = SOLID_TORUS, .normal = {0, 1, 1}, .radius = 1, .inner = 0.3}, 3, 0},
    {{.kind = SOLID_POLYGON, .polygon = &sharp}, 2, 0},
    {{.kind = SOLID_POLYGON, .polygon = &rounded}, 2, 0},
    {{.kind = SOLID_EXTRUSION, .region = {.n = 1, .solid = &washer}, .axis = 1, .begin = -0.5, .end = 1}, 3, 0},
};

static void examples_make(void)
{
    int corner;
    const real third = 4 * pi / 3, length = sqrt(5);
    const real volumes[] = {1.5,
                            pi * 2.25,
                            pi * 0.49 * 3,
                            pi * 1.4,
                            third,
                            third * 0.3,
                            pi * (4 - 1.44),
                            pi * 0.64 * length,
                            pi / 3 * length * (1 + 0.4 + 0.16),
                            pi / 3,
                            2 * pi * pi * 0.09,
                            arrow_area(0),
                            arrow_area(0.25),
                            pi * 0.84 * 1.5};
    assert_int_equal(polygon_check_and_compute_rounded_corners(&sharp, &corner), POLYGON_FINE);
    if (!rounded.bend) assert_int_equal(polygon_check_and_compute_rounded_corners(&rounded, &corner), POLYGON_FINE);
    for (size_t k = 0; k < COUNT_OF(examples); k++) examples[k].volume = volumes[k];
}

/* ---- checks of one solid ----------------------------------------------------------------------------------------- */

/* Checks that the volume of the solid s is `volume`, by quasi-random points in a box slightly larger than its bounding
 * box. Tolerance: 2e-3 of the box. */
static void check_volume(const struct solid *s, int dim, real volume)
{
    const struct region r = {.n = 1, .solid = (struct solid *)(uintptr_t)s};
    real from[DIM_MAX], to[DIM_MAX], box = 1;
    assert_true(region_compute_bounding_box_if_finite(&r, dim, from, to));
    for (int d = 0; d < dim; d++) {
        const real edge = to[d] - from[d];
        from[d] -= 0.05 * edge, to[d] += 0.04 * edge, box *= 1.09 * edge;
    }
    assert_float_equal(region_volume_within_box(&r, dim, from, to), volume, 2e-3 * box);
}

/* Checks the bounding box of the solid s by 3000 random points just outside each side: none is in the solid, and the
 * nearest is within 0.15 of it, so that the box is not too large. */
static void check_bounds(const struct solid *s, int dim)
{
    const struct region r = {.n = 1, .solid = (struct solid *)(uintptr_t)s};
    real from[DIM_MAX], to[DIM_MAX], X[DIM_MAX] = {0};
    uint64_t seed = 7;
    assert_true(region_compute_bounding_box_if_finite(&r, dim, from, to));
    for (int side = 0; side < 2 * dim; side++) {
        const int d = side / 2;
        real nearest = INFINITY;
        for (int k = 0; k < 3000; k++) {
            for (int a = 0; a < dim; a++) X[a] = from[a] + random_next(&seed) * (to[a] - from[a]);
            X[d] = side % 2 ? to[d] + 1e-9 : from[d] - 1e-9;
            const real level = solid_level_set_value(s, X, dim);
            assert_true(level > 0);
            nearest = real_min(nearest, level);
        }
        assert_true(nearest < 0.15); /* 3000 points leave no larger gap */
    }
}

/* Checks the signed distance of the solid s at random points by two conditions that define it. It changes by at most
 * the distance between two points. A step back along the normal by the distance leads from outside to the surface.
 * Normals must be unit vectors, and the sign must be that of the level-set value. */
static void check_distance(const struct solid *s, int dim)
{
    uint64_t seed = 99;
    for (int k = 0; k < 2000; k++) {
        real X[DIM_MAX] = {0}, Y[DIM_MAX] = {0}, normal[DIM_MAX] = {0}, other[DIM_MAX] = {0};
        for (int d = 0; d < dim; d++) X[d] = 9 * random_next(&seed) - 4.5;
        const real distance = solid_signed_distance(s, X, dim, normal), level = solid_level_set_value(s, X, dim);
        assert_float_equal(dot(normal, normal, dim), 1, 1e-12);
        assert_true((level > 0) == (distance > 0));
        for (int d = 0; d < dim; d++) Y[d] = X[d] + 0.3 * (2 * random_next(&seed) - 1);
        real apart = 0;
        for (int d = 0; d < dim; d++) apart += square(X[d] - Y[d]);
        assert_true(fabs(solid_signed_distance(s, Y, dim, other) - distance) <= sqrt(apart) * (1 + 1e-9) + 1e-12);
        if (distance <= 0) continue;
        for (int d = 0; d < dim; d++) Y[d] = X[d] - distance * normal[d];
        assert_float_equal(solid_signed_distance(s, Y, dim, other), 0, 1e-7);
    }
}

static void test_every_kind(void **state)
{
    (void)state;
    examples_make();
    for (size_t k = 0; k < COUNT_OF(examples); k++) {
        check_volume(&examples[k].s, examples[k].dim, examples[k].volume);
        check_bounds(&examples[k].s, examples[k].dim);
        check_distance(&examples[k].s, examples[k].dim);
    }
}

/* Checks for every kind of solid that volume, bounding box and distance are also right if it is rotated, mirrored and
 * displaced. */
static void test_every_kind_moved(void **state)
{
    (void)state;
    examples_make();
    for (size_t k = 0; k < COUNT_OF(examples); k++) {
        struct solid s = examples[k].s;
        const int dim = examples[k].dim;
        struct solid_motion turn = {.kind = MOTION_ROTATE, .about = {0.3, 0.1}, .axis = {1, -2, 0.5}, .angle = 0.7};
        struct solid_motion mirror = {.kind = MOTION_MIRROR, .about = {0.2}, .axis = {1, 0.5, 0}};
        struct solid_motion move = {.kind = MOTION_MOVE, .step = {0.3, -0.2, 0.1}};
        assert_true(solid_apply_motion_unless_too_many_copies(&s, &turn, dim) &&
                    solid_apply_motion_unless_too_many_copies(&s, &mirror, dim) &&
                    solid_apply_motion_unless_too_many_copies(&s, &move, dim));
        assert_int_equal(s.images, 1);
        check_volume(&s, dim, examples[k].volume);
        check_bounds(&s, dim);
        check_distance(&s, dim);
        memory_free(s.image), memory_free(s.motion), box_tree_free(&s.tree);
    }
}

/* ---- copies ------------------------------------------------------------------------------------------------------ */

/* Checks that a box rotated by quarter turns about its corner is bitwise equal to the box with exchanged corners. */
static void test_quarter_turns(void **state)
{
    (void)state;
    const real corners[4][4] = {{1, 2, 4, 3}, {-3, 1, -2, 4}, {-4, -3, -1, -2}, {2, -4, 3, -1}};
    for (int k = 0; k < 4; k++) {
        struct solid s = {.kind = SOLID_BOX, .from = {1, 2}, .to = {4, 3}};
        struct solid_motion turn = {.kind = MOTION_ROTATE, .angle = k * 90 * pi / 180};
        real from[DIM_MAX], to[DIM_MAX];
        assert_true(solid_apply_motion_unless_too_many_copies(&s, &turn, 2));
        assert_true(region_compute_bounding_box_if_finite(&(struct region){.n = 1, .solid = &s}, 2, from, to));
        assert_true(from[0] == corners[k][0] && from[1] == corners[k][1]);
        assert_true(to[0] == corners[k][2] && to[1] == corners[k][3]);
        memory_free(s.image), memory_free(s.motion), box_tree_free(&s.tree);
    }
}

/* Checks that a wheel of 18 teeth is invariant under rotation by one tooth, and has the area of the teeth. */
static void test_gear(void **state)
{
    (void)state;
    real tooth[][2] = {{9, -1}, {12, -0.5}, {12, 0.5}, {9, 1}};
    struct polygon flank = {4, tooth, 0, NULL, 0};
    struct solid s[2] = {{.kind = SOLID_BALL, .radius = 10}, {.kind = SOLID_POLYGON, .polygon = &flank}};
    struct solid_motion ring = {.kind = MOTION_RING, .count = {18}, .angle = 2 * pi / 18};
    const struct region gear = {.n = 2, .solid = s};
    int corner;
    uint64_t seed = 3;
    assert_int_equal(polygon_check_and_compute_rounded_corners(&flank, &corner), POLYGON_FINE);
    assert_true(solid_apply_motion_unless_too_many_copies(&s[1], &ring, 2));
    assert_int_equal(s[1].images, 18);
    for (int k = 0; k < 5000; k++) {
        const real r = 8 + 5 * random_next(&seed), angle = 2 * pi * random_next(&seed), turned = angle + 7 * pi / 9;
        const real X[] = {r * cos(angle), r * sin(angle), 0}, Y[] = {r * cos(turned), r * sin(turned), 0};
        assert_float_equal(region_level_set_value(&gear, X, 2), region_level_set_value(&gear, Y, 2), 1e-13);
    }
    /* Area of a tooth beyond the wheel, by strips along it. */
    real area = pi * 100;
    enum { STRIPS = 20000 };
    for (int k = 0; k < STRIPS; k++) {
        const real y = (k + 0.5) / STRIPS, end = y < 0.5 ? 12 : 12 - (y - 0.5) * 6;
        area += 18 * 2 * real_max(0, end - sqrt(100 - y * y)) / STRIPS;
    }
    const real from[] = {-12, -12, 0}, to[] = {12, 12, 0};
    assert_float_equal(region_volume_within_box(&gear, 2, from, to), area, 1e-3 * 576);
    memory_free(s[1].image), memory_free(s[1].motion), box_tree_free(&s[1].tree);
}

/* Checks that a grid of holes equals a list of the holes, that a mirror image equals a hole at its position, and that a
 * grid of too many copies is refused. */
static void test_grid_and_mirror(void **state)
{
    (void)state;
    struct solid hole = {.kind = SOLID_BALL, .subtract = true, .centre = {1, 1}, .radius = 0.3}, list[7];
    struct solid plate = {.kind = SOLID_BOX, .to = {6, 4}};
    struct solid_motion grid = {.kind = MOTION_GRID, .count = {3, 2}, .step = {2, 2}};
    struct solid_motion mirror = {.kind = MOTION_MIRROR, .about = {3, 0}, .axis = {2, 0}, .keep = true};
    uint64_t seed = 5;
    list[0] = plate;
    for (int k = 0; k < 6; k++) {
        list[1 + k] = hole;
        list[1 + k].centre[0] += 2 * (k % 3), list[1 + k].centre[1] += 2 * (k / 3);
    }
    struct solid holes = hole, two = hole;
    assert_true(solid_apply_motion_unless_too_many_copies(&holes, &grid, 2) &&
                solid_apply_motion_unless_too_many_copies(&two, &mirror, 2));
    struct solid perforated[] = {plate, holes}, pair[] = {plate, two}, said[] = {plate, hole, list[3]};
    for (int k = 0; k < 4000; k++) {
        const real X[] = {7 * random_next(&seed) - 0.5, 5 * random_next(&seed) - 0.5, 0};
        real one[DIM_MAX], other[DIM_MAX];
        assert_float_equal(region_level_set_value(&(struct region){.n = 2, .solid = perforated}, X, 2),
                           region_level_set_value(&(struct region){.n = 7, .solid = list}, X, 2), 1e-13);
        assert_float_equal(region_signed_distance(&(struct region){.n = 2, .solid = pair}, X, 2, one),
                           region_signed_distance(&(struct region){.n = 3, .solid = said}, X, 2, other), 1e-13);
    }
    memory_free(holes.image), memory_free(holes.motion), memory_free(two.image), memory_free(two.motion);
    box_tree_free(&holes.tree), box_tree_free(&two.tree);
    struct solid many = hole;
    grid.count[0] = 3000;
    assert_false(solid_apply_motion_unless_too_many_copies(&many, &grid, 2));
}

/* ---- index ------------------------------------------------------------------------------------------------------- */

/* Evaluates the regions a and b at `places` random positions, also on surfaces, and checks that the results are bitwise
 * equal. */
static void check_same(const struct region *a, const struct region *b, int dim, int places)
{
    uint64_t seed = 13;
    for (int k = 0; k < places; k++) {
        real X[DIM_MAX] = {0}, one[DIM_MAX], other[DIM_MAX];
        for (int d = 0; d < dim; d++) X[d] = 24 * random_next(&seed) - 2;
        for (int d = 0; d < dim && k % 4 == 0; d++) X[d] = nearbyint(X[d]);
        const real level = region_level_set_value(a, X, dim), grown[] = {0, 0.4, -0.4, 2, level, -level};
        assert_true(level == region_level_set_value(b, X, dim));
        assert_true(region_signed_distance(a, X, dim, one) == region_signed_distance(b, X, dim, other));
        for (int d = 0; d < dim; d++) assert_true(one[d] == other[d]);
        for (size_t t = 0; t < COUNT_OF(grown); t++) {
            assert_true(region_contains(a, X, dim, grown[t]) == (level <= grown[t]));
            assert_true(region_contains(b, X, dim, grown[t]) == (level <= grown[t]));
        }
    }
}

enum { MANY = 200 };

static void many_free(struct solid *list)
{
    for (int k = 0; k < MANY; k++) {
        memory_free(list[k].image), memory_free(list[k].motion);
        box_tree_free(&list[k].tree);
    }
}

/* Checks that search trees do not change results: a list of 200 solids of all kinds, many of them rotated, in sequences
 * that are added, subtracted and intersected, has bitwise equal results with and without trees. */
static void test_index_of_list(void **state)
{
    (void)state;
    examples_make();
    for (int dim = 2; dim <= 3; dim++) {
        struct solid list[MANY];
        uint64_t seed = 3;
        for (int k = 0; k < MANY; k++) {
            const struct example *e;
            do e = &examples[(size_t)(random_next(&seed) * COUNT_OF(examples))];
            while (e->dim != dim);
            struct solid_motion turn = {.kind = MOTION_ROTATE, .axis = {1, 2, 3}, .angle = 6 * random_next(&seed)};
            struct solid_motion move = {.kind = MOTION_MOVE};
            for (int d = 0; d < dim; d++) move.step[d] = 20 * random_next(&seed);
            list[k] = e->s;
            list[k].subtract = k / 30 % 2;
            if (k == 70) continue;
            assert_true((k % 3 == 0 || solid_apply_motion_unless_too_many_copies(&list[k], &turn, dim)) &&
                        solid_apply_motion_unless_too_many_copies(&list[k], &move, dim));
        }
        list[70] = (struct solid){.kind = SOLID_BALL, .intersect = true, .centre = {10, 10, 10}, .radius = 11};
        const struct region plain = {.n = MANY, .solid = list};
        struct region indexed = plain;
        region_build_search_trees(&indexed, dim);
        assert_int_equal(indexed.runs, 9);
        check_same(&plain, &indexed, dim, 800);
        struct solid group = {.kind = SOLID_GROUP, .region = indexed};
        check_same(&plain, &(struct region){.n = 1, .solid = &group}, dim, 200);
        for (int j = 0; j < indexed.runs; j++) box_tree_free(&indexed.run[j].tree);
        memory_free(indexed.run);
        many_free(list);
    }
}

/* Checks that a solid with 200 copies has results bitwise equal to those of a list of the copies, in 2D and as an
 * extrusion. */
static void test_index_of_copies(void **state)
{
    (void)state;
    const struct solid_motion turn = {.kind = MOTION_ROTATE, .angle = 0.7, .axis = {0, 1, 2}},
                              grid = {.kind = MOTION_GRID, .count = {10, 20, 1}, .step = {2, 1, 0}};
    struct solid plate[] = {{.kind = SOLID_BOX, .to = {20, 20}},
                            {.kind = SOLID_BOX, .subtract = true, .from = {0, 0, -1}, .to = {1.4, 0.3, 1}}},
                 list[MANY];
    assert_true(solid_apply_motion_unless_too_many_copies(&plate[1], &turn, 2) &&
                solid_apply_motion_unless_too_many_copies(&plate[1], &grid, 2));
    for (int k = 0; k < MANY; k++) {
        list[k] = plate[1], list[k].image = &plate[1].image[k], list[k].images = 1;
        const struct bounds endless = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
        box_tree_make(&list[k].tree, &endless, 1, 2);
        list[k].subtract = false;
    }
    const struct solid all = {.kind = SOLID_GROUP, .subtract = true, .region = {.n = MANY, .solid = list}};
    struct solid said[] = {plate[0], all};
    const struct region a = {.n = 2, .solid = plate}, b = {.n = 2, .solid = said};
    struct solid one = {.kind = SOLID_EXTRUSION, .axis = 1, .begin = 0, .end = 20, .region = a}, other = one;
    other.region = b;
    check_same(&a, &b, 2, 2000);
    check_same(&(struct region){.n = 1, .solid = &one}, &(struct region){.n = 1, .solid = &other}, 3, 500);
    for (int k = 0; k < MANY; k++) box_tree_free(&list[k].tree);
    memory_free(plate[1].image), memory_free(plate[1].motion), box_tree_free(&plate[1].tree);
}

/* Checks that an intersection contains exactly the points that all of its solids contain, surfaces included, and that
 * its bounding box is the intersection of theirs. */
static void test_intersection(void **state)
{
    (void)state;
    struct solid s[] = {{.kind = SOLID_BALL, .intersect = true, .radius = 2},
                        {.kind = SOLID_HALF_SPACE, .intersect = true, .point = {0.5}, .normal = {2, 0}}};
    const struct region r = {.n = 2, .solid = s};
    struct solid group = {.kind = SOLID_GROUP, .region = r};
    real from[DIM_MAX], to[DIM_MAX];
    uint64_t seed = 11;
    assert_true(region_compute_bounding_box_if_finite(&r, 2, from, to));
    assert_true(from[0] == -2 && to[0] == 0.5 && from[1] == -2 && to[1] == 2);
    assert_true(region_contains(&r, (real[]){0.5, 0, 0}, 2, 0) && region_contains(&r, (real[]){-2, 0, 0}, 2, 0));
    assert_false(region_contains(&r, (real[]){0.6, 0, 0}, 2, 0));
    for (int k = 0; k < 2000; k++) {
        const real X[] = {5 * random_next(&seed) - 2.5, 5 * random_next(&seed) - 2.5, 0};
        const bool inside = hypot(X[0], X[1]) <= 2 && X[0] <= 0.5;
        assert_true(region_contains(&r, X, 2, 0) == inside);
        assert_true(region_contains(&(struct region){.n = 1, .solid = &group}, X, 2, 0) == inside);
    }
    check_distance(&s[0], 2);
}

/* Checks that invalid polygons are detected: rounding radii that are too large, edges that cross or touch, edges
 * without length. */
static void test_polygon_faults(void **state)
{
    (void)state;
    static struct {
        real corner[4][2];
        int n;
        real round;
        enum polygon_fault fault;
    } q[] = {
        {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 4, 0.5, POLYGON_FINE},
        {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 4, 0.51, POLYGON_TIGHT},
        {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 4, 0, POLYGON_CROSSED},
        {{{0, 0}, {1, 0}, {0.5, 0}, {0, 1}}, 4, 0, POLYGON_CROSSED},
        {{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, 4, 0, POLYGON_SHORT},
        {{{0, 0}, {1, 1}, {2, 2}}, 3, 0, POLYGON_CROSSED},
    };
    for (size_t k = 0; k < COUNT_OF(q); k++) {
        struct polygon p = {q[k].n, q[k].corner, q[k].round, NULL, 0};
        int corner;
        assert_int_equal(polygon_check_and_compute_rounded_corners(&p, &corner), q[k].fault);
        memory_free(p.bend);
    }
}

/* ---- cracks and planes of symmetry ------------------------------------------------------------------------------- */

/* Checks the mirror images of cracks in planes of symmetry. A crack that crosses a plane keeps its inner part and has
 * an image with its corners in reverse order; a crack farther from the plane than bonds reach has none. With two planes
 * a crack at their corner has three images. */
static void test_mirrored_cracks(void **state)
{
    (void)state;
    real across[2][DIM_MAX] = {{-0.7, 0.9}, {1.3, 2.9}}, far[2][DIM_MAX] = {{3.2, 4}, {5, 4.7}};
    const struct crack crack[] = {{.n = 2, .corner = across}, {.n = 2, .corner = far}};
    const struct mirror_plane plane[] = {{.axis = 0, .outside = -1, .at = 0.3}, {.axis = 1, .outside = -1, .at = 1.9}};
    struct crack_list list;
    cracks_make_mirror_images(&list, crack, 2, plane, 1, 1.1, 1e-9);
    assert_int_equal(list.n, 3);
    const real meets = 0.9 + 2.9 - 0.9 - 1; /* the crack crosses the plane x = 0.3 midway, at y = 1.9 */
    const real expected[3][2][2] = {{{0.3, meets}, {1.3, 2.9}}, {{3.2, 4}, {5, 4.7}}, {{-0.7, 2.9}, {0.3, meets}}};
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 2; a++)
            for (int d = 0; d < 2; d++) assert_true(fabs(list.crack[k].corner[a][d] - expected[k][a][d]) < 1e-12);
    assert_true(list.of[0] == 0 && list.of[1] == 1 && list.of[2] == 0);
    crack_list_free(&list);
    cracks_make_mirror_images(&list, crack, 1, plane, 2, 1.1, 1e-9);
    assert_int_equal(list.n, 4);
    for (int k = 0; k < 4; k++) { /* ends distant from the corner of the planes, all four mirrored */
        const struct crack *c = &list.crack[k];
        const real *end = hypot(c->corner[0][0] - 0.3, c->corner[0][1] - 1.9) > 0.5 ? c->corner[0] : c->corner[1];
        assert_true(fabs(fabs(end[0] - 0.3) - 1) < 1e-12 && fabs(fabs(end[1] - 1.9) - 1) < 1e-12);
        for (int other = 0; other < k; other++)
            assert_true(list.crack[other].corner[0][0] != c->corner[0][0] ||
                        list.crack[other].corner[0][1] != c->corner[0][1] ||
                        list.crack[other].corner[1][1] != c->corner[1][1]);
    }
    crack_list_free(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_kind),      cmocka_unit_test(test_every_kind_moved),
        cmocka_unit_test(test_quarter_turns),   cmocka_unit_test(test_gear),
        cmocka_unit_test(test_grid_and_mirror), cmocka_unit_test(test_intersection),
        cmocka_unit_test(test_polygon_faults),  cmocka_unit_test(test_index_of_list),
        cmocka_unit_test(test_index_of_copies), cmocka_unit_test(test_mirrored_cracks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
