/* State that trial equilibria change, saved and restored. */
#ifndef CLEAVE_TRIAL
#define CLEAVE_TRIAL

#include "base/memory_archive.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* What a trial has to give back. */
struct stand {
    real t, overload, lost, damped, work, constraint_work;
    struct field u, f;
    bool touches;
    struct memory_archive touch;
};

/* Saves the present equilibrium in k. */
void stand_take(struct stand *k, struct run *e);

/* Restores the equilibrium saved in k, and the bonds of the list `broken` (NULL: none); frees k. */
void stand_give(struct stand *k, struct run *e, const struct break_list *broken);

/* Frees k without restoring it. */
void stand_free(struct stand *k, const struct run *e);

#endif
