/* Writes the reports of a run: schedules and writes output frames and checkpoints, and prints the progress line. */
#include "step/report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "bonds/closing.h"
#include "bonds/struts.h"
#include "fracture/fragments.h"
#include "rigid/rigid_surface.h"
#include "output/output_files.h"
#include "output/output.h"
#include "contact/contact.h"
#include "fracture/fracture_part.h"
#include "mesh/mesh_part.h"
#include "step/step.h"
#include "probes/probes_part.h"
#include "run/say.h"
#include "step/sample.h"
#include "step/checks.h"

#define PROGRESS_SECONDS 0.5       /* time between progress lines on a terminal [s] */
#define PROGRESS_SECONDS_FILE 60.0 /* time between progress lines in a file [s] */
#define CHECKPOINT_SECONDS 60.0    /* least time between checkpoints with output.checkpoint: auto [s] */
#define CHECKPOINT_SHARE 0.03      /* largest share of the time of a run that such checkpoints take [1] */

/* ---- schedule ---------------------------------------------------------------------------------------------------- */

/* Returns the step nearest to step number `step` at which the mesh cells of all levels have reached the same time.
 * Coarser cells have longer time steps, so this happens only after each multiple of clock->stride steps. */
static int64_t common_step(const struct run_clock *clock, int64_t step)
{
    return (step + clock->stride / 2) / clock->stride * clock->stride;
}

/* Returns the step after which event k (from 0) of n events spread evenly over the run is due: k steps/n, rounded. The
 * product k steps is avoided, since it can exceed 64 bits. Returns the last step if n <= 0. clock: number of steps of
 * the run. */
static int64_t due_step(const struct run_clock *clock, int64_t k, int64_t n)
{
    if (n <= 0) return clock->steps;
    return common_step(clock, k * (clock->steps / n) + (k * (clock->steps % n) + n / 2) / n);
}

int64_t report_frame_count_of_run(const struct scene *s, const struct run_clock *clock)
{
    const int64_t most = clock->steps / clock->stride;
    return s->frames < most ? s->frames : most;
}

/* Returns the step after which frame k (from 0) of the whole body is written. It is the step nearest to the time that
 * the scene s gives for the frame, or one of evenly spread steps if the input file (scene) gives no times. If frames
 * are closer together than the steps, some are written at later or earlier steps, so that each output frame has a step
 * of its own. clock: number and length of steps. */
int64_t report_step_number_of_frame(const struct scene *s, const struct run_clock *clock, int64_t k)
{
    const struct number_list *times = &s->times;
    const int64_t n = report_frame_count_of_run(s, clock);
    if ((times->n == 0 && s->every == 0) || k < 1) return due_step(clock, k, n);
    const real time = k > n ? 0 : s->every > 0 ? real_min((real)k * s->every, s->duration) : times->value[k - 1];
    int64_t step = k <= n ? (int64_t)floor(time / clock->dt + 0.5) : clock->steps, last = clock->steps - (n - k);
    return common_step(clock, step < k ? k : step > last ? last : step);
}

bool report_history_sample_is_due(const struct scene *s, const struct run_clock *clock)
{
    const int64_t most = clock->steps / clock->stride, n = s->samples < most ? s->samples : most;
    if (!scene_is_dynamic(s)) return clock->step == 0; /* the start; the equilibrium is a sample of its own */
    return due_step(clock, (clock->step * n + clock->steps / 2) / clock->steps, n) == clock->step;
}

/* ---- frames and checkpoints -------------------------------------------------------------------------------------- */

/* Returns FAILED, with a message, if stress, position or velocity of a particle is not finite. clock: for the message.
 * Positions and speeds are also checked in every step, and energies at samples; this check adds the stresses. p: all
 * particles. */
