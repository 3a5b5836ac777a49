/* Checks that unbreakable bodies keep their energy over arbitrarily long runs: a sample of the cases of `cleave bench
 * stability` (bench/stability/energy_drift*.c). The drift is the growth rate of the energy per step, fitted over the
 * second half of a run, of which 25,000 steps detect 5e-8 as well as 1e5. With the environment variable LONG
 * (long_energy.sh) runs have 1e5 steps. Takes 20 s: 25 bodies. */
#include <stdarg.h>
#include <setjmp.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "../bench/stability/energy_drift.h"
#include "tests/support/near.h"

/* Returns the number of steps of a run: `most` with the environment variable LONG, else a quarter of it. */
static int64_t steps_of(int64_t most) { return getenv("LONG") ? most : most / 4; }

static const struct drift_case *named(const char *name)
{
    for (int k = 0; k < drift_named_count; k++)
        if (!strcmp(drift_named[k].name, name)) return &drift_named[k];
    fail_msg("no case %s", name);
    return NULL;
}

/* Runs the case l for `steps` steps and returns true if drift_holds finds its energy within the limits of
 * energy_drift.h; else prints its figures. */
static bool holds(const struct drift_case *l, int64_t steps)
{
    struct lasting r;
    char label[128];
    drift_label(l, label, sizeof label);
    assert_ok(drift_run(l, steps, &r));
    if (drift_holds(l, &r)) return true;
    print_message("%s: energy %.2e at the end, %.2e at most, %.2e at least, %.2e a step, turned %.1e, %s\n", label,
                  r.end, r.largest, r.least, r.rate, r.turn, r.why[0] ? r.why : "went on");
    return false;
}

static void all_hold(const struct drift_case *sample, int n, int64_t steps)
{
    int wrong = 0;
    for (int k = 0; k < n; k++) wrong += !holds(&sample[k], steps);
    assert_int_equal(wrong, 0);
}

/* ---- growth is detected ------------------------------------------------------------------------------------------ */

/* Checks that growth of energy is detected: a bar of bonds runs with 1.03 times its critical step, 2 sqrt(m/k) of the
 * stiffest mode, known to 2 %. A sample is taken in every step, since the run stops soon. */
static void test_seen(void **state)
{
    (void)state;
    const struct drift_case bar = {
        .c = {.text = "space: line\nduration: 1\nmethod: pd\nmaterial: {young: 72e9, density: 2440}\n"
                      "body: {box: {from: [0], to: [48e-3]}}\nparticles: {spacing: 1e-3}\n"
                      "time: {safety: 1.03}\noutput: {frames: 0, samples: 1}\n"}};
    struct lasting r;
    assert_ok(drift_run(&bar, 400, &r));
    assert_false(drift_holds(&bar, &r));
    assert_true(r.stopped > 0 && r.loudest > 10 && r.rate > 1e-3);
}

/* ---- energy is constant ------------------------------------------------------------------------------------------ */

#define PLATE .dim = 2, .edge = 12
#define MESH(by, law, nu, where)                                                                                       \
    PLATE, .method = "adaptive", .frame = "reference", .coupling = by, .model = law, .poisson = nu, .region = where
static const struct drift_case meshed[] = {
    {.c = {MESH("partial stress", "bond", 0, DISC)}},
    {.c = {MESH("partial stress", "ospd", 0.2, NOTCH)}},
    {.c = {MESH("partial stress", "ospd", 0.49, SQUARE), .space = "plane strain"}},
    {.c = {MESH("handshake", "ospd", 0.45, HALF)}},
    {.c = {MESH("partial stress", "mospd", 0.25, SQUARE), .offset = 0.5}},
    {.c = {MESH("partial stress", "mospd", 0.45, CORNER)}},
    {.c = {MESH("handshake", "mospd", 0.3, NOTCH)}},
};

static void test_meshed(void **state)
{
    (void)state;
    const struct drift_case solid = {.c = {.dim = 3,
                                           .edge = 6,
                                           .method = "adaptive",
                                           .frame = "reference",
                                           .coupling = "partial stress",
                                           .model = "mospd",
                                           .poisson = 0.3,
                                           .horizon = 2.015,
                                           .region = CORNER}};
    all_hold(meshed, COUNT_OF(meshed), steps_of(100000));
    all_hold(&solid, 1, steps_of(20000));
}

static const struct drift_case held[] = {
    {.c = {PLATE, .method = "pd", .model = "bond", .weights = "isotropic", .horizon = 2.015, .support = CLAMP}},
    {.c = {PLATE, .method = "pd", .model = "mospd", .poisson = 0.45, .support = CLAMP_MIRROR}},
    {.c = {PLATE, .method = "pd", .model = "ospd", .poisson = 0.3, .irregularity = 0.5, .support = FIXED}},
    {.c = {MESH("partial stress", "ospd", 0.3, HALF), .support = CLAMP_ACROSS}},
    {.c = {MESH("partial stress", "mospd", 0.3, HALF), .support = MIRRORS}},
    {.c = {MESH("partial stress", "bond", 0, HALF), .support = DRIVEN}},
};

static void test_held(void **state)
{
    (void)state;
    all_hold(held, COUNT_OF(held), steps_of(100000));
}

