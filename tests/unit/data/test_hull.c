/* Closed and open triangulated surfaces compared with closed forms: volumes of ball and torus, winding numbers,
 * distances; surfaces that are reversed or have holes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/memory.h"
#include "data/hull.h"

static const real pi = 3.14159265358979323846;

/* A surface on a grid of n x m quadrilaterals that is periodic in both directions (torus) or has poles (ball): corners
 * and triangular faces. */
struct grid_hull {
    int64_t corners, faces;
    real (*corner)[DIM_MAX];
    int32_t (*face)[DIM_MAX];
};

static void place_on(bool torus, real a, real b, real *X)
{
    const real out = torus ? 2 + 0.5 * cos(b) : sin(b / 2);
    X[0] = out * cos(a), X[1] = out * sin(a), X[2] = torus ? 0.5 * sin(b) : -cos(b / 2);
}

static struct grid_hull grid_make(bool torus, int n, int m)
{
    struct grid_hull g = {.corners = (int64_t)n * (m + 1)};
    g.corner = memory_new("test", g.corners, sizeof *g.corner);
    g.face = memory_new("test", 2 * (int64_t)n * m, sizeof *g.face);
    for (int j = 0; j <= m; j++)
        for (int i = 0; i < n; i++) place_on(torus, 2 * pi * i / n, 2 * pi * j / m, g.corner[j * n + i]);
    for (int j = 0; j < m; j++)
        for (int i = 0; i < n; i++) {
            const int right = (i + 1) % n, up = torus ? (j + 1) % m : j + 1;
            int32_t q[4] = {j * n + i, j * n + right, up * n + right, up * n + i};
            for (int c = 0; c < 4 && !torus; c++) /* a pole is one corner */
                if (q[c] < n || q[c] >= m * n) q[c] = q[c] < n ? 0 : m * n;
            const int32_t pair[2][DIM_MAX] = {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
            memcpy(g.face[g.faces], pair, sizeof pair);
            g.faces += 2;
        }
    return g;
}

static void hull_of(struct hull *hull, const struct grid_hull *g)
{
    hull_make_closed_surface(hull, 3, g->corners, g->corner, g->faces, g->face);
}

static void ball_and_torus(void **state)
{
    (void)state;
    for (int torus = 0; torus < 2; torus++) {
        const struct grid_hull g = grid_make(torus, 96, 96);
        const real volume = torus ? 2 * pi * pi * 2 * 0.25 : 4 * pi / 3;
        struct hull s;
        hull_of(&s, &g);
        assert_int_equal(s.open_edges, 0);
        assert_int_equal(s.shells, 1);
        assert_false(s.reversed);
        /* Tolerance: chords of 96 sides, 1 - sin(2 pi/n)/(2 pi/n) in each of two directions. */
        assert_true(fabs(s.volume / volume - 1) < 0.003);
        for (int k = 0; k < 400; k++) {
            const real a = 0.1 + k * 2.399963, X[] = {3 * sin(1.1 * k), 3 * cos(a), sin(0.7 * k)};
            const real out = sqrt(X[0] * X[0] + X[1] * X[1]);
            const real exact =
                torus ? sqrt(square(out - 2) + square(X[2])) - 0.5 : sqrt(square(out) + square(X[2])) - 1;
            real normal[DIM_MAX];
            assert_true(fabs(hull_winding_number(&s, X) - (exact < 0)) < 0.04 || fabs(exact) < 0.003);
            const real distance = hull_signed_distance(&s, X, normal);
            assert_true(fabs(distance - exact) < 0.003);
            const real most[] = {0, 0.4, -0.4, distance, nextafter(distance, -9)};
            for (int t = 0; t < 5; t++)
                assert_true(hull_point_is_within_distance(&s, X, most[t]) == (distance <= most[t]));
            assert_true(fabs(dot(normal, normal, 3) - 1) < 1e-12);
            const real along =
                torus ? (X[0] * normal[0] + X[1] * normal[1]) / out * (out - 2) + X[2] * normal[2] : dot(X, normal, 3);
            if (fabs(exact) > 0.02 && fabs(exact + 0.5) > 0.1 && fabs(exact + 1) > 0.1)
                assert_true(along > 0.9 * (exact + (torus ? 0.5 : 1)));
        }
        hull_free(&s);
    }
}

/* Checks hull_is_convex_near_point: a ball is convex everywhere, a torus on its outer side but not on its inner one;
 * the answer is false where too many faces are near. */
static void convex_near(void **state)
{
    (void)state;
    for (int torus = 0; torus < 2; torus++) {
        const struct grid_hull g = grid_make(torus, 16, 16), fine = grid_make(torus, 96, 96);
        struct hull s, t;
        hull_of(&s, &g), hull_of(&t, &fine);
        assert_true(hull_is_convex_near_point(&s, (real[]){torus ? 2.4 : 0.9, 0, 0}, 0.15));
        assert_int_equal(hull_is_convex_near_point(&s, (real[]){torus ? 1.6 : 0.9, 0, 0}, 0.3), !torus);
        assert_false(hull_is_convex_near_point(&t, (real[]){0.9, 0, 0}, 3));
        hull_free(&s), hull_free(&t);
    }
}

/* Checks that a surface with inward normals is recognised as reversed and used with outward normals, and the number of
 * open edges and of uncertain positions of a ball with a small hole and of half a ball. */
static void turned_and_open(void **state)
{
    (void)state;
    struct grid_hull g = grid_make(false, 24, 24);
    struct hull s;
    for (int64_t k = 0; k < g.faces; k++) {
        const int32_t first = g.face[k][0];
        g.face[k][0] = g.face[k][1], g.face[k][1] = first;
    }
    hull_of(&s, &g);
    assert_true(s.reversed && s.open_edges == 0 && s.volume > 4);
    assert_true(hull_signed_distance(&s, (real[]){0, 0, 0}, NULL) < -0.97);
    hull_free(&s);
    /* A hole of two of 1104 faces: the middle is inside, and few positions are uncertain. */
    g = grid_make(false, 24, 24);
    memmove(g.face + 500, g.face + 502, sizeof *g.face * (size_t)(g.faces - 502));
    g.faces -= 2;
    hull_of(&s, &g);
    assert_int_equal(s.open_edges, 4);
    assert_true(hull_sample_winding_number_statistics(&s).unclear < 0.01);
    assert_true(hull_winding_number(&s, (real[]){0, 0, 0}) > 0.98);
    hull_free(&s);
    /* Half a ball is not closed. */
    g = grid_make(false, 24, 24);
    g.faces /= 2;
    hull_of(&s, &g);
    assert_int_equal(s.open_edges, 24);
    assert_true(hull_sample_winding_number_statistics(&s).unclear > 0.1);
    hull_free(&s);
}

/* Checks the winding numbers of a ball of radius 1/2 inside a ball: the volume that both enclose is found to be
 * enclosed twice if both have outward normals, but not if the inner one is a cavity. Tolerance 5 %: random positions.
 */
static void ball_in_ball(void **state)
{
    (void)state;
    for (int cavity = 0; cavity < 2; cavity++) {
        struct grid_hull g = grid_make(false, 24, 24);
        const struct grid_hull inner = grid_make(false, 24, 24);
        struct hull s;
        GROW("test", g.corner, 2 * g.corners);
        GROW("test", g.face, 2 * g.faces);
        for (int64_t k = 0; k < inner.corners; k++)
            for (int d = 0; d < DIM_MAX; d++) g.corner[g.corners + k][d] = inner.corner[k][d] / 2;
        for (int64_t k = 0; k < inner.faces; k++)
            for (int c = 0; c < DIM_MAX; c++)
                g.face[g.faces + k][c] = (int32_t)g.corners + inner.face[k][cavity && c < 2 ? 1 - c : c];
        g.corners += inner.corners, g.faces += inner.faces;
        hull_of(&s, &g);
        memory_free(inner.corner);
        memory_free(inner.face);
        assert_int_equal(s.shells, 2);
        const real twice = hull_sample_winding_number_statistics(&s).enclosed_again, ball = 4 * 3.14159265 / 3 / 8;
        assert_true(fabs(twice - (cavity ? 0 : ball)) < 0.05 * ball);
        hull_free(&s);
    }
}

/* Checks that one of two equal faces is kept, and that two faces of opposite orientation are both removed. */
static void doubles(void **state)
{
    (void)state;
    struct grid_hull g = grid_make(true, 12, 12);
    struct hull s;
    g.face = memory_resize("test", g.face, g.faces, g.faces + 3, sizeof *g.face);
    memcpy(g.face[g.faces], g.face[7], sizeof *g.face);
    memcpy(g.face[g.faces + 1], (int32_t[]){0, 50, 90}, sizeof *g.face);
    memcpy(g.face[g.faces + 2], (int32_t[]){50, 0, 90}, sizeof *g.face);
    g.faces += 3;
    hull_of(&s, &g);
    assert_int_equal(s.faces, 288);
    assert_int_equal(s.dropped, 1);
    assert_int_equal(s.open_edges, 0);
    hull_free(&s);
}

/* Checks a closed surface in 2D, a square with a square hole: area, signed distances, normals and winding number. */
static void plane_ring(void **state)
{
    (void)state;
    static const real at[8][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}};
    real(*corner)[DIM_MAX] = memory_new("test", 8, sizeof *corner);
    int32_t(*face)[DIM_MAX] = memory_new("test", 8, sizeof *face);
    struct hull s;
    for (int k = 0; k < 8; k++) {
        corner[k][0] = at[k][0], corner[k][1] = at[k][1];
        face[k][0] = k, face[k][1] = k / 4 * 4 + (k + 1) % 4;
    }
    hull_make_closed_surface(&s, 2, 8, corner, 8, face);
    assert_int_equal(s.shells, 2);
    assert_true(fabs(s.volume - 12) < 1e-12);
    real normal[DIM_MAX];
    assert_true(fabs(hull_signed_distance(&s, (real[]){2, 2}, normal) - 1) < 1e-12);
    assert_true(fabs(hull_signed_distance(&s, (real[]){0.25, 2}, normal) + 0.25) < 1e-12);
    assert_true(normal[0] < -0.999);
    assert_true(fabs(hull_signed_distance(&s, (real[]){-3, -4}, normal) - 5) < 1e-12);
    assert_true(fabs(normal[0] + 0.6) < 1e-12 && fabs(normal[1] + 0.8) < 1e-12);
    assert_true(fabs(hull_winding_number(&s, (real[]){0.5, 0.5}) - 1) < 1e-12);
    hull_free(&s);
}

