/* One material: the values given by the scene and those derived from them: wave speeds, elastic constants of the space,
 * and the constants of bond-based peridynamics. */
#ifndef CLEAVE_MATERIAL
#define CLEAVE_MATERIAL

#include <math.h>

#include "base/base.h"
#include "scatter.h"

enum space { SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID };

/* Returns the dimension of a space. */
static inline int space_dim(enum space s) { return s == SPACE_LINE ? 1 : s == SPACE_SOLID ? 3 : 2; }

/* A material. */
struct material {
    char name[NAME_MAX_LENGTH];
    /* values given by the scene */
    real young, poisson, density; /* [Pa] [1] [kg/m^3] */
    real energy_release_rate;     /* G_c [J/m^2]; NAN: not given */
    real critical_stretch;        /* s_c [1], computed from G_c if not given; INFINITY: never breaks */
    real yield_stress;            /* sigma_y [Pa]; INFINITY or 0: elastic */
    real yield_tangent;           /* E_t: slope of the uniaxial stress-strain curve beyond sigma_y, below E [Pa] */
    struct {
        real linear, quadratic;
    } viscosity;                     /* coefficients of bulk viscosity in rapid compression (step/viscosity.h) [1] */
    struct strength_scatter scatter; /* random field of its critical stretch */
    /* values derived by material_compute_constants */
    real yield_hardening;             /* H = E E_t/(E - E_t): increase of yield stress per plastic strain [Pa] */
    real c11, c12, shear;             /* elastic constants of the space [Pa]; c12 = 0 in 1D */
    real wave_speed;                  /* longitudinal, of the space: sqrt(c11/rho) [m/s] */
    real shear_speed, rayleigh_speed; /* [m/s]; 0 in 1D */
    real bulk;                        /* E in 1D, in-plane k2 = (c11 + c12)/2 in 2D, K in 3D [Pa] */
};

/* Returns true if the material yields. */
static inline bool material_yields(const struct material *m)
{
    return m->yield_stress > 0 && isfinite(m->yield_stress);
}

/* Returns true if the material has bulk viscosity. */
static inline bool material_viscous(const struct material *m)
{
    return m->viscosity.linear > 0 || m->viscosity.quadratic > 0;
}

/* Returns Poisson's ratio as imposed by bond-based peridynamics: 1/3 (plane stress), 1/4 (plane strain, 3D), NAN in
 * 1D. */
real material_bond_poisson(enum space space);

/* Returns the micro-modulus c [N/m^6] from the weighted sum sigma = sum_j r V_j beta [m^4] over a full family:
 * 2E/sigma, 8 k2/sigma, 18 K/sigma (energy of uniform dilatation, Silling & Askari 2005). */
real material_micro_modulus(const struct material *m, enum space space, real sigma);

/* Returns the micro-modulus of the continuum [N/m^6]: 2E/(A d^2), 12 k2/(pi h d^3), 18 K/(pi d^4) (Silling & Askari
 * 2005). horizon: d [m]; section: cross-section A [m^2] in 1D, thickness h [m] in 2D, ignored in 3D. */
real material_micro_modulus_continuum(const struct material *m, enum space space, real horizon, real section);

/* Returns the critical stretch from G_c, the energy of all bonds that cross a unit plane [1]. horizon [m]. model:
 * bond-based with the continuum micro-modulus (Silling & Askari 2005), or ordinary state-based (Madenci & Oterkus
 * 2014). The model with rotations has no continuum limit: family_separation_work. */
enum stretch_of { STRETCH_BOND, STRETCH_OSPD };
real material_critical_stretch(const struct material *m, enum space space, real horizon, enum stretch_of model);

/* Returns the stress at a strain [1] of monotonic uniaxial loading [Pa]. */
real material_stress_at(const struct material *m, real strain);

/* Computes the derived constants. */
void material_compute_constants(struct material *m, enum space space);

/* Computes the elastic stiffness as a matrix over symmetric components, symmetric_count(dim) squared, row major [Pa]
 * (tensor shear strain: shear rows contain 2G). */
void material_stiffness(const struct material *m, int dim, real *matrix);

/* Computes the inverse of material_stiffness [1/Pa]. */
void material_compliance(const struct material *m, int dim, real *matrix);

#endif
