/* The active set of blocks of eight rows of bonds (data/active_set.h). */
#ifndef CLEAVE_ACTIVE_ROWS
#define CLEAVE_ACTIVE_ROWS

#include "bonds/bonds.h"
#include "loads/loads.h"

/* Updates which blocks of eight rows are active after a step. A block is a group of eight particles whose bonds are
 * stored together; bond forces are computed for active blocks only. The forces of all active ones must have been
 * computed in this step. Activates the neighbours of blocks whose particles have changed position; if rows were
 * rebuilt, determines anew which blocks are active. b: bonds of the particles p, with the list of active blocks, which
 * changes; loads: blocks of particles on which loads or contact act remain active. */
void active_bond_row_blocks_update_after_step(struct bonds *b, const struct particles *p, const struct loads *loads);

/* Activates the blocks of eight rows (groups of eight particles whose bonds are stored together) that contain any of
 * the particles in particle_list[particle_count] (indices). To be called if forces other than those of bonds (loads,
 * contact) may act on these particles from the next step on. The bond forces in these blocks must be 0 so far. b: bonds
 * of the particles p, with the list of active blocks, which changes; loads: boundary conditions, and the particles on
 * which contact acts. */
void active_bond_row_blocks_activate_for_particles(struct bonds *b, const struct particles *p,
                                                   const struct loads *loads, const int32_t *particle_list,
                                                   int64_t particle_count);

#endif
