/* Room `rigid` (folder of include/ and src/): rigid bodies: their motion, and the distance of a point from their
 * surface. The room uses `data`, but neither the forces of particles nor input files; contact computes the forces on
 * rigid bodies, and the engine moves them.
 *
 * A rigid body is fixed, moves with a prescribed velocity (driven), or moves under forces (free); a free body has a
 * mass of uniform density. The shape is a region (data/region.h) in the reference configuration, t = 0. */
#ifndef CLEAVE_RIGID
#define CLEAVE_RIGID

#include "base/archive.h"
#include "data/region.h"

/* How a rigid body moves: not at all, with a prescribed velocity, or by forces and its inertia. */
enum rigid_motion { RIGID_FIXED, RIGID_DRIVEN, RIGID_FREE };

/* A rigid body: its shape, how it moves, and its present motion and forces. Members marked FREE or DRIVEN have a
 * meaning for this kind of motion only. */
struct rigid_body {
    char name[NAME_MAX_LENGTH];
    const struct region *shape; /* region that the body fills at t = 0; kept by reference */
    int dim;
    enum rigid_motion motion;
    bool turns;                /* FREE: may rotate */
    real speed[DIM_MAX], ramp; /* DRIVEN: velocity from t = `ramp` on [m/s]; before, it grows in proportion to t [s] */
    real mass;                 /* FREE: mass [kg] */
    /* FREE: tensor of inertia about the centre, at t = 0; in the plane only zz counts [kg m^2] */
    real inertia[DIM_MAX][DIM_MAX];
    real weight[DIM_MAX]; /* FREE: constant force at the centre [N] */
    /* largest face of the bounding box: 1 in 1D, a length [m] in 2D, an area [m^2] in 3D */
    real face;
    real centre[DIM_MAX]; /* at t = 0: centre of mass, or of volume if the body has no mass [m] */
    real radius;          /* diagonal of the bounding box [m] */

    real x[DIM_MAX]; /* present position of the centre [m] */
    /* velocity of the centre [m/s] and angular velocity [1/s], half a step behind t */
    real v[DIM_MAX], spin[DIM_MAX];
    real angular[DIM_MAX];        /* angular momentum about the centre [kg m^2/s] */
    real turn[DIM_MAX][DIM_MAX];  /* rotation matrix from t = 0 to the present */
    real force[DIM_MAX];          /* contact force on the body in the last step [N] */
    real moment[DIM_MAX];         /* moment of the contact forces about the centre in the last step [N m] */
    real force_most;              /* largest |force| so far [N] */
    real increment[DIM_MAX];      /* displacement in the last step [m] */
    real force_previous[DIM_MAX]; /* force at the last call of rigid_add_work_of_prescribed_motion [N] */
    real work;                    /* work of the drive up to the last call of rigid_add_work_of_prescribed_motion [J] */
    /* kinetic energy of the last step as leap-frog conserves it, 1/2 m v_old . v_new with the rotation likewise [J] */
    real kinetic;
};

/* Initialises the rigid body *r, whose name must be set and whose other members must be 0. shape: region at t = 0, kept
 * by reference; dim: dimension of space; mass: of a free body, which moves under forces [kg], 0 for a fixed or driven
 * one; velocity: initial velocity of a free body, prescribed velocity of a driven one (dim components [m/s]); spacing:
 * of the particles [m]. Returns REFUSED, with a message, if a moving body is unbounded or a bounded body has no volume.
 */
status rigid_make(struct rigid_body *r, const struct region *shape, int dim, real mass, const real *velocity,
                  real spacing);

/* Tests by the bounding sphere of the rigid body r whether a point of the body may be within `reach` [m] of the current
 * position x (r->dim components [m]). Returns false if that is impossible; always true for a fixed body, which may be
 * unbounded. */
