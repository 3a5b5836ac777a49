/* Implements `cleave run`: reads an input file, runs it and writes the results. */
#include <math.h>
#include <omp.h>
#include <stdio.h>

#include "arguments.h"
#include "base/busy.h"
#include "commands.h"
#include "engine/engine.h"
#include "scene/scene_read.h"
#include "study/pilot.h"
#include "study/uncertainty.h"
#include "fracture/fracture_part.h"
#include "probes/diagnostics.h"
#include "fracture/tips.h"
#include "quasistatic/statics.h"
#include "coupling/coupling_part.h"
#include "step/report.h"
#include "output/output.h"
#include "output/output_files.h"
#include "report/report.h"
#include "mesh/mesh_part.h"

/* ---- run --------------------------------------------------------------------------------------------------------- */

/* Prints the growth of the crack that ends at *tip, its direction and its ends; in a bar the growth of the zone of
 * broken bonds. dim: number of dimensions. The length [m] has the SI prefix with which it has up to three digits before
 * the point. */
static void print_longest(const struct crack_tip *tip, int dim)
{
    static const struct {
        double size;
        const char *name;
    } units[] = {{1e3, "km"}, {1, "m"}, {1e-3, "mm"}, {1e-6, "um"}, {1e-9, "nm"}};
    size_t k = 0;
    while (k + 1 < COUNT_OF(units) && tip->growth < 0.9995 * units[k].size) k++;
    printf("longest %s grew %.4g %s", dim > 1 ? "crack" : "zone of broken bonds", tip->growth / units[k].size,
           units[k].name);
    if (dim > 1) printf(" at %.3g degrees", tip_deflection_angle(tip, dim));
    printf(", from (%s)", position_text(tip->origin, dim, 4).text);
    if (dim > 1) printf(" to (%s)", position_text(tip->place, dim, 4).text);
    printf(" m");
    if (dim > 1 && !tip->from_crack) printf(", not from a pre-crack");
    if (tip->joined > 0)
        printf(", %.0f %% of it by joining others, which has no speed", 100 * tip->joined / tip->growth);
}

/* Prints how bonds broke in the run: when and at how many positions they broke first, the growth, angle and ends of
 * the longest crack, and when a bond first broke at a particle that a boundary drives. Prints nothing if no bond broke.
 */
static void print_breaks(const struct run *run)
{
    const struct diagnostics *diagnostics = run->diagnostics;
    const struct crack_tip *tip = tips_find_tip_with_largest_growth(&run->fracture->tips);
    const bool in_steps = scene_has_load_steps(run->scene), broke = !isnan(diagnostics->break_time);
    const int64_t tied = tips_count_crack_ends_with_largest_growth(&run->fracture->tips);
    if (broke && in_steps)
        printf("  first bond broken in load step %.0f", diagnostics->break_time / run->clock.dt);
    else if (broke)
        printf("  first bond broken at %.4g s", diagnostics->break_time);
    if (broke && diagnostics->break_ends > 1) printf(" at %lld positions", (long long)diagnostics->break_ends);
    if (tip) printf(broke ? ", " : "  ");
    if (tip) print_longest(tip, run->part.dim);
    if (tied > 1) printf(", one of %lld tips whose growth is equal to within a spacing", (long long)tied);
    if (broke || tip) printf("\n");
    if (isnan(diagnostics->driven_time)) return;
    if (in_steps)
        printf("  first broken bond of particles that a boundary moves: in load step %.0f\n",
               diagnostics->driven_time / run->clock.dt);
    else
        printf("  first broken bond of particles that a boundary moves: at %.4g s\n", diagnostics->driven_time);
}

/* Prints the energy that the load steps have released so far, and the area of the crack, from r, the record of the load
 * steps. softens: true if bonds soften before they break. */
static void print_release(const struct steps_record *r, bool softens)
{
    const bool beside_mirror = r->face > r->area;
    printf("  released %.4g J%s over %.4g m^2 of new crack: %.4g J/m^2%s%s\n", r->released,
           beside_mirror ? " on this side of the mirror" : "", r->face, r->released / r->area,
           beside_mirror ? " on both sides" : "",
           softens ? ", part of it in bonds that still soften and have no crack area yet, so not G_c" : "");
}

static void print_summary(const struct run *run, const char *folder, double wall)
{
    const struct printable_name shown = printable_name(folder);
    const bool in_steps = scene_has_load_steps(run->scene);
    printf("%s: %lld particles, ", run->scene->name, (long long)run->part.n_body);
    if (in_steps)
        printf("%lld load steps, %lld equilibria, %.1f s\n", (long long)run->clock.step,
               (long long)run->statics->solutions, wall);
    else
        printf("%lld steps of %.4g s, %.1f s\n", (long long)run->clock.step, run->clock.dt, wall);
    print_breaks(run);
    if (in_steps && run->statics->record.area > 0) print_release(&run->statics->record, run->bonds.soft.curve != NULL);
    printf("  peridynamic particles: %.2f %% at the start, %.2f %% at the end\n",
           100.0 * (double)run->coupling->conversion.start / (double)run->part.n_body,
           100.0 * (double)run->part.n_of[KIND_PD] / (double)run->part.n_body);
    printf("  energy balance %.2g, momentum %.2g\n", run->diagnostics->now.balance_error,
           run->diagnostics->now.momentum_error);
    printf("  results in %s; open %s/frames.hdf.series in ParaView, or draw them with: cleave plot %s\n", shown.text,
           shown.text, shown.text);
}

