#ifndef CLEAVE_DAMPING
#define CLEAVE_DAMPING

#include "kernels/kernels.h"
#include "loads/loads.h"

/* Velocities before a step moves them, of particles and of nodes, where damping acts; from step to step it has no
 * state. */
struct damping_state {
    real *before[2][DIM_MAX];
};

/* Returns the share of a kick that is left at its end, exp(-c dt/2); 1 without damping [1]. decay: c dt of a step. */
real damping_share(real decay);

/* Slows all velocities by half a step, before the first kick; returns the kinetic energy that is lost [J]. */
real damping_start(struct particles *p, const struct mesh *mesh, struct loads *l, real decay);

/* Keeps all velocities, before a step moves anything. */
void damping_keep(struct damping_state *s, const struct particles *p, const struct mesh *mesh);

/* Returns the energy lost since the previous step [J], by the velocities kept in this one. After the first step only.
 */
real damping_loss(const struct damping_state *s, const struct particles *p, const struct mesh *mesh, real decay);

/* Slows all velocities by a whole step, for the next one. */
void damping_end(struct particles *p, const struct mesh *mesh, struct loads *l, real decay);

/* Returns the energy lost in the kick after the last step [J], by the kinetic energy before the kick and the one across
 * the kick, 1/2 m v- . v+ [J]. */
real damping_last(real decay, real kinetic_before, real kinetic);

#endif
