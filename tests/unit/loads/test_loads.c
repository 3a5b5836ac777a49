/* Tests applied loads: body forces with a spatial profile, combination of loads, integration in time, tractions, mean
 * displacements, and inertia relief. */
#include <stdarg.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/support/cloud.h"
#include "loads/loads.h"
#include "tests/support/near.h"
#include "base/team.h"

/* Checks a body force with a sine profile along (3, 4)/5, whose origin is inside the body, with components x and y. The
 * profile refers to reference positions, so that displacements have no effect. */
static void test_sine(void **state)
{
    (void)state;
    const real length = 5 * CLOUD_SPACING, volume = square(CLOUD_SPACING) * 2e-3, dt = 1e-6;
    const struct boundary push = {.name = "push",
                                  .kind = BOUNDARY_BODY_FORCE,
                                  .body = -1,
                                  .value = {2e6, -3e6},
                                  .time = {.kind = TIME_RAMP, .until = 4},
                                  .profile = {PROFILE_SINE, length, {CLOUD_SPACING, -CLOUD_SPACING}, {3, 4}}};
    struct particle_cloud c;
    struct loads l;
    real sum[2] = {0};
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {9, 7}, .horizon = 3});
    struct particles *p = &c.p;
    assert_ok(loads_make_from_boundaries(&l, &push, 1, p, CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
    for (int64_t i = 0; i < p->n; i++) p->x[0][i] += 0.3 * CLOUD_SPACING, p->f[1][i] = 77;
    loads_clear_forces_of_loaded_particles(&l, p);
    loads_apply_forces_and_motion_constraints(&l, p, 1 + 0.5 * dt, dt,
                                              dt); /* velocity update around t = 1: a quarter of the ramp */
    for (int64_t i = 0; i < p->n; i++) {
        real along = 0.6 * (p->X[0][i] - CLOUD_SPACING) + 0.8 * (p->X[1][i] + CLOUD_SPACING);
        real factor = 0.25 * sin(2 * M_PI * along / length);
        assert_near(p->f[0][i], 2e6 * volume * factor, 1e-12 * 2e6 * volume);
        assert_near(p->f[1][i], -3e6 * volume * factor, 1e-12 * 3e6 * volume);
        for (int d = 0; d < 2; d++) sum[d] += p->f[d][i] * dt;
    }
    for (int d = 0; d < 2; d++) assert_near(l.impulse[d], sum[d], 1e-12 * 3e6 * volume * dt * (double)p->n);

    real work = 0; /* work of the same forces on the displacements */
    for (int64_t i = 0; i < p->n; i++)
        for (int d = 0; d < 2; d++) {
            real way = 1e-6 * (real)(i + d);
            p->x[d][i] += way;
            work += way * p->f[d][i];
        }
    loads_impose_prescribed_motion_on_particles(&l, p, 1, dt); /* as if the middle of the step were at t = 1 */
    assert_close(l.work, work, 1e-8); /* displacements of 1e-6 at positions near 1e-2, accurate to 1e-18 */
    assert_true(fabs(work) > 1e-9);
    loads_free(&l);
    particle_cloud_free(&c);
}

/* Computes the impulse[], the work *work and the forces f[] of six loads on a body on `threads` threads, for
 * comparison. together: true to combine loads on the same particles, false for separate loads. The loads are two with
 * one profile, one with another, one on part of the body, one whose region contains every particle, and a traction. */
static void check_together(int threads, bool together, real *impulse, real *work, real *f)
{
    const real length = 5 * CLOUD_SPACING, dt = 1e-6;
    const struct profile wave = {PROFILE_SINE, length, {0}, {3, 4}};
    const struct boundary row[] = {
        {.name = "steady", .kind = BOUNDARY_BODY_FORCE, .body = -1, .value = {2e6, -3e6}, .profile = wave},
        {.name = "ramp",
         .kind = BOUNDARY_BODY_FORCE,
         .body = -1,
         .value = {5e6, 1e6},
         .profile = wave,
         .time = {.kind = TIME_RAMP, .until = 4}},
        {.name = "other",
         .kind = BOUNDARY_BODY_FORCE,
         .body = -1,
         .value = {0, 7e6},
         .profile = {PROFILE_SINE, length, {0}, {1, -1}}},
        {.name = "even", .kind = BOUNDARY_BODY_FORCE, .body = 0, .value = {1e6, 0}},
        {.name = "first", .kind = BOUNDARY_BODY_FORCE, .body = 1, .value = {-4e6, 4e6}},
        {.name = "face", .kind = BOUNDARY_TRACTION, .body = -1, .value = {1e6, 2e6}, .face = 1, .side = 1}};
    struct particle_cloud c;
    struct loads l;
    threads_set_count_and_bind_to_cores(threads);
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {71, 53}, .horizon = 3});
    for (int64_t i = 0; i < c.p.n; i++) c.p.body[i] = i % 3 == 0;
    impulse[0] = impulse[1] = *work = 0;
    for (size_t k = 0; k < (together ? 1 : COUNT_OF(row)); k++) {
        assert_ok(loads_make_from_boundaries(&l, together ? row : &row[k], together ? COUNT_OF(row) : 1, &c.p,
                                             CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
        if (k == 0) loads_clear_forces_of_loaded_particles(&l, &c.p);
        loads_apply_forces_and_motion_constraints(&l, &c.p, 1, dt, dt);
        for (int d = 0; d < 2; d++)
            for (int64_t i = 0; i < c.p.n; i++) c.p.x[d][i] += 1e-6 * sin(0.1 * (real)i + d);
        loads_impose_prescribed_motion_on_particles(&l, &c.p, 1, dt);
        for (int d = 0; d < 2; d++) impulse[d] += l.impulse[d];
        *work += l.work;
        for (int d = 0; d < 2; d++)
            for (int64_t i = 0; i < c.p.n; i++) c.p.x[d][i] = c.p.X[d][i];
        if (together) assert_ptr_equal(l.load[0].share[1], l.load[1].share[0]);
        if (together) assert_int_equal(l.load[2].leader, 0);
        loads_free(&l);
    }
    for (int d = 0; d < 2; d++) memcpy(f + d * c.p.n, c.p.f[d], (size_t)c.p.n * sizeof *f);
    particle_cloud_free(&c);
}

static void test_together(void **state)
{
    (void)state;
    enum { N = 71 * 53 };
    static real f[4][2 * N];
    real impulse[4][2], work[4];
    check_together(1, false, impulse[0], &work[0], f[0]);
    for (int threads = 1; threads <= 3; threads++)
        check_together(threads, true, impulse[threads], &work[threads], f[threads]);
    for (int i = 0; i < 2 * N; i++) assert_near(f[1][i], f[0][i], 1e-14 * 2e7 * square(CLOUD_SPACING) * 2e-3);
    for (int d = 0; d < 2; d++) assert_close(impulse[1][d], impulse[0][d], 1e-12);
    assert_close(work[1], work[0], 1e-10); /* terms of both signs, of which 1e-3 remains */
    for (int threads = 2; threads <= 3; threads++) {
        assert_memory_equal(f[threads], f[1], sizeof f[1]);
        assert_memory_equal(impulse[threads], impulse[1], sizeof impulse[1]);
        assert_memory_equal(&work[threads], &work[1], sizeof work[1]);
    }
    threads_set_count_and_bind_to_cores(2);
}

/* Checks the leap-frog integration of loads: half a velocity update, then full updates, each centred at the time of its
 * forces. The impulse of a force is its time integral: exact for a linear function or one that switches at a whole
 * step, else of second order in the step. */
static void test_kicks(void **state)
{
    (void)state;
    const real volume = CLOUD_SPACING * 4e-6, dt = 1e-3;
    const struct {
        struct time_function time;
        real until_now;
    } row[] = {
        {{.kind = TIME_CONSTANT}, 9.5 * dt},
        {{.kind = TIME_STEP, .until = 5 * dt}, 5 * dt}, /* complete */
        {{.kind = TIME_STEP, .from = 3 * dt, .until = 99}, 6.5 * dt},
        {{.kind = TIME_RAMP, .until = 20 * dt}, 9.5 * 9.5 / 40 * dt}, /* integral of t/20 dt */
    };
    for (size_t k = 0; k < COUNT_OF(row); k++) {
        const struct boundary push = {
            .name = "push", .kind = BOUNDARY_BODY_FORCE, .body = -1, .value = {3e6}, .time = row[k].time};
        struct particle_cloud c;
        struct loads l;
        particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_LINE, .count = {4}, .horizon = 3});
        assert_ok(loads_make_from_boundaries(&l, &push, 1, &c.p, CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
        for (int step = 0; step < 10; step++) {
            loads_clear_forces_of_loaded_particles(&l, &c.p);
            loads_apply_forces_and_motion_constraints(&l, &c.p, (step + 0.5) * dt, dt, step == 0 ? 0.5 * dt : dt);
        }
        assert_close(l.impulse[0], 4 * 3e6 * volume * row[k].until_now, 1e-12);
        loads_free(&l);
        particle_cloud_free(&c);
    }
}

/* Sets the volume of every particle of p to that of its cell, as in a filled body. */
static void even_volumes(struct particles *p)
{
    for (int64_t i = 0; i < p->n; i++) p->volume0[i] = square(CLOUD_SPACING) * 2e-3;
}

/* Checks that the resultant of a traction t on an area A is t A, in any direction and also for particles shifted by up
 * to 0.3 spacings. On the unshifted lattice the moment of the tangential component must be that of a force on the face,
 * half a spacing outside the outermost particles. */
static void test_traction(void **state)
{
    (void)state;
    const int rows = 30, columns = 12;
    const real area = rows * CLOUD_SPACING * 2e-3, t[2] = {3e6, -7e6};
    for (int shaken = 0; shaken < 2; shaken++)
        for (int side = -1; side <= 1; side += 2) {
            const struct boundary pull = {
                .name = "pull", .kind = BOUNDARY_TRACTION, .body = -1, .value = {t[0], t[1]}, .face = 0, .side = side};
            struct particle_cloud c;
            struct loads l;
            particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS,
                                                         .count = {columns, rows},
                                                         .horizon = 3,
                                                         .shake = shaken ? 0.3 : 0,
                                                         .seed = 5});
            real sum[2] = {0}, first = 0, *X = c.p.X[0];
            even_volumes(&c.p);
            assert_ok(loads_make_from_boundaries(&l, &pull, 1, &c.p, CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
            loads_add_static_forces(&l, &c.p);
            real low = INFINITY, high = -INFINITY;
            for (int64_t i = 0; i < c.p.n; i++) low = fmin(low, X[i]), high = fmax(high, X[i]);
            for (int64_t i = 0; i < c.p.n; i++) {
                for (int d = 0; d < 2; d++) sum[d] += c.p.f[d][i];
                first += c.p.f[1][i] * X[i];
            }
            for (int d = 0; d < 2; d++) assert_close(sum[d], t[d] * area, 1e-12);
            if (!shaken)
                assert_near(first / (t[1] * area), (side > 0 ? high : low) + side * 0.5 * CLOUD_SPACING,
                            1e-9 * CLOUD_SPACING);
            loads_free(&l);
            particle_cloud_free(&c);
        }
}

/* Checks that the displacement of a load is the mean over its particles weighted by their area shares, as in the work
 * of the load, and the plain mean if the shares add up to zero. */
static void test_mean_displacement(void **state)
{
    (void)state;
    const real length = 5 * CLOUD_SPACING, volume = square(CLOUD_SPACING) * 2e-3;
    const struct boundary push = {.name = "push",
                                  .kind = BOUNDARY_BODY_FORCE,
                                  .body = -1,
                                  .value = {2e6, -3e6},
                                  .profile = {PROFILE_SINE, length, {-0.3 * CLOUD_SPACING, 0}, {1, 0}}};
    struct particle_cloud c;
    struct loads l;
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {3, 4}, .horizon = 3});
    even_volumes(&c.p);
    assert_ok(loads_make_from_boundaries(&l, &push, 1, &c.p, CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
    real shares = 0, moved = 0;
    for (int64_t i = 0; i < c.p.n; i++) {
        const real share = sin(2 * M_PI * (c.p.X[0][i] + 0.3 * CLOUD_SPACING) / length), u = 1e-6 * (real)(i * i);
        c.p.x[0][i] += u;
        shares += share, moved += share * u;
    }
    load_compute_total_force_and_mean_displacement(&l.load[0], &c.p, 1);
    assert_close(l.load[0].reaction[0], 2e6 * volume * shares, 1e-12);
    assert_close(l.load[0].reaction[1], -3e6 * volume * shares, 1e-12);
    assert_close(l.load[0].displacement[0], moved / shares, 1e-9);
    assert_near(l.load[0].displacement[1], 0, 1e-18);
    loads_free(&l);
    particle_cloud_free(&c);
}

/* Checks the force of a load on a particle at a time: value, function of time and formula of time, times the volume of
 * the particle. */
static void test_force_at(void **state)
{
    (void)state;
    const struct expression_step step[] = {{EXPRESSION_X, 0}, {EXPRESSION_T, 0}, {EXPRESSION_TIMES, 0}};
    struct boundary push = {.name = "push",
                            .kind = BOUNDARY_BODY_FORCE,
                            .body = -1,
                            .value = {2e6, -3e6},
                            .time = {.kind = TIME_RAMP, .until = 4}};
    struct particle_cloud c;
    struct loads l;
    expression_make(&push.formula[0], step, 3, "x*t");
    particle_cloud_make(&c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {3, 4}, .horizon = 3});
    even_volumes(&c.p);
    assert_ok(loads_make_from_boundaries(&l, &push, 1, &c.p, CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
    for (int64_t k = 0; k < l.load[0].n; k++) {
        const real volume = square(CLOUD_SPACING) * 2e-3, x = c.p.X[0][l.load[0].particle[k]];
        real force[DIM_MAX];
        load_force_on_particle(&l.load[0], &c.p, k, 1.3, force);
        assert_close(force[0], 1.3 / 4 * 2e6 * volume * x * 1.3, 1e-12);
        assert_close(force[1], 1.3 / 4 * -3e6 * volume, 1e-12);
    }
    loads_free(&l);
    particle_cloud_free(&c);
    expression_free(&push.formula[0]);
}

/* Checks inertia relief: opposite tangential tractions on a free body are balanced by its inertia, so that neither a
 * resultant force nor a moment remains. */
static void test_relief(void **state)
{
    (void)state;
    const struct boundary shear[] = {
        {.name = "up", .kind = BOUNDARY_TRACTION, .body = -1, .value = {1e6, 0}, .face = 1, .side = 1},
        {.name = "down", .kind = BOUNDARY_TRACTION, .body = -1, .value = {-1e6, 0}, .face = 1, .side = -1}};
    struct particle_cloud c;
    struct loads l;
    real sum[2] = {0}, moment = 0, size = 0;
    particle_cloud_make(
        &c, &(struct cloud_plan){.space = SPACE_PLANE_STRESS, .count = {12, 9}, .horizon = 3, .shake = 0.2, .seed = 3});
    even_volumes(&c.p);
    assert_ok(loads_make_from_boundaries(&l, shear, 2, &c.p, CLOUD_SPACING, 3 * CLOUD_SPACING, 0));
    assert_true(loads_add_inertia_relief_and_return_moment_ratio(&l, &c.p) >
                0.3); /* only moment; not largest at the farthest particles */
    loads_add_static_forces(&l, &c.p);
    for (int64_t i = 0; i < c.p.n; i++) {
        for (int d = 0; d < 2; d++) sum[d] += c.p.f[d][i], size += fabs(c.p.f[d][i]);
        moment += c.p.X[0][i] * c.p.f[1][i] - c.p.X[1][i] * c.p.f[0][i];
    }
    for (int d = 0; d < 2; d++) assert_near(sum[d], 0, 1e-12 * size);
    assert_near(moment, 0, 1e-12 * size * 12 * CLOUD_SPACING);
    loads_free(&l);
    particle_cloud_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sine),     cmocka_unit_test(test_kicks),
                                       cmocka_unit_test(test_together), cmocka_unit_test(test_traction),
                                       cmocka_unit_test(test_relief),   cmocka_unit_test(test_mean_displacement),
                                       cmocka_unit_test(test_force_at)};
    threads_set_count_and_bind_to_cores(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
