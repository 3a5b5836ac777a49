/* Writes summary.json, the results of a run for scripts. Physical results come first and do not depend on the number of
 * threads; results that depend on the machine follow. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fracture/fragments.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "base/program_commit.h"
#include "base/team.h"
#include "output/json.h"
#include "run/part.h"
#include "simd/simd.h"
#include "coupling/coupling_part.h"
#include "step/report.h"
#include "output/output.h"
#include "probes/diagnostics.h"

/* ---- physical results -------------------------------------------------------------------------------------------- */

/* Writes name, method, status, numbers of steps and particles, and times of the run to the JSON object j. s: status
 * with which the run has ended; message: its error message, "" without one. */
static void put_run(struct json *j, const struct run *run, status s, const char *message)
{
    static const char *const method[] = {[METHOD_PD] = "pd", [METHOD_MPM] = "mpm", [METHOD_ADAPTIVE] = "adaptive"};
    json_write_text(j, "name", run->scene->name);
    json_write_text(j, "version", CLEAVE_VERSION);
    json_write_text(j, "method", method[run->scene->method]);
    json_write_text(j, "status", s == OK ? "done" : s == INTERRUPTED ? "interrupted" : "failed");
    if (s != OK && message[0]) json_write_text(j, "message", message);
    json_write_integer(j, "steps", run->clock.step);
    json_write_real(j, "time_step", run->clock.dt);
    json_write_real(j, "time_step_critical", run->clock.dt_critical);
    json_write_real(j, "time_end", run->clock.t);
    json_write_integer(j, "particles", run->part.n_body);
    json_write_integer(j, "particles_made", run->part.n);
    json_write_integer(j, "particles_pd_start", run->coupling->conversion.start);
    json_write_integer(j, "particles_pd_end", run->part.n_of[KIND_PD]);
    json_write_integer(j, "bonds_peak", run->coupling->conversion.peak_bonds);
}

static void put_warnings(struct json *j, const struct warnings *w)
{
    json_begin_object_or_list(j, "warnings", '[');
    for (int k = 0; k < w->n; k++) json_write_text(j, NULL, w->text[k]);
    json_end_object_or_list(j, ']');
}

/* ---- fragments --------------------------------------------------------------------------------------------------- */

/* Returns true if a run of `scene` reports fragments: all particles are peridynamic, a bond is broken or there are
 * pre-cracks, and the problem is not a single equilibrium. diagnostics: number of broken bonds. */
static bool has_fragments(const struct scene *scene, const struct diagnostics *diagnostics)
{
    return scene->method == METHOD_PD && !scene_is_single_equilibrium(scene) &&
           (diagnostics->bonds_broken > 0 || scene->cracks > 0);
}

/* Writes the JSON object "fragments" to j: number and largest mass of the fragments f, and number and mass of the
 * particles without any bond, which are counted separately. */
static void put_fragments(struct json *j, const struct fragments *f)
{
    json_begin_object_or_list(j, "fragments", '{');
    json_write_integer(j, "count", f->n);
    json_write_real(j, "mass_max", f->n > 0 ? f->fragment[0].mass : 0);
    json_write_integer(j, "particles_alone", f->singles);
    json_write_real(j, "mass_alone", f->mass_singles);
    json_end_object_or_list(j, '}');
}

/* Prints the contents of fragments.csv to `file`: a header, and for each fragment of f, the heaviest first, a line with
 * body, number of particles, mass, position and velocity. part: particles of the run. */
static void fragments_print(FILE *file, const struct particles *part, const struct fragments *f)
{
    static const char axis[] = "xyz";
    const int dim = part->dim;
    fputs("body,particles,mass [kg]", file);
    for (int d = 0; d < dim; d++) fprintf(file, ",%c [m]", axis[d]);
    for (int d = 0; d < dim; d++) fprintf(file, ",velocity_%c [m/s]", axis[d]);
    fputc('\n', file);
    for (int64_t k = 0; k < f->n; k++) {
        const struct fragment *g = &f->fragment[k];
        fprintf(file, "%d,%lld,%.9g", g->body, (long long)g->particles, g->mass);
        for (int d = 0; d < dim; d++) fprintf(file, ",%.9g", g->x[d]);
        for (int d = 0; d < dim; d++) fprintf(file, ",%.9g", g->v[d]);
        fputc('\n', file);
    }
}

/* Writes fragments.csv, a table of the fragments f, into the folder of the run. part: particles of the run; report: its
 * output. Returns FAILED, with a message, if memory is exhausted or the file cannot be written. */
