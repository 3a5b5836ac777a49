/* Tests of the cost-accuracy table: the Pareto front of a set of points, the fastest method for an error, the exact
 * solutions of the problems, and the lines of the measured table. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "bench/accuracy/accuracy.h"
#include "bench/common/manufactured.h"
#include "scene/fill.h"
#include "scene/scene_read.h"

/* Points (time, error) for the test of the Pareto front: a staircase with points above it, two equal points, one of an
 * unstable run (error NAN) and one without a time. */
static const struct accuracy_dot cloud[] = {{4, 0.001}, {1, 0.1},   {2, 0.02},        {2, 0.03},   {3, 0.02},
                                            {1, 0.1},   {0.5, NAN}, {INFINITY, 1e-5}, {8, 0.0015}, {0.7, 0.3}};
enum { DOTS = COUNT_OF(cloud) };

static void front_has_what_nothing_beats(void **state)
{
    (void)state;
    static const int expected[] = {9, 1, 2, 0};
    int front[DOTS];
    assert_int_equal(accuracy_find_pareto_front(cloud, DOTS, front), COUNT_OF(expected));
    for (size_t k = 0; k < COUNT_OF(expected); k++) assert_int_equal(front[k], expected[k]);
    assert_int_equal(accuracy_find_pareto_front(cloud, 0, front), 0);
    assert_int_equal(accuracy_find_pareto_front(&cloud[6], 2, front), 0);
}

/* Checks accuracy_find_pareto_front for random sets of points by the definition of the front: time grows and error
 * falls along it, and for every point of the set a point of the front is at most as large in time and error. */
static void front_of_random_clouds(void **state)
{
    (void)state;
    enum { N = 60 };
    struct accuracy_dot dot[N];
    int front[N];
    srand(7);
    for (int trial = 0; trial < 50; trial++) {
        for (int k = 0; k < N; k++) dot[k] = (struct accuracy_dot){rand() % 40, rand() % 40};
        const int n = accuracy_find_pareto_front(dot, N, front);
        for (int k = 1; k < n; k++) {
            assert_true(dot[front[k]].time > dot[front[k - 1]].time);
            assert_true(dot[front[k]].error < dot[front[k - 1]].error);
        }
        for (int k = 0; k < N; k++) {
            bool reached = false; /* by a point of the front */
            for (int j = 0; j < n; j++)
                reached |= dot[front[j]].time <= dot[k].time && dot[front[j]].error <= dot[k].error;
            assert_true(reached);
        }
    }
}

static void cheapest_is_the_first_good_enough(void **state)
{
    (void)state;
    assert_int_equal(accuracy_index_of_fastest_point(cloud, DOTS, 1), 9);
    assert_int_equal(accuracy_index_of_fastest_point(cloud, DOTS, 0.05), 2);
    assert_int_equal(accuracy_index_of_fastest_point(cloud, DOTS, 0.02), 2);
    assert_int_equal(accuracy_index_of_fastest_point(cloud, DOTS, 0.019), 0);
    assert_int_equal(accuracy_index_of_fastest_point(cloud, DOTS, 1e-4), -1);
}

/* ---- exact forms satisfy rho u_tt = c12 grad div u + G (lap u + grad div u) + f ---------------------------------- */

/* A motion in closed form, u = at(context, X, t), in an isotropic elastic medium, which is to satisfy the equation of
 * motion. */
struct motion {
    int dim;
    real c12, shear, density, length, time; /* length and time scales, for the steps of finite differences */
    void (*at)(const void *context, const real *X, real t, real *u);
    const void *context;
};

static real second_difference(const struct motion *m, const real *X, real t, int component, int a, int b)
{
    const real h = 1e-3 * m->length;
    real sum = 0;
    for (int corner = 0; corner < 4; corner++) {
        real Y[DIM_MAX], u[DIM_MAX];
        const int sa = corner & 1 ? -1 : 1, sb = corner & 2 ? -1 : 1;
        for (int d = 0; d < m->dim; d++) Y[d] = X[d];
        Y[a] += sa * h, Y[b] += sb * h;
        m->at(m->context, Y, t, u);
        sum += sa * sb * u[component];
    }
    return sum / (4 * h * h);
}

static real acceleration(const struct motion *m, const real *X, real t, int component)
{
    const real h = 1e-3 * m->time;
    real before[DIM_MAX], now[DIM_MAX], after[DIM_MAX];
    m->at(m->context, X, t - h, before), m->at(m->context, X, t, now), m->at(m->context, X, t + h, after);
    return (before[component] - 2 * now[component] + after[component]) / (h * h);
}

