/* Pieces of the body that supports, bonds and contact leave free to move as a whole. */
#ifndef CLEAVE_PIECES
#define CLEAVE_PIECES

#include "run/run.h"
#include "solver/field.h"

/* Finds the pieces and their free rigid motions, by the present bonds, supports and contacts. */
void statics_pieces_make(struct run *e);

/* Frees the list of pieces. */
void statics_pieces_free(struct run *e);

/* Returns FAILED if applied forces would move a piece as a whole. */
status statics_unheld(const struct run *e);

/* Removes the free rigid motions of the pieces from v, a field of forces or displacements. */
void statics_pieces_hold(const struct run *e, struct field *v);

#endif
