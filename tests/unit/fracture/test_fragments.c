/* Fragments of a plate divided by two cuts: their particles, masses, centres and velocities, compared with plain
 * sums. */
#include "fracture/fragments.h"

#include "tests/support/cloud.h"
#include "tests/support/near.h"

/* Checks number, mass, position and velocity of the fragments of a plate of nine columns of particles, every third of
 * them heavier, with cuts after the third and the eighth column. */
static void test_fragments(void **state)
{
    (void)state;
    enum { COLUMNS = 9, ROWS = 5, PIECES = 3 };
    struct particle_cloud c;
    struct fragments f;
    uint64_t seed = 5;
    real corner[2][2][DIM_MAX] = {{{3 * CLOUD_SPACING, -1}, {3 * CLOUD_SPACING, 1}},
                                  {{8 * CLOUD_SPACING, -1}, {8 * CLOUD_SPACING, 1}}};
    const struct crack crack[] = {{.n = 2, .corner = corner[0]}, {.n = 2, .corner = corner[1]}};
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {COLUMNS, ROWS}, .horizon = 3});
    struct particles *p = &c.p;
    for (int64_t i = 0; i < p->n; i++) {
        p->mass[i] *= i % 3 ? 1 : 2.7;
        for (int d = 0; d < 2; d++) {
            p->x[d][i] += cloud_between(&seed, -0.1, 0.1) * CLOUD_SPACING;
            p->v[d][i] = cloud_between(&seed, -30, 20);
        }
    }
    cloud_source(&c);
    c.source.crack = crack, c.source.cracks = 2;
    bonds_make(&c.bonds, NULL, p, &c.source);
    fragments_find_by_intact_bonds(&f, &c.bonds, p);
    assert_int_equal(f.n, PIECES);
    assert_int_equal(f.singles, 0);
    for (int k = 0; k < PIECES; k++) {
        const int from[] = {3, 0, 8}, to[] = {8, 3, 9};
        real mass = 0, x[2] = {0}, v[2] = {0};
        int64_t n = 0;
        for (int64_t i = 0; i < p->n; i++) {
            if (i % COLUMNS < from[k] || i % COLUMNS >= to[k]) continue;
            assert_int_equal(f.of[i], k);
            n++, mass += p->mass[i];
            for (int d = 0; d < 2; d++) x[d] += p->mass[i] * p->x[d][i], v[d] += p->mass[i] * p->v[d][i];
        }
        assert_int_equal(f.fragment[k].particles, n);
        assert_close(f.fragment[k].mass, mass, 1e-12);
        for (int d = 0; d < 2; d++) {
            assert_near(f.fragment[k].x[d], x[d] / mass, 1e-15);
            assert_near(f.fragment[k].v[d], v[d] / mass, 1e-12);
        }
    }
    fragments_free(&f);
    particle_cloud_free(&c);
}

/* Checks that single particles without bonds are no fragments, and that their number and mass are reported. */
static void test_alone(void **state)
{
    (void)state;
    enum { COLUMNS = 6 };
    struct particle_cloud c;
    struct fragments f;
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_LINE, .count = {COLUMNS}, .horizon = 1.015});
    struct particles *p = &c.p;
    real corner[3][1][DIM_MAX] = {{{CLOUD_SPACING}}, {{2 * CLOUD_SPACING}}, {{5 * CLOUD_SPACING}}}, alone = 0;
    const struct crack crack[] = {
        {.n = 1, .corner = corner[0]}, {.n = 1, .corner = corner[1]}, {.n = 1, .corner = corner[2]}};
    for (int64_t i = 0; i < p->n; i++) p->mass[i] *= 1.3 + 0.7 * (real)i;
    cloud_source(&c);
    c.source.crack = crack, c.source.cracks = 3;
    bonds_make(&c.bonds, NULL, p, &c.source);
    fragments_find_by_intact_bonds(&f, &c.bonds, p);
    assert_int_equal(f.n, 1);
    assert_int_equal(f.fragment[0].particles, 3);
    assert_int_equal(f.singles, 3);
    for (int64_t i = 0; i < p->n; i++) alone += i < 2 || i == 5 ? p->mass[i] : 0;
    assert_close(f.mass_singles, alone, 1e-12);
    fragments_free(&f);
    particle_cloud_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fragments), cmocka_unit_test(test_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
