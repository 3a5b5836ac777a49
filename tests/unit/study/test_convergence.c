/* Tests convergence studies: order of convergence, confidence intervals, choice of spacings. */
#include "tests/support/near.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output/output_files.h"
#include "scene/scene_read.h"
#include "study/convergence_study.h"
#include "study/uncertainty.h"

/* ---- convergence ------------------------------------------------------------------------------------------------- */

enum { LEVELS = 3, RUNS = 5 };

/* Evaluates c for values f0 + a h^p at the relative spacings h = 1, sqrt(2), 2, `runs` runs each. The values of the
 * runs deviate by -1 to 1 times `noise`. Returns the result of the evaluation. */
static bool converge_at(struct convergence *c, double f0, double a, double p, double noise, int runs)
{
    static const double part[RUNS] = {0, -1, 1, -0.5, 0.5};
    double spacing[LEVELS * RUNS], value[LEVELS * RUNS];
    int level[LEVELS * RUNS], n = 0;
    for (int k = 0; k < LEVELS; k++)
        for (int r = 0; r < runs; r++, n++) {
            level[n] = k;
            spacing[n] = 1e-3 * pow(2, 0.5 * k);
            value[n] = f0 + a * pow(pow(2, 0.5 * k), p) + noise * part[r];
        }
    return convergence_evaluate_scalar_result(c, spacing, value, level, n, LEVELS, NULL);
}

/* Checks that the order of a power law is found to 1e-9, and that the interval of the finest value contains the
 * limit. */
static void power_laws_are_found(void **state)
{
    (void)state;
    struct convergence c;
    for (double p = 0.5; p <= 2; p += 0.25) {
        assert_true(converge_at(&c, 3, -0.2, p, 0, 1));
        assert_int_equal(c.verdict, VERDICT_CONVERGES);
        assert_near(c.order, p, 1e-9);
        assert_near(c.index, 1.25 * 0.2, 1e-9);
        assert_true(fabs(c.order_likely - p) < 2 * c.order_error);
        assert_true(c.order_error > 0 && c.order_error < 0.75);            /* orders from 0.5 to 2 */
        assert_true(c.uncertainty[0] > 0.2 && c.uncertainty[0] < 3 * 0.2); /* -0.2 is its true error */
        assert_near(c.level[0].error, 0, 0);
    }
}

static void bounds_where_no_order_is_seen(void **state)
{
    (void)state;
    struct convergence c;
    assert_true(converge_at(&c, 3, 1, 0.2, 0, 1));
    assert_int_equal(c.verdict, VERDICT_SLOW);
    assert_near(c.order, 0.2, 1e-9);
    assert_true(converge_at(&c, 3, 1, -1, 0, 1)); /* grows as the spacing decreases */
    assert_int_equal(c.verdict, VERDICT_DIVERGES);
    assert_true(isnan(c.index));
    assert_true(c.uncertainty[0] >= 0.5); /* the range of the means */
    const double spacing[] = {1, 1.4, 2}, value[] = {1, 2, 1.5}, lost[] = {1, NAN, 1};
    const int level[] = {0, 1, 2};
    assert_true(convergence_evaluate_scalar_result(&c, spacing, value, level, 3, 3, NULL));
    assert_int_equal(c.verdict, VERDICT_OSCILLATES);
    assert_true(isnan(c.order));
    assert_true(c.uncertainty[0] >= 1); /* the range of the means */
    assert_false(convergence_evaluate_scalar_result(&c, spacing, lost, level, 3, 3, NULL));
}

/* Checks means with random errors: orders of 2.9 and -1.0 are observed, but the most likely orders are within 0.5 to
 * 2. */
static void chance_moves_the_order(void **state)
{
    (void)state;
    struct convergence c;
    static const double mean[2][LEVELS] = {{9.05, 8.75, 7.95}, {9.05, 8.45, 8.05}};
    for (int which = 0; which < 2; which++) {
        double spacing[LEVELS * RUNS], value[LEVELS * RUNS];
        int level[LEVELS * RUNS];
        for (int k = 0; k < LEVELS * RUNS; k++) {
            level[k] = k / RUNS;
            spacing[k] = (double[]){1, 1.4, 2}[level[k]];
            value[k] = mean[which][level[k]] + 0.1 * (k % RUNS - 2); /* its mean to 0.2 */
        }
        assert_true(convergence_evaluate_scalar_result(&c, spacing, value, level, LEVELS * RUNS, LEVELS, NULL));
        assert_int_equal(c.verdict, which == 0 ? VERDICT_CONVERGES : VERDICT_SCATTERS);
        assert_true(which == 0 ? c.order > 2.2 : c.order < 0);
        assert_true(c.order_likely > 0.5 && c.order_likely < 2);
        const double rest = mean[which][0] - mean[which][2]; /* remaining error at order 1 */
        assert_true(c.uncertainty[0] > rest);
    }
}

