/* floor 5: the automatic time step against the limit of growth; steps beyond it are caught; twins of a scene, mirrored, turned
 * and rescaled, give the same; bodies at the edge of what an automatic step can mean. */
#include <stdarg.h>
#include <setjmp.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "../bench/stability.h"
#include "memory.h"
#include "near.h"

/* ---- the automatic step ---------------------------------------------------------------------------------------- */

static const struct stability_case bounds[] = {
    {.dim = 1, .method = "pd"},
    {.dim = 2, .method = "pd"},
    {.dim = 2, .method = "pd", .horizon = 1},
    {.dim = 2, .method = "pd", .irregularity = 0.5},
    {.dim = 2, .method = "pd", .heavier = 8},
    {.dim = 2, .method = "pd", .model = "ospd", .space = "plane strain", .poisson = 0.499},
    {.dim = 2, .method = "pd", .model = "mospd", .irregularity = 0.5},
    {.dim = 3, .method = "pd", .horizon = 2.015},
    {.group = GROUP_POINTS, .dim = 2, .method = "mpm", .shape = "linear", .transfer = "flip", .offset = 0.25},
    {.group = GROUP_POINTS, .dim = 2, .method = "mpm", .shape = "gimp", .transfer = "flip"},
    {.group = GROUP_POINTS, .dim = 2, .method = "mpm", .shape = "gimp", .transfer = "flip", .space = "plane strain", .poisson = 0.499},
    {.group = GROUP_POINTS, .dim = 2, .method = "mpm", .shape = "cubic", .transfer = "flip"},
    {.group = GROUP_POINTS, .dim = 2, .method = "mpm", .shape = "gimp", .transfer = "apic"},
    {.group = GROUP_POINTS, .dim = 1, .method = "mpm", .shape = "gimp", .transfer = "apic", .cell = 4},
    {.group = GROUP_POINTS, .dim = 2, .method = "mpm", .shape = "quadratic", .transfer = "apic", .cell = 1},
    {.dim = 2, .method = "adaptive"},
    {.dim = 2, .method = "adaptive", .model = "ospd", .irregularity = 0.5},
    {.dim = 2, .method = "adaptive", .coupling = "pgg"},
    {.dim = 2, .method = "adaptive", .transfer = "apic", .coupling = "handshake"},
    {.dim = 2, .method = "mpm", .frame = "reference"},
    {.dim = 2, .method = "adaptive", .frame = "reference"},
    {.dim = 2, .method = "adaptive", .frame = "reference", .region = ISLANDS},
    {.dim = 2, .method = "adaptive", .frame = "reference", .coupling = "handshake", .region = ISLANDS},
};

/* Not more than 0.95 of what grows, and no less than 0.6 of it. */
static void test_bounds(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(bounds); k++) {
        struct stability_limits l;
        const bool linear = bounds[k].shape && !strcmp(bounds[k].shape, "linear");
        assert_ok(stability_observe(&bounds[k], linear ? 1500 : 250, 0, &l));
        const double share = l.automatic / l.observed;
        if (!(share >= STABILITY_LEAST && share <= STABILITY_MOST)) print_message("case %zu: %.3f of the limit\n", k, share);
        assert_true(share >= STABILITY_LEAST && share <= STABILITY_MOST);
    }
}

/* Strains of velocities that are not mapped again, with linear shapes, have no limit above 0: refused. */
static void test_no_limit(void **state)
{
    (void)state;
    struct stability_limits l;
    assert_int_equal(stability_observe(&(struct stability_case){.dim = 1, .method = "mpm", .shape = "linear", .transfer = "apic"},
                                       10, 0, &l), REFUSED);
    assert_non_null(strstr(status_message(), "strains from velocities that are not mapped again"));
}

/* Points drift through their cells: each place has another limit, and the automatic step holds in all of them. */
static void test_drift(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(bounds); k++) {
        bool stays;
        if (bounds[k].group != GROUP_POINTS) continue;
        assert_ok(stability_stays(&bounds[k], 0, (struct stability_shake){1e-5, 2e-3, 1500}, &stays));
        assert_true(stays);
    }
}

/* ---- beyond the limit ------------------------------------------------------------------------------------------- */

