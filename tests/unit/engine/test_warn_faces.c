/* Checks the warning about weight factors near faces (pd.surface: moments) whose solver has not converged.
 * test_meant.sh has bodies of a few rows. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <string.h>
#include <cmocka.h>

#include "src/engine/engine_internal.h"

static void weights_that_are_not_solved(void **state)
{
    (void)state;
    static const struct {
        real residual;
        enum surface_rule surface;
        int warnings;
    } cases[] = {{1e-13, SURFACE_MOMENTS, 0}, {0.02, SURFACE_MOMENTS, 1}, {0.02, SURFACE_NONE, 0}};
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        const struct scene s = {.method = METHOD_PD, .dim = 2, .surface = cases[k].surface};
        const struct particles p = {0};
        const struct surface_correction w = {.residual = cases[k].residual};
        struct warnings to = {0};
        run_warn_of_bodies_too_thin_to_correct_faces(&s, &p, &w, &to);
        assert_int_equal(to.n, cases[k].warnings);
        if (to.n > 0) assert_non_null(strstr(to.text[0], "have not converged (residual 0.02, required 1e-13)"));
        warnings_free(&to);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(weights_that_are_not_solved)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
