/* Reflection of waves at absorbing faces, as `cleave bench absorbing` measures it, compared with the closed form of
 * Lysmer & Kuhlemeyer 1969. */
#include <math.h>

#include "bench/absorbing/absorbing_bench.h"
#include "tests/support/near.h"

/* Checks the closed form for Poisson's ratio 1/4. Normal incidence: no reflection. Angles of 1 to 89 degrees: the
 * reflected energy flux (sum of A^2 c cos over the reflected waves, A amplitude, c wave speed) is below the incident
 * one. 45 degrees: the amplitudes agree with a solution by hand, to its digits. */
static void test_theory(void **state)
{
    (void)state;
    const double ratio = sqrt(3);
    for (int shear = 0; shear < 2; shear++) {
        struct absorbing_reflection r = absorbing_reflection_in_closed_form(shear, 0, ratio);
        assert_true(r.as_p < 1e-15 && r.as_s < 1e-15);
        for (int k = 1; k < 90; k++) {
            const double angle = k * M_PI / 180, p = sin(angle) * (shear ? ratio : 1);
            const double flow_p = p < 1 ? sqrt(1 - p * p) : 0, flow_s = sqrt(1 - p * p / 3) / ratio;
            r = absorbing_reflection_in_closed_form(shear, angle, ratio);
            assert_true(r.as_p * r.as_p * flow_p + r.as_s * r.as_s * flow_s < (shear ? flow_s : flow_p));
        }
    }
    assert_near(absorbing_reflection_in_closed_form(false, M_PI / 4, ratio).as_p, 0.0144, 1e-3);
    assert_near(absorbing_reflection_in_closed_form(false, M_PI / 4, ratio).as_s, 0.071, 1e-3);
    assert_near(absorbing_reflection_in_closed_form(true, M_PI / 4, ratio).as_p, 0.420, 1e-3);
}

/* Measures how much of a pulse 32 spacings wide an absorbing face reflects at normal incidence, with each method in 1D
 * or 2D. Limits: 2 % of the peak velocity, 2.05 % for bonds in 1D, 2.4 % for FLIP, whose time steps exceed a cell over
 * the wave speed. */
static void test_right_angle(void **state)
{
    (void)state;
    static const double most[ABSORBING_METHODS] = {0.0205, 0.02, 0.02, 0.024, 0.02, 0.02};
    for (int k = 0; k < ABSORBING_METHODS; k++) {
        struct absorbing_pulse figure;
        assert_ok(absorbing_measure_pulse_reflection(&absorbing_methods[k], k == 1 || k == 2 ? 2 : 1, 32, &figure));
        if (!(figure.reflected <= most[k])) fail_msg("%s: %g", absorbing_methods[k].name, figure.reflected);
    }
}

/* Compares the amplitudes that a face reflects from P and S waves at 45 degrees with the closed form, with bonds and
 * with cells, at 32 spacings per wavelength. Tolerance: a face displaced by 0.15 spacings reflects 0.015 of the
 * amplitude. */
static void test_angle(void **state)
{
    (void)state;
    const int which[] = {0, 5};
    for (size_t k = 0; k < COUNT_OF(which); k++)
        for (int shear = 0; shear < 2; shear++) {
            const struct absorbing_reflection exact = absorbing_reflection_in_closed_form(shear, M_PI / 4, sqrt(3));
            struct absorbing_reflection seen;
            assert_ok(absorbing_measure_oblique_reflection(&absorbing_methods[which[k]], shear, M_PI / 4, 32, &seen));
            assert_near(seen.as_p, exact.as_p, 0.015);
            assert_near(seen.as_s, exact.as_s, 0.015);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_theory), cmocka_unit_test(test_right_angle),
                                       cmocka_unit_test(test_angle)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
