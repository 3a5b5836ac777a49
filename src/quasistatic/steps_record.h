/* Declares the columns that load steps add to history.csv: crack area, released energy and load size. */
#ifndef CLEAVE_STEPS_RECORD
#define CLEAVE_STEPS_RECORD

#include "output/column.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Stores names and units of the columns that load steps (successive static equilibria) of the run add to history.csv in
 * column[], unless `column` is NULL. Returns the number of these columns, 0 for a run without load steps. */
int statics_list_history_columns(const struct run *run, struct column *column);

/* Computes the values of the columns that the load steps (static equilibria) of the run add to history.csv and stores
 * them in record[], one for each column of statics_list_history_columns. Call this function once after each load step.
 */
void statics_compute_history_values(struct run *run, real *record);

/* Stores the present numbers of search directions and equilibria of the solver s. The next call of
 * statics_compute_history_values reports the numbers since then. */
void statics_reset_solver_counts_for_history(struct statics *s);

#endif
