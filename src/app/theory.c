/* `cleave help theory`: the equations that the program solves, on one page, with their sources. */
#include <stdio.h>

#include "commands.h"

static const char page[] =
    "What Cleave solves\n"
    "\n"
    "Notation: D space dimension; V_j, m_j volume [m^3] and mass [kg] of particle j; X, x places at rest and now;\n"
    "xi = X_j - X_i, r = |xi|, Y = x_j - x_i, n = Y/|Y|, e = |Y| - r, s = e/r; delta horizon; mu = 1 for an intact\n"
    "bond, 0 for a broken one; beta the share of V_j within the horizon; sums run over the family, r <= delta.\n"
    "\n"
    "Motion (leap-frog)   v(n+1/2) = v(n-1/2) + dt f(n)/m,   x(n+1) = x(n) + dt v(n+1/2);  the first kick: dt/2.\n"
    "\n"
    "PERIDYNAMICS   m_i a_i = V_i sum_j (T_ij - T_ji) V_j beta_ij + loads\n"
    "  bond           T_ij = c s mu n/2;  energy of a bond c s^2 r V_i V_j beta/2, counted once.       Silling 2005\n"
    "                 c gives a full lattice family the bulk modulus k2 (in the plane) or k (solid):\n"
    "                 2 E/S (line), 8 k2/S (plane), 18 k/S (solid),  S = sum_j r V_j beta.\n"
    "  bond breaks    s > s_c, for ever. From the energy release rate G_c: s_c^2 = 3 G_c/(E delta) (line),\n"
    "                 4 pi G_c/(9 E delta) (plane stress), 5 pi G_c/(12 E delta) (plane strain),\n"
    "                 5 G_c/(6 E delta) (solid).\n"
    "  bond yields    f = k (s - s_p), |f| <= k s_y + H_b alpha;  s_p, alpha plastic stretch and path.\n"
    "  ospd           T_ij = (w r/q) (D^2 (lambda - G) S_i + D (D + 2) G e/r) n,                       Silling 2007\n"
    "                 q = sum w r^2 V beta,  S_i = (1/q) sum w r e V beta,  lambda of the space.\n"
    "  mospd          W_i = lambda (tr)^2/2 + (D G/q) sum w |Y - R_i xi|^2 V beta,                     mospd 2026\n"
    "                 R_i the rotation that makes W_i least; T_ij its gradient.\n"
    "  damage         1 - sum mu V_j / sum V_j over the family at the start.\n"
    "  surfaces       bonds are scaled by 2 V0/(V_i + V_j), V_i = sum_j V_j beta, V0 of a full family. Le 2018\n"
    "\n"
    "MATERIAL POINT METHOD, current frame (MUSL)                                                      Zeng 2022\n"
    "  1 m_I = sum_p m_p N_Ip,  P_I = sum_p m_p v_p N_Ip            2 bonds act on points\n"
    "  3 f_I = -sum_p V_p sigma_p . grad N_Ip + sum_p N_Ip f_p,     P_I += dt f_I\n"
    "  4 v_p += dt sum_I N_Ip f_I/m_I,  x_p += dt sum_I N_Ip P_I/m_I   5 bonds break\n"
    "  6 P_I = sum_p m_p v_p N_Ip again, v_I = P_I/m_I              7 L = sum_I v_I (x) grad N_Ip, stress, volume\n"
    "  8 conversion                                                 apic: v_p and its gradient in place of 4, 6\n"
    "  N: linear, GIMP, cpGIMP (Bardenhagen 2004), B-splines. Stress: Jaumann's rate; von Mises plasticity with\n"
    "  linear isotropic hardening by return mapping (Simo 1998).\n"
    "MATERIAL POINT METHOD, reference frame: linear cells of two spacings over X with the points as quadrature;\n"
    "  f_I = -dE/du_I,  E = sum_p V_p W(F_p);  W of the strain of the rotated cell (finite) or of sym grad u.\n"
    "\n"
    "COUPLING   bonds join peridynamic particles and points: equal and opposite forces. partial stress: a point keeps\n"
    "  sigma - sum over bonds that cross its cell of their stress there, so that uniform strain crosses the interface\n"
    "  without force. interface damping: fourth-order viscosity between neighbours in the interface zone.\n"
    "  conversion     a point becomes peridynamic where its stress, the stretch of its bonds or a broken bond near it\n"
    "                 says so (Zeng 2022, eqs. 28, 31, 32); reversion: back, after low stress for a hold time.\n"
    "\n"
    "TIME STEP   dt < 2/omega_max: largest frequency of bonds by Lanczos' iteration and Gershgorin's bound, of\n"
    "  cells by the largest eigenvalue of one cell, of the current frame by a measured multiple of h/c.\n"
    "\n"
    "STRESS-INTENSITY FACTORS   interaction integral over rings, kinetic terms included; auxiliary fields of Williams\n"
    "  and of a moving tip (Freund 1990). K_I = E* I/(2 A_I).  growth: direction of the largest hoop stress,\n"
    "  theta = 2 atan(-2 k/(1 + sqrt(1 + 8 k^2))), k = K_II/K_I; bonds behind the tip fade (Imachi 2019).\n"
    "\n"
    "STATICS   K u = f by conjugate gradients, or adaptive dynamic relaxation.\n"
    "\n"
    "ENERGY   balance error = (kinetic + strain + plastic + fracture + damped - work - start)/largest sum.\n"
    "\n"
    "Titles and DOIs of the sources are in README.md.\n";

status theory_print(FILE *out)
{
    fputs(page, out);
    return ferror(out) ? status_set(FAILED, "help cannot be written") : OK;
}