static status frame_sound(const struct run_clock *clock, const struct particles *p)
{
    int64_t first = p->n;
#pragma omp parallel for schedule(static) reduction(min : first)
    for (int64_t i = 0; i < p->n; i++) {
        real sum = 0;
        for (int k = 0; k < symmetric_tensor_component_count(p->dim); k++) sum += 0 * p->stress[k][i];
        for (int d = 0; d < p->dim; d++) sum += 0 * (p->x[d][i] + p->v[d][i]);
        if (!(sum == 0) && i < first) first = i;
    }
    if (first == p->n) return OK;
    return status_set(FAILED,
                      "step %lld, t = %.4g s: particle %d has a stress, position or velocity that is not finite: check "
                      "material, supports and initial state (`cleave check`)",
                      (long long)clock->step, clock->t, (int)p->id[first]);
}

struct run_seconds report_wall_clock_times(const struct run_report *r, const struct timers *timers)
{
    struct run_seconds s = r->before;
    s.wall += wall_clock_seconds() - r->began;
    s.setup += r->setup_seconds;
    for (int k = 0; k < TIMERS; k++)
        if (k != TIMER_OUTPUT) s.loop += timers->spent[k];
    return s;
}

/* Returns true if frame number `frames` (from 0; a frame is an output file of one time) of the whole body is to be
 * written after `step` steps. s: times of frames; clock: number and length of steps. */
static bool body_frame_due(const struct scene *s, const struct run_clock *clock, int frames, int64_t step)
{
    return frames <= report_frame_count_of_run(s, clock) && step >= report_step_number_of_frame(s, clock, frames);
}

/* Returns true if frame number `frames` (from 0; a frame is an output file of one time) of a region is to be written
 * after `step` steps. Frames are written every `every` [s] and at the end of the run; if several fall into one step,
 * only one is written. duration: duration of the run [s]; clock: number and length of steps. */
static bool region_frame_due(const struct run_clock *clock, real every, real duration, int frames, int64_t step)
{
    if (frames > (int64_t)ceil(duration / every * (1 - 1e-12))) return false;
    const int64_t due = (int64_t)floor(real_min((real)frames * every, duration) / clock->dt + 0.5);
    return step >= (due < clock->steps ? common_step(clock, due) : clock->steps);
}

unsigned report_frame_series_due_after_step_as_bitmask(const struct output *out, const struct scene *s,
                                                       const struct run_clock *clock, int64_t step)
{
    const bool at_rest = scene_is_single_equilibrium(s);
    unsigned due = 0;
    if (!out || (at_rest && step > 0 && step < clock->steps)) return 0;
    if (body_frame_due(s, clock, out->series[0].frames, step)) due |= 1;
    for (int k = 1; k <= out->n_series; k++)
        if (at_rest || region_frame_due(clock, s->series[k - 1].every, s->duration, out->series[k].frames, step))
            due |= 1u << k;
    return due;
}

/* Returns the fields that the output frames of series k contain, as bits ASK_... (output/output.h): the fields given
 * for the series, else those of the scene. Series 0 is the whole body; series 1, 2, .. are regions. */
static unsigned asked_of(const struct scene *scene, int k)
{
    return k > 0 && scene->series[k - 1].fields ? scene->series[k - 1].fields : scene->fields;
}

/* Writes a frame (output file of one time) of the run for each series of frames in `due`, and for the body also rigid
 * bodies and profiles. due: series of which a frame is to be written now, as bits: bit 0 for the whole body, bit k for
 * region k. Frames at t = 0 have no contact forces. Returns FAILED, with a message, if a value is not finite or a file
 * cannot be written. */
