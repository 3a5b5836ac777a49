#ifndef CLEAVE_COLUMN
#define CLEAVE_COLUMN

#include "base/base.h"

/* Name and unit of a column of history.csv or of a value in summary.json. */
struct column {
    char name[2 * NAME_MAX_LENGTH];
    char unit[16];
};

#endif
