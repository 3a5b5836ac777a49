/* Surfaces of rigid bodies as files beside the frames: frames/rigid_NNNNNN.vtp with their index rigid.vtp.series, for
 * ParaView and for pictures. */
#ifndef CLEAVE_RIGID_SURFACE
#define CLEAVE_RIGID_SURFACE

#include "output/output.h"
#include "rigid/rigid.h"

struct rigid_set;

/* Polygons on the surface of a region: segments in the plane, quadrilaterals in space. All arrays are owned. */
struct rigid_surface {
    int64_t points, faces;
    int corners;     /* of a face: 2 in the plane, 4 in space */
    real *X;         /* [points][DIM_MAX] [m] */
    int32_t *corner; /* [faces][corners] indices of points */
};

/* Approximates the surface of the region `shape` by polygons between points on the surface and stores them in *s. The
 * points are found with a grid of at most about 24 (in the plane 200) cells along the longest edge of the region. low,
 * high: corners of a box to which an unbounded region is cut [m]; dim: 2 or 3. Release with rigid_surface_free. */
void rigid_surface_approximate_by_polygons(struct rigid_surface *s, const struct region *shape, int dim,
                                           const real *low, const real *high);

/* Computes the box in which a rigid body of shape `shape` is shown. low, high: on entry the lower and upper corner of
 * the box of the particles, on return those of the box to show, dim components each [m]. A bounded body is shown in its
 * own bounding box. An unbounded one is cut to the box of the particles, widened on all sides by 0.08 of its longest
 * edge, and extended to the nearest part of the body if that is farther away. Returns true if the body is bounded. */
bool rigid_compute_plotting_box(const struct region *shape, int dim, real *low, real *high);

/* Releases the points and polygons in *s, which rigid_surface_approximate_by_polygons has allocated. */
void rigid_surface_free(struct rigid_surface *s);

/* Writes the surfaces and the motion of all rigid bodies at their present positions to a file beside the latest frame
 * (state at one time) of the whole body of o. Then writes the index of all such files anew. p: particles of the run;
 * an unbounded body is cut to the box of the particles. Does nothing without rigid bodies and in one dimension. Returns
 * FAILED if a file cannot be written. */
status rigids_write_surfaces_of_frame(struct rigid_set *rigid, const struct output *o, const struct particles *p);

/* Position and rotation of a rigid body in a frame: a point of the body that was at X at t = 0 is at x + turn (X -
 * centre) [m]. centre: centre of the body at t = 0 [m]; x: centre at the time of the frame [m]; turn: rotation matrix
 * [1]. */
struct rigid_placement {
    real centre[DIM_MAX], x[DIM_MAX], turn[DIM_MAX][DIM_MAX];
};

/* Reads the placements (positions and rotations) of `rigid_body_count` rigid bodies at frame `frame_number` from the
 * folder of a run into placement[rigid_body_count]. Returns false if there is no such file or it cannot be read, or if
 * it contains another number of bodies. */
bool rigids_read_placements_of_frame(struct rigid_placement *placement, int rigid_body_count, const char *folder,
                                     int frame_number);

#endif
