/* Pieces of the body that supports, bonds and contact leave free to move as a whole. */
#ifndef CLEAVE_PIECES
#define CLEAVE_PIECES

#include "quasistatic/statics.h"
#include "run/run.h"

/* Finds the pieces and their free rigid motions, by the present bonds, supports and contacts. */
void statics_pieces_make(struct run *e);

/* Frees the list of pieces. */
void statics_pieces_free(struct statics *s);

/* Returns FAILED if applied forces would move a piece as a whole. step: number of the load step, for the message. */
status statics_unheld(const struct statics *s, const struct particles *p, int64_t step);

/* Removes the free rigid motions of the pieces from v, a field of forces or displacements. */
void statics_pieces_hold(const struct statics *s, struct field *v);

#endif
