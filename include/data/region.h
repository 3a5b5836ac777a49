/* Regions (sets of points by constructive geometry), functions of time, cracks and initial waves, as the input file
 * defines them; set-up, loads and probes use them. Coordinates are reference positions [m]. */
#ifndef CLEAVE_REGION
#define CLEAVE_REGION

#include "base/base.h"
#include "data/solid.h"

/* ---- regions ----------------------------------------------------------------------------------------------------- */

/* Distance [spacings] from the surface of a region below which points count as being on the surface, i.e. as inside. */
#define ON_SURFACE 1e-8

/* Returns true if the point X (dim components [m]) is inside the region r or on its surface. tolerance: length by which
 * the region is enlarged on all sides before the test, reduced if negative [m]. */
bool region_contains(const struct region *r, const real *X, int dim, real tolerance);

/* Returns the length [m] by which the region r must be enlarged to contain the point X (dim components [m]): negative
 * inside the region, 0 on its surface, positive outside. The result is the least tolerance at which region_contains
 * returns true. */
real region_level_set_value(const struct region *r, const real *X, int dim);

/* Computes the corners `lower` and `upper` [m] of a box that contains the region r. The box may be too large, because
 * intersections and differences are ignored. Returns true if the box is finite, else false. */
bool region_compute_bounding_box_if_finite(const struct region *r, int dim, real lower[DIM_MAX], real upper[DIM_MAX]);

/* Returns the signed distance [m] of the point X (dim components [m]) from the surface of the region r, negative
 * inside. normal: receives the outward unit normal of the nearest surface. The distance from a single solid is exact
 * outside and beside flat faces; for several solids it is the distance from the nearest one. No box of the region may
 * have an infinite side. */
real region_signed_distance(const struct region *r, const real *X, int dim, real *normal);

/* Returns true if a box of the region r, also within a group of solids, has an infinite side, so that
 * region_signed_distance is not defined. */
bool region_has_box_with_infinite_side(const struct region *r, int dim);

/* Returns an upper bound [m] of how far the region r extends in a direction: of the scalar product X . direction over
 * all points X of the region. direction: unit vector, dim components. */
real region_support_function_bound(const struct region *r, const real *direction, int dim);

/* Returns the volume [m^dim] of the part of the region r inside the box between the corners `lower` and `upper` (dim
 * components [m]). It is computed by quasi-random sampling, with an error of about 0.1 % of the volume of the box. */
real region_volume_within_box(const struct region *r, int dim, const real *lower, const real *upper);

/* Builds search trees over consecutive solids of the region r that are all added or all subtracted, so that later
 * queries examine only solids near the point. The results of queries stay bitwise equal. The list of solids must not
 * change afterwards. */
void region_build_search_trees(struct region *r, int dim);

/* Releases all solids and the search trees of the region r. */
void region_free(struct region *r);

/* A list of n numbers value[n] in ascending order. */
struct number_list {
    int n;
    real *value;
};

/* ---- functions of time ------------------------------------------------------------------------------------------- */

/* Forms of a function of time; struct time_function has the formulas. */
enum time_kind { TIME_CONSTANT, TIME_STEP, TIME_PULSE, TIME_RAMP, TIME_TABLE };

/* A dimensionless factor of time:
 *   CONSTANT  1
 *   STEP      1 for from <= t < until, else 0
 *   PULSE     sin^2(pi (t - from) / (until - from)) inside, 0 outside
 *   RAMP      0 before from, linear to 1 at until, 1 after
 *   TABLE     piecewise linear through (t[k], value[k]); constant outside */
struct time_function {
    enum time_kind kind;
    real from, until; /* STEP, PULSE, RAMP: beginning and end [s] */
    int n;            /* TABLE: number of points */
    real *t, *value;  /* TABLE: [n] times [s], ascending; factors [1] */
};

/* Returns the value of the time function f, a dimensionless factor, at the time t [s]. */
real time_function_value(const struct time_function *f, real t);

/* Returns the integral [s] of the time function f, a dimensionless factor, over the time from 0 to t >= 0 [s]. */
real time_function_integral(const struct time_function *f, real t);

/* Returns the largest magnitude of the slope [1/s] of the time function f between the times 0 and `t_end` [s]; INFINITY
 * if f jumps there. */
