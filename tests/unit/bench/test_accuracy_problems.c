/* Tests of the problems of the cost-accuracy table: every scene is valid, the exact solution for the plate with a hole
 * satisfies its equations, and coarse, quick runs of each problem have their measured errors. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "bench/accuracy/accuracy.h"
#include "bench/accuracy/accuracy_reference.h"

/* Checks that all scenes of the bench are valid: creating the plan reads each of them. */
static void scenes_are_sound(void **state)
{
    (void)state;
    struct accuracy_plan plan = {0};
    assert_int_equal(accuracy_plan_make(&plan), OK);
    for (int k = 0; k < accuracy_problems; k++)
        for (int at = 0; at < accuracy_case_count(accuracy_problem[k]); at++) {
            int points = 0, quick = 0;
            for (int n = 0; n < plan.n; n++) {
                const struct accuracy_entry *entry = &plan.entry[n];
                if (entry->point.problem != accuracy_problem[k] || entry->point.at != at) continue;
                assert_true(entry->point.method->family & accuracy_problem[k]->families);
                points++, quick += entry->quick;
            }
            assert_true(points >= 20 && quick >= 8 && quick < points);
        }
    accuracy_plan_free(&plan);
}

/* ---- the plate with a hole --------------------------------------------------------------------------------------- */

/* Checks that the solution for a plate with a hole has a free hole and edges under its tension, within 3e-4 of it, and
 * the factor 3.36 at the hole. */
static void hole_is_free_and_edges_are_pulled(void **state)
{
    (void)state;
    double u[2], s[3];
    for (int k = 0; k <= 90; k++) { /* accuracy of the boundary collocation: 4e-5 */
        const double angle = k * M_PI / 180, c = cos(angle), n = sin(angle), side = 5 * n;
        accuracy_hole_compute_exact_solution((double[2]){c, n}, u, s);
        assert_true(fabs(s[0] * c + s[2] * n) <= 3e-4 * 1e4 && fabs(s[2] * c + s[1] * n) <= 3e-4 * 1e4);
        accuracy_hole_compute_exact_solution((double[2]){5, side}, u, s);
        assert_true(fabs(s[0]) <= 3e-4 * 1e4 && fabs(s[2]) <= 3e-4 * 1e4);
        accuracy_hole_compute_exact_solution((double[2]){side, 5}, u, s);
        assert_true(fabs(s[1] - 1e4) <= 3e-4 * 1e4 && fabs(s[2]) <= 3e-4 * 1e4);
    }
    accuracy_hole_compute_exact_solution((double[2]){1, 0}, u, s);
    assert_true(fabs(s[1] - 3.3601e4) <= 1);
}

/* Checks by finite differences that the exact field around a hole satisfies Hooke's law and equilibrium: the stresses
 * follow from the displacement gradient and have no divergence. */
static void hole_is_elastic_and_in_balance(void **state)
{
    (void)state;
    static const double place[][2] = {{1.3, 0.2}, {0.4, 1.7}, {-2.2, 3.1}, {4.1, -4.3}};
    const double h = 1e-4, young = 1e9, nu = 1.0 / 3;
    for (size_t k = 0; k < COUNT_OF(place); k++) {
        double u[4][2], s[4][3], here[3], at[2];
        accuracy_hole_compute_exact_solution(place[k], at, here);
        for (int end = 0; end < 4; end++) {
            double X[2] = {place[k][0], place[k][1]};
            X[end / 2] += end % 2 ? -h : h;
            accuracy_hole_compute_exact_solution(X, u[end], s[end]);
        }
        const double exx = (u[0][0] - u[1][0]) / (2 * h), eyy = (u[2][1] - u[3][1]) / (2 * h);
        const double exy = (u[2][0] - u[3][0] + u[0][1] - u[1][1]) / (4 * h);
        assert_true(fabs(young / (1 - nu * nu) * (exx + nu * eyy) - here[0]) <= 1e-5 * 1e4);
        assert_true(fabs(young / (1 - nu * nu) * (eyy + nu * exx) - here[1]) <= 1e-5 * 1e4);
        assert_true(fabs(young / (1 + nu) * exy - here[2]) <= 1e-5 * 1e4);
        assert_true(fabs(s[0][0] - s[1][0] + s[2][2] - s[3][2]) / (2 * h) <= 1e-4 * 1e4);
        assert_true(fabs(s[0][2] - s[1][2] + s[2][1] - s[3][1]) / (2 * h) <= 1e-4 * 1e4);
    }
}