static status write_frames(struct run *run, unsigned due)
{
    const bool parts = run->scene->method == METHOD_PD && scene_can_have_cracks(run->scene);
    struct output *out = run->report->out;
    struct fragments fragments = {0};
    unsigned asked = 0;
    status s = OK;
    if (run->frame->shown.part.n > 0)
        TRY(output_wait_until_frame_is_written(out)); /* the writer may still read the points */
    run_update_particle_motion_and_stress(run);
    TRY(frame_sound(&run->clock, &run->part));
    if (parts) fragments_find_by_intact_bonds(&fragments, &run->bonds, &run->part);
    for (int k = 0; k <= out->n_series; k++)
        if (due >> k & 1) asked |= asked_of(run->scene, k);
    struct frame_extra extra = {.push = run->contact->push[0] ? run->contact->push : NULL,
                                .fragment = fragments.of,
                                .material_number = run->scene->material_number};
    if (coarse_cell_points_interpolate_for_output(run->frame, &run->part, run->scene->material,
                                                  asked & (ASK_STRAIN | ASK_DENSITY))) {
        extra.more = &run->frame->shown.part, extra.more_spacing = run->frame->shown.spacing;
        extra.spacing = run->scene->spacing;
    }
    frame_fields_compute_requested(run, asked, &extra);
    for (int k = 0; k <= out->n_series && s == OK; k++) {
        if (!(due >> k & 1)) continue;
        extra.asked = asked_of(run->scene, k);
        s = output_begin_writing_frame_in_thread(out, k, &run->part, &extra, run->clock.t, run->clock.step,
                                                 run->scene->text);
    }
    frame_fields_free(&extra);
    fragments_free(&fragments);
    const struct observed_run seen = observed_run_make_read_only_view(run);
    if (s == OK && due & 1) s = rigids_write_surfaces_of_frame(run->rigid, out, &run->part);
    return s == OK && due & 1 ? profiles_write_csv_files(&run->probing->probes, out, &seen) : s;
}

/* Writes a checkpoint of the run and adds the time that this took to run->report, without the time of waiting for an
 * output frame. Returns FAILED, with a message, if the file cannot be written. */
static status write_checkpoint(struct run *run)
{
    struct run_report *r = run->report;
    lagrangian_mesh_update_point_motion_and_stress(run->frame, &run->part, &run->loads);
    r->last_checkpoint = wall_clock_seconds();
    TRY(output_wait_until_frame_is_written(r->out));
    const double begun = wall_clock_seconds();
    TRY(checkpoint_write(r->out, run->scene->text, run->save, run));
    const double now = wall_clock_seconds();
    r->checkpoint_seconds = real_max(r->checkpoint_seconds, now - r->last_checkpoint);
    r->checkpoints_spent += now - begun;
    return OK;
}

/* Returns true if a checkpoint is to be written after a time step or load step. If the input file (scene) gives an
 * interval, it is written after this time, and after every load step. Otherwise it is written after
 * CHECKPOINT_SECONDS, or after a load step, but only if checkpoints so far took less than the share CHECKPOINT_SHARE
 * of the run time. r: times of earlier checkpoints; s: scene. */
static bool checkpoint_due(const struct run_report *r, const struct scene *s)
{
    const bool in_steps = scene_has_load_steps(s);
    const double now = wall_clock_seconds(), since = now - r->last_checkpoint;
    if (!isnan(s->checkpoint_interval)) return in_steps || since > s->checkpoint_interval;
    const bool cheap = r->checkpoints_spent + r->checkpoint_seconds <= CHECKPOINT_SHARE * (now - r->started);
    return cheap && (in_steps || since > CHECKPOINT_SECONDS);
}

/* Returns true if the run with the report `report` has to stop because of the wall-clock time that the scene s allows:
 * the time that remains is less than twice the duration of the longest checkpoint so far, which must still be
 * written. */
static bool wall_is_over(const struct scene *s, const struct run_report *report)
{
    return wall_clock_seconds() - report->began + 2 * report->checkpoint_seconds >= s->wall;
}

/* Adds warnings to `to` and prints them, for output frames and profiles that a resumed run should have, but whose
 * files are missing. out: output of the run; probes: probes with profiles. Returns FAILED, with a message, if the list
 * of frames cannot be read. */
static status say_lost(struct output *out, const struct probes *probes, struct warnings *to)
{
    char text[2 * PATH_NAME_ROOM + 300];
    int lost;
    TRY(output_remove_missing_frames_from_index(out, &lost, text, sizeof text));
    if (lost > 0) warnings_add_and_print(to, text);
    profiles_warn_of_missing_files(probes, out, to);
    return OK;
}

