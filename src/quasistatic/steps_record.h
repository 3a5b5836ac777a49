/* Columns of history.csv that load steps add. */
#ifndef CLEAVE_STEPS_RECORD
#define CLEAVE_STEPS_RECORD

#include "output/column.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Describes the columns (column NULL: none is stored). Returns their number. */
int statics_columns(const struct run *e, struct column *column);

/* Stores the values of the columns after a load step. */
void statics_record(struct run *e, real *record);

/* Sets the counters from which the next record counts. */
void statics_record_keep(struct statics *s);

#endif
