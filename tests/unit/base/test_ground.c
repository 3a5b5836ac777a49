/* Tests of the base: status, exhausted memory, thread team, regions, functions of time, cracks, materials. */
#include "tests/support/near.h"

#include <omp.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include "data/material.h"
#include "base/memory.h"
#include "data/region.h"
#include "base/team.h"

/* ---- status and memory ------------------------------------------------------------------------------------------- */

/* Returns REFUSED with a message that is composed of a text and a number, for tests of status_set. */
static status inner(void) { return status_set(REFUSED, "%s: %d is %s", "x.yaml:3:1", 7, "too large"); }
static status outer(void)
{
    TRY(inner());
    return OK;
}

static void status_keeps_its_message(void **state)
{
    (void)state;
    assert_refused(outer(), "x.yaml:3:1: 7 is too large");
    assert_failed(status_set(FAILED, "again: %s", status_message()), "again: x.yaml:3:1: 7 is too large");
    status_message_append_line("x.yaml:%d:1: \n", 4);
    assert_string_equal(status_message(), "again: x.yaml:3:1: 7 is too large\nx.yaml:4:1: ?");
    char *text = memory_new("text", 5001, 1);
    memset(text, 'a', 5000);
    assert_int_equal(status_set(FAILED, "%s", text), FAILED);
    assert_int_equal(strlen(status_message()), 4095); /* truncated, not overrun */
    memory_free(text);
}

