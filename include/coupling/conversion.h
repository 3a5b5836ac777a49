/* Room `coupling`: the coupling of peridynamic particles and material points: conversion, reversion, partial stress,
 * interface damping, slits for pre-cracks. The room uses bonds, loads and kernels; the engine uses it.
 *
 * This header: conversion of material points to peridynamic particles, one pass at the end of a step, and the coupling
 * data that depend on the kinds of particles: bond rows and partial stresses. PD-MPM bonds are the bonds between a
 * peridynamic particle and a material point. */
#ifndef CLEAVE_CONVERSION
#define CLEAVE_CONVERSION

#include "bonds/bonds.h"
#include "data/cells.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "scene/requests.h"

/* Results of conversion and reversion so far. */
struct conversion {
    real first_time;                  /* time of the first conversion [s], NAN: none so far */
    real first_place[DIM_MAX];        /* reference position of the particle that triggered the first conversion [m] */
    int64_t start, converted, events; /* peridynamic particles at t = 0; conversions since; passes with conversions */
    int64_t peak_bonds;               /* largest number of stored directed bonds at a time */
    int64_t peak;                     /* largest number of peridynamic particles at a time */
    int64_t reverted, reversions;     /* particles that became material points again; passes with reversions */
    real reversion_energy;            /* change of the total energy by reversions [J] */
};

/* Callbacks of a pass. sync: updates n listed particles whose motion is stored on the nodes of a mesh (mesh.h), before
 * bonds to them are made; the list contains each particle once. converted (may be NULL): n listed particles have become
 * peridynamic and have bonds now. context: first argument of both. */
struct conversion_sync {
    void (*sync)(void *context, const int32_t *list, int64_t n);
    void *context;
    void (*converted)(void *context, const int32_t *list, int64_t n);
};

/* Converts every material point flagged FLAG_STRESSED or FLAG_LOST_BOND (as rule->criteria select) and, with
 * rule->block, its neighbours within the horizon; clears the flags of the step. Rows of bonds and partial stresses
 * (`partial`, NULL: hand-shake without them) are rebuilt only if a particle is converted. Bonds beyond their limit when
 * made are cut at once and their energy is booked as fracture. sync: NULL if no particle is in a mesh; t: time [s].
 * Returns the number of particles converted. */
int64_t convert_flagged_points(struct conversion *c, const struct conversion_rule *rule, struct particles *p,
                               struct bonds *b, const struct bond_source *source, struct partial_stress *partial,
                               const struct conversion_sync *sync, real t);

/* Makes every particle peridynamic, before step 0, that has a bond cut by a pre-crack (Zeng et al. 2022, eq. 28), and
 * the particles in `region` (NULL: none). */
void convert_cut_particles(struct particles *p, const struct bond_source *source, const struct region *region);

/* Computes the region `to` that is peridynamic from step 0 on: the region of the scene (`given`, NULL: none), and a
 * ball of `radius` [m] round each end of a pre-crack inside the body (in 3D a cylinder round each edge). The caller
 * frees to->solid; a region without solids is empty. */
void initial_pd_region_make(struct region *to, const struct region *given, const struct particles *p,
                            const struct bond_source *source, real radius);

/* Computes for every material point whose cell is crossed by PD-MPM bonds the stiffness tensor T of fourth rank that
 * maps the strain of the point to its partial stress (partial_stress.c): T = (1/V) sum K xi^2 l e e e e over these
 * bonds, with e the direction of the bond and l the share of its reference segment inside the cell. changed[n]:
 * particles converted since the last call, only whose surroundings are recomputed; NULL: all points. */
void partial_stress_make(struct partial_stress *partial, const struct particles *p, const struct bonds *b,
                         const struct bond_source *source, const int32_t *changed, int64_t n);

/* Sets p->end_strain of the material points of state-based PD-MPM bonds on the grid, from their stress. material:
 * [materials]. */
void bonded_points_strain_from_stress(const struct partial_stress *partial, struct particles *p,
                                      const struct material *material);

/* Releases all arrays. */
void partial_stress_free(struct partial_stress *partial);

/* Saves or restores the results of conversion. */
status conversion_archive(struct conversion *c, struct archive *a);

#endif
