/* Creates the particles of a scene: positions, volumes, masses, materials; bonds, grids and loads follow later. */
#ifndef CLEAVE_FILL
#define CLEAVE_FILL

#include "data/hollow.h"
#include "data/particles.h"
#include "scene.h"

/* Largest distance from the origin at which doubles resolve strains [spacings]: a coordinate is rounded by 1e-9 of a
 * spacing there, which is 1e-5 of a strain of 1e-4. At ten thousand times this distance stresses are 3 % off. */
#define FILL_FARTHEST 1e7

/* Creates the particles of all bodies of s, from lattices and particle lists, and sets their positions, volumes, masses
 * and initial state. optional_arrays: optional arrays of p, sum of WITH_*; hollow: cells without particles, NULL: none;
 * the ids of their particles stay unused. Returns REFUSED, with a message and with p empty, for an empty body, an
 * unreadable list, a list in another length unit than the spacing, or two particles at one position. Release with
 * particles_free. */
status fill_particles(struct particles *p, const struct scene *s, const struct cells_without_particles *hollow,
                      int optional_arrays);

/* Computes the position of one site of the lattice that fills body number `body` into X (dim components [m]). The body
 * must not come from a particle list. Returns REFUSED, with a message, if the body has no lattice, for example because
 * the scene gives no spacing. */
status fill_lattice_site(const struct scene *s, int body, real *X);

/* Finds the cells of hollow->box in which all particle positions are inside body number `body`, and marks them in
 * hollow->whole, one byte per cell, which is allocated here and freed by the caller. hollow->box must be set before. */
void fill_mark_whole_cells(struct cells_without_particles *hollow, const struct scene *s, int body);

/* Checks the particle lists of all bodies against the particle spacing of the scene, by the distances between
 * neighbours in each list. Returns REFUSED, with a message, if they differ so much that the list must be in another
 * length unit, or if there would be more bonds than memory can hold. */
status fill_check_particle_lists(const struct particles *p, const struct scene *s);

/* Sets the strength factor of each particle [1] (fill_strength.c): random where the strength of its material scatters,
 * else 1. Does nothing if p->strength is NULL. */
void fill_strength_factors(struct particles *p, const struct scene *s);

/* Sets the temperature of each particle [K] (fill_strength.c): the room temperature that the flow law of its material
 * gives, or ROOM_TEMPERATURE if it gives none. Does nothing if p->temperature is NULL. */
void fill_initial_temperature(struct particles *p, const struct scene *s);
#define ROOM_TEMPERATURE 293.15

#endif