/* Asserts that m satisfies its equation of motion with the body force f[dim] at the position X and time t. The residual
 * may be 2e-5 of the largest term, which the error of the finite differences explains. */
static void assert_moves(const struct motion *m, const real *X, real t, const real *f)
{
    for (int a = 0; a < m->dim; a++) {
        const real inertia = m->density * acceleration(m, X, t, a);
        real elastic = 0, largest = fabs(inertia) + fabs(f[a]);
        for (int b = 0; b < m->dim; b++) {
            const real grow = (m->c12 + m->shear) * second_difference(m, X, t, b, a, b);
            const real bend = m->shear * second_difference(m, X, t, a, b, b);
            elastic += grow + bend, largest = fmax(largest, fabs(grow) + fabs(bend));
        }
        assert_true(fabs(inertia - elastic - f[a]) <= 2e-5 * largest);
    }
}

static void manufactured_motion(const void *context, const real *X, real t, real *u)
{
    const struct manufactured_values v = manufactured_at(context, X, t);
    for (int d = 0; d < ((const struct manufactured *)context)->dim; d++) u[d] = v.displacement[d];
}

/* Computes f[dim], the body force of the manufactured solution m at the position X [m] and the time t [s], from the
 * text that is written for scenes, which is read as a scene. */
static void force_of_scene(const struct manufactured *m, const real *X, real t, real *f)
{
    char text[4096];
    struct scene s;
    FILE *to = fmemopen(text, sizeof text, "w");
    fprintf(to,
            "space: %s\nduration: 1\nmethod: mpm\nmaterial: {young: 1, density: 1}\nparticles: {spacing: 0.5}\n"
            "body: {box: {from: %s, to: %s}}\nboundary:\n",
            m->dim == 2 ? "plane stress\nthickness: 1" : "solid", m->dim == 2 ? "[0, 0]" : "[0, 0, 0]",
            m->dim == 2 ? "[1, 1]" : "[1, 1, 1]");
    manufactured_write_body_force(to, m);
    fclose(to);
    assert_int_equal(scene_read_text(&s, text, strlen(text), "test", NULL, 0), OK);
    for (int a = 0; a < m->dim; a++) f[a] = 0;
    for (int k = 0; k < s.boundaries; k++) {
        const struct profile *q = &s.boundary[k].profile;
        const real along = dot(X, q->direction, m->dim) / sqrt(dot(q->direction, q->direction, m->dim));
        const real factor = sin(2 * M_PI * along / q->wavelength) * time_function_value(&s.boundary[k].time, t);
        for (int a = 0; a < m->dim; a++) f[a] += factor * s.boundary[k].value[a];
    }
    scene_free(&s);
}

static void manufactured_is_a_solution(void **state)
{
    (void)state;
    static const real place[][3] = {{0.13, 0.27, 0.41}, {0.62, 0.91, 0.33}, {0.05, 0.48, 0.77}};
    for (int dim = 2; dim <= 3; dim++) {
        const struct manufactured m = {dim, 1e-3, 2, 1.5, {1, -0.5, 0.75}, 3, 2, 1.7};
        const struct motion moving = {dim, m.c12, m.shear, m.density, m.length, m.period, manufactured_motion, &m};
        for (int k = 0; k < 3; k++)
            for (real t = 0.3; t < 2; t += 0.4) {
                const struct manufactured_values v = manufactured_at(&m, place[k], t);
                real f[DIM_MAX], u[2][DIM_MAX];
                force_of_scene(&m, place[k], t, f);
                assert_moves(&moving, place[k], t, f);
                for (int a = 0; a < dim; a++) assert_true(fabs(v.force[a] - f[a]) <= 1e-12 * m.amplitude * 1e3);
                const real h = 1e-4;
                manufactured_motion(&m, place[k], t - h, u[0]), manufactured_motion(&m, place[k], t + h, u[1]);
                for (int a = 0; a < dim; a++)
                    assert_true(fabs((u[1][a] - u[0][a]) / (2 * h) - v.velocity[a]) <= 1e-6 * m.amplitude);
                for (int s = 0; s < symmetric_tensor_component_count(dim); s++) {
                    int a, b;
                    real ends[4][DIM_MAX], slope = 0;
                    symmetric_tensor_component_axes(dim, s, &a, &b);
                    for (int end = 0; end < 4; end++) {
                        real Y[DIM_MAX] = {place[k][0], place[k][1], place[k][2]};
                        Y[end < 2 ? b : a] += end % 2 ? -h : h;
                        manufactured_motion(&m, Y, t, ends[end]);
                    }
                    slope = (ends[0][a] - ends[1][a] + ends[2][b] - ends[3][b]) / (4 * h);
                    assert_true(fabs(slope - v.strain[s]) <= 1e-5 * m.amplitude);
                }
            }
    }
}