status report_open_history_and_write_first_frame(struct run *run)
{
    struct run_report *r = run->report;
    r->started = r->last_progress = r->last_checkpoint = wall_clock_seconds();
    r->step_started = run->clock.step;
    /* the checkpoint of step 0 counts frame 0 */
    const bool resumed = r->out && r->out->series[0].frames > 0;
    status s = history_sample_open_csv_file(run, resumed);
    if (s == OK && r->out) contact_allocate_particle_forces(run->contact, &run->part);
    r->setup_seconds += wall_clock_seconds() - r->started;
    if (s == OK && r->out && resumed) s = say_lost(r->out, &run->probing->probes, &run->warnings);
    if (s == OK && r->out && !resumed) {
        profiles_remove_files_of_earlier_run(&run->probing->probes, r->out);
        /* frame 0 of the body is always written */
        s = write_frames(run, report_frame_series_due_after_step_as_bitmask(r->out, run->scene, &run->clock, 0) | 1);
        if (s == OK) s = write_checkpoint(run);
        r->checkpoints_spent = 0;
    }
    return s;
}

/* ---- progress ---------------------------------------------------------------------------------------------------- */

/* Writes the duration `seconds` [s] to text[size], in s, min or h depending on its size. */
static void duration_text(char *text, size_t size, double seconds)
{
    if (seconds < 100)
        snprintf(text, size, "%.0f s", seconds);
    else if (seconds < 6000)
        snprintf(text, size, "%.0f min", seconds / 60);
    else
        snprintf(text, size, "%.1f h", seconds / 3600);
}

/* Prints the progress line of the run on stderr if PROGRESS_SECONDS (in a file PROGRESS_SECONDS_FILE) have passed since
 * the previous line. Prints nothing if run->report->quiet is true. last: true after the last step, when the line is
 * always printed on a terminal. */
static void progress(struct run *run, bool last)
{
    if (run->report->quiet) return;
    bool terminal = isatty(STDERR_FILENO);
    double now = wall_clock_seconds();
    if (!last && now - run->report->last_progress < (terminal ? PROGRESS_SECONDS : PROGRESS_SECONDS_FILE)) return;
    if (last && !terminal) return;
    run->report->last_progress = now;
    double rate = (double)(run->clock.step - run->report->step_started) / real_max(now - run->report->started, 1e-9);
    char left[32];
    duration_text(left, sizeof left, rate > 0 ? (double)(run->clock.steps - run->clock.step) / rate : 0);
    const struct crack_tip *tip = tips_find_tip_with_largest_growth(&run->fracture->tips);
    const char *const from = terminal ? "\r" : "";
    if (scene_has_load_steps(run->scene))
        fprintf(stderr, "%sload step %lld/%lld  %s  at most %s left", from, (long long)run->clock.step,
                (long long)run->clock.steps, run->report->note, left);
    else
        fprintf(stderr, "%sstep %lld/%lld  t = %.4g s  %.0f steps/s  %s left", from, (long long)run->clock.step,
                (long long)run->clock.steps, run->clock.t, rate, left);
    fprintf(stderr, "  PD %.1f %%  crack %.3g mm%s", 100.0 * (double)run->part.n_of[KIND_PD] / (double)run->part.n_body,
            tip ? 1e3 * tip->growth : 0.0, terminal && !last ? "\033[K" : "\n");
    fflush(stderr);
}

/* ---- after a step ------------------------------------------------------------------------------------------------ */

/* Returns the fraction of all particles that are still at rest, which time steps skip (data/active_set.h) [1]:
 * peridynamic particles by blocks of eight rows of the bonds b, material points by the mesh. p: all particles. */
real particles_at_rest_fraction(const struct bonds *b, const struct mesh *mesh, const struct particles *p)
{
    real at_rest = active_set_inactive_fraction(&b->active) * (real)p->n_of[KIND_PD];
    if (mesh->points > 0) at_rest += active_set_inactive_fraction(&mesh->active) * (real)mesh->points;
    return at_rest / (real)p->n;
}

/* Adds to `to` and prints, once in a run, the warning that softening bonds of b act as struts under pressure at a
 * particle of p (bonds/struts.h), if they do. limit: onsets of softening. */