/* 1.2 times the limit: stopped within 1000 steps, with place, step and cure. */
static void test_caught(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(bounds); k += 2) {
        struct stability_limits l;
        struct bench_overrides o = {0};
        struct engine e;
        struct scene s;
        char text[4096];
        assert_ok(stability_observe(&bounds[k], 250, 0, &l));
        stability_text(&bounds[k], text, sizeof text);
        bench_override(&o, "time.step", "%.17g", 1.2 * l.observed);
        bench_override(&o, "duration", "%.17g", 1000 * 1.2 * l.observed);
        bench_override(&o, "initial", "[{pulse: {at: [3e-3%s], direction: [1%s], width: 5e-3, velocity: 1}}]",
                       bounds[k].dim == 1 ? "" : bounds[k].dim == 2 ? ", 3e-3" : ", 3e-3, 3e-3",
                       bounds[k].dim == 1 ? "" : bounds[k].dim == 2 ? ", 0.2" : ", 0.2, 0.1");
        bench_override(&o, "output.samples", "100");
        assert_ok(bench_engine_make(&e, &s, "block", text, bench_overrides_ready(&o), o.n));
        const status ran = engine_run(&e);
        if (ran != FAILED) print_message("case %zu is not caught\n", k);
        assert_int_equal(ran, FAILED);
        const char *said = status_message();
        if (!strstr(said, "choose a smaller time.step (now dt = ")) print_message("case %zu: %s\n", k, said);
        assert_non_null(strstr(said, "unstable at step "));
        assert_non_null(strstr(said, ": particle "));
        assert_non_null(strstr(said, "choose a smaller time.step (now dt = "));
        assert_non_null(strstr(said, " of the critical "));
        bench_engine_free(&e, &s);
    }
}

/* ---- twins ---------------------------------------------------------------------------------------------------------- */

/* x' = scale (x, y), in the other order if `turned`, x against its axis if `mirrored`. */
struct twin { double scale; bool mirrored, turned; };

static void put_vector(FILE *to, const struct twin *t, double scale, double x, double y)
{
    if (t->mirrored) x = -x;
    fprintf(to, "[%.17g, %.17g]", scale * (t->turned ? y : x), scale * (t->turned ? x : y));
}

static void put_box(FILE *to, const struct twin *t, double x0, double y0, double x1, double y1)
{
    const double mm = 1e-3 * t->scale;
    fputs("{box: {from: ", to);
    put_vector(to, t, mm, t->mirrored ? x1 : x0, y0);
    fputs(", to: ", to);
    put_vector(to, t, mm, t->mirrored ? x0 : x1, y1);
    fputs("}}", to);
}

/* A notched plate with a hole, no symmetry left, pulled at two faces while a pulse runs through it. */
static void put_plate(FILE *to, const struct twin *t, const char *method)
{
    const double mm = 1e-3 * t->scale;
    fprintf(to, "name: plate\nspace: plane stress\nthickness: %.17g\nduration: %.17g\ntime: {step: %.17g}\nmethod: %s\n", mm,
            2e-5 * t->scale, 1e-7 * t->scale, method);
    fprintf(to, "material: {young: 72e9, density: 2440, energy_release_rate: %.17g}\nparticles: {spacing: %.17g}\nbody:\n  - ",
            2000 * t->scale, mm);
    put_box(to, t, -18, -12, 20, 14);
    fputs("\n  - subtract: {disc: {centre: ", to);
    put_vector(to, t, mm, 9, 5);
    fprintf(to, ", radius: %.17g}}\ncracks:\n  - {from: ", 3.3 * mm);
    put_vector(to, t, mm, -18, 1);
    fputs(", to: ", to);
    put_vector(to, t, mm, -4, 1);
    fputs("}\nboundary:\n", to);
    for (int side = -1; side <= 1; side += 2) {
        fputs("  - {traction: ", to);
        put_vector(to, t, 1, 0, side * 4e6);
        fprintf(to, ", face: %c%c}\n", t->turned ? 'x' : 'y', side > 0 ? '+' : '-');
    }
    fputs("initial:\n  - {pulse: {at: ", to);
    put_vector(to, t, mm, 4, -3);
    fputs(", direction: ", to);
    put_vector(to, t, 1, 1, 0.4);
    fprintf(to, ", width: %.17g, velocity: 3}}\noutput: {frames: 0, samples: 1}\n", 12 * mm);
    fputs("mpm: {origin: ", to);
    put_vector(to, t, mm, 0, 0);
    fputs("}\n", to);
    if (strcmp(method, "adaptive")) return;
    fputs("pd: {region: ", to);
    put_box(to, t, -10, -5, 4, 7);
    fputs("}\nconversion: {criteria: none}\n", to);
}

