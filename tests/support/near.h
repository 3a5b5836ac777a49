/* Assertions that cmocka lacks: numbers with a tolerance, and statuses with their message. */
#ifndef CLEAVE_TESTS_NEAR
#define CLEAVE_TESTS_NEAR

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/base.h"

/* Fails the test unless |a - b| <= tolerance. Infinities equal themselves; NAN equals nothing. what: name of a for the
 * message; file, line: location of the assertion. */
static inline void near_check(double a, double b, double tolerance, const char *what, const char *file, int line)
{
    if (a == b || fabs(a - b) <= tolerance) return;
    print_error("%s: %.17g and %.17g differ by %.3g, more than %.3g\n", what, a, b, fabs(a - b), tolerance);
    _fail(file, line);
}

/* Fails the test unless the status `got` equals `wanted` and, if that is not OK, the stored message contains the text
 * `part` (NULL: any message). file, line: location of the assertion. */
static inline void status_check(status got, status wanted, const char *part, const char *file, int line)
{
    if (got == wanted && (wanted == OK || part == NULL || strstr(status_message(), part) != NULL)) return;
    print_error("status %d (wanted %d): '%s' (wanted '%s')\n", (int)got, (int)wanted, got == OK ? "" : status_message(),
                part != NULL ? part : "");
    _fail(file, line);
}

#define assert_near(a, b, tolerance) near_check(a, b, tolerance, #a, __FILE__, __LINE__)
/* Asserts |a - b| <= share |b|; share: relative tolerance [1]. The test fails otherwise. */
#define assert_close(a, b, share) near_check(a, b, fabs((double)(b)) * (share), #a, __FILE__, __LINE__)
#define assert_exact(a, b) near_check(a, b, 0, #a, __FILE__, __LINE__)
#define assert_ok(call) status_check(call, OK, NULL, __FILE__, __LINE__)
/* Asserts that a call returns REFUSED, or FAILED, and that its message contains `part` (NULL: any message). */
#define assert_refused(call, part) status_check(call, REFUSED, part, __FILE__, __LINE__)
#define assert_failed(call, part) status_check(call, FAILED, part, __FILE__, __LINE__)

#endif