static status open_folder(struct output *out, const struct scene *s, const struct run_arguments *a)
{
    char folder[sizeof s->name + sizeof "results/"];
    snprintf(folder, sizeof folder, "results/%s", s->name);
    const enum output_mode mode = a->resume ? OUTPUT_RESUME : a->overwrite ? OUTPUT_OVERWRITE : OUTPUT_FIRST;
    const char *to = a->folder ? a->folder : folder;
    for (int k = 0; k < s->n_series; k++) TRY(output_check_series_folder_can_be_created(to, s->series[k].name));
    const status opened = output_open(out, to, s->text, mode, s->compress);
    TRY(out->has_other_scene ? scene_prepend_location_to_error_message(s, opened) : opened);
    for (int k = 0; k < s->n_series; k++) TRY(output_add_frame_series(out, s->series[k].name, &s->series[k].region));
    return OK;
}

/* Creates run e of scene s (the input file), opens its folder as `out`, resumes from a checkpoint if the arguments a
 * request it, runs to the end and writes the summary. The folder is opened after the run is created, so that a refused
 * input file leaves no folder. threads: number of threads, for messages and the summary. Returns OK, REFUSED, FAILED,
 * or INTERRUPTED if a signal ended the run early. */
static status run_engine(struct run *e, const struct scene *s, struct output *out, const struct run_arguments *a,
                         int threads)
{
    char busy[256];
    const double start = wall_clock_seconds(), load = machine_load_average();
    run_print_notice_if_set_up_takes_long(s);
    TRY(run_set_up_from_scene(e, s, out)); /* before the folder is opened, so that a refused scene leaves none */
    const double made = wall_clock_seconds();
    TRY(open_folder(out, s, a));
    const double opened = wall_clock_seconds();
    e->report->began = start;
    e->report->quiet = a->quiet;
    run_warn_of_suspicious_input(e);
    const struct levels_choice levels = mesh_levels_choose_level_count(e->frame, &e->part, s, e->clock.dt_critical);
    char coarse[1024];
    if (mesh_levels_given_by_scene_are_too_many(&levels, e->frame, s, coarse, sizeof coarse))
        warnings_add_if_new(&e->warnings, "%s", coarse);
    warnings_print(&e->warnings, 0, stderr);
    if (threads > 2 * omp_get_num_procs())
        fprintf(stderr, "warning: %d threads share %d hardware threads, which slows the run; use fewer (-t)\n", threads,
                omp_get_num_procs());
    if (!a->quiet &&
        machine_compose_warning_if_overloaded(busy, sizeof busy, load, machine_physical_core_count(), threads))
        printf("  %s\n", busy);
    e->report->stop = stop_signals_install_handlers();
    if (a->resume && checkpoint_exists(out->folder)) TRY(checkpoint_read(out, s->text, run_load_checkpoint, e));
    if (a->resume && !a->quiet && e->clock.step >= e->clock.steps)
        fprintf(stderr, "the run in %s is finished: no step is left, and only its summary is written again\n",
                printable_name(out->folder).text);
    output_remove_single_vtkhdf_with_all_frames(out);
    e->report->setup_seconds = wall_clock_seconds() - opened + made - start;
    status ran = run_advance_to_end_time(e);
    const double run = wall_clock_seconds();
    if (ran == OK) ran = run_repeat_with_mpm_only_for_pulse_probe(e);
    e->report->setup_seconds += wall_clock_seconds() - run;
    if (ran == OK || ran == INTERRUPTED) {
        const status temporal = output_write_single_vtkhdf_with_all_frames(out, s->text);
        if (temporal != OK) ran = temporal;
    }
    struct error_bar bar[ERROR_BARS_MOST];
    e->report->bar = bar;
    e->report->bars = error_bars_read_from_convergence_study(bar, ERROR_BARS_MOST, s, out->folder);
    status written = ran == REFUSED ? OK : run_write_summary_files(e, ran, threads);
    if (ran != OK) return ran;
    TRY(written);
    if (!a->quiet) print_summary(e, out->folder, wall_clock_seconds() - start);
    return OK;
}

status command_run_main(int argc, char **argv)
{
    const volatile sig_atomic_t *stop =
        stop_signals_install_handlers(); /* before the scene is read, which can take seconds */
    struct run_arguments a;
    struct pilot_choice pilot;
    struct path folder = {{0}};
    const bool page = arguments_remove_option(&argc, argv, "--report");
    TRY(arguments_read(&a, argc, argv, "run " RUN_WORDS));
    int threads = threads_set_count_and_bind_to_cores(a.threads);
    struct scene s = {0};
    struct run e = {0};
    struct output out = {0};
    status result = scene_read_and_choose_method_by_pilot_runs(&s, &pilot, a.scene, a.override, a.overrides, a.folder,
                                                               (struct study_options){.quiet = a.quiet, .stop = stop});
    if (result == OK) result = run_engine(&e, &s, &out, &a, threads);
    run_free_memory(&e);
    if (out.folder) snprintf(folder.text, sizeof folder.text, "%s", out.folder);
    output_close(&out);
    scene_free(&s);
    pilot_choice_free(&pilot);
    if (result == OK && page)
        result = report_write_html_page(&(struct report_request){.folder = folder.text, .quiet = a.quiet});
    arguments_free(&a);
    return result;
}
