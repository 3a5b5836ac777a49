/* Computes derived constants of a material: wave speeds, elastic constants for line, plane or solid, and the constants
 * of bond-based peridynamics. */
#include "data/material.h"

#include <math.h>

static const real pi = 3.14159265358979323846;

real bond_based_poisson_ratio(enum space space)
{
    static const real poisson[] = {
        [SPACE_LINE] = NAN, [SPACE_PLANE_STRESS] = 1.0 / 3, [SPACE_PLANE_STRAIN] = 0.25, [SPACE_SOLID] = 0.25};
    return poisson[space];
}

/* Returns the micro-modulus c of bonds (force per stretch and squared volume) [N/m^6] of material m, such that bonds
 * and continuum have equal energy densities under a uniform expansion by the strain s. For bonds the energy density is
 * 1/4 c s^2 family_sum. For the continuum it is 1/2 E s^2 (1D), 2 k s^2 (2D) or 9/2 k s^2 (3D), with the bulk modulus k
 * of the space. family_sum: sum of length times volume over the bonds of a full neighbourhood [m^4]. */
real material_micro_modulus_of_discrete_family(const struct material *m, enum space space, real family_sum)
{
    static const real factor[DIM_MAX + 1] = {[1] = 2, [2] = 8, [3] = 18};
    INVARIANT(family_sum > 0);
    return factor[space_dim(space)] * m->bulk / family_sum;
}

/* Returns the micro-modulus c of bonds (force per stretch and squared volume) [N/m^6] of material m. It follows from
 * equal energy densities of bonds and continuum under a uniform expansion, where an integral over the horizon replaces
 * the sum over neighbours. horizon: length of the longest bonds [m]; space: line, plane or solid; cross_section:
 * cross-section in 1D [m^2], thickness in 2D [m], not used in 3D. */
real material_micro_modulus_of_continuum(const struct material *m, enum space space, real horizon, real cross_section)
{
    switch (space_dim(space)) {
    case 1:
        return 2 * m->bulk / (cross_section * square(horizon));
    case 2:
        return 12 * m->bulk / (pi * cross_section * horizon * square(horizon));
    default:
        return 18 * m->bulk / (pi * square(square(horizon)));
    }
}

/* Returns the critical stretch s_c of material m in bond-based models [1]: at s_c the energy of all bonds across a unit
 * area equals the energy release rate G_c (Silling & Askari 2005). space: space of the scene; horizon: length of the
 * longest bonds [m]. The thickness of a plate cancels. */
static real critical_bond(const struct material *m, enum space space, real horizon)
{
    real ratio = m->energy_release_rate / (m->bulk * horizon);
    switch (space_dim(space)) {
    case 1:
        return sqrt(3 * ratio);
    case 2:
        return sqrt(pi / 3 * ratio);
    default:
        return sqrt(5.0 / 9 * ratio);
    }
}

real material_critical_stretch(const struct material *m, enum space space, real horizon, enum stretch_of model)
{
    const real G = m->shear, dim = space_dim(space);
    real stiffness =
        dim == 2 ? 6 * G / pi + 16 * (m->bulk - 2 * G) / (9 * pi * pi) : 3 * G + 81.0 / 256 * (m->bulk - 5 * G / 3);
    if (model == STRETCH_BOND) return critical_bond(m, space, horizon);
    return sqrt(m->energy_release_rate / (horizon * stiffness));
}

/* Returns Rayleigh's function D(v) = 4 a_d a_s - (1 + a_s^2)^2 [1] at the speed v [m/s], with a^2 = 1 - v^2/c^2 (Freund
 * 1990); positive for speeds below the Rayleigh speed. longitudinal, shear: wave speeds c in a_d and a_s [m/s]. */
static real rayleigh_function(real v, real longitudinal, real shear)
{
    real d2 = 1 - square(v / longitudinal), s2 = 1 - square(v / shear);
    return 4 * sqrt(d2 * s2) - square(1 + s2);
}

/* Returns the Rayleigh wave speed [m/s] for the given longitudinal and shear wave speeds [m/s]: the non-trivial root of
 * rayleigh_function, between 0.68 (nu = -1) and 0.96 (nu = 1/2) of the shear speed, by bisection. */
static real rayleigh_speed(real longitudinal, real shear)
{
    real low = 0.5 * shear, high = shear;
    for (int k = 0; k < 60; k++) {
        real middle = 0.5 * (low + high);
        if (rayleigh_function(middle, longitudinal, shear) > 0)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

real material_uniaxial_stress(const struct material *m, real strain)
{
    const real elastic = m->young * strain;
    if (!material_yields(m) || elastic <= m->yield_stress) return elastic;
    return m->yield_stress + m->yield_tangent * (strain - m->yield_stress / m->young);
}

void material_compute_derived_constants(struct material *m, enum space space)
{
    real E = m->young, nu = m->poisson;
    m->yield_hardening = E * m->yield_tangent / (E - m->yield_tangent);
    if (space == SPACE_LINE) {
        m->c11 = m->bulk = E;
        m->c12 = m->shear = m->shear_speed = m->rayleigh_speed = 0;
        m->wave_speed = sqrt(E / m->density);
        flow_law_compute_derived_constants(&m->law, m->yield_stress, E, nu, 0, m->density);
        return;
    }
    bool thin = space == SPACE_PLANE_STRESS;
    m->shear = E / (2 * (1 + nu));
    flow_law_compute_derived_constants(&m->law, m->yield_stress, E, nu, m->shear, m->density);
    m->c12 = thin ? E * nu / (1 - nu * nu) : E * nu / ((1 + nu) * (1 - 2 * nu));
    m->c11 = m->c12 + 2 * m->shear;
    m->bulk = m->c12 + 2 * m->shear / space_dim(space);
    m->wave_speed = sqrt(m->c11 / m->density);
    m->shear_speed = sqrt(m->shear / m->density);
    m->rayleigh_speed = rayleigh_speed(m->wave_speed, m->shear_speed);
}

/* Fills matrix[n][n] with an isotropic stiffness or compliance, with n symmetric components in dim dimensions.
 * diagonal, off: entries of normal components, on and off the diagonal; shear: diagonal entry of shear components. */
static void isotropic_matrix(int dim, real diagonal, real off, real shear, real *matrix)
{
    int n = symmetric_tensor_component_count(dim);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            bool normal = i < dim && j < dim;
            matrix[i * n + j] = normal ? (i == j ? diagonal : off) : (i == j ? shear : 0);
        }
}

void material_stiffness_matrix(const struct material *m, int dim, real *matrix)
{
    isotropic_matrix(dim, m->c11, m->c12, 2 * m->shear, matrix);
}

void material_compliance_matrix(const struct material *m, int dim, real *matrix)
{
    real c11 = m->c11, c12 = m->c12;
    real determinant = (c11 - c12) * (c11 + (dim - 1) * c12);
    real shear = dim > 1 ? 1 / (2 * m->shear) : 0;
    isotropic_matrix(dim, (c11 + (dim - 2) * c12) / determinant, -c12 / determinant, shear, matrix);
}
