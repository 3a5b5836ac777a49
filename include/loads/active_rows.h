/* The active set of row blocks of bonds (data/active_set.h). */
#ifndef CLEAVE_ACTIVE_ROWS
#define CLEAVE_ACTIVE_ROWS

#include "bonds/bonds.h"
#include "loads/loads.h"

/* After a step in which the forces of all active row blocks were computed: finds the levels of rows that were just
 * made, else activates the neighbours of row blocks that have moved. */
void active_rows_update(struct bonds *b, const struct particles *p, const struct loads *l);

/* Before a step: something else than bonds may move these n particles from now on, so that their row blocks are active
 * and their forces, which were 0, begin anew. */
void active_rows_touch(struct bonds *b, const struct particles *p, const struct loads *l, const int32_t *list,
                       int64_t n);

#endif
