/* Tests that the causes of an instability are distinguished: a time step above the limit, loads that the body cannot
 * carry, and energy gains at any step. */
#include <stdarg.h>
#include <setjmp.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "../bench/common/bench.h"
#include "tests/support/near.h"
#include "base/rise.h"
#include "step/stability.h"
#include "step/checks.h"

/* ---- growth rate ------------------------------------------------------------------------------------------------- */

/* Returns samples of a quantity that grows exponentially, tenfold in `tenfold` steps, recorded every `stride` steps
 * before step 20000. */
static struct quantity_samples rising(real tenfold, int64_t stride)
{
    struct quantity_samples r = {0};
    for (int64_t step = 0; step < 20000; step += stride)
        quantity_samples_add_value(&r, step, pow(10, (real)(step - 20000) / tenfold));
    return r;
}

static void pace_of_exponentials(void **state)
{
    (void)state;
    static const struct {
        real tenfold;
        int64_t stride;
        enum growth_rate target_speed;
    } at[] = {
        {5, 64, RISE_FAST},     {60, 64, RISE_FAST},   {95, 64, RISE_FAST},
        {95, 700, RISE_FAST},   {150, 64, RISE_SLOW},  {1000, 64, RISE_SLOW},
        {1000, 700, RISE_SLOW}, {4000, 64, RISE_SLOW}, {1000, 1, RISE_SLOW},
    };
    for (size_t k = 0; k < COUNT_OF(at); k++) {
        const struct quantity_samples r = rising(at[k].tenfold, at[k].stride);
        real steps;
        assert_int_equal(quantity_samples_classify_growth_rate(&r, 20000, 1, &steps), at[k].target_speed);
        /* 64 values 16 steps apart: exact. */
        if (at[k].stride == 1)
            assert_true(steps > 990 && steps < 1010);
        else
            assert_near(steps, at[k].tenfold, 1e-6 * at[k].tenfold); /* between values: round-off */
    }
    const struct quantity_samples endless = rising(1e5, 64); /* more than 64 x 64 steps ago */
    real steps;
    assert_int_equal(quantity_samples_classify_growth_rate(&endless, 20000, 1, &steps), RISE_SLOW);
    assert_true(isinf(steps));
}

static void pace_of_few_values(void **state)
{
    (void)state;
    real steps;
    struct quantity_samples r = {0};
    assert_int_equal(quantity_samples_classify_growth_rate(&r, 10, 1, &steps), RISE_UNSURE);
    quantity_samples_add_value(&r, 0, 0);
    assert_int_equal(quantity_samples_classify_growth_rate(&r, 10, 1, &steps), RISE_FAST); /* growth from zero */
    assert_int_equal(quantity_samples_classify_growth_rate(&r, 20000, 1, &steps),
                     RISE_UNSURE); /* at some time within 20000 steps */
    quantity_samples_add_value(&r, 640, -1e-3);
    assert_int_equal(quantity_samples_classify_growth_rate(&r, 1280, 1, &steps), RISE_FAST);
    quantity_samples_add_value(&r, 650, 0.5); /* too close to the previous value: ignored */
    assert_int_equal(r.n, 2);
    quantity_samples_add_value(&r, 1280, 1e-3); /* a background value, or slow growth: undecidable */
    assert_int_equal(quantity_samples_classify_growth_rate(&r, 1920, 1, &steps), RISE_UNSURE);
    quantity_samples_add_value(&r, 1920, 0.06);
    assert_int_equal(quantity_samples_classify_growth_rate(&r, 2560, 1, &steps), RISE_SLOW);
}

/* Integrates x'' = -4 x + damping x' by leap-frog steps dt, whose limit is 1, until the squared velocity has grown from
 * about 1e-8 to 1. Returns the class of its growth rate. */
