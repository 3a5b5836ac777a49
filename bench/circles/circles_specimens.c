/* Specimens of the circles: their scenes, what is measured of a run, and particles on a turned lattice. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory_stream.h"
#include "circles.h"
#include "output/history.h"
#include "output/output_files.h"

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

#define GLASS "young: 70 GPa, density: 2440, energy_release_rate: 10, tensile_strength: 40 MPa"
#define MATERIALS "materials:\n  - {name: glass, " GLASS "}\n  - {name: grip, young: 70 GPa, density: 2440}\n"
#define PULLED(duration)                                                                                               \
    "duration: " duration "\nmethod: pd\ncontact: {between: none}\nparticles: {spacing: h}\n"                          \
    "output: {frames: 0, samples: 400}\n" MATERIALS
#define REACTION "probes: [{reaction: {boundary: top}}]\n"
#define STATIC "duration: 1 s\nmethod: pd\nsolver: static\noutput: {frames: 0}\n" MATERIALS
#define BODY(shape, grip)                                                                                              \
    "bodies:\n  - name: body\n    material: glass\n    shape: " shape "\n    parts: [{region: " grip                   \
    ", material: grip}]\n"

/* clang-format off */

/* Scene of a strip under tension. In this and similar scenes the specimen is strained at the start to 0.9 of the strain
 * at which the strength is reached. Then it is strained further, by half of that strain in 40 us, between grips that do
 * not break. */
static const char strip[] =
    "space: plane stress\nthickness: 1 mm\n" PULLED("100 us") REACTION
    "variables: {h: 0.1 mm, e: 40 MPa/70 GPa, rate: 0.5*e/(40 us), nu: 1/3}\n"
    BODY("{box: {from: [-2.5 mm, -6 mm], to: [2.5 mm, 6 mm]}}",
         "[{all: true}, {subtract: {box: {from: [-3 mm, -4.8 mm], to: [3 mm, 4.8 mm]}}}]")
    "initial: [{velocity_gradient: [[-nu*rate, 0], [0, rate]]}]\n"
    "boundary:\n"
    "  - {name: top, velocity: [free, 5.7 mm*rate], region: {box: {from: [-3 mm, 5.7 mm], to: [3 mm, 6 mm]}}}\n"
    "  - {velocity: [free, -5.7 mm*rate], region: {box: {from: [-3 mm, -6 mm], to: [3 mm, -5.7 mm]}}}\n";

static const char disc[] =
    "space: plane stress\nthickness: 1 mm\n" PULLED("24 us") REACTION
    "variables: {h: 0.1 mm, e: (1 - 1/3)*27 MPa/70 GPa, start: 0.9*e, rate: 0.5*e/(40 us)}\n"
    BODY("{disc: {centre: [0, 0], radius: 2.5 mm}}", "{ring: {centre: [0, 0], radius: 3 mm, inner: 1.7 mm}}")
    "initial: [{displacement_gradient: [[start, 0], [0, start]], velocity_gradient: [[rate, 0], [0, rate]]}]\n"
    "regions: {rim: {ring: {centre: [0, 0], radius: 3 mm, inner: 2.1 mm}}}\n"
    "boundary:\n"
    "  - name: top\n    velocity: [x*rate, y*rate]\n"
    "    region: [{region: rim}, {intersect: {half-space: {point: [0, 0], normal: [0, -1]}}}]\n"
    "  - velocity: [x*rate, y*rate]\n"
    "    region: [{region: rim}, {intersect: {half-space: {point: [0, 0], normal: [0, 1]}}}]\n";

static const char sheared[] =
    "space: plane stress\nthickness: 1 mm\n" PULLED("48 us") REACTION
    "variables: {h: 0.1 mm, e: (1 + 1/3)*44.4 MPa/70 GPa, start: 0.6*e, rate: 0.5*e/(40 us)}\n"
    BODY("{box: {from: [-2 mm, -2 mm], to: [2 mm, 2 mm]}}",
         "[{all: true}, {subtract: {box: {from: [-1.4 mm, -1.4 mm], to: [1.4 mm, 1.4 mm]}}}]")
    "initial: [{displacement_gradient: [[-start, 0], [0, start]], velocity_gradient: [[-rate, 0], [0, rate]]}]\n"
    "boundary:\n"
    "  - {name: top, velocity: [free, 1.9 mm*rate], region: {box: {from: [-2 mm, 1.8 mm], to: [2 mm, 2 mm]}}}\n"
    "  - {velocity: [free, -1.9 mm*rate], region: {box: {from: [-2 mm, -2 mm], to: [2 mm, -1.8 mm]}}}\n"
    "  - {velocity: [-1.9 mm*rate, free], region: {box: {from: [1.8 mm, -2 mm], to: [2 mm, 2 mm]}}}\n"
    "  - {velocity: [1.9 mm*rate, free], region: {box: {from: [-2 mm, -2 mm], to: [-1.8 mm, 2 mm]}}}\n";

