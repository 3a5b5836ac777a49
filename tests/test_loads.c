/* floor 3: applied forces: what a body force that varies over the body gives to every particle. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "cloud.h"
#include "loads.h"
#include "near.h"
#include "team.h"

/* A sine along (3, 4)/5 with its origin inside, pulling in x and y; the particles have moved since, which must not
 * matter: the profile holds on reference positions. */
static void test_sine(void **state)
{
    (void)state;
    const real length = 5 * CLOUD_SPACING, volume = square(CLOUD_SPACING) * 2e-3, dt = 1e-6;
    const struct boundary push = {.name = "push", .kind = BOUNDARY_BODY_FORCE, .body = -1, .value = {2e6, -3e6},
                                  .time = {.kind = TIME_RAMP, .until = 4},
                                  .profile = {PROFILE_SINE, length, {CLOUD_SPACING, -CLOUD_SPACING}, {3, 4}}};
    struct cloud c;
    struct loads l;
    real sum[2] = {0};
    cloud_make(&c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {9, 7}, .horizon = 3});
    struct particles *p = &c.p;
    assert_ok(loads_make(&l, &push, 1, p, CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
    for (int64_t i = 0; i < p->n; i++) p->x[0][i] += 0.3 * CLOUD_SPACING, p->f[1][i] = 77;
    loads_clear(&l, p);
    loads_apply(&l, p, 1, dt, dt);                   /* a quarter of the ramp */
    for (int64_t i = 0; i < p->n; i++) {
        real along = 0.6 * (p->X[0][i] - CLOUD_SPACING) + 0.8 * (p->X[1][i] + CLOUD_SPACING);
        real factor = 0.25 * sin(2 * M_PI * along / length);
        assert_near(p->f[0][i], 2e6 * volume * factor, 1e-12 * 2e6 * volume);
        assert_near(p->f[1][i], -3e6 * volume * factor, 1e-12 * 3e6 * volume);
        for (int d = 0; d < 2; d++) sum[d] += p->f[d][i] * dt;
    }
    for (int d = 0; d < 2; d++) assert_near(l.impulse[d], sum[d], 1e-12 * 3e6 * volume * dt * (double)p->n);

    real work = 0;                                   /* over the way they go, with the same forces */
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < 2; d++) {
            real way = 1e-6 * (real)(i + d);
            p->x[d][i] += way;
            work += way * p->f[d][i];
        }
    struct grid none = {0};
    loads_hold(&l, &none, p, 1, dt);
    assert_close(l.work, work, 1e-8);                /* ways of 1e-6 of positions near 1e-2, to 1e-18 */
    assert_true(fabs(work) > 1e-9);
    loads_free(&l);
    cloud_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sine)};
    team_make(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
