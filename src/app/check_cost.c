/* Estimates the cost of a run from trial steps, in processor time of one thread, so that other programs do not count.
 * With one core for each thread the processor time of a thread equals the wall-clock time. A short run is executed as a
 * whole. Of a long run only the first steps are timed, with the whole body active. The effect of inactive parts,
 * conversion and reversion is measured in the same input file with larger particles, which is executed as a whole. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check_parts.h"
#include "engine/engine.h"
#include "base/memory.h"
#include "step/report.h"
#include "contact/contact.h"
#include "probes/probes_part.h"
#include "probes/probes.h"
#include "step/step.h"
#include "step/stability.h"
#include "scene/scene_read.h"
#include "step/checks.h"

/* Limits for measuring the time per step. PERIODS_MOST: largest number of measurements; WINDOWS_LEAST: least number. */
enum { PERIODS_MOST = 200, WINDOWS_LEAST = 5 };
#define SECONDS_ENOUGH 0.15        /* time of the measurements after which there are enough [s] */
#define SECONDS_MOST 1.0           /* time after which the measurements end in any case [s] */
#define SECONDS_WHOLE 1.5          /* time of a trial of a whole run [s] */
#define PATIENCE 3.0               /* factor on SECONDS_WHOLE, for conversion or a busy machine */
#define WALL_MOST 60.0             /* wall-clock time of such a trial [s] */
#define COARSER_MOST 4.0           /* factor on the spacing up to which a body breaks in about the same positions */
#define PARTS_BYTES 56             /* per particle, in addition with bonds: fragments of a broken body, damage */
#define OUTPUT_BYTES 4.6e6         /* memory of the HDF5 library, code and data; measured 3.9 to 6.5e6 [byte] */
#define START_SECONDS 0.02         /* start of a process and its summary [s] */
#define FILE_SECONDS 4e-3          /* time of a frame, checkpoint or profile of any size; measured [s] */
#define FILE_SECONDS_PARTICLE 8e-8 /* further time per particle; measured: frames of 320,000 take 26 ms [s] */
#define BONDS_MOST 2e8             /* largest number of bonds of a body that is tried as peridynamic throughout */
#define BONDS_TRIED 2e7            /* number of bonds of the coarser body that is tried instead of a larger one */

/* Returns the quartiles of n measured times spent[n] [s]; the array is sorted in place. */
static struct quartiles quartiles_of(double *spent, int n)
{
    const double median = median_by_sorting(spent, n);
    return (struct quartiles){spent[n / 4], median, spent[n - 1 - n / 4]};
}

/* Makes time steps of the run and measures the processor time of one step. Each measurement covers the steps from one
 * sample of the history to the next. *step: receives the quartiles of the measurements [s]. The first step, which has
 * cold caches, does not count. *bytes: receives the peak memory of this process after the first WINDOWS_LEAST
 * measurements [byte]: the number of measurements depends on the speed of the processor, and with conversion the memory
 * depends on their number; not written if NULL. Returns FAILED, with a message, if a step fails. */
static status time_steps(struct run *run, struct quartiles *step, double *bytes)
{
    const int64_t samples = run->scene->samples > 0 ? run->scene->samples : 1;
    const int64_t period = run->clock.steps / samples > 0 ? run->clock.steps / samples : 1;
    double spent[PERIODS_MOST], all = 0;
    int n = 0;
    run->report->quiet = run->warnings.silent = true;
    TRY(report_open_history_and_write_first_frame(run));
    const double begun = thread_cpu_clock_seconds();
    TRY(run_adapt_mesh_and_advance_one_step(run));
    const double first = thread_cpu_clock_seconds() - begun;
    while (n < PERIODS_MOST && all < SECONDS_MOST && (n < WINDOWS_LEAST || all < SECONDS_ENOUGH)) {
        const double start = thread_cpu_clock_seconds();
        int64_t taken = 0;
        for (; taken < period && run->clock.step < run->clock.steps - 1 &&
               thread_cpu_clock_seconds() - start < SECONDS_MOST;
             taken++)
            TRY(run_adapt_mesh_and_advance_one_step(run));
        if (taken == 0) break;
        all += thread_cpu_clock_seconds() - start;
        spent[n++] = (thread_cpu_clock_seconds() - start) / (double)taken;
        if (bytes && n == WINDOWS_LEAST) *bytes = (double)memory_peak_resident_size();
    }
    if (bytes && n < WINDOWS_LEAST) *bytes = (double)memory_peak_resident_size();
    *step = n > 0 ? quartiles_of(spent, n) : (struct quartiles){first, first, first};
    return OK;
}

