/* Tests of crack-tip fields and of the interaction integral, evaluated for exact fields. */
#include <math.h>

#include "tests/support/glass.h"
#include "tests/support/near.h"
#include "fracture/sif.h"

/* ---- fields ------------------------------------------------------------------------------------------------------ */

/* Returns the largest difference of the states a and b, relative to the largest entry of b, for gradients and stresses
 * each; the larger of both. */
static real state_difference(const struct crack_state *a, const struct crack_state *b)
{
    real d[2] = {0}, size[2] = {0};
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            d[0] = real_max(d[0], fabs(a->gradient[i][j] - b->gradient[i][j]));
            d[1] = real_max(d[1], fabs(a->stress[i][j] - b->stress[i][j]));
            size[0] = real_max(size[0], fabs(b->gradient[i][j])), size[1] = real_max(size[1], fabs(b->stress[i][j]));
        }
    return real_max(d[0] / size[0], d[1] / size[1]);
}

/* Checks the crack-tip field of mode `mode` at the tip speed v [m/s] in the medium m by finite differences. Gradients
 * are those of the displacements; stresses satisfy the equation of motion and vanish on the crack faces; the stress
 * ahead of the tip is 1/sqrt(2 pi r) for a unit stress-intensity factor. */
static void field_is_a_solution(const struct crack_medium *m, enum crack_mode mode, real v)
{
    const real e = 1e-5;
    struct crack_field here, to[2][2], face;
    for (int k = 0; k < 7; k++) {
        const real theta = 0.9 * pi * (k - 3) / 3.0, x[2] = {2 * cos(theta), 2 * sin(theta)};
        crack_tip_unit_sif_field_at_any_speed(m, mode, v, x, &here);
        for (int j = 0; j < 2; j++)
            for (int side = 0; side < 2; side++) {
                real y[2] = {x[0], x[1]};
                y[j] += side ? e : -e;
                crack_tip_unit_sif_field_at_any_speed(m, mode, v, y, &to[j][side]);
            }
        const real size = fabs(here.state.gradient[0][0]) + fabs(here.state.gradient[1][0]);
        for (int i = 0; i < 2; i++) {
            real balance = -m->density * here.state.acceleration[i];
            for (int j = 0; j < 2; j++) {
                balance += (to[j][1].state.stress[i][j] - to[j][0].state.stress[i][j]) / (2 * e);
                assert_near((to[j][1].displacement[i] - to[j][0].displacement[i]) / (2 * e), here.state.gradient[i][j],
                            1e-8 * size);
            }
            assert_near(balance, 0, 1e-8); /* for stresses of 0.3 Pa; finite differences cost half the digits */
            assert_near((to[0][1].state.velocity[i] - to[0][0].state.velocity[i]) / (2 * e),
                        here.state.velocity_along[i], 1e-8 * size * (v + 1));
        }
    }
    for (int sign = -1; sign <= 1; sign += 2) {
        crack_tip_unit_sif_field_at_any_speed(m, mode, v, (real[2]){-2, copysign(0, sign)}, &face);
        assert_near(face.state.stress[0][1], 0, 1e-12);
        assert_near(face.state.stress[1][1], 0, 1e-12);
    }
    crack_tip_unit_sif_field_at_any_speed(m, mode, v, (real[2]){2, 0}, &here);
    assert_near(here.state.stress[mode == MODE_I ? 1 : 0][1] * sqrt(2 * pi * 2), 1, 1e-12);
}

static void fields_solve_the_equations_of_motion(void **state)
{
    (void)state;
    for (int thin = 0; thin < 2; thin++) {
        const struct crack_medium m = glass(thin ? SPACE_PLANE_STRESS : SPACE_PLANE_STRAIN);
        for (int mode = 0; mode < MODES; mode++)
            for (int k = 0; k < 4; k++) field_is_a_solution(&m, mode, 900.0 * k);
    }
}

/* Checks that the moving field tends to the static one at low speed: at 0.01 c_s, where the formulas change, the
 * difference is below 2e-4, at 0.1 c_s above 1e-3 (it is of the order (v/c_s)^2). */
