/* floor 1: what the files bonds*.c share: one row of bonds while it is made. */
#ifndef CLEAVE_BONDS_PARTS_H
#define CLEAVE_BONDS_PARTS_H

#include "bonds.h"

struct row {
    int n;
    int32_t *nbr;
    real *inverse_length;
    float *w;
    struct bond_plasticity *plastic;
    real trigger, family_volume, cut_volume;
};

/* Micro-moduli of all pairs of materials over that of material 0. */
struct pair_table { real *ratio; int materials; };

/* Room for a row of `room` bonds. */
void row_room_make(struct row *row, int room);
void row_room_free(struct row *row);

/* Particles and images of the body of particle i within the cutoff, ascending. Returns how many there are; more than
 * `room` are not written. */
int family_search(const struct bond_source *s, const struct particles *p, int32_t i, int32_t *found, int room);

/* Row of particle i: what it was in `old` if it held the whole family there or is not `fresh`, else made anew with what load has done to the
 * bonds that it held. `weigh` false: only who the neighbours are, to count them. */
void row_make(struct row *row, const struct bonds *old, const struct bond_source *s, const struct particles *p,
              const struct pair_table *pairs, int32_t i, int room, bool weigh, bool fresh);

/* What state-based models keep; after the rows and their `whole` (bonds_state.c). */
void state_make(struct bonds *b, const struct particles *p, const struct bond_source *s);
void state_free(struct bonds *b);

#endif
