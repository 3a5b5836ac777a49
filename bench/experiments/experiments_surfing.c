/* A crack that follows a moving field ("surfing": Hossain, Hsueh, Bourdin & Bhattacharya 2014): the edge of a plate is
 * displaced as in the field of a steadily moving crack. The fracture energy per new area is measured far from start and
 * end.
 *
 * Scenes cannot prescribe a displacement that varies from point to point: the edge of the plate is `fixed`, and between
 * two steps its particles are moved to the positions of the field. The steps of the engine are called one by one,
 * because its energy balance does not include the work of this motion. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "experiments.h"
#include "fracture/sif_fields.h"
#include "step/report.h"

#define SURF_WIDTH 0.1      /* width of the plate, from x = 0 [m] */
#define SURF_HEIGHT 0.02    /* half of its height [m] */
#define SURF_NOTCH 0.02     /* length of the notch [m] */
#define SURF_EDGE 3.1       /* width of the prescribed layer at each edge [spacings] */
#define SURF_FROM 0.035     /* tip position at the start of the measurement [m] */
#define SURF_TO 0.075       /* tip position at its end [m] */
#define SURF_TOUGHNESS 40.0 /* energy release rate G_c [J/m^2] */
#define SURF_LOAD 1.2       /* A_I K^2/E of the field over G_c: the tip follows that of the field */
#define HOSSAIN "Hossain et al. 2014"
enum { SURF_STEPS = 10 }; /* steps between two evaluations of the tip */

/* The prescribed field: that of a mode I crack whose tip moves at constant speed. */
struct surf {
    struct crack_medium medium;
    double speed, factor, tip; /* speed [m/s], K [Pa m^0.5], position of the tip at t = 0 [m] */
    int64_t held;
    int32_t *particle; /* [held] particles with prescribed displacement */
};

static void surf_text(FILE *to, double spacing)
{
    const double edge = SURF_EDGE * spacing;
    fprintf(to,
            "name: surf\nspace: plane stress\nthickness: 1 mm\nduration: 1 s\nmethod: pd\n"
            "material: {young: 4.55 GPa, density: 1230, energy_release_rate: %g}\nparticles: {spacing: %.9g}\n"
            "body: {box: {from: [0, %g], to: [%g, %g]}}\ncracks: [{from: [-1 mm, 0], to: [%.9g, 0]}]\n"
            "time: {active_set: false}\noutput: {frames: 0, samples: 1}\nboundary:\n",
            SURF_TOUGHNESS, spacing, -SURF_HEIGHT, SURF_WIDTH, SURF_HEIGHT, SURF_NOTCH + 0.1 * spacing);
    fprintf(to, "  - {fixed: all, region: {box: {from: [-inf, -inf], to: [%.9g, inf]}}}\n", edge);
    fprintf(to, "  - {fixed: all, region: {box: {from: [%.9g, -inf], to: [inf, inf]}}}\n", SURF_WIDTH - edge);
    fprintf(to, "  - {fixed: all, region: {box: {from: [-inf, -inf], to: [inf, %.9g]}}}\n", edge - SURF_HEIGHT);
    fprintf(to, "  - {fixed: all, region: {box: {from: [-inf, %.9g], to: [inf, inf]}}}\n", SURF_HEIGHT - edge);
}

/* Computes the displacement u[2] [m] and velocity v[2] [m/s] of the prescribed field of a moving crack, at the
 * reference position of particle i of p and time t [s]. */
static void surf_field(const struct surf *s, const struct particles *p, int64_t i, double t, double *u, double *v)
{
    const real at[2] = {p->X[0][i] - s->tip - s->speed * t, p->X[1][i]};
    struct crack_field f;
    crack_tip_unit_sif_field_at_any_speed(&s->medium, MODE_I, s->speed, at, &f);
    for (int d = 0; d < 2; d++) {
        u[d] = s->factor * f.displacement[d];
        v[d] = -s->speed * s->factor * f.state.gradient[d][0];
    }
}

/* Sets the displacement and velocity of all particles of the run to those of the prescribed field at t = 0. The
 * particles at the edge of the plate, which later follow this field, are listed in s->particle[s->held]; their velocity
 * is set to 0. */
static void surf_start(struct surf *s, struct run *run)
{
    struct particles *p = &run->part;
    double u[2], v[2];
    s->medium = crack_medium_of_material(&run->scene->material[0], run->scene->space);
    s->particle = NEW("bench.surf", p->n, int32_t);
    for (int64_t i = 0; i < p->n; i++) {
        const bool held = p->flag[i] & FLAG_DRIVEN;
        surf_field(s, p, i, 0, u, v);
        for (int d = 0; d < 2; d++) p->x[d][i] = p->X[d][i] + u[d], p->v[d][i] = held ? 0 : v[d];
        if (held) s->particle[s->held++] = (int32_t)i;
    }
}

static void surf_edge_move(const struct surf *s, struct particles *p, double t)
{
#pragma omp parallel for
    for (int64_t k = 0; k < s->held; k++) {
        double u[2], v[2];
        surf_field(s, p, s->particle[k], t, u, v);
        for (int d = 0; d < 2; d++) p->x[d][s->particle[k]] = p->X[d][s->particle[k]] + u[d];
    }
}

static double surf_tip(const struct particles *p, double spacing)
{
    double tip = 0;
    for (int64_t i = 0; i < p->n; i++)
        if (fabs(p->X[1][i]) < spacing && p->damage[i] > 0.01 * EXPERIMENT_DAMAGED) tip = fmax(tip, p->X[0][i]);
    return tip;
}

/* The fracture energy is counted from broken bonds alone. The energy that enters at the edge differs, because the
 * strain energy of the field in the plate changes while the field moves, and waves leave the tip. */

