/* `method: auto`: the choice from a table written by hand, whose cheapest point is known in closed form;
 * what scenes are like; the spacing that fits; and that the scene as run says the same without auto. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "auto/scene_read.h"
#include "src/auto/auto.h"

/* ---- a table whose lines are powers ---------------------------------------------------------------------------------
 *
 * first   error 1/N, 1e-6 N^2 s;  second   error 10/N^2, 4e-6 N^2 s:  with errors met exactly 1e-6/e^2 and 4e-5/e s, so
 *            that
 * the second is cheaper below e = 1/40 */

enum { POWERS = 6 };
static const int resolutions[POWERS] = {10, 20, 40, 80, 160, 320};

static void put_line(FILE *to, const char *at, const char *method, double factor, double order, double cost,
                     const char *keys)
{
    for (int k = 0; k < POWERS; k++) {
        const double N = resolutions[k];
        const double error = factor * pow(N, -order);
        fprintf(to, "bar,%s,%s,%g,3.015,0.8,%.17g,%.17g,%g,%g,%s\n", at, method, N, error, cost * N * N, N, N, keys);
    }
}

static const struct auto_kind smooth = {"bar", "pulse", "a pulse", "its width", 1, 1, 0, true, 0, 0, 0};
static const struct auto_kind rough = {"bar", "pulse", "a pulse", "its width", 1, 1, 0, false, 0, 0, 0};
static const struct auto_kind cases = {"bar", NULL, "a pulse", "its width", 1, 1, 0, true, 0, 0, 0};

static bool all(const struct cost_point *p, const void *context)
{
    (void)p, (void)context;
    return true;
}
static bool not_second(const struct cost_point *p, const void *context)
{
    (void)context;
    return strcmp(p->method, "second") != 0;
}

static char text[16384];
static struct cost_accuracy two_lines(void)
{
    struct cost_accuracy c;
    FILE *to = fmemopen(text, sizeof text, "w");
    fputs(TABLE_HEADER "\n", to);
    put_line(to, "pulse", "first", 1, 1, 1e-6, "method=pd");
    put_line(to, "pulse", "second", 10, 2, 4e-6, "method=mpm;mpm.frame=reference");
    fclose(to);
    assert_int_equal(cost_accuracy_read_text(&c, text, "text"), OK);
    assert_int_equal(c.n, 2 * POWERS);
    return c;
}

static struct auto_found picked(const struct cost_accuracy *c, const struct auto_kind *kind, double accuracy,
                                double resolution, bool (*allows)(const struct cost_point *, const void *))
{
    const struct auto_match m = {.kind = kind, .cases = 1, .at = {"pulse"}, .feature = 1, .growth = 1};
    const struct auto_wish w = {.match = &m, .accuracy = accuracy, .resolution = resolution, .allows = allows};
    struct auto_found f;
    auto_pick(&f, c, &w);
    return f;
}

/* The lines are powers, so the resolution between two runs is that of the closed form, for nine tenths of the
 * required accuracy. */
static void cheapest_of_two_powers(void **state)
{
    (void)state;
    struct cost_accuracy c = two_lines();
    const double coarse = 0.04, fine = 0.004;
    struct auto_found f = picked(&c, &smooth, coarse, 0, all);
    assert_string_equal(f.best.of->method, "first");
    assert_true(fabs(f.best.resolution / (1 / (0.9 * coarse)) - 1) < 1e-12);
    assert_true(fabs(f.best.seconds / (1e-6 / pow(0.9 * coarse, 2)) - 1) < 1e-12);
    assert_true(fabs(f.best.error / coarse - 1) < 1e-12);
    assert_string_equal(f.second.of->method, "second");
    assert_true(fabs(f.second.seconds / (4e-5 / (0.9 * coarse)) - 1) < 1e-12);
    f = picked(&c, &smooth, fine, 0, all);
    assert_string_equal(f.best.of->method, "second");
    assert_true(fabs(f.best.resolution / sqrt(10 / (0.9 * fine)) - 1) < 1e-12);
    assert_true(fabs(f.best.seconds / (4e-5 / (0.9 * fine)) - 1) < 1e-12);
    cost_accuracy_free(&c);
}