static void say_struts(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                       struct warnings *to)
{
    if (!bonds_any_softened_crack_carries_compression(b, p, limit)) return;
    warnings_add_and_print(
        to,
        "beside bonds that have softened and ended, others press with more than five times the tensile strength: bonds "
        "do not fail under pressure, so a crack that is sheared under pressure does not slide, and columns between "
        "cracks do not crush; do not trust larger loads at later times (inputs/strength_surface.md)");
}

/* Adds to `to` and prints, once in a run, the warning that the faces of cracks between particles of p overlap in load
 * steps with softening bonds b (bonds/closing.h), if they do. limit: onsets of softening; model: of the bonds; t:
 * pseudo-time [s]. */
static void say_overlap(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                        enum model model, real t, struct warnings *to)
{
    static const char *const begin = "crack faces overlap: ";
    for (int k = 0; k < to->n; k++)
        if (!strncmp(to->text[k], begin, strlen(begin))) return;
    const struct bond_overlap found = bonds_find_overlap_at_cracks(b, p, limit);
    char text[640];
    if (found.pairs == 0) return;
    snprintf(text, sizeof text,
             "%sat t = %.3g s %lld pairs of particles at ended bonds or at a pre-crack are pressed together by up to "
             "%.3g m, beyond the strength, without a force: load steps with bonds that soften have no contact there; "
             "%sset solver: explicit with contact.between: all, or remove the loads that close the crack",
             begin, t, (long long)found.pairs, found.deepest,
             model == MODEL_BOND ? "" : "set model: bond, whose ended bonds press, or ");
    warnings_add_and_print(to, text);
}

status report_write_outputs_due_after_step(struct run *run)
{
    struct run_report *r = run->report;
    const bool last = run->clock.step == run->clock.steps, in_steps = scene_has_load_steps(run->scene);
    r->particle_steps[KIND_PD] += run->part.n_of[KIND_PD];
    r->particle_steps[KIND_MPM] += run->part.n_of[KIND_MPM];
    r->bond_visits += run->bonds.n;
    r->inactive += particles_at_rest_fraction(&run->bonds, &run->frame->mesh, &run->part);
    timer_add_elapsed_to_section(&run->timers, TIMER_SAMPLE);
    /* before the checkpoint, so that a finished run is complete */
    if (last && !in_steps) history_sample_write_after_last_step(run);
    TRY(r->history_status);
    TRY(run_check_last_sample_for_energy_divergence(run));
    if (last) run_warn_of_unconserved_energy_and_momentum(run);
    if (last) warn_of_tips_above_rayleigh_speed(&run->fracture->tips, run->scene, &run->warnings);
    if (last || in_steps) warn_when_bonds_first_yield(r, &run->bonds, run->scene, &run->warnings);
    if (last || in_steps || r->sampling.due) say_struts(&run->bonds, &run->part, &run->source.limit, &run->warnings);
    if (in_steps)
        say_overlap(&run->bonds, &run->part, &run->source.limit, run->scene->model, run->clock.t, &run->warnings);
    if (r->out) {
        const unsigned due =
            report_frame_series_due_after_step_as_bitmask(r->out, run->scene, &run->clock, run->clock.step);
        if (due) TRY(write_frames(run, due));
        const bool late = wall_is_over(run->scene, r), stop = late || (r->stop && *r->stop);
        if (stop || checkpoint_due(r, run->scene)) TRY(write_checkpoint(run));
        if (stop && !last)
            return status_set(INTERRUPTED, "%s at step %lld of %lld; continue with --resume",
                              late ? "the wall-clock limit time.wall is reached" : "interrupted",
                              (long long)run->clock.step, (long long)run->clock.steps);
    }
    progress(run, false);
    timer_add_elapsed_to_section(&run->timers, TIMER_OUTPUT);
    return OK;
}

status report_write_last_checkpoint_and_finish(struct run *run)
{
    struct run_report *r = run->report;
    progress(run, true);
    if (!r->out) return OK;
    TRY(output_wait_until_frame_is_written(r->out));
    if (run->clock.step > r->step_started) TRY(write_checkpoint(run));
    return OK;
}
