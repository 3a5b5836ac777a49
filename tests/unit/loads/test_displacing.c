/* Tests the displacement that a boundary prescribes at a time: its own value for `displacement`, the time integral for
 * a velocity and for a rotation. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "loads/loads.h"
#include "tests/support/near.h"
#include "base/team.h"

/* Sets *e to the expression x*x or, if with_time, x*t, of reference position and time. */
static void by_x(struct expression *e, bool with_time)
{
    const struct expression_step step[] = {
        {EXPRESSION_X, 0}, {with_time ? EXPRESSION_T : EXPRESSION_X, 0}, {EXPRESSION_TIMES, 0}};
    expression_make(e, step, 3, with_time ? "x*t" : "x*x");
    e->in_space = true, e->in_time = with_time;
}

/* A body of particles and the loads of one boundary that acts on all of them. */
struct displaced {
    struct particle_cloud c;
    struct loads l;
};
static void displaced_make(struct displaced *m, const struct boundary *b)
{
    particle_cloud_make(&m->c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {7, 5}, .horizon = 3});
    assert_ok(loads_make_from_boundaries(&m->l, b, 1, &m->c.p, CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
    assert_true(m->l.load[0].n == m->c.p.n);
}

static void displaced_free(struct displaced *m)
{
    loads_free(&m->l);
    particle_cloud_free(&m->c);
}

/* Checks prescribed displacements and velocities, each by a number and by a formula times a ramp in time, against
 * closed forms. A component that is not prescribed yields 0 whatever its value. */
static void test_values(void **state)
{
    (void)state;
    struct boundary b = {.name = "grip",
                         .kind = BOUNDARY_VELOCITY,
                         .body = -1,
                         .components = 1,
                         .value = {3, 7},
                         .time = {.kind = TIME_RAMP, .until = 4}};
    struct displaced m;
    for (int kind = 0; kind < 4; kind++) {
        const bool displaces = kind % 2 == 1, formula = kind >= 2;
        b.displaces = displaces;
        if (formula) by_x(&b.formula[0], false);
        displaced_make(&m, &b);
        for (int64_t k = 0; k < m.c.p.n; k += 11) {
            real u[DIM_MAX];
            const real place = formula ? square(m.c.p.X[0][k]) : 1;
            load_prescribed_displacement_of_particle(&m.l.load[0], &m.c.p, k, 2, u);
            assert_near(u[0], 0.5 * 3 * place, 1e-15 * 3); /* t/4 and its integral t^2/8 are both 1/2 at t = 2 */
            load_prescribed_displacement_of_particle(&m.l.load[0], &m.c.p, k, 6, u);
            assert_near(u[0], (displaces ? 1 : 4) * 3 * place, 1e-15 * 12);
            assert_true(u[1] == 0);
        }
        assert_ok(boundary_check_velocity_has_closed_form_integral(&b));
        displaced_free(&m);
    }
    expression_free(&b.formula[0]);
}

/* Checks the rotation about an oblique axis in 3D against Rodrigues' formula, separately for the components of the arm
 * along the axis and across it. */
static void test_turn_in_space(void **state)
{
    (void)state;
    const struct boundary b = {.name = "grip",
                               .kind = BOUNDARY_VELOCITY,
                               .body = -1,
                               .components = 7,
                               .rotates = true,
                               .rate = 0.7,
                               .centre = {0.3, -0.1, 0.8},
                               .axis_of = {2, -3, 6},
                               .time = {.kind = TIME_CONSTANT}};
    const real axis[] = {2 / 7.0, -3 / 7.0, 6 / 7.0}, arm[] = {1.3, 0.4, -0.6}, angle = 0.7 * 1.9;
    const struct prescribed_displacement by = boundary_prescribed_displacement_at_time(&b, 3, 1.9);
    const struct prescribed_motion step = boundary_prescribed_motion_in_step(&b, 3, 1.9, 0.2);
    const real along = dot(axis, arm, 3);
    real X[3], way[3];
    for (int d = 0; d < 3; d++) X[d] = b.centre[d] + arm[d];
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        const real turned = axis[e] * arm[f] - axis[f] * arm[e];
        const real to = arm[d] * cos(angle) + turned * sin(angle) + axis[d] * along * (1 - cos(angle));
        assert_near(prescribed_displacement_component_at_position(&by, X, d), to - arm[d], 1e-14);
        way[d] = prescribed_velocity_component_at_position(&step, X, d, false);
    }
    /* Mean velocity from 1.8 to 2 s: chord of the circle over the duration. */
    const real across = sqrt(dot(arm, arm, 3) - square(along));
    assert_near(sqrt(dot(way, way, 3)), 2 * across * sin(0.5 * 0.7 * 0.2) / 0.2, 1e-13);
    assert_near(dot(way, axis, 3), 0, 1e-14);
}

/* Checks a rotation by a right angle about the point (1, 2) spacings at a linearly increasing rate. */
static void test_turn(void **state)
{
    (void)state;
    const struct boundary b = {.name = "grip",
                               .kind = BOUNDARY_VELOCITY,
                               .body = -1,
                               .components = 3,
                               .rotates = true,
                               .value = {1, 1},
                               .centre = {CLOUD_SPACING, 2 * CLOUD_SPACING},
                               .rate = M_PI / 4,
                               .time = {.kind = TIME_RAMP, .until = 4}};
    struct displaced m;
    displaced_make(&m, &b);
    for (int64_t k = 0; k < m.c.p.n; k++) {
        real u[DIM_MAX];
        const real x = m.c.p.X[0][k] - b.centre[0], y = m.c.p.X[1][k] - b.centre[1];
        load_prescribed_displacement_of_particle(&m.l.load[0], &m.c.p, k, 4, u); /* the integral of t/4 to 4 is 2 */
        assert_near(u[0], -y - x, 1e-15 * 10 * CLOUD_SPACING);
        assert_near(u[1], x - y, 1e-15 * 10 * CLOUD_SPACING);
    }
    displaced_free(&m);
}

