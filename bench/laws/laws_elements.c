/* Single elements with the laws of metals, driven through the return mapping (kernels/laws/law_update.h) in explicit
 * steps: `cleave bench laws`, and tests of the laws. */
#include <math.h>

#include "laws_bench.h"

struct law laws_law_with_derived_constants(struct law law, real young, real poisson, real yield, real density)
{
    law.given = true;
    flow_law_compute_derived_constants(&law, yield, young, poisson, young / (2 * (1 + poisson)), density);
    return law;
}

struct law laws_steel(enum flow flow)
{
    const struct law law = {
        .flow = flow,
        .hardening = 1000 * MPA,
        .voce = {150 * MPA, 20},
        .power = {292 * MPA, 0.31},
        .table = {.points = 3, .strain = {0, 0.01, 0.05}, .stress = {200 * MPA, 260 * MPA, 320 * MPA}},
        .johnson_cook = {90 * MPA, 292 * MPA, 0.31, 0.025, 1.09, 1, 294, 1356}};
    return laws_law_with_derived_constants(law, 200e9, 0.3, 200 * MPA, 7800);
}

/* Returns a law of steel with kinematic hardening only. modulus, recall: constants C [Pa] and gamma [1] of the
 * evolution of the back stress by Armstrong & Frederick. */
static struct law steel_kinematic(real modulus, real recall)
{
    struct law m = laws_steel(FLOW_LINEAR);
    m.hardening = 0, m.kinematic.modulus = modulus, m.kinematic.recall = recall;
    return m;
}

struct law_points laws_points_at_rest(void)
{
    struct law_points p = {.active = (lanes_mask){0} - 1};
    for (int c = 0; c < SYM_MAX; c++) p.s[c] = p.before[c] = p.back[c] = lanes_broadcast(0);
    p.a = p.work = lanes_broadcast(0);
    p.volume_before = p.volume = lanes_broadcast(1);
    p.temperature = lanes_broadcast(294);
    return p;
}

void laws_add_elastic_stress_of_increment(const struct law *law, struct law_points *points,
                                          const real *strain_increment, enum space space)
{
    const real G = law->shear, nu = law->poisson, E = law->young;
    const real lame = space == SPACE_PLANE_STRESS ? E * nu / (1 - nu * nu) : E * nu / ((1 + nu) * (1 - 2 * nu));
    for (int c = 0; c < SYM_MAX; c++) points->before[c] = points->s[c];
    if (space == SPACE_LINE) {
        points->s[0] += E * strain_increment[0];
        return;
    }
    const real across = space == SPACE_SOLID ? strain_increment[2] : 0,
               trace = strain_increment[0] + strain_increment[1] + across;
    points->s[0] += lame * trace + 2 * G * strain_increment[0],
        points->s[1] += lame * trace + 2 * G * strain_increment[1];
    if (space != SPACE_PLANE_STRESS) points->s[2] += lame * trace + 2 * G * across;
    for (int c = 3; c < (space == SPACE_SOLID ? 6 : 4); c++) points->s[c] += 2 * G * strain_increment[c];
}

/* ---- energy ------------------------------------------------------------------------------------------------------ */

/* Returns the elastic energy density of the first point in `points` with the material law `law` [J/m^3], ((1 + nu) s:s
 * - nu (tr s)^2)/(2 E), where s is the stress, E Young's modulus and nu Poisson's ratio. */
real laws_elastic_energy_density(const struct law *law, const struct law_points *points)
{
    real squares = 0, trace = 0;
    for (int c = 0; c < SYM_MAX; c++)
        squares += (c < 3 ? 1 : 2) * square(points->s[c][0]), trace += c < 3 ? points->s[c][0] : 0;
    return 0.5 / law->young * ((1 + law->poisson) * squares - law->poisson * square(trace));
}

