/* Closed forms of the vortex. */
#include "vortex.h"

#include <math.h>

#define VORTEX_DIFFERENCE 1e-3 /* distance of points for finite differences [m]: their error is 1e-9 of the stress */

/* ---- motion ------------------------------------------------------------------------------------------------------ */

/* Returns the factor on the rotation of the vortex v at time t [s]: sin^2(pi t/(2 T)), which grows from 0 to 1 over the
 * time T. */
static double vortex_growth(const struct vortex *v, double t) { return square(sin(M_PI * t / (2 * v->period))); }

/* Returns the rotation angle alpha of the vortex v at X[2] [m] and time t [s] in rad, and stores alpha'/R in *slope,
 * its derivative along the radius R over R [1/m^2]. */
static double vortex_angle(const struct vortex *v, const double *X, double t, double *slope)
{
    const double rest = 1 - X[0] * X[0] - X[1] * X[1], grown = v->turn * vortex_growth(v, t);
    *slope = rest > 0 ? -8 * grown * rest * rest * rest : 0;
    return rest > 0 ? grown * square(rest * rest) : 0;
}

void vortex_compute_present_position(const struct vortex *v, const double *reference_position, double t,
                                     double *present_position)
{
    double slope;
    const double a = vortex_angle(v, reference_position, t, &slope);
    present_position[0] = cos(a) * reference_position[0] - sin(a) * reference_position[1];
    present_position[1] = sin(a) * reference_position[0] + cos(a) * reference_position[1];
}

void vortex_compute_deformation_gradient(const struct vortex *v, const double *position, double t, double F[2][2])
{
    double slope;
    const double a = vortex_angle(v, position, t, &slope), c = cos(a), s = sin(a);
    const double G[2][2] = {{1 - slope * position[1] * position[0], -slope * position[1] * position[1]},
                            {slope * position[0] * position[0], 1 + slope * position[0] * position[1]}};
    for (int j = 0; j < 2; j++) F[0][j] = c * G[0][j] - s * G[1][j], F[1][j] = s * G[0][j] + c * G[1][j];
}

/* ---- constitutive laws ------------------------------------------------------------------------------------------- */

/* Fills the members bonds, xi and weight of v with the bonds of a square lattice with uniform weights, whose longest
 * bond has the length `longest_bond` [spacings]. The weights are scaled so that they have the bulk modulus of the
 * plane, (c11
 * + c12)/2. */
void vortex_fill_bonds_of_lattice(struct vortex *v, double longest_bond)
{
    double sum = 0;
    v->bonds = 0;
    for (int i = 0; i <= (int)longest_bond; i++)
        for (int j = -(int)longest_bond; j <= (int)longest_bond; j++) {
            const double r = hypot(i, j);
            if (r == 0 || r > longest_bond || (i == 0 && j < 0)) continue;
            INVARIANT(v->bonds < VORTEX_BONDS_MOST);
            v->xi[v->bonds][0] = i, v->xi[v->bonds][1] = j, v->weight[v->bonds++] = r;
            sum += r;
        }
    /* Under a uniform expansion e, both directions of a bond cause a stress of sum r c V e, half of it along each axis,
     * which must equal (c11 + c12) e. */
    for (int k = 0; k < v->bonds; k++) v->weight[k] *= 2 * (v->c11 + v->c12) / sum;
}

static void stress_of_bonds(const struct vortex *v, double F[2][2], double P[2][2])
{
    for (int a = 0; a < 2; a++) P[a][0] = P[a][1] = 0;
    for (int k = 0; k < v->bonds; k++) {
        const double r = hypot(v->xi[k][0], v->xi[k][1]), n[2] = {v->xi[k][0] / r, v->xi[k][1] / r};
        const double y[2] = {F[0][0] * n[0] + F[0][1] * n[1], F[1][0] * n[0] + F[1][1] * n[1]};
        const double pull = v->weight[k] * (1 - 1 / hypot(y[0], y[1]));
        for (int a = 0; a < 2; a++)
            for (int b = 0; b < 2; b++) P[a][b] += pull * y[a] * n[b];
    }
}

static void stress_of_biot(const struct vortex *v, double F[2][2], double P[2][2])
{
    const double along = F[0][0] + F[1][1], across = F[1][0] - F[0][1], size = hypot(along, across);
    const double c = along / size, s = across / size;
    const double e11 = c * F[0][0] + s * F[1][0] - 1, e22 = c * F[1][1] - s * F[0][1] - 1;
    const double s12 = 2 * v->shear * (c * F[0][1] + s * F[1][1]);
    const double s11 = v->c11 * e11 + v->c12 * e22, s22 = v->c12 * e11 + v->c11 * e22;
    P[0][0] = c * s11 - s * s12, P[0][1] = c * s12 - s * s22;
    P[1][0] = s * s11 + c * s12, P[1][1] = s * s12 + c * s22;
}

void vortex_compute_piola_stress(const struct vortex *v, double F[2][2], double P[2][2])
{
    if (v->law == VORTEX_BONDS)
        stress_of_bonds(v, F, P);
    else
        stress_of_biot(v, F, P);
}

/* ---- force ------------------------------------------------------------------------------------------------------- */

/* Adds the derivatives of the stresses P_ab of the vortex v along axis b at X[2] [m] and time t [s] to sum[a], for a =
 * 0 and 1 [N/m^3], by fourth-order central differences. The sum over b = 0 and 1 is the divergence Div P. */
static void divergence_add(const struct vortex *v, const double *X, double t, int b, double *sum)
{
    static const double place[] = {-2, -1, 1, 2}, share[] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12};
    for (int k = 0; k < 4; k++) {
        double at[2] = {X[0], X[1]}, F[2][2], P[2][2];
        at[b] += place[k] * VORTEX_DIFFERENCE;
        vortex_compute_deformation_gradient(v, at, t, F);
        vortex_compute_piola_stress(v, F, P);
        for (int a = 0; a < 2; a++) sum[a] += share[k] * P[a][b] / VORTEX_DIFFERENCE;
    }
}

void vortex_compute_body_force(const struct vortex *v, const double *position, double t, double *body_force)
{
    double x[2], divergence[2] = {0};
    const double beat = M_PI / (2 * v->period),
                 shape = square(square(fmax(0, 1 - position[0] * position[0] - position[1] * position[1])));
    const double rate = v->turn * shape * beat * sin(2 * beat * t);
    const double change = v->turn * shape * 2 * square(beat) * cos(2 * beat * t);
    vortex_compute_present_position(v, position, t, x);
    for (int a = 0; a < 2; a++) divergence_add(v, position, t, a, divergence);
    body_force[0] = v->density * (-change * x[1] - rate * rate * x[0]) - divergence[0];
    body_force[1] = v->density * (change * x[0] - rate * rate * x[1]) - divergence[1];
}
