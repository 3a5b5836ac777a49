/* Tests the accelerations of nodes with little mass in APIC, which are distributed to their neighbours
 * (kernels/mpm/grid_move.c). */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "kernels/kernels.h"
#include "tests/support/near.h"
#include "tests/support/sets.h"
#include "base/team.h"

enum { BORDER = 4 };

/* Returns the mass of node I of g in a body that ends at node BORDER. The next node along the first two axes has 1e-7
 * of the usual mass; nodes beyond have 0. seed: state of the random numbers, by which masses vary. */
static real light_body(const struct grid *g, int64_t I, uint64_t *seed)
{
    real mass = cloud_between(seed, 0.5, 1);
    for (int d = 0; d < g->dim; d++) {
        const int64_t k = I / g->stride[d] % g->count[d];
        if (d < 2 && k == BORDER + 1) mass *= 1e-7;
        if (k == 0 || k > BORDER + (d < 2)) mass = 0;
    }
    return mass;
}

/* Checks the accelerations a that a force on one node causes. The sum of m a is this force and has its moment. The
 * response is symmetric: a_i by a force at node j equals a_j by the same force at node i. The response of a light node
 * is not larger than that of its neighbours. */
static void test_light_nodes(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct grid g = {.dim = dim, .h = 1, .light_mass = GRID_MASS_LIGHT};
        const real from[DIM_MAX] = {1, 1, 1}, to[DIM_MAX] = {BORDER, BORDER, BORDER};
        bool changed;
        uint64_t seed = 5;
        assert_ok(grid_extend_box(&g, from, to, 1 << 20, &changed));
        real *mass = NEW("test.mass", g.n, real), *a = NEW("test.accelerations", g.n * g.n, real), largest = 0;
        for (int64_t I = 0; I < g.n; I++) mass[I] = light_body(&g, I, &seed);
        for (int64_t J = 0; J < g.n; J++) {
            real impulse[DIM_MAX] = {0}, work = 0, total = 0, moment = 0;
            if (mass[J] == 0) continue;
            for (int64_t I = 0; I < g.n; I++) {
                g.mass[I] = mass[I];
                for (int d = 0; d < dim; d++) g.momentum[d][I] = 3 * mass[I], g.force[d][I] = d == 0 && I == J;
            }
            grid_advance_and_constrain_nodes(&g, TRANSFER_APIC, 1, GRID_MASS_SMALLEST, impulse, &work);
            for (int64_t I = 0; I < g.n; I++) {
                const real own = mass[I] > 0 ? g.velocity[0][I] - 3 : 0;
                a[I * g.n + J] = own, largest = fmax(largest, fabs(own));
                total += mass[I] * own;
                if (dim > 1)
                    moment += mass[I] * own * (real)(I / g.stride[1] % g.count[1] - J / g.stride[1] % g.count[1]);
            }
            assert_near(total, 1, 1e-12);
            assert_near(moment, 0, 1e-5); /* up to the mass of the light nodes themselves */
        }
        for (int64_t k = 0; k < g.n * g.n; k++) assert_near(a[k], a[k % g.n * g.n + k / g.n], 1e-12 * largest);
        assert_true(largest < 30); /* (2 + 1)^2 of the heavy nodes' 1/m, each below 2, and no more at corners */
        memory_free(mass);
        memory_free(a);
        grid_free(&g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_light_nodes)};
    threads_set_count_and_bind_to_cores(2);
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
