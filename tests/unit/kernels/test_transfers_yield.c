/* Tests material points that yield in a step of the transfer kernels. Expected values: the return mapping of the stress
 * of an elastic step, which test_transfers.c checks. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/law_step.h"
#include "tests/support/point_cloud.h"
#include "tests/support/reference_points.h"
#include "tests/support/sets.h"
#include "base/team.h"

/* Compares point i of s after a step with the return mapping of the stress of the elastic step in `elastic`. strain:
 * plastic strain before the step. Returns true if the point has yielded. */
static bool check_yielded(const struct point_cloud *s, const struct particles *elastic, int64_t i, real strain)
{
    const struct particles *p = &s->c.p;
    const struct elastic *m = &s->elastic[p->material[i]];
    const int n = symmetric_tensor_component_count(s->dim);
    real stress[SYM_MAX], zz = 0, work = 0, a = strain;
    for (int c = 0; c < n; c++) stress[c] = elastic->stress[c][i];
    const real more = m->law ? law_step(m->law, m->space, NULL, stress, &a, &work, &zz) : 0;
    const real largest = reference_principal(stress, s->dim);
    assert_true(fabs(largest - m->trigger) > 1e-9 * m->trigger); /* no tie that round-off could decide */
    assert_int_equal((p->flag[i] & FLAG_STRESSED) != 0, largest > m->trigger);
    assert_true(fabs(p->plastic_strain[i] - strain - more) <= CLOSE);
    for (int c = 0; c < n; c++) assert_true(fabs(p->stress[c][i] - stress[c]) <= CLOSE * 1e8);
    return more > 0;
}

/* Checks for the kernels k that points of one of two materials yield by its law, and are flagged for conversion by the
 * stress after the return. */
static void yields_case(const struct transfer_kernels *k)
{
    static const enum space space[] = {SPACE_LINE, SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};
    struct point_cloud s, elastic;
    real impulse[DIM_MAX] = {0}, work = 0;
    int64_t yielded = 0;
    point_cloud_make(&s, k, 200), point_cloud_make(&elastic, k, 200);
    const struct material *own = &s.c.material[0];
    struct law law = {.given = true, .flow = FLOW_LINEAR, .hardening = 3e9};
    flow_law_compute_derived_constants(&law, 6e7, own->young, own->poisson, own->shear, own->density);
    s.elastic[0].law = &law, s.elastic[0].space = space[k->dim], s.t.laws = true;
    for (int64_t i = 0; i < s.c.p.n; i++) s.c.p.plastic_strain[i] = 1e-3 * (real)(i % 7);
    point_cloud_step(&s, k, impulse, &work), point_cloud_step(&elastic, k, impulse, &work);
    for (int64_t i = 0; i < s.c.p.n; i++)
        if (s.c.p.kind[i] == KIND_MPM) yielded += check_yielded(&s, &elastic.c.p, i, 1e-3 * (real)(i % 7));
    assert_true(yielded > 0 && yielded < s.order.n);
    point_cloud_free(&s), point_cloud_free(&elastic);
}

static void test_yielding(void **state) { (void)state, for_all_transfer_kernels(yields_case); }

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_yielding)};
    threads_set_count_and_bind_to_cores(2);
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
