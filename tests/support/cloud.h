/* Small bodies for tests of kernels: a regular or irregular lattice with its neighbourhood, cells and bonds. */
#ifndef CLEAVE_TESTS_CLOUD
#define CLEAVE_TESTS_CLOUD

#include <math.h>
#include <string.h>

#include "kernels/kernels.h"
#include "bonds/bonds.h"
#include "bonds/surface.h"
#include "base/memory.h"
#include "data/particles.h"

enum { CLOUD_MATERIALS = 2 };
#define CLOUD_SPACING 1e-3 /* [m] */

/* Returns transfer_data.half_width [m] for particles at a distance of CLOUD_SPACING on a grid of node distance h [m].
 */
static inline real cloud_half_width(enum shape shape, real h)
{
    return 0.5 * (shape == SHAPE_QUADRATIC ? h : CLOUD_SPACING);
}

/* Plan of a body on a lattice of CLOUD_SPACING, from which particle_cloud_make makes its particles. Members that are 0
 * mean: one particle in this direction, a regular lattice, whole volumes of neighbours, calibration on the lattice. */
struct cloud_plan {
    enum space space;
    int count[DIM_MAX]; /* particles per direction; 0 means 1 */
    real horizon;       /* [spacings] */
    real shake;         /* largest displacement [spacings]; volumes vary by the same factor */
    uint64_t seed;
    int optional; /* bit set of WITH_* arrays */
    enum volume_rule volume;
    enum calibration calibration;
    enum surface_rule surface;
    enum shell_rule shells;
    enum influence influence;
};

/* A body with all that bond kernels need: particles; two materials, with the limits and yield stretches of bonds by
 * pair of materials; cells for the neighbour search; bonds and the data from which they are made; surface corrections.
 * It owns its arrays; release them with particle_cloud_free. */
struct particle_cloud {
    struct particles p;
    struct material material[CLOUD_MATERIALS];
    real limit[CLOUD_MATERIALS * CLOUD_MATERIALS];
    real yield[CLOUD_MATERIALS * CLOUD_MATERIALS], hardening[CLOUD_MATERIALS * CLOUD_MATERIALS]; /* yield stretch
                                                                                                  * infinite,
                                                                                                  * hardening 0 */
    struct cells cells;
    struct bond_source source;
    struct bonds bonds;
    real *neighbour_volume;
    struct surface_correction surface;
};

/* Returns a pseudo-random number, uniform in [0, 1) and equal on all machines, from a linear congruential generator,
 * which suffices to perturb particles. seed: state of the generator, which is advanced. */
static inline real cloud_random(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (real)(*seed >> 11) * 0x1p-53;
}

/* Returns a pseudo-random number, uniform between low and high. seed: state of the generator, which is advanced. */
static inline real cloud_between(uint64_t *seed, real low, real high)
{
    return low + (high - low) * cloud_random(seed);
}

/* Sets the two materials of the body c to elastic ones, like steel and aluminium, whose bonds neither break nor yield
 * (infinite limits). Poisson's ratio is that of bond-based peridynamics in the space, 0 in 1D. */
static inline void cloud_materials(struct particle_cloud *c, enum space space)
{
    static const real young[] = {200e9, 70e9}, density[] = {8000, 2700};
    for (int m = 0; m < CLOUD_MATERIALS; m++) {
        struct material *k = &c->material[m];
        *k = (struct material){
            .young = young[m], .density = density[m], .energy_release_rate = NAN, .critical_stretch = INFINITY};
        k->poisson = space == SPACE_LINE ? 0 : bond_based_poisson_ratio(space);
        material_compute_derived_constants(k, space);
    }
    for (int k = 0; k < CLOUD_MATERIALS * CLOUD_MATERIALS; k++) c->limit[k] = c->yield[k] = INFINITY;
}

/* Creates the particles of the body c by a plan: peridynamic, one body, material 0, at rest at their reference
 * positions. The body has no cells and bonds yet (cloud_source, cloud_bonds). Release it with particle_cloud_free. */
