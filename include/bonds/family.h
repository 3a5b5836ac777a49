/* Neighbourhoods (families) of particles: their neighbours, the weights of their bonds, and the stretches at which
 * bonds break and yield. */
#ifndef CLEAVE_FAMILY
#define CLEAVE_FAMILY

#include "data/cells.h"
#include "data/material.h"
#include "data/region.h"
#include "data/softening.h"
#include "data/voids.h"

/* Rule for beta, the fraction of the volume of a neighbour near the horizon that counts (key pd.volume; Seleson 2014).
 * VOLUME_WHOLE: 1; VOLUME_RAMP: falls linearly from 1 to 0 over one spacing around the horizon; VOLUME_CUT_RAMP: as
 * VOLUME_RAMP, but without the neighbours beyond the horizon. */
enum volume_rule { VOLUME_WHOLE, VOLUME_RAMP, VOLUME_CUT_RAMP };

/* Rule by which the micro-modulus of bonds follows from the elastic constants (key pd.calibration): from the sum over a
 * complete neighbourhood of the lattice, from the integral over a continuum, or the rule vmpd of Zeng et al. 2021. */
enum calibration { CALIBRATION_LATTICE, CALIBRATION_CONTINUUM, CALIBRATION_VMPD };

/* Rule by which the weights of bonds near faces of a body are corrected (key pd.surface): not at all, by the volume of
 * the neighbours of both particles, or by moments of the neighbourhoods (bonds/surface.h). */
enum surface_rule { SURFACE_NONE, SURFACE_VOLUME, SURFACE_MOMENTS };

/* Rule for the dependence of bond weights on the direction of the bond (key pd.weights): none, or such that the elastic
 * constants of the lattice are isotropic. */
enum shell_rule { SHELLS_UNIFORM, SHELLS_ISOTROPIC };

/* Influence function omega(r) of a bond of length r, with the horizon delta; in the order of the names: 1,
 * exp(-r^2/delta^2), delta/r, (delta/r)^2, 1 - r/(delta + spacing). */
enum influence { INFLUENCE_ONE, INFLUENCE_GAUSSIAN, INFLUENCE_INVERSE, INFLUENCE_INVERSE_SQUARE, INFLUENCE_LINEAR };

/* Measure from which the energy of a bond follows. With the weight w and length r of the bond: c w s^2 r of its stretch
 * s (bond-based models), w e^2 of its elongation e (ordinary state-based), w |eta|^2 of the relative displacement eta
 * of its two particles (models with particle rotations). */
enum bond_energy { ENERGY_OF_STRETCH, ENERGY_OF_ELONGATION, ENERGY_OF_DISPLACEMENT };

/* Rules (enumerations above) and sizes that define neighbourhoods and the weights of their bonds. */
struct family {
    enum space space;             /* dimension and plane state */
    enum volume_rule volume;      /* part of the volume of a neighbour that counts: beta */
    enum calibration calibration; /* how the stiffness of bonds follows from the elastic constants */
    enum surface_rule surface;    /* correction near faces */
    enum shell_rule shells;       /* dependence of weights on the direction of the bond */
    enum influence influence;     /* dependence of weights on the length of the bond: omega */
    enum bond_energy energy;      /* measure from which the energy of a bond follows */
    real spacing;                 /* lattice spacing [m] */
    real horizon;                 /* horizon delta, reach of bonds [m] */
    real cutoff;                  /* largest distance of a neighbour, with a relative tolerance [m] */
    real section;                 /* cross-section A (1D) [m^2], thickness (2D) [m], 1 (3D) */
    real cell_volume;             /* volume of a lattice particle: spacing^dim section [m^3] */
    real full;     /* sum of V_j beta over a full neighbourhood (volume factor beta, all lattice neighbours) [m^3] */
    real weighted; /* sum of omega beta r^2 over a full neighbourhood, with the weights that are stored [m^2] */
    real shell_weight[2]; /* isotropic shells: factors on bonds near the axes and near the diagonals [1] */
};

/* Rule for the force of a bond in the time step in which its stretch exceeds the limit, so that it breaks.
 * LAST_FORCE_MOMENT: the force acts until the moment within the step at which the stretch reaches the limit;
 * LAST_FORCE_HALF, LAST_FORCE_WHOLE, LAST_FORCE_NONE: half, all or none of the force acts. */
enum last_force { LAST_FORCE_MOMENT, LAST_FORCE_HALF, LAST_FORCE_WHOLE, LAST_FORCE_NONE };

/* Number of time steps between two examinations of a bond whose stretch exceeds its onset of softening while the stress
 * does not yet allow it to soften; empirical. */
enum { SOFTENING_RETRY_STEPS = 8 };

