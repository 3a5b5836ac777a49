/* Manufactured solution in two and three dimensions: a motion whose body force is chosen such that it solves the
 * equations of motion.
 *
 *   u_a = U p_a sin^2(pi t/T) sin(k x_a) prod_{b != a} cos(k x_b),    k = 2 pi/L
 *
 * Normal displacements are odd and tangential ones even about the planes x_a = 0 and L/2, which are therefore mirrors.
 * The elastic operator maps the field to a multiple of itself, (c12 + G) grad div u + G lap u = -A_a u_a/p_a with A_a =
 * k^2 [(c12 + G) sum p + G dim p_a]. The body force is thus f_a = U [rho p_a 2 pi^2/T^2 + (A_a - 4 pi^2 rho p_a/T^2)
 * sin^2(pi t/T)] times the same modes. */
#ifndef CLEAVE_BENCH_MANUFACTURED
#define CLEAVE_BENCH_MANUFACTURED

#include <stdio.h>

#include "base/base.h"

/* Parameters of the manufactured motion, and elastic constants from which the required body force follows. */
struct manufactured {
    int dim;
    real amplitude, period, length; /* U [m], T [s], L [m] */
    real share[DIM_MAX];            /* p [1] */
    real c12, shear, density;       /* elastic constants of the space [Pa], rho [kg/m^3] */
};

/* Displacement, velocity, strain and body force of the manufactured solution at one point and time. */
struct manufactured_values {
    real displacement[DIM_MAX], velocity[DIM_MAX], strain[SYM_MAX]; /* [m] [m/s] [1] */
    real force[DIM_MAX];                                            /* [N/m^3] */
};

/* Returns displacement, velocity, strain and body force of the solution at position[dim] [m] and time t [s]. */
struct manufactured_values manufactured_at(const struct manufactured *m, const real *position, real t);

/* Writes the body force of the solution m to `scene_file` as entries of `boundary` in a scene, one per line. It
 * consists of plane waves in all directions (1, +-1, +-1), each with a constant part and a part proportional to
 * sin^2(pi t/T), with the time t and the period T of m. */
void manufactured_write_body_force(FILE *scene_file, const struct manufactured *m);

#endif
