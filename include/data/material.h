/* Properties of one material: constants that the input file gives, and those derived from them: wave speeds, elastic
 * constants for the dimension and plane state, constants of bond-based peridynamics. */
#ifndef CLEAVE_MATERIAL
#define CLEAVE_MATERIAL

#include <math.h>

#include "base/base.h"
#include "law.h"
#include "scatter.h"
#include "strength_surface.h"

/* Dimension of a scene, and the plane state in 2D. */
enum space { SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID };

/* Returns the dimension of the space s: 1 for a line, 2 for plane stress and plane strain, 3 for a solid. */
static inline int space_dim(enum space s) { return s == SPACE_LINE ? 1 : s == SPACE_SOLID ? 3 : 2; }

/* Shape of the curve by which the force of a softening bond decreases with its stretch after the maximum
 * (softening.h). */
enum softening { SOFTENING_LINEAR, SOFTENING_BILINEAR, SOFTENING_EXPONENTIAL };

/* Dependence of the tensile strength of softening bonds on the strain rate (softening.h): factor[k] on the strength at
 * rate[k], k = 0 .. points - 1, linear in the logarithm of the rate between these rates, constant beyond. */
enum { RATE_POINTS = 16 };
struct strength_rate {
    int points;                                  /* number of rates; 0: the strength does not depend on the rate */
    real rate[RATE_POINTS], factor[RATE_POINTS]; /* [1/s] ascending; at least 1, not falling [1] */
    real onset[RATE_POINTS]; /* factor on the stretch at which bonds begin to soften; the strength is then as above [1]
                              */
};

/* A material: constants that the input file gives, and constants that material_compute_derived_constants derives from
 * them. */
struct material {
    char name[NAME_MAX_LENGTH];
    /* values given by the scene */
    real young, poisson, density; /* [Pa] [1] [kg/m^3] */
    real energy_release_rate;     /* G_c [J/m^2]; NAN: not given */
    real critical_stretch;        /* s_c [1], computed from G_c if not given; INFINITY: never breaks */
    real tensile_strength;        /* sigma_t of a material whose bonds soften [Pa]; NAN: its bonds are brittle */
    enum softening softening;     /* form of the softening curve of bonds that soften */
    bool softening_given;         /* the scene gives `softening` */
    /* strengths of a strength surface, beside tensile_strength [Pa], and a radius [m]; NAN: not given */
    real compressive_strength, hydrostatic_strength, biaxial_strength, strength_radius;
    struct strength_rate rate; /* increase of the tensile strength with the strain rate */
    real onset_stretch;        /* s_0 at which bonds begin to soften; critical_stretch if they are brittle [1] */
    real yield_stress;         /* sigma_y [Pa]; INFINITY or 0: elastic */
    real yield_tangent;        /* E_t: slope of the uniaxial stress-strain curve beyond sigma_y, below E [Pa] */
    struct {
        real linear, quadratic;
    } viscosity;                     /* coefficients of bulk viscosity in rapid compression (step/viscosity.h) [1] */
    struct strength_scatter scatter; /* random field of the critical stretch */
    struct law law;                  /* law by which material points yield */
    struct strength_surface surface; /* stresses at which bonds begin to soften; none without one of the strengths */
    real surface_least_strain;       /* smallest strain at which `surface` is reached [1] */
    int surface_means; /* `surface`: how many times the strain is averaged over the neighbours of each particle */
    /* values derived by material_compute_derived_constants */
    real yield_hardening;             /* H = E E_t/(E - E_t): increase of yield stress per plastic strain [Pa] */
    real c11, c12, shear;             /* elastic constants of the space [Pa]; c12 = 0 in 1D */
    real wave_speed;                  /* speed of longitudinal waves in the space, sqrt(c11/rho) [m/s] */
    real shear_speed, rayleigh_speed; /* speed of shear waves and of Rayleigh waves [m/s]; 0 in 1D */
    real bulk;                        /* bulk modulus: E in 1D, in-plane (c11 + c12)/2 in 2D, K in 3D [Pa] */
};

/* Returns true if the bonds of material m soften, i.e. lose their force gradually (softening.h), because a tensile
 * strength is given; false if they are brittle. */
static inline bool material_has_softening_bonds(const struct material *m) { return m->tensile_strength > 0; }

/* Returns true if the bonds of material m begin to soften where the stress reaches a strength surface
 * (strength_surface.h), not at a given stretch. */
static inline bool material_has_strength_surface(const struct material *m) { return m->surface.g0 > 0; }

/* Returns true if the material m yields: it has a positive, finite yield stress or a flow law (yield stress as a
 * function of plastic strain). */
static inline bool material_yields(const struct material *m)
{
    return (m->yield_stress > 0 && isfinite(m->yield_stress)) || m->law.given;
}

/* Returns true if all material points of a grid cell shall use the mean of their dilatations: if material m yields or
 * is nearly incompressible (Poisson's ratio above 0.4), since linear cells would be too stiff otherwise
 * (kernels/mpm/dilatation.h). False if `space` is plane stress or line, in which the volume is not constrained. */
static inline bool material_uses_mean_dilatation(const struct material *m, enum space space)
{
    return (space == SPACE_PLANE_STRAIN || space == SPACE_SOLID) && (material_yields(m) || m->poisson > 0.4);
}

/* Returns true if the materials a and b have equal bulk moduli and equal shear moduli, to the last bit. */
static inline bool materials_have_equal_stiffness(const struct material *a, const struct material *b)
{
    return reals_are_bitwise_equal(a->bulk, b->bulk) && reals_are_bitwise_equal(a->shear, b->shear);
}

