/* Room `rigid`: solids that do not deform: where they are, how they move, and how far a point is from their surface. It
 * knows `data`, and neither particles' forces nor scenes; contact puts forces on them, the engine moves them.
 *
 * A rigid body keeps its place, moves as it is told, or flies: then it has a mass, and a uniform density. Its shape is
 * that of a region (data/region.h), in the places of t = 0. */
#ifndef CLEAVE_RIGID
#define CLEAVE_RIGID

#include "base/archive.h"
#include "data/region.h"

enum rigid_motion { RIGID_FIXED, RIGID_DRIVEN, RIGID_FREE };

struct rigid_body {
    char name[NAME_MAX_LENGTH];
    const struct region *shape; /* borrowed; at t = 0 */
    int dim;
    enum rigid_motion motion;
    bool turns;                     /* FREE: may rotate */
    real speed[DIM_MAX], ramp;      /* DRIVEN: velocity [m/s] from t = ramp on, less in proportion before [s] */
    real mass;                      /* FREE [kg] */
    real inertia[DIM_MAX][DIM_MAX]; /* about the centre, at t = 0; along z in the plane [kg m^2] */
    real weight[DIM_MAX];           /* FREE: constant force at its centre [N] */
    real face;                      /* largest side of the box round it: 1, a length [m] or an area [m^2] */
    real centre[DIM_MAX], radius;   /* of mass (else of the box round it) and farthest point, at t = 0 [m] */

    real x[DIM_MAX];                      /* centre now [m] */
    real v[DIM_MAX], spin[DIM_MAX];       /* half a step behind [m/s], [1/s] */
    real angular[DIM_MAX];                /* angular momentum about the centre [kg m^2/s] */
    real turn[DIM_MAX][DIM_MAX];          /* rotation since t = 0 */
    real force[DIM_MAX], moment[DIM_MAX]; /* on it, about its centre, in the last step [N], [N m] */
    real force_most;                      /* largest so far [N] */
    real way[DIM_MAX];                    /* of the last step [m] */
    real force_before[DIM_MAX];           /* as the last step of `work` had it [N] */
    real work;                            /* done by what drives it, up to `force_before` [J] */
    real kinetic;                         /* 1/2 m v- . v+ of the last step [J] */
};

/* mass: FREE [kg], 0: none. REFUSED where a free body has no volume or no bounds. */
status rigid_make(struct rigid_body *r, const struct region *shape, int dim, real mass, const real *velocity,
                  real spacing);

/* May a point within `reach` of x be in it? A quick answer [m]. */
static inline bool rigid_may_reach(const struct rigid_body *r, const real *x, real reach)
{
    real far2 = 0;
    for (int d = 0; d < r->dim; d++) far2 += square(x[d] - r->x[d]);
    return r->motion == RIGID_FIXED || far2 <= square(r->radius + reach);
}

/* Distance of the point x from its surface, negative inside [m]; outward unit normal there. */
real rigid_distance(const struct rigid_body *r, const real *x, real *normal);

/* Where its point of t = 0 is now [m]. */
void rigid_place(const struct rigid_body *r, const real *X, real *x);

/* Velocity of the body at the point x [m/s]. */
void rigid_velocity(const struct rigid_body *r, const real *x, real *v);

/* Sets v to the velocity that a driven body has at time t [m/s]. */
void rigid_driven_velocity(const struct rigid_body *r, real t, real *v);

/* Way of a driven body up to time t, 0 of others; returns its length [m]. */
real rigid_shift(const struct rigid_body *r, real t, real *way);
/* Puts a driven body where it is at time t [s]; its way from where it was is booked with its work. */
void rigid_put(struct rigid_body *r, real t);

/* One step under `force` and `moment`. middle: t + dt/2 [s]; dt_velocity: since the time of the velocities [s]. */
void rigid_move(struct rigid_body *r, real middle, real dt, real dt_velocity);

/* Books the work of what drives it since the last call, up to the force of now. */
void rigid_book(struct rigid_body *r);
void rigid_note(struct rigid_body *r);       /* this force counts for the largest so far */
real rigid_work(const struct rigid_body *r); /* the same without booking it [J] */

/* Kinetic energy by the velocities of now [J], and what half a step under the force adds to it. */
real rigid_kinetic(const struct rigid_body *r);
real rigid_kick(const struct rigid_body *r, real dt);

status rigid_archive(struct rigid_body *r, int number, struct archive *a);

#endif