static enum growth_rate pace_of_oscillator(real dt, real damping)
{
    struct quantity_samples r = {0};
    real x = 1e-4, v = 0, steps, most = 0;
    quantity_samples_add_value(&r, 0, 0);
    for (int64_t step = 1; step < 1000000; step++) {
        v += dt * (damping * v - 4 * x);
        x += dt * v;
        most = real_max(most, square(v));
        if (square(v) > 1) return quantity_samples_classify_growth_rate(&r, step, square(v), &steps);
        if (step % RISE_STRIDE == 0) quantity_samples_add_value(&r, step, most), most = 0;
    }
    fail_msg("dt = %g does not grow", dt);
    return RISE_UNSURE;
}

/* Checks that a step beyond the limit by a relative 2e-5 is classified as fast growth, and an amplitude that gains 1e-3
 * per step within the limit as slow. */
static void steps_beyond_the_limit_are_fast(void **state)
{
    (void)state;
    const real beyond[] = {1 + 2e-5, 1.001, 1.02, 1.2, 2};
    for (size_t k = 0; k < COUNT_OF(beyond); k++) assert_int_equal(pace_of_oscillator(beyond[k], 0), RISE_FAST);
    const real within[] = {0.1, 0.5, 0.8};
    for (size_t k = 0; k < COUNT_OF(within); k++)
        assert_int_equal(pace_of_oscillator(within[k], 2e-3 / within[k]), RISE_SLOW);
}

/* ---- messages ---------------------------------------------------------------------------------------------------- */

/* Scene of an adaptive plate without loads. */
static const char plate[] =
    "space: plane stress\nthickness: 1 mm\nduration: 1 ms\nmethod: adaptive\nmpm: {frame: current}\n"
    "material: {young: 200 GPa, poisson: 1/3, density: 7850}\n"
    "body: {box: {from: [0, 0], to: [20 mm, 20 mm]}}\nparticles: {spacing: 1 mm}\n"
    "pd: {region: {box: {from: [5 mm, 5 mm], to: [15 mm, 15 mm]}}}\noutput: {frames: 0, samples: 100}\n";

/* Writes the advice for the override key=value (key may be NULL) to `remedy`, where the velocity has grown tenfold in
 * `tenfold` steps until step 20000 in a plate without loads. */
static void remedy_of(const char *key, const char *value, real tenfold, char *remedy)
{
    struct run e;
    struct scene s;
    struct bench_overrides o = {0};
    if (key) bench_overrides_append(&o, key, "%s", value);
    assert_ok(bench_engine_make(&e, &s, "plate", plate, bench_overrides_as_array(&o), o.n));
    const struct quantity_samples r = rising(tenfold, 200);
    e.clock.step = 20000, e.clock.t = 20000 * e.clock.dt;
    e.part.v[0][0] = 1; /* not caused by work of loads */
    run_describe_remedy_for_divergence(&e, &r, 1, remedy, REMEDY_LENGTH);
    bench_engine_free(&e, &s);
}

static void slow_growth_is_no_matter_of_the_step(void **state)
{
    (void)state;
    char remedy[REMEDY_LENGTH];
    remedy_of(NULL, NULL, 1000, remedy);
    assert_null(strstr(remedy, "choose a smaller"));
    assert_non_null(strstr(remedy, "took 1000 steps to grow tenfold"));
    assert_non_null(strstr(
        remedy,
        "gains energy: try method: pd, mpm.frame: reference or mpm.transfer: apic, and please report the scene"));
    remedy_of("model", "mospd", 1000, remedy);
    assert_non_null(strstr(remedy, "model: bond"));
    remedy_of("coupling", "pgg", 1000, remedy);
    assert_non_null(strstr(remedy, "coupling: partial stress"));
    remedy_of("mpm.frame", "reference", 1000, remedy);
    assert_non_null(strstr(remedy, "try method: pd or mpm.frame: current, and"));
    remedy_of("boundary", "[{mirror: {axis: x, at: 0, tangential: held}}]", 1000, remedy);
    assert_non_null(strstr(remedy, "`fixed` in place of a mirror with tangential: held"));
    remedy_of(NULL, NULL, 20, remedy);
    assert_true(strncmp(remedy, "choose a smaller time.safety (now dt = ", 39) == 0);
    assert_null(strstr(remedy, "gains energy"));
    remedy_of("time.step", "1 us", 1000, remedy); /* above the critical one: 0.4 us */
    assert_true(strncmp(remedy, "choose a smaller time.step (now dt = ", 37) == 0);
}

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Runs the plate with the overrides method[] and set[], pairs of key and value up to NULL; the run must stop as
 * unstable. Returns the message. */
