/* Strength surfaces of Drucker and Prager (1952): a material fails where
 *
 *     U = (sqrt(J2) + g1 I1)/g0 = 1
 *
 * with the first invariant I1 of the stress, the second invariant J2 of its deviator, the strength g0 in
 * shear [Pa], and g1 [1], which follows from a second strength: compressive, hydrostatic or equal biaxial
 * tensile (Kamarei et al. 2025). U is the ratio of the stress to the stress on the surface that has the same
 * direction: 1 on the surface, proportional to the stress. */
#ifndef CLEAVE_STRENGTH_SURFACE
#define CLEAVE_STRENGTH_SURFACE

#include <math.h>

#include "base/base.h"

/* A strength surface of Drucker and Prager, on which a material fails: (sqrt(J2) + g1 I1)/g0 = 1, with the first
 * invariant I1 of the stress and the second invariant J2 of its deviator. g0 = 0: the material has no such surface. */
struct strength_surface {
    real g0, g1; /* [Pa] [1] */
};

/* Returns the strength surface of Drucker and Prager with the strengths tensile_strength [Pa] in uniaxial tension and
 * compressive_strength [Pa] in uniaxial compression; compressive_strength >= tensile_strength. */
struct strength_surface strength_surface_from_compressive_strength(real tensile_strength, real compressive_strength);

/* Returns the strength surface of Drucker and Prager with the strengths tensile_strength [Pa] in uniaxial and
 * hydrostatic_strength [Pa] in hydrostatic tension; hydrostatic_strength > tensile_strength/3. */
struct strength_surface strength_surface_from_hydrostatic_strength(real tensile_strength, real hydrostatic_strength);

/* Returns the strength surface of Drucker and Prager with the strengths tensile_strength [Pa] in uniaxial and
 * biaxial_strength [Pa] in equal biaxial tension; tensile_strength/2 < biaxial_strength <= tensile_strength. */
struct strength_surface strength_surface_from_biaxial_strength(real tensile_strength, real biaxial_strength);

/* Returns the ratio U = (sqrt(J2) + g1 I1)/g0 of a stress to the stress on the strength surface s that has the same
 * direction: 1 on the surface, below 1 inside. xx, yy, zz: normal stresses [Pa]; shear_squares: sum of the squares of
 * the shear stresses xy, yz, zx [Pa^2]. */
static inline real strength_surface_stress_to_strength_ratio(const struct strength_surface *s, real xx, real yy,
                                                             real zz, real shear_squares)
{
    const real J2 = (square(xx - yy) + square(yy - zz) + square(zz - xx)) / 6 + shear_squares;
    return (sqrt(J2) + s->g1 * (xx + yy + zz)) / s->g0;
}

/* Returns the ratio U = (sqrt(J2) + g1 I1)/g0 of a stress to the stress on the strength surface s that has the same
 * direction: 1 on the surface, below 1 inside. stress: components xx yy xy in 2D, xx yy zz xy yz zx in 3D [Pa];
 * out_of_plane_ratio: in 2D, the ratio [1] of the stress normal to the plane to the sum of the two normal stresses in
 * the plane: Poisson's ratio in plane strain, 0 in plane stress. */
static inline real strength_surface_stress_tensor_to_strength_ratio(const struct strength_surface *s,
                                                                    const real *stress, real out_of_plane_ratio,
                                                                    const int dim)
{
    real shear_squares = 0;
    for (int c = dim; c < dim * (dim + 1) / 2; c++) shear_squares += square(stress[c]);
    const real zz = dim == 3 ? stress[2] : out_of_plane_ratio * (stress[0] + stress[1]);
    return strength_surface_stress_to_strength_ratio(s, stress[0], stress[1], zz, shear_squares);
}

/* Returns the strength [Pa] of a material under principal stresses that grow in proportion: the number by which the
 * three principal values direction[3] [1] must be multiplied to reach the strength surface s; INFINITY if no multiple
 * reaches the surface. */
real strength_surface_strength_in_stress_direction(const struct strength_surface *s, const real *direction);

#endif
