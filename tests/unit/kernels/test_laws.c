/* Flow laws and their return mapping compared with a plain, slow twin, with closed forms and with published cases; the
 * energy balance of one element. */
#include "tests/support/near.h"

#include "kernels/laws/flows.h"
#include "kernels/laws/law_update.h"
#include "tests/support/cloud.h"
#include "tests/support/law_reference.h"
#include "tests/support/sets.h"

#define MPA 1e6

static const enum space spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};

/* Returns the law of a material with the given elastic constants [Pa] [1] and yield stress [Pa]. */
static struct law completed(struct law law, real young, real poisson, real yield, real density)
{
    law.given = true;
    law_compute_constants(&law, yield, young, poisson, young / (2 * (1 + poisson)), density);
    return law;
}

/* Steel with each flow law. */
static struct law steel(enum flow flow)
{
    struct law law = {.flow = flow,
                      .hardening = 1000 * MPA,
                      .voce = {150 * MPA, 20},
                      .power = {292 * MPA, 0.31},
                      .table = {.points = 3, .strain = {0, 0.01, 0.05}, .stress = {200 * MPA, 260 * MPA, 320 * MPA}},
                      .johnson_cook = {90 * MPA, 292 * MPA, 0.31, 0.025, 1.09, 1, 294, 1356}};
    return completed(law, 200e9, 0.3, 200 * MPA, 7800);
}

/* Copper of Johnson & Cook 1983, which heats. */
static struct law copper(real m)
{
    struct law law = {.flow = FLOW_JOHNSON_COOK,
                      .johnson_cook = {90 * MPA, 292 * MPA, 0.31, 0.025, m, 1, 294, 1356},
                      .specific_heat = 383,
                      .taylor_quinney = 0.9};
    return completed(law, 117e9, 0.35, 0, 8960);
}

/* ---- functions --------------------------------------------------------------------------------------------------- */

/* Errors of logarithm, exponential and power: a few roundings of 1.1e-16, of powers times |b log a|. */
static void test_functions(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int k = 0; k < 200000; k++) {
        const real exponent = cloud_between(&seed, -690, 690), near = 1 + cloud_between(&seed, -0.4, 0.4);
        const real a = exp(exponent), b = cloud_between(&seed, 0.1, 1), base = exp(cloud_between(&seed, -20, 2));
        assert_close(lanes_log(lanes_of(a))[0], logl(a), 6e-16);
        assert_close(lanes_log(lanes_of(near))[3], logl(near), 6e-16);
        assert_close(lanes_exp(lanes_of(exponent))[1], expl(exponent), 3e-16);
        assert_close(lanes_power(lanes_of(base), b)[2], powl(base, b), 3e-16 + 6e-16 * fabs(b * log(base)));
    }
    assert_exact(lanes_log(lanes_of(1))[0], 0);
    assert_exact(lanes_exp(lanes_of(0))[0], 1);
    assert_exact(lanes_power(lanes_of(0), 0.1)[0], 0);
}

/* Stress, slope (central difference), work (Simpson's rule) and reach of each law at random strains. */
static void test_flow_laws(void **state)
{
    (void)state;
    uint64_t seed = 4;
    for (int flow = 0; flow < FLOW_LAWS; flow++)
        for (int k = 0; k < 2000; k++) {
            const struct law m = steel(flow);
            const real a = exp(cloud_between(&seed, -9, 0)), rate = exp(cloud_between(&seed, -3, 12));
            const real T = cloud_between(&seed, 200, 1300), step = 1e-5 * a;
            lanes slope;
            const lanes stress = flow_stress(&m, lanes_of(a), lanes_of(rate), lanes_of(T), &slope);
            assert_close(stress[5], reference_stress(&m, a, rate, T), 5e-15);
            const real rise = reference_stress(&m, a + step, rate, T) - reference_stress(&m, a - step, rate, T);
            const bool kink = flow == FLOW_TABLE && (fabs(a - 0.01) <= step || fabs(a - 0.05) <= step);
            if (!kink) assert_near(slope[2], rise / (2 * step), 1e-8 * stress[0] / a + 1e-9 * slope[2]);
            const real reach = flow_reach(&m, stress, lanes_of(rate), lanes_of(T))[1];
            assert_true(reach >= a * (1 - 1e-12)); /* powers 1/n of roundings */
            const lanes upper = flow_work(&m, lanes_of(a + step)), lower = flow_work(&m, lanes_of(a - step));
            const real mean = (reference_stress(&m, a + step, 0, 294) + 4 * reference_stress(&m, a, 0, 294) +
                               reference_stress(&m, a - step, 0, 294)) /
                              6;
            if (!kink) assert_close((upper[0] - lower[0]) / (2 * step), mean, 1e-9 + 1e-12 / a); /* cancellation */
        }
}

