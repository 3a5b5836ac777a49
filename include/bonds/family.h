/* Families: which neighbours a particle has, what their bonds weigh, when they break and yield. */
#ifndef CLEAVE_FAMILY
#define CLEAVE_FAMILY

#include "data/cells.h"
#include "data/material.h"
#include "data/region.h"
#include "data/voids.h"

enum volume_rule { VOLUME_WHOLE, VOLUME_RAMP, VOLUME_CUT_RAMP };
enum calibration { CALIBRATION_LATTICE, CALIBRATION_CONTINUUM, CALIBRATION_VMPD };
enum surface_rule { SURFACE_NONE, SURFACE_VOLUME, SURFACE_MOMENTS };
enum shell_rule { SHELLS_UNIFORM, SHELLS_ISOTROPIC };
/* Influence function omega(r): 1, exp(-r^2/delta^2), delta/r, (delta/r)^2, 1 - r/(delta + spacing). */
enum influence { INFLUENCE_ONE, INFLUENCE_GAUSSIAN, INFLUENCE_INVERSE, INFLUENCE_INVERSE_SQUARE, INFLUENCE_LINEAR };

/* How a family is made and weighed. */
struct family {
    enum space space;
    enum volume_rule volume;
    enum calibration calibration;
    enum surface_rule surface;
    enum shell_rule shells;
    enum influence influence;
    real spacing;         /* [m] */
    real horizon;         /* delta [m] */
    real cutoff;          /* farthest neighbour, with its relative tolerance [m] */
    real section;         /* A (1D) [m^2], thickness (2D) [m], 1 (3D) */
    real cell_volume;     /* of a lattice particle: spacing^dim section [m^3] */
    real full;            /* sum V_j beta of a full family [m^3] */
    real weighted;        /* sum omega beta r^2 of a full family, weights as stored [m^2] */
    real shell_weight[2]; /* along the axes; along the diagonals (shells: isotropic) */
};

/* How long the force of a breaking bond acts: until the moment at which the bond passes its limit, found within the
 * step; or with half, all or nothing of itself in the first step that sees it beyond. */
enum last_force { LAST_FORCE_MOMENT, LAST_FORCE_HALF, LAST_FORCE_WHOLE, LAST_FORCE_NONE };

/* When bonds break: critical stretch by pair of materials, [materials^2]; INFINITY: never. */
struct bond_limit {
    const real *critical_stretch;
    int materials;
    enum last_force last_force;
    real dt; /* between the positions of two steps [s] */
};

/* No bond breaks: one row of stretches for all pairs of materials. */
extern const struct bond_limit bond_limit_never;

/* When bonds yield, by pair of materials: stretch s_y and hardening modulus over the bond's own, H_b/k_e [materials^2].
 * stretch NULL: no bond ever does. */
struct bond_yield {
    const real *stretch, *hardening;
    int materials;
};

/* State-based materials: A and B of kernels/pd/state_laws.h [Pa]. */
struct state_modulus {
    real A, B;
};
static inline struct state_modulus state_modulus_of(const struct material *m, enum space space, bool rotates)
{
    const real D = space_dim(space);
    return (struct state_modulus){D * D * (rotates ? m->c12 : m->c12 - m->shear), (rotates ? 2 : D + 2) * D * m->shear};
}

/* Everything that bonds_make needs besides particles. */
struct bond_source {
    struct family family;
    const struct cells *cells; /* reference search, edge >= cutoff */
    const struct material *material;
    int materials;
    struct bond_limit limit;
    struct bond_yield yield;
    const struct state_modulus *modulus; /* of state-based models, else NULL */
    real core;                           /* stiffness of cores (kernels/pd/bond_core.h), in those of bonds */
    bool local, rotates;                 /* normalisation by what a family has; model with rotations */
    const int *mirror_axis;              /* [loads] axis of a plane of symmetry, -1: clamped */
    const struct crack *given;           /* pre-cracks of the scene ... */
    int givens;
    const struct crack *crack; /* ... and what of them lies in the body, with its images beyond mirrors */
    int cracks;
    const int *crack_of;               /* [cracks] number of the given one */
    const struct voids *voids;         /* of bodies, which part bonds as pre-cracks do; NULL: there are none */
    const struct mirror_plane *mirror; /* planes of symmetry, clamped ones left out */
    int mirrors;
    const struct image *image;             /* of loads */
    int room;                              /* most neighbours of a particle (bonds_room); 0: counted when needed */
    const real *neighbour_volume;          /* [n_all] V_i^H = sum V_j beta, for the volume method; NULL without */
    const struct surface_weights *surface; /* of bonds near faces (bonds/surface.h); NULL without */
};

/* Horizon and cutoff, shell weights, and the sum over a full family on the lattice. The rules (volume, calibration,
 * surface, shells) must be set before. */
void family_make(struct family *f, enum space space, real spacing, real horizon_in_spacings, real section);
/* c of a material in this family [N/m^6]. */
real family_micro_modulus(const struct family *f, const struct material *m);
/* Elastic constants of a full family on the lattice under uniform strain [Pa]: C_abcd = 1/(2V) sum c V V w r e_a e_b
 * e_c e_d, cubic, with the shear modulus equal to C12; shell weights and partial volumes as they are. */
void family_constants(const struct family *f, const struct material *m, real *c11, real *c12);
/* Work that separates a lattice of the model with rotations normal to a plane, over the square of the stretch at
 * which its bonds break [N/m] (separation.c). */
real family_separation(const struct family *f, const struct state_modulus *m, bool local);
/* Energy of the bonds that cross a plane of the lattice along its axes, each at the critical stretch, per area
 * [J/m^2]; bond-based models. */
real family_crossing_energy(const struct family *f, const struct material *m);
/* Most scenes: all bonds weigh shell_weight[0], nothing to work out. */
static inline bool family_plain(const struct family *f)
{
    return f->volume == VOLUME_WHOLE && f->influence == INFLUENCE_ONE && f->shell_weight[0] == f->shell_weight[1];
}
/* beta x omega x shell weight of a reference bond of components xi and length r [1]. */
real family_weight(const struct family *f, const real *xi, real r);

#endif
