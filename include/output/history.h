/* history.csv read back, of a finished or a running run. */
#ifndef CLEAVE_HISTORY
#define CLEAVE_HISTORY

#include "base/base.h"

struct history {
    int columns;
    char **name; /* [columns] without the unit */
    int64_t rows;
    double *value; /* [rows][columns] SI; NAN where the file has none */
};

/* Reads folder/history.csv; a last line that is still being written is left out. FAILED: no file, no header, or a
 * line with another number of columns. */
status history_read(struct history *h, const char *folder);
/* The same of any file of this form, as the profiles of probes are. */
status history_read_file(struct history *h, const char *path);
void history_free(struct history *h);

/* Place of a column, -1 without. */
int history_column(const struct history *h, const char *name);

/* Entry of a row; NAN for column -1. */
static inline double history_at(const struct history *h, int64_t row, int column)
{
    return column < 0 ? __builtin_nan("") : h->value[row * h->columns + column];
}

#endif