double laws_energy_error_of_random_strains(const struct law *law, enum space space)
{
    struct law_points p = laws_points_at_rest();
    const int n = space == SPACE_LINE ? 1 : space == SPACE_SOLID ? 6 : 4;
    uint64_t seed = 21;
    real work = 0, moved = 0;
    for (int k = 0; k < 500; k++) {
        real strain[SYM_MAX];
        for (int c = 0; c < SYM_MAX; c++) strain[c] = 2e-3 * bench_random(&seed);
        laws_add_elastic_stress_of_increment(law, &p, strain, space);
        law_update(law, &p, space, LAW_EXPLICIT);
        for (int c = 0; c < n; c++) {
            if (c == 2 && space != SPACE_SOLID) continue;
            const real one = (c < 3 ? 0.5 : 1) * (p.before[c][0] + p.s[c][0]) * strain[c];
            work += one, moved += fabs(one);
        }
    }
    return p.a[0] > 0.1 && p.work[0] > 0 ? (work - laws_elastic_energy_density(law, &p) - p.work[0]) / moved : NAN;
}

status laws_measure_energy_of_random_strains(const struct laws_case *c, double *measured)
{
    (void)c;
    struct law m = laws_steel(FLOW_VOCE);
    measured[0] = laws_energy_error_of_random_strains(&m, SPACE_SOLID);
    m = steel_kinematic(40e9, 300);
    measured[1] = laws_energy_error_of_random_strains(&m, SPACE_PLANE_STRESS);
    m = laws_steel(FLOW_JOHNSON_COOK);
    measured[2] = laws_energy_error_of_random_strains(&m, SPACE_PLANE_STRAIN);
    return OK;
}

/* ---- bars -------------------------------------------------------------------------------------------------------- */

/* Loads a bar in `steps` equal steps from the strain *strain to the strain `to`, and sets *strain to `to`. m: its law;
 * p: its state, which is updated. */
static void bar_load(const struct law *m, struct law_points *p, real *strain, real to, int steps)
{
    const real step[SYM_MAX] = {(to - *strain) / steps};
    for (int k = 0; k < steps; k++) {
        laws_add_elastic_stress_of_increment(m, p, step, SPACE_LINE);
        law_update(m, p, SPACE_LINE, LAW_EXPLICIT);
    }
    *strain = to;
}

/* Loads a bar in strain steps of 1e-6 until its stress is `to` [Pa], and updates *strain. The last steps are shortened
 * by halving. m: its law; p: its state, which is updated. */
static void bar_pull(const struct law *m, struct law_points *p, real *strain, real to)
{
    const real sign = to > p->s[0][0] ? 1 : -1;
    real step = 1e-6;
    while (step > 1e-15) {
        struct law_points next = *p;
        const real more[SYM_MAX] = {sign * step};
        laws_add_elastic_stress_of_increment(m, &next, more, SPACE_LINE);
        law_update(m, &next, SPACE_LINE, LAW_EXPLICIT);
        if (sign * (next.s[0][0] - to) > 0) {
            step *= 0.5;
            continue;
        }
        *p = next, *strain += more[0];
    }
}

status laws_measure_hardening(const struct laws_case *c, double *measured)
{
    const struct law m = laws_steel((enum flow)c->given[0]);
    struct law_points p = laws_points_at_rest();
    real strain = 0;
    bar_load(&m, &p, &strain, 0.01, 10000);
    measured[0] = p.s[0][0] / MPA;
    bar_load(&m, &p, &strain, 0.05, 10000);
    measured[1] = p.s[0][0] / MPA, measured[2] = p.work[0] / MPA;
    return OK;
}

status laws_measure_tabulated_hardening(const struct laws_case *c, double *measured)
{
    (void)c;
    static const real to[] = {0.008, 0.04, 0.2};
    const struct law m = laws_steel(FLOW_TABLE);
    struct law_points p = laws_points_at_rest();
    real strain = 0;
    for (int k = 0; k < 3; k++) {
        bar_load(&m, &p, &strain, to[k], 100);
        measured[k] = p.s[0][0] / MPA;
    }
    return OK;
}

status laws_measure_prager_hardening(const struct laws_case *c, double *measured)
{
    (void)c;
    const struct law m = steel_kinematic(10e9, 0);
    struct law_points p = laws_points_at_rest();
    real strain = 0;
    for (int k = 0; k < 4; k++) {
        bar_load(&m, &p, &strain, k % 2 ? -0.01 : 0.01, 100);
        measured[k] = p.s[0][0] / MPA;
    }
    return OK;
}