struct wave {
    struct wave_pulse pulse;
    real speed;
    int dim;
};

static void wave_motion(const void *context, const real *X, real t, real *u)
{
    const struct wave *w = context;
    struct wave_pulse moved = w->pulse;
    for (int d = 0; d < w->dim; d++) moved.at[d] += w->speed * t * moved.direction[d];
    const struct wave_state s = wave_pulse_initial_state(&moved, X, w->speed, w->dim);
    for (int d = 0; d < w->dim; d++) u[d] = s.displacement * moved.polarisation[d];
}

/* Checks by finite differences that wave pulses as scenes define them, along and across their direction, solve the
 * equation of motion without body force. */
static void pulses_are_solutions(void **state)
{
    (void)state;
    static const char *const pulse[] = {"direction: [0.6, 0.8]", "direction: [3, 4], polarisation: [-3, -4]",
                                        "direction: [0.6, 0.8], polarisation: [8, -6]"};
    for (size_t k = 0; k < COUNT_OF(pulse); k++) {
        char text[1024];
        struct scene s;
        snprintf(text, sizeof text,
                 "space: plane stress\nthickness: 1\nduration: 1\nmethod: mpm\n"
                 "material: {young: 2, density: 1.3, poisson: 0.2}\nparticles: {spacing: 0.5}\n"
                 "body: {box: {from: [0, 0], to: [1, 1]}}\ninitial: [{pulse: {at: [0.1, 0.2], width: 0.8, velocity: "
                 "0.01, %s}}]\n",
                 pulse[k]);
        assert_int_equal(scene_read_text(&s, text, strlen(text), "test", NULL, 0), OK);
        const struct material *m = &s.material[0];
        const struct wave w = {s.initial[0].pulse, k == 2 ? m->shear_speed : m->wave_speed, 2};
        assert_true(w.pulse.transverse == (k == 2));
        const struct motion moving = {2, m->c12, m->shear, m->density, 0.2, 0.2 / w.speed, wave_motion, &w};
        const real X[DIM_MAX] = {0.21, 0.34}, none[DIM_MAX] = {0};
        for (real t = 0; t < 0.3; t += 0.07) assert_moves(&moving, X, t, none);
        scene_free(&s);
    }
}

/* Checks that initial stress, velocity and displacement of particles in a transverse wave pulse agree: the traction on
 * planes of the wave is -rho c v, with the shear wave speed c, to round-off. */
static void particles_start_in_a_transverse_wave(void **state)
{
    (void)state;
    static const char text[] = "space: plane stress\nthickness: 1\nduration: 1\nmethod: mpm\n"
                               "material: {young: 2, density: 1.3, poisson: 0.2}\nparticles: {spacing: 0.1}\n"
                               "body: {box: {from: [0, 0], to: [1, 1]}}\ninitial: [{pulse: {at: [0.5, 0.5], "
                               "direction: [0.6, 0.8], polarisation: [-0.8, 0.6], width: 0.8, velocity: 0.01}}]\n";
    struct scene s;
    struct particles p;
    assert_int_equal(scene_read_text(&s, text, strlen(text), "test", NULL, 0), OK);
    assert_int_equal(bodies_fill_with_particles(&p, &s, NULL, 0), OK);
    const struct wave_pulse *w = &s.initial[0].pulse;
    const real speed = sqrt(2 / (2 * 1.2) / 1.3), *n = w->direction;
    for (int64_t i = 0; i < p.n; i++) {
        const real X[2] = {p.X[0][i], p.X[1][i]};
        const struct wave_state wave = wave_pulse_initial_state(w, X, speed, 2);
        const real traction[2] = {p.stress[0][i] * n[0] + p.stress[2][i] * n[1],
                                  p.stress[2][i] * n[0] + p.stress[1][i] * n[1]};
        for (int d = 0; d < 2; d++) {
            assert_true(fabs(p.v[d][i] - wave.velocity * w->polarisation[d]) <= 1e-15);
            assert_true(fabs(p.x[d][i] - X[d] - wave.displacement * w->polarisation[d]) <= 1e-15);
            assert_true(fabs(traction[d] + 1.3 * speed * p.v[d][i]) <= 1e-14);
        }
    }
    particles_free(&p);
    scene_free(&s);
}