static const char *stopped(const char *const *method, const char *const *set)
{
    struct run e;
    struct scene s;
    struct bench_overrides o = {0};
    for (; *method; method += 2) bench_overrides_append(&o, method[0], "%s", method[1]);
    for (; *set; set += 2) bench_overrides_append(&o, set[0], "%s", set[1]);
    assert_ok(bench_engine_make(&e, &s, "plate", plate, bench_overrides_as_array(&o), o.n));
    assert_int_equal(run_advance_to_end_time(&e), FAILED);
    assert_non_null(strstr(status_message(), "unstable at step "));
    bench_engine_free(&e, &s);
    return status_message();
}

static const char *const methods[][5] = {{"method", "pd"},
                                         {"method", "pd", "model", "mospd"},
                                         {"method", "mpm"},
                                         {"method", "adaptive"},
                                         {"method", "mpm", "mpm.frame", "reference"},
                                         {"method", "adaptive", "mpm.frame", "reference"}};

static void check_said(const char *const *set, const char *said, const char * not )
{
    for (size_t k = 0; k < COUNT_OF(methods); k++) {
        const char *message = stopped(methods[k], set);
        if (!strstr(message, said) || strstr(message, not )) fail_msg("method %zu: %s", k, message);
    }
}

static void loads_beyond_reason_are_named(void **state)
{
    (void)state;
    check_said((const char *[]){"boundary",
                                "[{name: pull, traction: [0, 1e30], face: y+}, {traction: [0, 1], face: y-}]", NULL},
               "boundary pull, a traction of 1e+30 Pa, gives its particles ", "choose a smaller");
    check_said((const char *[]){"boundary",
                                "[{traction: [0, 1], face: y-}, {body_force: [1e16, 0], time: {ramp: {until: 1 us}}}]",
                                NULL},
               "boundary boundary1, a body force of 1e+16 N/m^3, gives its particles ", "choose a smaller");
    check_said((const char *[]){"boundary",
                                "[{name: hit, velocity: [1e5, free], region: {box: {from: [0, 0], to: [1 mm, 1]}}}]",
                                NULL},
               "boundary hit, a velocity of 1e+05 m/s, drives its particles at 1e+05 m/s", "choose a smaller");
    check_said(
        (const char *[]){"initial", "[{velocity: [1e5, 0], region: {box: {from: [0, 0], to: [9 mm, 1]}}}]", NULL},
        "the scene starts with 1e+05 m/s", "choose a smaller");
}

/* Checks that a too long time step is reported as the cause where the loads are those that a body can carry. */
static void steps_too_long_are_named(void **state)
{
    (void)state;
    check_said((const char *[]){"time.safety", "1.2", "boundary", "[{traction: [0, 100 MPa], face: y+}]", "initial",
                                "[{velocity_gradient: [10, 3, 0, -7]}]", NULL},
               "; choose a smaller time.safety (now dt = ", "no time step");
}

/* Checks that a body that becomes unstable and is sampled only at the end of its run is reported as unstable. */
static void the_last_sample_is_looked_at(void **state)
{
    (void)state;
    const char *message =
        stopped(methods[2], (const char *[]){"time.safety", "1.2", "output.samples", "1", "duration", "85 us",
                                             "initial", "[{velocity_gradient: [10, 3, 0, -7]}]", NULL});
    if (!strstr(message, "of its energy gained without work of loads; choose a smaller time.safety"))
        fail_msg("%s", message);
}

