/* Rigid bodies of a run. */
#ifndef CLEAVE_RIGID_PART
#define CLEAVE_RIGID_PART

#include "output/column.h"
#include "rigid/rigid.h"
#include "run/run.h"

/* All rigid bodies of a run, and the shapes of the deformable bodies that contact uses. */
struct rigid_set {
    int n, dim;
    bool moves;                  /* true if the motion is integrated in time: velocities have a meaning */
    struct rigid_body *body;     /* [n] */
    const struct region **shape; /* [scene->bodies] NULL: body made from a list, or of several joined solids */
    /* [n][2 DIM_MAX] centres [m] and velocities [m/s] at the time of the present sample */
    real *motion;
    struct rigid_surface *surface; /* [n] for the files beside the frames (rigid_surface.h); NULL before the first */
    bool met;                      /* the warning of two rigid bodies inside each other has been given */
};

/* Makes all rigid bodies of scene s at t = 0 in *rigid, and lists the shapes of the deformable bodies for contact.
 * Returns REFUSED, with a message, if a rigid body is unbounded while it moves or has no volume (rigid_make). Released
 * by run_free_memory. */
status rigids_make(struct rigid_set *rigid, const struct scene *s);

/* Checks the positions of all rigid bodies at the start. Returns REFUSED, with a message, if one overlaps particles, or
 * if a freely moving one touches a mirror plane of the scene s. p: particles of the run. */
status rigids_check_no_overlap_at_start(const struct rigid_set *rigid, const struct scene *s,
                                        const struct particles *p);

/* Moves all driven rigid bodies (those with a prescribed velocity) of the set `rigid` to their prescribed positions at
 * time t [s]. */
void rigids_move_to_prescribed_positions(struct rigid_set *rigid, real t);

/* Updates, from the contact forces on all rigid bodies in the last step, the work of the drives (the forces that
 * enforce prescribed motion) and the largest forces. Subtracts the impulse of the contact forces, force times
 * dt_velocity [s], from `particle_impulse`, the impulse on the particles (dim components [N s]). */
void rigids_update_drive_work_and_contact_impulse(struct rigid_set *rigid, real dt_velocity,
                                                  real particle_impulse[DIM_MAX]);

/* Advances all rigid bodies by one leap-frog step under their forces or prescribed velocities (rigid_advance_one_step).
 * t_middle: time in the middle of the step; dt: time by which positions advance; dt_velocity: time by which velocities
 * advance [s]. */
void rigids_advance_one_step(struct rigid_set *rigid, real t_middle, real dt, real dt_velocity);

/* Checks the speeds of all rigid bodies. Returns FAILED, with a message, if one moves more than half a particle spacing
 * of the scene s in a time step, so that particles would be inside the body before contact acts. clock: time and time
 * step of the run. */
status rigids_check_motion_per_step_is_small(const struct rigid_set *rigid, const struct scene *s,
                                             const struct run_clock *clock);

/* Adds a warning to `warning_list`, once in a run, if a freely moving rigid body is more than half a spacing inside
 * another rigid body at time t [s]: rigid bodies exert no forces on each other. spacing: of the particles [m]. */
void rigids_warn_of_overlap(struct rigid_set *rigid, real spacing, real t, struct warnings *warning_list);

/* Energies of all rigid bodies [J]. before, last: kinetic energy before a step, and after the last step of a run; step:
 * kinetic energy in the last step as leap-frog conserves it (product of the velocities before and after the step);
 * work: work of the forces that enforce prescribed motion, and of the weights. */
struct rigid_energy {
    real before, step, last, work;
};

/* Returns the kinetic energies and the work of drives and weights, summed over all rigid bodies, from their present
 * motion and forces [J]. dt: time step [s]. */
struct rigid_energy rigids_compute_energy(const struct rigid_set *rigid, real dt);

/* Stores names and units of the columns of the rigid bodies of the run in history.csv in the array `column`; if
 * `column` is NULL, only counts the columns. Returns the number of columns: force [N], moment [N m], position of the
 * centre [m] and velocity [m/s] of each body. */
int rigids_list_history_columns(const struct run *run, struct column *column);

/* Writes the values of the history.csv columns of the rigid bodies of the run to the array `record`, in the order of
 * rigids_list_history_columns: for each body the forces and moments of the last step, then position and velocity at the
 * time of the sample, which rigids_store_motion_before_step has stored. */
void rigids_write_history_values(struct run *run, real *record);

/* Stores the positions and velocities of all rigid bodies in rigid->motion, before a step, for the sample (line of
 * history.csv) at time t [s]. The stored velocity of a body with prescribed motion is the prescribed one at t. */
void rigids_store_motion_before_step(struct rigid_set *rigid, real t);

/* Replaces the velocities of free bodies of `rigid` that rigids_store_motion_before_step stored before the step by the
 * mean of these and the current velocities. Must be called after the step; the result is the velocities at the time of
 * the sample. */
void rigids_average_stored_and_current_velocities(struct rigid_set *rigid);

/* Replaces the velocities stored by rigids_store_motion_before_step by those at time t [s], extrapolated from the
 * current ones, for the sample (line of history.csv) after the last time step. dt: time step [s]. rigid: the bodies. */
void rigids_extrapolate_stored_velocities_to_time(struct rigid_set *rigid, real t, real dt);

/* Computes the velocity v of rigid body number `body` at time t [m/s], dim components: for a free body from its
 * velocity, half a step behind t, and the current forces; for a body with prescribed motion the prescribed velocity.
 * dt: time step [s]. */
void rigids_compute_velocity_of_body_at_time(const struct rigid_set *rigid, int body, real t, real dt, real *v);

#endif
