/* Concrete and rock: a notched beam under impact, and a disc split by jaws. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "experiments.h"
#include "output/history.h"
#include "output/summary_read.h"

/* ---- the beam of John & Shah 1990 -------------------------------------------------------------------------------- */

/* Data of the beam of John & Shah (1990). Its notch is gamma times half the span from the middle; for gamma above
 * 0.77 the beam broke in its middle. */
#define JOHN_SHAH "John & Shah 1990"
#define HALF_SPAN 101.6 /* [mm] */
#define NOTCH_END 19.0  /* [mm] */
enum { BEAM_BISECTIONS = 6, BEAM_STEPS = 3 };

/* Runs the notched beam of John & Shah (1990) and sets *middle to true if a crack grows from its lower side near the
 * middle. gamma: distance of the notch from the middle over half the span; safety: fraction of the critical time
 * step; spacing [mm]. Returns FAILED if the run fails. */
static status beam_middle(double gamma, double safety, double spacing, bool *middle)
{
    struct run e;
    struct scene s;
    struct bench_overrides o = {0};
    /* The notch is midway between two columns of particles, as in the scene. */
    const double at = spacing * round(gamma * HALF_SPAN / spacing);
    bench_overrides_append(&o, "cracks", "[{from: [%.9g mm, -1 mm], to: [%.9g mm, 19 mm], width: 2 mm}]", at, at);
    bench_overrides_append(&o, "particles.spacing", "%.9g mm", spacing);
    bench_overrides_append(&o, "time.safety", "%.9g", safety);
    bench_overrides_append(&o, "output", "{frames: 0, samples: 1}");
    TRY(bench_engine_make(&e, &s, "inputs/three_point_bend.yaml", NULL, bench_overrides_as_array(&o), o.n));
    const status ran = run_advance_to_end_time(&e);
    *middle = false;
    for (int64_t i = 0; i < e.part.n && ran == OK; i++)
        *middle |= e.part.damage[i] > 0.01 * EXPERIMENT_DAMAGED && fabs(e.part.X[0][i]) < 2e-4 * HALF_SPAN &&
                   e.part.X[1][i] < 1e-3 * NOTCH_END;
    bench_engine_free(&e, &s);
    return ran;
}

/* Determines by bisection the position gamma of the notch above which the beam of John & Shah (1990) breaks in its
 * middle; NAN if it is not between 0.6 and 0.98. safety: fraction of the critical time step; spacing [mm]. Returns
 * FAILED if a run fails. */
static status beam_change(double safety, double spacing, double *gamma)
{
    double low = 0.6, high = 0.98;
    bool at_low, at_high, middle;
    TRY(beam_middle(low, safety, spacing, &at_low));
    TRY(beam_middle(high, safety, spacing, &at_high));
    *gamma = NAN;
    if (at_low || !at_high) return OK;
    for (int k = 0; k < BEAM_BISECTIONS && high - low > spacing / HALF_SPAN; k++) {
        const double between = 0.5 * (low + high);
        TRY(beam_middle(between, safety, spacing, &middle));
        *(middle ? &high : &low) = between;
    }
    *gamma = 0.5 * (low + high);
    return OK;
}

status experiments_run_notched_beam(struct experiments *x)
{
    static const double safety[BEAM_STEPS] = {0.45, 0.5, 0.55}, spacing[2] = {2.54, 1.27};
    static const struct experiment_case angle = {
        "notched beam",
        "gamma 0.7",
        "inputs/three_point_bend.yaml",
        NULL,
        {{"output", "{times: [1.3 ms], samples: 400}"}},
        {"2.54 mm", "2.54 mm"},
        {9, 3},
        true,
        false,
        {{"first bond breaks", "us", "crack.start_time", NULL, 1e6, NAN, NAN, ""},
         {"crack off the vertical", "deg", "crack.angle_deg", NULL, 1, NAN, NAN, ""}}};
    if (!bench_scene_exists("inputs/three_point_bend.yaml")) return OK;
    for (int h = 0; h < (x->quick ? 1 : 2); h++) {
        struct experiment_row row = {.experiment = "notched beam",
                                     .figure = "middle breaks from gamma",
                                     .unit = "",
                                     .verdict = "",
                                     .source = JOHN_SHAH,
                                     .low = 0.75,
                                     .high = 0.79,
                                     .spacing = spacing[h]};
        double value[BEAM_STEPS];
        for (int k = 0; k < BEAM_STEPS; k++) TRY(beam_change(safety[k], spacing[h], &value[k]));
        row.runs = experiment_compute_mean_and_interval(value, BEAM_STEPS, &row.value, &row.deviation, &row.interval);
        snprintf(row.variant, sizeof row.variant, "%.3g mm", spacing[h]);
        experiment_add_and_print_result(x, row);
    }
    return experiment_make_convergence_study(x, &angle);
}