/* Returns the processor time of one evaluation of the forces of the run [s], the median of several. */
static double time_force(struct run *run)
{
    double spent[PERIODS_MOST], all = 0;
    int n = 0;
    while (n < PERIODS_MOST && (all < SECONDS_ENOUGH || n < 3)) {
        const double start = thread_cpu_clock_seconds();
        run_compute_internal_forces(run);
        all += spent[n++] = thread_cpu_clock_seconds() - start;
    }
    return median_by_sorting(spent, n);
}

/* Returns the processor time of contact in one step of the run at its present state [s]: search and forces, the median
 * of several. */
static double time_contact(struct run *run)
{
    double spent[PERIODS_MOST], all = 0;
    int n = 0;
    while (n < PERIODS_MOST && (all < 0.1 * SECONDS_ENOUGH || n < 3)) {
        const double start = thread_cpu_clock_seconds();
        contact_update_pair_list_if_outdated(run->contact, &run->part, &run->bonds, &run->loads, &run->source.family,
                                             run->clock.step, run->contact->broken, run->contact->changed);
        contact_compute_forces(run->contact, &run->part, 0);
        all += spent[n++] = thread_cpu_clock_seconds() - start;
    }
    return median_by_sorting(spent, n);
}

/* ---- other scenes ------------------------------------------------------------------------------------------------ */

/* Reads the scene of the arguments a again to *s, with the additional override key=value (none if key is NULL), and
 * creates its run e. rest: true if inactive parts of the body may be skipped, as the scene requests. Returns FAILED or
 * REFUSED, with a message, if the scene cannot be read or its run cannot be created. The caller releases s and the run,
 * also on failure. */
static status make_other(struct scene *s, struct run *run, const struct run_arguments *a, const char *key,
                         const char *value, bool rest)
{
    struct scene_override *override = NEW("check.override", a->overrides + 1, struct scene_override);
    array_copy(override, a->override, a->overrides, sizeof *override);
    override[a->overrides] = (struct scene_override){key, value};
    const status read = scene_read(s, a->scene, override, key ? a->overrides + 1 : a->overrides);
    memory_free(override);
    TRY(read);
    s->active_set = s->active_set && rest;
    s->accept |= 1u << ACCEPT_SHOCK; /* as in check_sound */
    return run_set_up_from_scene(run, s, NULL);
}

/* Runs all steps of the run and returns their processor time [s]. Returns NAN if a step fails, if the processor time
 * exceeds PATIENCE * SECONDS_WHOLE (a few seconds), or if the wall-clock time exceeds WALL_MOST (a minute). */
static double all_steps(struct run *run)
{
    const double start = thread_cpu_clock_seconds(), began = wall_clock_seconds();
    run->report->quiet = run->warnings.silent = true;
    if (report_open_history_and_write_first_frame(run) != OK) return NAN;
    timers_start(&run->timers);
    while (run->clock.step < run->clock.steps) {
        if (run_adapt_mesh_and_advance_one_step(run) != OK || run_check_stability_after_step(run) != OK ||
            report_write_outputs_due_after_step(run) != OK)
            return NAN;
        if (thread_cpu_clock_seconds() - start > PATIENCE * SECONDS_WHOLE || wall_clock_seconds() - began > WALL_MOST)
            return NAN;
    }
    return run_repeat_with_mpm_only_for_pulse_probe(run) == OK ? thread_cpu_clock_seconds() - start : NAN;
}

/* Runs the input file of the arguments a with the additional override key=value (none if key is NULL). whole: true to
 * run and measure all steps; false to extrapolate the time from the first steps. found: receives the warnings of the
 * run, appended; or NULL. Returns the processor time of all steps [s]; NAN if a step fails. */
static double try_other(const struct run_arguments *a, const char *key, const char *value, bool whole,
                        struct warnings *found)
{
    struct scene s = {0};
    struct run e = {0};
    struct quartiles step;
    double seconds = NAN;
    if (make_other(&s, &e, a, key, value, whole) == OK) {
        memory_set_reuse_of_freed_arrays(whole);
        if (whole)
            seconds = all_steps(&e);
        else if (time_steps(&e, &step, NULL) == OK)
            seconds = step.median * (double)e.clock.steps;
    }
    memory_set_reuse_of_freed_arrays(false);
    if (found) warnings_append_missing_from_list(found, &e.warnings, 0);
    run_free_memory(&e);
    scene_free(&s);
    return seconds;
}

