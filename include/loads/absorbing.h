/* Absorbing faces: viscous tractions t = -(rho c_p v_n n + rho c_s v_t) on the face that a body shows along an axis, so
 * that waves leave it (Lysmer & Kuhlemeyer 1969). Each is a dashpot on a particle or node, solved within its leap-frog
 * step (kernels/dashpot.h): no time step is too long for it, and it never gives energy. */
#ifndef CLEAVE_ABSORBING
#define CLEAVE_ABSORBING

#include "data/grid.h"
#include "data/particles.h"

/* What moves a particle, each with its own elastic constants. */
enum moved_by { MOVED_BY_BONDS, MOVED_BY_GRID, MOVED_BY_MESH, MOVERS };

/* Of a material, rho c_p and rho c_s [kg/(m^2 s)]. */
struct impedance {
    real normal, tangential;
};

/* Dashpots of all absorbing faces. */
struct absorbing {
    int64_t n;
    int32_t *particle;           /* [n] ascending */
    real *rate[MOVERS][DIM_MAX]; /* [n] force over velocity by component, for a particle moved so [kg/s] */
    const struct impedance *impedance[MOVERS]; /* [materials] borrowed */
    bool idle;                                 /* no dashpot acts: forces are computed that no motion follows */
    real energy;                               /* taken since the start [J] */
    real kick;                                 /* a quarter of impulse . change of velocity, in the last step [J] */
    real *field;                               /* scratch: rates of the grid's nodes [kg/s] */
};

#endif
