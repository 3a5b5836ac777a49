/* Sets of points by constructive geometry, functions of time, cracks and waves: the terms of a scene that set-up, loads
 * and probes share. Coordinates are reference positions [m]. */
#ifndef CLEAVE_REGION
#define CLEAVE_REGION

#include "base/base.h"
#include "data/solid.h"

/* ---- regions ----------------------------------------------------------------------------------------------------- */

/* Distance from a surface below which points count as on it, and so inside [spacings]. */
#define ON_SURFACE 1e-8

/* Returns true if X is in the closed set grown by `tolerance` [m] (shrunk if negative). */
bool region_contains(const struct region *r, const real *X, int dim, real tolerance);

/* Returns the least tolerance at which region_contains is true [m]. */
real region_level(const struct region *r, const real *X, int dim);

/* Computes the bounding box from .. to [m], not reduced by intersections and differences. Returns false if it is
 * unbounded. */
bool region_bounds(const struct region *r, int dim, real from[DIM_MAX], real to[DIM_MAX]);

/* Returns the signed distance of X from the surface, negative inside [m], and its unit normal: exact outside each of
 * its solids and beside flat faces, for several solids the nearest. All sides of boxes must be finite. */
real region_distance(const struct region *r, const real *X, int dim, real *normal);

/* Returns true if a side of one of its boxes is infinite; such boxes have no distance. */
bool region_has_endless_box(const struct region *r, int dim);

/* Returns an upper bound of the scalar product X . along over all points X of the region [m]. along: unit vector, dim
 * components. */
real region_support(const struct region *r, const real *along, int dim);

/* Returns the volume within the box from .. to [m^dim] by quasi-random sampling, to about 0.1 % of the box. */
real region_volume(const struct region *r, int dim, const real *from, const real *to);

/* Builds an index of a long list, so that a point is compared with solids near it only, with bitwise equal results. The
 * list must not change afterwards. */
void region_build_index(struct region *r, int dim);

/* Releases all solids and the index. */
void region_free(struct region *r);

/* List of ascending numbers. */
struct number_list {
    int n;
    real *value;
};

/* ---- functions of time ------------------------------------------------------------------------------------------- */

enum time_kind { TIME_CONSTANT, TIME_STEP, TIME_PULSE, TIME_RAMP, TIME_TABLE };

/* A dimensionless factor of time:
 *   CONSTANT  1
 *   STEP      1 for from <= t < until, else 0
 *   PULSE     sin^2(pi (t - from) / (until - from)) inside, 0 outside
 *   RAMP      0 before from, linear to 1 at until, 1 after
 *   TABLE     piecewise linear through (t[k], value[k]); constant outside */
struct time_function {
    enum time_kind kind;
    real from, until; /* [s] */
    int n;
    real *t, *value; /* [s], [1] */
};

/* Returns the factor at t [s]. */
real time_function_value(const struct time_function *f, real t);

/* Returns the integral of the factor from 0 to t >= 0 [s]. */
real time_function_integral(const struct time_function *f, real t);

/* Returns the largest slope of the factor between 0 and t, INFINITY if it jumps there [1/s]. */
real time_function_largest_slope(const struct time_function *f, real t);

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* A pre-crack: a point in 1D (corner[0]), a segment in 2D (corner[0..1]), a plane convex polygon in 3D. */
struct crack {
    int n;                   /* corners */
    real (*corner)[DIM_MAX]; /* [m] */
    real width;              /* width of a notch: its faces touch once their distance has decreased by this [m] */
};

/* Returns true if the crack cuts the bond between reference positions a and b. Symmetric in a and b to the last bit. A
 * particle closer to the crack's plane than 1e-9 crack lengths counts as on its positive side; a bond that passes
 * exactly through the crack's end is cut. */
bool crack_cuts(const struct crack *c, const real *a, const real *b, int dim);

/* Returns false if the crack cuts no bond of a particle at X that is at most `reach` long [m]. Quick, for far
 * particles. */
bool crack_may_cut_near(const struct crack *c, const real *X, real reach, int dim);

/* Computes the area of a crack in 3D as a vector along its normal [m^2]: half of the sum of cross products of
 * consecutive vectors from its first corner to the others (Newell). */
void crack_area_vector(const struct crack *c, real area[DIM_MAX]);

/* A plane of symmetry; the body is on one side. */
struct mirror_plane {
    int axis, outside; /* axis of its normal; side without body, -1 or +1 */
    real at;           /* position along the axis [m] */
};

/* Returns true if the crack reaches X on or beyond a plane of symmetry (within `tolerance` [m]) from inside: it
 * continues there as its image, so X is not a crack end. */
bool mirrors_continue_crack(const struct mirror_plane *m, int mirrors, const struct crack *c, const real *X,
                            real tolerance);

/* Cracks; of[k]: index of the crack of which crack k is a part or an image. */
struct crack_list {
    int n;
    struct crack *crack;
    int *of;
};

/* Computes the parts of the cracks within a body with planes of symmetry, and their mirror images within `reach` [m] of
 * these planes, so that a bond across a plane and its image are cut alike. Release with crack_list_free. */
void cracks_mirrored(struct crack_list *to, const struct crack *crack, int cracks, const struct mirror_plane *m,
                     int mirrors, real reach, real tolerance);

/* Releases the cracks. */
void crack_list_free(struct crack_list *l);

/* Returns the distance of X from the segment from .. to [m]. */
real segment_distance(const real *from, const real *to, const real *X, int dim);

/* ---- waves ------------------------------------------------------------------------------------------------------- */

/* A plane wave: at t = 0 v = velocity exp(-(xi/r)^2) along `polarisation`, xi = (X - at) . direction, r a quarter of
 * the width. It travels along `direction` into material at rest and leaves displaced material behind. Polarisation
 * along the direction: longitudinal wave; across it: transverse wave. */
struct wave_pulse {
    real at[DIM_MAX];           /* centre [m] */
    real direction[DIM_MAX];    /* unit vector */
    real width;                 /* four radii r [m] */
    real velocity;              /* largest particle velocity [m/s] */
    real polarisation[DIM_MAX]; /* unit vector */
    bool transverse;
};

/* Velocity [m/s] and displacement [m] along the polarisation, and strain du/dxi [1], with v = -c du/dxi. */
struct wave_state {
    real velocity, displacement, strain;
};

/* Returns the state of the wave at X at t = 0, in material of wave speed c [m/s]. */
struct wave_state wave_pulse_at(const struct wave_pulse *w, const real *X, real c, int dim);

#endif
