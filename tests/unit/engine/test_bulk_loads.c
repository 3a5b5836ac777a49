/* Loads on all of a body: gravity, damping, pressure on free faces that follows them or not, rotation, expressions;
 * against closed forms, with the balances of energy and momentum. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "auto/scene_read.h"
#include "base/memory.h"
#include "engine/engine.h"

#define BLOCK                                                                                                          \
    "space: plane strain\nthickness: 1 m\nduration: 1 ms\nmethod: pd\n"                                                \
    "material: {young: 1 MPa, poisson: 1/4, density: 1000}\nbody: {box: {from: [0, 0], to: [30 mm, 50 mm]}}\n"         \
    "particles: {spacing: 5 mm}\n"
#define BAR                                                                                                            \
    "space: line\nsection: 1 cm^2\nduration: 3 ms\nmethod: pd\n"                                                       \
    "material: {young: 72 GPa, poisson: 0, density: 2440}\nbody: {box: {from: [0], to: [1 m]}}\n"                      \
    "particles: {spacing: 20 mm}\n"

struct run { struct scene s; struct engine e; };

/* Runs a scene with the overrides `key=value`, up to NULL. */
static status run_status(struct run *a, const char *text, va_list list)
{
    enum { MOST = 8 };
    static char key[MOST][64];
    struct scene_override override[MOST];
    int n = 0;
    for (const char *one; (one = va_arg(list, const char *)) != NULL; n++) {
        const char *equal = strchr(one, '=');
        snprintf(key[n], sizeof key[n], "%.*s", (int)(equal - one), one);
        override[n] = (struct scene_override){key[n], equal + 1};
    }
    memset(a, 0, sizeof *a);
    TRY(scene_read_text(&a->s, text, strlen(text), "test.yaml", override, n));
    a->e.report.quiet = true;
    TRY(engine_make(&a->e, &a->s, NULL));
    a->e.report.quiet = true;
    return engine_run(&a->e);
}

static void run(struct run *a, const char *text, ...)
{
    va_list list;
    va_start(list, text);
    const status s = run_status(a, text, list);
    va_end(list);
    if (s != OK) fail_msg("%s", status_message());
}

static void run_end(struct run *a)
{
    engine_free(&a->e);
    scene_free(&a->s);
}

/* Worst of a balance that the run has kept, to this tolerance. */
static void balanced(const struct run *a, real tolerance)
{
    const struct energy_balance *now = &a->e.diagnostics.now;
    if (!(fabs(now->balance_error) <= tolerance)) fail_msg("balance %g > %g", now->balance_error, tolerance);
    if (!(now->momentum_error <= 1e-12)) fail_msg("momentum %g", now->momentum_error);
}

static real energy_of(const struct run *a)
{
    return a->e.diagnostics.now.energy.kinetic + a->e.diagnostics.now.energy.strain;
}

static const char *const frames[][2] = {{"method=pd", "mpm.frame=auto"}, {"method=mpm", "mpm.frame=reference"},
                                        {"method=mpm", "mpm.frame=current"}, {"method=adaptive", "mpm.frame=auto"}};
#define FRAMES (sizeof frames / sizeof *frames)

/* Free fall: 1/2 m (g t)^2 and no strain; the work of gravity is all there is. */
static void gravity_makes_bodies_fall(void **state)
{
    (void)state;
    const real mass = 1.5, energy = 0.5 * mass * square(9.81e-3);        /* after 1 ms [kg], [J] */
    for (size_t k = 0; k < FRAMES; k++) {
        struct run a;
        run(&a, BLOCK, frames[k][0], frames[k][1], "gravity=[0, -9.81 m/s^2]", NULL);
        const struct energy_balance *now = &a.e.diagnostics.now;
        const real steps2 = square((real)a.e.clock.steps);       /* 1/2 m v- . v+, v+- = g (t +- dt/2) */
        assert_true(fabs(now->energy.kinetic - energy * (1 - 0.25 / steps2)) < 0.01 * energy);
        assert_true(fabs(now->external_work - energy) < 1e-9 * energy);
        assert_true(now->energy.strain < 1e-12 * energy);
        balanced(&a, 1e-10);
        run_end(&a);
    }
}

/* A bar that stands: its weight is borne by the support, u(L) = -rho g L^2/(2 E). */
static void gravity_rests_on_a_support(void **state)
{
    (void)state;
    struct run a;
    run(&a, BAR, "solver=cg", "gravity=[-9.81 m/s^2]", "boundary=[{mirror: {axis: x, at: 0, tangential: held}}]", NULL);
    const struct particles *p = &a.e.part;
    const real X = p->X[0][p->n - 1], exact = -2440 * 9.81 / 72e9 * (X - 0.5 * X * X);
    assert_true(fabs(p->x[0][p->n - 1] - X - exact) < 0.03 * fabs(exact));      /* the free end is a horizon long */
    run_end(&a);
}

/* Energy of free vibrations falls as exp(-c t), of all modes alike; what is lost is booked. */
static void damping_is_that_of_an_oscillator(void **state)
{
    (void)state;
    static const char halves[] = "initial=[{velocity: [1 m/s], region: {box: {from: [0.5 m], to: [inf]}}}, "
                                 "{velocity: [-1 m/s], region: {box: {from: [-inf], to: [0.5 m]}}}]";
    for (size_t k = 0; k < FRAMES; k++) {
        struct run a;
        run(&a, BAR, frames[k][0], frames[k][1], "damping=1000 1/s", halves, NULL);
        const real start = a.e.diagnostics.energy_start;
        /* modes near the shortest wave see c dt/4 of it, here 0.5 %, the current frame loses 0.3 % by itself */
        assert_true(fabs(-log(energy_of(&a) / start) / 3 - 1) < 0.02);
        assert_true(fabs(a.e.diagnostics.now.energy.damped - start + energy_of(&a)) < 1e-3 * start);
        balanced(&a, k == 2 ? 1e-3 : 1e-10);
        run_end(&a);
    }
}

/* Far beyond critical damping the step shrinks, and bodies creep without gaining energy. */
static void any_damping_only_takes(void **state)
{
    (void)state;
    for (real rate = 1e4; rate < 1e11; rate *= 1e3) {
        struct run a;
        char damping[40];
        snprintf(damping, sizeof damping, "damping=%g 1/s", rate);
        run(&a, BLOCK, damping, "initial=[{displacement_gradient: [[1e-7, 0], [0, 0]]}]", NULL);
        assert_true(energy_of(&a) < a.e.diagnostics.energy_start);
        balanced(&a, 1e-7);             /* coordinates are rounded, strains are 1e-7 */
        run_end(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gravity_makes_bodies_fall),
        cmocka_unit_test(gravity_rests_on_a_support),
        cmocka_unit_test(damping_is_that_of_an_oscillator),
        cmocka_unit_test(any_damping_only_takes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