/* ---- one step against the slow twin ------------------------------------------------------------------------------ */

/* Returns points whose eight lanes are alike, at rest. */
static struct law_points points_at_rest(void)
{
    struct law_points p;
    memset(&p, 0, sizeof p);
    p.volume_before = p.volume = lanes_of(1);
    p.rate = lanes_of(1), p.temperature = lanes_of(294);
    p.active = (lanes_mask){0} - 1;
    return p;
}

/* Fills a random trial state of a size [Pa]; components that the space does not have are 0. */
static struct reference_point random_trial(uint64_t *seed, enum space space, const struct law *m)
{
    struct reference_point p = {.a = cloud_between(seed, 0, 1) < 0.3 ? 0 : exp(cloud_between(seed, -9, -1))};
    const real size = m->yield * exp(cloud_between(seed, -1, 6));
    const int n = space == SPACE_LINE ? 1 : space == SPACE_SOLID ? 6 : 4;
    for (int c = 0; c < n; c++) {
        p.s[c] = size * cloud_between(seed, -1, 1);
        p.back[c] = m->kinematic.modulus > 0 ? 0.3 * m->yield * cloud_between(seed, -1, 1) : 0;
    }
    if (space == SPACE_PLANE_STRESS) p.s[2] = 0;
    if (space == SPACE_LINE)
        p.back[1] = p.back[2] = -0.5 * p.back[0];
    else
        p.back[2] = -p.back[0] - p.back[1];
    return p;
}

/* Compares a load step with bisection, in the spaces that have a twin. */
static void compare(const struct law *m, enum space space, uint64_t *seed)
{
    struct reference_point p = random_trial(seed, space, m);
    struct law_points eight = points_at_rest();
    const real rate = exp(cloud_between(seed, -3, 12)), T = cloud_between(seed, 294, 900);
    const real size = fabs(p.s[0]) + fabs(p.s[1]) + fabs(p.s[2]) + fabs(p.s[3]) + m->yield;
    for (int c = 0; c < SYM_MAX; c++) eight.s[c] = lanes_of(p.s[c]), eight.back[c] = lanes_of(p.back[c]);
    eight.a = lanes_of(p.a), eight.rate = lanes_of(rate), eight.temperature = lanes_of(T);
    eight.active[6] = 0;
    const struct law_points before = eight;
    law_update(m, &eight, space, LAW_LOAD_STEP);
    if (space == SPACE_PLANE_STRESS)
        reference_return_plane_stress(m, &p, rate, T);
    else
        reference_return(m, &p, rate, T);
    for (int c = 0; c < SYM_MAX; c++) {
        if (space == SPACE_PLANE_STRESS && c == 2) continue;
        assert_near(eight.s[c][1], p.s[c], 3e-14 * size); /* some hundred roundings */
        if (m->kinematic.modulus > 0) assert_near(eight.back[c][1], p.back[c], 3e-14 * size);
        assert_exact(eight.s[c][6], before.s[c][6]); /* a lane of another law */
    }
    assert_near(eight.a[1], p.a, 3e-14 * (size / m->young + p.a));
    assert_exact(eight.a[6], before.a[6]);
}

static void test_load_steps(void **state)
{
    (void)state;
    FOR_EVERY_SET
    {
        uint64_t seed = 11;
        for (int flow = 0; flow < FLOW_LAWS; flow++)
            for (int kinematic = 0; kinematic < 3; kinematic++)
                for (int k = 0; k < 300; k++) {
                    struct law m = steel(flow);
                    if (kinematic > 0) m.kinematic.modulus = 40e9;
                    if (kinematic > 1) m.kinematic.recall = 300;
                    compare(&m, SPACE_SOLID, &seed), compare(&m, SPACE_PLANE_STRAIN, &seed);
                    if (k < 30) compare(&m, SPACE_PLANE_STRESS, &seed);
                }
    }
}

/* Powers with the exponent 0.1 are the steepest: their first step from a = 0 has the root far from both bounds. */
static void test_steep_power(void **state)
{
    (void)state;
    uint64_t seed = 12;
    struct law m = {.flow = FLOW_POWER, .power = {292 * MPA, 0.1}};
    m = completed(m, 117e9, 0.35, 90 * MPA, 8960);
    for (int k = 0; k < 2000; k++) compare(&m, SPACE_SOLID, &seed);
}

