/* Single elements with the laws of metals, driven through the return mapping (kernels/laws/law_update.h) in explicit
 * steps: `cleave bench laws`, and tests of the laws. */
#include <math.h>

#include "laws_bench.h"

struct law laws_material(struct law law, real young, real poisson, real yield, real density)
{
    law.given = true;
    law_compute_derived_constants(&law, yield, young, poisson, young / (2 * (1 + poisson)), density);
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
    return laws_material(law, 200e9, 0.3, 200 * MPA, 7800);
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

void laws_add_trial_stress(const struct law *m, struct law_points *p, const real *strain, enum space space)
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

/* ---- energy ------------------------------------------------------------------------------------------------------ */

/* Returns the elastic energy density of the first point of p with the law m [J/m^3], ((1 + nu) s:s - nu (tr s)^2)/(2
 * E), where s is the stress. */
real laws_elastic_energy(const struct law *m, const struct law_points *p)
{
    real squares = 0, trace = 0;
    for (int c = 0; c < SYM_MAX; c++) squares += (c < 3 ? 1 : 2) * square(p->s[c][0]), trace += c < 3 ? p->s[c][0] : 0;
    return 0.5 / m->young * ((1 + m->poisson) * squares - m->poisson * square(trace));
}

double laws_cycled_energy(const struct law *m, enum space space)
{
    struct law_points p = laws_points_at_rest();
    const int n = space == SPACE_LINE ? 1 : space == SPACE_SOLID ? 6 : 4;
    uint64_t seed = 21;
    real work = 0, moved = 0;
    for (int k = 0; k < 500; k++) {
        real strain[SYM_MAX];
        for (int c = 0; c < SYM_MAX; c++) strain[c] = 2e-3 * bench_random(&seed);
        laws_add_trial_stress(m, &p, strain, space);
        law_update(m, &p, space, LAW_EXPLICIT);
        for (int c = 0; c < n; c++) {
            if (c == 2 && space != SPACE_SOLID) continue;
            const real one = (c < 3 ? 0.5 : 1) * (p.before[c][0] + p.s[c][0]) * strain[c];
            work += one, moved += fabs(one);
        }
    }
    return p.a[0] > 0.1 && p.work[0] > 0 ? (work - laws_elastic_energy(m, &p) - p.work[0]) / moved : NAN;
}

status laws_energy(const struct laws_case *c, double *found)
{
    (void)c;
    struct law m = laws_steel(FLOW_VOCE);
    found[0] = laws_cycled_energy(&m, SPACE_SOLID);
    m = steel_kinematic(40e9, 300);
    found[1] = laws_cycled_energy(&m, SPACE_PLANE_STRESS);
    m = laws_steel(FLOW_JOHNSON_COOK);
    found[2] = laws_cycled_energy(&m, SPACE_PLANE_STRAIN);
    return OK;
}

/* ---- bars -------------------------------------------------------------------------------------------------------- */

/* Loads a bar in `steps` equal steps from the strain *strain to the strain `to`, and sets *strain to `to`. m: its law;
 * p: its state, which is updated. */
static void bar_load(const struct law *m, struct law_points *p, real *strain, real to, int steps)
{
    const real step[SYM_MAX] = {(to - *strain) / steps};
    for (int k = 0; k < steps; k++) {
        laws_add_trial_stress(m, p, step, SPACE_LINE);
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
        laws_add_trial_stress(m, &next, more, SPACE_LINE);
        law_update(m, &next, SPACE_LINE, LAW_EXPLICIT);
        if (sign * (next.s[0][0] - to) > 0) {
            step *= 0.5;
            continue;
        }
        *p = next, *strain += more[0];
    }
}

status laws_hardening(const struct laws_case *c, double *found)
{
    const struct law m = laws_steel((enum flow)c->given[0]);
    struct law_points p = laws_points_at_rest();
    real strain = 0;
    bar_load(&m, &p, &strain, 0.01, 10000);
    found[0] = p.s[0][0] / MPA;
    bar_load(&m, &p, &strain, 0.05, 10000);
    found[1] = p.s[0][0] / MPA, found[2] = p.work[0] / MPA;
    return OK;
}

status laws_table(const struct laws_case *c, double *found)
{
    (void)c;
    static const real to[] = {0.008, 0.04, 0.2};
    const struct law m = laws_steel(FLOW_TABLE);
    struct law_points p = laws_points_at_rest();
    real strain = 0;
    for (int k = 0; k < 3; k++) {
        bar_load(&m, &p, &strain, to[k], 100);
        found[k] = p.s[0][0] / MPA;
    }
    return OK;
}

status laws_prager(const struct laws_case *c, double *found)
{
    (void)c;
    const struct law m = steel_kinematic(10e9, 0);
    struct law_points p = laws_points_at_rest();
    real strain = 0;
    for (int k = 0; k < 4; k++) {
        bar_load(&m, &p, &strain, k % 2 ? -0.01 : 0.01, 100);
        found[k] = p.s[0][0] / MPA;
    }
    return OK;
}

status laws_armstrong_frederick(const struct laws_case *c, double *found)
{
    (void)c;
    const struct law m = steel_kinematic(40e9, 300);
    struct law_points p = laws_points_at_rest();
    real strain = 0, before = 0;
    bar_load(&m, &p, &strain, 0.01, 10000);
    found[0] = p.s[0][0] / MPA;
    for (int cycle = 0; cycle < 5; cycle++) {
        bar_load(&m, &p, &strain, -0.01, 20000);
        bar_load(&m, &p, &strain, 0.01, 20000);
    }
    found[1] = p.s[0][0] / MPA;
    p = laws_points_at_rest(), strain = 0;
    for (int cycle = 0; cycle < 4; cycle++) {
        before = strain;
        bar_pull(&m, &p, &strain, 300 * MPA), bar_pull(&m, &p, &strain, -200 * MPA);
    }
    found[2] = 1e3 * (strain - before);
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
            laws_add_trial_stress(m, &next, strain, SPACE_PLANE_STRAIN);
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

status laws_plane_strain(const struct laws_case *c, double *found)
{
    const struct law law = {.flow = FLOW_LINEAR, .hardening = c->given[0] * MPA};
    const struct law m = laws_material(law, 200e9, 0.3, 250 * MPA, 7800);
    struct law_points p = laws_points_at_rest();
    found[3] = sheet_pull(&m, &p, c->given[1]) / MPA;
    found[0] = p.s[0][0] / MPA, found[1] = p.s[2][0] / MPA, found[2] = 1e3 * p.a[0];
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
        laws_add_trial_stress(m, &next, strain, SPACE_SOLID);
        law_update(m, &next, SPACE_SOLID, LAW_EXPLICIT);
        if (next.a[0] > p.a[0]) next.duration = (next.a[0] - p.a[0]) / 1000;
    }
    const real share = (to - p.a[0]) / (next.a[0] - p.a[0]);
    *stress = (1 - share) * (p.s[0][0] - p.s[1][0]) + share * (next.s[0][0] - next.s[1][0]);
    *temperature = (1 - share) * p.temperature[0] + share * next.temperature[0];
}

status laws_johnson_cook(const struct laws_case *c, double *found)
{
    const struct law copper = {.flow = FLOW_JOHNSON_COOK,
                               .johnson_cook = {90 * MPA, 292 * MPA, 0.31, 0.025, c->given[1], 1, 294, 1356},
                               .specific_heat = 383,
                               .taylor_quinney = 0.9};
    const struct law steel = {.flow = FLOW_JOHNSON_COOK,
                              .johnson_cook = {792 * MPA, 510 * MPA, 0.26, 0.014, c->given[1], 1, 294, 1793},
                              .specific_heat = 477,
                              .taylor_quinney = 0.9};
    const struct law m =
        c->given[0] == 1 ? laws_material(steel, 200e9, 0.29, 0, 7830) : laws_material(copper, 117e9, 0.35, 0, 8960);
    real stress, temperature;
    point_heat(&m, c->given[2], &stress, &temperature);
    found[0] = stress / MPA, found[1] = temperature;
    return OK;
}

/* ---- rate -------------------------------------------------------------------------------------------------------- */

/* Returns the Johnson-Cook law of copper without heating by plastic work. hardening: its constant B [Pa]. */
static struct law copper_cold(real hardening)
{
    const struct law m = {.flow = FLOW_JOHNSON_COOK,
                          .johnson_cook = {90 * MPA, hardening, 0.31, 0.025, 1, 1, 294, 1356}};
    return laws_material(m, 117e9, 0.35, 0, 8960);
}

status laws_cycled_rate(const struct laws_case *c, double *found)
{
    const struct law m = copper_cold(292 * MPA);
    for (int k = 0; k < 2; k++) {
        struct law_points p = laws_points_at_rest();
        const int steps = k ? 10000 : 1000; /* a cycle */
        real strain = 0;
        p.duration = 1 / (c->given[1] * steps);
        for (int step = 1; step <= 5 * steps; step++)
            bar_load(&m, &p, &strain, c->given[0] * sin(2 * M_PI * step / steps), 1);
        found[k] = 100 * p.a[0];
    }
    return OK;
}

status laws_held(const struct laws_case *c, double *found)
{
    const struct law m = copper_cold(0);
    struct law_points p = laws_points_at_rest();
    real strain = 0;
    p.duration = 1e-9;
    bar_load(&m, &p, &strain, 0.01, 10000); /* 1000/s */
    found[0] = p.s[0][0] / MPA;
    for (int k = 0; k < 2; k++) {
        bar_load(&m, &p, &strain, strain, (int)round((c->given[k] - (k ? c->given[0] : 0)) / p.duration));
        found[1 + k] = p.s[0][0] / MPA;
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
        laws_add_trial_stress(&m, &p, shear, SPACE_SOLID);
        law_update(&m, &p, SPACE_SOLID, mode);
    }
    return (p.s[0][0] - p.s[1][0]) / m.yield;
}

status laws_turning(const struct laws_case *c, double *found)
{
    (void)c;
    found[0] = tension_left(1000, LAW_EXPLICIT);
    for (int k = 0; k < 3; k++) found[1 + k] = tension_left(1 << 2 * k, LAW_LOAD_STEP);
    return OK;
}