/* Where nothing says that errors are powers, a run of the table; a run that is good enough as it is needs no margin. */
static void runs_where_it_is_not_smooth(void **state)
{
    (void)state;
    struct cost_accuracy c = two_lines();
    assert_true(picked(&c, &rough, 0.09, 0, all).best.resolution == 20);     /* first: 1/20 */
    assert_true(picked(&c, &rough, 0.003, 0, all).best.resolution == 80);  /* second: 10/80^2; first is never so good */
    /* the coarsest: nothing coarser is known */
    assert_true(picked(&c, &smooth, 0.1, 0, not_second).best.resolution == 10);
    cost_accuracy_free(&c);
}

static void what_is_not_reached_is_said(void **state)
{
    (void)state;
    struct cost_accuracy c = two_lines();
    struct auto_found f = picked(&c, &smooth, 1e-5, 0, all);
    assert_null(f.best.of);
    assert_string_equal(f.finest.of->method, "second");
    assert_true(fabs(f.finest.error / (10.0 / (320 * 320)) - 1) < 1e-12);
    f = picked(&c, &smooth, 1e-3, 0, not_second);
    assert_null(f.best.of);
    assert_true(fabs(f.finest.error * 320 - 1) < 1e-12);
    cost_accuracy_free(&c);
}

/* At the user's spacing: between runs with the margin, beyond the finest no better than it, below the coarsest
 * nothing. */
static void at_a_given_resolution(void **state)
{
    (void)state;
    struct cost_accuracy c = two_lines();
    struct auto_found f = picked(&c, &smooth, 0.02, 30, all);
    assert_string_equal(f.best.of->method, "second");
    assert_true(fabs(f.best.error / (10 / (0.9 * 30 * 30)) - 1) < 1e-12);
    assert_null(picked(&c, &smooth, 0.01, 30, all).best.of);
    f = picked(&c, &smooth, 0.5, 640, all);
    assert_string_equal(f.best.of->method, "first");
    assert_true(fabs(f.best.error * 320 - 1) < 1e-12);
    assert_true(fabs(f.best.seconds / (1e-6 * 640 * 640) - 1) < 1e-12);
    assert_null(picked(&c, &smooth, 0.5, 5, all).best.of);
    f = picked(&c, &rough, 0.04, 30, all);
    assert_true(fabs(f.best.error / 0.025 - 1) < 1e-12);
    cost_accuracy_free(&c);
}

/* A coarse run that is better than finer ones of its method is luck, and not taken. */
static void dips_are_not_believed(void **state)
{
    (void)state;
    struct cost_accuracy c = two_lines();
    c.point[2].error = 1e-4;                             /* first at 40 */
    const struct auto_found f = picked(&c, &smooth, 1e-3, 0, all);
    assert_string_equal(f.best.of->method, "second");
    /* as good as the next, 1/80, and no better */
    assert_true(picked(&c, &rough, 0.013, 0, not_second).best.resolution == 40);
    cost_accuracy_free(&c);
}

/* A run that no finer one of its method bears out, and errors below what the reference itself is known to. */
static void what_is_alone_or_unknown(void **state)
{
    (void)state;
    static const struct auto_kind vague = {"bar", "pulse", "a pulse", "its width", 1, 1, 0, false, 0, 0.05, 0};
    struct cost_accuracy c = two_lines();
    strcpy(c.point[0].method, "alone");
    c.point[0].error = 1e-9, c.point[0].seconds = 1e-9;
    assert_string_equal(picked(&c, &smooth, 0.1, 0, all).best.of->method, "alone");
    assert_string_not_equal(picked(&c, &rough, 0.1, 0, all).best.of->method, "alone");
    assert_null(picked(&c, &vague, 0.049, 0, all).best.of);
    assert_true(picked(&c, &vague, 0.05, 0, all).best.resolution == 20);
    assert_true(picked(&c, &vague, 0.05, 0, all).best.error == 0.05);
    cost_accuracy_free(&c);
}

