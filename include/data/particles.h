/* Room `data`: what a body is made of: particles, cells, grids, materials, regions, the active set. Structures and what
 * keeps them whole, no physics. It knows `base`; every other room may call it.
 *
 * Particles of both kinds as a structure of arrays, and the one table that describes every array.
 *
 * Layout: entries 0 .. n-1 are the body, sorted row by row (x fastest) so that lattice neighbours are
 * neighbours in memory; entries n .. n_all-1 are mirror images of some of them (struct image), read by bonds,
 * never integrated. Arrays have room for LANES more entries, so that whole vectors can be loaded anywhere. */
#ifndef CLEAVE_PARTICLES
#define CLEAVE_PARTICLES

#include <math.h>

#include "base/archive.h"
#include "base/base.h"
#include "material.h"

#define LATTICE_NEAR 1e-8 /* a particle of a lattice may be that far from its site [spacings] */
enum { LANES = 8 };       /* particles per vector: 8 doubles                      */
enum { ROTATION = 4 };    /* numbers that hold a rotation in space                */

enum kind { KIND_MPM, KIND_PD, KINDS };

enum particle_flag {
    FLAG_LOST_BOND = 1,     /* lost a bond in this step                             */
    FLAG_STRESSED = 2,      /* largest principal stress passed the trigger          */
    FLAG_DRIVEN = 4,        /* a velocity or fixed condition holds a component      */
    FLAG_CRACKED = 8,       /* lost a bond to a particle, neither of them driven    */
    FLAG_GRID_COUPLED = 16, /* peridynamic, but moved by the grid (grid_coupled.h)         */
    FLAG_MESHED = 32,       /* material point of the mesh (mesh.h)                  */
    FLAG_LISTED = 64,       /* stands on the list that conversion.c is making          */
    FLAG_NEAR = 128         /* material point near another body (approach.h)           */
};

struct particles {
    int64_t n, n_all;                 /* body; body and images */
    int64_t n_body;                   /* of the body with those that are not made (hollow.h) */
    real low[DIM_MAX], high[DIM_MAX]; /* of their reference positions, where some are not made [m] */
    int dim;
    const struct material *plane_strain; /* the materials of a body in plane strain, borrowed; in other spaces NULL */
    int64_t n_of[KINDS];                 /* of the body */
    int64_t n_grid_coupled;              /* peridynamic particles that the grid moves */
    int32_t *list[KINDS];                /* their indices, ascending; rebuilt by particles_list */
    int64_t n_free;                      /* material points on the grid, not of the mesh */
    int32_t *list_free;                  /* theirs */
    /* every array below has n_all (+ LANES) entries */
    real *X[DIM_MAX];       /* reference position [m] */
    real *x[DIM_MAX];       /* position [m] */
    real *v[DIM_MAX];       /* velocity, half a step behind x [m/s] */
    real *f[DIM_MAX];       /* bond and applied force [N] */
    real *mass;             /* [kg] */
    real *volume0, *volume; /* reference and current volume [m^3] */
    /* Cauchy stress [Pa]. Of points on the grid: written by g2p in every step. Of points of a mesh: by
     * frame_sync, of peridynamic particles: by run_stress, both for frames (run_sync) and for samples
     * and reversion that read it, and stale in between. */
    real *stress[SYM_MAX];
    real *gradient[DIM_MAX * DIM_MAX]; /* velocity gradient dv_a/dx_b at [a dim + b], only APIC [1/s] */
    real *stretch[DIM_MAX];            /* axial stretch, only cpGIMP [1] */
    real *plastic_strain;              /* accumulated, equivalent; only where a material yields [1] */
    real *out_of_plane;                /* sigma_zz - nu (sigma_xx + sigma_yy), only with WITH_OUT_OF_PLANE [Pa] */
    /* of points of a mesh: what flow has taken off the stress C : strain, in the axes of their cell; only with
     * WITH_PLASTIC_CORRECTION [Pa] */
    real *plastic_correction[SYM_MAX];
    /* material points at the end of state-based bonds: what their cells add to the mean strain S of their family,
     * and ... [1] */
    real *end_strain;
    /* ... their rotation R: in the plane cos - 1 and sin, in space its quaternion, the scalar last; only models with
     * rotations [1] */
    real *end_rotation[ROTATION];
    /* the reaction of bonds on them: derivative of their family's energy by end_strain, and ... [J] */
    real *end_pull;
    real *end_moment[DIM_MAX]; /* ... moment of their bonds about them, in axes that turn with them [N m] */
    real *low_since; /* peridynamic: since when its stress is low, infinite: it is not; only with WITH_REVERSION [s] */
    real *strength;  /* factor on the critical stretch; only with WITH_STRENGTH [1] */
    real *damage;    /* share of broken bonds, 0..1 [1] */
    uint8_t *kind, *material, *body, *flag; /* enum kind; indices; enum particle_flag */
    uint8_t *reversions;                    /* times it became a material point again; only with WITH_REVERSION [1] */
    int32_t *id;                            /* order in which the scene made them */
};

