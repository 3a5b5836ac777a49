/* Trial equilibria: bonds break or loads change, and then all is as before. */
#ifndef CLEAVE_TRIAL
#define CLEAVE_TRIAL

#include "base/memory_archive.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Saves the present equilibrium in m, and the plastic state as the start of solutions. A trial that is kept ends with
 * memory_archive_free. */
void trial_begin(struct run *e, struct memory_archive *m);

/* Restores the equilibrium saved in m, the plastic state saved last, and the bonds of the list `broken` (NULL: none);
 * frees m. The unknowns must be those of trial_begin. */
void trial_undo(struct run *e, struct memory_archive *m, const struct break_list *broken);

#endif
