/* Scenes that are run with full peridynamics and adaptively, and the ends of their cracks. */
#include "efficiency.h"
#include "fracture/fracture_part.h"
#include "probes/diagnostics.h"
#include "fracture/tips.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Table of the scenes. In Kalthoff's plate the ends of notches are peridynamic from the start within three horizons
 * (3D: one): cracks then start 1 % later than with full peridynamics instead of 12 % (3D: within 3 % instead of 5 to 8
 * %; mospd at 2 mm: 5 %). */
#define PLATE_CRACK "plate_crack", "inputs/plate_crack.yaml"
#define PLATE_HOLE "plate_hole", "inputs/plate_hole.yaml"
#define KALTHOFF "kalthoff_winkler", "inputs/kalthoff_winkler.yaml"
#define KALTHOFF_3D "kalthoff_winkler_3d", "inputs/kalthoff_winkler_3d.yaml"
/* clang-format off */
#define NO_PAPER NULL, NAN, false, NAN, 0, {{0, 0}}
#define FINER(spacing, aim) spacing, aim, false, NAN, 0, {{0, 0}}

const struct scene_case efficiency_case[EFFICIENCY_CASES] = {
    {PLATE_CRACK, "bond", "0", NULL, 0.85, true, 0.371, 2, {{10e-6, 0.025}, {15e-6, 0.035}}},
    {PLATE_HOLE, "bond", "0", NULL, 0.88, true, 0.342, 0, {{0, 0}}},
    {KALTHOFF, "bond", "3", NULL, 0.80, true, 0.323, 2, {{0, 0.03}, {42e-6, 0.05}}},
    {KALTHOFF_3D, "bond", "1", NULL, NAN, true, NAN, 0, {{0, 0}}},
    {PLATE_CRACK, "ospd", "0", NO_PAPER}, {PLATE_CRACK, "mospd", "0", NO_PAPER},
    {PLATE_HOLE, "ospd", "0", NO_PAPER},  {PLATE_HOLE, "mospd", "0", NO_PAPER},
    {KALTHOFF, "ospd", "3", NO_PAPER},    {KALTHOFF, "mospd", "3", NO_PAPER},
    {KALTHOFF_3D, "ospd", "1", NO_PAPER}, {KALTHOFF_3D, "mospd", "1", NO_PAPER},
    {PLATE_CRACK, "bond", "0", FINER("0.25 mm", 0.90)},  {PLATE_HOLE, "bond", "0", FINER("0.25 mm", 0.90)},
    {KALTHOFF, "bond", "3", FINER("0.5 mm", 0.90)},      {KALTHOFF_3D, "bond", "1", FINER("1 mm", 0.85)},
    {PLATE_CRACK, "bond", "0", FINER("0.125 mm", 0.95)}, {PLATE_HOLE, "bond", "0", FINER("0.125 mm", 0.95)},
    {KALTHOFF, "bond", "3", FINER("0.25 mm", 0.95)},
    {KALTHOFF_3D, "ospd", "1", FINER("1 mm", 0.85)},     {KALTHOFF_3D, "mospd", "1", FINER("1 mm", 0.85)},
};
/* clang-format on */

const struct variant efficiency_variant[VARIANTS] = {
    {"pd", "-", "current", "true", "false", "bonds", false, NULL},
    {"adaptive", "none", "current", "false", "false", "bonds", false, "#b0b0b0"},
    {"adaptive", "frame", "reference", "false", "false", "bonds", false, "#2a6fbb"},
    {"adaptive", "slits", "reference", "false", "false", "auto", false, "#3f9f6f"},
    {"adaptive", "levels", "reference", "false", "false", "auto", true, "#7b4fa3"},
    {"adaptive", "active_set", "current", "true", "false", "bonds", false, NULL},
    {"adaptive", "reversion", "current", "false", "true", "bonds", false, NULL},
    {"adaptive", "all", "reference", "true", "true", "auto", true, "#d1603d"},
};

bool efficiency_scene_is_bond_based(const struct scene_case *c) { return strcmp(c->model, "bond") == 0; }