static inline bool rigid_may_be_within_distance_of_position(const struct rigid_body *r, const real *x, real reach)
{
    real far2 = 0;
    for (int d = 0; d < r->dim; d++) far2 += square(x[d] - r->x[d]);
    return r->motion == RIGID_FIXED || far2 <= square(r->radius + reach);
}

/* Returns the distance of the point x (present position, DIM_MAX components [m]) from the surface of the rigid body r,
 * negative inside [m]. normal: receives the outward unit normal of the nearest surface point. */
real rigid_signed_distance(const struct rigid_body *r, const real *x, real *normal);

/* Computes the current position x of the point of the rigid body r that was at X at t = 0. X, x: DIM_MAX components
 * each [m]. */
void rigid_compute_current_position_of_point(const struct rigid_body *r, const real *X, real *x);

/* Computes the velocity of the point of the rigid body r that is at the position x (r->dim components [m]), from the
 * velocity of the centre and the angular velocity of the body. velocity: receives DIM_MAX components [m/s]. */
void rigid_compute_velocity_at_point(const struct rigid_body *r, const real *x, real *velocity);

/* Computes the velocity that is prescribed for the rigid body r, which must have prescribed motion, at time t [s].
 * velocity: receives r->dim components [m/s]. */
void rigid_compute_prescribed_velocity(const struct rigid_body *r, real t, real *velocity);

/* Computes the displacement that is prescribed for the rigid body r between the times 0 and t [s]; 0 for bodies without
 * prescribed motion. displacement: receives r->dim components [m]. Returns the length of the displacement vector
 * [m]. */
real rigid_compute_prescribed_displacement(const struct rigid_body *r, real t, real *displacement);

/* Moves the rigid body r, if it has prescribed motion, to its prescribed position at time t [s], and adds the
 * displacement to r->increment, from which rigid_add_work_of_prescribed_motion computes the work. Does nothing for
 * other bodies. */
void rigid_move_to_prescribed_position(struct rigid_body *r, real t);

/* Advances the rigid body r by one leap-frog step: a free body under r->force, r->moment and its weight, other moving
 * bodies with their prescribed velocity. Velocities advance by dt_velocity, positions by dt [s]. t_middle: time in the
 * middle of the step [s]. Stores in r->kinetic the kinetic energy that leap-frog conserves, with the product of the
 * velocities before and after the step in place of their squares. */
void rigid_advance_one_step(struct rigid_body *r, real t_middle, real dt, real dt_velocity);

/* Adds to r->work the work done since the last call by the drive of the rigid body r, i.e. by the force that enforces
 * its prescribed motion [J]: minus the displacement since the last call times the mean of the contact forces at the
 * last call and now. Does nothing for other bodies. */
void rigid_add_work_of_prescribed_motion(struct rigid_body *r);

/* Increases r->force_most, the largest magnitude of the contact force on the rigid body r so far [N], to the magnitude
 * of the present force r->force if that is larger. */
void rigid_update_largest_contact_force(struct rigid_body *r);

/* Returns the work [J] done on the rigid body r from t = 0 to the present position by its weight and its drive, i.e.
 * the force that enforces a prescribed motion. */
real rigid_work_of_prescribed_motion_and_weight(const struct rigid_body *r);

/* Returns the kinetic energy of the rigid body r at its present velocity and angular velocity [J]. */
real rigid_kinetic_energy(const struct rigid_body *r);

/* Returns by how much the kinetic energy of the free rigid body r changes in half a time step under its current contact
 * force, weight and moment, to first order in dt [J]; 0 for other bodies. dt: whole time step [s]. */
real rigid_half_step_kinetic_energy_change(const struct rigid_body *r, real dt);

/* Saves the motion of the rigid body r to the archive `a` (checkpoint file or memory) if a->saving is set, else
 * restores the motion from the archive. body_number: number of the body in the scene, which the names of the entries in
 * the archive contain. Returns FAILED if the archive cannot be read or written or a stored size differs. */
status rigid_save_or_load(struct rigid_body *r, int body_number, struct archive *a);

#endif
