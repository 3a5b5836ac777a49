/* Sets of points by constructive geometry, functions of time, and cracks: the plain words that a
 * scene is made of and that set-up, loads and probes share. Coordinates are reference positions [m]. */
#ifndef CLEAVE_REGION
#define CLEAVE_REGION

#include "base/base.h"
#include "data/solid.h"

/* ---- regions ----------------------------------------------------------------------------------------------------- */

/* Points this close to a surface count as on it, and so inside [spacings]. */
#define ON_SURFACE 1e-8

/* Closed set, grown by `tolerance` [m] (shrunk where negative). */
bool region_contains(const struct region *r, const real *X, int dim, real tolerance);
/* region_contains holds where this is no more than the tolerance [m]. */
real region_level(const struct region *r, const real *X, int dim);

/* Box round it, the smallest but for what intersections and differences cut off; returns false if it is unbounded. */
bool region_bounds(const struct region *r, int dim, real from[DIM_MAX], real to[DIM_MAX]);
/* Signed distance of X from the surface, negative inside [m]: exact outside each of its solids and beside flat faces,
 * of several solids the nearest; and the unit normal that leads away. All sides of boxes are finite. */
real region_distance(const struct region *r, const real *X, int dim, real *normal);
/* Is a side of one of its boxes infinite? Such boxes have no distance. */
bool region_has_endless_box(const struct region *r, int dim);
/* max over its points of X . along, at most [m]. */
real region_support(const struct region *r, const real *along, int dim);
/* Volume in the box from..to [m^dim] by evenly spread points: within about 0.1 % of the box. */
real region_volume(const struct region *r, int dim, const real *from, const real *to);
/* Makes an index of a long list, by which a point is compared with what is near it only: the same results, to the last
 * bit. The list stays as it is from then on. */
void region_index(struct region *r, int dim);
void region_free(struct region *r);

/* Ascending numbers. */
struct number_list {
    int n;
    real *value;
};

/* ---- functions of time ------------------------------------------------------------------------------------------- */

enum time_kind { TIME_CONSTANT, TIME_STEP, TIME_PULSE, TIME_RAMP, TIME_TABLE };

/* A dimensionless factor:
 *   CONSTANT  1
 *   STEP      1 for from <= t < until, else 0
 *   PULSE     sin^2(pi (t - from) / (until - from)) inside, 0 outside
 *   RAMP      0 before from, linear to 1 at until, 1 after
 *   TABLE     piecewise linear through (t[k], value[k]); the end values are held */
struct time_function {
    enum time_kind kind;
    real from, until; /* [s] */
    int n;
    real *t, *value; /* [s], [1] */
};

real time_function_at(const struct time_function *f, real t);
/* Its integral from 0 to t >= 0 [s]. */
real time_function_integral(const struct time_function *f, real t);
/* Its largest slope between 0 and t, INFINITY where it jumps there [1/s]. */
real time_function_steepest(const struct time_function *f, real t);

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* A pre-crack: a point in 1D (corner[0]), a segment in 2D (corner[0..1]), a plane convex polygon in 3D. */
struct crack {
    int n;                   /* corners */
    real (*corner)[DIM_MAX]; /* [m] */
    real width;              /* of a notch: its faces meet once they are so much nearer [m] */
};

/* Does the crack cut the bond between two reference positions? Symmetric in a and b to the last bit. A
 * particle closer to the crack's plane than 1e-9 lengths counts as on its positive side; a bond that passes
 * exactly through a crack's end is cut. */
bool crack_cuts(const struct crack *c, const real *a, const real *b, int dim);
/* False: it cuts no bond of a particle at X that is no longer than `reach` [m]. Quick, for the many that are far
 * away. */
bool crack_near(const struct crack *c, const real *X, real reach, int dim);

/* Area of a crack in space as a vector along its normal: half of the sum of the cross products of the ways to its
 * corners from the first one (Newell) [m^2]. */
void crack_area_vector(const struct crack *c, real area[DIM_MAX]);

/* A plane of symmetry; the body is on one side of it. */
struct mirror_plane {
    int axis, outside; /* of its normal; side without body, -1 or +1 */
    real at;           /* [m] */
};

/* Does the crack come from inside to X on a plane of symmetry, to the tolerance [m], or beyond it? There it goes on as
 * its image: that is no end of it. */
bool mirrors_continue(const struct mirror_plane *m, int mirrors, const struct crack *c, const real *X, real tolerance);

/* Cracks and, for each, the number of the crack that it is or is an image of. */
struct crack_list {
    int n;
    struct crack *crack;
    int *of;
};

/* What of the cracks lies in a body with planes of symmetry, and behind it the mirror images of what is within `reach`
 * [m] of them: a bond across a plane and its own image are then cut alike. */
void cracks_mirrored(struct crack_list *to, const struct crack *crack, int cracks, const struct mirror_plane *m,
                     int mirrors, real reach, real tolerance);
void crack_list_free(struct crack_list *l);

/* Distance of X from the segment from..to [m]. */
real segment_distance(const real *from, const real *to, const real *X, int dim);

/* ---- waves ------------------------------------------------------------------------------------------------------- */

/* A plane wave: at t = 0 v = velocity exp(-(xi/r)^2) along `polarisation`, xi = (X - at) . direction, r a quarter of
 * the width. It moves along `direction` into material at rest and leaves displaced material behind. Its particles
 * move along or across its direction: a longitudinal or a transverse wave. */
struct wave_pulse {
    real at[DIM_MAX];           /* centre [m] */
    real direction[DIM_MAX];    /* unit vector */
    real width;                 /* four radii r [m] */
    real velocity;              /* of particles, largest [m/s] */
    real polarisation[DIM_MAX]; /* unit vector */
    bool transverse;
};

/* Velocity along the polarisation [m/s], displacement along it [m] and its slope du/dxi [1] at X, in material of
 * wave speed c [m/s]: v = -c du/dxi. */
struct wave_state {
    real velocity, displacement, strain;
};
struct wave_state wave_pulse_at(const struct wave_pulse *w, const real *X, real c, int dim);

#endif