/* ---- points ------------------------------------------------------------------------------------------------------ */

/* Returns the method called `name`; NULL if there is none. */
static const struct accuracy_method *method_called(const char *name)
{
    for (int m = 0; m < accuracy_methods; m++)
        if (!strcmp(accuracy_method[m].name, name)) return &accuracy_method[m];
    return NULL;
}

/* Coarse, quick runs of the bench and their measured errors. Tolerance 20 %: compilers round differently, and cracks
 * are sensitive to round-off. */
static const struct cheap {
    const struct accuracy_problem *problem;
    int at;
    const char *method;
    int resolution;
    double error;
} cheap[] = {{&accuracy_hole, 0, "pd bond", 40, 0.216},
             {&accuracy_hole, 0, "mpm reference", 40, 0.0201},
             {&accuracy_cracks, 0, "pd mospd", 32, 0.0287},
             {&accuracy_cracks, 1, "pd bond", 32, 0.0211},
             {&accuracy_cracks, 0, "mpm reference", 32, 0.0461},
             {&accuracy_sudden, 0, "mpm reference", 20, 0.00288},
             {&accuracy_sudden, 1, "pd bond", 20, 0.0771},
             {&accuracy_spall, 0, "pd bond", 200, 0.0403},
             {&accuracy_spall, 0, "adaptive reference", 200, 0.0208},
             {&accuracy_beam, 0, "pd bond", 5, 0.0063},
             {&accuracy_rod, 1, "pd bond", 5, 0.0562},
             {&accuracy_fracture, 0, "pd bond", 60, 0.177},
             {&accuracy_fracture, 1, "adaptive reference", 100, 0.0428}};

static void points_are_as_far_off_as_measured(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(cheap); k++) {
        const struct accuracy_method *method = method_called(cheap[k].method);
        assert_non_null(method);
        const struct accuracy_point p = {cheap[k].problem,
                                         method,
                                         cheap[k].at,
                                         cheap[k].resolution,
                                         method->family & ACCURACY_MPM ? 0 : ACCURACY_HORIZON,
                                         ACCURACY_STEP};
        struct accuracy_scene from;
        struct run e;
        struct scene s;
        double error, part[ACCURACY_PARTS];
        assert_true(!p.problem->applies || p.problem->applies(&p));
        accuracy_compose_scene_of_point(&p, &from);
        assert_int_equal(bench_engine_make(&e, &s, "test", from.text, bench_overrides_as_array(&from.set), from.set.n),
                         OK);
        assert_int_equal(p.problem->run ? p.problem->run(&p, &e) : run_advance_to_end_time(&e), OK);
        assert_int_equal(p.problem->measure(&p, &e, &error, part), OK);
        if (fabs(error / cheap[k].error - 1) > 0.2)
            fail_msg("%s, %s %d: error %g, %g was measured", p.problem->name, method->name, p.resolution, error,
                     cheap[k].error);
        bench_engine_free(&e, &s);
    }
}

/* Checks that the reference solutions that the bench uses deviate from the finest ones by no more than the header of
 * the bench states: angles by 0.043 rms, lengths by 2.2 %, start times by 0.9 %, speeds by 1.4 %. */
static void references_converge(void **state)
{
    (void)state;
    for (int at = 0; at < 2; at++) {
        const struct fracture *f = fracture_reference[at], *finest = &f[FRACTURE_SPACINGS - 1],
                              *used = &f[FRACTURE_QUARTER];
        double beside = 0;
        for (int r = 0; r < FRACTURE_RINGS; r++) beside += pow(used->angle[r] - finest->angle[r], 2) / FRACTURE_RINGS;
        assert_true(sqrt(beside) <= 0.043 && fabs(used->length / finest->length - 1) <= 0.022);
        assert_true(fabs(used->start / finest->start - 1) <= 0.009 && fabs(used->speed / finest->speed - 1) <= 0.014);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_are_sound),
        cmocka_unit_test(hole_is_free_and_edges_are_pulled),
        cmocka_unit_test(hole_is_elastic_and_in_balance),
        cmocka_unit_test(points_are_as_far_off_as_measured),
        cmocka_unit_test(references_converge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