/* Scene of a cube under equal triaxial tension. The stress is measured in the middle of a ball of glass inside the
 * cube. */
#define EQUAL(value) "[[" value ", 0, 0], [0, " value ", 0], [0, 0, " value "]]"
static const char cube[] =
    "space: solid\n" PULLED("11 us") "probes: [{point: {name: centre, at: [0, 0, 0]}}]\n"
    "variables: {h: 0.1 mm, e: (1 - 2/4)*27.8 MPa/70 GPa, start: 0.9*e, rate: 0.5*e/(40 us)}\n"
    BODY("{box: {from: [-0.8 mm, -0.8 mm, -0.8 mm], to: [0.8 mm, 0.8 mm, 0.8 mm]}}",
         "[{all: true}, {subtract: {ball: {centre: [0, 0, 0], radius: 0.5 mm}}}]")
    "initial: [{displacement_gradient: " EQUAL("start") ", velocity_gradient: " EQUAL("rate") "}]\n"
    "boundary:\n  - velocity: [x*rate, y*rate, z*rate]\n"
    "    region: [{all: true}, {subtract: {box: {from: [-0.6 mm, -0.6 mm, -0.6 mm], "
    "to: [0.6 mm, 0.6 mm, 0.6 mm]}}}]\n";

/* Scene of half a strip with an edge notch. The load grows to 0.85 P in 15 us and to 1.1 P in 110 us more: a ramp four
 * times as steep adds 3 to 5 % to the load at which the crack has run. */
#define RAMP "time: {table: [[0, 0], [15 us, 0.85], [125 us, 1.1]]}"
static const char notch[] =
    "space: plane stress\nthickness: 1 mm\nduration: 125 us\nmethod: pd\ndamping: 1.5e6\n"
    "contact: {between: none}\nparticles: {spacing: h}\nprobes: [{tip: {at: [notch, 0]}}]\n"
    "output: {frames: 0, samples: 800}\n" MATERIALS
    "variables: {h: 0.1 mm, notch: 1 mm, P: 10.89 MPa}\n"
    BODY("{box: {from: [0, 0], to: [5 mm, 6 mm]}}",
         "[{all: true}, {subtract: {box: {from: [-1 mm, -5.5 mm], to: [6 mm, 5.5 mm]}}}]")
    "cracks: [{from: [-1 mm, 0], to: [notch, 0]}]\n"
    "boundary:\n"
    "  - {body_force: [0, P/(0.5 mm)], region: {box: {from: [0, 5.5 mm], to: [5 mm, 6 mm]}}, " RAMP "}\n"
    "  - {mirror: {axis: y, at: 0}}\n";
#define LOWER_LOAD \
    "{body_force: [0, -P/(0.5 mm)], region: {box: {from: [0, -6 mm], to: [5 mm, -5.5 mm]}}, " RAMP "}"

/* Scene of pure shear: half of a strip 5 mm high with a long crack, which grows by 0.025 mm in each load step. The
 * grip is strained like the strip, so that it clamps the face of the strip exactly. */
static const char pure_shear[] =
    "space: plane stress\nthickness: 1 mm\n" STATIC
    "steps: {number: 32, control: energy, energy: 0.125 uJ}\nparticles: {spacing: h}\nvariables: {h: 0.1 mm}\n"
    "body: {box: {from: [0, 0], to: [30 mm, 2.5 mm + 3*h]}}\n"
    "parts: [{region: {box: {from: [0, 1.5 mm], to: [30 mm, 4 mm]}}, material: grip}]\n"
    "cracks: [{from: [-1 mm, 0], to: [10 mm, 0]}]\n"
    "boundary:\n  - displacement: [0, y/2500]\n"
    "    region: {box: {from: [0, 2.5 mm], to: [30 mm, 4 mm]}}\n    time: {ramp: {until: 1 s}}\n"
    "  - {mirror: {axis: y, at: 0}}\n";

/* Scene of a double cantilever beam, of which one half is computed: 55 x 20 x 2.5 mm, with a crack of 25 mm measured
 * from the line of the loads. */
