/* Curves of softening bonds, their energy, and the strength of bodies with such bonds, compared with closed forms and
 * independent quadratures. */
#include "data/softening.h"

#include "tests/support/near.h"

/* Checks the areas under the normalised softening curves against closed forms: linear 1/2; bilinear, with the kink at
 * 2/9 and 1/3, 5/18; exponential 1/5 - exp(-5)/(1 - exp(-5)), within 0.8 % of the strength, by which chords exceed an
 * exponential. Each curve begins at 1 and ends at 0. */
static void test_curves(void **state)
{
    (void)state;
    const real area[] = {0.5, 5.0 / 18, 1.0 / 5 - exp(-5) / (1 - exp(-5))}, within[] = {1e-15, 1e-15, 8e-3};
    for (enum softening law = SOFTENING_LINEAR; law <= SOFTENING_EXPONENTIAL; law++) {
        const struct softening_curve c = softening_curve_of_law(law);
        real sum = 0;
        assert_near(c.area, area[law], within[law]);
        assert_near(softening_curve_normalised_force(&c, 0), 1, 1e-15);
        assert_near(softening_curve_normalised_force(&c, 1), 0, 1e-15);
        for (int k = 0; k < 100000; k++) sum += softening_curve_normalised_force(&c, (k + 0.5) * 1e-5) * 1e-5;
        assert_near(sum, c.area, 1e-9);
        for (int k = 0; k <= 1000 && law == SOFTENING_EXPONENTIAL; k++)
            assert_near(softening_curve_normalised_force(&c, 1e-3 * k), (exp(-5e-3 * k) - exp(-5)) / (1 - exp(-5)),
                        8e-3);
    }
    const struct softening_curve concrete = softening_curve_of_law(SOFTENING_BILINEAR);
    assert_near(softening_curve_normalised_force(&concrete, 2.0 / 9), 1.0 / 3, 1e-15);
}

/* Checks the energy D that a bond dissipates up to the stretch k, divided by its stiffness and length, against closed
 * forms. In all it is s_c^2/2 (s_c: critical stretch of a brittle bond). For linear softening from s_0 to s_f =
 * s_c^2/s_0 it is D(k) = s_0 s_f (k - s_0)/(2 (s_f - s_0)). */
static void test_energy(void **state)
{
    (void)state;
    const real onset = 1.3e-4, critical = 2.9e-4;
    for (enum softening law = SOFTENING_LINEAR; law <= SOFTENING_EXPONENTIAL; law++) {
        const struct softening_curve c = softening_curve_of_law(law);
        const real end = softening_breaking_stretch_of_equal_energy(&c, onset, critical);
        assert_close(softening_normalised_dissipated_energy(&c, onset, end, end), 0.5 * critical * critical, 1e-13);
        assert_close(softening_normalised_dissipated_energy(&c, onset, end, 7 * end), 0.5 * critical * critical, 1e-13);
        assert_near(softening_normalised_dissipated_energy(&c, onset, end, onset), 0, 1e-25);
        if (law != SOFTENING_LINEAR) continue;
        assert_close(end, critical * critical / onset, 1e-14);
        for (real k = onset; k < end; k += 1e-5)
            assert_near(softening_normalised_dissipated_energy(&c, onset, end, k),
                        0.5 * onset * end * (k - onset) / (end - onset), 1e-22);
    }
}

/* Compares the peak stresses of neighbourhoods with linear softening, relative to E s_0, with independent quadratures
 * over 1440 (plane) and 2000 (space) directions, to three digits. kappa = s_c^2/s_0^2. Closed forms: 1/(1 - nu) in
 * biaxial tension in the plane, 1/(1 + nu) in shear at kappa = 1 (nu = 1/3 in the plane, 1/4 in space). Shear in space
 * is compared with 4000 directions in steps of strain of 3 %, which miss a peak by 1e-3. */
static void test_strength(void **state)
{
    (void)state;
    const real kappa[] = {1.2, 2, 4, 10, 20};
    const real plane[] = {1.003, 1.035, 1.096, 1.183, 1.242}, solid[] = {1.038, 1.143, 1.281, 1.445, 1.552};
    const struct softening_curve c = softening_curve_of_law(SOFTENING_LINEAR);
    for (size_t k = 0; k < COUNT_OF(kappa); k++) {
        const struct softening_strength flat =
            softening_curve_normalised_peak_stresses(&c, SPACE_PLANE_STRESS, kappa[k]);
        assert_near(flat.tension, plane[k], 1.5e-3);
        assert_near(flat.biaxial, 1.5, 1e-9);
        assert_near(softening_curve_normalised_peak_stresses(&c, SPACE_SOLID, kappa[k]).tension, solid[k], 1.5e-3);
        assert_near(softening_curve_normalised_peak_stresses(&c, SPACE_LINE, kappa[k]).tension, 1, 1e-12);
    }
    const real sheared[] = {0.8346, 0.9339, 1.0716, 1.2497};
    for (size_t k = 0; k < COUNT_OF(sheared); k++)
        assert_near(softening_curve_normalised_peak_stresses(&c, SPACE_SOLID, kappa[k]).shear, sheared[k], 3e-3);
    assert_near(softening_curve_normalised_peak_stresses(&c, SPACE_SOLID, 1).shear, 0.8, 1e-3);
    assert_near(softening_curve_normalised_peak_stresses(&c, SPACE_PLANE_STRAIN, 1).shear, 0.75, 1e-3);
    assert_near(softening_curve_normalised_peak_stresses(&c, SPACE_PLANE_STRESS, 4).shear, 0.864, 1.5e-3);
}

/* Checks that the onset stretch s_0 follows from the strength: modulus s_0 tension(s_c^2/s_0^2) = strength, with the
 * normalised peak stress `tension`. For a strength that cannot be reached s_0 must exceed the critical stretch. */
static void test_onset(void **state)
{
    (void)state;
    const enum space spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    for (size_t k = 0; k < COUNT_OF(spaces); k++) {
        struct material m = {.young = 70e9, .density = 2440, .critical_stretch = 1e-3, .tensile_strength = 40e6};
        m.poisson = k == 0 ? 0 : bond_based_poisson_ratio(spaces[k]);
        const real modulus = k == 2 ? 70e9 / (1 - 1.0 / 16) : 70e9,
                   onset = softening_onset_stretch_from_strength(&m, spaces[k]);
        const struct softening_curve c = softening_curve_of_law(m.softening);
        const real tension = softening_curve_normalised_peak_stresses(&c, spaces[k], square(1e-3 / onset)).tension;
        assert_close(modulus * onset * tension, 40e6, 1e-6);
        m.tensile_strength = 80e6;
        assert_true(softening_onset_stretch_from_strength(&m, spaces[k]) > m.critical_stretch);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_curves), cmocka_unit_test(test_energy),
                                       cmocka_unit_test(test_strength), cmocka_unit_test(test_onset)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
