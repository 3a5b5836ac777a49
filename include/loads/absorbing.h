/* Absorbing faces: viscous tractions t = -(rho c_p v_n n + rho c_s v_t) on the exposed face of a body along an axis, by
 * which waves leave the body (Lysmer & Kuhlemeyer 1969). rho: density; c_p, c_s: speeds of longitudinal and shear
 * waves; n, v_n, v_t: normal of the face, normal and tangential velocity. Each traction is a dashpot on a particle or
 * node, solved implicitly within the leap-frog step (kernels/dashpot.h): stable at any time step, and never adding
 * energy. */
#ifndef CLEAVE_ABSORBING
#define CLEAVE_ABSORBING

#include "data/grid.h"
#include "data/particles.h"

/* The method that moves a particle: bond forces, background grid or mesh. The wave impedance of a material differs
 * between them. MOVERS: number of these methods. */
enum moved_by { MOVED_BY_BONDS, MOVED_BY_GRID, MOVED_BY_MESH, MOVERS };

/* Wave impedances of a material: normal, rho c_p, and tangential, rho c_s [kg/(m^2 s)], with the speeds c_p, c_s of
 * longitudinal and shear waves. */
struct impedance {
    real normal, tangential;
};

/* Dashpots of all absorbing faces, `n` in number, one for each particle on these faces. */
struct absorbing {
    int64_t n;
    int32_t *particle;           /* [n] particles with a dashpot, indices in ascending order */
    real *rate[MOVERS][DIM_MAX]; /* [n] coefficient (force divided by velocity) of the dashpot for each method of motion
                                    and each component [kg/s] */
    const struct impedance *impedance[MOVERS]; /* [materials] borrowed */
    bool idle;                                 /* true: dashpots are inactive, as forces are evaluated without motion */
    real energy;                               /* energy dissipated since the start [J] */
    real kick; /* sum of impulse . change of velocity/4 in the last step, which the correction of the kinetic energy of
                  samples leaves out [J] */
    real *field; /* working memory: rates of the grid's nodes [kg/s] */
};

#endif
