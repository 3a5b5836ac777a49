/* floor 4: history.csv: one line per sample, cut back to the checkpoint when a run is resumed. */
#include <errno.h>
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output.h"
#include "output_files.h"

static struct path history_path(const struct output *o) { return path_join(o->folder, "history.csv"); }

/* Ends a line: books its length if all of it reached the file. */
static status history_flush(struct output *o, int64_t bytes)
{
    errno = 0;
    if (bytes < 0 || fflush(o->history) != 0 || ferror(o->history)) return file_fault(history_path(o).text, errno);
    o->history_bytes += bytes;
    return OK;
}

/* Adds the outcome of a print to a length; -1 stays -1. */
static void add_length(int64_t *bytes, int printed) { *bytes = *bytes < 0 || printed < 0 ? -1 : *bytes + printed; }

static status history_header(struct output *o, const struct column *column)
{
    int64_t bytes = 0;
    for (int k = 0; k < o->columns; k++) {
        const char *end = k + 1 < o->columns ? "," : "\n";
        char name[sizeof column->name];
        snprintf(name, sizeof name, "%s", column[k].name);
        /* What would end a field early cannot be part of its name. */
        for (char *c = name; *c; c++) *c = *c == ',' || *c == '"' || *c == '\n' || *c == '\r' ? '_' : *c;
        if (column[k].unit[0]) add_length(&bytes, fprintf(o->history, "%s [%s]%s", name, column[k].unit, end));
        else add_length(&bytes, fprintf(o->history, "%s%s", name, end));
    }
    return history_flush(o, bytes);
}

/* Cuts the file to the length that belongs to the restored state. */
static status history_cut(const struct output *o)
{
    struct path path = history_path(o);
    struct stat s;
    if (stat(path.text, &s) != 0 || s.st_size < o->history_bytes)
        return status_set(FAILED, "cannot resume: %s is shorter than at the checkpoint (%lld bytes)", path.text,
                          (long long)o->history_bytes);
    if (truncate(path.text, o->history_bytes) != 0) return file_fault(path.text, errno);
    return OK;
}

status output_history_open(struct output *o, const struct column *column, int columns, bool resume)
{
    assert(columns > 0 && !o->history);
    struct path path = history_path(o);
    o->columns = columns;
    if (resume) TRY(history_cut(o));
    o->history = fopen(path.text, resume ? "a" : "w");
    if (!o->history) return file_fault(path.text, errno);
    if (resume) return OK;
    o->history_bytes = 0;
    return history_header(o, column);
}

status output_history(struct output *o, const real *value)
{
    int64_t bytes = 0;
    for (int k = 0; k < o->columns; k++) {
        /* The sign of a NaN means nothing and must not make two runs differ. */
        real a = isnan(value[k]) ? fabs(NAN) : value[k];
        add_length(&bytes, fprintf(o->history, "%.9g%s", a, k + 1 < o->columns ? "," : "\n"));
    }
    return history_flush(o, bytes);
}