/* Returns the half width of the confidence interval of mean[0] by rectangular quadrature over value, slope, order and
 * misfit of the model, directly from its definition. spacing[], mean[], error[]: of each level; scale: of the
 * misfit. */
static double half_width_plainly(const double *spacing, const double *mean, const double *error, double scale)
{
    static const double order[] = {0.5, 0.75, 1, 1.25, 1.5, 1.75, 2}, weight[] = {0.5, 1, 1, 1, 1, 1, 0.5};
    enum { STEPS = 1201, SLOPES = 401 };
    static double at[STEPS]; /* probability of each v - mean[0] from -6 to 6 scales */
    double sum = 0, inside = 0;
    for (int v = 0; v < STEPS; v++) at[v] = 0;
    for (int o = 0; o < 7; o++)
        for (int m = 0; m < 10; m++) {
            const double misfit = scale * pow(1e-3, 1 - m / 9.0);
            for (int v = 0; v < STEPS; v++)
                for (int s = 0; s < SLOPES; s++) {
                    const double value = (v - 600) * 0.01 * scale, trend = (s - 200) * 0.03 * scale;
                    const double slope = trend / (pow(spacing[LEVELS - 1] / spacing[0], order[o]) - 1);
                    double likely = weight[o] * exp(-0.5 * square(trend / scale));
                    for (int k = 0; k < LEVELS; k++) {
                        const double variance = square(0.5 * error[k]) + square(misfit);
                        const double off = mean[k] - mean[0] - value - slope * pow(spacing[k] / spacing[0], order[o]);
                        likely *= exp(-0.5 * off * off / variance) / sqrt(variance);
                    }
                    at[v] += likely;
                }
        }
    for (int v = 0; v < STEPS; v++) sum += at[v];
    int reach = 0;
    for (inside = at[600]; inside < 0.95 * sum; reach++) inside += at[600 - reach - 1] + at[600 + reach + 1];
    return 0.01 * scale * (reach + 0.5);
}

static void intervals_as_defined(void **state)
{
    (void)state;
    struct convergence c = {.levels = LEVELS};
    static const double spacing[] = {1, 1.5, 2}, error[] = {0.1, 0.2, 0.3};
    static const double mean[][LEVELS] = {{1, 1.4, 2}, {1, 1.1, 0.4}, {1, 3, 3.2}};
    for (int which = 0; which < 3; which++) {
        for (int k = 0; k < LEVELS; k++)
            c.level[k] = (struct spacing_level_statistics){spacing[k], mean[which][k], 0.1, error[k], 5};
        const double *m = mean[which];
        const double range = fmax(m[0], fmax(m[1], m[2])) - fmin(m[0], fmin(m[1], m[2]));
        const double plainly = half_width_plainly(spacing, m, error, hypot(range, 0.15));
        const double width = convergence_confidence_interval_half_width(&c, c.level[0].mean, 0.95);
        assert_near(width, plainly, 0.03 * plainly); /* step size of the quadrature */
    }
}

/* Checks random values that follow the model of the intervals (Park & Miller's generator): 90 to 98 of 100 intervals of
 * 95 % contain the true value. */
static void intervals_hold_what_they_name(void **state)
{
    (void)state;
    enum { CASES = 600 };
    uint64_t seed = 20260101;
    int held = 0;
    for (int n = 0; n < CASES; n++) {
        struct convergence c = {.levels = LEVELS};
        double draw[8];
        for (int k = 0; k < 8; k++) { /* nearly normal: sum of twelve uniform numbers */
            draw[k] = -6;
            for (int j = 0; j < 12; j++) draw[k] += (double)(seed = seed * 48271 % 2147483647) / 2147483647.0;
        }
        const double p = 0.5 + 0.25 * (n % 7), misfit = pow(10, -(n % 4));
        for (int k = 0; k < LEVELS; k++) {
            const double h = pow(2, 0.5 * k), noise = hypot(misfit, 0.05) * 0.3 * draw[k];
            const double trend = draw[7] / (pow(2, p) - 1);
            c.level[k] = (struct spacing_level_statistics){h, 7 + trend * pow(h, p) + noise, 0, 0.03, 5};
        }
        held += fabs(c.level[0].mean - 7) <= convergence_confidence_interval_half_width(&c, c.level[0].mean, 0.95);
    }
    assert_true(held >= 0.9 * CASES && held <= 0.98 * CASES); /* the scale is estimated from the means, which costs 3
                                                               * of 100 */
}