/* Mirror images: entry n + k of the particles is the image of `source` (which may itself be an image) in the
 * mirror of load `load`. */
struct image {
    int32_t source;
    uint8_t load;
};

/* Eight consecutive bytes as one number; eight equal ones. */
static inline uint64_t eight_bytes(const uint8_t *from)
{
    uint64_t eight;
    memcpy(&eight, from, sizeof eight);
    return eight;
}
#define EIGHT_TIMES(byte) ((uint64_t)(byte)*0x0101010101010101)
static inline bool eight_same(const uint8_t *from) { return eight_bytes(from) == EIGHT_TIMES(from[0]); }

/* The next of n marks that is set, from `first` on; n: there is none. Most are not, and eight are skipped at a time:
 * behind the last mark there are LANES more, not set. */
static inline int64_t next_marked(const uint8_t *mark, int64_t first, int64_t n)
{
    while (first < n && !mark[first])
        if (eight_bytes(mark + first))
            first++;
        else
            first += LANES;
    return first < n ? first : n;
}

/* Marks of one bit a particle. */
static inline void bit_set(uint64_t *marks, int64_t i) { marks[i / 64] |= (uint64_t)1 << i % 64; }
static inline void bit_clear(uint64_t *marks, int64_t i) { marks[i / 64] &= ~((uint64_t)1 << i % 64); }
static inline bool bit_is_set(const uint64_t *marks, int64_t i) { return marks[i / 64] >> i % 64 & 1; }

/* How many of the eight from `first` on are below n. */
static inline int eight_at(int64_t first, int64_t n) { return n - first < LANES ? (int)(n - first) : LANES; }

/* The particle of the body that an image, or an image of an image, comes from. */
static inline int64_t image_root(const struct particles *p, const struct image *image, int64_t i)
{
    while (i >= p->n) i = image[i - p->n].source;
    return i;
}

/* Which optional arrays exist. */
enum {
    WITH_GRADIENT = 1,
    WITH_STRETCH = 2,
    WITH_PLASTIC = 4,
    WITH_OUT_OF_PLANE = 8,
    WITH_REVERSION = 16,
    WITH_ENDS = 32,
    WITH_ROTATIONS = 64,
    WITH_STRENGTH = 128,
    WITH_PLASTIC_CORRECTION = 256,
    WITH_EVERYTHING = 511
};

/* One line per array: name, unit, what it is, where it lives. `size` is the bytes of one entry; `count` the
 * number of component arrays for a dimension. The table makes, frees, sorts, checkpoints and restores. */
struct particle_field {
    const char *name, *unit, *meaning;
    size_t offset, size; /* of the (first) array pointer in struct particles; entry */
    int (*count)(int dim, int optional);
    bool in_trials; /* part of ARCHIVE_TRIAL: plastic state */
};
extern const struct particle_field particle_fields[];
extern const int particle_fields_count;

