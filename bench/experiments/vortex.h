/* A vortex whose body force is chosen for it, after the generalized vortex of Kamojjala, Brannon, Sadeghirad & Guilkey
 * (2015): every circle about the middle turns as a whole,
 *
 *   x = Q(alpha) X,    alpha = A sin^2(pi t/(2 T)) (1 - R^2)^4 for R < 1, else 0
 *
 * Their closed body force is that of a Neo-Hookean law, which Cleave has not. Here it is rho a - Div P of the laws that
 * it has, with F = Q (1 + alpha'/R (J X) (x) X) in closed form and Div by differences of fourth order:
 *
 *   mesh   P = R C : (U - 1), F = R U, linear in the strain of Biot (kernels/mesh/mesh_law.h)
 *   bonds  P = 1/2 sum c (|F xi| - |xi|)/|xi| F xi/|F xi| (x) xi V over the family of the lattice */
#ifndef CLEAVE_EXPERIMENTS_VORTEX
#define CLEAVE_EXPERIMENTS_VORTEX

#include "base/base.h"

enum vortex_law { VORTEX_BIOT, VORTEX_BONDS };
enum { VORTEX_BONDS_MOST = 64 };

struct vortex {
    enum vortex_law law;
    double turn, period, density; /* A [rad], T [s], rho [kg/m^3] */
    double c11, c12, shear;       /* of the plane [Pa] */
    int bonds;                    /* of half a family: xi [spacings], and c V r^2 summed to fit the plane [Pa] */
    double xi[VORTEX_BONDS_MOST][2], weight[VORTEX_BONDS_MOST];
};

/* The bonds of a lattice of which all weigh the same, of this reach [spacings], with the bulk modulus of the plane. */
void vortex_bonds(struct vortex *v, double reach);
/* Deformation gradient; first Piola-Kirchhoff stress of it [Pa]. */
void vortex_gradient(const struct vortex *v, const double *X, double t, double F[2][2]);
void vortex_stress(const struct vortex *v, double F[2][2], double P[2][2]);
/* Place [m], and body force per reference volume [N/m^3]. */
void vortex_place(const struct vortex *v, const double *X, double t, double *x);
void vortex_force(const struct vortex *v, const double *X, double t, double *b);

#endif