/* Checks runs that scatter: the error of a mean is that of Student's distribution; a trend below it determines no
 * order, a large one does. */
static void scatter_hides_small_trends(void **state)
{
    (void)state;
    struct convergence c;
    const double deviation = sqrt(2.5 / 4); /* of 0, -1, 1, -0.5, 0.5 */
    assert_true(converge_at(&c, 3, 0.1, 1, 1, RUNS));
    assert_int_equal(c.verdict, VERDICT_SCATTERS);
    assert_near(c.level[0].deviation, deviation, 1e-12);
    assert_near(c.level[0].error, 2.776 * deviation / sqrt(RUNS), 1e-12); /* 4 degrees of freedom, published tables */
    assert_true(c.uncertainty[0] >= c.level[0].error && c.uncertainty[0] >= c.discretisation[0]);
    assert_true(converge_at(&c, 3, 10, 1, 1, RUNS)); /* a large trend is detected */
    assert_int_equal(c.verdict, VERDICT_CONVERGES);
    assert_near(c.order, 1, 1e-9);
}

/* Checks that a length in whole spacings has an error of at least half a spacing, even if runs agree. */
static void steps_of_a_figure_are_errors(void **state)
{
    (void)state;
    struct convergence c;
    const double spacing[] = {1, 1, 1.4, 1.4, 2, 2}, value[] = {9, 9, 9.4, 9.4, 8, 8}, half[] = {0.5, 0.7, 1};
    const int level[] = {0, 0, 1, 1, 2, 2};
    assert_true(convergence_evaluate_scalar_result(&c, spacing, value, level, 6, 3, NULL));
    assert_int_equal(c.verdict, VERDICT_OSCILLATES);
    assert_true(convergence_evaluate_scalar_result(&c, spacing, value, level, 6, 3, half));
    assert_int_equal(c.verdict, VERDICT_SCATTERS);
    assert_near(c.level[0].error, 0.5, 1e-12);
    assert_true(c.uncertainty[0] > 1 && c.uncertainty[2] > 1);
}

/* Checks that a bias is included as an independent normal error: its 95 % value is 1.96 and its 50 % value 0.6745
 * standard deviations. */
static void bias_widens_intervals(void **state)
{
    (void)state;
    struct convergence c;
    assert_true(converge_at(&c, 3, -0.2, 1, 0, 1));
    const double at = c.level[0].mean, wide = convergence_confidence_interval_half_width(&c, at, 0.95);
    const double half = convergence_confidence_interval_half_width(&c, at, 0.5);
    c.bias = 2;
    assert_near(convergence_confidence_interval_half_width(&c, at, 0.95), hypot(wide, 2), 1e-5);
    assert_near(convergence_confidence_interval_half_width(&c, at, 0.5), hypot(half, 2 * 0.67449 / 1.95996), 1e-5);
}

static void student_as_published(void **state)
{
    (void)state;
    assert_near(student_t_quantile_975(1), 12.706, 0);
    assert_near(student_t_quantile_975(30), 2.042, 0.005);
    assert_near(student_t_quantile_975(60), 2.000, 0.005);
    assert_near(student_t_quantile_975(1000000), 1.960, 0.001);
}

/* ---- spacings ---------------------------------------------------------------------------------------------------- */

/* Checks the spacings of a study of a plate of 100 x 40 with a crack at mid-height: they are near 0.5 times powers of
 * sqrt(2) and divide both sides and the height of the crack. A crack through a row of particles stays there. */
