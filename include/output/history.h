/* Reader of history.csv for finished and for running runs. */
#ifndef CLEAVE_HISTORY
#define CLEAVE_HISTORY

#include "base/base.h"

/* Contents of a table with one header line, such as history.csv. Arrays are owned. */
struct history {
    int columns;
    char **name; /* [columns] names without units */
    int64_t rows;
    double *value; /* [rows][columns] in SI units; NAN for an empty or non-numeric entry */
};

/* Reads the file history.csv of the folder of a run into *h. The last line is skipped if it is incomplete because the
 * run is still writing it. Returns FAILED if there is no such file or header, or if a line has another number of
 * columns than the header. Release with history_free. */
status history_read(struct history *h, const char *folder);

/* Reads the header (the first line) of history.csv in `folder`, the folder of a run, into header[capacity], without the
 * line break. Stores "" if the file is missing or empty. A header that is too long is cut to capacity - 1 bytes. */
void history_read_header(char *header, size_t capacity, const char *folder);

/* Reads the file `path`, a table with one header line like history.csv (for example a profile of a probe), into *h. An
 * incomplete last line is skipped. Returns FAILED if there is no such file or header, or if a line has another number
 * of columns than the header. Release with history_free. */
status history_read_file(struct history *h, const char *path);

/* Frees the names and values of the table *h, which history_read or history_read_file has allocated. */
void history_free(struct history *h);

/* Returns the index of the column of the history h called `name` (without unit), or -1 if there is none. A column that
 * was renamed in a later version of Cleave is found by both names. */
int history_find_column(const struct history *h, const char *name);

/* Returns the value in row `row` and column `column` of the table h, both counted from 0, in SI units; NAN if `column`
 * is -1 (not found) or if the entry is empty or not a number. */
static inline double history_value_at(const struct history *h, int64_t row, int column)
{
    return column < 0 ? __builtin_nan("") : h->value[row * h->columns + column];
}

#endif