/* ---- the measured table ------------------------------------------------------------------------------------------ */

/* Returns the problem called `name`; NULL if there is none. */
static const struct accuracy_problem *problem_named(const char *name)
{
    for (int k = 0; k < accuracy_problems; k++)
        if (strcmp(accuracy_problem[k]->name, name) == 0) return accuracy_problem[k];
    return NULL;
}

static int case_named(const struct accuracy_problem *q, const char *name)
{
    for (int k = 0; k < accuracy_case_count(q); k++)
        if (strcmp(q->cases[k], name) == 0) return k;
    return -1;
}

static const struct accuracy_method *method_named(const char *name)
{
    for (int k = 0; k < accuracy_methods; k++)
        if (strcmp(accuracy_method[k].name, name) == 0) return &accuracy_method[k];
    return NULL;
}

enum { COLUMNS = 11, LINE_ROOM = 512 };
enum { PROBLEM, CASE, METHOD, RESOLUTION, HORIZON, STEP, KEYS = COLUMNS - 1 };

/* Returns true if `keys`, a text of the form key=value;key=value, contains the key `key` with the value `value`. */
static bool keys_have(const char *keys, const char *key, const char *value)
{
    char pair[LINE_ROOM];
    const size_t length = (size_t)snprintf(pair, sizeof pair, "%s=%s", key, value);
    bool has = false;
    for (const char *at = keys; *at && !has; at += strcspn(at, ";"), at += *at == ';')
        has = strcspn(at, ";") == length && strncmp(at, pair, length) == 0;
    return has;
}

/* Checks that a line of the table, with the texts column[], is a run of the bench and states the present scene keys of
 * its method. Keys for particles, time, output and contact are left out. */
static void line_is_of_the_plan(char *const *column)
{
    const struct accuracy_problem *q = problem_named(column[PROBLEM]);
    const struct accuracy_method *m = method_named(column[METHOD]);
    assert_non_null(q);
    assert_non_null(m);
    assert_true(m->family & q->families);
    const struct accuracy_point at = {.problem = q,
                                      .method = m,
                                      .at = case_named(q, column[CASE]),
                                      .resolution = atoi(column[RESOLUTION]),
                                      .horizon = atof(column[HORIZON]),
                                      .step = atof(column[STEP])};
    assert_true(at.at >= 0 && (!q->applies || q->applies(&at)));
    struct accuracy_scene s;
    accuracy_compose_scene_of_point(&at, &s);
    bench_overrides_as_array(&s.set);
    for (int j = 0; j < s.set.n; j++) {
        const char *key = s.set.at[j].key;
        bool apart = false, later = false;
        const char *const others[] = {"particles.", "time.", "output.", "contact."};
        for (size_t a = 0; a < COUNT_OF(others); a++) apart |= strncmp(key, others[a], strlen(others[a])) == 0;
        for (int i = j + 1; i < s.set.n; i++) later |= strcmp(s.set.at[i].key, key) == 0;
        if (!apart && !later) assert_true(keys_have(column[KEYS], key, s.set.at[j].value));
    }
}

/* Checks that every line of bench/accuracy/cost_accuracy.csv is a run of the bench, with the present scene keys of its
 * method; other lines could not be reproduced. */
static void the_chart_is_of_these_methods(void **state)
{
    (void)state;
    char line[LINE_ROOM], *column[COLUMNS];
    int lines = 0;
    FILE *from = fopen("bench/accuracy/cost_accuracy.csv", "r");
    assert_non_null(from);
    assert_non_null(fgets(line, sizeof line, from));
    assert_string_equal(line, ACCURACY_TABLE_HEADER "\n");
    for (; fgets(line, sizeof line, from); lines++) {
        char *rest = line;
        line[strcspn(line, "\n")] = '\0';
        for (int k = 0; k < COLUMNS; k++) column[k] = strsep(&rest, ",");
        assert_true(column[KEYS] && !rest);
        line_is_of_the_plan(column);
    }
    fclose(from);
    assert_true(lines > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(front_has_what_nothing_beats),
        cmocka_unit_test(front_of_random_clouds),
        cmocka_unit_test(cheapest_is_the_first_good_enough),
        cmocka_unit_test(manufactured_is_a_solution),
        cmocka_unit_test(pulses_are_solutions),
        cmocka_unit_test(particles_start_in_a_transverse_wave),
        cmocka_unit_test(the_chart_is_of_these_methods),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
