/* Declares functions for the set-up of a run that use its scene, particles and loads, but none of its parts (contact,
 * mesh, probes and others). */
#ifndef CLEAVE_RUN_MAKE
#define CLEAVE_RUN_MAKE

#include "run/run.h"

/* Reduces elastic[m].trigger [Pa], the stress at which material points of material m convert to peridynamic particles,
 * to the conversion stress of the weakest particle of this material. Does nothing unless the strength of particles is
 * random (p->strength). elastic: array of the constants of all materials, changed in place; p: particles of the run. */
void conversion_stresses_set_by_weakest_particles(struct elastic *elastic, const struct particles *p);

/* Returns the wave impedances that absorbing boundaries use, an array [MOVERS][materials]: for each material and for
 * each method that moves its particles (bonds, grid or mesh). Release it with memory_free. Returns NULL if the scene s
 * has no absorbing boundary or is static. source: bond law. */
struct impedance *absorbing_boundary_impedances(const struct scene *s, const struct bond_source *source);

/* Lists the shapes of bodies of scene s that may contain voids (narrow slots or gaps, across which no bonds are made),
 * and of all bodies joined to these, in tables->voids. Lists the planes of all mirror boundaries in
 * tables->void_mirror. Bodies are left out if they or bodies joined to them are made from particle lists or images.
 * loads: state on which side of each mirror plane the body is. Shapes are kept by reference to s; the lists are
 * released with `tables` at the end of the run. Returns true if at least one shape was listed. */
bool material_tables_list_bodies_with_possible_voids(struct material_tables *tables, const struct scene *s,
                                                     const struct loads *loads);

/* Returns the largest distance [m] across which particles interact: through bonds, which are shorter than `cutoff` [m],
 * or as points of one cell of the mesh. s: scene. Across voids narrower than this distance, bonds must be removed and
 * mesh nodes doubled. */
real scene_interaction_distance_across_voids(const struct scene *s, real cutoff);

/* Returns true if solids (geometric shapes, also surfaces read from files) of the input file define the surfaces of all
 * bodies of a group that interfaces join to one another, i.e. if none of them is made from a particle list or a voxel
 * image. s: scene (the input file); first_body: lowest index of the bodies of the group, s->body[].joined of each; a
 * body without such interfaces is a group of its own. */
bool joined_bodies_are_all_defined_by_solids(const struct scene *s, int first_body);

/* Computes factors on the weights (themselves factors on the forces) of bonds near free surfaces into `correction`, by
 * moments of the bond weights (key `pd.surface: moments`), and sets source->surface = `correction`, so that
 * `correction` must outlive `source`. Returns REFUSED, with a message, if particles of p that can have bonds, mirror
 * images included, are not on one lattice. loads: boundary conditions, so that the message can name the boundary of
 * scene s whose mirror plane does not fit the lattice. */
status surface_correction_compute_bond_weight_factors(struct surface_correction *correction, struct bond_source *source,
                                                      const struct particles *p, const struct loads *loads,
                                                      const struct scene *s);

/* Checks that bodies which the scene s joins by an interface are close enough for bonds. p: particles; cells: search
 * cells of the particles; cutoff: largest length of a bond [m]. Returns REFUSED, with a message, if no particle of one
 * body is within `cutoff` of a particle of the other. */
status joined_bodies_check_within_bond_reach(const struct scene *s, const struct particles *p,
                                             const struct cells *cells, real cutoff);

/* Checks the velocities and displacements that the boundaries of scene s prescribe. loads: loads and supports made from
 * these boundaries; p: particles at the start; run_begins: true at the beginning of a run, false at a restart. Returns
 * REFUSED, with a message, in these cases: a value depends on the reference position but acts on material points on the
 * background grid, which store present positions only; in an explicit run, a displacement jumps, is not 0 at t = 0, or
 * changes as fast as the fastest wave or faster; at the beginning, particles with a prescribed displacement are not at
 * their reference positions. */
status prescribed_motion_check_is_admissible(const struct loads *loads, const struct particles *p,
                                             const struct scene *s, bool run_begins);

#endif