/* Component array k of a field. */
void *particle_array(const struct particles *p, const struct particle_field *f, int k);

/* Saves or restores the fields of all particles, images included; in a trial, their plastic state. */
status particles_archive(struct particles *p, int optional, struct archive *a);

/* Reference position of particle i [m]. */
static inline void particle_place(const struct particles *p, int64_t i, real *X)
{
    for (int d = 0; d < p->dim; d++) X[d] = p->X[d][i];
}

/* Factor on the limit of a bond between i and j: that of its weaker end. Weibull's distribution is closed under the
 * minimum (weakest link): bonds, and chains of them, have its modulus, too. */
static inline real bond_strength(const struct particles *p, int64_t i, int64_t j)
{
    return p->strength ? (p->strength[i] < p->strength[j] ? p->strength[i] : p->strength[j]) : 1;
}

/* Is particle i moved by the grid? */
static inline bool particle_on_grid(const struct particles *p, int64_t i)
{
    return p->kind[i] == KIND_MPM || (p->flag[i] & FLAG_GRID_COUPLED);
}

/* Stress across the plane, sigma_zz = nu (sigma_xx + sigma_yy) and what flow adds; 0 unless in plane strain [Pa].
 * Bonds have nu = 1/4, as their material is made to have; plastic sigma_zz from before conversion is kept, and their
 * own yielding adds nothing. Exact for small strain and in the current frame, in the reference frame to a share of
 * the size of the strain. */
static inline real particle_stress_across(const struct particles *p, int64_t i)
{
    if (!p->plane_strain) return 0;
    const real flow = p->out_of_plane ? p->out_of_plane[i] : 0;
    return p->plane_strain[p->material[i]].poisson * (p->stress[0][i] + p->stress[1][i]) + flow;
}

/* Makes n zeroed particles with room for `images` more; optional is a sum of WITH_*. */
void particles_make(struct particles *p, int dim, int64_t n, int optional);
/* Grows every array by `images` entries behind the body; pointers change. Called once, at set-up. */
void particles_add_images(struct particles *p, int64_t images, int optional);
void particles_free(struct particles *p);

/* Takes all fields of the particles of `old` whose numbers here are `now`, -1: none. */
void particles_take(struct particles *p, const struct particles *old, const int32_t *now, int optional);

/* Sorts the body row by row: z, then y, then x, in rows of thickness `spacing`; ties by id. At set-up. */
void particles_sort(struct particles *p, real spacing, int optional);

/* Least and largest reference position along d of the first n particles [m]; INFINITY, -INFINITY of none. Of the body:
 * those that are not made count. */
void particles_extent(const struct particles *p, int64_t n, int d, real *low, real *high);
/* The particle of the body whose reference position is nearest to X; the first of equals. */
int64_t particles_nearest(const struct particles *p, const real *X);
/* Longest edge of the box round the body's particles [m]. */
real particles_longest(const struct particles *p);

/* Volume of a particle of a lattice [m^3]; section: A (1D) [m^2], thickness (2D) [m], 1 (3D). One function, so that
 * a quotient of two such volumes is 1 to the last bit. */
static inline real lattice_volume(real section, real spacing, int dim)
{
    real volume = section;
    for (int d = 0; d < dim; d++) volume *= spacing;
    return volume;
}

/* Is X a whole number of spacings from `origin`, but for round-off? Then that number is in *site. */
static inline bool lattice_site(real X, real origin, real spacing, real *site)
{
    const real k = (X - origin) / spacing;
    *site = nearbyint(k);
    return fabs(k - *site) <= LATTICE_NEAR;
}

/* Rebuilds n_of and list from kind, n_free and list_free from flag. */
void particles_list(struct particles *p);

/* True if a criterion marked a particle for conversion in this step. */
bool convert_due(const struct particles *p);

#endif