status efficiency_make_run_of_variant(struct run *run, struct scene *s, const struct scene_case *c, int variant,
                                      double time_step)
{
    char step[32], samples[16];
    const struct variant *w = &efficiency_variant[variant];
    struct scene_override override[13] = {
        {"method", w->method},        {"output.samples", samples},
        {"model", c->model},          {"mpm.frame", w->frame},
        {"time.active_set", w->rest}, {"pd.surface", efficiency_scene_is_bond_based(c) ? "volume" : "none"}};
    int n = 6;
    snprintf(step, sizeof step, "%.17g", time_step);
    snprintf(samples, sizeof samples, "%d", EFFICIENCY_SAMPLES);
    if (variant > 0) override[n++] = (struct scene_override){"conversion.reversion", w->back};
    if (variant > 0) override[n++] = (struct scene_override){"conversion.tips", c->tips};
    if (variant > 0) override[n++] = (struct scene_override){"conversion.notch", w->notch};
    override[n++] = (struct scene_override){"mpm.levels", !w->coarse ? "0" : c->spacing ? "2" : "1"};
    /* The scene's mpm.origin is chosen for another surface correction. */
    if (strstr(c->path, "plate_hole")) override[n++] = (struct scene_override){"mpm.origin", ""};
    if (c->spacing) override[n++] = (struct scene_override){"particles.spacing", c->spacing};
    if (time_step > 0) override[n++] = (struct scene_override){"time.step", step};
    if (!(time_step > 0) && c->spacing)
        override[n++] = (struct scene_override){"time.step", "auto"}; /* finer than the scene */
    return bench_engine_make(run, s, c->path, NULL, override, n);
}

bool efficiency_variant_is_run_for_scene(const struct scene_case *c, int variant)
{
    return !c->spacing || variant == VARIANT_PD || (variant >= VARIANT_FRAME && variant <= VARIANT_LEVELS);
}

status efficiency_find_common_time_step(const struct scene_case *c, double *time_step)
{
    *time_step = INFINITY;
    for (int variant = 0; variant < VARIANTS; variant++) {
        struct scene s;
        struct run e;
        if (!efficiency_variant_is_run_for_scene(c, variant)) continue;
        TRY(efficiency_make_run_of_variant(&e, &s, c, variant, 0));
        *time_step = fmin(*time_step, e.clock.dt);
        bench_engine_free(&e, &s);
    }
    return OK;
}

const char *efficiency_title(const struct scene_case *c, char *text, size_t capacity)
{
    snprintf(text, capacity, c->spacing ? "%s at %s" : "%s", c->name, c->spacing);
    return text;
}

void efficiency_write_tic_label(FILE *gnuplot, const struct scene_case *scene)
{
    fputc('"', gnuplot);
    for (const char *c = scene->name; *c; c++) fputs(*c == '_' ? "\\n" : (char[]){*c, '\0'}, gnuplot);
    fprintf(gnuplot, "\\n%s\\n%s\"", scene->model, scene->spacing ? scene->spacing : "");
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* Stores the crack tips of the run, the index of the longest crack, and the time of its first broken bond in *c. */
void crack_ends_store_from_run(struct crack_ends *c, const struct run *run)
{
    const struct crack_tip *longest = tips_find_tip_with_largest_growth(&run->fracture->tips);
    memcpy(c->tip, run->fracture->tips.tip, sizeof c->tip);
    c->tips = run->fracture->tips.n;
    c->longest = longest ? (int)(longest - run->fracture->tips.tip) : -1;
    c->start = run->diagnostics->break_time;
}

double position_distance(const real *position, const real *other_position)
{
    double sum = 0;
    for (int d = 0; d < DIM_MAX; d++) sum += square(position[d] - other_position[d]);
    return sqrt(sum);
}

const struct crack_tip *crack_tip_nearest_in_other_run(const struct crack_ends *other_run, const struct crack_tip *tip)
{
    const struct crack_tip *best = NULL;
    for (int k = 0; k < other_run->tips; k++)
        if (other_run->tip[k].growth > 0 && (!best || position_distance(other_run->tip[k].place, tip->place) <
                                                          position_distance(best->place, tip->place)))
            best = &other_run->tip[k];
    return best;
}
