/* What a run makes of its scene and its particles before any part is there. */
#ifndef CLEAVE_RUN_MAKE
#define CLEAVE_RUN_MAKE

#include "run/run.h"

/* Triggers of materials whose strength scatters, once their particles are made. */
void strength_found(struct run *e);
/* Dashpots of absorbing faces, by the constants of what moves their particles. */
void absorbing_make_all(struct run *e);
/* Finds the voids of bodies that have shapes (e->tables.voids); e->source.voids stays NULL where none can be. */
void run_voids_make(struct run *e);
/* Distance up to which bonds or cells join particles [m]. */
real voids_reach(const struct run *e);
/* Have a body and what is joined to it a surface that is known, none of lists and images? */
bool surface_known(const struct scene *s, int body);
/* Makes the weights of bonds near faces. REFUSED where particles are on no lattice. */
status run_surface_make(struct run *e);
/* REFUSED where bodies that the scene joins are apart. */
status joined_check(const struct run *e);
/* REFUSED for what is driven by place on a grid that knows no reference places, and for displacements that jump or, at
 * the `start` of a run, are not from where particles are. */
status driving_check(const struct run *e, bool start);

#endif
