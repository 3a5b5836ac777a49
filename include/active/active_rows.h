/* The active set of row blocks of bonds (data/active_set.h). */
#ifndef CLEAVE_ACTIVE_ROWS
#define CLEAVE_ACTIVE_ROWS

#include "bonds/bonds.h"
#include "loads/loads.h"

/* After a step in which the forces of all active row blocks were computed: finds the levels of rows that were just
 * made, else activates the neighbours of row blocks that have moved. */
void active_rows_update(struct bonds *b, const struct particles *p, const struct loads *l);

#endif