static status fragments_write(const struct particles *part, const struct run_report *report, const struct fragments *f)
{
    char *text = NULL;
    size_t length = 0;
    FILE *file = memory_stream_open(&text, &length);
    if (!file)
        return status_set(
            FAILED,
            "cannot write fragments.csv: out of memory; use a larger particles.spacing, or a machine with more memory");
    fragments_print(file, part, f);
    const bool whole = fclose(file) == 0;
    const status written = whole ? output_write_text(report->out, "fragments.csv", text, length)
                                 : status_set(FAILED, "cannot write fragments.csv: out of memory; use a larger "
                                                      "particles.spacing, or a machine with more memory");
    free(text);
    return written;
}

/* ---- results of the machine -------------------------------------------------------------------------------------- */

/* Writes the results that depend on the machine to the JSON object j: processor, commit, threads, kernels, times and
 * memory. r: counts of the run; steps: number of its steps; threads: number of threads; spent: times of the run [s]. */
static void put_machine(struct json *j, const struct run_report *r, int64_t steps, int threads,
                        const struct run_seconds *spent)
{
    real updates = 0, ns = 1e9 * spent->loop;
    for (int k = 0; k < KINDS; k++) updates += (real)r->particle_steps[k];
    json_write_text(j, "processor", machine_processor_name());
    if (*program_commit()) json_write_text(j, "commit", program_commit());
    json_write_integer(j, "threads", threads);
    json_write_text(j, "kernels", simd_current_kernels()->name);
    json_write_rounded(j, "wall_seconds", spent->wall, JSON_TIMING);
    json_write_rounded(j, "setup_seconds", spent->setup, JSON_TIMING);
    json_write_rounded(j, "loop_seconds", spent->loop, JSON_TIMING);
    json_write_rounded(j, "output_seconds", spent->wall - spent->setup - spent->loop, JSON_TIMING);
    json_write_integer(j, "memory_peak_bytes", memory_peak_resident_size());
    json_write_rounded(j, "ns_per_particle_step", ns / updates, JSON_TIMING);
    json_write_rounded(j, "ns_per_bond_step", ns / (real)r->bond_visits, JSON_TIMING);
    json_write_rounded(j, "inactive_share", r->inactive / (real)(steps > 0 ? steps : 1), JSON_TIMING);
}

/* Writes the computing times of the sections of the time loop in this process, timers->spent [s], to the JSON object j,
 * as an object "laps". */
static void put_timers(struct json *j, const struct timers *timers)
{
    json_begin_object_or_list(j, "laps", '{');
    for (int k = 0; k < TIMERS; k++) json_write_rounded(j, timer_name[k], timers->spent[k], JSON_TIMING);
    json_end_object_or_list(j, '}');
}

/* Prints the contents of summary.json to `file`. run: the run; fragments: its fragments at the end; s: status with
 * which the run has ended; message: its error message, "" without one; threads: number of threads. */
static void summary_print(FILE *file, const struct run *run, const struct fragments *fragments, status s,
                          const char *message, int threads)
{
    struct json j = {.file = file, .depth = 1};
    fputc('{', file);
    put_run(&j, run, s, message);
    put_warnings(&j, &run->warnings);
    for (const struct part *const *p = run->parts; *p; p++)
        if ((*p)->summary) (*p)->summary(run, &j);
    if (has_fragments(run->scene, run->diagnostics)) put_fragments(&j, fragments);
    const struct run_seconds spent = report_wall_clock_times(run->report, &run->timers);
    put_machine(&j, run->report, run->clock.step, threads, &spent);
    put_timers(&j, &run->timers);
    fputs("\n}\n", file);
}

status run_write_summary_files(const struct run *run, status end_status, int thread_count)
{
    char message[1024], *text = NULL;
    size_t length = 0;
    if (!run->report->out) return OK;
    snprintf(message, sizeof message, "%s", status_message());
    struct fragments fragments = {0};
    if (has_fragments(run->scene, run->diagnostics)) {
        fragments_find_by_intact_bonds(&fragments, &run->bonds, &run->part);
        TRY(fragments_write(&run->part, run->report, &fragments));
    }
    FILE *file = memory_stream_open(&text, &length);
    if (!file)
        return status_set(
            FAILED,
            "cannot write summary.json: out of memory; use a larger particles.spacing, or a machine with more memory");
    summary_print(file, run, &fragments, end_status, message, thread_count);
    fragments_free(&fragments);
    const bool whole = fclose(file) == 0;
    status written = whole ? output_write_text(run->report->out, "summary.json", text, length)
                           : status_set(FAILED, "cannot write summary.json: out of memory; use a larger "
                                                "particles.spacing, or a machine with more memory");
    free(text);
    /* the cause of a failed run has precedence over a failure to write its summary */
    if (written != OK && end_status != OK) return status_set(end_status, "%s", message);
    return written;
}
