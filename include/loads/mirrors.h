/* Planes of symmetry that bonds cross (loads_mirror.c). */
#ifndef CLEAVE_MIRRORS
#define CLEAVE_MIRRORS

#include "loads/loads.h"

/* Checks the distance between parallel mirrors of a body with bonds of at most `bond_length` [m]. A particle between
 * mirrors that are closer would have bonds to images of images on both sides, of which only one exists. The forces
 * would have no potential, and no time step would be stable. Material points have no such limit. Returns REFUSED, with
 * a message, if the distance is at most the bond length minus a spacing. */
status loads_check_bonds_between_mirrors(const struct loads *l, real bond_length);

#endif