/* Bodies with a notch of zero width whose faces collide repeatedly. Leap-frog integration gains or loses energy when a
 * contact begins or ends; contact_balance.c removes the gain at the next contact. Measured energy: 6 % below to 0.3 %
 * above the initial one, three times the initial one without this correction. Between these bounds the energy varies,
 * by round-off differently on each processor: the growth rate fitted over the last 50,000 steps is up to 1.3e-6 per
 * step (AVX2), the rise from the lower to the upper bound. */
static const struct drift_case touching[] = {
    {.c = {MESH("partial stress", "ospd", 0.2, NOTCH), .contact = true}},
    {.c = {MESH("handshake", "mospd", 0.3, NOTCH), .contact = true}},
    {.c = {PLATE, .method = "pd", .region = NOTCH, .contact = true}},
};

static void test_touching(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(touching); k++) {
        struct lasting r;
        assert_ok(drift_run(&touching[k], steps_of(100000), &r));
        if (!(r.largest < 0.01 && r.least > -0.1 && r.rate < 2e-6))
            fail_msg("notch %zu: energy %+.2e, %.2e at most, %.2e a step", k, r.end, r.largest, r.rate);
    }
}

/* ---- energy is not gained ---------------------------------------------------------------------------------------- */

#define GRID(by, law, nu, where, to)                                                                                   \
    PLATE, .method = "adaptive", .frame = "current", .transfer = to, .shape = "gimp", .coupling = by, .model = law,    \
           .poisson = nu, .region = where
static const struct drift_case current[] = {
    {.c = {GRID("partial stress", "bond", 0, SQUARE, "flip"), .offset = 0.25}},
    {.c = {GRID("handshake", "bond", 0, HALF, "flip")}},
    {.c = {GRID("partial stress", "ospd", 0.2, DISC, "flip")}},
    {.c = {GRID("partial stress", "mospd", 0.3, CORNER, "apic")}},
    /* Strongly irregular particles: checks that no instability stops these runs, which one at any step size would do
     * within 1000 steps. */
    {.c = {GRID("partial stress", "bond", 0, SQUARE, "flip"), .irregularity = 0.9}},
    {.c = {GRID("partial stress", "bond", 0, SQUARE, "apic"), .irregularity = 0.7}},
};

static void test_current(void **state)
{
    (void)state;
    all_hold(current, COUNT_OF(current), steps_of(50000));
    assert_true(holds(named("solid, apic, nu 0.49"), 2000));
}

/* Checks a known property: random motion in a bar of FLIP points gains energy, in proportion to its velocities v (about
 * 0.013 v/c per step), because the weights move with the points between forces and strains. It is an effect beyond the
 * linear step. The reference frame and APIC do not gain energy. */
static void test_noise(void **state)
{
    (void)state;
    const struct drift_case
        flip = {.c = {.dim = 1, .edge = 32, .method = "mpm", .frame = "current", .transfer = "flip", .shape = "gimp"}},
        apic = {.c = {.dim = 1, .edge = 32, .method = "mpm", .frame = "current", .transfer = "apic", .shape = "gimp"}},
        mesh = {.c = {.dim = 1, .edge = 32, .method = "mpm", .frame = "reference"}};
    struct lasting r;
    assert_ok(drift_run(&flip, steps_of(50000), &r));
    if (!(r.end > 0.005 && r.largest < 0.15))
        fail_msg("a bar of FLIP points: energy %+.2e, known to gain 0.5 to 15 %%", r.end);
    assert_true(holds(&apic, steps_of(50000)) && holds(&mesh, steps_of(50000)));
}

/* A plate with a slit between its cells or inside them, whose bonds do not break. */
#define SLIT(height)                                                                                                   \
    {                                                                                                                  \
        .name = "slit at " height, .c = {                                                                              \
            .dim = 2,                                                                                                  \
            .text = "space: plane stress\nthickness: 1e-3\nduration: 1\nmethod: adaptive\n"                            \
                    "material: {young: 72e9, density: 2440}\nbody: {box: {from: [0, 0], to: [14e-3, 10e-3]}}\n"        \
                    "particles: {spacing: 1e-3, horizon: 2.015}\ncracks: [{from: [-1e-3, " height                      \
                    "], to: [9.3e-3, " height "]}]\n"                                                                  \
                    "conversion: {notch: slit, tips: 1}\ncontact: {between: none}\noutput: {frames: 0, samples: 1}\n"  \
        }                                                                                                              \
    }

static void test_slit(void **state)
{
    (void)state;
    static const struct drift_case slit[] = {SLIT("4e-3"), SLIT("5e-3")};
    all_hold(slit, COUNT_OF(slit), 10000);
}

/* Checks four cases that are prone to gain energy, over 10,000 steps. */
static void test_named(void **state)
{
    (void)state;
    int wrong = 0;
    wrong += !holds(named("strip, mospd nu 0.45, reference"), 10000);
    wrong += !holds(named("square, bonds, current flip"), 10000);
    wrong += !holds(named("square, bonds, current flip, hand-shake"), 10000);
    wrong += !holds(named("strip of points, apic"), 10000);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_seen),    cmocka_unit_test(test_meshed),
                                       cmocka_unit_test(test_held),    cmocka_unit_test(test_touching),
                                       cmocka_unit_test(test_current), cmocka_unit_test(test_noise),
                                       cmocka_unit_test(test_named),   cmocka_unit_test(test_slit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