/* ---- energy ------------------------------------------------------------------------------------------------------ */

/* Adds the stress of a strain increment to a state in a space. Strains: tensor components; normal ones across the plane
 * or bar are left out where the space leaves them free. */
static void load(const struct law *m, struct law_points *p, const real *strain, enum space space)
{
    const real G = m->shear, nu = m->poisson, E = m->young;
    const real lame = space == SPACE_PLANE_STRESS ? E * nu / (1 - nu * nu) : E * nu / ((1 + nu) * (1 - 2 * nu));
    for (int c = 0; c < SYM_MAX; c++) p->before[c] = p->s[c];
    if (space == SPACE_LINE) {
        p->s[0] += E * strain[0];
        return;
    }
    const real across = space == SPACE_SOLID ? strain[2] : 0, trace = strain[0] + strain[1] + across;
    p->s[0] += lame * trace + 2 * G * strain[0], p->s[1] += lame * trace + 2 * G * strain[1];
    if (space != SPACE_PLANE_STRESS) p->s[2] += lame * trace + 2 * G * across;
    for (int c = 3; c < (space == SPACE_SOLID ? 6 : 4); c++) p->s[c] += 2 * G * strain[c];
}

/* Returns the elastic energy density of lane 0 [J/m^3]. */
static real elastic_energy(const struct law *m, const struct law_points *p)
{
    real squares = 0, trace = 0;
    for (int c = 0; c < SYM_MAX; c++) squares += (c < 3 ? 1 : 2) * square(p->s[c][0]), trace += c < 3 ? p->s[c][0] : 0;
    return 0.5 / m->young * ((1 + m->poisson) * squares - m->poisson * square(trace));
}

/* Strains at random, to and fro, in both modes: the work of leap-frog steps is elastic energy and plastic work, to a
 * few roundings of the work that goes in and out. */
static void test_energy(void **state)
{
    (void)state;
    for (int flow = 0; flow < FLOW_LAWS; flow++)
        for (int s = 0; s < 4; s++)
            for (int mode = 0; mode < 4; mode++) {
                struct law m = steel(flow);
                struct law_points p = points_at_rest();
                uint64_t seed = 21;
                real work = 0, moved = 0;
                if (mode > 1) m.kinematic.modulus = 40e9, m.kinematic.recall = 300;
                for (int k = 0; k < 500; k++) {
                    real strain[SYM_MAX];
                    for (int c = 0; c < SYM_MAX; c++) strain[c] = 2e-3 * cloud_between(&seed, -1, 1);
                    load(&m, &p, strain, spaces[s]);
                    law_update(&m, &p, spaces[s], mode % 2 ? LAW_LOAD_STEP : LAW_EXPLICIT);
                    const int n = spaces[s] == SPACE_LINE ? 1 : spaces[s] == SPACE_SOLID ? 6 : 4;
                    for (int c = 0; c < n; c++) {
                        if (c == 2 && spaces[s] != SPACE_SOLID) continue;
                        const real one = (c < 3 ? 0.5 : 1) * (p.before[c][0] + p.s[c][0]) * strain[c];
                        work += one, moved += fabs(one);
                    }
                }
                assert_true(p.a[0] > 0.1 && p.work[0] > 0);
                assert_near(work, elastic_energy(&m, &p) + p.work[0], 1e-14 * moved);
            }
}

/* ---- closed forms ------------------------------------------------------------------------------------------------ */

/* Loads a bar by `steps` equal explicit steps to the strain `to`, from *strain. */
static void bar_load(const struct law *m, struct law_points *p, real *strain, real to, int steps)
{
    const real step[SYM_MAX] = {(to - *strain) / steps};
    for (int k = 0; k < steps; k++) {
        load(m, p, step, SPACE_LINE);
        law_update(m, p, SPACE_LINE, LAW_EXPLICIT);
    }
    *strain = to;
}

/* Voce 200 + 150 (1 - exp(-20 a)) MPa, E = 200 GPa: stress and work of a bar in tension, from the equation strain =
 * sigma/E + a. Tolerance: the digits of the numbers; the work by its trapezoids. */
static void test_voce_bar(void **state)
{
    (void)state;
    const struct law m = steel(FLOW_VOCE);
    struct law_points p = points_at_rest();
    real strain = 0;
    bar_load(&m, &p, &strain, 0.01, 10000);
    assert_near(p.s[0][0] / MPA, 224.403, 6e-4);
    bar_load(&m, &p, &strain, 0.05, 10000);
    assert_near(p.s[0][0] / MPA, 293.176, 6e-4);
    assert_near(p.work[0] / MPA, 12.3281, 1e-4);
    assert_close(p.work[0], flow_work(&m, p.a)[0], 1e-5);
}

