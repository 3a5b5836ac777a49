/* Computes the constants of Drucker-Prager strength surfaces (failure criteria in stress) from two strengths, and the
 * strengths and strains at failure of a material with such a surface. */
#include "data/strength_surface.h"

#include "data/material.h"

/* Returns the Drucker-Prager surface with the coefficient g1 of the mean stress [1] that passes through the tensile
 * strength `tension` [Pa]. */
static struct strength_surface surface_through(real tension, real g1)
{
    return (struct strength_surface){tension * (1 / sqrt(3) + g1), g1};
}

struct strength_surface strength_surface_from_compressive_strength(real tensile_strength, real compressive_strength)
{
    return surface_through(tensile_strength, (compressive_strength - tensile_strength) /
                                                 (sqrt(3) * (compressive_strength + tensile_strength)));
}

struct strength_surface strength_surface_from_hydrostatic_strength(real tensile_strength, real hydrostatic_strength)
{
    return surface_through(tensile_strength,
                           tensile_strength / (sqrt(3) * (3 * hydrostatic_strength - tensile_strength)));
}

struct strength_surface strength_surface_from_biaxial_strength(real tensile_strength, real biaxial_strength)
{
    return surface_through(tensile_strength, (tensile_strength - biaxial_strength) /
                                                 (sqrt(3) * (2 * biaxial_strength - tensile_strength)));
}

void material_set_strength_surface(struct material *m, enum space space, struct strength_surface surface)
{
    m->surface = surface;
    m->surface_least_strain = material_smallest_strain_on_strength_surface(m, space);
}

real strength_surface_strength_in_stress_direction(const struct strength_surface *s, const real *direction)
{
    const real share = strength_surface_stress_to_strength_ratio(s, direction[0], direction[1], direction[2], 0);
    return share > 0 ? 1 / share : INFINITY;
}

/* Sets stress[2], the principal stress normal to the plane of `space`, from stress[0] and stress[1] [Pa]: 0 in plane
 * stress, nu (stress[0] + stress[1]) in plane strain, with Poisson's ratio nu of material m. Unchanged in other
 * spaces. */
static void complete_state(const struct material *m, enum space space, real *stress)
{
    if (space == SPACE_PLANE_STRESS) stress[2] = 0;
    if (space == SPACE_PLANE_STRAIN) stress[2] = m->poisson * (stress[0] + stress[1]);
}

/* Returns the largest principal strain that a stress state of fixed direction has when it reaches the strength surface
 * (failure criterion in stress) of material m, for the elasticity of the space [1]; INFINITY if it never does.
 * stress[3]: principal stresses that give the direction; in a plane, the one normal to it is computed and stored. */
static real largest_strain(const struct material *m, enum space space, real *stress)
{
    const int dim = space_dim(space);
    real most = -INFINITY;
    complete_state(m, space, stress);
    const real strength = strength_surface_strength_in_stress_direction(&m->surface, stress),
               sum = stress[0] + stress[1] + stress[2];
    for (int k = 0; k < dim; k++) most = real_max(most, ((1 + m->poisson) * stress[k] - m->poisson * sum) / m->young);
    return isinf(strength) ? INFINITY : strength * most;
}

enum { ANGLES = 360 }; /* of a half circle; the least strain is found to 1e-4 */

real material_smallest_strain_on_strength_surface(const struct material *m, enum space space)
{
    real least = INFINITY;
    for (int k = 0; k < 2 * ANGLES; k++) {
        const real azimuth = M_PI * k / ANGLES;
        for (int n = 0; n < (space == SPACE_SOLID ? ANGLES : 1); n++) {
            const real polar = space == SPACE_SOLID ? M_PI * (n + 0.5) / ANGLES : 0.5 * M_PI;
            real stress[] = {sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar)};
            least = real_min(least, largest_strain(m, space, stress));
        }
    }
    /* the corner of equal tension in all directions lies between the angles */
    real equal[] = {1, 1, 1};
    return real_max(0, real_min(least, largest_strain(m, space, equal)));
}

struct surface_strengths material_strengths_from_strength_surface(const struct material *m, enum space space)
{
    real tension[] = {1, 0, 0}, biaxial[] = {1, 1, 0};
    const real shear[] = {1, -1, 0}, hydrostatic[] = {1, 1, 1};
    real pressure[] = {-1, 0, 0};
    if (space != SPACE_SOLID)
        complete_state(m, space, tension), complete_state(m, space, biaxial), complete_state(m, space, pressure);
    return (struct surface_strengths){strength_surface_strength_in_stress_direction(&m->surface, tension),
                                      strength_surface_strength_in_stress_direction(&m->surface, biaxial),
                                      strength_surface_strength_in_stress_direction(&m->surface, shear),
                                      strength_surface_strength_in_stress_direction(&m->surface, hydrostatic),
                                      strength_surface_strength_in_stress_direction(&m->surface, pressure)};
}

real material_stress_to_strength_ratio(const struct material *m, enum space space, const real *stress)
{
    return strength_surface_stress_tensor_to_strength_ratio(
        &m->surface, stress, space == SPACE_PLANE_STRAIN ? m->poisson : 0, space_dim(space));
}
