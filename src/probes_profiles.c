/* floor 3: profiles of LINE and EXACT probes as csv files. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "probes.h"
#include "probes_parts.h"

static void profile_header(FILE *file, const struct particles *p)
{
    fprintf(file, "s [m]");
    for (int d = 0; d < p->dim; d++) fprintf(file, ",%s [m]", axis_name[d]);
    for (int k = 0; k < readings_count(p); k++) {
        struct column c = reading_column(p, k);
        fprintf(file, ",%s [%s]", c.name, c.unit);
    }
    fputc('\n', file);
}

/* Stations outside the bodies are left out: there is nothing to read. */
static void profile_rows(FILE *file, const struct probe *q, const struct particles *p)
{
    real X[DIM_MAX], start[DIM_MAX], value[READINGS_MAX];
    station_position(q, p->dim, 0, start);
    for (int64_t k = 0; k < q->n; k++) {
        if (q->list[k] < 0) continue;
        real s2 = 0;
        station_position(q, p->dim, (int)k, X);
        for (int d = 0; d < p->dim; d++) s2 += square(X[d] - start[d]);
        fprintf(file, "%.9g", sqrt(s2));
        for (int d = 0; d < p->dim; d++) fprintf(file, ",%.9g", X[d]);
        readings_of(p, q->list[k], value);
        for (int m = 0; m < readings_count(p); m++) fprintf(file, ",%.9g", value[m]);
        fputc('\n', file);
    }
}

static void bar_rows(FILE *file, const struct probe *q, const struct observed *o)
{
    real value[BAR_READINGS];
    for (int m = 0; m < BAR_READINGS; m++)
        fprintf(file, "%s%s [%s]%s", m > 0 ? "," : "", bar_reading[m].name, bar_reading[m].unit,
                m + 1 < BAR_READINGS ? "" : "\n");
    bar_measure(q->bar, o);
    for (int64_t k = 0; k < q->bar->n; k++) {
        bar_readings(q->bar, o, k, value);
        for (int m = 0; m < BAR_READINGS; m++)
            fprintf(file, "%s%.9g%s", m > 0 ? "," : "", value[m], m + 1 < BAR_READINGS ? "" : "\n");
    }
}

static void profile_text(FILE *file, const struct probe *q, const struct observed *o)
{
    if (q->request.kind == PROBE_EXACT) {
        bar_rows(file, q, o);
        return;
    }
    profile_header(file, o->part);
    profile_rows(file, q, o->part);
}

static status profile_failed(const char *path)
{
    return status_set(FAILED, "cannot write %s: %s", path, strerror(errno));
}

/* Written aside, synced, renamed: a file that is there is whole. */
static status profile_write(const struct probe *q, const struct observed *o, const char *folder, int frame)
{
    char path[4096], aside[4096 + 8], name[NAME_MAX_LENGTH];
    snprintf(name, sizeof name, "%s", q->request.name);
    for (char *c = name; *c; c++)
        if (*c == '/') *c = '_';
    if (snprintf(path, sizeof path, "%s/%s_%06d.csv", folder, name, frame) >= (int)sizeof path) {
        errno = ENAMETOOLONG;
        return profile_failed(folder);
    }
    snprintf(aside, sizeof aside, "%s.tmp", path);
    FILE *file = fopen(aside, "w");
    if (!file) return profile_failed(path);
    profile_text(file, q, o);
    bool written = fflush(file) == 0 && !ferror(file) && fsync(fileno(file)) == 0;
    int fault = errno;
    if (fclose(file) != 0 && written) written = false, fault = errno;
    if (written && rename(aside, path) == 0) return OK;
    if (written) fault = errno;
    remove(aside);
    errno = fault;
    return profile_failed(path);
}

status probes_profiles(const struct probes *s, const struct observed *o, const char *folder, int frame)
{
    for (int k = 0; k < s->n; k++)
        if (s->probe[k].request.kind == PROBE_LINE || s->probe[k].request.kind == PROBE_EXACT)
            TRY(profile_write(&s->probe[k], o, folder, frame));
    return OK;
}
