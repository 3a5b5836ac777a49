/* Reads history.csv, and profiles of probes, by columns. */
#include "output/history.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "output/renamed_results.h"

/* Returns the length of the entry of a CSV line that starts at `from`; it ends before a comma or the end of the
 * line. */
static size_t entry_length(const char *from) { return strcspn(from, ",\n"); }

/* Returns an allocated copy of the name in a column heading `name [unit]` of `length` characters, without the unit;
 * control characters are replaced. from: beginning of the heading. Release it with memory_free. */
static char *history_column_name(const char *from, size_t length)
{
    char *name = NEW("history.name", (int64_t)length + 1, char);
    memcpy(name, from, length);
    char *unit = strstr(name, " [");
    if (unit != NULL) *unit = '\0';
    name[strcspn(name, "\r")] = '\0';
    text_replace_control_characters(name);
    return name;
}

static void read_header(struct history *h, const char *line)
{
    for (const char *at = line;; at++) {
        size_t length = entry_length(at);
        GROW("history.names", h->name, h->columns + 1);
        h->name[h->columns++] = history_column_name(at, length);
        at += length;
        if (*at != ',') return;
    }
}

/* Reads one line of history.csv into row[h->columns]. An entry that is not a number becomes NAN. Returns false if the
 * line has another number of entries than the header, h->columns. */
static bool read_row(const struct history *h, const char *line, double *row)
{
    const char *at = line;
    for (int k = 0; k < h->columns; k++) {
        char *end;
        row[k] = strtod(at, &end);
        if (end == at) row[k] = NAN;
        at += entry_length(at);
        if (*at != (k + 1 < h->columns ? ',' : '\n')) return false;
        at++;
    }
    return true;
}

/* Reads all complete lines of the open file `from` into h->value [rows][columns]. path: name of the file, for
 * messages; *line, *room: buffer of getline and its size, released by the caller. Returns FAILED, with file and line
 * in the message, for a malformed line. */
static status read_rows(struct history *h, FILE *from, const char *path, char **line, size_t *room)
{
    ssize_t length;
    while ((length = getline(line, room, from)) > 0 && (*line)[length - 1] == '\n') {
        GROW("history.value", h->value, (h->rows + 1) * h->columns);
        if (!read_row(h, *line, h->value + h->rows * h->columns))
            return status_set(
                FAILED, "%s:%lld: this line does not have %d entries, so the file is damaged; run the scene again",
                path, (long long)h->rows + 2, h->columns);
        h->rows++;
    }
    return OK;
}

void history_read_header(char *header, size_t capacity, const char *folder)
{
    const struct path history = path_join(folder, "history.csv");
    FILE *from = path_is_file(history.text) ? fopen(history.text, "r") : NULL;
    *header = '\0';
    if (!from) return;
    if (!fgets(header, (int)capacity, from)) *header = '\0';
    header[strcspn(header, "\r\n")] = '\0';
    fclose(from);
}

status history_read(struct history *h, const char *folder)
{
    char path[4096];
    *h = (struct history){0};
    if (snprintf(path, sizeof path, "%s/history.csv", folder) >= (int)sizeof path)
        return status_set(FAILED, "%s: the name of the file is too long; choose a shorter one", folder);
    return history_read_file(h, path);
}

status history_read_file(struct history *h, const char *path)
{
    char *line = NULL;
    size_t room = 0;
    *h = (struct history){0};
    if (path_exists(path) && !path_is_file(path))
        return status_set(FAILED, "%s is not a regular file; give the folder of a run", path);
    FILE *from = fopen(path, "r");
    if (from == NULL) return status_set(FAILED, "%s: %s", path, strerror(errno));
    ssize_t length = getline(&line, &room, from);
    status s =
        length > 0 && line[length - 1] == '\n'
            ? OK
            : status_set(FAILED, "%s:1: the header is missing, so the file is damaged; run the scene again", path);
    if (s == OK) read_header(h, line);
    if (s == OK) s = read_rows(h, from, path, &line, &room);
    free(line);
    fclose(from);
    if (s != OK) history_free(h);
    return s;
}

void history_free(struct history *h)
{
    for (int k = 0; k < h->columns; k++) memory_free(h->name[k]);
    memory_free(h->name);
    memory_free(h->value);
    *h = (struct history){0};
}

/* Returns the index of the column of the history h with exactly the name `name`; -1 if there is none. */
static int column_called(const struct history *h, const char *name)
{
    for (int k = 0; k < h->columns; k++)
        if (strcmp(h->name[k], name) == 0) return k;
    return -1;
}

int history_find_column(const struct history *h, const char *name)
{
    const int column = column_called(h, name);
    const char *other = column < 0 ? renamed_result_swap_former_and_current_name(name) : NULL;
    return other ? column_called(h, other) : column;
}
