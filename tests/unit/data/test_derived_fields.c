/* Derived fields: invariants and principal axes of tensors. */
#include "tests/support/near.h"

#include "data/derived_fields.h"

/* Checks that principal values and axes of rotated tensors are those of their construction: values agree, axes are
 * orthonormal, and both reproduce the tensor, to round-off. */
static void principal_values_of_turned_tensors(void **state)
{
    static const real values[][3] = {{3, 1, -2}, {5, 5, 1}, {2, -1, -1}, {1, 1, 1}, {4e9, 1, -4e9}, {0, 0, 0}};
    (void)state;
    for (size_t v = 0; v < COUNT_OF(values); v++)
        for (int k = 0; k < 40; k++) {
            const real a = 0.3 * k, b = 1.1 * k, largest = fabs(values[v][0]) + 1e-300;
            const real n[3][3] = {{cos(a) * cos(b), sin(a) * cos(b), -sin(b)},
                                  {-sin(a), cos(a), 0},
                                  {cos(a) * sin(b), sin(a) * sin(b), cos(b)}};
            static const int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
            real tensor[6] = {0}, found[3], direction[9];
            for (int c = 0; c < 6; c++)
                for (int m = 0; m < 3; m++) tensor[c] += values[v][m] * n[m][row[c]] * n[m][column[c]];
            tensor_compute_principal_values(tensor, found, direction);
            for (int m = 0; m < 3; m++) assert_true(fabs(found[m] - values[v][m]) <= 1e-14 * largest);
            for (int c = 0; c < 6; c++) {
                real again = 0;
                for (int m = 0; m < 3; m++)
                    again += found[m] * direction[3 * m + row[c]] * direction[3 * m + column[c]];
                assert_true(fabs(again - tensor[c]) <= 1e-14 * largest);
            }
            for (int m = 0; m < 3; m++)
                for (int l = 0; l < 3; l++)
                    assert_true(fabs(dot(direction + 3 * m, direction + 3 * l, 3) - (m == l)) < 1e-14);
        }
}

/* Checks the von Mises stress against closed forms: S under uniaxial stress S, sqrt(3) T in pure shear T, 0 under
 * pressure. */
static void invariants(void **state)
{
    (void)state;
    assert_near(tensor_mises_stress((const real[6]){0, -7e8, 0, 0, 0, 0}), 7e8, 1e-6);
    for (int k = 3; k < 6; k++) {
        real shear[6] = {0};
        shear[k] = 2;
        assert_near(tensor_mises_stress(shear), 2 * sqrt(3), 1e-15);
    }
    assert_near(tensor_mises_stress((const real[6]){4, 4, 4, 0, 0, 0}), 0, 1e-15);
    assert_near(tensor_determinant((const real[6]){2, 3, 5, 1, 0.5, 0.25}),
                2 * (3 * 5 - 0.25) - 1 * (1 * 5 - 0.5 * 0.25) + 0.25 * (0.5 - 3 * 0.25), 1e-14);
}

static void fields_by_name(void **state)
{
    const real stress[6] = {-3, -6, -9, 0, 0, 0}, velocity[3] = {2, -3, 6};
    real out[DERIVED_MOST];
    (void)state;
    for (int k = 0; k < DERIVED_FIELDS; k++)
        assert_ptr_equal(derived_field_find_by_name(derived_fields[k].name), derived_fields + k);
    assert_null(derived_field_find_by_name("stress"));
    derived_field_find_by_name("speed")->compute(velocity, out);
    assert_near(out[0], 7, 0);
    derived_field_find_by_name("pressure")->compute(stress, out);
    assert_near(out[0], 6, 0);
    derived_field_find_by_name("principal_stress")->compute(stress, out);
    assert_true(out[0] == -3 && out[1] == -6 && out[2] == -9);
    derived_field_find_by_name("principal_directions")->compute(stress, out);
    for (int k = 0; k < 9; k++) assert_near(out[k], k % 4 == 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(principal_values_of_turned_tensors),
        cmocka_unit_test(invariants),
        cmocka_unit_test(fields_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
