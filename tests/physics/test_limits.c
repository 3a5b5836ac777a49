/* Runs the scenes of bench/stability/limits.h in which some methods fail. Each measured quantity must be within the
 * known range of the table, and exactly the methods for which the table states a remedy must fail. Rows that take long
 * run with LONG only (long_energy.sh). Takes 25 s: mostly shear at constant volume near nu = 1/2, where every method
 * needs many small steps. */
#include <stdarg.h>
#include <setjmp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

#include "../bench/stability/limits.h"
#include "../bench/stability/limits_scenes.h"
#include "tests/support/near.h"

/* Measures the row r of the scene s. Returns true if all its quantities are in their known ranges and the row fails if
 * and only if the table states a remedy; else prints the differences. */
static bool row_is_as_known(const struct limits_scene *s, const struct limits_row *r)
{
    double figure[FAILING_FIGURES];
    char label[128];
    bool known = true;
    limits_label(s, r, label, sizeof label);
    const status done = limits_measure(s, r, figure);
    if (done != OK) print_message("%s: %s\n", label, status_message());
    for (int k = 0; k < limits_quantity_count(s); k++) {
        const bool good = figure[k] >= r->known[k].low && figure[k] <= r->known[k].high;
        if (!good)
            print_message("%s: %s %.4g, known %g to %g\n", label, s->figure[k].quantity, figure[k], r->known[k].low,
                          r->known[k].high);
        known = known && good;
    }
    if (limits_quantities_are_below_thresholds(s, figure) == !r->remedy) return done == OK && known;
    print_message("%s: %s\n", label, r->remedy ? "holds, and is said to fail" : "fails without a remedy");
    return false;
}

/* Returns true if row r of the scene s takes long, so that it runs with LONG only: a plate over a million steps, and
 * squares that rotate at 100 m/s instead of 10 m/s. */
static bool is_for_long(const struct limits_scene *s, const struct limits_row *r)
{
    return s == &limits_million || (s == &limits_spin && r->given == 100);
}

static void figures_are_as_known(void **state)
{
    const struct limits_scene *s = *state;
    int wrong = 0;
    for (int k = 0; k < s->rows; k++)
        if (getenv("LONG") || !is_for_long(s, &s->row[k])) wrong += !row_is_as_known(s, &s->row[k]);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    struct CMUnitTest tests[FAILING_SCENES];
    for (int k = 0; k < FAILING_SCENES; k++)
        tests[k] = (struct CMUnitTest){
            .name = limits_scene[k]->name, .test_func = figures_are_as_known, .initial_state = (void *)limits_scene[k]};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