/* Returns the stress [Pa] at which material m begins to yield. Only for materials that yield (material_yields). */
static inline real material_initial_yield_stress(const struct material *m)
{
    return m->law.given ? m->law.yield : m->yield_stress;
}

/* Returns true if the material m has bulk viscosity, a pressure against rapid compression (step/viscosity.h). */
static inline bool material_has_viscosity(const struct material *m)
{
    return m->viscosity.linear > 0 || m->viscosity.quadratic > 0;
}

/* Returns the only value of Poisson's ratio that bond-based peridynamics can represent in the space `space`: 1/3 in
 * plane stress, 1/4 in plane strain and in 3D, NAN in 1D, where there is none. */
real bond_based_poisson_ratio(enum space space);

/* Returns the micro-modulus c [N/m^6] of bond-based peridynamics in the space `space` for a neighbourhood of discrete
 * particles: 2 k/family_sum in 1D, 8 k/family_sum in 2D, 18 k/family_sum in 3D, with k = m->bulk. Bonds then have the
 * energy of the continuum under uniform dilatation (Silling & Askari 2005). family_sum: sum of r V_j beta over a full
 * neighbourhood [m^4], where beta is the fraction of the volume of neighbour j within the horizon. */
real material_micro_modulus_of_discrete_family(const struct material *m, enum space space, real family_sum);

/* Returns the micro-modulus c [N/m^6] of bond-based peridynamics in the space `space` for a continuous family: 2 k/(A
 * d^2) in 1D, 12 k/(pi h d^3) in 2D, 18 k/(pi d^4) in 3D, with k = m->bulk (Silling & Askari 2005). horizon: d [m];
 * cross_section: cross-section A in 1D [m^2], thickness h in 2D [m], ignored in 3D. */
real material_micro_modulus_of_continuum(const struct material *m, enum space space, real horizon, real cross_section);

/* Returns the critical stretch [1] of the bonds of material m: if all bonds that cross a plane have this stretch, their
 * energy per area of the plane is the energy release rate G_c. horizon: radius of neighbourhoods [m]; model:
 * STRETCH_BOND bond-based with the continuum micro-modulus (Silling & Askari 2005), STRETCH_OSPD ordinary state-based
 * (Madenci & Oterkus 2014). For the model with particle rotations use family_fracture_energy_over_stretch_squared. */
enum stretch_of { STRETCH_BOND, STRETCH_OSPD };
real material_critical_stretch(const struct material *m, enum space space, real horizon, enum stretch_of model);

/* Returns the stress [Pa] of material m in monotonic uniaxial loading at the total strain `strain` [1]: Young's modulus
 * times strain up to the yield stress, beyond it a line of the slope m->yield_tangent. Only for materials whose law
 * m->law is not given. */
real material_uniaxial_stress(const struct material *m, real strain);

/* Computes the members of m that follow from the members given by the input file, for the space `space` (line, plane
 * stress, plane strain or solid): hardening modulus, elastic constants and wave speeds. */
void material_compute_derived_constants(struct material *m, enum space space);

/* Strengths [Pa] that follow from the strength surface of a material: in uniaxial tension, equal biaxial tension,
 * shear, hydrostatic tension and uniaxial compression, INFINITY if no stress of that kind reaches the surface. In plane
 * strain uniaxial and biaxial states include the stress normal to the plane. */
struct surface_strengths {
    real tension, biaxial, shear, hydrostatic, compression;
};

/* Returns the strengths [Pa] that follow from the strength surface of material m: the stresses at which the surface is
 * reached under uniaxial, biaxial, shear and hydrostatic loading. m must have a strength surface. space: plane stress,
 * plane strain or solid. */
struct surface_strengths material_strengths_from_strength_surface(const struct material *m, enum space space);

/* Returns the smallest strain [1] at which the strength surface of material m can be reached: the minimum, over all
 * stress states on the surface, of the largest principal strain, which is the stretch of the most stretched bond. Bonds
 * with smaller stretches need no check of the surface. space: plane stress, plane strain or solid. Returns 0 if some
 * stress state on the surface stretches no bond. */
real material_smallest_strain_on_strength_surface(const struct material *m, enum space space);

/* Sets the strength surface of Drucker and Prager at which the bonds of material m begin to soften: m->surface to
 * `surface`, and m->surface_least_strain to the smallest strain [1] at which it can be reached. space: space of the
 * body, on which the stress normal to the plane depends. The elastic constants of m must be set. */
void material_set_strength_surface(struct material *m, enum space space, struct strength_surface surface);

/* Returns the ratio U of the stress `stress` to the stress on the strength surface of material m that has the same
 * direction: 1 on the surface, below 1 inside, 0 without stress. stress: components xx yy xy in 2D, xx yy zz xy yz zx
 * in 3D [Pa]; space: determines the stress normal to a plane. m must have a strength surface. */
real material_stress_to_strength_ratio(const struct material *m, enum space space, const real *stress);

/* Computes into `matrix` the elastic stiffness [Pa] of material m, row-major n x n, for the n =
 * symmetric_tensor_component_count(dim) components of stress and strain. Strains are tensor components, so that shear
 * rows contain 2G. */
void material_stiffness_matrix(const struct material *m, int dim, real *matrix);

/* Computes into `matrix` the inverse of the elastic stiffness of material m [1/Pa], row-major n x n, for the n =
 * symmetric_tensor_component_count(dim) components of stress and strain. Strains are tensor components, so that shear
 * rows contain 1/(2G). */
void material_compliance_matrix(const struct material *m, int dim, real *matrix);

#endif