static void plate_run(struct engine *e, struct scene *s, const struct twin *t, const char *method)
{
    char text[4096];
    FILE *to = fmemopen(text, sizeof text, "w");
    put_plate(to, t, method);
    fclose(to);
    assert_ok(bench_engine_make(e, s, "plate", text, NULL, 0));
    assert_ok(engine_run(e));
    assert_true(e->watch.bonds_broken == 0);
}

/* The particle of the twin where particle i of the plate would be. */
static int64_t twin_of(const struct particles *p, int64_t i, const struct particles *q, const struct twin *t)
{
    const double x = t->scale * (t->mirrored ? -p->X[0][i] : p->X[0][i]), y = t->scale * p->X[1][i];
    for (int64_t k = 0; k < q->n; k++)
        if (fabs(q->X[t->turned][k] - x) + fabs(q->X[!t->turned][k] - y) < 1e-6 * t->scale) return k;
    fail_msg("no twin of particle %d", (int)i);
    return -1;
}

/* Velocities and displacements over lengths, of the largest: sums in another order and lengths that are no binary fractions, over
 * 200 steps. */
#define SAME 1e-10

static void compare(const struct engine *a, const struct engine *b, const struct twin *t)
{
    double speed = 0, shift = 0, most_speed = 0, most_shift = 0;
    assert_int_equal(a->part.n, b->part.n);
    for (int64_t i = 0; i < a->part.n; i++) {
        const int64_t k = twin_of(&a->part, i, &b->part, t);
        for (int d = 0; d < 2; d++) {
            const double sign = d == 0 && t->mirrored ? -1 : 1;
            const int axis = t->turned ? !d : d;
            const double v = a->part.v[d][i], u = a->part.x[d][i] - a->part.X[d][i];
            speed = fmax(speed, fabs(sign * b->part.v[axis][k] - v));
            shift = fmax(shift, fabs(sign * (b->part.x[axis][k] - b->part.X[axis][k]) / t->scale - u));
            most_speed = fmax(most_speed, fabs(v)), most_shift = fmax(most_shift, fabs(u));
        }
    }
    if (!(speed <= SAME * most_speed && shift <= SAME * most_shift))
        print_message("scale %g, mirrored %d, turned %d: %.2e, %.2e\n", t->scale, t->mirrored, t->turned, speed / most_speed,
                      shift / most_shift);
    assert_true(most_speed > 1 && most_shift > 1e-6);
    assert_true(speed <= SAME * most_speed && shift <= SAME * most_shift);
}

static void test_twins(void **state)
{
    (void)state;
    static const char *const method[] = {"pd", "mpm", "adaptive"};
    static const struct twin twin[] = {{1000, false, false}, {1, true, false}, {1, false, true}, {1e-6, true, true}};
    for (size_t m = 0; m < COUNT_OF(method); m++) {
        struct engine one, other;
        struct scene s, other_s;
        plate_run(&one, &s, &(struct twin){1, false, false}, method[m]);
        for (size_t k = 0; k < COUNT_OF(twin); k++) {
            plate_run(&other, &other_s, &twin[k], method[m]);
            compare(&one, &other, &twin[k]);
            bench_engine_free(&other, &other_s);
        }
        bench_engine_free(&one, &s);
    }
}

/* ---- edges ------------------------------------------------------------------------------------------------------------ */

static double automatic_of(const char *text, const char *key, const char *value)
{
    struct engine e;
    struct scene s;
    struct bench_overrides o = {0};
    if (key) bench_override(&o, key, "%s", value);
    assert_ok(bench_engine_make(&e, &s, "block", text, bench_overrides_ready(&o), o.n));
    const double critical = e.dt_critical;
    bench_engine_free(&e, &s);
    return critical;
}

