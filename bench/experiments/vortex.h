/* A vortex with manufactured body force, after the generalized vortex of Kamojjala, Brannon, Sadeghirad & Guilkey
 * (2015): every circle around the centre rotates rigidly,
 *
 *   x = Q(alpha) X,    alpha = A sin^2(pi t/(2 T)) (1 - R^2)^4 for R < 1, else 0
 *
 * The body force of the paper is that of a Neo-Hookean law, which Cleave lacks. Here it is rho a - Div P for the laws
 * of Cleave, with F = Q (1 + alpha'/R (J X) (x) X) in closed form and Div by fourth-order differences:
 *
 *   mesh   P = R C : (U - 1), F = R U, linear in the Biot strain (kernels/mesh/mesh_law.h)
 *   bonds  P = 1/2 sum c (|F xi| - |xi|)/|xi| F xi/|F xi| (x) xi V over the neighbourhood of the lattice */
#ifndef CLEAVE_EXPERIMENTS_VORTEX
#define CLEAVE_EXPERIMENTS_VORTEX

#include "base/base.h"

enum vortex_law { VORTEX_BIOT, VORTEX_BONDS };
enum { VORTEX_BONDS_MOST = 64 };

/* Parameters of the prescribed vortex, its material law, and the bonds by which that law may be defined. */
struct vortex {
    enum vortex_law law;
    double turn, period, density; /* A [rad], T [s], rho [kg/m^3] */
    double c11, c12, shear;       /* elastic constants of the plane [Pa] */
    int bonds; /* number of bonds of half a neighbourhood; xi [spacings]; weight: c V r^2, scaled to the
                * constants of the plane [Pa] */
    double xi[VORTEX_BONDS_MOST][2], weight[VORTEX_BONDS_MOST];
};

/* Fills the members bonds, xi and weight of v with the bonds of a square lattice with uniform weights, scaled to the
 * bulk modulus of the plane. longest_bond: length of the longest bond [spacings]. */
void vortex_fill_bonds_of_lattice(struct vortex *v, double longest_bond);

/* Computes the deformation gradient F of the vortex v at the reference position position[2] [m] and time t [s]. */
void vortex_compute_deformation_gradient(const struct vortex *v, const double *position, double t, double F[2][2]);

/* Computes the first Piola-Kirchhoff stress P [Pa] at the deformation gradient F by the law v->law. */
void vortex_compute_piola_stress(const struct vortex *v, double F[2][2], double P[2][2]);

/* Computes the position present_position[2] [m] at time t [s] of the material point of the vortex v at the reference
 * position reference_position[2] [m]. */
void vortex_compute_present_position(const struct vortex *v, const double *reference_position, double t,
                                     double *present_position);

/* Computes the body force body_force[2] per reference volume [N/m^3] that the motion v requires at the reference
 * position position[2] [m] and time t [s]. */
void vortex_compute_body_force(const struct vortex *v, const double *position, double t, double *body_force);

#endif