static const char cantilever[] =
    "space: plane strain\nthickness: 2.5 mm\n" STATIC
    "steps: {number: 24, control: energy}\nparticles: {spacing: h}\nvariables: {h: 0.1 mm}\n"
    "body: {box: {from: [0, 0], to: [55 mm, 10 mm]}}\n"
    "parts: [{region: {box: {from: [0, 2 mm], to: [55 mm, 10 mm]}}, material: grip}]\n"
    "cracks: [{from: [-1 mm, 0], to: [25 mm + h/2, 0]}]\n"
    "boundary:\n  - name: upper\n    displacement: [free, 40 um]\n"
    "    region: {box: {from: [0, 0], to: [h, 10 mm]}}\n    time: {ramp: {until: 1 s}}\n"
    "  - {mirror: {axis: y, at: 0}}\n"
    "  - {fixed: [x], region: {box: {from: [55 mm - h, 0], to: [55 mm, h]}}}\n"
    "probes: [{reaction: {boundary: upper}}]\n";

/* clang-format on */

/* ---- results ----------------------------------------------------------------------------------------------------- */

#define SETTLED 1e-6 /* time at which waves from a strain given at the start have crossed a body [s] */

/* Returns the largest value of a column of the history in `folder`, from the time SETTLED until the column has fallen
 * to half of it: broken bodies swing. Returns NAN if the history cannot be read. */
static double column_peak(const char *folder, const char *column)
{
    struct history h;
    double peak = 0;
    if (history_read(&h, folder) != OK) return NAN;
    const int at = history_find_column(&h, column), time = history_find_column(&h, "time");
    for (int64_t k = 0; k < h.rows; k++) {
        const double value = history_value_at(&h, k, at);
        if (history_value_at(&h, k, time) < SETTLED) continue;
        if (value < 0.5 * peak) break;
        peak = fmax(peak, value);
    }
    history_free(&h);
    return peak;
}

/* Returns the load of a notched strip [MPa] when the column `column` of the history first exceeds `limit`; NAN if it
 * does not. folder: output of the run r. */
static double load_at(const char *folder, const struct circle_run *r, const char *column, double limit)
{
    struct history h;
    double share = NAN;
    if (history_read(&h, folder) != OK) return NAN;
    const int at = history_find_column(&h, column), time = history_find_column(&h, "time");
    for (int64_t k = 0; k < h.rows && isnan(share); k++)
        if (history_value_at(&h, k, at) > limit) share = 0.85 + 0.25 * (history_value_at(&h, k, time) - 15e-6) / 110e-6;
    history_free(&h);
    return strtod(r->of->set[CIRCLE_LOAD].value, NULL) * share;
}

/* Returns the largest mean stress during a run: the force on the boundary `top` over the cross section of the specimen
 * [MPa]. folder: output of the run r; NAN if it cannot be read. */
static double stress_peak(const char *folder, const struct circle_run *r)
{
    return column_peak(folder, "reaction.force_y") / (r->section * circle_specimen[r->of->specimen].area) / 1e6;
}

/* Returns the largest stress yy at the centre of a body during a run [MPa]. folder: output of the run; r: not used; NAN
 * if the output cannot be read. */
static double centre_peak(const char *folder, const struct circle_run *r)
{
    return (void)r, column_peak(folder, "centre.stress_yy") / 1e6;
}

/* Returns the load of a notched strip at which the crack tip has advanced by 0.5 mm [MPa]. folder: output of the run r;
 * NAN if the tip does not advance so far. */
static double notch_load(const char *folder, const struct circle_run *r)
{
    struct history h;
    if (history_read(&h, folder) != OK) return NAN;
    const double tip = h.rows > 0 ? history_value_at(&h, 0, history_find_column(&h, "tip.x")) : NAN;
    history_free(&h);
    return load_at(folder, r, "tip.x", tip + 0.5e-3);
}

/* Returns the load of a notched strip [MPa] at which the body has dissipated the energy of a crack of 0.5 mm. It
 * replaces the load at which the crack tip has advanced, for notches so short that the body may break elsewhere.
 * folder: output of the run r; NAN if less energy is dissipated. */
static double short_notch_load(const char *folder, const struct circle_run *r)
{
    const double halves = r->degrees ? 2 : 1;
    return load_at(folder, r, "fracture", halves * CIRCLE_TOUGHNESS * 0.25e-3 * 1e-3);
}

/* Returns the largest load of a notched strip in a run with load steps [MPa]. folder: output of the run; r: not
 * used. */
static double steps_load(const char *folder, const struct circle_run *r)
{
    return (void)r, CIRCLE_STRENGTH / 1e6 * column_peak(folder, "load_time");
}

/* Returns the displacement between the clamped faces of the strip in pure shear at which the crack grows: the mean over
 * the second half of the load steps [um]. folder: output of the run; r: not used; NAN if it cannot be read. */
static double shear_opening(const char *folder, const struct circle_run *r)
{
    struct history h;
    double sum = 0;
    (void)r;
    if (history_read(&h, folder) != OK) return NAN;
    const int time = history_find_column(&h, "load_time");
    for (int64_t k = h.rows / 2; k < h.rows; k++) sum += 2 * history_value_at(&h, k, time);
    const double mean = sum / (double)(h.rows - h.rows / 2);
    history_free(&h);
    return mean;
}

