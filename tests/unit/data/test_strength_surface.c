/* Strength surfaces, from which the strength in any direction of stress follows: published values for glass, the
 * strengths that define a surface, and the smallest strain on a surface compared with closed forms. */
#include "data/material.h"

#include "tests/support/near.h"

/* Compares strengths of glass with 40 MPa in tension and 1000 MPa in compression with published values, to three
 * digits: 44.4 MPa in shear, 27.0 MPa in equal biaxial and 27.8 MPa in hydrostatic tension (Kamarei et al. 2025). */
static void test_glass(void **state)
{
    (void)state;
    const struct strength_surface glass = strength_surface_from_compressive_strength(40e6, 1000e6);
    assert_near(strength_surface_strength_in_stress_direction(&glass, (const real[]){1, -1, 0}), 44.4e6, 5e4);
    assert_near(strength_surface_strength_in_stress_direction(&glass, (const real[]){1, 1, 0}), 27.0e6, 5e4);
    assert_near(strength_surface_strength_in_stress_direction(&glass, (const real[]){1, 1, 1}), 27.8e6, 5e4);
}

/* Checks that a strength surface has the strengths from which it was made, and that compressive, biaxial and
 * hydrostatic strength define the same surface. */
static void test_back(void **state)
{
    (void)state;
    const real tension = 31e6, compression = 170e6;
    const struct strength_surface s = strength_surface_from_compressive_strength(tension, compression);
    const real biaxial = strength_surface_strength_in_stress_direction(&s, (const real[]){1, 1, 0}),
               hydrostatic = strength_surface_strength_in_stress_direction(&s, (const real[]){1, 1, 1});
    assert_close(strength_surface_strength_in_stress_direction(&s, (const real[]){0, 1, 0}), tension, 1e-14);
    assert_close(strength_surface_strength_in_stress_direction(&s, (const real[]){0, 0, -1}), compression, 1e-14);
    assert_close(strength_surface_stress_to_strength_ratio(&s, 0, 0, 0, square(s.g0)), 1, 1e-14);
    const struct strength_surface others[] = {strength_surface_from_biaxial_strength(tension, biaxial),
                                              strength_surface_from_hydrostatic_strength(tension, hydrostatic)};
    for (int k = 0; k < 2; k++) {
        assert_close(others[k].g0, s.g0, 1e-13);
        assert_close(others[k].g1, s.g1, 1e-12);
    }
    /* no uniaxial pressure reaches a surface whose hydrostatic strength is below two thirds of the tensile one */
    const struct strength_surface blunt = strength_surface_from_hydrostatic_strength(tension, 0.6 * tension);
    assert_true(isinf(strength_surface_strength_in_stress_direction(&blunt, (const real[]){-1, 0, 0})));
    assert_close(strength_surface_strength_in_stress_direction(&blunt, (const real[]){1, 1, 1}), 0.6 * tension, 1e-14);
}

/* Checks that the ratio of a stress tensor to the strength is that of its principal values; in plane strain the
 * out-of-plane stress is included. */
static void test_share(void **state)
{
    (void)state;
    struct material m = {.young = 70e9, .poisson = 0.25, .density = 2440, .tensile_strength = 40e6};
    m.surface = strength_surface_from_compressive_strength(40e6, 1000e6);
    const real turn = 0.4, c = cos(turn), s = sin(turn), one = 13e6, two = -7e6;
    const real plane[] = {one * c * c + two * s * s, one * s * s + two * c * c, (one - two) * c * s};
    assert_close(material_stress_to_strength_ratio(&m, SPACE_PLANE_STRESS, plane),
                 strength_surface_stress_to_strength_ratio(&m.surface, one, two, 0, 0), 1e-13);
    assert_close(material_stress_to_strength_ratio(&m, SPACE_PLANE_STRAIN, plane),
                 strength_surface_stress_to_strength_ratio(&m.surface, one, two, 0.25 * (one + two), 0), 1e-13);
    const real solid[] = {plane[0], plane[1], 5e6, plane[2], 0, 0};
    assert_close(material_stress_to_strength_ratio(&m, SPACE_SOLID, solid),
                 strength_surface_stress_to_strength_ratio(&m.surface, one, two, 5e6, 0), 1e-13);
}

/* Checks the smallest principal strain on the strength surface against closed forms, that of equal tension: (1 - nu)
 * sigma_bs/E in plane stress, (1 - 2 nu) sigma_hs/E in 3D, (1 + nu)(1 - 2 nu) sigma_bs/E in plane strain (bs: biaxial,
 * hs: hydrostatic strength). For a surface that does not depend on pressure it is below a fifth of this. */
static void test_least(void **state)
{
    (void)state;
    const enum space spaces[] = {SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    for (int k = 0; k < 3; k++) {
        struct material m = {.young = 70e9, .poisson = bond_based_poisson_ratio(spaces[k]), .tensile_strength = 40e6};
        m.surface = strength_surface_from_compressive_strength(40e6, 1000e6);
        const struct surface_strengths at = material_strengths_from_strength_surface(&m, spaces[k]);
        const real nu = m.poisson, expected[] = {(1 - nu) * at.biaxial, (1 + nu) * (1 - 2 * nu) * at.biaxial,
                                                 (1 - 2 * nu) * at.hydrostatic};
        assert_close(material_smallest_strain_on_strength_surface(&m, spaces[k]), expected[k] / 70e9, 1e-12);
        m.surface = strength_surface_from_compressive_strength(40e6, 40e6);
        assert_true(material_smallest_strain_on_strength_surface(&m, spaces[k]) < 0.2 * expected[k] / 70e9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_glass), cmocka_unit_test(test_back),
                                       cmocka_unit_test(test_share), cmocka_unit_test(test_least)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
