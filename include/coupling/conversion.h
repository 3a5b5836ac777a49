/* Room `coupling` (folder of include/ and src/): coupling of peridynamic particles and material points: conversion of
 * points to peridynamic particles and back (reversion), partial stress, damping at the interface, pre-cracks as slits
 * of the mesh. The room uses bonds, loads and kernels; the engine uses it.
 *
 * This header: conversion of material points to peridynamic particles at the end of a time step, and the data that
 * depend on the kinds of particles: bond rows and partial stresses (parts of the stress of points that bonds carry). A
 * PD-MPM bond connects a peridynamic particle and a material point. */
#ifndef CLEAVE_CONVERSION
#define CLEAVE_CONVERSION

#include "bonds/bonds.h"
#include "data/cells.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "scene/requests.h"

/* Counts and times of conversion (material point to peridynamic particle) and reversion (the opposite) since the
 * start. */
struct conversion {
    real first_time;           /* time of the first conversion [s], NAN: none so far */
    real first_place[DIM_MAX]; /* reference position of the particle that triggered the first conversion [m] */
    int64_t start;             /* peridynamic particles in the first line of history.csv; before, those of the set-up */
    int64_t converted, events; /* conversions after the set-up; passes with conversions */
    int64_t peak_bonds; /* largest number of stored bonds at a time, each counted once for each of its particles that
                           has a row */
    int64_t peak;       /* largest number of peridynamic particles at a time */
    int64_t reverted, reversions; /* particles that became material points again; passes with reversions */
    real reversion_energy;        /* change of the total energy by reversions [J] */
};

/* Functions that convert_flagged_points_to_peridynamic calls, with `context` as first argument. sync: brings position
 * and velocity of the particles list[n] (indices, each once) up to date from the nodes of a mesh, before bonds of these
 * particles are made. converted: is called after the particles list[n] have become peridynamic and have bonds; NULL:
 * not called. */
struct conversion_sync {
    void (*sync)(void *context, const int32_t *list, int64_t n);
    void *context;
    void (*converted)(void *context, const int32_t *list, int64_t n);
};

/* Converts material points of p to peridynamic particles at the end of a step: points that lost a bond (FLAG_LOST_BOND)
 * or are near another body (FLAG_NEAR). If rule->criteria has the stress criterion, those with FLAG_STRESSED convert,
 * too. If rule->block is true, the particles of the same body within the cutoff of any of these points convert with
 * them. Clears these flags, rebuilds the bonds b from `source` if a particle converts, and updates the partial stresses
 * (parts of stresses that bonds carry; `partial`, NULL: none) near converted particles and broken bonds. sync:
 * functions to call before and after bonds are made, NULL if no particle is in a mesh; t: time [s]. Counts are added to
 * c. Returns the number of particles converted. */
int64_t convert_flagged_points_to_peridynamic(struct conversion *c, const struct conversion_rule *rule,
                                              struct particles *p, struct bonds *b, const struct bond_source *source,
                                              struct partial_stress *partial, const struct conversion_sync *sync,
                                              real t);

/* Makes those particles of p peridynamic, before step 0, that have a bond cut by a pre-crack (Zeng et al. 2022, eq. 28)
 * or are in `region` (NULL: no region). source: inputs of the bonds, with the pre-cracks. */
void convert_particles_at_precracks_to_peridynamic(struct particles *p, const struct bond_source *source,
                                                   const struct region *region);

/* Computes into *region the region whose particles are peridynamic from step 0 on: the region that the input file
 * gives, and a ball round each end of a pre-crack inside the body (in 3D a cylinder round each edge). The caller frees
 * region->solid; a region without solids is empty. p: particles; source: inputs of the bonds, with the pre-cracks;
 * scene_region: region of the input file, NULL: none; tip_radius: radius of the balls and cylinders [m]. */
void initial_pd_region_make(struct region *region, const struct region *scene_region, const struct particles *p,
                            const struct bond_source *source, real tip_radius);

/* Computes the partial stress of each material point of p whose cell is crossed by PD-MPM bonds, i.e. bonds to
 * peridynamic particles. The partial stress is the part of the stress of the point that these bonds carry, stored as
 * the matrix M by which the stress of the point must be multiplied to obtain it: M = T C^-1 with the elastic stiffness
 * C of the material and T = (1/V) sum K xi^2 l e e e e (partial_stress.c). The sum is over the bonds b, with stiffness
 * K, length xi, direction e and share l of the length inside the cell; V: volume of the point. source: inputs of the
 * bonds (horizon, materials, cracks, mirrors); converted_particles[n]: indices of the particles converted since the
 * last call; only points near them are recomputed. If `converted_particles` is NULL, all points are. Release with
 * partial_stress_free. */
void partial_stress_compute_from_bonds(struct partial_stress *partial, const struct particles *p, const struct bonds *b,
                                       const struct bond_source *source, const int32_t *converted_particles,
                                       int64_t converted_count);

/* Computes p->end_strain [1] for each material point on the background grid that has state-based bonds to peridynamic
 * particles: the part of the mean strain of its neighbourhood that is due to the deformation of the cell of the point
 * itself. The strain of the cell follows from the stress of the point by Hooke's law. Does nothing in bond-based
 * models. partial: lists these points; material: array of the materials. */
void bonded_mpm_points_compute_strain_from_stress(const struct partial_stress *partial, struct particles *p,
                                                  const struct material *material);

/* Releases all arrays of `partial`, the partial stresses of material points (the part of the stress that bonds
 * carry). */
void partial_stress_free(struct partial_stress *partial);

/* Saves the counts, times and energy of c to the archive `a` if a->saving, else restores them from it. Returns FAILED
 * if the archive cannot be read or written or a stored size differs. */
status conversion_save_or_load(struct conversion *c, struct archive *a);

#endif
