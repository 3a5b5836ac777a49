/* Room `coupling`: where peridynamic particles and material points meet: conversion, reversion, partial stress,
 * interface damping, grid-coupled particles. It knows bonds, loads and kernels; the engine calls it.
 *
 * Material point -> peridynamic particle, one compacting pass at the end of the step, and the coupling data that
 * follow from the kinds: bond rows and partial stresses. */
#ifndef CLEAVE_CONVERSION
#define CLEAVE_CONVERSION

#include "bonds/bonds.h"
#include "data/cells.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "scene/requests.h"

/* What conversion has done so far. */
struct conversion {
    real first_time;                  /* [s], NAN before */
    real first_place[DIM_MAX];        /* reference position of the first triggered particle [m] */
    int64_t start, converted, events; /* peridynamic particles at t = 0; converted since; passes */
    int64_t peak_bonds;               /* directed bonds stored, most at any time */
    int64_t peak;                     /* peridynamic particles, most at any time */
    int64_t reverted, reversions;     /* particles that became material points again; passes */
    real reversion_energy;            /* all energy less that before, of these passes [J] */
};

/* What a pass asks of others. sync: updates particles whose motion is stored on the nodes of a mesh (mesh.h), before
 * bonds to them are made; the list names each particle once. converted (may be NULL): these have become peridynamic,
 * and their bonds are made. */
struct conversion_sync {
    void (*sync)(void *context, const int32_t *list, int64_t n);
    void *context;
    void (*converted)(void *context, const int32_t *list, int64_t n);
};

/* Converts every material point flagged FLAG_STRESSED or FLAG_LOST_BOND (as the criteria say), both ends of a bond that
 * broke, and with `block` their neighbours within the horizon; clears the flags of the step. Rows of bonds and
 * partial stresses (`partial` NULL: hand-shake without them) are rebuilt only if something converted. Bonds that are
 * past their limit when made are cut at once and their energy is booked as fracture. `sync` may be NULL. Returns the
 * number of particles converted. */
int64_t convert(struct conversion *c, const struct conversion_rule *rule, struct particles *p, struct bonds *b,
                const struct bond_source *source, struct partial_stress *partial, const struct conversion_sync *sync,
                real t);

/* Marks as peridynamic, before step 0, every particle one of whose bonds a pre-crack cuts (Zeng et al. 2022,
 * eq. 28), and those in `region` (NULL: none). */
void convert_start(struct particles *p, const struct bond_source *source, const struct region *region);

/* What is peridynamic before step 0 and stays so: the region that the scene gives (NULL: none), and `radius` [m]
 * round the ends of pre-cracks that lie in the body (in space: their edges). The caller frees `to`; one without
 * solids is none. */
void convert_region(struct region *to, const struct region *given, const struct particles *p,
                    const struct bond_source *source, real radius);

/* Partial stress (partial_stress.c) of every material point whose cell a bond between a peridynamic particle and a
 * material point crosses: T = (1/V) sum K xi^2 l e e e e, l the share of the bond's reference segment inside the cell.
 * `changed`: particles converted since the last call, only their surroundings are made anew; NULL: everything. */
void partial_stress_make(struct partial_stress *partial, const struct particles *p, const struct bonds *b,
                         const struct bond_source *source, const int32_t *changed, int64_t n);
/* Sets particles.end_strain of points on the grid at the ends of state-based bonds, from their stress. */
void partial_ends_update(const struct partial_stress *partial, struct particles *p, const struct material *material);
void partial_stress_free(struct partial_stress *partial);
status conversion_archive(struct conversion *c, struct archive *a);

#endif