/* Sums for a least-squares line through points (x, y): their number, and the sums of x, y, x^2 and x y. */
struct surf_line {
    double n, x, y, xx, xy;
};
static void surf_line_add(struct surf_line *l, double x, double y)
{
    l->n++, l->x += x, l->y += y, l->xx += x * x, l->xy += x * y;
}
static double surf_line_slope(const struct surf_line *l)
{
    return (l->n * l->xy - l->x * l->y) / (l->n * l->xx - l->x * l->x);
}

static status surf_go(struct surf *s, struct run *run, double spacing, struct surf_figures *found)
{
    const double until = (SURF_WIDTH - SURF_NOTCH) / s->speed;
    struct surf_line taken = {0}, place = {0};
    double tip = 0;
    TRY(report_open_history_and_write_first_frame(run));
    for (int64_t step = 0; run->clock.t < until && tip < SURF_TO; step++) {
        surf_edge_move(s, &run->part, run->clock.t);
        TRY(run_adapt_mesh_and_advance_one_step(run));
        if (step % SURF_STEPS) continue;
        tip = surf_tip(&run->part, spacing);
        if (tip < SURF_FROM) continue;
        surf_line_add(&taken, 1e-3 * (tip - SURF_FROM), bonds_fracture_energy(&run->bonds));
        surf_line_add(&place, run->clock.t - SURF_FROM / s->speed, tip - SURF_FROM);
    }
    if (tip < SURF_TO) return status_set(FAILED, "surfing: the crack has not followed its field");
    *found = (struct surf_figures){surf_line_slope(&taken), surf_line_slope(&place)};
    return OK;
}

status surf_run_and_measure_crack(double spacing, double energy_share, double speed_ratio, double time_step_fraction,
                                  struct surf_figures *measured, double *rayleigh_speed)
{
    char text[2048];
    struct run e;
    struct scene scene;
    struct bench_overrides o = {0};
    FILE *to = fmemopen(text, sizeof text, "w");
    if (!to) return status_set(FAILED, "bench: out of memory");
    surf_text(to, spacing);
    fclose(to);
    bench_overrides_append(&o, "time.safety", "%.9g", time_step_fraction);
    TRY(bench_engine_make(&e, &scene, "surf", text, bench_overrides_as_array(&o), o.n));
    struct surf s = {.tip = SURF_NOTCH};
    s.medium = crack_medium_of_material(&scene.material[0], scene.space);
    *rayleigh_speed = s.medium.rayleigh;
    s.speed = speed_ratio * *rayleigh_speed;
    s.factor = sqrt(energy_share * SURF_TOUGHNESS * s.medium.modulus /
                    crack_tip_speed_universal_function(&s.medium, MODE_I, s.speed));
    surf_start(&s, &e);
    const status ran = surf_go(&s, &e, spacing, measured);
    memory_free(s.particle);
    bench_engine_free(&e, &scene);
    return ran;
}

/* A speed of the field over c_R [1], and the spacings at which it is run [mm], each with several time steps. */
struct surf_case {
    double speed, spacing[3];
    bool quick;
};
static const struct surf_case surf_cases[] = {{0.05, {0.5, 0.4, 0}, false},
                                              {0.1, {0.5, 0.4, 0.25}, true},
                                              {0.2, {0.5, 0.4, 0.25}, false},
                                              {0.4, {0.5, 0.4, 0.25}, false}};
static const double surf_safety[] = {0.45, 0.5, 0.55}; /* fractions of the critical time step */
enum { SURF_SAFETIES = COUNT_OF(surf_safety), SURF_RUNS = 3 * SURF_SAFETIES };

static void surf_add(struct experiments *x, const struct surf_case *c, const char *figure, const double *value, int n)
{
    struct experiment_row row = {.experiment = "surfing",
                                 .unit = "",
                                 .verdict = "",
                                 .source = "G_c, by " HOSSAIN,
                                 .low = 0.98,
                                 .high = 1.02,
                                 .spacing = c->spacing[0]};
    for (int k = 0; k < 3 && c->spacing[k] > 0 && !x->quick; k++) row.spacing = c->spacing[k];
    snprintf(row.variant, sizeof row.variant, "v/c_R %.3g", c->speed);
    snprintf(row.figure, sizeof row.figure, "%s", figure);
    row.runs = experiment_compute_mean_and_interval(value, n, &row.value, &row.deviation, &row.interval);
    experiment_add_and_print_result(x, row);
}

status experiments_run_surfing_crack(struct experiments *x)
{
    struct experiment_curve *curve = experiment_add_empty_curve(x, "taken", "moving field");
    for (size_t k = 0; k < COUNT_OF(surf_cases); k++) {
        const struct surf_case *c = &surf_cases[k];
        double taken[SURF_RUNS], speed[SURF_RUNS], mean, deviation, interval;
        struct surf_figures f;
        double rayleigh = 1;
        int n = 0;
        if (x->quick && !c->quick) continue;
        for (int h = 0; h < (x->quick ? 1 : 3) && c->spacing[h] > 0; h++)
            for (int s = 0; s < SURF_SAFETIES; s++) {
                TRY(surf_run_and_measure_crack(1e-3 * c->spacing[h], SURF_LOAD, c->speed, surf_safety[s], &f,
                                               &rayleigh));
                taken[n] = f.taken / SURF_TOUGHNESS, speed[n++] = f.speed / rayleigh;
            }
        surf_add(x, c, "energy taken / G_c", taken, n);
        experiment_compute_mean_and_interval(speed, n, &mean, &deviation, &interval);
        const double fast = mean;
        experiment_compute_mean_and_interval(taken, n, &mean, &deviation, &interval);
        experiment_curve_append_point(curve, fast, mean, deviation);
    }
    return OK;
}
