/* Tests of the warning about other programs that use the machine (base/busy.h). */
#include "tests/support/near.h"

#include "base/busy.h"

/* Returns true if machine_compose_warning_if_overloaded writes a warning for a load of other programs of `load`
 * processes, `cores` cores and `threads` threads of the run. Fails the test if this warning does not contain `words`.
 */
static bool said(double load, int cores, int threads, const char *words)
{
    char text[256] = "";
    const bool busy = machine_compose_warning_if_overloaded(text, sizeof text, load, cores, threads);
    if (busy && !strstr(text, words)) fail_msg("%s", text);
    assert_int_equal(busy, text[0] != '\0');
    return busy;
}

/* Checks that there is no warning for idle machines and for machines with a core for every process and thread. Checks
 * the factor in the warnings about overloaded ones, such as 2.5 for 3 other processes and 2 threads on 2 cores. */
static void load_is_described(void **state)
{
    (void)state;
    assert_false(said(0, 2, 2, ""));
    assert_false(said(0.4, 2, 2, ""));
    assert_false(said(6, 16, 8, ""));
    assert_false(said(5, 0, 8, ""));
    assert_true(said(3, 2, 2, "use 3.0 of this machine's 2 cores, so on 2 threads the run takes about 2.5 times"));
    assert_true(said(1, 1, 1, "use 1.0 of this machine's 1 core, so on 1 thread the run takes about 2 times"));
    assert_true(said(12, 16, 8, "on 8 threads the run takes about 1.2 times"));
}

static void load_is_finite(void **state)
{
    (void)state;
    assert_true(machine_load_average() >= 0 && machine_load_average() < 1e6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(load_is_described), cmocka_unit_test(load_is_finite)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
