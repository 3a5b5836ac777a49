/* The active set of row blocks of bonds (data/active_set.h). */
#ifndef CLEAVE_ACTIVE_ROWS
#define CLEAVE_ACTIVE_ROWS

#include "bonds/bonds.h"
#include "loads/loads.h"

/* Updates the set of active row blocks (blocks of eight rows of bonds whose forces are computed) after a step in which
 * the forces of all active ones were computed. Activates the neighbours of row blocks whose particles have changed
 * position; if rows were rebuilt, determines anew which row blocks are active. loads: row blocks of loaded particles
 * stay active. */
void active_rows_update(struct bonds *b, const struct particles *p, const struct loads *loads);

/* Activates the row blocks that contain any of the n particles in `list` (indices), because forces other than those of
 * bonds (loads, contact) may act on these particles from the next step on. The bond forces in these row blocks must be
 * 0 so far. loads: boundary conditions and contact marks of the run. */
void active_rows_activate(struct bonds *b, const struct particles *p, const struct loads *loads, const int32_t *list,
                          int64_t n);

#endif