/* Returns the ratio r of the processor time of all steps of scene s (the input file) to the time extrapolated from its
 * first steps [1]. Both times are measured with particles so much larger that a whole run takes about SECONDS_WHOLE.
 * Returns NAN if a time cannot be measured, a body is read from a particle list, or the particles would have to be more
 * than COARSER_MOST times larger. Stores the factor by which the particles are larger in c->coarser, and r in
 * c->growth. a: arguments from which s was read; first: extrapolated time of the input file itself [s]. */
static double growth_of(struct cost *c, const struct scene *s, const struct run_arguments *a, double first)
{
    char value[32];
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].file) return NAN;
    c->coarser = ceil(pow(first / SECONDS_WHOLE, 1.0 / s->dim) * 4) / 4;
    if (c->coarser <= 1 || c->coarser > COARSER_MOST) return NAN;
    snprintf(value, sizeof value, "%.17g", c->coarser * s->spacing);
    c->growth =
        try_other(a, "particles.spacing", value, true, NULL) / try_other(a, "particles.spacing", value, false, NULL);
    return c->growth;
}

/* ---- the estimate ------------------------------------------------------------------------------------------------ */

/* Returns the number of neighbours of a particle far from surfaces: the volume of its complete neighbourhood f (all
 * neighbours within the horizon) divided by that of a lattice cell [1]. */
static double family_size(const struct family *f) { return f->full / f->cell_volume; }

/* Returns an estimate of the time for writing the output of the run [s]: all frames (outputs of all particles at one
 * time) including the one at the start, two checkpoints, profiles and particle series. */
static double output_seconds(const struct run *run)
{
    double files = (double)(run->scene->frames < run->clock.steps ? run->scene->frames : run->clock.steps) + 3;
    for (int k = 0; k < run->scene->n_series; k++) /* all particles are updated for each frame of a region */
        files += fmin(run->scene->duration / run->scene->series[k].every, (double)run->clock.steps) + 1;
    return START_SECONDS + files * (FILE_SECONDS + FILE_SECONDS_PARTICLE * (double)run->part.n +
                                    FILE_SECONDS * (double)probes_count_profiles(&run->probing->probes));
}

/* Factors between the estimated run time and its bounds, for each basis of the estimate: lower bound estimate / below,
 * upper bound estimate * above. The values are empirical, from input files of all kinds
 * (tests/scenes/long_forecast.sh). */
static const struct {
    double below, above;
} range[] = {[COST_TRIED] = {1.3, 1.5}, [COST_SCALED] = {1.6, 1.6}, [COST_FIRST] = {2, 1.5}};
#define SPREAD_MOST 1.5 /* largest factor by which the scatter of measurements widens the bounds of the time [1] */

/* Estimates the time c->run of the whole run with set-up and output, and its bounds c->least and c->most [s]. Stores in
 * c->basis whether the time was measured, scaled or extrapolated. If the whole run was measured, its warnings replace
 * those in c->found. The caller must have set c->make, c->step, c->spread and c->output. clock: number of steps; scene,
 * a: scene, and arguments from which it was read. */
static void cost_run(struct cost *c, const struct run_clock *clock, const struct scene *scene,
                     const struct run_arguments *a)
{
    const double first = c->step * (double)clock->steps;
    double loop = NAN;
    struct warnings found = {0};
    if (first < PATIENCE * SECONDS_WHOLE) loop = try_other(a, NULL, NULL, true, &found);
    c->basis = COST_TRIED;
    if (!isnan(loop)) { /* includes the warnings of the first steps, whose time may differ in the last digits */
        warnings_free(&c->found);
        warnings_append_missing_from_list(&c->found, &found, 0);
    }
    warnings_free(&found);
    if (isnan(loop)) {
        const double growth = growth_of(c, scene, a, first);
        c->basis = isnan(growth) ? COST_FIRST : COST_SCALED;
        loop = first * (isnan(growth) ? 1 : growth);
    }
    c->run = c->make + loop + c->output;
    c->least = c->run / range[c->basis].below / fmin(c->spread, SPREAD_MOST);
    c->most = c->run * range[c->basis].above * fmin(c->spread, SPREAD_MOST);
}