static void spacings_fit_faces_and_cracks(void **state)
{
    (void)state;
    struct solid box = {.kind = SOLID_BOX, .to = {100, 40}};
    struct scene_body body = {.shape = {.n = 1, .solid = &box}};
    real corner[2][DIM_MAX] = {{0, 20}, {50, 20}};
    struct crack crack = {2, corner, 0};
    struct scene s = {.dim = 2, .spacing = 0.5, .bodies = 1, .body = &body, .cracks = 1, .crack = &crack};
    struct spacings to;
    spacings_choose_for_convergence_study(&to, &s, 3, s.spacing);
    assert_near(to.at[0][0], 0.5, 0);
    for (int k = 0; k < 3; k++) {
        assert_true(fabs(to.at[k][0] / (0.5 * pow(2, 0.5 * k)) - 1) < 0.12);
        for (int j = 0; j < to.n[k]; j++)
            for (int side = 1; side <= 5; side += side == 1 ? 1 : 3) { /* 20, 40, 100 */
                const double cells = 20 * side / to.at[k][j];
                assert_near(cells, round(cells), 0.02);
            }
        for (int j = 1; j < to.n[k]; j++) assert_true(fabs(to.at[k][j] / to.at[k][0] - 1) > 1e-3);
    }
    corner[0][1] = corner[1][1] = 20.25; /* through the middle of a row */
    int fits = 0;
    spacings_choose_for_convergence_study(&to, &s, 3, s.spacing);
    for (int k = 0; k < 3; k++) {
        const double rows = 20.25 / to.at[k][0] - 0.5, off = fabs(rows - round(rows));
        fits += off <= 0.02;
        assert_true(off <= 0.02 || to.misfit[k] > 0.02); /* reported */
    }
    assert_true(fits > 0);
}

/* Checks that without lengths that a lattice must fit, the spacings of a study have the ratio sqrt(2). */
static void mesh_levels_are_apart(void **state)
{
    (void)state;
    struct scene_body list = {.file = "list.csv"};
    const struct scene s = {.dim = 2, .spacing = 0.37, .bodies = 1, .body = &list};
    struct spacings to;
    spacings_choose_for_convergence_study(&to, &s, 4, 0.29);
    assert_int_equal(to.levels, 4);
    for (int k = 0; k < 4; k++) assert_true(fabs(to.at[k][0] / (0.29 * pow(sqrt(2), k)) - 1) < 1e-12);
}

/* ---- existing study ---------------------------------------------------------------------------------------------- */

/* Checks the intervals read from a study: those of the level whose spacing is within 5 % of that of the scene; none for
 * other spacings or another scene. */
static void intervals_at_hand(void **state)
{
    (void)state;
    static const char table[] =
        "figure,unit,spacing_0 [m],mean_0,uncertainty_0,spacing_1 [m],mean_1,uncertainty_1,spacing_2 [m],"
        "uncertainty_2\n"
        "energy.strain,J,0.00031,7,0.11,0.00044,7.2,0.23,0.00062,0.47\n"
        "crack.length_end,m,0.00031,3,0.013,0.00044,3.1,,0.00062,0.059\n";
    char folder[] = "/tmp/cleave_test_XXXXXX", text[] = "name: \"plate\"\n";
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    assert_int_equal(mkdir("plate_converge", 0777), 0);
    assert_int_equal(study_write_scene_and_options("plate_converge", text, "--runs 3"), OK);
    assert_int_equal(file_write_whole("plate_converge/converge.csv", table, strlen(table)), OK);
    static const struct {
        double spacing;
        int bars;
        double first;
    } at[] = {{0.31e-3, 2, 0.11}, {0.44e-3, 1, 0.23}, {0.63e-3, 2, 0.47}, {0.5e-3, 0, 0}};
    struct scene s = {.name = "plate", .text = text};
    for (size_t k = 0; k < COUNT_OF(at); k++) {
        struct error_bar bar[4];
        s.spacing = at[k].spacing;
        assert_int_equal(error_bars_read_from_convergence_study(bar, 4, &s, "plate"), at[k].bars);
        if (at[k].bars == 0) continue;
        assert_string_equal(bar[0].figure, "energy.strain");
        assert_near(bar[0].half_width, at[k].first, 0);
    }
    struct error_bar none;
    s.text = (char[]){"name: \"other\"\n"};
    assert_int_equal(error_bars_read_from_convergence_study(&none, 1, &s, "plate"), 0);
    assert_int_equal(unlink("plate_converge/converge.csv") | unlink("plate_converge/study.yaml"), 0);
    assert_int_equal(rmdir("plate_converge"), 0);
    assert_int_equal(chdir("/") | rmdir(folder), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(power_laws_are_found),
        cmocka_unit_test(bounds_where_no_order_is_seen),
        cmocka_unit_test(scatter_hides_small_trends),
        cmocka_unit_test(chance_moves_the_order),
        cmocka_unit_test(intervals_as_defined),
        cmocka_unit_test(intervals_hold_what_they_name),
        cmocka_unit_test(bias_widens_intervals),
        cmocka_unit_test(mesh_levels_are_apart),
        cmocka_unit_test(intervals_at_hand),
        cmocka_unit_test(student_as_published),
        cmocka_unit_test(steps_of_a_figure_are_errors),
        cmocka_unit_test(spacings_fit_faces_and_cracks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
