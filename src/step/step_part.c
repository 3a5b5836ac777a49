/* Registers three modules with the engine: reports (samples, output frames, checkpoints), bulk damping and stability
 * checks. Defines their callbacks (struct part in run/part.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "output/output.h"
#include "probes/probes_part.h"
#include "run/part.h"
#include "step/step.h"
#include "step/damping.h"
#include "step/report.h"
#include "step/stability.h"

static void report_free_all(struct run *run)
{
    struct run_report *r = run->report;
    if (!r) return;
    for (int d = 0; d < DIM_MAX; d++) memory_free(r->sampling.before[d]);
    memory_free(r->record);
}

static void damping_free_all(struct run *run)
{
    for (int k = 0; k < 2; k++)
        for (int d = 0; d < DIM_MAX; d++) memory_free(run->damping->before[k][d]);
}

static void stability_free_all(struct run *run)
{
    if (run->stability) memory_free(run->stability->pairs.pair);
}

/* State of put_figure while it writes scalar results of probes to JSON: name of the present probe, and whether its
 * object is open. All results of one probe come in succession; a new name ends the object of the previous probe. */
struct probe_sink {
    struct json *json;
    char name[NAME_MAX_LENGTH];
    bool open;
};

/* Writes one scalar result of a probe to a JSON object named after the probe. Results that are not finite are omitted.
 * context: a struct probe_sink; probe: name of the probe; quantity: name of the result; value: in SI units. */
static void put_figure(void *context, const char *probe, const char *quantity, real value)
{
    struct probe_sink *sink = context;
    if (!isfinite(value)) return;
    if (!sink->open || strcmp(sink->name, probe) != 0) {
        if (sink->open) json_end_object_or_list(sink->json, '}');
        json_begin_object_or_list(sink->json, probe, '{');
        snprintf(sink->name, sizeof sink->name, "%s", probe);
        sink->open = true;
    }
    json_write_real(sink->json, quantity, value);
}

static void put_probes(struct json *j, const struct probes *probes, const struct observed_run *o)
{
    struct probe_sink sink = {.json = j};
    json_begin_object_or_list(j, "probes", '{');
    probes_visit_results(probes, o, put_figure, &sink);
    if (sink.open) json_end_object_or_list(j, '}');
    json_end_object_or_list(j, '}');
}

/* Writes the JSON object `uncertainty` with the half-widths of the error bars of scalar results to j, if a study of
 * this scene has stored them in r. */
static void put_error_bars(struct json *j, const struct run_report *r)
{
    if (r->bars == 0) return;
    json_begin_object_or_list(j, "uncertainty", '{');
    for (int k = 0; k < r->bars; k++) json_write_rounded(j, r->bar[k].figure, r->bar[k].half_width, 3);
    json_end_object_or_list(j, '}');
}

static void put_figures(const struct run *run, struct json *j)
{
    const struct observed_run o = observed_run_make_read_only_view(run);
    put_probes(j, &run->probing->probes, &o);
    put_error_bars(j, run->report);
}

static status report_state(struct run *run, struct archive *a)
{
    struct run_report *r = run->report;
    if (a->scope == ARCHIVE_REBUILD) return OK;
    ARCHIVE_VALUE(a, "engine/particle_steps", r->particle_steps);
    ARCHIVE_VALUE(a, "engine/bond_visits", r->bond_visits);
    ARCHIVE_VALUE(a, "engine/inactive", r->inactive);
    ARCHIVE_VALUE(a, "engine/sampled", r->sampled);
    struct run_seconds seconds = a->saving ? report_wall_clock_times(r, &run->timers) : (struct run_seconds){0};
    ARCHIVE_VALUE(a, "engine/seconds", seconds);
    if (!a->saving) r->before = seconds;
    return output_save_or_load(r->out, a);
}

static status stability_state(struct run *run, struct archive *a)
{
    ARCHIVE_VALUE(a, "engine/speed_rise", run->stability->speed);
    ARCHIVE_VALUE(a, "engine/excess_rise", run->stability->excess);
    ARCHIVE_VALUE(a, "engine/stretched", run->stability->stretched);
    ARCHIVE_VALUE(a, "engine/parted", run->stability->parted);
    ARCHIVE_VALUE(a, "engine/released", run->stability->released);
    ARCHIVE_VALUE(a, "engine/pulled", run->stability->pairs.pulled);
    ARCHIVE_VALUE(a, "engine/large_motion", run->stability->motion);
    return OK;
}

const struct part part_report = {PART(report, run_report), .free = report_free_all, .state = report_state,
                                 .summary = put_figures};
const struct part part_damping = {PART(damping, damping_state), .free = damping_free_all};
const struct part part_stability = {PART(stability, stability), .free = stability_free_all, .state = stability_state};
