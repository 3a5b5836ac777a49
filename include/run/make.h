/* What a run makes of its scene and its particles before any part is there. */
#ifndef CLEAVE_RUN_MAKE
#define CLEAVE_RUN_MAKE

#include "run/run.h"

/* Lowers the triggers of materials [materials] whose strength scatters to those of their weakest particles. */
void strength_found(struct elastic *elastic, const struct particles *p);

/* Returns the impedances of absorbing faces [MOVERS][materials], by the constants of what moves their particles; NULL:
 * there are no such faces. The caller frees them. */
struct impedance *absorbing_impedances(const struct scene *s, const struct bond_source *source);

/* Lists the bodies whose shapes may have voids (tables->voids), and the mirrors that these have images beyond. Returns
 * false if there are none. */
bool run_voids_list(struct material_tables *tables, const struct scene *s, const struct loads *loads);

/* Returns the distance up to which bonds (of reach `cutoff` [m]) or cells join particles [m]. */
real voids_reach(const struct scene *s, real cutoff);

/* Have a body and what is joined to it a surface that is known, none of lists and images? */
bool surface_known(const struct scene *s, int body);
/* Makes the weights w of bonds near faces, of which `source` keeps the address. REFUSED where particles are on no
 * lattice. */
status run_surface_make(struct surface_weights *w, struct bond_source *source, const struct particles *p,
                        const struct loads *loads, const struct scene *s);

/* REFUSED where bodies that the scene joins are farther apart than `cutoff` [m]. */
status joined_check(const struct scene *s, const struct particles *p, const struct cells *cells, real cutoff);

/* REFUSED for what is driven by place on a grid that knows no reference places, and for displacements that jump or, at
 * the `start` of a run, are not from where particles are. */
status driving_check(const struct loads *loads, const struct particles *p, const struct scene *s, bool start);

#endif