/* The step goes with the length over any scale; a body without bonds has one, too; so has one whose bonds are all cut. */
static void test_scales(void **state)
{
    (void)state;
    static const char *const method[] = {"pd", "mpm", "adaptive"};
    static const double scale[] = {1e-9, 1e-3, 1e6};
    for (size_t m = 0; m < COUNT_OF(method); m++) {
        double share[COUNT_OF(scale)];
        for (size_t k = 0; k < COUNT_OF(scale); k++) {
            char text[1024];
            const double D = scale[k];
            snprintf(text, sizeof text, "space: plane stress\nthickness: %.9g\nduration: %.9g\nmethod: %s\nmaterial: {young: 72e9, "
                     "density: 2440}\nbody: {box: {from: [0, 0], to: [%.9g, %.9g]}}\nparticles: {spacing: %.9g}\n", D, D,
                     method[m], 12 * D, 8 * D, D);
            share[k] = automatic_of(text, NULL, NULL) / D;
            assert_close(share[k], share[0], 1e-7);     /* strains of the trial motion */
        }
    }
    const char *const one = "space: plane stress\nthickness: 1e-3\nduration: 1e-5\nmaterial: {young: 72e9, density: 2440}\n"
                            "body: {box: {from: [0, 0], to: [1e-3, 1e-3]}}\nparticles: {spacing: 1e-3}\n";
    for (size_t m = 0; m < COUNT_OF(method); m++) {
        const double critical = automatic_of(one, "method", method[m]), wave = 1e-3 / sqrt(72e9 / (8.0 / 9) / 2440);
        assert_true(critical > 0.2 * wave && critical < 4 * wave);
    }
}

/* Rows between mirrors, where images go against their sources; a thin plate; a stiff light material in a soft
 * heavy one: all modes are seen. */
static void test_odd_bodies(void **state)
{
    (void)state;
    static const char *const text[] = {
        "space: plane stress\nthickness: 1e-3\nduration: 1\nmethod: pd\nmaterial: {young: 72e9, density: 2440}\n"
        "body: {box: {from: [0, 0], to: [24e-3, 3e-3]}}\nparticles: {spacing: 1e-3}\noutput: {frames: 0, samples: 1}\n"
        "boundary:\n  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 3e-3}}\n",
        "space: solid\nduration: 1\nmethod: pd\nmaterial: {young: 72e9, density: 2440}\nbody: {box: {from: [0, 0, 0], to: [9e-3, "
        "9e-3, 1e-3]}}\nparticles: {spacing: 1e-3, horizon: 2.015}\noutput: {frames: 0, samples: 1}\n",
        "space: plane stress\nthickness: 1e-3\nduration: 1\nmethod: pd\nmaterials:\n  - {name: soft, young: 7e9, density: 9000}\n"
        "  - {name: stiff, young: 400e9, density: 2000}\nbodies:\n  - {material: soft, shape: {box: {from: [0, 0], to: [15e-3, "
        "15e-3]}}}\n  - {material: stiff, shape: {box: {from: [15e-3, 7e-3], to: [16e-3, 8e-3]}}}\nparticles: {spacing: 1e-3}\n"
        "output: {frames: 0, samples: 1}\n"};
    for (size_t k = 0; k < COUNT_OF(text); k++) {
        struct stability_limits l;
        assert_ok(stability_observe(&(struct stability_case){.method = "pd", .text = text[k]}, 400, 0, &l));
        const double share = l.automatic / l.observed;
        if (!(share >= STABILITY_LEAST && share <= STABILITY_MOST)) print_message("body %zu: %.3f of the limit\n", k, share);
        assert_true(share >= STABILITY_LEAST && share <= STABILITY_MOST);
    }
}

/* A row between mirrors that are closer than its bonds reach grew at a third of the predicted step: it is refused. */
static void test_close_mirrors(void **state)
{
    (void)state;
    struct stability_limits l;
    const char *const row = "space: plane stress\nthickness: 1e-3\nduration: 1\nmethod: pd\nmaterial: {young: 72e9, density: 2440}\n"
                            "body: {box: {from: [0, 0], to: [24e-3, 1e-3]}}\nparticles: {spacing: 1e-3}\n"
                            "boundary:\n  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 1e-3}}\n";
    assert_int_equal(stability_observe(&(struct stability_case){.method = "pd", .text = row}, 10, 0, &l), REFUSED);
    assert_non_null(strstr(status_message(), "want them farther apart than 0.002"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bounds), cmocka_unit_test(test_no_limit), cmocka_unit_test(test_drift), cmocka_unit_test(test_caught),
        cmocka_unit_test(test_twins), cmocka_unit_test(test_scales), cmocka_unit_test(test_odd_bodies),
        cmocka_unit_test(test_close_mirrors)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
