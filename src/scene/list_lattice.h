/* Lists of particles that are lattices (list_lattice.c). */
#ifndef CLEAVE_LIST_LATTICE
#define CLEAVE_LIST_LATTICE

#include "scene/particle_list.h"

/* Are the places of each body of a list whole spacings apart, to a thousandth of one, and all volumes those of the
 * spacing, to a thousandth? volume: of a particle of the lattice [m^3]. */
bool list_is_lattice(const struct particle_list *l, real spacing, real volume);
/* Puts n coordinates of a body on one axis, which are whole spacings apart to a thousandth, exactly so, unless they are
 * that to all digits. anchor: place from which they are whole or half spacings away, if they nearly are [m]. */
void list_to_lattice(real *X, int64_t n, real spacing, real anchor);

#endif
