/* Particles while they are collected: of lattices (fill.c) and of lists (fill_list.c). */
#ifndef CLEAVE_FILL_DRAFT
#define CLEAVE_FILL_DRAFT

#include "data/hollow.h"
#include "scene/scene.h"

/* Particles in the order in which the scene makes them, collected before their number is known. */
struct draft {
    const struct scene *scene;
    const struct hollow *hollow; /* cells whose particles are not made; NULL: none */
    int64_t n, room;
    int64_t skipped;                  /* that are not made */
    real low[DIM_MAX], high[DIM_MAX]; /* of those [m] */
    real *X[DIM_MAX], *volume;        /* [m], [m^3] */
    real *v[DIM_MAX], *mass;          /* as lists say; NAN: as the body and its material say [m/s], [kg] */
    uint8_t *material, *body;
    int32_t *id;
};

/* Appends a particle at X [m], [dim]; volume [m^3]. REFUSED beyond PARTICLES_MAX particles. */
status draft_add(struct draft *d, const real *X, real volume, int material, int body);
status draft_refuse(const struct draft *d, int body, const char *why);
/* Adds the particles of a body from its list. */
status fill_list(struct draft *d, int body);

#endif
