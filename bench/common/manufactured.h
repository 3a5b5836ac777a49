/* A motion that is known because its body force is chosen so, in two and three dimensions:
 *
 *   u_a = U p_a sin^2(pi t/T) sin(k x_a) prod_{b != a} cos(k x_b),    k = 2 pi/L
 *
 * Normal displacements are odd and tangential ones even about the planes x_a = 0 and L/2: mirrors. Under the elastic
 * operator it keeps its form, (c12 + G) grad div u + G lap u = -A_a u_a/p_a, A_a = k^2 [(c12 + G) sum p + G dim
 * p_a], so the body force is f_a = U [rho p_a 2 pi^2/T^2 + (A_a - 4 pi^2 rho p_a/T^2) sin^2(pi t/T)] times the same
 * modes. */
#ifndef CLEAVE_BENCH_MANUFACTURED
#define CLEAVE_BENCH_MANUFACTURED

#include <stdio.h>

#include "base/base.h"

struct manufactured {
    int dim;
    real amplitude, period, length; /* U [m], T [s], L [m] */
    real share[DIM_MAX];            /* p [1] */
    real c12, shear, density;       /* elastic constants of the space [Pa], rho [kg/m^3] */
};

struct manufactured_values {
    real displacement[DIM_MAX], velocity[DIM_MAX], strain[SYM_MAX]; /* [m] [m/s] [1] */
    real force[DIM_MAX];                                            /* [N/m^3] */
};
struct manufactured_values manufactured_at(const struct manufactured *m, const real *X, real t);

/* The body force as entries of `boundary` in a scene: plane waves in all directions (1, +-1, ..), one part that is
 * steady and one that beats; "  - {..}" line by line. */
void manufactured_boundaries(FILE *to, const struct manufactured *m);

#endif