/* Checks formulas of t. A displacement is the formula's value at the time; a velocity by formula has no closed
 * integral; a static problem uses the value at the end. */
static void test_formula_of_time(void **state)
{
    (void)state;
    struct boundary b = {
        .name = "grip", .kind = BOUNDARY_VELOCITY, .body = -1, .components = 1, .value = {1}, .displaces = true};
    struct displaced m;
    real u[DIM_MAX];
    by_x(&b.formula[0], true);
    displaced_make(&m, &b);
    load_prescribed_displacement_of_particle(&m.l.load[0], &m.c.p, 3, 5, u);
    assert_true(m.c.p.X[0][3] != 0 && u[0] == 5 * m.c.p.X[0][3]);
    assert_ok(boundary_check_velocity_has_closed_form_integral(&b));
    displaced_free(&m);
    b.displaces = false;
    assert_true(boundary_check_velocity_has_closed_form_integral(&b) == REFUSED);
    assert_non_null(strstr(status_message(), "boundary grip: a velocity that is a formula of t"));
    b.frozen = true, b.frozen_at = 2, b.time = (struct time_function){.kind = TIME_STEP, .until = 1};
    assert_ok(boundary_check_velocity_has_closed_form_integral(&b));
    displaced_make(&m, &b);
    load_prescribed_displacement_of_particle(&m.l.load[0], &m.c.p, 3, 1, u);
    assert_true(u[0] == 2 * m.c.p.X[0][3]);
    displaced_free(&m);
    expression_free(&b.formula[0]);
}

/* Compares the largest slope of a function of time with finite differences. It is infinite at a jump, and 0 before the
 * start. */
static void test_steepest(void **state)
{
    (void)state;
    enum { PIECES = 20000 };
    real t[] = {-1, 0.5, 1.5, 2}, value[] = {0, 3, 1, 1.5};
    const struct time_function f[] = {{.kind = TIME_CONSTANT},
                                      {.kind = TIME_RAMP, .from = 0.3, .until = 1.1},
                                      {.kind = TIME_PULSE, .from = 0.1, .until = 1.9},
                                      {.kind = TIME_TABLE, .n = 4, .t = t, .value = value}};
    for (size_t k = 0; k < sizeof f / sizeof *f; k++) {
        real most = 0;
        for (int p = 0; p < PIECES; p++)
            most = real_max(most, fabs(time_function_value(&f[k], 2.0 * (p + 1) / PIECES) -
                                       time_function_value(&f[k], 2.0 * p / PIECES)) /
                                      (2.0 / PIECES));
        assert_close(time_function_largest_slope_until(&f[k], 2), most, 1e-6);
    }
    assert_true(time_function_largest_slope_until(&f[1], 0.2) == 0 &&
                time_function_largest_slope_until(&f[2], 0.05) == 0);
    const struct time_function step = {.kind = TIME_STEP, .from = 0, .until = 1};
    assert_true(time_function_largest_slope_until(&step, 0.9) == 0 &&
                isinf(time_function_largest_slope_until(&step, 1.1)));
}

/* Checks a static problem: each particle has the prescribed displacement of the end of the run, and the work is half
 * the sum of support forces times displacements. */
static void test_static(void **state)
{
    (void)state;
    struct boundary b = {.name = "grip",
                         .kind = BOUNDARY_VELOCITY,
                         .body = -1,
                         .components = 1,
                         .value = {2},
                         .displaces = true,
                         .time = {.kind = TIME_RAMP, .until = 8}},
                    end;
    struct displaced m;
    by_x(&b.formula[0], true);
    static_boundaries_make_from_dynamic(&end, &b, 1, 4, 0.1); /* 2 x t at t = 4, times a factor 1/2 */
    displaced_make(&m, &end);
    struct particles *p = &m.c.p;
    real *u[2] = {NEW("test.u", p->n, real), NEW("test.u", p->n, real)}, work = 0, mean = 0;
    uint8_t *held = NEW("test.held", p->n, uint8_t);
    loads_compute_prescribed_static_displacements(&m.l, p, 0.1, u, held);
    for (int64_t i = 0; i < p->n; i++) {
        assert_true(held[i] == 1 && u[1][i] == 0);
        assert_close(u[0][i], 4 * p->X[0][i], 1e-15);
        p->f[0][i] = 3 + (real)i, p->f[1][i] = 5;
        work -= 0.5 * (3 + (real)i) * u[0][i], mean += u[0][i] / (real)p->n;
    }
    loads_extract_static_reactions_from_forces(&m.l, p);
    loads_compute_work_in_static_equilibrium(&m.l, p);
    assert_close(m.l.constraint_work, work, 1e-13);
    assert_close(m.l.load[0].displacement[0], mean, 1e-14);
    assert_true(p->f[0][3] == 0 && p->f[1][3] == 5);
    memory_free(u[0]), memory_free(u[1]), memory_free(held);
    displaced_free(&m);
    expression_free(&b.formula[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_values),        cmocka_unit_test(test_turn),
                                       cmocka_unit_test(test_turn_in_space), cmocka_unit_test(test_formula_of_time),
                                       cmocka_unit_test(test_steepest),      cmocka_unit_test(test_static)};
    threads_set_count_and_bind_to_cores(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