static inline void particle_cloud_make(struct particle_cloud *c, const struct cloud_plan *plan)
{
    static const real section[DIM_MAX + 1] = {0, 4e-6, 2e-3, 1};
    memset(c, 0, sizeof *c);
    int dim = space_dim(plan->space);
    int64_t count[DIM_MAX], n = 1;
    for (int d = 0; d < DIM_MAX; d++) n *= count[d] = d < dim && plan->count[d] ? plan->count[d] : 1;
    cloud_materials(c, plan->space);
    c->source.family = (struct family){.volume = plan->volume,
                                       .calibration = plan->calibration,
                                       .surface = plan->surface,
                                       .shells = plan->shells,
                                       .influence = plan->influence};
    family_make_on_lattice(&c->source.family, plan->space, CLOUD_SPACING, plan->horizon, section[dim]);

    struct particles *p = &c->p;
    uint64_t seed = plan->seed;
    particles_make(p, dim, n, plan->optional);
    for (int64_t i = 0; i < n; i++) {
        int64_t at[DIM_MAX] = {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
        for (int d = 0; d < dim; d++) {
            real shaken = plan->shake > 0 ? cloud_between(&seed, -plan->shake, plan->shake) : 0;
            p->x[d][i] = p->X[d][i] = ((real)at[d] + 0.5 + shaken) * CLOUD_SPACING;
        }
        real bigger = plan->shake > 0 ? cloud_between(&seed, 1 - plan->shake, 1 + plan->shake) : 1;
        p->volume[i] = p->volume0[i] = bigger * c->source.family.cell_volume;
        p->mass[i] = p->volume0[i] * c->material[0].density;
        p->kind[i] = KIND_PD;
        p->id[i] = (int32_t)i;
        for (int d = 0; d < dim && plan->optional & WITH_STRETCH; d++) p->stretch[d][i] = 1;
        if (dim == 3 && plan->optional & WITH_ROTATIONS) p->end_rotation[ROTATION - 1][i] = 1;
    }
    particles_rebuild_lists_by_kind(p);
}

/* Rounds the positions of a regular lattice to multiples of half a spacing that are exact doubles, as src/scene/fill.c
 * does for bodies of scenes, so that bonds of equal length have exactly equal lengths. */
static inline void cloud_exact(struct particle_cloud *c)
{
    const real half = nearbyint(0.5 * CLOUD_SPACING * 0x1p50) * 0x1p-50;
    for (int d = 0; d < c->p.dim; d++)
        for (int64_t i = 0; i < c->p.n; i++) c->p.x[d][i] = c->p.X[d][i] = half * nearbyint(c->p.X[d][i] / half);
}

/* Stores all bonds of b explicitly: replaces the shared stencils, which give the bonds of regular blocks of eight rows
 * (the bonds of eight particles), by lists of neighbours. */
static inline void cloud_unfold(struct bonds *b)
{
    for (int64_t g = 0; g < b->row_blocks; g++)
        if (b->implicit[g]) bond_row_block_copy_bonds_from_stencil(b, g);
}

/* Creates the cells of the body c and fills c->source, the argument from which bonds_make makes bonds: materials,
 * limits of bonds, and the surface correction of the plan. Call this function once, after kinds, bodies and materials
 * of the particles are set. cloud_bonds calls it itself. */
static inline void cloud_source(struct particle_cloud *c)
{
    struct bond_source *s = &c->source;
    particles_rebuild_lists_by_kind(&c->p);
    cells_make_for_neighbour_search(&c->cells, &c->p, s->family.cutoff);
    s->cells = &c->cells;
    s->material = c->material;
    s->materials = CLOUD_MATERIALS;
    s->limit =
        (struct bond_limit){.critical_stretch = c->limit, .materials = CLOUD_MATERIALS, .last_force = LAST_FORCE_HALF};
    s->yield = (struct bond_yield){c->yield, c->hardening, CLOUD_MATERIALS};
    if (s->family.surface == SURFACE_MOMENTS &&
        surface_correction_fit_bond_weight_factors(&c->surface, &c->p, s, s->rotates) == OK)
        s->surface = &c->surface;
    if (s->family.surface != SURFACE_VOLUME) return;
    c->neighbour_volume = NEW("cloud.volume", c->p.n_all, real);
    bonds_compute_family_volumes(c->neighbour_volume, &c->p, s);
    s->neighbour_volume = c->neighbour_volume;
}

/* Creates the cells and bonds of body c (c->bonds). Call it once, after kinds, bodies and materials of the particles
 * are set. */
static inline void cloud_bonds(struct particle_cloud *c)
{
    cloud_source(c);
    bonds_make(&c->bonds, NULL, &c->p, &c->source);
}

/* Strains the body uniformly: sets the positions x = X + strain X, with the displacement gradient `strain`, which need
 * not be symmetric. */
static inline void cloud_strain(struct particle_cloud *c, const real strain[DIM_MAX][DIM_MAX])
{
    struct particles *p = &c->p;
    for (int64_t i = 0; i < p->n; i++)
        for (int a = 0; a < p->dim; a++) {
            p->x[a][i] = p->X[a][i];
            for (int b = 0; b < p->dim; b++) p->x[a][i] += strain[a][b] * p->X[b][i];
        }
}

/* Frees all arrays of the body c and sets it to zero. */
static inline void particle_cloud_free(struct particle_cloud *c)
{
    if (c->bonds.column) bonds_free(&c->bonds);
    if (c->cells.start) cells_free(&c->cells);
    memory_free(c->neighbour_volume);
    surface_correction_free(&c->surface);
    particles_free(&c->p);
    memset(c, 0, sizeof *c);
}

/* Creates the particles *to as a copy of *from with arrays of its own. optional: sum of the WITH_* whose arrays are
 * copied; *from must have them. Release with particles_free. */
static inline void cloud_copy(struct particles *to, const struct particles *from, int optional)
{
    particles_make(to, from->dim, from->n, optional);
    for (int f = 0; f < particle_fields_count; f++) {
        const struct particle_field *field = &particle_fields[f];
        for (int k = 0; k < field->count(from->dim, optional); k++)
            memcpy(particle_field_array(to, field, k), particle_field_array(from, field, k),
                   (size_t)from->n * field->size);
    }
    particles_rebuild_lists_by_kind(to);
}

/* Returns the largest difference of corresponding elements of a[n] and b[n], divided by the largest magnitude in b; 0
 * if a and b are equal, NAN if a difference is NAN. */
static inline real cloud_difference(const real *a, const real *b, int64_t n)
{
    real difference = 0, largest = 0;
    for (int64_t i = 0; i < n; i++) {
        if (!(fabs(a[i] - b[i]) <= difference)) difference = fabs(a[i] - b[i]);
        largest = real_max(largest, fabs(b[i]));
    }
    return difference == 0 ? 0 : difference / largest;
}

#endif