/* Returns the largest load of a double cantilever beam [N]. folder: output of the run; r: not used; NAN if the output
 * cannot be read. */
static double cantilever_load(const char *folder, const struct circle_run *r)
{
    return (void)r, column_peak(folder, "reaction.force_y");
}

/* clang-format off */
const struct circle_specimen circle_specimen[CIRCLE_SPECIMENS] = {
    [CIRCLE_STRIP] = {"strip", NULL, strip, {-2.5e-3, -6e-3}, {2.5e-3, 6e-3}, 0, {0}, 0, 5e-6, stress_peak},
    [CIRCLE_DISC] = {"disc", NULL, disc, {-2.5e-3, -2.5e-3}, {2.5e-3, 2.5e-3}, 2.5e-3, {0}, 0, 5e-6, stress_peak},
    [CIRCLE_SQUARE] = {"square", NULL, sheared, {-2e-3, -2e-3}, {2e-3, 2e-3}, 0, {0}, 0, 4e-6, stress_peak},
    [CIRCLE_CUBE] = {.name = "cube", .text = cube, .measure = centre_peak},
    [CIRCLE_NOTCH] = {"notch", NULL, notch, {0, -6e-3}, {5e-3, 6e-3}, 0, {"boundary.1", LOWER_LOAD}, 0.5e-3, 5e-6,
                      notch_load},
    [CIRCLE_SHORT_NOTCH] = {"short_notch", NULL, notch, {0, -6e-3}, {5e-3, 6e-3}, 0, {"boundary.1", LOWER_LOAD}, 0.5e-3,
                            5e-6, short_notch_load},
    [CIRCLE_NOTCH_STEPS] = {.name = "notch_steps", .path = "inputs/strength_notch.yaml", .measure = steps_load},
    [CIRCLE_PURE_SHEAR] = {.name = "pure_shear", .text = pure_shear, .measure = shear_opening},
    [CIRCLE_CANTILEVER] = {.name = "cantilevers", .text = cantilever, .measure = cantilever_load},
};
/* clang-format on */

/* ---- lists ------------------------------------------------------------------------------------------------------- */

/* Adds one particle of a list at the height y [m], with the volume `volume` [m^3], to two sums: list->section, the mean
 * cross-section over that of the specimen s, weighted by a triangle over the middle half of its height; and
 * list->layer, the same for the loaded layer at its upper end. */
static void circle_list_add(struct circle_list *list, const struct circle_specimen *s, double y, double volume)
{
    const double reach = 0.5 * s->to[1], width = s->to[0] - s->from[0], section = 1e-3 * width;
    list->section += volume * fmax(0, 1 - fabs(y) / reach) / (reach * section);
    if (s->loaded > 0 && y > s->to[1] - s->loaded) list->layer += volume / (s->loaded * section);
}

status circle_write_particle_list(const char *path, const struct circle_specimen *specimen, double spacing,
                                  int lattice_degrees, double middle_x, struct circle_list *body_sizes)
{
    char *text = NULL;
    size_t length = 0;
    const double along = cos(lattice_degrees * M_PI / 180), across = sin(lattice_degrees * M_PI / 180);
    const int most = (int)ceil(
        (hypot(specimen->to[0] - specimen->from[0], specimen->to[1] - specimen->from[1]) + fabs(middle_x)) / spacing);
    FILE *to = memory_stream_open(&text, &length);
    if (!to) return status_set(FAILED, "cannot write %s: out of memory", path);
    fprintf(to, "x,y,volume\n");
    *body_sizes = (struct circle_list){0, specimen->loaded > 0 ? 0 : 1};
    for (int p = -most; p <= most; p++)
        for (int q = -most; q <= most; q++) { /* no particle is on y = 0 */
            const double x = middle_x + spacing * (along * (p + 0.5) - across * q);
            const double y = spacing * (across * (p + 0.5) + along * q), volume = 1e-3 * spacing * spacing;
            const bool in =
                x > specimen->from[0] && x < specimen->to[0] && y > specimen->from[1] && y < specimen->to[1];
            if (!in || (specimen->radius > 0 && hypot(x, y) >= specimen->radius)) continue;
            fprintf(to, "%.17g,%.17g,%.17g\n", x, y, volume);
            circle_list_add(body_sizes, specimen, y, volume);
        }
    if (specimen->radius > 0) body_sizes->section = 1; /* a triangle over a disc is no section */
    const status written = fclose(to) == 0 ? file_write_whole(path, text, length)
                                           : status_set(FAILED, "cannot write %s: out of memory", path);
    free(text);
    return written;
}
