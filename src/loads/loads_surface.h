/* The surface of bodies of lattice particles, for pressure that follows the deformation (loads_surface.c). */
#ifndef CLEAVE_LOADS_SURFACE
#define CLEAVE_LOADS_SURFACE

#include "loads/loads.h"

/* A free face of a particle, by axis and side of its normal. */
struct surface_face {
    int32_t particle;
    uint8_t axis;
    int8_t side;
};

/* List of free faces. */
struct surface_faces {
    int64_t n;
    struct surface_face *face;
};

/* Makes the surface of these faces and lists the particles at their corners as those of the load; shares: areas of the
 * reference state. all: the n boundaries of the scene, including mirrors. REFUSED if bodies are not lattices, or
 * mirrors are not midway between sites. */
status load_surface_make(struct load *l, const struct surface_faces *faces, const struct boundary *all, int n,
                         struct particles *p, real spacing);

/* Computes the inward areas at present positions of the particles of the load, by component: area [dim][load->n]
 * [m^2]. */
void surface_areas(struct surface *s, const struct particles *p, real *const *area);

/* Releases the surface. */
void load_surface_free(struct surface *s);

#endif
