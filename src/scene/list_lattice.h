/* Recognises particle lists whose positions form a lattice (list_lattice.c). */
#ifndef CLEAVE_LIST_LATTICE
#define CLEAVE_LIST_LATTICE

#include "scene/particle_list.h"

/* Returns true if the particles of each body of the list l form a lattice: their positions are whole numbers of
 * `spacing` [m] apart, to a thousandth of a spacing, and all volumes equal `cell_volume`, the volume of a lattice cell
 * [m^3], to a thousandth. */
bool particle_list_is_lattice(const struct particle_list *l, real spacing, real cell_volume);

/* Rounds the `count` coordinates `coordinate` [m] of the particles of a body along one axis to exact multiples of
 * `spacing` [m]. The coordinates must be whole spacings apart up to a thousandth of a spacing. They are unchanged if
 * they are exact already. plane_coordinate: coordinate of a plane [m]; if the coordinates are nearly n or n + 1/2
 * spacings away from it, with a whole number n, they become exactly so. */
void coordinates_round_to_lattice(real *coordinate, int64_t count, real spacing, real plane_coordinate);

#endif