/* ---- the disc ---------------------------------------------------------------------------------------------------- */

#define DISC_DIAMETER 50e-3  /* [m] */
#define DISC_THICKNESS 10e-3 /* [m] */
#define DISC_YOUNG 50e9      /* [Pa] */
#define DISC_TOUGHNESS 20.0  /* energy release rate G_c [J/m^2] */
#define DISC_CLOSED "2 P/(pi D t)"

/* Returns the horizontal stress in the middle of a compressed disc over the closed form 2 P/(pi D t), with load P,
 * diameter D and thickness t. It is the mean over the samples between 0.7 and 1 times the time at which the first bond
 * breaks. folder: of the run; spacing: not used. Returns NAN if the results cannot be read. */
static double disc_stress(const char *folder, double spacing)
{
    struct history h;
    double start, sum = 0;
    int n = 0;
    (void)spacing;
    if (summary_read_number(folder, "crack.start_time", &start) != OK || history_read(&h, folder) != OK) return NAN;
    const int time = history_find_column(&h, "time"), stress = history_find_column(&h, "centre.stress_xx");
    const int force = history_find_column(&h, "upper_force_y");
    for (int64_t k = 0; k < h.rows; k++) {
        const double t = history_value_at(&h, k, time), P = fabs(history_value_at(&h, k, force));
        if (t < 0.7 * start || t > start) continue;
        sum += history_value_at(&h, k, stress) / (2 * P / (M_PI * DISC_DIAMETER * DISC_THICKNESS)), n++;
    }
    history_free(&h);
    return n > 0 ? sum / n : NAN;
}

/* Returns the largest load P on a compressed disc over (pi D t/2) E s_c, with diameter D, thickness t and Young's
 * modulus E. Under that load the tensile stress 2 P/(pi D t) in its middle is E s_c, the stress at which bonds break,
 * where s_c = sqrt(4 pi G_c/(9 E delta)) with the horizon delta. folder: of the run; spacing [m]. Returns NAN if the
 * results cannot be read. */
static double disc_strength(const char *folder, double spacing)
{
    struct history h;
    double most = 0;
    if (history_read(&h, folder) != OK) return NAN;
    const int force = history_find_column(&h, "upper_force_y");
    for (int64_t k = 0; k < h.rows; k++) most = fmax(most, fabs(history_value_at(&h, k, force)));
    history_free(&h);
    const double strength = DISC_YOUNG * sqrt(4 * M_PI * DISC_TOUGHNESS / (9 * DISC_YOUNG * 3.015 * spacing));
    return most / (0.5 * M_PI * DISC_DIAMETER * DISC_THICKNESS * strength);
}

status experiments_run_compressed_disc(struct experiments *x)
{
    static const struct experiment_case disc = {
        "Brazilian disc",
        "pd",
        "inputs/brazilian_disc.yaml",
        NULL,
        {{"output", "{frames: 0, samples: 500}"}},
        {"0.5 mm", "1 mm"},
        {9, 3},
        true,
        false,
        {{"stress / closed form", "", NULL, disc_stress, 1, 0.98, 1.02, DISC_CLOSED},
         {"largest load / E s_c", "", NULL, disc_strength, 1, 0.9, 1.1, DISC_CLOSED},
         {"first bond breaks", "us", "crack.start_time", NULL, 1e6, NAN, NAN, ""}}};
    return experiment_make_convergence_study(x, &disc);
}
