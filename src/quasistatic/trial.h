/* Trial equilibria: bonds break or loads change, then the previous state is restored. */
#ifndef CLEAVE_TRIAL
#define CLEAVE_TRIAL

#include "base/memory_archive.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Begins a trial equilibrium: saves the present equilibrium in *saved, and the present plastic state as the start of
 * the next solutions. End the trial with trial_equilibrium_undo, or keep its result and release *saved with
 * memory_archive_free. */
void trial_equilibrium_begin(struct run *e, struct memory_archive *saved);

/* Ends a trial equilibrium: restores the equilibrium saved in *saved, the plastic state at trial_equilibrium_begin, and
 * the bonds that the trial has broken, listed in `broken_bonds` (NULL: none); frees *saved. The system of equations
 * must have the same unknowns as at trial_equilibrium_begin. */
void trial_equilibrium_undo(struct run *e, struct memory_archive *saved, const struct break_list *broken_bonds);

#endif