/* ---- large displacements ----------------------------------------------------------------------------------------- */

enum { RING = 24 };

/* A ring of particles in the plane z = 0.7 around (3, -2) with radius 1.3, on which a pressure acts. */
struct loaded_ring {
    struct particles part;
    real X[DIM_MAX][RING], x[DIM_MAX][RING];
    int32_t particle[RING];
    struct load load;
    struct loads loads;
    struct boundary boundary;
};

static void ring_make(struct loaded_ring *r)
{
    *r = (struct loaded_ring){.part = {.n = RING, .n_all = RING, .n_body = RING, .dim = 3}};
    r->boundary = (struct boundary){.name = "lid", .kind = BOUNDARY_PRESSURE};
    r->load = (struct load){.boundary = &r->boundary, .n = RING, .particle = r->particle};
    r->loads = (struct loads){.n = 1, .load = &r->load};
    for (int d = 0; d < DIM_MAX; d++) r->part.X[d] = r->X[d], r->part.x[d] = r->x[d];
    for (int i = 0; i < RING; i++) {
        const real angle = 2 * 3.14159265358979323846 * i / RING;
        r->particle[i] = i, r->X[2][i] = 0.7;
        r->X[0][i] = 3 + 1.3 * cos(angle), r->X[1][i] = -2 + 1.3 * sin(angle);
    }
}

/* Sets the current positions of r: stretched along x by the factor `stretch`, rotated by `degrees` about the axis
 * `axis` through the origin, and shifted. */
static void ring_move(struct loaded_ring *r, int axis, real degrees, real stretch)
{
    const real angle = degrees * 3.14159265358979323846 / 180, c = cos(angle), s = sin(angle);
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (int i = 0; i < RING; i++) {
        const real X[] = {stretch * r->X[0][i], r->X[1][i], r->X[2][i]};
        r->x[axis][i] = X[axis] + 5;
        r->x[a][i] = c * X[a] - s * X[b], r->x[b][i] = s * X[a] + c * X[b] - 11;
    }
}

/* Checks that a surface that has rotated by more than 10 degrees about any axis is reported if its pressure does not
 * follow it; a stretch by 2 is no rotation. */
static void pressures_on_turned_surfaces(void **state)
{
    (void)state;
    struct loaded_ring r;
    struct warnings said = {0};
    ring_make(&r);
    for (int axis = 0; axis < 3; axis++)
        for (int k = 0; k < 4; k++) {
            struct large_motion m = {0};
            ring_move(&r, axis, k == 0 ? 9.9 : k == 1 ? -10.1 : k == 2 ? 137 : 0, k == 3 ? 2 : 1);
            large_motion_warn_of_non_follower_pressure(&m, &r.part, &r.loads, 0.3, &said);
            assert_int_equal(m.turned, k == 1 || k == 2);
        }
    struct large_motion follows = {0};
    ring_move(&r, 2, 50, 1);
    r.boundary.follow = true;
    large_motion_warn_of_non_follower_pressure(&follows, &r.part, &r.loads, 0.3, &said);
    assert_false(follows.turned);
    warnings_free(&said);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pace_of_exponentials),
                                       cmocka_unit_test(pace_of_few_values),
                                       cmocka_unit_test(steps_beyond_the_limit_are_fast),
                                       cmocka_unit_test(slow_growth_is_no_matter_of_the_step),
                                       cmocka_unit_test(loads_beyond_reason_are_named),
                                       cmocka_unit_test(steps_too_long_are_named),
                                       cmocka_unit_test(the_last_sample_is_looked_at),
                                       cmocka_unit_test(pressures_on_turned_surfaces)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
