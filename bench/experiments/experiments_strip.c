/* A crack through a long strip whose faces are displaced apart: in steady state the energy release rate is G = E'
 * strain^2 h/2 at any speed (Rice 1968). Measures speed, stress-intensity factor and fracture energy over the load.
 *
 * The material resembles Homalite-100. The bond-based model has no length or time scale but those of the lattice, so
 * that speeds over c_R and factors over K_c depend only on the load over G_c and on Poisson's ratio (1/3). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "experiments.h"
#include "fracture/sif_fields.h"
#include "output/history.h"

#define STRIP_YOUNG 4.55e9 /* [Pa] */
#define STRIP_POISSON (1.0 / 3)
#define STRIP_DENSITY 1230.0 /* [kg/m^3] */
#define STRIP_TOUGHNESS 40.0 /* energy release rate G_c [J/m^2] */
#define STRIP_FREE 16.8e-3   /* height between the displaced faces [m] */
#define STRIP_GROWN 10e-3    /* growth at the start of the measurement [m] */
#define STRIP_LAST 100e-3    /* growth at its end, 30 mm before the far end [m] */
#define STRIP_NOTCH 30e-3    /* length of the notch [m] */
#define KNAUSS "Ravi-Chandar & Knauss 1984"

static const char strip_text[] =
    "name: strip\nspace: plane stress\nthickness: 1 mm\nduration: 250 us\nmethod: pd\n"
    "material: {young: 4.55 GPa, density: 1230, energy_release_rate: 40}\n"
    "body: {box: {from: [0, -10 mm], to: [160 mm, 10 mm]}}\nparticles: {spacing: 0.5 mm}\n"
    "cracks: [{from: [-1 mm, 0], to: [30 mm, 0]}]\n"
    "initial: [{displacement_gradient: [[0, 0], [0, 1e-3]]}]\nboundary:\n"
    "  - {fixed: all, region: {box: {from: [-inf, 8.4 mm], to: [inf, inf]}}}\n"
    "  - {fixed: all, region: {box: {from: [-inf, -inf], to: [inf, -8.4 mm]}}}\n"
    "output: {times: [250 us], samples: 250}\nprobes: [sif: {outer: 8 mm, contours: [7 mm, 8 mm]}]\n";

/* Loads G over G_c. */
static const double strip_loads[] = {1.1, 1.3, 1.6, 2, 2.5, 3.2, 4, 6};
enum { STRIP_LOADS = COUNT_OF(strip_loads) };

static struct crack_medium strip_medium(void)
{
    struct material m = {.young = STRIP_YOUNG, .poisson = STRIP_POISSON, .density = STRIP_DENSITY};
    material_compute_derived_constants(&m, SPACE_PLANE_STRESS);
    return crack_medium_of_material(&m, SPACE_PLANE_STRESS);
}

/* ---- results of a run -------------------------------------------------------------------------------------------- */

/* A history, and its rows first .. end - 1 in which the crack is straight and far from both ends of the strip. */
struct strip_window {
    struct history h;
    int64_t first, end;
};

static bool strip_window_open(struct strip_window *w, const char *folder, double spacing)
{
    const double branches = branching_x_coordinate(folder, spacing);
    *w = (struct strip_window){0};
    if (history_read(&w->h, folder) != OK) return false;
    const double straight = isnan(branches) ? INFINITY : branches - STRIP_NOTCH - 4 * spacing;
    const double last = fmin(STRIP_LAST, straight), from = fmin(STRIP_GROWN, 0.3 * last);
    const int length = history_find_column(&w->h, "crack_length");
    while (w->first < w->h.rows && history_value_at(&w->h, w->first, length) < from) w->first++;
    w->end = w->first;
    while (w->end < w->h.rows && history_value_at(&w->h, w->end, length) <= last) w->end++;
    if (w->end - w->first >= 8) return true;
    history_free(&w->h);
    return false;
}

/* Returns the slope of the column y_name over the column x_name of a history, by least squares over the rows of the
 * window w, in which the crack is straight. */
