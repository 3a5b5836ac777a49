/* Colours, the particle types of an export for the particles at cut bonds: the colours of two particles determine
 * whether their bond is cut. Checked for cracks in any direction on a lattice and for irregular particles, where keys
 * are not unique. Further: the number of colours does not grow with the length of a straight crack, and a pair of
 * colours with both kinds of bonds is detected. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <cmocka.h>

#include "base/memory.h"
#include "src/export/export_parts.h"

enum { REACH = 3, PERIOD = 2 * REACH + 1 };

/* Points X[n] of a plane, and a crack from (0, 0) to (a, b). */
struct points {
    int n;
    double (*X)[2];
    double a, b;
};

static bool near_each_other(const double *p, const double *q)
{
    return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) <= 3.015 * 3.015;
}

/* Returns true if the segment p-q crosses the segment of s from (0, 0) to (a, b), by areas of triangles. */
static bool crosses(const struct points *s, const double *p, const double *q)
{
    const double d0 = s->a * p[1] - s->b * p[0], d1 = s->a * q[1] - s->b * q[0];
    const double x = q[0] - p[0], y = q[1] - p[1];
    const double e0 = x * (0 - p[1]) - y * (0 - p[0]), e1 = x * (s->b - p[1]) - y * (s->a - p[0]);
    return d0 * d1 < 0 && e0 * e1 < 0;
}

static uint64_t key_of_point(const struct points *s, int i)
{
    uint64_t key = 0;
    const long x = lround(s->X[i][0]), y = lround(s->X[i][1]);
    for (int j = 0; j < s->n; j++)
        if (near_each_other(s->X[i], s->X[j]) && crosses(s, s->X[i], s->X[j]))
            key += (uint64_t)(lround(s->X[j][0]) - x + 100) * 1000003u +
                   (uint64_t)(lround(s->X[j][1]) - y + 100) * 7919u * 7919u;
    return key * PERIOD * PERIOD + (uint64_t)((x % PERIOD + PERIOD) % PERIOD * PERIOD + (y % PERIOD + PERIOD) % PERIOD);
}

/* Lists all particles of s that have a bond which the crack cuts, and their neighbours, by testing all pairs. */
static struct particles_at_cut_bonds touched_of(const struct points *s)
{
    struct particles_at_cut_bonds t = {0};
    int *number = NEW("test", s->n, int);
    t.particle = NEW("test", s->n, int32_t), t.key = NEW("test", s->n, uint64_t);
    for (int i = 0; i < s->n; i++) {
        number[i] = -1;
        for (int j = 0; j < s->n && number[i] < 0; j++)
            if (near_each_other(s->X[i], s->X[j]) && crosses(s, s->X[i], s->X[j])) {
                t.key[t.n] = key_of_point(s, i);
                t.particle[t.n] = i;
                number[i] = (int)t.n++;
            }
    }
    t.first = NEW("test", t.n + 1, int64_t), t.near = NEW("test", 40 * t.n + 1, int32_t),
    t.cut = NEW("test", 40 * t.n + 1, uint8_t);
    for (int64_t k = 0; k < t.n; k++) {
        t.first[k + 1] = t.first[k];
        for (int j = 0; j < s->n; j++) {
            const int i = t.particle[k];
            if (j == i || number[j] < 0 || !near_each_other(s->X[i], s->X[j])) continue;
            t.near[t.first[k + 1]] = number[j];
            t.cut[t.first[k + 1]++] = crosses(s, s->X[i], s->X[j]);
        }
    }
    memory_free(number);
    return t;
}

static struct points lattice(int edge, double a, double b, double shake)
{
    struct points s = {edge * edge, memory_new("test", edge * edge, sizeof(double[2])), a, b};
    for (int i = 0; i < s.n; i++) {
        s.X[i][0] = i % edge - 9.5 + shake * (rand() / (double)RAND_MAX - 0.5);
        s.X[i][1] = i / edge - 9.5 + shake * (rand() / (double)RAND_MAX - 0.5);
    }
    return s;
}

/* Colours the points of s at cut bonds and checks that two near points are cut apart by the crack if and only if their
 * pair of colours is. Returns the number of colours. */
static int colours_of(const struct points *s)
{
    struct particles_at_cut_bonds t = touched_of(s);
    int32_t *colour = NEW("test", t.n, int32_t);
    const int n = particles_at_cut_bonds_assign_and_count_colours(colour, &t);
    uint8_t *pair = colour_pairs_classify_as_bonded_or_cut(colour, n, &t);
    assert_non_null(pair);
    for (int64_t k = 0; k < t.n; k++)
        for (int64_t m = 0; m < t.n; m++) {
            const double *p = s->X[t.particle[k]], *q = s->X[t.particle[m]];
            assert_true(colour[k] >= 0 && colour[k] < n);
            if (k == m || !near_each_other(p, q)) continue;
            assert_int_equal(pair[colour[k] * n + colour[m]] == PAIR_CUT, crosses(s, p, q));
        }
    memory_free(pair);
    memory_free(colour);
    particles_at_cut_bonds_free(&t);
    return n;
}

static int colours_with(int edge, double a, double b, double shake)
{
    struct points s = lattice(edge, a, b, shake);
    const int n = colours_of(&s);
    memory_free(s.X);
    return n;
}

static void cracks_on_a_lattice(void **state)
{
    static const double end[][2] = {{6.2, 0.03}, {0.02, -7.1}, {5.4, 3.2}, {-6.3, 4.4}, {-4.1, -6.9}, {0.3, 0.4}};
    (void)state;
    for (size_t k = 0; k < COUNT_OF(end); k++) assert_true(colours_with(20, end[k][0], end[k][1], 0) > 0);
}

/* Checks that a straight crack with two ends needs fewer than 80 colours (63, counted by hand from the regions of the
 * plate in LAMMPS), and a longer one equally many. */
static void length_does_not_count(void **state)
{
    (void)state;
    const int of_short = colours_with(34, 14.2, 0.01, 0), of_long = colours_with(34, 21.2, 0.01, 0);
    assert_int_equal(of_short, of_long);
    assert_true(of_short < 80);
}

static void scattered_particles(void **state)
{
    (void)state;
    srand(7);
    for (int k = 0; k < 20; k++) assert_true(colours_with(20, 6.2 - k, 0.7 * k - 5.1, 0.1 + 0.1 * k) > 0);
}

/* Checks that a pair of colours with both kinds of bonds is detected: two particles of one colour, one cut off from a
 * third particle and one bonded to it. */
static void both_kinds_are_found(void **state)
{
    int32_t particle[] = {0, 1, 2}, near[] = {2, 2, 0, 1}, colour[] = {0, 0, 1}, own[] = {0, 1, 2};
    int64_t first[] = {0, 1, 2, 4};
    uint8_t cut[] = {1, 0, 1, 0}, *pair;
    uint64_t key[] = {5, 5, 6};
    const struct particles_at_cut_bonds t = {3, particle, first, near, cut, key};
    (void)state;
    assert_null(colour_pairs_classify_as_bonded_or_cut(colour, 2, &t));
    pair = colour_pairs_classify_as_bonded_or_cut(own, 3, &t);
    assert_non_null(pair);
    memory_free(pair);
    int32_t made[3];
    const int n = particles_at_cut_bonds_assign_and_count_colours(made, &t);
    pair = colour_pairs_classify_as_bonded_or_cut(made, n, &t);
    assert_non_null(pair);
    memory_free(pair);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cracks_on_a_lattice), cmocka_unit_test(length_does_not_count),
                                       cmocka_unit_test(scattered_particles), cmocka_unit_test(both_kinds_are_found)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
