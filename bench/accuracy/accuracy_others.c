/* Problems with known solutions that are not in the cost-accuracy table: other sizes, materials, angles, times and
 * dimensions. `method: auto` has to reach the accuracy that is required there, too. */
#include <math.h>
#include <stdio.h>

#include "accuracy.h"
#include "engine/engine.h"
#include "probes/probes.h"
#include "step/step.h"

/* ---- bars -------------------------------------------------------------------------------------------------------- */

/* Steel; a pulse 0.25 m wide goes 0.5 m, twice the width. */
static void pulse_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    (void)p;
    snprintf(
        s->text, sizeof s->text,
        "space: line\nduration: 0.0990605 ms\nmaterial: {young: 200 GPa, density: 7850 kg/m^3, critical_stretch: inf}\n"
        "body: {box: {from: [-1], to: [2]}}\nparticles: {spacing: 0.01}\n"
        "initial: [{pulse: {at: [0.2], direction: [1], width: 0.25, velocity: 1 mm/s}}]\nprobes: [exact: pulse]\n");
}

static status pulse_measure(const struct accuracy_point *p, struct run *e, double *error, double *part)
{
    const double rms = 1e-3 * sqrt(0.0625 * sqrt(0.5 * M_PI) / 3), impedance = sqrt(200e9 * 7850);
    (void)p;
    part[0] = accuracy_figure(e, "exact", "L2") / (rms * impedance);
    part[1] = accuracy_figure(e, "exact", "L2_velocity") / rms;
    *error = sqrt(0.5 * (part[0] * part[0] + part[1] * part[1]));
    return OK;
}

/* Aluminium, 0.3 m, pulled at its right end by 1 kPa; half a transit. */
static void step_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    (void)p;
    snprintf(
        s->text, sizeof s->text,
        "space: line\nduration: 29.4594 us\nmaterial: {young: 70 GPa, density: 2700 kg/m^3, critical_stretch: inf}\n"
        "body: {box: {from: [0], to: [0.3]}}\nparticles: {spacing: 0.01}\n"
        "boundary: [{name: wall, mirror: {axis: x, at: 0}}, {name: pull, traction: [1 kPa], face: x+}]\n"
        "probes: [exact: step bar]\n");
}

static status step_measure(const struct accuracy_point *p, struct run *e, double *error, double *part)
{
    (void)p;
    part[0] = accuracy_figure(e, "exact", "L1") / 1e3;
    part[1] = accuracy_figure(e, "exact", "L1_velocity") * sqrt(70e9 * 2700) / 1e3;
    *error = 0.5 * (part[0] + part[1]);
    return OK;
}

/* 0.1 m of aluminium strike 0.9 m at 20 m/s: tension at 0.1 m from the free end when the waves have gone 1 m. */
static void spall_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    (void)p;
    snprintf(
        s->text, sizeof s->text,
        "space: line\nduration: 0.23 ms\nmaterial: {young: 70 GPa, density: 2700 kg/m^3, critical_stretch: 1.5515e-3}\n"
        "body: {box: {from: [0], to: [1]}}\nparticles: {spacing: 0.01}\n"
        "initial: [{velocity: [-20], region: {box: {from: [0.9], to: [1]}}}]\nprobes: [spall]\n");
}

static status spall_measure(const struct accuracy_point *p, struct run *e, double *error, double *part)
{
    (void)p;
    part[0] = accuracy_figure(e, "spall", "time") / (1 / sqrt(70e9 / 2700)) - 1;
    part[1] = accuracy_figure(e, "spall", "position") / 0.1 - 1;
    *error = isfinite(part[0]) ? sqrt(0.5 * (part[0] * part[0] + part[1] * part[1])) : 1;
    return OK;
}

/* ---- plane ------------------------------------------------------------------------------------------------------- */

/* As the table's but for their angles, and two for Poisson's ratio. */
static void wave_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    static const char *const poisson[] = {"1/3", "1/3", "0.1", "0.45"};
    accuracy_wave.scene(p, s);
    bench_override(&s->set, "material.poisson", "%s", poisson[p->at]);
}

static status wave_measure(const struct accuracy_point *p, struct run *e, double *error, double *part)
{
    return accuracy_wave.measure(p, e, error, part);
}

/* A crack of 15 mm in 30 mm of an alloy of nu = 0.3, a/W = 0.5, H = W as in the table. */
static void crack_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    (void)p;
    snprintf(s->text, sizeof s->text,
             "space: plane stress\nthickness: 2 mm\nduration: 1\n"
             "material: {young: 70 GPa, poisson: 0.3, density: 2700 kg/m^3}\n"
             "particles: {spacing: 0.1 mm}\nbody: {box: {from: [0, 0], to: [30 mm, 30 mm]}}\n"
             "cracks: [{from: [-1 mm, 15 mm], to: [15 mm, 15 mm]}]\nprobes: [sif: {contours: [6 mm]}]\n"
             "boundary: [{traction: [0, 10 MPa], face: y+}, {traction: [0, -10 MPa], face: y-}]\n");
    bench_override(&s->set, "solver", "static");
}

static status crack_measure(const struct accuracy_point *p, struct run *e, double *error, double *part)
{
    (void)p;
    part[0] = fabs(accuracy_figure(e, "sif", "K_I")) / (10e6 * sqrt(M_PI * 15e-3)) / 3.009 - 1;
    *error = fabs(part[0]);
    return OK;
}