static int ascending_ints(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

/* Checks that arrays without elements and storage can be copied, filled, compared and sorted, and that source and
 * target of a copy may overlap. */
static void arrays_may_be_empty_or_overlap(void **state)
{
    (void)state;
    int list[] = {5, 3, 4, 1, 2}, *none = NULL;
    array_copy(none, none, 0, sizeof *none);
    array_fill_bytes(none, 1, 0, sizeof *none);
    array_sort(none, 0, sizeof *none, ascending_ints);
    assert_true(arrays_equal(none, none, 0, sizeof *none) && arrays_equal(none, list, 0, sizeof *none));
    array_copy(list + 1, list, 4, sizeof *list);
    assert_true(arrays_equal(list, (int[]){5, 5, 3, 4, 1}, 5, sizeof *list));
    assert_false(arrays_equal(list, (int[]){5, 5, 3, 4, 2}, 5, sizeof *list));
    array_sort(list, 5, sizeof *list, ascending_ints);
    array_fill_bytes(list + 3, 0, 2, sizeof *list);
    assert_true(arrays_equal(list, (int[]){1, 3, 4, 0, 0}, 5, sizeof *list));
}

static void refusals_have_one_place(void **state)
{
    (void)state;
    assert_refused(status_message_prepend_location("x.yaml:3:1: ", status_set(REFUSED, "no particle")),
                   "x.yaml:3:1: no particle");
    assert_refused(status_message_prepend_location("x.yaml: ", REFUSED),
                   "x.yaml:3:1: no particle"); /* the first location is kept */
    assert_int_equal(strncmp(status_message(), "x.yaml:3:1: ", 12), 0);
    status_message_prepend_location("x.yaml: ", status_set(FAILED, "disk full"));
    assert_string_equal(status_message(), "disk full"); /* a failure has no location */
    status_message_prepend_location("", status_set(REFUSED, "no particle"));
    assert_string_equal(status_message(), "no particle");
}

/* Runs deed(context) in a child process. Returns the exit status of the process; line[512]: receives the first line
 * that it prints on standard error, truncated to 511 bytes. */
static int exit_of(void (*deed)(void *), void *context, char line[512])
{
    int channel[2], result;
    assert_int_equal(pipe(channel), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(channel[1], STDERR_FILENO);
        deed(context);
        _exit(0);
    }
    close(channel[1]);
    ssize_t length = read(channel[0], line, 511);
    line[length > 0 ? length : 0] = '\0';
    close(channel[0]);
    assert_int_equal(waitpid(child, &result, 0), child);
    return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

static void allocate(void *count) { memory_new("bonds.w", *(int64_t *)count, sizeof(real)); }

static void grow(void *count)
{
    real *array = NEW("bonds.w", 3, real);
    GROW("bonds.w", array, *(int64_t *)count);
}

static void out_of_memory_says_so(void **state)
{
    (void)state;
    char line[512];
    int64_t few = 10, count[] = {-1, INT64_MAX, INT64_MAX / 8 + 1, (int64_t)1 << 60};
    for (size_t c = 0; c < COUNT_OF(count); c++) {
        assert_int_equal(exit_of(allocate, &count[c], line), FAILED);
        assert_non_null(strstr(line, "out of memory: the array bonds.w"));
        assert_ptr_equal(strchr(line, '\n'), line + strlen(line) - 1); /* one line */
        if (count[c] < 0) continue;
        char wanted[80];
        snprintf(wanted, sizeof wanted, "out of memory: the array bonds.w needs %lld entries of 8 bytes",
                 (long long)count[c]);
        assert_int_equal(exit_of(grow, &count[c], line), FAILED);
        assert_non_null(strstr(line, wanted));
    }
    assert_int_equal(exit_of(allocate, &few, line), 0);
    assert_true(memory_peak_resident_size() > 1000000); /* a process with its libraries is larger than 1 MB */
}

/* Evaluates one invariant in each of four threads; it is violated in all of them if `broken` is true. Returns the line
 * number of the invariant in this file. */
static int break_invariant(bool broken)
{
#pragma omp parallel num_threads(4)
    INVARIANT(omp_get_num_threads() == 4 && !broken);
    return __LINE__ - 1;
}

static void break_here(void *unused) { (void)unused, break_invariant(true); }

/* Checks that a violated invariant ends the process with exit status 1 and one line, even if several threads violate
 * it. It runs before any thread team of this process exists, since a child process would lack the team. */
static void broken_invariants_leave_one_line(void **state)
{
    (void)state;
    char line[512], place[256];
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
    assert_int_equal(exit_of(break_here, NULL, line), -1); /* abort */
#else
    assert_int_equal(exit_of(break_here, NULL, line), FAILED);
#endif
    snprintf(place, sizeof place,
             "cleave %s: broken invariant at %s:%d, break_invariant: omp_get_num_threads() == 4 && !broken; ",
             CLEAVE_VERSION, __FILE__, break_invariant(false));
    assert_memory_equal(line, place, strlen(place));
    assert_non_null(strstr(line, "please report this line, with scene.yaml"));
    assert_ptr_equal(strchr(line, '\n'), line + strlen(line) - 1);
}

/* ---- team -------------------------------------------------------------------------------------------------------- */

/* Returns term i of the harmonic series from 1 on, times the factor *context, for tests of sums. */
static real harmonic(const void *context, int64_t i) { return *(const real *)context / (real)(i + 1); }

static void sums_do_not_depend_on_threads(void **state)
{
    (void)state;
    const int64_t n[] = {0, 1, SUM_BLOCK, SUM_BLOCK + 1, 123457};
    real scale = 0.1;
    for (size_t c = 0; c < COUNT_OF(n); c++) {
        real plain = 0, sum[4];
        for (int64_t i = 0; i < n[c]; i++) plain += harmonic(&scale, i);
        for (int threads = 1; threads <= 4; threads++) {
            omp_set_num_threads(threads);
            sum[threads - 1] = reproducible_sum(n[c], harmonic, &scale);
            assert_memory_equal(&sum[threads - 1], &sum[0], sizeof(real));
        }
        assert_close(sum[0], plain, 1e-13); /* round-off of 1e5 additions in another order */
    }
    omp_set_num_threads(2);
}

static void team_has_the_threads_asked_for(void **state)
{
    (void)state;
    struct machine before = machine_properties();
    for (int threads = 3; threads >= 1; threads--) {
        int seen = 0;
        assert_int_equal(threads_set_count_and_bind_to_cores(threads), threads);
#pragma omp parallel
#pragma omp single
        seen = omp_get_num_threads();
        assert_int_equal(seen, threads);
    }
    struct machine m = machine_properties(); /* binding the threads must not hide cores from the next call */
    assert_int_equal(m.cores, before.cores);
    assert_int_equal(m.threads_allowed, before.threads_allowed);
    assert_true(m.cores >= 1 && m.threads_allowed >= m.cores);
    assert_true(m.memory > 0 && strlen(m.model) > 0);
    assert_true(threads_set_count_and_bind_to_cores(0) >= 1);
    threads_set_count_and_bind_to_cores(2);
}

static void timers_book_time_where_it_went(void **state)
{
    (void)state;
    struct timers l;
    double begin = wall_clock_seconds();
    timers_start(&l);
    usleep(20000);
    timer_add_elapsed_to_section(&l, TIMER_BONDS);
    timer_add_elapsed_to_section(&l, TIMER_OUTPUT);
    double whole = wall_clock_seconds() - begin;
    assert_true(l.spent[TIMER_BONDS] >= 0.02 && l.spent[TIMER_BONDS] <= whole);
    assert_true(l.spent[TIMER_OUTPUT] >= 0 && l.spent[TIMER_BONDS] + l.spent[TIMER_OUTPUT] <= whole + 1e-9);
    assert_exact(l.spent[TIMER_GRID], 0);
    for (int k = 0; k < TIMERS; k++) assert_true(strlen(timer_name[k]) > 0);
}

/* ---- regions ----------------------------------------------------------------------------------------------------- */

#define POINT(...) ((const real[DIM_MAX]){__VA_ARGS__})

static void solids_are_closed_and_grow(void **state)
{
    (void)state;
    struct solid box = {.kind = SOLID_BOX, .from = {0, 0, 0}, .to = {2, 1, 3}};
    struct solid ball = {.kind = SOLID_BALL, .centre = {1, 1, 1}, .radius = 0.5};
    struct solid cylinder = {.kind = SOLID_CYLINDER, .from = {0, 0, 0}, .to = {0, 0, 2}, .radius = 1};
    struct solid half = {.kind = SOLID_HALF_SPACE, .point = {0, 1, 0}, .normal = {0, 5, 0}};
    const struct {
        struct solid *solid;
        real inside[DIM_MAX], surface[DIM_MAX], outside[DIM_MAX]; /* outside by 0.1 */
    } c[] = {{&box, {1, 0.5, 2}, {2, 1, 3}, {2.1, 0.5, 1}},
             {&ball, {1.2, 1, 1}, {1, 1.5, 1}, {1, 1, 1.6}},
             {&cylinder, {0.5, 0.5, 1}, {1, 0, 2}, {0, 0, 2.1}},
             {&half, {9, -9, 9}, {3, 1, 4}, {0, 1.1, 0}}};
    for (size_t k = 0; k < COUNT_OF(c); k++) {
        struct region r = {.n = 1, .solid = c[k].solid};
        assert_true(region_contains(&r, c[k].inside, 3, 0));
        assert_true(region_contains(&r, c[k].surface, 3, 0));
        assert_false(region_contains(&r, c[k].surface, 3, -1e-6));
        assert_false(region_contains(&r, c[k].outside, 3, 0.09));
        assert_true(region_contains(&r, c[k].outside, 3, 0.11));
    }
}

static void regions_build_in_order(void **state)
{
    (void)state;
    struct solid plate = {.kind = SOLID_BOX, .from = {0, 0}, .to = {4, 4}};
    struct solid hole = {.kind = SOLID_BALL, .subtract = true, .centre = {2, 2}, .radius = 1};
    struct solid pin = {.kind = SOLID_BALL, .centre = {2, 2}, .radius = 0.5};
    struct region r = {.n = 3, .solid = (struct solid[]){plate, hole, pin}},
                  turned = {.n = 3, .solid = (struct solid[]){plate, pin, hole}};
    assert_true(region_contains(&r, POINT(2, 2), 2, 0));
    assert_false(region_contains(&turned, POINT(2, 2), 2, 0));
    assert_false(region_contains(&r, POINT(2.7, 2), 2, 0));
    assert_true(region_contains(&r, POINT(3, 2), 2, 0)); /* the edge of the hole belongs to the plate */
    assert_false(region_contains(&r, POINT(3, 2), 2, -1e-9));
    assert_true(region_contains(&r, POINT(2.95, 2), 2, 0.06)); /* an enlarged plate has a smaller hole */
    assert_false(region_contains(&r, POINT(5, 2), 2, 0));
    assert_true(region_contains(&(struct region){0}, POINT(1e9, -1e9), 2, 0));
    struct solid all = {.kind = SOLID_ALL};
    assert_true(region_contains(&(struct region){.n = 1, .solid = &all}, POINT(7), 1, 0));
}

static void bounds_hold_the_added_solids(void **state)
{
    (void)state;
    real low[DIM_MAX], high[DIM_MAX];
    struct solid s[] = {{.kind = SOLID_CYLINDER, .from = {0, 0, 0}, .to = {3, 4, 0}, .radius = 1},
                        {.kind = SOLID_BALL, .centre = {0, 0, 5}, .radius = 2},
                        {.kind = SOLID_HALF_SPACE, .subtract = true, .normal = {1, 0, 0}}};
    struct region r = {.n = 3, .solid = s};
    assert_true(region_compute_bounding_box_if_finite(&r, 3, low, high));
    const real want_low[] = {-2, -2, -1}, want_high[] = {3.8, 4.6, 7}; /* cylinder: reach 0.8, 0.6, 1 */
    for (int d = 0; d < 3; d++) {
        assert_near(low[d], want_low[d], 1e-14);
        assert_near(high[d], want_high[d], 1e-14);
    }
    s[2].subtract = false;
    assert_false(region_compute_bounding_box_if_finite(&r, 3, low, high));
    assert_false(region_compute_bounding_box_if_finite(&(struct region){0}, 3, low, high));
    struct solid strip = {.kind = SOLID_BOX, .from = {0, -INFINITY}, .to = {1, INFINITY}};
    assert_false(region_compute_bounding_box_if_finite(&(struct region){.n = 1, .solid = &strip}, 2, low, high));
    assert_true(region_compute_bounding_box_if_finite(&(struct region){.n = 1, .solid = &strip}, 1, low, high));
    assert_true(region_contains(&(struct region){.n = 1, .solid = &strip}, POINT(0.5, 1e30), 2, 0));
}

/* ---- functions of time ------------------------------------------------------------------------------------------- */

/* Checks values of all kinds of functions of time between, at and beyond their times, jumps included. */
static void time_functions_follow_their_definitions(void **state)
{
    (void)state;
    real t[] = {0, 1, 1, 3}, value[] = {5, 6, 0, 4}; /* a jump at t = 1 */
    const struct time_function constant = {.kind = TIME_CONSTANT}, step = {TIME_STEP, 1, 2, 0, NULL, NULL},
                               pulse = {TIME_PULSE, 1, 3, 0, NULL, NULL}, ramp = {TIME_RAMP, 1, 3, 0, NULL, NULL},
                               table = {.kind = TIME_TABLE, .n = 4, .t = t, .value = value},
                               sudden = {TIME_RAMP, 1, 1, 0, NULL, NULL};
    const struct {
        const struct time_function *f;
        real t, value;
    } c[] = {
        {&constant, -3, 1}, {&step, 0.999, 0},  {&step, 1, 1},   {&step, 1.999, 1},  {&step, 2, 0},  {&pulse, 1, 0},
        {&pulse, 2, 1},     {&pulse, 1.5, 0.5}, {&pulse, 3, 0},  {&pulse, 0, 0},     {&ramp, 0, 0},  {&ramp, 1.5, 0.25},
        {&ramp, 3, 1},      {&ramp, 9, 1},      {&table, -1, 5}, {&table, 0.5, 5.5}, {&table, 1, 0}, {&table, 2, 2},
        {&table, 9, 4},     {&sudden, 0.9, 0},  {&sudden, 1, 1},
    };
    for (size_t k = 0; k < COUNT_OF(c); k++)
        assert_near(time_function_value(c[k].f, c[k].t), c[k].value, 1e-15); /* round-off of sin^2 */
    assert_exact(time_function_value(&(struct time_function){.kind = TIME_STEP, .until = INFINITY}, 1e9), 1);
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* Checks that crack c cuts the bond between a and b, if `cut` is true, or does not, in both directions. */
static void check_cut(const struct crack *c, const real *a, const real *b, int dim, bool cut)
{
    assert_int_equal(crack_cuts_bond(c, a, b, dim), cut);
    assert_int_equal(crack_cuts_bond(c, b, a, dim), cut);
}

static void cracks_cut_in_one_and_two_dimensions(void **state)
{
    (void)state;
    struct crack point = {.n = 1, .corner = (real[][DIM_MAX]){{1}}},
                 edge = {.n = 2, .corner = (real[][DIM_MAX]){{0, 0}, {2, 0}}};
    check_cut(&point, POINT(0.5), POINT(1.5), 1, true);
    check_cut(&point, POINT(0.5), POINT(0.7), 1, false);
    check_cut(&point, POINT(1), POINT(1.5), 1, false); /* on the crack counts as the positive side */
    check_cut(&point, POINT(1), POINT(0.5), 1, true);
    check_cut(&edge, POINT(1, -1), POINT(1.5, 1), 2, true);
    check_cut(&edge, POINT(2, -1), POINT(2, 1), 2, true); /* exactly through the tip */
    check_cut(&edge, POINT(1.5, -1), POINT(2.5, 1), 2, true);
    check_cut(&edge, POINT(2.001, -1), POINT(2.001, 1), 2, false);
    check_cut(&edge, POINT(-0.001, -1), POINT(-0.001, 1), 2, false);
    check_cut(&edge, POINT(1, 0.1), POINT(1, 1), 2, false);
    check_cut(&edge, POINT(0.5, 0), POINT(1.5, 0), 2, false);   /* along the crack */
    check_cut(&edge, POINT(0.5, 1e-10), POINT(1, -1), 2, true); /* positions 1e-10 on either side count as the same
                                                                 * side */
    check_cut(&edge, POINT(0.5, -1e-10), POINT(1, -1), 2, true);
    check_cut(&edge, POINT(0.5, -1e-10), POINT(1, 1), 2, false);
    check_cut(&edge, POINT(0.5, -1.9e-9), POINT(1, -2.1e-9), 2, true); /* cut between them, but not elsewhere */
    check_cut(&edge, POINT(3, 0), POINT(3, -1), 2, false);             /* on the extension of the crack */
    check_cut(&edge, POINT(1, 1), POINT(1, 1), 2, false);
    struct crack nothing = {.n = 2, .corner = (real[][DIM_MAX]){{1, 1}, {1, 1}}};
    check_cut(&nothing, POINT(0, 1), POINT(2, 1), 2, false);
}

static void cracks_cut_in_three_dimensions(void **state)
{
    (void)state;
    real corner[][DIM_MAX] = {{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {1, 3, 1}, {0, 2, 1}}, back[5][DIM_MAX];
    for (int k = 0; k < 5; k++) memcpy(back[k], corner[4 - k], sizeof back[k]);
    for (int rotation = 0; rotation < 2; rotation++) { /* either orientation */
        struct crack c = {.n = 5, .corner = rotation ? back : corner};
        check_cut(&c, POINT(1, 1, 0), POINT(1, 1, 2), 3, true);
        check_cut(&c, POINT(0.5, 2.5, 0), POINT(0.5, 2.5, 2), 3, true); /* on an oblique edge */
        check_cut(&c, POINT(0.4, 2.5, 0), POINT(0.4, 2.5, 2), 3, false);
        check_cut(&c, POINT(0, 0, 0), POINT(0, 0, 2), 3, true); /* on a corner */
        check_cut(&c, POINT(3, 1, 0), POINT(0, 1, 3), 3, true); /* obliquely through (2, 1, 1) */
        check_cut(&c, POINT(3.01, 1, 0), POINT(2.01, 1, 3), 3, false);
        check_cut(&c, POINT(1, 1, 1.5), POINT(1, 1, 2), 3, false);
    }
    check_cut(&(struct crack){.n = 2, .corner = corner}, POINT(1, 0, 0), POINT(1, 0, 2), 3, false);
}

/* Checks that crack_cuts_bond has equal results for a bond and its reverse where round-off decides: for bonds through
 * the very end of the crack, which has a tolerance of 1e-9 crack lengths. */
static void cracks_are_symmetric_at_their_tips(void **state)
{
    (void)state;
    struct crack edge = {.n = 2, .corner = (real[][DIM_MAX]){{-0.1, 0.03}, {0.3, 0.7}}};
    int cut = 0;
    for (int k = 0; k < 20000; k++) {
        real angle = 1.1 + 1e-4 * k, far = 0.4 + 1e-5 * k; /* never along the crack, whose angle is 1.03 */
        real past = 1e-9 + 1e-16 * (k % 13 - 6);           /* a few units of round-off on either side of the limit */
        real end[2] = {0.3 + past * 0.4, 0.7 + past * 0.67};
        real a[2] = {end[0] + cos(angle), end[1] + sin(angle)};
        real b[2] = {end[0] - far * cos(angle), end[1] - far * sin(angle)};
        bool forth = crack_cuts_bond(&edge, a, b, 2);
        assert_int_equal(forth, crack_cuts_bond(&edge, b, a, 2));
        cut += forth;
    }
    assert_in_range(cut, 1000, 19000); /* check: round-off decides here */
}

/* ---- materials --------------------------------------------------------------------------------------------------- */

/* Compares elastic constants in every space with closed forms, to round-off, and wave speeds with those of Imachi et
 * al. 2019, to the digits given. */
static void elastic_constants_agree_with_closed_forms(void **state)
{
    (void)state;
    struct material m = {.young = 2e11, .poisson = 0.3, .density = 8000};
    material_compute_derived_constants(&m, SPACE_PLANE_STRESS);
    assert_close(m.c11, 2e11 / 0.91, 1e-14);
    assert_close(m.c12, 0.3 * m.c11, 1e-14);
    assert_close(m.bulk, 2e11 / 1.4, 1e-14);
    material_compute_derived_constants(&m, SPACE_PLANE_STRAIN);
    assert_close(m.c11, 2e11 * 0.7 / (1.3 * 0.4), 1e-14);
    assert_close(m.bulk, 2e11 / (2 * 1.3 * 0.4), 1e-14);
    material_compute_derived_constants(&m, SPACE_SOLID);
    assert_close(m.bulk, 2e11 / 1.2, 1e-14);
    material_compute_derived_constants(&m, SPACE_LINE);
    assert_exact(m.c11, 2e11);
    assert_close(m.wave_speed, 5000, 1e-15);
    assert_exact(m.c12 + m.shear_speed + m.rayleigh_speed, 0);
    /* Wave speeds of Imachi et al. 2019 from the closed forms, to the digits given. */
    struct material glass = {.young = 75.629e9, .poisson = 0.286, .density = 2456};
    material_compute_derived_constants(&glass, SPACE_PLANE_STRAIN);
    assert_near(glass.wave_speed, 6320.3, 0.06);
    assert_near(glass.shear_speed, 3460.1, 0.06);
    assert_near(glass.rayleigh_speed, 3201.4, 0.06);
}

static void compliance_inverts_stiffness(void **state)
{
    (void)state;
    const enum space space[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};
    for (size_t k = 0; k < COUNT_OF(space); k++) {
        struct material m = {.young = 7e10, .poisson = 0.2, .density = 1};
        int dim = space_dim(space[k]), n = symmetric_tensor_component_count(dim);
        real C[SYM_MAX * SYM_MAX], S[SYM_MAX * SYM_MAX];
        material_compute_derived_constants(&m, space[k]);
        material_stiffness_matrix(&m, dim, C);
        material_compliance_matrix(&m, dim, S);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                real sum = 0;
                for (int l = 0; l < n; l++) sum += C[i * n + l] * S[l * n + j];
                assert_near(sum, i == j, 1e-14);
            }
        if (dim > 1) assert_close(C[n * n - 1], 7e10 / 1.2, 1e-14); /* 2G for the tensor shear strain */
    }
}

static void bond_constants_agree_with_closed_forms(void **state)
{
    (void)state;
    const real E = 3e9, d = 0.01, h = 0.002, A = 1e-4, pi = acos(-1), G_c = 50;
    struct material m = {.young = E, .density = 1000, .energy_release_rate = G_c};
    const struct {
        enum space space;
        real poisson, section, c, s;
    } want[] = {{SPACE_LINE, 0, A, 2 * E / (A * d * d), sqrt(3 * G_c / (E * d))},
                {SPACE_PLANE_STRESS, 1.0 / 3, h, 9 * E / (pi * h * d * d * d), sqrt(4 * pi * G_c / (9 * E * d))},
                {SPACE_PLANE_STRAIN, 0.25, h, 48 * E / (5 * pi * h * d * d * d), sqrt(5 * pi * G_c / (12 * E * d))},
                {SPACE_SOLID, 0.25, 1, 12 * E / (pi * d * d * d * d), sqrt(5 * G_c / (6 * E * d))}};
    for (size_t k = 0; k < COUNT_OF(want); k++) {
        m.poisson = want[k].poisson;
        material_compute_derived_constants(&m, want[k].space);
        assert_close(material_micro_modulus_of_continuum(&m, want[k].space, d, want[k].section), want[k].c, 1e-13);
        assert_close(material_critical_stretch(&m, want[k].space, d, STRETCH_BOND), want[k].s, 1e-13);
        if (want[k].space != SPACE_LINE) assert_exact(bond_based_poisson_ratio(want[k].space), want[k].poisson);
        /* The continuum value is the discrete formula with the integral of r over the horizon. */
        real integral[] = {0, A * d * d, 2 * pi * h * d * d * d / 3, pi * d * d * d * d};
        assert_close(material_micro_modulus_of_discrete_family(&m, want[k].space, integral[space_dim(want[k].space)]),
                     want[k].c, 1e-13);
    }
    assert_true(isnan(bond_based_poisson_ratio(SPACE_LINE)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(broken_invariants_leave_one_line),
        cmocka_unit_test(status_keeps_its_message),
        cmocka_unit_test(arrays_may_be_empty_or_overlap),
        cmocka_unit_test(refusals_have_one_place),
        cmocka_unit_test(out_of_memory_says_so),
        cmocka_unit_test(sums_do_not_depend_on_threads),
        cmocka_unit_test(team_has_the_threads_asked_for),
        cmocka_unit_test(timers_book_time_where_it_went),
        cmocka_unit_test(solids_are_closed_and_grow),
        cmocka_unit_test(regions_build_in_order),
        cmocka_unit_test(bounds_hold_the_added_solids),
        cmocka_unit_test(time_functions_follow_their_definitions),
        cmocka_unit_test(cracks_cut_in_one_and_two_dimensions),
        cmocka_unit_test(cracks_cut_in_three_dimensions),
        cmocka_unit_test(cracks_are_symmetric_at_their_tips),
        cmocka_unit_test(elastic_constants_agree_with_closed_forms),
        cmocka_unit_test(compliance_inverts_stiffness),
        cmocka_unit_test(bond_constants_agree_with_closed_forms),
    };
    omp_set_num_threads(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
