#ifndef CLEAVE_DAMPING
#define CLEAVE_DAMPING

#include "kernels/kernels.h"
#include "loads/loads.h"

/* Velocities of particles [0] and of nodes of the reference frame [1] before the kick of the current step [n, m/s].
 * They are set in every step, so that checkpoints do not contain them. */
struct damping_state {
    real *before[2][DIM_MAX];
};

/* Returns the factor exp(-c dt/2) that damping applies to the kick of a step; 1 without damping [1]. decay: c dt of
 * a step. */
real damping_share(real decay);

/* Multiplies all velocities by exp(-c dt/2), before the first kick; returns the kinetic energy that is lost [J]. */
real damping_start(struct particles *p, const struct mesh *mesh, struct loads *l, real decay);

/* Stores all velocities before the kick of a step. */
void damping_keep(struct damping_state *s, const struct particles *p, const struct mesh *mesh);

/* Returns the energy lost since the previous step [J], from the velocities stored in this step. Valid from the
 * second step on. */
real damping_loss(const struct damping_state *s, const struct particles *p, const struct mesh *mesh, real decay);

/* Multiplies all velocities by exp(-c dt) at the end of a step. */
void damping_end(struct particles *p, const struct mesh *mesh, struct loads *l, real decay);

/* Returns the energy lost in the kick after the last step [J]. kinetic_before: kinetic energy before the kick;
 * kinetic: 1/2 m v- . v+ with the velocities before and after the kick [J]. */
real damping_last(real decay, real kinetic_before, real kinetic);

#endif