/* The plate of the table, 40 mm wide with a hole of 4 mm, of a stiffer material. */
static const double hole_radius = 4e-3, hole_young = 70e9, hole_pull = 1e6;
static void hole_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    (void)p;
    snprintf(s->text, sizeof s->text,
             "space: plane stress\nthickness: 1 mm\nduration: 1\n"
             "material: {young: 70 GPa, poisson: 1/3, density: 2700 kg/m^3, critical_stretch: inf}\n"
             "particles: {spacing: 0.1 mm}\n"
             "body: [{box: {from: [-20 mm, -20 mm], to: [20 mm, 20 mm]}}, {subtract: {disc: {centre: [0, 0], radius: 4 "
             "mm}}}]\n"
             "boundary: [{traction: [0, 1 MPa], face: y+}, {traction: [0, -1 MPa], face: y-}]\n");
    bench_override(&s->set, "solver", "static");
}

/* The exact field is that of a radius of 1 m, 1 GPa and 10 kPa (accuracy_hole.c); from 1.5 to 3 radii. */
static status hole_measure(const struct accuracy_point *p, struct run *e, double *error, double *part)
{
    const struct particles *q = &e->part;
    const double scale = hole_radius * (hole_pull / 1e4) * (1e9 / hole_young);
    double off2 = 0, size2 = 0;
    (void)p;
    for (int64_t i = 0; i < q->n; i++) {
        const double X[2] = {q->X[0][i] / hole_radius, q->X[1][i] / hole_radius}, r = hypot(X[0], X[1]);
        double u[2], stress[3];
        if (r < 1.5 || r > 3) continue;
        accuracy_hole_exact(X, u, stress);
        for (int d = 0; d < 2; d++)
            off2 += pow(q->x[d][i] - q->X[d][i] - scale * u[d], 2), size2 += pow(scale * u[d], 2);
    }
    *error = part[0] = sqrt(off2 / size2);
    return OK;
}

/* ---- solid ------------------------------------------------------------------------------------------------------- */

/* A pressure wave 0.4 m wide along a column between mirrors, as far as it is wide. */
static const struct wave_pulse column_pulse = {
    .at = {0.6}, .direction = {1}, .width = 0.4, .velocity = 1e-4, .polarisation = {1}};
static void column_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    (void)p;
    FILE *to = fmemopen(s->text, sizeof s->text, "w");
    fputs("space: solid\nduration: 4 ms\nmaterial: {young: 25000/3, density: 1, critical_stretch: inf}\n"
          "body: {box: {from: [0, 0, 0], to: [1.6, 0.2, 0.2]}}\nparticles: {spacing: 0.1}\n"
          "initial: [{pulse: {at: [0.6, 0, 0], direction: [1, 0, 0], width: 0.4, velocity: 1e-4}}]\nboundary:\n", to);
    for (int axis = 1; axis < 3; axis++)
        for (int at = 0; at < 2; at++) fprintf(to, "  - {mirror: {axis: %c, at: %g}}\n", 'x' + axis, 0.2 * at);
    fclose(to);
}

static status column_measure(const struct accuracy_point *p, struct run *e, double *error, double *part)
{
    const struct observed seen = run_observed(e);
    struct wave_pulse w = column_pulse;
    double off2 = 0, size2 = 0;
    (void)p;
    w.at[0] += seen.material->wave_speed * seen.t_velocity;
    for (int64_t i = 0; i < seen.part->n; i++) {
        const real X[DIM_MAX] = {seen.part->X[0][i], seen.part->X[1][i], seen.part->X[2][i]};
        const double exact = wave_pulse_at(&w, X, seen.material->wave_speed, 3).velocity;
        size2 += exact * exact;
        for (int d = 0; d < 3; d++) off2 += pow(seen.part->v[d][i] - (d ? 0 : exact), 2);
    }
    *error = part[0] = sqrt(off2 / size2);
    return OK;
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

#define OTHER(name_, title_, dim_, what, ...)                                                                          \
    static const struct accuracy_problem other_##what = {.name = name_,                                                \
                                                         .title = title_,                                              \
                                                         .cases = {__VA_ARGS__},                                       \
                                                         .dim = dim_,                                                  \
                                                         .scene = what##_scene,                                        \
                                                         .measure = what##_measure,                                    \
                                                         .resolution = {100}}
OTHER("pulse", "steel bar, another width, twice as far", 1, pulse, "steel");
OTHER("step", "aluminium bar, another length, half a transit", 1, step, "aluminium");
OTHER("spall2", "aluminium bar that spalls, another impactor", 1, spall, "aluminium");
OTHER("wave2", "plane waves at other angles", 2, wave, "P 30 deg", "S 12 deg", "P 22.5 nu 0.1", "P 0 nu 0.45");
OTHER("crack2", "edge crack, three times as long, nu = 0.3", 2, crack, "nu 0.3");
OTHER("hole2", "plate with another hole, another material", 2, hole, "4 mm");
OTHER("column", "pressure wave along a column", 3, column, "solid");

const struct accuracy_problem *const accuracy_other[] = {&other_pulse, &other_step, &other_spall, &other_wave,
                                                         &other_crack, &other_hole, &other_column};
const int accuracy_others = COUNT_OF(accuracy_other);
