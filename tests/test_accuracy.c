/* floor 5: what the speed-accuracy chart says of a cloud of points: its front, and the cheapest way to an error. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "accuracy.h"

/* A staircase with points above it, two alike, one unstable and one that was not timed. */
static const struct accuracy_dot cloud[] = {
    {4, 0.001}, {1, 0.1}, {2, 0.02}, {2, 0.03}, {3, 0.02}, {1, 0.1}, {0.5, NAN}, {INFINITY, 1e-5}, {8, 0.0015}, {0.7, 0.3}};
enum { DOTS = COUNT_OF(cloud) };

static void front_has_what_nothing_beats(void **state)
{
    (void)state;
    static const int expected[] = {9, 1, 2, 0};
    int front[DOTS];
    assert_int_equal(accuracy_front(cloud, DOTS, front), COUNT_OF(expected));
    for (size_t k = 0; k < COUNT_OF(expected); k++) assert_int_equal(front[k], expected[k]);
    assert_int_equal(accuracy_front(cloud, 0, front), 0);
    assert_int_equal(accuracy_front(&cloud[6], 2, front), 0);
}

/* The definition, over random clouds: a point is on the front exactly if no other is as good in both and better in one. */
static void front_of_random_clouds(void **state)
{
    (void)state;
    enum { N = 60 };
    struct accuracy_dot dot[N];
    int front[N];
    srand(7);
    for (int trial = 0; trial < 50; trial++) {
        for (int k = 0; k < N; k++) dot[k] = (struct accuracy_dot){rand() % 40, rand() % 40};
        const int n = accuracy_front(dot, N, front);
        for (int k = 1; k < n; k++) {
            assert_true(dot[front[k]].time > dot[front[k - 1]].time);
            assert_true(dot[front[k]].error < dot[front[k - 1]].error);
        }
        for (int k = 0; k < N; k++) {
            bool reached = false;        /* by a point of the front */
            for (int j = 0; j < n; j++)
                reached |= dot[front[j]].time <= dot[k].time && dot[front[j]].error <= dot[k].error;
            assert_true(reached);
        }
    }
}

static void cheapest_is_the_first_good_enough(void **state)
{
    (void)state;
    assert_int_equal(accuracy_cheapest(cloud, DOTS, 1), 9);
    assert_int_equal(accuracy_cheapest(cloud, DOTS, 0.05), 2);
    assert_int_equal(accuracy_cheapest(cloud, DOTS, 0.02), 2);
    assert_int_equal(accuracy_cheapest(cloud, DOTS, 0.019), 0);
    assert_int_equal(accuracy_cheapest(cloud, DOTS, 1e-4), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(front_has_what_nothing_beats),
        cmocka_unit_test(front_of_random_clouds),
        cmocka_unit_test(cheapest_is_the_first_good_enough),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
