/* Unconstrained fragments: parts of the body that supports, bonds and contact leave free to move as rigid bodies. */
#ifndef CLEAVE_PIECES
#define CLEAVE_PIECES

#include "quasistatic/statics.h"
#include "run/run.h"

/* Finds the unconstrained fragments and their free rigid motions for the present bonds, supports and contacts. */
void unconstrained_find(struct run *e);

/* Frees the list of unconstrained fragments. */
void unconstrained_free(struct statics *s);

/* Returns FAILED if the applied forces on an unconstrained fragment do not balance along its free motions. step: number
 * of the load step, for the message. */
status unconstrained_check(const struct statics *s, const struct particles *p, int64_t step);

/* Removes from the field v (forces or displacements) its components along the free rigid motions of the fragments, by
 * orthogonal projection. */
void unconstrained_project(const struct statics *s, struct field *v);

#endif
