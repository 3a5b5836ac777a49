/* Steps of the set-up of a run that need its scene and particles, and no part of the run. */
#ifndef CLEAVE_RUN_MAKE
#define CLEAVE_RUN_MAKE

#include "run/run.h"

/* Lowers the triggers of materials [materials] whose strength scatters to those of their weakest particles. */
void strength_found(struct elastic *elastic, const struct particles *p);

/* Returns the impedances of absorbing faces [MOVERS][materials], by the constants of what moves their particles; NULL:
 * there are no such faces. The caller frees them. */
struct impedance *absorbing_impedances(const struct scene *s, const struct bond_source *source);

/* Lists the bodies whose shapes may have voids (tables->voids), and the mirrors of the scene, beyond which bodies have
 * images. Returns false if there are none. */
bool run_voids_list(struct material_tables *tables, const struct scene *s, const struct loads *loads);

/* Returns the distance up to which bonds (of reach `cutoff` [m]) or cells join particles [m]. */
real voids_reach(const struct scene *s, real cutoff);

/* Returns true if the surface of a body and of all bodies joined to it is known: no body is made from a list or an
 * image. */
bool surface_known(const struct scene *s, int body);

/* Computes the weights w of bonds near faces (pd.surface moments), which `source` refers to afterwards. REFUSED if the
 * particles of a body are not on one lattice. */
status run_surface_make(struct surface_weights *w, struct bond_source *source, const struct particles *p,
                        const struct loads *loads, const struct scene *s);

/* Returns REFUSED if two bodies that the scene joins are farther apart than `cutoff` [m]. */
status joined_check(const struct scene *s, const struct particles *p, const struct cells *cells, real cutoff);

/* Checks prescribed velocities and displacements. REFUSED for values that depend on reference positions, which the grid
 * of the current frame does not store; for displacements that jump or grow faster than waves; and, at the `start` of a
 * run, for displacements of particles that are not at their reference positions. */
status driving_check(const struct loads *loads, const struct particles *p, const struct scene *s, bool start);

#endif
