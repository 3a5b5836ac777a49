/* Declares trial equilibria: solutions with broken bonds or changed loads, after which the previous state can be
 * restored. */
#ifndef CLEAVE_TRIAL
#define CLEAVE_TRIAL

#include "base/memory_archive.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* Begins a trial equilibrium (a solution that may be discarded): saves the present equilibrium of the run in *saved,
 * and the present plastic state as the start of the next solutions. trial_equilibrium_end frees *saved. */
void trial_equilibrium_begin(struct run *run, struct memory_archive *saved);

/* Ends a trial equilibrium (a solution that may be discarded) of the run and frees *saved. keep_result: true to keep
 * the result of the trial. Otherwise restores the equilibrium saved in *saved, the plastic state at
 * trial_equilibrium_begin, and the bonds that the trial has broken, listed in `broken_bonds` (NULL: none); the system
 * of equations must then have the same unknowns as at trial_equilibrium_begin. */
void trial_equilibrium_end(struct run *run, struct memory_archive *saved, bool keep_result,
                           const struct break_list *broken_bonds);

#endif
