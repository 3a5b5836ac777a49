/* The surface of bodies of lattice particles, for pressure that follows it (loads_surface.c). */
#ifndef CLEAVE_LOADS_SURFACE
#define CLEAVE_LOADS_SURFACE

#include "loads/loads.h"

/* Free faces of particles, each by its axis and side. */
struct surface_face {
    int32_t particle;
    uint8_t axis;
    int8_t side;
};
struct surface_faces {
    int64_t n;
    struct surface_face *face;
};

/* The load acts on the particles that the corners of these faces go with: takes them, their shares being the areas of
 * the reference state. all: the n boundaries of the scene, with the mirrors. REFUSED where bodies are no lattice, or
 * mirrors do not stand half-way between its sites. */
status load_surface_make(struct load *l, const struct surface_faces *faces, const struct boundary *all, int n,
                         struct particles *p, real spacing);
/* Areas at present places that the particles of the load bear, inwards, by component [load->n] [m^2]. */
void surface_areas(struct surface *s, const struct particles *p, real *const *area);
void load_surface_free(struct surface *s);

#endif
