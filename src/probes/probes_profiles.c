/* Writes the profiles of LINE and EXACT probes (values along a line or a bar at one time) as CSV files. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory_stream.h"
#include "probes_parts.h"

/* Writes the header line of a profile along a line (probe of kind LINE) to `file`: distance s along the line,
 * coordinates, and the quantities that particles p have, each with its unit. */
static void profile_header(FILE *file, const struct particles *p)
{
    fprintf(file, "s [m]");
    for (int d = 0; d < p->dim; d++) fprintf(file, ",%s [m]", axis_name[d]);
    for (int k = 0; k < particle_probe_value_count(p); k++) {
        struct column c = particle_probe_value_column(p, k);
        fprintf(file, ",%s [%s]", c.name, c.unit);
    }
    fputc('\n', file);
}

/* Writes to file a CSV row for each station of the probe of kind LINE (equidistant points of the line) that is inside a
 * body of the run o: distance from the first station [m], position, and the values of the nearest particle. */
static void profile_rows(FILE *file, const struct probe *probe, const struct observed_run *o)
{
    const struct particles *p = o->part;
    real X[DIM_MAX], start[DIM_MAX], value[READINGS_MAX];
    line_probe_compute_station_position(probe, p->dim, 0, start);
    for (int64_t k = 0; k < probe->n; k++) {
        if (probe->list[k] < 0) continue;
        real s2 = 0;
        line_probe_compute_station_position(probe, p->dim, (int)k, X);
        for (int d = 0; d < p->dim; d++) s2 += square(X[d] - start[d]);
        fprintf(file, "%.9g", sqrt(s2));
        for (int d = 0; d < p->dim; d++) fprintf(file, ",%.9g", X[d]);
        particle_compute_probe_values(o, probe->list[k], value);
        for (int m = 0; m < particle_probe_value_count(p); m++) fprintf(file, ",%.9g", value[m]);
        fputc('\n', file);
    }
}

/* Writes the profile of the probe of kind EXACT (closed-form solution of a bar) to file as CSV, with a header: computed
 * and exact values of all particles of the run o from left to right. */
static void bar_rows(FILE *file, const struct probe *probe, const struct observed_run *o)
{
    real value[BAR_READINGS];
    for (int m = 0; m < BAR_READINGS; m++)
        fprintf(file, "%s%s [%s]%s", m > 0 ? "," : "", bar_reading[m].name, bar_reading[m].unit,
                m + 1 < BAR_READINGS ? "" : "\n");
    bar_probe_measure_fields(probe->bar, o);
    for (int64_t k = 0; k < probe->bar->n; k++) {
        bar_probe_compute_profile_line(probe->bar, o, k, value);
        for (int m = 0; m < BAR_READINGS; m++)
            fprintf(file, "%s%.9g%s", m > 0 ? "," : "", value[m], m + 1 < BAR_READINGS ? "" : "\n");
    }
}

/* Writes the profile of the LINE or EXACT probe (a requested measurement) of the run o to file as CSV, with a header
 * line. */
static void profile_text(FILE *file, const struct probe *probe, const struct observed_run *o)
{
    if (probe->request.kind == PROBE_EXACT) {
        bar_rows(file, probe, o);
        return;
    }
    profile_header(file, o->part);
    profile_rows(file, probe, o);
}

/* Writes the file name `<probe>_NNNNNN.csv` of the profile of the probe (a requested measurement) to
 * name[PROFILE_NAME], with the number `frame`. A slash in the name of the probe becomes an underscore. */
static void profile_name(char *name, const struct probe *probe, int frame)
{
    snprintf(name, PROFILE_NAME, "%.*s_%06d.csv", NAME_MAX_LENGTH, probe->request.name, frame);
    for (char *c = name; *c; c++)
        if (*c == '/') *c = '_';
}

/* Returns true if probe (a requested measurement) has profiles: it is a LINE or an EXACT probe. */
static bool has_profile(const struct probe *probe)
{
    return probe->request.kind == PROBE_LINE || probe->request.kind == PROBE_EXACT;
}

bool probes_compose_profile_file_name(const struct probes *probes, int which, int frame_number, char *file_name)
{
    for (int k = 0; k < probes->n; k++) {
        if (!has_profile(&probes->probe[k]) || which-- > 0) continue;
        profile_name(file_name, &probes->probe[k], frame_number);
        return true;
    }
    return false;
}

/* Composes the profile of the probe (a requested measurement) of the run o at frame number `frame` and passes file name
 * and text to put(context, name, text, length), which writes them. Returns FAILED, with a message, if memory is
 * exhausted; else the status of put. */
static status profile_put(const struct probe *probe, const struct observed_run *o, probe_file_fn *put, void *context,
                          int frame)
{
    char name[PROFILE_NAME], *text = NULL;
    size_t length = 0;
    FILE *file = memory_stream_open(&text, &length);
    if (file) profile_text(file, probe, o);
    const bool whole = file && fclose(file) == 0;
    profile_name(name, probe, frame);
    const status s =
        whole ? put(context, name, text, length) : status_set(FAILED, "cannot write %s: out of memory", name);
    free(text);
    return s;
}

int64_t probes_count_profiles(const struct probes *probes)
{
    int64_t n = 0;
    for (int k = 0; k < probes->n; k++) n += has_profile(&probes->probe[k]);
    return n;
}

status probes_write_profiles(const struct probes *probes, const struct observed_run *o, probe_file_fn *write_file,
                             void *context, int frame_number)
{
    for (int k = 0; k < probes->n; k++)
        if (has_profile(&probes->probe[k])) TRY(profile_put(&probes->probe[k], o, write_file, context, frame_number));
    return OK;
}
