#ifndef CLEAVE_COLUMN
#define CLEAVE_COLUMN

#include "base/base.h"

/* A column of history.csv or a figure of summary.json. */
struct column {
    char name[2 * NAME_MAX_LENGTH];
    char unit[16];
};

#endif