status laws_measure_armstrong_frederick_hardening(const struct laws_case *c, double *measured)
{
    (void)c;
    const struct law m = steel_kinematic(40e9, 300);
    struct law_points p = laws_points_at_rest();
    real strain = 0, before = 0;
    bar_load(&m, &p, &strain, 0.01, 10000);
    measured[0] = p.s[0][0] / MPA;
    for (int cycle = 0; cycle < 5; cycle++) {
        bar_load(&m, &p, &strain, -0.01, 20000);
        bar_load(&m, &p, &strain, 0.01, 20000);
    }
    measured[1] = p.s[0][0] / MPA;
    p = laws_points_at_rest(), strain = 0;
    for (int cycle = 0; cycle < 4; cycle++) {
        before = strain;
        bar_pull(&m, &p, &strain, 300 * MPA), bar_pull(&m, &p, &strain, -200 * MPA);
    }
    measured[2] = 1e3 * (strain - before);
    return OK;
}

/* ---- sheets and points ------------------------------------------------------------------------------------------- */

/* Stretches a sheet in plane strain, whose faces normal to y are free of stress, by steps of 1e-5 to the strain `at`
 * along xx. In each step the strain yy follows from the condition that the stress yy is 0, by bisection. m: its law; p:
 * its state, which is updated. Returns the largest stress xx before the first plastic strain [Pa]. */
static real sheet_pull(const struct law *m, struct law_points *p, real at)
{
    const real step = 1e-5;
    real first = 0;
    for (int k = 0; k < (int)round(at / step); k++) {
        real low = -3 * step, high = 3 * step;
        struct law_points next;
        for (int times = 0; times < 60; times++) {
            const real strain[SYM_MAX] = {step, 0.5 * (low + high)};
            next = *p;
            laws_add_elastic_stress_of_increment(m, &next, strain, SPACE_PLANE_STRAIN);
            law_update(m, &next, SPACE_PLANE_STRAIN, LAW_EXPLICIT);
            if (next.s[1][0] > 0)
                high = strain[1];
            else
                low = strain[1];
        }
        if (next.a[0] == 0) first = next.s[0][0];
        *p = next;
    }
    return first;
}

status laws_measure_plane_strain_tension(const struct laws_case *c, double *measured)
{
    const struct law law = {.flow = FLOW_LINEAR, .hardening = c->given[0] * MPA};
    const struct law m = laws_law_with_derived_constants(law, 200e9, 0.3, 250 * MPA, 7800);
    struct law_points p = laws_points_at_rest();
    measured[3] = sheet_pull(&m, &p, c->given[1]) / MPA;
    measured[0] = p.s[0][0] / MPA, measured[1] = p.s[2][0] / MPA, measured[2] = 1e3 * p.a[0];
    return OK;
}

/* Stretches a point with the law m without change of volume to the plastic strain `to`, in steps of 1e-4 at a plastic
 * strain rate of 1000/s. Stores its equivalent stress [Pa] and temperature [K] at this strain, by interpolation between
 * two steps, in *stress and *temperature. */
static void point_heat(const struct law *m, real to, real *stress, real *temperature)
{
    const real step = 1e-4, strain[SYM_MAX] = {step, -0.5 * step, -0.5 * step};
    struct law_points p = laws_points_at_rest(), next = p;
    next.duration = step / 1000;
    while (next.a[0] < to) {
        p = next;
        laws_add_elastic_stress_of_increment(m, &next, strain, SPACE_SOLID);
        law_update(m, &next, SPACE_SOLID, LAW_EXPLICIT);
        if (next.a[0] > p.a[0]) next.duration = (next.a[0] - p.a[0]) / 1000;
    }
    const real share = (to - p.a[0]) / (next.a[0] - p.a[0]);
    *stress = (1 - share) * (p.s[0][0] - p.s[1][0]) + share * (next.s[0][0] - next.s[1][0]);
    *temperature = (1 - share) * p.temperature[0] + share * next.temperature[0];
}

