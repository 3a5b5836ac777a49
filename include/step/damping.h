#ifndef CLEAVE_DAMPING
#define CLEAVE_DAMPING

#include "kernels/kernels.h"
#include "loads/loads.h"

/* Velocities before the velocity update of the current step [m/s]: before[0][d][i] is component d of particle i,
 * before[1][d][k] is component d of node k of the mesh in the reference frame. Checkpoints do not contain these
 * velocities, since every step sets them. */
struct damping_state {
    real *before[2][DIM_MAX];
};

/* Returns the factor exp(-c dt/2) by which bulk damping reduces the velocity increment of a time step [1], c being the
 * damping rate and dt the time step; 1 without damping. rate_times_dt: c dt [1]. */
real damping_velocity_increment_factor(real rate_times_dt);

/* Returns the relative amounts by which the velocities before a time step, and their increments in it, would be larger
 * without bulk damping [1]; the work of supports is computed with these undamped values. rate_times_dt: c dt [1], with
 * the damping rate c and the time step dt; first_step: true in the first time step of a run, before which velocities
 * are damped by half a step only. */
struct undamped_velocity_excess damping_relative_excess_of_undamped_velocities(real rate_times_dt, bool first_step);

/* Multiplies all velocities of the particles p and of the mesh nodes by exp(-c dt/2) before the first velocity update
 * of the run, and subtracts the momentum that is lost from the impulse of the loads, loads->impulse. rate_times_dt: c
 * dt [1], with the damping rate c and the time step dt. Returns the kinetic energy that is lost [J]. */
real damping_apply_first_half_step_and_sum_loss(struct particles *p, const struct mesh *mesh, struct loads *loads,
                                                real rate_times_dt);

/* Copies all velocities of the particles p and the nodes of the mesh to s->before, before the forces of a time step
 * change them. */
void damping_store_velocities(struct damping_state *s, const struct particles *p, const struct mesh *mesh);

/* Returns the energy that bulk damping has dissipated since the previous time step [J], computed from the velocities
 * that damping_store_velocities stored in *s in this step and the present ones of the particles p and the mesh nodes.
 * rate_times_dt: c dt [1], c being the damping rate and dt the time step. Valid from the second step on. */
real damping_energy_loss_since_previous_step(const struct damping_state *s, const struct particles *p,
                                             const struct mesh *mesh, real rate_times_dt);

/* Multiplies all velocities of the particles p and of the mesh nodes by exp(-c dt) at the end of a time step, and
 * subtracts the momentum that is lost from the impulse of the loads, loads->impulse. rate_times_dt: c dt [1], with the
 * damping rate c and the time step dt. */
void damping_apply_full_step(struct particles *p, const struct mesh *mesh, struct loads *loads, real rate_times_dt);

/* Returns the energy that bulk damping dissipates in the velocity update that follows the last time step [J].
 * rate_times_dt: c dt [1], with the damping rate c and the time step dt. kinetic_energy_before: kinetic energy before
 * that update [J]; leapfrog_kinetic_energy: sum of 1/2 m v- . v+ over all particles, with the mass m and the velocities
 * v- and v+ before and after it [J]. */
real damping_energy_loss_in_last_velocity_update(real rate_times_dt, real kinetic_energy_before,
                                                 real leapfrog_kinetic_energy);

#endif
