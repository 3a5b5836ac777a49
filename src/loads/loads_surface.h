/* The surface of bodies of lattice particles, for pressure that follows the deformation (loads_surface.c). */
#ifndef CLEAVE_LOADS_SURFACE
#define CLEAVE_LOADS_SURFACE

#include "loads/loads.h"

/* A free face of a particle. particle: index of the particle; axis: axis of the outward normal, 0 to dim - 1; side: -1
 * or 1, the direction of the normal along this axis. */
struct surface_face {
    int32_t particle;
    uint8_t axis;
    int8_t side;
};

/* List of free faces of particles, face[0 .. n - 1]. */
struct surface_faces {
    int64_t n;
    struct surface_face *face;
};

/* Creates the surface l->surface of the body from `free_faces`, makes the particles of p at the corners of these faces
 * the particles of load l, and stores their area vectors in the reference state in l->share [m^2], by which the
 * pressure is multiplied to obtain forces. all_boundaries: the boundary conditions of the input file, `boundary_count`
 * in number, including mirrors; spacing: lattice spacing [m]. Returns REFUSED, with a message, if a body is not a
 * lattice, or a mirror plane is not midway between two lattice sites. Release with load_surface_free. */
status load_surface_make_from_free_faces(struct load *l, const struct surface_faces *free_faces,
                                         const struct boundary *all_boundaries, int boundary_count, struct particles *p,
                                         real spacing);

/* Computes into `area` the area vector of each particle of the load to which the surface s belongs, by which the
 * pressure is multiplied to obtain the force on the particle, from the present positions of p. It points into the body.
 * area: [dim][number of particles of the load] [m^2]. */
void load_surface_compute_area_vectors(struct surface *s, const struct particles *p, real *const *area);

/* Frees the surface s, which load_surface_make_from_free_faces has made, with its arrays; s may be NULL. */
void load_surface_free(struct surface *s);

#endif