static double strip_slope(const struct strip_window *w, const char *x_name, const char *y_name)
{
    const int cx = history_find_column(&w->h, x_name), cy = history_find_column(&w->h, y_name);
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (int64_t k = w->first; k < w->end; k++) {
        const double a = history_value_at(&w->h, k, cx) - history_value_at(&w->h, w->first, cx),
                     b = history_value_at(&w->h, k, cy);
        n++, x += a, y += b, xx += a * a, xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

/* Returns the mean speed of the crack over the Rayleigh speed c_R while the crack is straight and far from the ends of
 * the strip; NAN if it never is. folder: of the run; spacing [m]. */
static double strip_speed(const char *folder, double spacing)
{
    struct strip_window w;
    if (!strip_window_open(&w, folder, spacing)) return NAN;
    const double v = strip_slope(&w, "time", "crack_length");
    history_free(&w.h);
    return v / strip_medium().rayleigh;
}

/* Returns the energy of broken bonds per new crack area over G_c while the crack is straight and far from the ends of
 * the strip; NAN if it never is. folder: of the run; spacing [m]. */
static double strip_taken(const char *folder, double spacing)
{
    struct strip_window w;
    if (!strip_window_open(&w, folder, spacing)) return NAN;
    const double taken = strip_slope(&w, "crack_length", "fracture") / (1e-3 * STRIP_TOUGHNESS);
    history_free(&w.h);
    return taken;
}

/* Returns the mean stress-intensity factor at the moving crack tip over K_c = sqrt(G_c E) while the crack is straight
 * and far from the ends of the strip; NAN if it never is. folder: of the run; spacing [m]. */
static double strip_factor(const char *folder, double spacing)
{
    struct strip_window w;
    double sum = 0;
    if (!strip_window_open(&w, folder, spacing)) return NAN;
    const int K = history_find_column(&w.h, "sif.K_I");
    for (int64_t k = w.first; k < w.end; k++) sum += history_value_at(&w.h, k, K);
    const double mean = sum / (double)(w.end - w.first);
    history_free(&w.h);
    return mean / sqrt(STRIP_TOUGHNESS * STRIP_YOUNG);
}

/* Returns the energy flux into the moving crack tip over G_c, A_I(v) K_I^2/(E G_c), while the crack is straight; NAN if
 * it never is. A_I is the universal function of the crack speed v (Freund 1990). folder: of the run; spacing [m]. */
static double strip_flux(const char *folder, double spacing)
{
    const struct crack_medium m = strip_medium();
    const double v = strip_speed(folder, spacing) * m.rayleigh;
    return crack_tip_speed_universal_function(&m, MODE_I, v) * square(strip_factor(folder, spacing));
}

/* ---- all loads --------------------------------------------------------------------------------------------------- */

/* Returns the last result called `figure` that x has for the strip under the load `variant`, and stores its standard
 * deviation in *deviation. Returns NAN and leaves *deviation unchanged if there is none. */
static double strip_value(const struct experiments *x, const char *variant, const char *figure, double *deviation)
{
    for (int k = x->n; k-- > 0;)
        if (!strcmp(x->row[k].variant, variant) && !strcmp(x->row[k].figure, figure)) {
            *deviation = x->row[k].deviation;
            return x->row[k].value;
        }
    return NAN;
}

/* Evaluates the runs of the glass strip under all its loads together: adds to x the largest speed of a crack that stays
 * straight, as a result, and the curves of crack speed for the picture. variant[STRIP_LOADS]: names of the loads in the
 * results. */
static void strip_curves(struct experiments *x, const char (*variant)[16])
{
    struct experiment_curve *speed = experiment_add_empty_curve(x, "speed", "strip");
    struct experiment_curve *taken = experiment_add_empty_curve(x, "taken", "strip");
    struct experiment_row fastest = {.experiment = "strip",
                                     .variant = "all loads",
                                     .figure = "largest speed / c_R",
                                     .unit = "",
                                     .verdict = "",
                                     .source = KNAUSS,
                                     .low = 0,
                                     .high = 0.45};
    fastest.value = fastest.interval = fastest.deviation = NAN;
    for (int k = 0; k < STRIP_LOADS; k++) {
        double spread = NAN, other = NAN;
        const double v = strip_value(x, variant[k], "speed / c_R", &spread);
        if (isnan(v)) continue;
        experiment_curve_append_point(speed, strip_value(x, variant[k], "K / K_c", &other), v, spread);
        experiment_curve_append_point(taken, v, strip_value(x, variant[k], "energy taken / G_c", &other), other);
        if (isnan(fastest.value) || v > fastest.value) fastest.value = v, fastest.deviation = spread, fastest.runs = 1;
    }
    experiment_add_and_print_result(x, fastest);
}

status experiments_run_strip(struct experiments *x)
{
    char variant[STRIP_LOADS][16], initial[STRIP_LOADS][96];
    for (int k = 0; k < STRIP_LOADS; k++) {
        const double G = strip_loads[k] * STRIP_TOUGHNESS;
        const double strain = sqrt(2 * G * (1 - square(STRIP_POISSON)) / (STRIP_YOUNG * STRIP_FREE));
        snprintf(variant[k], sizeof variant[k], "G/G_c %.3g", strip_loads[k]);
        snprintf(initial[k], sizeof initial[k], "[{displacement_gradient: [[0, 0], [0, %.9g]]}]", strain);
        const struct experiment_case c = {"strip",
                                          variant[k],
                                          NULL,
                                          strip_text,
                                          {{"initial", initial[k]}},
                                          {"0.25 mm", "0.4 mm"},
                                          {5, 3},
                                          k == 0 || k == 3,
                                          false,
                                          {{"speed / c_R", "", NULL, strip_speed, 1, NAN, NAN, ""},
                                           {"K / K_c", "", NULL, strip_factor, 1, NAN, NAN, ""},
                                           {"A_I K^2/E / G_c", "", NULL, strip_flux, 1, NAN, NAN, ""},
                                           {"energy taken / G_c", "", NULL, strip_taken, 1, NAN, NAN, ""},
                                           {"branches at x", "mm", NULL, branching_x_coordinate, 1e3, NAN, NAN, ""}}};
        TRY(experiment_make_convergence_study(x, &c));
    }
    strip_curves(x, variant);
    return OK;
}