/* A curve through points: exact on its segments, to the first order in the step at its corners. */
static void test_table_bar(void **state)
{
    (void)state;
    const struct law m = steel(FLOW_TABLE);
    struct law_points p = points_at_rest();
    real strain = 0;
    bar_load(&m, &p, &strain, 0.008, 100);
    assert_close(p.s[0][0], (200 + 6000 * p.a[0]) * MPA, 1e-13);
    bar_load(&m, &p, &strain, 0.04, 100);
    assert_close(p.s[0][0], (245 + 1500 * p.a[0]) * MPA, 1e-13);
    bar_load(&m, &p, &strain, 0.2, 100);
    assert_close(p.s[0][0], 320 * MPA, 1e-13);
}

/* Prager, C = 10 GPa, 200 MPa, strains +-0.01: the stress is +-(200 + C (0.01 - stress/E)) from the first cycle. */
static void test_prager(void **state)
{
    (void)state;
    struct law m = steel(FLOW_LINEAR);
    struct law_points p = points_at_rest();
    real strain = 0;
    m.hardening = 0, m.kinematic.modulus = 10e9;
    for (int cycle = 0; cycle < 3; cycle++) {
        bar_load(&m, &p, &strain, 0.01, 100);
        assert_near(p.s[0][0] / MPA, 285.714, 6e-4);
        bar_load(&m, &p, &strain, -0.01, 100);
        assert_near(p.s[0][0] / MPA, -285.714, 6e-4);
    }
}

/* Loads a bar by explicit steps until its stress is `to` [Pa]; the last step is shortened by bisection. */
static void bar_pull(const struct law *m, struct law_points *p, real *strain, real to)
{
    const real sign = to > p->s[0][0] ? 1 : -1;
    real step = 1e-6;
    while (step > 1e-15) {
        struct law_points next = *p;
        const real more[SYM_MAX] = {sign * step};
        load(m, &next, more, SPACE_LINE);
        law_update(m, &next, SPACE_LINE, LAW_EXPLICIT);
        if (sign * (next.s[0][0] - to) > 0) {
            step *= 0.5;
            continue;
        }
        *p = next, *strain += more[0];
    }
}

/* Armstrong & Frederick, 200 MPa, C = 40 GPa, gamma = 300: first and stable stress at strains +-0.01 (k + C/gamma
 * tanh(gamma eps_p/2)), and ratcheting of a bar between 300 and -200 MPa. Tolerance: the digits of the numbers, and
 * steps of 1e-6 over 1/gamma. */
static void test_armstrong_frederick(void **state)
{
    (void)state;
    struct law m = steel(FLOW_LINEAR);
    struct law_points p = points_at_rest();
    real strain = 0, before = 0;
    m.hardening = 0, m.kinematic.modulus = 40e9, m.kinematic.recall = 300;
    bar_load(&m, &p, &strain, 0.01, 10000);
    assert_near(p.s[0][0] / MPA, 322.56, 0.03);
    for (int cycle = 0; cycle < 5; cycle++) {
        bar_load(&m, &p, &strain, -0.01, 20000);
        bar_load(&m, &p, &strain, 0.01, 20000);
    }
    assert_near(p.s[0][0] / MPA, 331.56, 0.03);
    p = points_at_rest(), strain = 0;
    for (int cycle = 0; cycle < 4; cycle++) {
        before = strain;
        bar_pull(&m, &p, &strain, 300 * MPA), bar_pull(&m, &p, &strain, -200 * MPA);
    }
    assert_close(strain - before, 2.75560e-3, 1e-3);
}

/* Tension in plane strain with a free face: strains xx in explicit steps of 1e-5, yy such that no stress yy is left.
 * Stores the stresses where xx is `at`. */
static void sheet_pull(const struct law *m, struct law_points *p, real at, real *first)
{
    const real step = 1e-5;
    *first = 0;
    for (int k = 0; k < (int)round(at / step); k++) {
        real low = -3 * step, high = 3 * step;
        struct law_points next;
        for (int times = 0; times < 60; times++) {
            const real strain[SYM_MAX] = {step, 0.5 * (low + high)};
            next = *p;
            load(m, &next, strain, SPACE_PLANE_STRAIN);
            law_update(m, &next, SPACE_PLANE_STRAIN, LAW_EXPLICIT);
            if (next.s[1][0] > 0)
                high = strain[1];
            else
                low = strain[1];
        }
        if (next.a[0] == 0) *first = next.s[0][0];
        *p = next;
    }
}

