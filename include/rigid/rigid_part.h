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
    bool met; /* the warning of two rigid bodies inside each other has been given */
};

/* Makes all rigid bodies of a scene at the start. REFUSED if a body cannot be made (rigid_make). */
status rigids_make(struct rigid_set *rigid, const struct scene *s);

/* Returns REFUSED if a rigid body overlaps particles, or if a free one touches a mirror of the scene. */
status rigids_check(const struct rigid_set *rigid, const struct scene *s, const struct particles *p);

/* Books the contact forces of the last step, of length dt_velocity [s]: the work of drives, the largest forces, and the
 * impulse on the rigid bodies, which is subtracted from the impulse on the particles [dim, N s]. */
void rigids_add_impulse(struct rigid_set *rigid, real dt_velocity, real impulse[DIM_MAX]);

/* Advances all bodies by a step of length dt. middle: time in the middle of the step; dt_velocity: time by which
 * velocities advance [s]. */
void rigids_move(struct rigid_set *rigid, real middle, real dt, real dt_velocity);

/* Returns FAILED if a body moves more than half a spacing in a step, so that particles would be inside it before
 * contact acts. */
status rigids_speed_check(const struct rigid_set *rigid, const struct scene *s, const struct run_clock *clock);

/* Warns, once in a run, if a free body overlaps another rigid body at time t [s]. spacing: of particles [m]. */
void rigids_warn_of_overlap(struct rigid_set *rigid, real spacing, real t, struct warnings *to);

/* Energies of all rigid bodies [J]: kinetic energy before a step (`before`), of the last step as leap-frog conserves it
 * (`step`) and after the last step of a run (`last`); work of drives and weights (`work`). */
struct rigid_energy {
    real before, step, last, work;
};

/* Returns the energies. dt: time step [s]. */
struct rigid_energy rigids_energy(const struct rigid_set *rigid, real dt);

/* Describes the columns of rigid bodies in history.csv; column NULL: counts only. Returns the number of columns: force
 * [N], moment [N m], position of the centre [m] and velocity [m/s] of each body. */
int rigids_columns(const struct run *e, struct column *column);

/* Writes the values of the columns of rigid bodies at the time of the present sample to `record`. */
void rigids_record(struct run *e, real *record);

/* Stores the positions and velocities at time t [s], before a step, in rigid->motion for the present sample. */
void rigids_store_motion(struct rigid_set *rigid, real t);

/* Replaces the stored velocities of free bodies by the mean of the velocities before and after the step. */
void rigids_average_velocities(struct rigid_set *rigid);

/* Replaces the stored velocities by those at time t after the last step (rigids_velocity). */
void rigids_extrapolate_velocities(struct rigid_set *rigid, real t, real dt);

/* Computes the velocity v of rigid body k at time t [m/s], from the velocity half a step dt [s] behind t and the
 * present forces; of a driven body, the prescribed velocity. */
void rigids_velocity(const struct rigid_set *rigid, int k, real t, real dt, real *v);

#endif