status laws_measure_johnson_cook_heating(const struct laws_case *c, double *measured)
{
    const struct law copper = {.flow = FLOW_JOHNSON_COOK,
                               .johnson_cook = {90 * MPA, 292 * MPA, 0.31, 0.025, c->given[1], 1, 294, 1356},
                               .specific_heat = 383,
                               .taylor_quinney = 0.9};
    const struct law steel = {.flow = FLOW_JOHNSON_COOK,
                              .johnson_cook = {792 * MPA, 510 * MPA, 0.26, 0.014, c->given[1], 1, 294, 1793},
                              .specific_heat = 477,
                              .taylor_quinney = 0.9};
    const struct law m = c->given[0] == 1 ? laws_law_with_derived_constants(steel, 200e9, 0.29, 0, 7830)
                                          : laws_law_with_derived_constants(copper, 117e9, 0.35, 0, 8960);
    real stress, temperature;
    point_heat(&m, c->given[2], &stress, &temperature);
    measured[0] = stress / MPA, measured[1] = temperature;
    return OK;
}

/* ---- rate -------------------------------------------------------------------------------------------------------- */

/* Returns the Johnson-Cook law of copper without heating by plastic work. hardening: its constant B [Pa]. */
static struct law copper_cold(real hardening)
{
    const struct law m = {.flow = FLOW_JOHNSON_COOK,
                          .johnson_cook = {90 * MPA, hardening, 0.31, 0.025, 1, 1, 294, 1356}};
    return laws_law_with_derived_constants(m, 117e9, 0.35, 0, 8960);
}

status laws_measure_rate_sensitive_cycles(const struct laws_case *c, double *measured)
{
    const struct law m = copper_cold(292 * MPA);
    for (int k = 0; k < 2; k++) {
        struct law_points p = laws_points_at_rest();
        const int steps = k ? 10000 : 1000; /* a cycle */
        real strain = 0;
        p.duration = 1 / (c->given[1] * steps);
        for (int step = 1; step <= 5 * steps; step++)
            bar_load(&m, &p, &strain, c->given[0] * sin(2 * M_PI * step / steps), 1);
        measured[k] = 100 * p.a[0];
    }
    return OK;
}

status laws_measure_stress_relaxation(const struct laws_case *c, double *measured)
{
    const struct law m = copper_cold(0);
    struct law_points p = laws_points_at_rest();
    real strain = 0;
    p.duration = 1e-9;
    bar_load(&m, &p, &strain, 0.01, 10000); /* 1000/s */
    measured[0] = p.s[0][0] / MPA;
    for (int k = 0; k < 2; k++) {
        bar_load(&m, &p, &strain, strain, (int)round((c->given[k] - (k ? c->given[0] : 0)) / p.duration));
        measured[1 + k] = p.s[0][0] / MPA;
    }
    return OK;
}

/* ---- flow that turns --------------------------------------------------------------------------------------------- */

/* Loads a point of ideally plastic steel to its yield stress in tension, then shears it at constant rate, in `steps`
 * equal steps, by twice the deviatoric strain at yield. mode: how the law is integrated in a step. Returns the tensile
 * stress that remains, over the yield stress [1]. */
static real tension_left(int steps, enum law_mode mode)
{
    struct law m = laws_steel(FLOW_LINEAR);
    m.hardening = 0;
    struct law_points p = laws_points_at_rest();
    const real yield = sqrt(2.0 / 3) * m.yield; /* of the norm of the deviator */
    const real shear[SYM_MAX] = {0, 0, 0, sqrt(0.5) * 2 * yield / (2 * m.shear) / steps};
    for (int c = 0; c < 3; c++) p.s[c] = lanes_broadcast((c == 0 ? 2.0 / 3 : -1.0 / 3) * m.yield);
    for (int k = 0; k < steps; k++) {
        laws_add_elastic_stress_of_increment(&m, &p, shear, SPACE_SOLID);
        law_update(&m, &p, SPACE_SOLID, mode);
    }
    return (p.s[0][0] - p.s[1][0]) / m.yield;
}

status laws_measure_tension_then_shear(const struct laws_case *c, double *measured)
{
    (void)c;
    measured[0] = tension_left(1000, LAW_EXPLICIT);
    for (int k = 0; k < 3; k++) measured[1 + k] = tension_left(1 << 2 * k, LAW_LOAD_STEP);
    return OK;
}
