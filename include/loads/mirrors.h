/* Planes of symmetry or antisymmetry: mirror images of particles beyond them, and whether nodes of a grid fit them
 * (loads_mirror.c, loads_walls.c). */
#ifndef CLEAVE_MIRRORS
#define CLEAVE_MIRRORS

#include "loads/loads.h"

/* Checks all mirror boundaries of l and appends to p mirror images (copies beyond the plane) of the particles within
 * `mirror_reach` [m] of their planes. optional_arrays: optional particle arrays, as in particles_make. Part of
 * loads_make_from_boundaries. Returns REFUSED, with a message, if a mirror plane is inside its body or two mirrors
 * coincide. */
status loads_append_mirror_images_of_particles(struct loads *l, struct particles *p, real mirror_reach,
                                               int optional_arrays);

/* Sets the flag MOVES_LATER in l->loaded for the particles of p whose bonds may cross a clamped mirror plane (a mirror
 * that also prevents motion along its plane). The reactions of such bonds are added after all bond forces, so these
 * particles must not be moved before. */
void loads_flag_clamped_mirror_particles_to_move_late(struct loads *l, const struct particles *p);

/* Copies position x, velocity v, kind and FLAG_DRIVEN of the source particles of p to their mirror images, reflected in
 * the mirror plane. Before this, the coordinates of the source particles normal to the mirror are rounded to multiples
 * of l->place_step, if it is not 0, so that image and particle are exactly symmetric. */
void loads_update_mirror_images_of_particles(const struct loads *l, struct particles *p);

/* Checks the distance between parallel mirrors of l for a body with bonds of at most `bond_length` [m]. A particle
 * between mirrors that are closer would have bonds to images of images on both sides, of which only one exists. The
 * forces would have no potential, and no time step would be stable. Material points have no such limit. Returns
 * REFUSED, with a message, if the distance is at most the bond length minus a spacing. */
status loads_check_distance_between_mirrors(const struct loads *l, real bond_length);

/* Returns true if the plane of mirror b is on a row of nodes of grid g or midway between two rows, so that nodes have
 * nodes as mirror images. spacing: lattice spacing of the particles, to which the tolerance refers [m]. */
bool mirror_plane_is_at_or_midway_between_nodes(const struct boundary *b, const struct grid *g, real spacing);

#endif