static void fields_meet_at_low_speed(void **state)
{
    (void)state;
    const struct crack_medium m = glass(SPACE_PLANE_STRAIN);
    struct crack_field rest, moving;
    for (int mode = 0; mode < MODES; mode++)
        for (int k = 0; k < 5; k++) {
            const real theta = 0.45 * pi * (k - 2), x[2] = {cos(theta), sin(theta)};
            crack_tip_unit_sif_field_at_any_speed(&m, mode, 0, x, &rest);
            crack_tip_unit_sif_field_moving(&m, mode, 0.01 * m.shear_speed, x, &moving);
            assert_true(state_difference(&moving.state, &rest.state) < 2e-4);
            crack_tip_unit_sif_field_moving(&m, mode, 0.1 * m.shear_speed, x, &moving);
            assert_true(state_difference(&moving.state, &rest.state) > 1e-3);
        }
}

static void numbers_of_the_glass_at_a_kilometre_per_second(void **state)
{
    (void)state;
    const struct crack_medium m = glass(SPACE_PLANE_STRAIN);
    assert_near(m.longitudinal, 6320.3, 0.05);
    assert_near(m.shear_speed, 3460.1, 0.05);
    assert_near(m.rayleigh, 3201.4, 0.05);
    assert_near(crack_tip_speed_universal_function(&m, MODE_I, 1000), 1.06758, 5e-6);
    assert_near(crack_tip_speed_universal_function(&m, MODE_II, 1000), 1.03506, 5e-6);
    assert_near(crack_moving_to_resting_sif_ratio(&m, SPEED_EXACT, 1000), 0.8022, 5e-5);
    assert_near(crack_moving_to_resting_sif_ratio(&m, SPEED_APPROXIMATE, 1000), 0.7495, 5e-5);
    assert_close(crack_moving_to_resting_sif_ratio(&m, SPEED_ROSE, 1000),
                 crack_moving_to_resting_sif_ratio(&m, SPEED_EXACT, 1000), 0.005);
    for (int form = 0; form < 3; form++) {
        assert_near(crack_moving_to_resting_sif_ratio(&m, form, 0), 1, 1e-14);
        assert_near(crack_moving_to_resting_sif_ratio(&m, form, m.rayleigh), 0, 1e-6);
    }
    for (int mode = 0; mode < MODES; mode++)
        assert_near(crack_tip_speed_universal_function(&m, mode, 0.0101 * m.shear_speed), 1, 1e-4);
    /* K_I/(sigma_0 sqrt(pi a)), a = 12 mm, 9 us after the load, with a wave that has travelled 20 mm. */
    const real arrival = 0.02 / m.longitudinal;
    assert_near(arrival, 3.164e-6, 1e-9);
    assert_near(crack_sif_after_plane_wave(&m, 1, 9e-6 - arrival) / sqrt(pi * 0.012), 1.0226, 1e-4);
    assert_exact(crack_sif_after_plane_wave(&m, 1, -1e-6), 0);
}

static void constants_of_the_medium(void **state)
{
    (void)state;
    const struct crack_medium thin = glass(SPACE_PLANE_STRESS), thick = glass(SPACE_PLANE_STRAIN);
    for (int k = 0; k < 2; k++) { /* 8 G/E* = kappa + 1 in both */
        const struct crack_medium *m = k ? &thick : &thin;
        assert_close(8 * m->shear / m->modulus, m->kappa + 1, 1e-14);
        assert_close(m->lambda, m->shear * (3 - m->kappa) / (m->kappa - 1), 1e-14);
    }
    assert_close(thin.modulus, 75.629e9, 1e-15);
}

/* Checks that the hoop stress of the static fields is largest in the direction of crack_kink_angle_from_sif, and that
 * this largest stress has the factor crack_equivalent_sif. */
static void direction_is_that_of_the_largest_hoop_stress(void **state)
{
    (void)state;
    const struct crack_medium m = glass(SPACE_PLANE_STRESS);
    const real K[][MODES] = {{1, 0}, {1, 1e-9}, {1, 0.1}, {1, -0.5}, {0.2, 1}, {0, 1}, {0, -1}, {-0.3, 1}};
    for (size_t k = 0; k < COUNT_OF(K); k++) {
        enum { ANGLES = 20000 };
        real best = -INFINITY, at = 0;
        for (int n = 1; n < ANGLES; n++) {
            const real theta = pi * (2.0 * n / ANGLES - 1), c = cos(theta), s = sin(theta);
            struct crack_field f[MODES];
            real hoop = 0;
            for (int mode = 0; mode < MODES; mode++) {
                crack_tip_unit_sif_field_at_rest(&m, mode, (real[2]){c, s}, &f[mode]);
                const struct crack_state *t = &f[mode].state;
                hoop += K[k][mode] * (t->stress[0][0] * s * s + t->stress[1][1] * c * c - 2 * t->stress[0][1] * s * c);
            }
            if (hoop > best) best = hoop, at = theta;
        }
        assert_near(crack_kink_angle_from_sif(K[k]), at, 2 * pi / ANGLES);
        assert_near(crack_equivalent_sif(K[k]), best * sqrt(2 * pi), 1e-6); /* quadratic in the step of the angles */
    }
    assert_near(crack_kink_angle_from_sif((const real[]){1, 1e-200}), -2e-200, 1e-210);
    assert_exact(crack_kink_angle_from_sif((const real[]){1, 0}), 0);
}

