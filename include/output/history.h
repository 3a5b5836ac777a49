/* Reader of history.csv for finished and for running runs. */
#ifndef CLEAVE_HISTORY
#define CLEAVE_HISTORY

#include "base/base.h"

struct history {
    int columns; /* Contents of a table with one header line. */
    char **name; /* [columns] names without units */
    int64_t rows;
    double *value; /* [rows][columns] in SI units; NAN for an empty or non-numeric entry */
};

/* Reads folder/history.csv into h. An incomplete last line, which a run is still writing, is left out. FAILED without a
 * file or a header, and for a line with another number of columns. Release with history_free. */
status history_read(struct history *h, const char *folder);

/* Reads any file of the form of history.csv, for example a profile of a probe, as history_read does. */
status history_read_file(struct history *h, const char *path);

/* Releases the memory of h. */
void history_free(struct history *h);

/* Returns the index of the column `name`, or -1 if there is none. */
int history_column(const struct history *h, const char *name);

/* Returns the value in a row and column, or NAN if `column` is -1. */
static inline double history_at(const struct history *h, int64_t row, int column)
{
    return column < 0 ? __builtin_nan("") : h->value[row * h->columns + column];
}

#endif
