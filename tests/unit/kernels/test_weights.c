/* Tests weights and slopes of every shape function in one dimension against their definitions, in every piece and at
 * its edges. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "tests/support/reference_points.h"
#include "kernels/mpm/shape.h"

/* Checks all weights of the shape functions `shape` from the kernels at the position r (in node distances), for points
 * of half width l: sum N = 1, sum N x_I = x, sum dN = 0, sum dN x_I = 1. */
static void check_shape(enum shape shape, real r, real l)
{
    row_of_points some_N[ROW], some_dN[ROW];
    real N[ROW], dN[ROW], sum[4] = {0};
    const int64_t cell = (int64_t)floor(r), base = cell - 1;
    if (shape == SHAPE_QUADRATIC) l = 0.5; /* GIMP with the width of a cell */
    shape_functions_evaluate_at_row_nodes(shape, points_broadcast(r - (real)cell), points_broadcast(l),
                                          points_broadcast(0.5 / l), some_N, some_dN);
    for (int k = 0; k < ROW; k++) N[k] = some_N[k][0], dN[k] = some_dN[k][0];
    for (int64_t node = base - 3; node < base + ROW + 3; node++) {
        bool inside = node >= base && node < base + ROW;
        struct reference_shape s = reference_shape(shape, r - (real)node, 1, l);
        /* Round-off of (r +- l), up to ten, in an integral over 2 l >= 0.02. */
        assert_true(fabs(s.value - (inside ? N[node - base] : 0)) <= 1e-13);
        if (!(shape == SHAPE_LINEAR && r == floor(r))) /* at a kink the slope of either side is correct */
            assert_true(fabs(s.slope - (inside ? dN[node - base] : 0)) <= 1e-12);
        if (!inside) continue;
        sum[0] += N[node - base], sum[1] += N[node - base] * (real)node;
        sum[2] += dN[node - base], sum[3] += dN[node - base] * (real)node;
    }
    assert_true(fabs(sum[0] - 1) <= 1e-14 && fabs(sum[1] - r) <= 1e-13);
    assert_true(fabs(sum[2]) <= 1e-13 && fabs(sum[3] - 1) <= 1e-12);
}

static void test_shapes(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int shape = 0; shape < SHAPES; shape++) {
        for (int k = 0; k < 2000; k++)
            check_shape((enum shape)shape, cloud_between(&seed, -9, 9),
                        cloud_between(&seed, 0.01, shape == SHAPE_CPGIMP ? 1 : 0.5));
        for (int k = -16; k <= 16; k++) { /* on nodes, in the middle of cells and at the edges of pieces */
            check_shape((enum shape)shape, 0.25 * k, 0.25);
            check_shape((enum shape)shape, 0.25 * k, 0.5);
            check_shape((enum shape)shape, 0.25 * k + 1e-15, 0.25);
            if (shape == SHAPE_CPGIMP)
                check_shape(SHAPE_CPGIMP, 0.25 * k, 0.75), check_shape(SHAPE_CPGIMP, 0.25 * k, 1);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_shapes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
