/* Columns of history.csv that load steps add. */
#ifndef CLEAVE_STEPS_RECORD
#define CLEAVE_STEPS_RECORD

#include "output/column.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Stores names and units of the columns in column[] (not if `column` is NULL). Returns the number of columns. */
int statics_columns(const struct run *e, struct column *column);

/* Stores the values of the columns in record[] after a load step. */
void statics_record(struct run *e, real *record);

/* Stores the present counters of the solver (search directions, equilibria), from which the next record counts. */
void statics_record_keep(struct statics *s);

#endif