/* Stretches at which bonds break or begin to soften. materials: number of materials; last_force: rule for the force of
 * a bond in the step in which it breaks; critical_stretch: stretch at which a brittle bond breaks, for each pair of
 * materials: entry m materials + q for the materials m and q; INFINITY for bonds that never break. */
struct bond_limit {
    const real *critical_stretch; /* [1] */
    int materials;
    enum last_force last_force;
    real dt;                                /* time between the positions of two steps [s] */
    const struct softening_pair *softening; /* [materials^2] softening by pair of materials; NULL: bonds are brittle */
    const struct softening_curve *curve;    /* softening law of all bonds that soften */
    bool retries; /* bonds that were not allowed to soften are examined again in this step (kernels/pd/bond_begin.c) */
};

/* Limits with which no bond breaks or begins to soften, whatever its materials. Used for static equilibrium, and where
 * forces are computed without a time step after them. */
extern const struct bond_limit bond_limit_never;

/* Returns the stretch [1] at which the bond between particles i and j of p breaks if it is brittle: the critical
 * stretch of its two materials, from `limit`, times its random strength factor. A bond that softens dissipates the same
 * energy. */
static inline real bond_breaking_stretch(const struct particles *p, const struct bond_limit *limit, int64_t i,
                                         int64_t j)
{
    const int pair = p->material[i] * limit->materials + p->material[j];
    const bool alone = limit->softening && limit->softening[pair].strength_scatters;
    return limit->critical_stretch[pair] * (alone ? 1 : bond_strength_factor(p, i, j));
}

/* Returns the stretches [1] at which the bond between particles i and j of p begins to soften and breaks; both are the
 * critical stretch if the bond is brittle. limit: critical stretches and softening by pair of materials. */
static inline struct softening_range bond_softening_range(const struct particles *p, const struct bond_limit *limit,
                                                          int64_t i, int64_t j)
{
    const real critical = bond_breaking_stretch(p, limit, i, j);
    if (!limit->softening) return (struct softening_range){critical, critical};
    const struct softening_pair *pair = &limit->softening[p->material[i] * limit->materials + p->material[j]];
    const bool fixed = pair->strength_scatters && pair->surface;
    return softening_range_from_onset(limit->curve, pair->onset * (fixed ? 1 : bond_strength_factor(p, i, j)),
                                      critical);
}

/* Returns the stretches [1] at which the bond between particles i and j of p begins to soften and breaks, at the strain
 * rate `strain_rate` [1/s]. limit: critical stretches and softening by pair of materials, with softening
 * (limit->softening not NULL). The rate changes the onset, by the law of the two materials; the stretch at which the
 * bond breaks changes such that the dissipated energy stays the same. */
static inline struct softening_range bond_softening_range_at_strain_rate(const struct particles *p,
                                                                         const struct bond_limit *limit, int64_t i,
                                                                         int64_t j, real strain_rate)
{
    const struct softening_range slow = bond_softening_range(p, limit, i, j);
    const struct strength_rate *r = limit->softening[p->material[i] * limit->materials + p->material[j]].rate;
    if (!r || !(slow.onset < slow.end)) return slow;
    const real critical = bond_breaking_stretch(p, limit, i, j);
    const real most = real_max(slow.onset, critical / sqrt(RATE_LEAST_RATIO));
    return softening_range_from_onset(
        limit->curve,
        real_min(most, slow.onset * strength_rate_table_interpolate_in_log_rate(r, r->onset, strain_rate)), critical);
}

/* Plastic constants of bonds by pair of materials, arrays of materials^2 entries. stretch: yield stretch s_y [1], NULL
 * if no bond yields; hardening: hardening modulus divided by elastic modulus, H_b/k_e [1]. */
struct bond_yield {
    const real *stretch, *hardening;
    int materials;
};

/* Moduli A and B [Pa] of a material in state-based peridynamics; kernels/pd/state_laws.h defines them. */
struct state_modulus {
    real A, B;
};

/* Returns the moduli A and B [Pa] of material m in a state-based model (kernels/pd/state_laws.h). The pressure of a
 * neighbourhood is A times its mean stretch, and the springs of its bonds have the stiffness B, each multiplied by
 * volume over weighted volume. space: line, plane stress, plane strain or solid; with_rotations: true for the modified
 * state-based model, in which particles rotate (PD_MOSPD). */
static inline struct state_modulus state_based_moduli_of_material(const struct material *m, enum space space,
                                                                  bool with_rotations)
{
    const real D = space_dim(space);
    return (struct state_modulus){D * D * (with_rotations ? m->c12 : m->c12 - m->shear),
                                  (with_rotations ? 2 : D + 2) * D * m->shear};
}

/* Inputs of bonds_make besides the particles: rules of neighbourhoods, limits, `materials` materials, cracks, mirror
 * images. All pointers are borrowed. */
