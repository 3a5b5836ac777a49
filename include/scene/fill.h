/* Creates the particles of a scene: positions, volumes, masses, materials; bonds, grids and loads follow later. */
#ifndef CLEAVE_FILL
#define CLEAVE_FILL

#include "data/hollow.h"
#include "data/particles.h"
#include "scene.h"

/* Largest distance of a particle from the origin [spacings]. Double precision rounds a coordinate there by 1e-9 of a
 * spacing, which changes a strain of 1e-4 by 1e-5 of its value. Ten thousand times farther out, stresses are 3 %
 * wrong. */
#define FILL_FARTHEST 1e7

/* Creates the particles of all bodies of the scene s, from lattices and particle lists, and sets their positions,
 * volumes, masses and initial state. empty_cells: cells whose particles are not created since they will be inside
 * coarse mesh cells, NULL for none; the ids of these particles are left out. optional_arrays: optional arrays of p, a
 * sum of WITH_*. Returns REFUSED, with a message and with p empty, for an empty body, an unreadable list, a list in
 * another length unit than the spacing, or two particles at one position. Release p with particles_free. */
status bodies_fill_with_particles(struct particles *p, const struct scene *s,
                                  const struct cells_without_particles *empty_cells, int optional_arrays);

/* Computes the position X[dim] [m] of the first site of the lattice that fills body number `body` of scene s: the site
 * with the smallest coordinates, from which the positions of all other sites follow. The body must not come from a
 * particle list. Returns REFUSED, with a message, if the body has no lattice, for example because the scene states no
 * spacing. */
status body_lattice_compute_first_site_position(const struct scene *s, int body, real *X);

/* Finds the cells of the grid hollow->box in which all lattice sites (possible particle positions) are inside the body
 * with the index `body_index` of scene s. Sets hollow->whole[cell] to 1 for these cells, else to 0, in an array that is
 * allocated here and that the caller releases with memory_free. hollow->box must be set before. */
void body_flag_cells_with_all_lattice_sites_inside(struct cells_without_particles *empty_cells, const struct scene *s,
                                                   int body_index);

/* Compares the distances between neighbours in the particle list of each body with the particle spacing of scene s. p:
 * particles that were read from the lists. Returns REFUSED, with a message, if they differ so much that a list seems to
 * be in another length unit, or if there would be more bonds than memory can hold. */
status particle_lists_check_distances_fit_spacing(const struct particles *p, const struct scene *s);

/* Sets p->strength, the factor on the strength of each particle [1]: a random number if the scene s gives the material
 * of the particle a random strength, else 1. Does nothing if p->strength is NULL. */
void particles_set_strength_factors(struct particles *p, const struct scene *s);

/* Returns the temperature at which `material` of the scene s starts [K]: the room temperature of its flow law, or if it
 * has none, that of the first material which has one, or else ROOM_TEMPERATURE. */
real scene_initial_temperature(const struct scene *s, const struct material *material);

/* Sets the temperature of each particle, p->temperature [K], to that at which its material in the scene s starts. Does
 * nothing if p->temperature is NULL. */
void particles_set_initial_temperatures(struct particles *p, const struct scene *s);
#define ROOM_TEMPERATURE 293.15

#endif