/* Plane strain tension, E = 200 GPa, nu = 0.3, 250 MPa: first yield at 281.272 MPa (one step has 2.2 MPa), and the
 * stresses after plastic flow. Tolerance: the direction of flow changes by 1e-5/1e-3 over a step, and errors of the
 * steps do not add up. */
static void test_plane_strain_tension(void **state)
{
    (void)state;
    struct law m = {.flow = FLOW_LINEAR};
    struct law_points p = points_at_rest();
    real first;
    m = completed(m, 200e9, 0.3, 250 * MPA, 7800);
    sheet_pull(&m, &p, 0.005, &first);
    assert_near(first / MPA, 281.272 - 1.1, 1.2);
    assert_near(p.s[0][0] / MPA, 288.665, 0.01);
    assert_near(p.s[2][0] / MPA, 142.289, 0.2);
    assert_near(p.a[0], 4.2090e-3, 2e-5);
    m.hardening = 1000 * MPA, p = points_at_rest();
    sheet_pull(&m, &p, 0.02, &first);
    assert_near(p.s[0][0] / MPA, 313.376, 0.02);
    assert_near(p.s[2][0] / MPA, 156.376, 0.02);
}

/* Stretches a point without change of volume at 1000/s in explicit steps until its plastic strain is `to`; stress and
 * temperature there by interpolation. */
static void heat(const struct law *m, real to, real *stress, real *temperature)
{
    const real step = 1e-4, strain[SYM_MAX] = {step, -0.5 * step, -0.5 * step};
    struct law_points p = points_at_rest(), next = p;
    p.rate = next.rate = lanes_of(1000);
    while (next.a[0] < to) {
        p = next;
        load(m, &next, strain, SPACE_SOLID);
        law_update(m, &next, SPACE_SOLID, LAW_EXPLICIT);
    }
    const real share = (to - p.a[0]) / (next.a[0] - p.a[0]);
    *stress = (1 - share) * (p.s[0][0] - p.s[1][0]) + share * (next.s[0][0] - next.s[1][0]);
    *temperature = (1 - share) * p.temperature[0] + share * next.temperature[0];
}

/* Johnson-Cook with adiabatic heating. For m = 1 in closed form, T* = 1 - exp(-beta R W/(rho c (T_melt - T_room))) with
 * the work W of the law at the reference rate and R = 1 + C log(rate/eps0). Tolerance: 0.02 MPa and 0.01 K for the
 * steps of 1e-4, at which the temperature is that of the start. */
static void test_johnson_cook(void **state)
{
    (void)state;
    static const real rows[][3] = {{0.2, 309.393, 307.771}, {0.5, 367.131, 334.689}, {1, 409.161, 386.002}};
    const struct law m = copper(1), other = copper(1.09);
    real stress, temperature;
    for (int k = 0; k < 3; k++) {
        heat(&m, rows[k][0], &stress, &temperature);
        assert_near(stress / MPA, rows[k][1], 0.02);
        assert_near(temperature, rows[k][2], 0.01);
    }
    heat(&other, 1, &stress, &temperature);
    assert_near(stress / MPA, 416.478, 0.02);
    assert_near(temperature, 386.955, 0.01);
    struct law hard = {.flow = FLOW_JOHNSON_COOK,
                       .johnson_cook = {792 * MPA, 510 * MPA, 0.26, 0.014, 1.03, 1, 294, 1793},
                       .specific_heat = 477,
                       .taylor_quinney = 0.9};
    hard = completed(hard, 200e9, 0.29, 0, 7830);
    heat(&hard, 0.5, &stress, &temperature);
    assert_near(stress / MPA, 1217.20, 0.02);
    assert_near(temperature, 436.69, 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_functions),
        cmocka_unit_test(test_flow_laws),
        cmocka_unit_test(test_load_steps),
        cmocka_unit_test(test_steep_power),
        cmocka_unit_test(test_energy),
        cmocka_unit_test(test_voce_bar),
        cmocka_unit_test(test_table_bar),
        cmocka_unit_test(test_prager),
        cmocka_unit_test(test_armstrong_frederick),
        cmocka_unit_test(test_plane_strain_tension),
        cmocka_unit_test(test_johnson_cook),
    };
    return cmocka_run_group_tests_name("laws", tests, NULL, NULL);
}