/* Returns the processor time of one step per particle [s], measured with the input file of the arguments a, but with
 * all particles peridynamic and with `spacing` [m]; NAN if the steps fail. */
static double step_peridynamic(const struct run_arguments *a, double spacing)
{
    struct scene s = {0};
    struct run e = {0};
    struct run_arguments coarse = *a;
    struct quartiles step;
    double seconds = NAN;
    char value[32];
    snprintf(value, sizeof value, "%.17g", spacing);
    coarse.override = NEW("check.coarse", a->overrides + 1, struct scene_override);
    array_copy(coarse.override, a->override, a->overrides, sizeof *a->override);
    coarse.override[coarse.overrides++] = (struct scene_override){"particles.spacing", value};
    if (make_other(&s, &e, &coarse, "method", "pd", false) == OK && time_steps(&e, &step, NULL) == OK)
        seconds = step.median / (double)e.part.n;
    memory_free(coarse.override);
    run_free_memory(&e);
    scene_free(&s);
    return seconds;
}

/* Estimates the time of the run, if it is adaptive, with all its particles peridynamic: c->all_peridynamic [s].
 * Measures first steps of such a run, or of one with larger particles if there are more than BONDS_MOST bonds. If
 * c->run is only an extrapolation, the upper bound c->most is raised to this time, or to INFINITY if it is unknown. */
static void cost_peridynamic(struct cost *c, const struct run *run, const struct run_arguments *a)
{
    const struct scene *s = run->scene;
    const double n = (double)run->part.n_body, bonds = n * family_size(&run->source.family);
    double loop = NAN;
    if (s->method != METHOD_ADAPTIVE) return;
    if (bonds < BONDS_MOST)
        loop = try_other(a, "method", "pd", false, NULL);
    else if (run->part.n < run->part.n_body)
        loop = n * (double)run->clock.steps * step_peridynamic(a, s->spacing * pow(bonds / BONDS_TRIED, 1.0 / s->dim));
    c->all_peridynamic = c->make + loop + c->output;
    if (c->basis == COST_FIRST) c->most = c->all_peridynamic > 0 ? fmax(c->most, c->all_peridynamic) : INFINITY;
}

/* Returns an estimate of the memory for writing the output of `scene` with n particles [byte]. It is added to the
 * memory measured in trial steps, which write nothing. */
static double output_bytes(int64_t n, const struct scene *scene)
{
    /* per particle, by dimension: copy for the writer, the sort order, what goes to the particles file; measured */
    static const double frame[DIM_MAX + 1] = {0, 30, 53, 89};
    return OUTPUT_BYTES + (double)n * (frame[scene->dim] + (scene->method == METHOD_MPM ? 0 : PARTS_BYTES));
}

status run_cost_measure_by_trial_steps(struct cost *c, struct run *run, const struct run_arguments *a)
{
    const int known = run->warnings.n;
    c->particles_at_start = run->part.n;
    c->all_peridynamic = NAN;
    run->warnings.silent = true;
    if (scene_has_load_steps(run->scene)) {
        c->output =
            output_seconds(run) + FILE_SECONDS * run->scene->steps.number; /* one checkpoint after each load step */
        const status result = load_steps_estimate_run_cost(c, run);
        warnings_append_missing_from_list(&c->found, &run->warnings, known);
        TRY(result);
        c->bytes = (double)memory_peak_resident_size() + output_bytes(c->particles_at_start, run->scene);
        return OK;
    }
    if (scene_is_single_equilibrium(run->scene)) {
        /* conjugate gradients use central differences of forces: two evaluations per iteration
         * (static_body_compute_tangent_stiffness_product) */
        c->step = (run->scene->solver == SOLVER_CG ? 2 : 1) * time_force(run);
        c->bytes = (double)memory_peak_resident_size() + output_bytes(c->particles_at_start, run->scene);
        return OK;
    }
    struct quartiles step;
    const status result = time_steps(run, &step, &c->bytes);
    warnings_append_missing_from_list(&c->found, &run->warnings, known);
    TRY(result);
    c->step = step.median, c->spread = real_max(step.upper / step.median, step.median / step.lower);
    c->contact = time_contact(run) / c->step;
    c->bytes += output_bytes(c->particles_at_start, run->scene);
    c->output = output_seconds(run);
    cost_run(c, &run->clock, run->scene, a);
    cost_peridynamic(c, run, a);
    return OK;
}
