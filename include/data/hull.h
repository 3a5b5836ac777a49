/* Hulls: surfaces of triangles in 3D or of segments in 2D, with inside test, distance and outward normal.
 *
 * Outward normals: corners of a triangle run counter-clockwise as seen from outside; the body is on the left of a
 * segment. The winding number (a sum of solid angles over 4 pi; in 2D of angles over 2 pi) is 1 inside and 0 outside a
 * closed surface, and in between near a hole: a body with small holes is still filled as one would expect (Jacobson,
 * Kavan, Sorkine-Hornung 2013). Far faces are summed as dipoles (Barill et al. 2018). */
#ifndef CLEAVE_HULL
#define CLEAVE_HULL

#include "base/base.h"

/* Node of the search tree over the faces of a surface, with the faces first .. first + count - 1. These faces are
 * divided between the child nodes number `left` and left + 1; left = 0 for a leaf, which has no child nodes. */
struct hull_node {
    real low[DIM_MAX], high[DIM_MAX]; /* box round its faces [m] */
    real centre[DIM_MAX];             /* centroid of its faces, weighted by area [m] */
    real moment[DIM_MAX];             /* sum of area vectors [m^2]; of segments [m] */
    /* first face and number of faces; first of the two child nodes, 0: a leaf */
    int32_t first, count, left;
};

/* A surface of triangles (dim = 3) or segments (dim = 2) with a search tree of `nodes` nodes over them. All arrays are
 * owned. */
struct hull {
    int dim;
    int64_t corners, faces;   /* lengths of `corner`, `face` */
    real (*corner)[DIM_MAX];  /* [corners] positions [m] */
    int32_t (*face)[DIM_MAX]; /* [faces] indices of the corners of a face, the first `dim` are used */
    int32_t nodes;
    struct hull_node *node; /* [nodes] of the search tree; node[0] contains all faces */
    bool open;              /* the surface has no inside: all distances are positive */
    /* findings of hull_make_closed_surface */
    int64_t open_edges;    /* edges of faces that belong to no second face; in 2D: end points */
    real open_at[DIM_MAX]; /* the middle of one of these edges [m] */
    int64_t shells;        /* number of connected components of the surface */
    int64_t dropped;       /* number of faces left out: without area, or duplicates */
    bool reversed;         /* the normals pointed inwards and were reversed */
    real volume;           /* enclosed volume by the divergence theorem [m^3]; in 2D enclosed area [m^2] */
};

/* Largest number of corners of a surface, since faces have 32-bit indices. */
enum { HULL_CORNERS_MAX = INT32_MAX / 4 };

/* Creates the closed surface in 3D (dim 3) or 2D (dim 2) from corner_positions[corner_count] [m] and
 * face_corners[face_count], the numbers of the `dim` corners of each face. The hull takes ownership of both arrays,
 * which memory_new must have allocated. Pairs of coincident opposite faces, as between two elements of a mesh, and
 * faces without area are removed; a surface with inward normals is reversed. Faults of the surface, such as open edges,
 * are stored in *hull. Release with hull_free. */
void hull_make_closed_surface(struct hull *hull, int dim, int64_t corner_count, real (*corner_positions)[DIM_MAX],
                              int64_t face_count, int32_t (*face_corners)[DIM_MAX]);

/* Creates the open surface, which has no inside, from corner_positions[corner_count] [m] and face_corners[face_count],
 * the numbers of the `dim` corners of each face. The faces are not changed: none is removed or reversed, and a face
 * with equal corners is a line or a point. The hull takes ownership of both arrays, which memory_new must have
 * allocated. Release with hull_free. */
void hull_make_open_surface(struct hull *hull, int dim, int64_t corner_count, real (*corner_positions)[DIM_MAX],
                            int64_t face_count, int32_t (*face_corners)[DIM_MAX]);

/* Releases all arrays of the surface s. */
void hull_free(struct hull *hull);

/* Returns the winding number of the surface around the point X (hull->dim components [m]): 1 inside and 0 outside a
 * closed surface with outward normals, in between near a hole. */
real hull_winding_number(const struct hull *hull, const real *X);

/* Returns the signed distance [m] of the point X (hull->dim components [m]) from the surface, negative inside (an open
 * surface has no inside); INFINITY if the hull has no faces. normal: NULL, or receives the unit vector that points away
 * from the surface, outwards. */
real hull_signed_distance(const struct hull *hull, const real *X, real *normal);

/* Returns true if the signed distance of the point X (hull->dim components [m]) from the surface, negative inside, is
 * at most `max_distance` [m]. This function is faster than hull_signed_distance, because faces farther away are not
 * examined. */
bool hull_point_is_within_distance(const struct hull *hull, const real *X, real max_distance);

/* Returns true if the closed surface is convex near the point X (hull->dim components [m]): no face at most `reach` [m]
 * away is in front of another such face. A straight line from X, if X is inside, to another inside point at most
 * `reach` away is then completely inside. Returns false for an open surface or one with holes, and where more than 100
 * faces are that near. */
bool hull_is_convex_near_point(const struct hull *hull, const real *X, real reach);

/* Returns how far the surface extends in a direction (support function): the maximum [m] of the scalar product X .
 * direction over its corners X. direction: unit vector, hull->dim components. */
real hull_support_function(const struct hull *hull, const real *direction);

/* Findings at about 4000 sample points in the bounding box of a surface. unclear: share of the points at which inside
 * and outside cannot be distinguished [1]: the winding number there is farther than 0.3 from any integer, or below
 * -0.3; enclosed_again: volume inside more than one of the shells (connected parts of the surface), counted once for
 * each shell but one [m^3], in 2D area [m^2]. */
struct hull_samples {
    real unclear, enclosed_again;
};

/* Computes winding numbers at about 4000 points in the bounding box of the surface and returns what they show: the
 * share of points at which inside and outside cannot be distinguished, and the volume that is enclosed more than once.
 * Both are 0 for a closed surface whose normals point outwards (at a cavity, into the cavity) and whose shells
 * (connected parts) neither overlap nor are inside each other. */
struct hull_samples hull_sample_winding_number_statistics(const struct hull *hull);

/* Builds hull->node, the search tree over the faces of the surface, and sorts hull->face so that the faces of each tree
 * node are consecutive. Corners and faces must be set before. Part of hull_make_closed_surface. */
void hull_build_face_search_tree(struct hull *hull);

/* Computes area_vector, the area vector of face number `face` of the hull: outward normal times area [m^2]; in 2D,
 * where a face is a segment, outward normal times length [m]. */
void hull_compute_face_area_vector(const struct hull *hull, int64_t face, real area_vector[DIM_MAX]);

#endif
