/* One material: what the scene gives and what the methods derive from it: wave speeds, elastic constants of
 * the space, and the constants of bond-based peridynamics. */
#ifndef CLEAVE_MATERIAL
#define CLEAVE_MATERIAL

#include <math.h>

#include "base/base.h"
#include "scatter.h"

enum space { SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID };
static inline int space_dim(enum space s) { return s == SPACE_LINE ? 1 : s == SPACE_SOLID ? 3 : 2; }

struct material {
    char name[NAME_MAX_LENGTH];
    /* given */
    real young, poisson, density; /* [Pa] [1] [kg/m^3] */
    real energy_release_rate;     /* G_c [J/m^2], NAN if not given */
    real critical_stretch;        /* s_c [1]; from G_c if not given; INFINITY: never breaks */
    real yield_stress;            /* sigma_y [Pa]; INFINITY or 0: elastic */
    real yield_tangent;           /* E_t: slope of the uniaxial curve behind sigma_y, below E [Pa] */
    struct {
        real linear, quadratic;
    } viscosity;                     /* of rapid compression (step/viscosity.h) [1] */
    struct strength_scatter scatter; /* of its critical stretch, by place */
    /* derived by material_derive */
    real yield_hardening;             /* H = E E_t/(E - E_t): yield stress over plastic strain [Pa] */
    real c11, c12, shear;             /* elastic constants of the space [Pa]; c12 = 0 in 1D */
    real wave_speed;                  /* longitudinal, of the space: sqrt(c11 / rho) [m/s] */
    real shear_speed, rayleigh_speed; /* [m/s]; 0 in 1D */
    real bulk;                        /* E in 1D, k2 = (c11 + c12)/2 in 2D, K in 3D [Pa] */
};

static inline bool material_yields(const struct material *m)
{
    return m->yield_stress > 0 && isfinite(m->yield_stress);
}

static inline bool material_viscous(const struct material *m)
{
    return m->viscosity.linear > 0 || m->viscosity.quadratic > 0;
}

/* Poisson's ratio that bond-based peridynamics imposes: 1/3, 1/4, 1/4; NAN in 1D. */
real material_bond_poisson(enum space space);

/* Micro-modulus c [N/m^6] from the weighted sum Sigma = sum_j r V_j beta [m^4] over a full family:
 * 2E/Sigma, 8 k2/Sigma, 18 K/Sigma (energy of uniform dilatation, Silling & Askari 2005). */
real material_micro_modulus(const struct material *m, enum space space, real sigma);

/* Continuum value of the same: 2E/(A d^2), 12 k2/(pi h d^3), 18 K/(pi d^4); `section` is the cross-section
 * A [m^2] in 1D, the thickness h [m] in 2D, ignored in 3D. */
real material_micro_modulus_continuum(const struct material *m, enum space space, real horizon, real section);

/* Critical stretch from G_c, the energy of all bonds that cross a unit plane; horizon [m]. Bond-based for the continuum
 * micro-modulus; ordinary state-based (Madenci & Oterkus 2014). That of the model
 * with rotations has no continuum limit: family_separation. */
enum stretch_of { STRETCH_BOND, STRETCH_OSPD };
real material_critical_stretch(const struct material *m, enum space space, real horizon, enum stretch_of model);

/* Stress at a strain of monotonic uniaxial loading [Pa]. */
real material_stress_at(const struct material *m, real strain);

/* Fills the derived constants. */
void material_derive(struct material *m, enum space space);

/* Elastic stiffness as a matrix over symmetric components (tensor shear strain: shear rows hold 2G) and
 * its inverse, both symmetric_count(dim) squared, row major. */
void material_stiffness(const struct material *m, int dim, real *matrix);
void material_compliance(const struct material *m, int dim, real *matrix);

#endif