struct bond_source {
    struct family family;            /* rules and sizes of neighbourhoods */
    const struct cells *cells;       /* search over reference positions, cell edge >= cutoff */
    const struct material *material; /* [materials] */
    int materials;
    struct bond_limit limit;             /* stretches at which bonds break */
    struct bond_yield yield;             /* stretches at which bonds yield */
    const struct state_modulus *modulus; /* [materials] moduli of state-based models; NULL: bond-based model */
    real core; /* stiffness of the repulsive cores (kernels/pd/bond_core.h) divided by that of the bonds [1] */
    bool local, rotates;       /* state-based: weighted volumes are summed over the present bonds, not over a full
                                  neighbourhood;       model with particle rotations */
    const int *mirror_axis;    /* [loads] axis of a plane of symmetry, -1: clamped plane */
    const struct crack *given; /* [givens] pre-cracks of the scene */
    int givens;
    const struct crack *crack; /* [cracks] parts of the pre-cracks within the body, with their images beyond mirrors */
    int cracks;
    const int *crack_of;               /* [cracks] index in `given` */
    const struct voids *voids;         /* voids of bodies, which cut bonds as pre-cracks do; NULL: none */
    const struct mirror_plane *mirror; /* [mirrors] planes of symmetry, without clamped planes */
    int mirrors;
    const struct image *image; /* [n_all - n] origins of the mirror images of particles */
    int room; /* upper bound of the number of neighbours of a particle (bonds_neighbour_count_upper_bound); 0: computed
                 when needed */
    const real *neighbour_volume; /* [n_all] V_i^H = sum V_j beta, for the volume method; NULL: other methods */
    const struct surface_correction *surface; /* factors of bonds near faces (bonds/surface.h); NULL: none */
};

/* Computes horizon, cutoff, weights by direction and the sums over a complete neighbourhood on the lattice into f. The
 * rules f->volume, calibration, surface, shells and influence must be set. space: line, plane stress, plane strain or
 * solid; spacing: lattice spacing [m]; horizon_in_spacings: delta/spacing [1]; cross_section: cross-section in 1D
 * [m^2], thickness in 2D [m], 1 in 3D. */
void family_make_on_lattice(struct family *f, enum space space, real spacing, real horizon_in_spacings,
                            real cross_section);

/* Returns the micro-modulus c [N/m^6] of bond-based peridynamics for the material m, calibrated by the rule
 * f->calibration for a particle with all neighbours of the neighbourhood f. */
real family_micro_modulus(const struct family *f, const struct material *m);

/* Computes the elastic constants c11 and c12 [Pa] that a lattice of complete neighbourhoods has under uniform strain:
 * C_abcd = c V/2 sum w r e_a e_b e_c e_d over the bonds of a particle. f: neighbourhood and rules of the weights; m:
 * material; c: micro-modulus; V: volume of a particle; r, e: length and direction of a bond; w: its weight, with
 * partial volume and weight by direction (family_bond_weight). The elasticity is cubic, with a shear modulus equal to
 * c12. */
void family_compute_cubic_elastic_constants(const struct family *f, const struct material *m, real *c11, real *c12);

/* Returns the ratio G/s_c^2 [N/m] of state-based peridynamics, by which the critical stretch s_c of bonds follows from
 * the energy release rate G: the work per area that separates the two halves of a lattice along a plane (separation.c).
 * f: neighbourhood of the lattice; modulus: moduli of the material; particles_rotate: true for the modified state-based
 * model, in which particles rotate, false for the ordinary one; intact_bonds_only: true if the weighted volume Q is
 * summed over the unbroken bonds of a neighbourhood, false over all. */
real family_fracture_energy_over_stretch_squared(const struct family *f, const struct state_modulus *modulus,
                                                 bool particles_rotate, bool intact_bonds_only);

/* Returns the energy per area [J/m^2] stored in the bonds that cross a lattice plane normal to an axis if each has the
 * critical stretch of material m: the energy release rate of a crack along the plane. f: neighbourhood of the lattice.
 * Bond-based models only (Silling & Askari 2005). */
real family_energy_release_rate_at_critical_stretch(const struct family *f, const struct material *m);

/* Returns true if all bonds of neighbourhood f have one weight: no partial volumes, influence function 1, and equal
 * weights in all directions. */
static inline bool family_bonds_have_equal_weights(const struct family *f)
{
    return f->volume == VOLUME_WHOLE && f->influence == INFLUENCE_ONE && f->shell_weight[0] == f->shell_weight[1];
}

/* Returns the weight (factor on the stiffness, [1]) of a bond in the reference state: the product of volume fraction
 * beta, influence function omega and weight by direction. f: rules of the weights; bond_vector: reference vector of the
 * bond, dim components [m]; bond_length: its length [m]. */
real family_bond_weight(const struct family *f, const real *bond_vector, real bond_length);

#endif
