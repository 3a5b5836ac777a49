/* Bonds that have softened to their end and are compressed again, where a crack closes (bonds_closing.c). For load
 * steps, which have no contact where bonds soften. A bond of stiffness c, length r and damage d has the energy
 *
 *     psi = 1/2 c r s^2 (1 - d) for s > 0,   1/2 c r s^2 for s <= 0
 *
 * also at d = 1: an ended bond that is compressed presses with the stiffness of an intact one, and a closed crack
 * carries compression as the intact body does. A load step finds the set of ended bonds that press in alternation with
 * the equilibrium, in which they are linear springs. */
#ifndef CLEAVE_BONDS_CLOSING
#define CLEAVE_BONDS_CLOSING

#include "bonds/bonds.h"

/* Updates which ended bonds of b press at the present positions of p: ended bonds that are compressed become springs of
 * their former weight, those in tension have no force any more. Counts of broken bonds, their energies and the damage
 * of particles do not change. source: inputs of the bonds. Returns the number of changes, each counted once for each
 * particle of the bond; 0 in explicit time steps, and in state-based models, in which the force of a single bond
 * follows from no energy. */
int64_t bonds_update_contact_springs_of_broken_bonds(struct bonds *b, const struct particles *p,
                                                     const struct bond_source *source);

/* Allocates b->soft.settled, the largest stretches of bonds at the last equilibrium of load steps, with 0, if it is not
 * allocated yet. */
void bonds_allocate_max_stretches_at_last_equilibrium(struct bonds *b);

/* Pairs of particles that a crack separates and that overlap without contact. pairs: their number; deepest: largest
 * length by which such a pair is shorter than in the reference configuration [m]. */
struct bond_overlap {
    int64_t pairs;
    real deepest;
};

/* Returns the pairs of particles of p between which the bond of b has ended or was cut by a pre-crack, and which are
 * compressed by more than the stretch at which an intact bond would begin to soften. limit: onsets of softening. */
struct bond_overlap bonds_find_overlap_at_cracks(const struct bonds *b, const struct particles *p,
                                                 const struct bond_limit *limit);

#endif