static void worst_of_the_cases(void **state)
{
    (void)state;
    struct cost_accuracy c;
    FILE *to = fmemopen(text, sizeof text, "w");
    fputs(TABLE_HEADER "\n", to);
    put_line(to, "a", "first", 1, 1, 1e-6, "method=pd");
    put_line(to, "b", "first", 3, 1, 2e-6, "method=pd");
    put_line(to, "a", "alone", 0.01, 1, 1e-6, "method=pd");      /* not known in b */
    fclose(to);
    assert_int_equal(cost_accuracy_read_text(&c, text, "text"), OK);
    const struct auto_match m = {.kind = &cases, .cases = 2, .at = {"a", "b"}, .feature = 1, .growth = 1};
    const struct auto_wish w = {.match = &m, .accuracy = 0.03, .allows = all};
    struct auto_found f;
    auto_pick(&f, &c, &w);
    assert_string_equal(f.best.of->method, "first");
    assert_true(fabs(f.best.resolution / (3 / (0.9 * 0.03)) - 1) < 1e-12);
    assert_true(fabs(f.best.seconds / (2e-6 * pow(3 / (0.9 * 0.03), 2)) - 1) < 1e-12);
    assert_null(f.second.of);
    cost_accuracy_free(&c);
}

static void charts_that_are_none(void **state)
{
    (void)state;
    struct cost_accuracy c;
    const char *const bad[] = {"",
                               "a,b\n",
                               TABLE_HEADER "\nbar,pulse,pd,x,3,0.8,0.1,1,1,1,method=pd\n",
                               TABLE_HEADER "\nbar,pulse,pd,1\n",
                               TABLE_HEADER "\nbar,pulse,pd,1,3,0.8,-0.1,1,1,1,method=pd\n",
                               TABLE_HEADER "\nbar,pulse,pd,1,3,0.8,0.1,1,1,1,\n"};
    for (size_t k = 0; k < COUNT_OF(bad); k++) assert_int_equal(cost_accuracy_read_text(&c, bad[k], "bad"), REFUSED);
    assert_int_equal(cost_accuracy_read(&c, NULL), OK);          /* the program's own */
    assert_true(c.n > 100);
    cost_accuracy_free(&c);
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

#define BAR                                                                                                            \
    "space: line\nduration: 4 ms\nmaterial: {young: 1e4, density: 1, critical_stretch: inf}\n"                         \
    "body: {box: {from: [0], to: [1.6]}}\n"
#define PLATE                                                                                                          \
    "space: plane stress\nthickness: 1\nmaterial: {young: 80000/9, density: 1}\n"                                      \
    "body: {box: {from: [-0.5, -0.5], to: [0.5, 0.5]}}\n"
#define PULSE(direction, polarisation)                                                                                 \
    "duration: 2 ms\ninitial: [{pulse: {at: [0, 0], direction: " direction ", polarisation: " polarisation             \
    ", width: 0.1, velocity: 1e-4}}]\n"
#define PULLED "boundary: [{traction: [0, 1e-3], face: y+}]\n"
#define AUTO "method: auto\n"

static status read_text(struct scene *s, const char *from)
{
    return scene_read_text(s, from, strlen(from), "mine", NULL, 0);
}

/* Feature [m], its spacings over the resolution, and how much farther waves go than in the table. */
static void scenes_are_like(void **state)
{
    (void)state;
    static const struct { const char *text, *problem, *at[2]; double feature, growth; bool at_rest;
    } like[] = {
        {BAR "initial: [{pulse: {at: [0.6], direction: [1], width: 0.1, velocity: 1e-5}}]\n",
         "bar",
         {"pulse"},
         0.1,
         4,
         false},
        {BAR "boundary: [{mirror: {axis: x, at: 0}}, {traction: [1], face: x+}]\n", "bar", {"step"}, 1.6, 1, false},
        {PLATE PULSE("[1, 0]", "[1, 0]"), "wave", {"P 0 deg"}, 0.1, 2, false},
        {PLATE PULSE("[0, -1]", "[1, 0]"), "wave", {"S 0 deg"}, 0.1, 2, false},
        {PLATE PULSE("[1, 1]", "[1, 1]"), "wave", {"P 45 deg"}, 0.1, 2, false},
        {PLATE PULSE("[2, 1]", "[2, 1]"), "wave", {"P 22.5 deg", "P 45 deg"}, 0.1, 2, false},  /* 26.6 degrees */
        {PLATE PULSE("[8, -1]", "[8, -1]"), "wave", {"P 0 deg", "P 22.5 deg"}, 0.1, 2, false}, /* -7.1 */
        {PLATE "duration: 1\ncracks: [{from: [-1, 0], to: [-0.2, 0]}]\n" PULLED,
         "cracks",
         {"edge crack"},
         0.3,
         1,
         true},
        {PLATE "duration: 1\ncracks: [{from: [-0.2, -0.1], to: [0.2, 0.2]}]\n" PULLED,
         "cracks",
         {"inclined crack"},
         0.25,
         1,
         true},
        {PLATE "duration: 1 ms\ncracks: [{from: [-1, 0], to: [-0.2, 0]}]\n" PULLED,
         "sudden",
         {"at rest"},
         0.5,
         1,
         false},
        {"space: plane stress\nthickness: 1\nduration: 1\nmaterial: {young: 1, density: 1}\nbody: [{box: "
         "{from: [0, 0], to: [4, 4]}}, {subtract: {disc: {centre: [2, 2], radius: 0.3}}}]\n",
         "hole",
         {"pulled"},
         0.3,
         1,
         true},
        {"space: line\nduration: 1 ms\nmaterial: {young: 1e4, density: 1, critical_stretch: 1e-4}\nbody: "
         "{box: {from: [0], to: [1]}}\n"
         "initial: [{velocity: [-1e-3], region: {box: {from: [0.9], to: [1]}}}]\n",
         "spall",
         {"spall"},
         0.2,
         1,
         false},
        /* waves go 4 times as far as in the table: errors of a front grow with the root of it */
        {"space: line\nduration: 48 ms\nmaterial: {young: 1e4, density: 1, critical_stretch: inf}\n"
         "body: {box: {from: [0], to: [1.6]}}\nboundary: [{traction: [3], face: x+}]\n",
         "bar",
         {"step"},
         1.6,
         2,
         false},
    };
    for (size_t k = 0; k < COUNT_OF(like); k++) {
        struct scene s;
        struct auto_match m;
        char full[2048];
        snprintf(full, sizeof full, "%sparticles: {spacing: 0.02}\n", like[k].text);
        assert_int_equal(read_text(&s, full), OK);
        assert_int_equal(auto_match_find(&m, &s, like[k].at_rest), OK);
        assert_string_equal(m.kind->problem, like[k].problem);
        assert_int_equal(m.cases, like[k].at[1] ? 2 : 1);
        for (int c = 0; c < m.cases; c++) assert_string_equal(m.at[c], like[k].at[c]);
        assert_true(fabs(m.feature / like[k].feature - 1) < 1e-9);
        assert_true(fabs(m.growth / like[k].growth - 1) < 1e-2);
        const struct wave_pulse *w = s.initials == 1 && s.initial[0].sets_pulse ? &s.initial[0].pulse : NULL;
        const real speed = w && w->transverse ? s.material[0].shear_speed : s.material[0].wave_speed;
        if (w) assert_true(fabs(m.strain * speed / w->velocity - 1) < 1e-9);
        scene_free(&s);
    }
}

/* What the table has nothing like is no problem of it. */
static void scenes_that_are_like_nothing(void **state)
{
    (void)state;
    static const char *const odd[] = {
        PLATE "duration: 2 ms\ninitial: [{pulse: {at: [0, 0], direction: [1, 0], width: 0.1, velocity: 1e-4}}, "
              "{pulse: {at: [0, 0], direction: [0, 1], width: 0.2, velocity: 1e-4}}]\n",
        PLATE PULSE("[1, 0]", "[1, 0]") PULLED,
        PLATE "duration: 1 ms\n",
        PLATE "duration: 1 ms\n" PULLED,
        BAR "boundary: [{traction: [1], face: x+, time: {ramp: {until: 1 ms}}}]\n",
    };
    for (size_t k = 0; k < COUNT_OF(odd); k++) {
        struct scene s;
        struct auto_match m;
        char full[2048];
        snprintf(full, sizeof full, "%sparticles: {spacing: 0.02}\n", odd[k]);
        assert_int_equal(read_text(&s, full), OK);
        assert_int_equal(auto_match_find(&m, &s, false), REFUSED);
        assert_non_null(strstr(status_message(), "no problem like this one"));
        scene_free(&s);
    }
}

/* A crack's ends, gaps and edges lie between particles; cells of two spacings end with the body. */
static void spacing_fits(void **state)
{
    (void)state;
    static const char plate[] = "space: plane stress\nthickness: 1\nduration: 1\nmaterial: {young: 1, density: "
     "1}\nparticles: {spacing: 1}\n"
                                "body: {box: {from: [0, 0], to: [60, 40]}}\ncracks: [{from: [-1, 20], to: [30, 20]}]\n";
    struct scene s;
    assert_int_equal(read_text(&s, plate), OK);
    assert_true(fabs(auto_spacing_fit(&s, 1, false) - 1) < 1e-12);
    /* 60, 40, 30 and 20: a whole part of 10 */
    assert_true(fabs(auto_spacing_fit(&s, 0.99, false) - 10.0 / 11) < 1e-12);
    assert_true(fabs(auto_spacing_fit(&s, 3.4, true) - 10.0 / 3) < 1e-12);      /* 60 and 40 over 20/3: 9 and 6 pairs */
    assert_true(fabs(auto_spacing_fit(&s, 1e-3, true) - 1e-3) < 1e-12);
    scene_free(&s);
}

/* The scene as run, read again, is the same scene, and auto is not in it. */
static void echo_says_it_without_auto(void **state)
{
    (void)state;
    static const char *const from[] = {
        AUTO "accuracy: 2 %\n" BAR "initial: [{pulse: {at: [0.6], direction: [1], width: 0.4, velocity: 1e-5}}]\n",
        AUTO PLATE PULSE("[1, 0]", "[1, 0]") "accuracy: 0.04\n",
        AUTO "solver: static\naccuracy: 5 %\n" PLATE "duration: 1\ncracks: [{from: [-1, 0], to: [0, 0]}]\nboundary: "
         "[{traction: [0, 1e-3], face: y+}, "
             "{traction: [0, -1e-3], face: y-}]\n"};
    for (size_t k = 0; k < COUNT_OF(from); k++) {
        struct scene s, again;
        const status first = read_text(&s, from[k]);
        if (first != OK) print_message("%s\n", status_message());
        assert_int_equal(first, OK);
        assert_true(s.choice.made && s.method != METHOD_AUTO && s.solver != SOLVER_STATIC);
        assert_null(strstr(s.text, "method: auto"));
        assert_null(strstr(s.text, "accuracy"));
        assert_int_equal(read_text(&again, s.text), OK);
        assert_false(again.choice.made);
        /* but for the name, which is that of the text */
        assert_string_equal(s.text, again.text);
        scene_free(&again);
        scene_free(&s);
    }
}

/* Without a static solver, what is at rest is loaded slowly: over 30 transits of a plate with a hole, 1 m at 100 m/s,
 * by half a pulse. */
static void what_rests_is_loaded_slowly(void **state)
{
    (void)state;
    static const char from[] = AUTO "solver: static\naccuracy: 5 %\nspace: plane stress\nthickness: 1\nduration: 1\n"
        "material: {young: 80000/9, density: 1}\n"
        "body: [{box: {from: [-0.5, -0.2], to: [0.5, 0.2]}}, {subtract: {disc: {centre: [0, 0], radius: 0.05}}}]\n"
        "boundary: [{traction: [3e-3, 0], face: x+}, {traction: [-3e-3, 0], face: x-}]\n";
    struct scene s;
    const status read = read_text(&s, from);
    if (read != OK) fail_msg("%s", status_message());
    assert_true(s.solver == SOLVER_EXPLICIT && fabs(s.duration / 0.3 - 1) < 1e-9);
    for (int k = 0; k < 2; k++) {
        const struct time_function *time = &s.boundary[k].time;
        assert_true(time->kind == TIME_PULSE && time->from == 0 && fabs(time->until / 0.6 - 1) < 1e-9);
    }
    scene_free(&s);
}

/* A suddenly loaded crack is cheapest as a gap of one cell of points, from where it came in to its tip, and the
 * probe finds it; one that grows is none. */
static void crack_becomes_a_gap(void **state)
{
    (void)state;
    static const char from[] = AUTO PLATE "duration: 6 ms\ncracks: [{from: [-1, 0], to: [0, 0]}]\n"
                               "probes: [sif, {sif: {name: other, outer: 0.3}}]\n"
                               "boundary: [{traction: [0, 1e-3], face: y+}, {traction: [0, -1e-3], face: y-}]\n";
    struct scene s;
    assert_int_equal(read_text(&s, from), OK);
    assert_true(s.method == METHOD_MPM && s.frame == FRAME_REFERENCE);
    assert_int_equal(s.cracks, 0);
    assert_int_equal(s.body[0].shape.n, 2);
    const struct solid *gap = &s.body[0].shape.solid[1];
    assert_true(gap->subtract && gap->to[0] == 0 && gap->from[0] == -1);
    assert_true(gap->from[1] == -s.spacing && gap->to[1] == s.spacing && s.has_grid_origin &&
                s.grid_origin[1] == -s.spacing);
    for (int k = 0; k < 2; k++) {
        assert_true(s.probe[k].has_at && s.probe[k].at[0] == 0 && s.probe[k].at[1] == 0);
        assert_true(s.probe[k].direction[0] == 1 && s.probe[k].direction[1] == 0);
    }
    assert_true(s.probe[0].contours.n == 1 && fabs(s.probe[0].contours.value[0] - 0.4 * 0.5) < 1e-12);
    assert_true(s.probe[1].contours.n == 0 && s.probe[1].outer == 0.3);
    scene_free(&s);
    const struct scene_override grows = {"growth", "[{at: [0, 0], direction: [1, 0], speed: 10}]"};
    assert_int_equal(scene_read_text(&s, from, strlen(from), "mine", &grows, 1), OK);
    assert_true(s.cracks == 1 && s.method != METHOD_MPM);
    scene_free(&s);
}

/* What the user wrote wins, and rules the rest. */
static void what_is_written_stays(void **state)
{
    (void)state;
    static const char pulse[] = AUTO "accuracy: 5 %\n" BAR "initial: [{pulse: {at: [0.6], direction: [1], width: 0.4, "
     "velocity: 1e-5}}]\n";
    struct scene s;
    char full[2048];
    snprintf(full, sizeof full, "%smpm: {shape: cubic, transfer: apic, frame: current}\npd: {surface: volume}\n",
             pulse);
    assert_int_equal(read_text(&s, full), OK);
    assert_true(s.method == METHOD_MPM && s.shape == SHAPE_CUBIC && s.transfer == TRANSFER_APIC &&
                s.frame == FRAME_CURRENT);
    scene_free(&s);
    snprintf(full, sizeof full, "%sparticles: {horizon: 2.015}\nmpm: {frame: current, transfer: flip, shape: linear}\n",
             pulse);
    assert_int_equal(read_text(&s, full), OK);
    assert_true(s.method == METHOD_PD ? s.horizon == 2.015 : s.shape == SHAPE_LINEAR);
    scene_free(&s);
    snprintf(full, sizeof full, "%sparticles: {spacing: 2 mm}\n", pulse);
    assert_int_equal(read_text(&s, full), OK);
    assert_true(s.spacing == 2e-3);
    scene_free(&s);
}

/* The narrowest ring that a probe of factors takes has three spacings: from its inner radius, half of its own outer one
 * where none is given, to each outer one. */
static void rings_have_spacings(void **state)
{
    (void)state;
    double contour[] = {7e-3, 5.2e-3};
    struct probe_request probe[] = {{.kind = PROBE_SIF, .outer = 6e-3, .inner = 2.3e-3},
                                    {.kind = PROBE_SIF, .contours = {.n = 2, .value = contour}},
                                    {.kind = PROBE_LINE, .outer = 1e-3}};
    const struct scene one = {.probes = 1, .probe = probe}, all = {.probes = 3, .probe = probe};
    assert_true(fabs(auto_spacing_rings(&one) * 3 / 3.7e-3 - 1) < 1e-3);
    assert_true(fabs(auto_spacing_rings(&all) * 3 / 2.6e-3 - 1) < 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_have_spacings),
        cmocka_unit_test(cheapest_of_two_powers),
        cmocka_unit_test(runs_where_it_is_not_smooth),
        cmocka_unit_test(what_is_not_reached_is_said),
        cmocka_unit_test(at_a_given_resolution),
        cmocka_unit_test(dips_are_not_believed),
        cmocka_unit_test(worst_of_the_cases),
        cmocka_unit_test(what_is_alone_or_unknown),
        cmocka_unit_test(charts_that_are_none),
        cmocka_unit_test(scenes_are_like),
        cmocka_unit_test(scenes_that_are_like_nothing),
        cmocka_unit_test(spacing_fits),
        cmocka_unit_test(echo_says_it_without_auto),
        cmocka_unit_test(what_rests_is_loaded_slowly), cmocka_unit_test(crack_becomes_a_gap),
        cmocka_unit_test(what_is_written_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