/* Checks that points and lines, as open surfaces, have a distance, but no interior. */
static void open_ones(void **state)
{
    (void)state;
    real(*corner)[DIM_MAX] = memory_new("test", 3, sizeof *corner);
    int32_t(*face)[DIM_MAX] = memory_new("test", 2, sizeof *face);
    struct hull s;
    corner[1][0] = 1, corner[2][1] = 5;
    face[0][1] = face[0][2] = 1;
    face[1][0] = face[1][1] = face[1][2] = 2;
    hull_make_open_surface(&s, 3, 3, corner, 2, face);
    assert_true(fabs(hull_signed_distance(&s, (real[]){0.5, 0, 2}, NULL) - 2) < 1e-12);
    assert_true(fabs(hull_signed_distance(&s, (real[]){0, 5, -1}, NULL) - 1) < 1e-12);
    assert_true(hull_signed_distance(&s, (real[]){0, 5, 0}, NULL) == 0);
    assert_true(hull_point_is_within_distance(&s, (real[]){0, 5, 0}, 0) &&
                hull_point_is_within_distance(&s, (real[]){0, 5, 1}, 1));
    assert_false(hull_point_is_within_distance(&s, (real[]){0, 5, 1}, 0.999) ||
                 hull_point_is_within_distance(&s, (real[]){0, 5, 0}, -1));
    hull_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ball_and_torus), cmocka_unit_test(turned_and_open), cmocka_unit_test(ball_in_ball),
        cmocka_unit_test(doubles),        cmocka_unit_test(plane_ring),      cmocka_unit_test(open_ones),
        cmocka_unit_test(convex_near),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