real time_function_largest_slope_until(const struct time_function *f, real t_end);

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* A pre-crack: a point in 1D (corner[0]), a segment in 2D (corner[0..1]), a plane convex polygon in 3D. */
struct crack {
    int n;                   /* corners */
    real (*corner)[DIM_MAX]; /* [m] */
    real width;              /* width of a notch: its faces come into contact once they have approached by it [m] */
};

/* Returns true if the crack c cuts the bond between the reference positions `position` and `other_position` (dim
 * components each [m]). Exchanging the two positions never changes the result. A particle closer to the crack's plane
 * than 1e-9 crack lengths counts as on the positive side of the plane; a bond that passes exactly through the crack's
 * end is cut. */
bool crack_cuts_bond(const struct crack *c, const real *position, const real *other_position, int dim);

/* Tests quickly whether a particle at X (dim components [m]) is so far from the crack c that it can be skipped. Returns
 * false if the crack certainly cuts no bond of this particle of length `bond_length` [m] or less; true if the crack may
 * cut one. */
bool crack_may_cut_bonds_near(const struct crack *c, const real *X, real bond_length, int dim);

/* Computes the area vector [m^2] of the crack c in 3D, along its normal: half of the sum of cross products of
 * consecutive vectors from its first corner to the others (Newell). */
void crack_area_vector(const struct crack *c, real area[DIM_MAX]);

/* A plane of symmetry normal to a coordinate axis; the body is on one side of it. */
struct mirror_plane {
    int axis, outside; /* axis of its normal; side without body, -1 or +1 */
    real at;           /* position along the axis [m] */
};

/* Returns true if mirror images continue crack c beyond its end `end`, so that this end is no crack tip. This is so if
 * the end is on or beyond one of the planes of symmetry mirror_planes[mirror_count] and a corner of the crack is on the
 * inner side of this plane. tolerance: distance from a plane up to which a point is on it [m]. */
bool crack_end_is_continued_by_mirrors(const struct mirror_plane *mirror_planes, int mirror_count,
                                       const struct crack *c, const real *end, real tolerance);

/* Parts and mirror images of cracks: crack[k], k = 0 .. n - 1, is a part or an image of the original crack with index
 * of[k]. Both arrays are owned. */
struct crack_list {
    int n;
    struct crack *crack;
    int *of;
};

/* Computes into *list the parts of the cracks crack[crack_count] on the body's side of all planes of symmetry
 * mirror[mirror_count], and their mirror images within `image_reach` [m] of these planes. A bond across a plane and its
 * image are thus cut alike. tolerance: distance from a plane up to which a point is on it [m]. Release with
 * crack_list_free. */
void cracks_make_mirror_images(struct crack_list *list, const struct crack *crack, int crack_count,
                               const struct mirror_plane *mirror, int mirror_count, real image_reach, real tolerance);

/* Releases the cracks and the arrays of the list l. */
void crack_list_free(struct crack_list *l);

/* Returns the distance [m] of the point `point` from the segment between the points `segment_start` and `segment_end`
 * (dim components each [m]). */
real segment_distance_from_point(const real *segment_start, const real *segment_end, const real *point, int dim);

/* ---- waves ------------------------------------------------------------------------------------------------------- */

/* A plane wave in the initial state of a body. At t = 0 the particle velocity is `velocity` exp(-(xi/r)^2) along
 * `polarisation`, with xi = (X - at) . direction and r a quarter of the width. The wave travels along `direction` into
 * material at rest and leaves displaced material behind. It is longitudinal if the polarisation is along `direction`,
 * transverse if across. */
struct wave_pulse {
    real at[DIM_MAX];           /* centre [m] */
    real direction[DIM_MAX];    /* unit vector */
    real width;                 /* four radii r [m] */
    real velocity;              /* largest particle velocity [m/s] */
    real polarisation[DIM_MAX]; /* unit vector */
    bool transverse;
};

/* State of a plane wave at one position: velocity v [m/s] and displacement u [m] along the polarisation, and strain
 * du/dxi [1], where xi is the coordinate along the direction of travel. With the wave speed c, v = -c du/dxi. */
struct wave_state {
    real velocity, displacement, strain;
};

/* Returns velocity, displacement and strain of the plane wave w at time 0 and the position X (dim components [m]), in
 * material with the wave speed `wave_speed` [m/s]. */
struct wave_state wave_pulse_initial_state(const struct wave_pulse *w, const real *X, real wave_speed, int dim);

#endif
