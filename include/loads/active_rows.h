/* The active set of row blocks of bonds (data/active_set.h). */
#ifndef CLEAVE_ACTIVE_ROWS
#define CLEAVE_ACTIVE_ROWS

#include "bonds/bonds.h"
#include "loads/loads.h"

/* Updates the active row blocks after a step in which the forces of all active row blocks were computed: finds the
 * levels of rebuilt rows, else activates the neighbours of row blocks that have moved. */
void active_rows_update(struct bonds *b, const struct particles *p, const struct loads *l);

/* Activates the row blocks of n listed particles on which forces other than those of bonds may act from the next step
 * on; their bond forces are 0 before. */
void active_rows_touch(struct bonds *b, const struct particles *p, const struct loads *l, const int32_t *list,
                       int64_t n);

#endif
