/* Writes history.csv: one line per sample; the file is cut back to the checkpoint when a run is resumed. */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output.h"
#include "output/output_files.h"

static struct path history_path(const struct output *o) { return path_join(o->folder, "history.csv"); }

/* Returns `hash`, a hash of Fowler, Noll and Vo (FNV-1a), updated with n bytes. A new hash is HASH_START. The hash
 * of history.csv is updated with each line, so that a checkpoint need not read the file. */
#define HASH_START UINT64_C(0xCBF29CE484222325)
static uint64_t hash_bytes(uint64_t hash, const char *bytes, size_t n)
{
    for (size_t k = 0; k < n; k++) hash = (hash ^ (unsigned char)bytes[k]) * UINT64_C(0x100000001B3);
    return hash;
}

/* One line of history.csv while its text is composed in the memory stream `to`. */
struct line {
    char *text;
    size_t length;
    FILE *to;
};

/* Opens a memory stream l->to for the text of a line. Returns false if memory is exhausted. Release with line_end. */
static bool line_begin(struct line *l)
{
    *l = (struct line){0};
    l->to = memory_stream_open(&l->text, &l->length);
    return l->to != NULL;
}

/* Writes the finished line l to history.csv of the output o, adds it to length and hash of the file in o, and frees it.
 * Returns FAILED, with a message, if it cannot be written. */
static status line_end(struct output *o, struct line *l)
{
    errno = 0;
    const bool whole = fclose(l->to) == 0 && fwrite(l->text, 1, l->length, o->history) == l->length &&
                       fflush(o->history) == 0 && !ferror(o->history);
    const status s = whole ? OK : file_report_write_failure(history_path(o).text, errno);
    if (whole)
        o->history_bytes += (int64_t)l->length, o->history_hash = hash_bytes(o->history_hash, l->text, l->length);
    free(l->text);
    return s;
}

/* Writes the header of history.csv of the output o: `name [unit]` of all columns column[]. Returns FAILED, with a
 * message, if it cannot be written. */
static status history_header(struct output *o, const struct column *column)
{
    struct line l;
    if (!line_begin(&l)) return file_report_write_failure(history_path(o).text, ENOMEM);
    for (int k = 0; k < o->columns; k++) {
        const char *end = k + 1 < o->columns ? "," : "\n";
        char name[sizeof column->name];
        snprintf(name, sizeof name, "%s", column[k].name);
        /* Replace characters that would end a field by _. */
        for (char *c = name; *c; c++) *c = *c == ',' || *c == '"' || *c == '\n' || *c == '\r' ? '_' : *c;
        if (column[k].unit[0])
            fprintf(l.to, "%s [%s]%s", name, column[k].unit, end);
        else
            fprintf(l.to, "%s%s", name, end);
    }
    return line_end(o, &l);
}

/* Cuts history.csv of the output o to the length that it had at the checkpoint that is resumed. The result is a new
 * file, so that targets of links and other hard links to the old file remain unchanged. Returns FAILED, with a message,
 * if the file is missing or shorter, or if this part of it has changed. */
static status history_cut(const struct output *o)
{
    struct path path = history_path(o);
    char *text = NULL;
    size_t length = 0;
    if (!path_is_file(path.text))
        return status_set(FAILED, "cannot resume: %s is missing; start again with --overwrite", path.text);
    TRY(file_read_whole(path.text, &text, &length));
    const bool shorter = (int64_t)length < o->history_bytes;
    const bool same = !shorter && hash_bytes(HASH_START, text, (size_t)o->history_bytes) == o->history_hash;
    const status cut = same ? file_write_whole(path.text, text, (size_t)o->history_bytes) : OK;
    memory_free(text);
    if (same) return cut;
    return status_set(FAILED, "cannot resume: %s is %s at the checkpoint (%lld bytes); start again with --overwrite",
                      path.text, shorter ? "shorter than" : "not the file that it was", (long long)o->history_bytes);
}

/* Opens history.csv at `path` for writing, without following a link. resume: true to continue it at its end, false to
 * create a new file. Returns NULL and sets errno on a fault. */
static FILE *history_file(const char *path, bool resume)
{
    if (!resume) unlink(path);
    const int fd = open(path, O_WRONLY | O_CLOEXEC | O_NOFOLLOW | (resume ? O_APPEND : O_CREAT | O_EXCL), 0666);
    FILE *to = fd < 0 ? NULL : fdopen(fd, resume ? "a" : "w");
    if (fd >= 0 && !to) close(fd);
    return to;
}

status output_history_open(struct output *o, const struct column *column, int column_count, bool resume)
{
    INVARIANT(column_count > 0 && !o->history);
    struct path path = history_path(o);
    o->columns = column_count;
    if (resume) TRY(history_cut(o));
    TRY(file_check_replaceable(path.text));
    o->history = history_file(path.text, resume);
    if (!o->history) return file_report_write_failure(path.text, errno);
    if (resume) return OK;
    o->history_bytes = 0, o->history_hash = HASH_START;
    return history_header(o, column);
}

status output_write_history(struct output *o, const real *value)
{
    struct line l;
    if (!line_begin(&l)) return file_report_write_failure(history_path(o).text, ENOMEM);
    for (int k = 0; k < o->columns; k++) {
        /* Remove the sign of a NaN, which has no meaning and would make files of equal runs differ. */
        const real a = isnan(value[k]) ? fabs(NAN) : value[k];
        fprintf(l.to, "%.9g%s", a, k + 1 < o->columns ? "," : "\n");
    }
    return line_end(o, &l);
}