/* ---- interaction integral of exact fields ------------------------------------------------------------------------ */

/* Points and weights of Gauss quadrature with five points in [0, 1]. */
static const real gauss_place[] = {0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                   0.95308992296933200};
static const real gauss_weight[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                    0.11846344252809454};

/* Returns the interaction integral I of the exact fields of two modes, `actual` and `auxiliary`, at `tip` over the
 * contour c. Quadrature: Gauss panels in the radius; equidistant points in the angle, which converge exponentially
 * since products of two fields are periodic. The disc within 1e-3 of the inner radius is left out: the domain term
 * vanishes there. */
static real integral(const struct sif_tip *tip, const struct contour *c, enum crack_mode actual,
                     enum crack_mode auxiliary)
{
    enum { RINGS = 4, ANGLES = 400, POINTS = 5 };
    const real bound[] = {1e-3 * c->inner, c->inner, c->outer};
    real sum = 0;
    for (int n = 0; n < 2 * RINGS * POINTS * ANGLES; n++) {
        const int part = n % 2, ring = n / 2 % RINGS, a = n / 2 / RINGS % POINTS, b = n / 2 / RINGS / POINTS;
        const real width = (bound[part + 1] - bound[part]) / RINGS, step = 2 * pi / ANGLES;
        const real r = bound[part] + width * (ring + gauss_place[a]), theta = step * (b + 0.5) - pi;
        const real x[2] = {r * cos(theta), r * sin(theta)};
        struct crack_field f[2];
        crack_tip_unit_sif_field_at_any_speed(&tip->medium, actual, tip->speed, x, &f[0]);
        crack_tip_unit_sif_field_at_any_speed(&tip->medium, auxiliary, tip->speed, x, &f[1]);
        sum +=
            gauss_weight[a] * width * step * r * sif_interaction_integrand(tip, c, x, &f[0].state, &f[1].state, true);
    }
    return sum;
}

/* Checks that I times half of the effective modulus is the universal function of the tip speed (A_I or A_II, Freund
 * 1990), for every weight function and contour, and 0 for two different modes. */
static void exact_fields_return_the_universal_functions(void **state)
{
    (void)state;
    const struct contour contour[] = {{1, 2}, {0.3, 3}};
    const real speed[] = {0, 500, 1000, 2000, 3000};
    for (int thin = 0; thin < 2; thin++)
        for (size_t n = 0; n < COUNT_OF(speed); n++)
            for (int form = 0; form < 3; form++) {
                const struct contour *c = &contour[(n + form) % 2];
                const struct sif_tip tip = {
                    .medium = glass(thin ? SPACE_PLANE_STRESS : SPACE_PLANE_STRAIN), .speed = speed[n], .weight = form};
                for (int mode = 0; mode < MODES; mode++) {
                    const real I = integral(&tip, c, mode, mode),
                               A = crack_tip_speed_universal_function(&tip.medium, mode, tip.speed);
                    assert_near(0.5 * tip.medium.modulus * I / A, 1, 1e-10);
                }
                assert_near(0.5 * tip.medium.modulus * integral(&tip, c, MODE_I, MODE_II), 0, 1e-10);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_solve_the_equations_of_motion),
        cmocka_unit_test(fields_meet_at_low_speed),
        cmocka_unit_test(numbers_of_the_glass_at_a_kilometre_per_second),
        cmocka_unit_test(constants_of_the_medium),
        cmocka_unit_test(direction_is_that_of_the_largest_hoop_stress),
        cmocka_unit_test(exact_fields_return_the_universal_functions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
