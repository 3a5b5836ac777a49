/* Hulls: surfaces of triangles in 3D or of segments in 2D, with inside test, distance and outward normal.
 *
 * Outward normals: corners of a triangle run counter-clockwise as seen from outside; the body is on the left of a
 * segment. The winding number (a sum of solid angles over 4 pi; in 2D of angles over 2 pi) is 1 inside and 0 outside a
 * closed surface, and in between near a hole: a body with small holes is still filled as one would expect (Jacobson,
 * Kavan, Sorkine-Hornung 2013). Far faces are summed as dipoles (Barill et al. 2018). */
#ifndef CLEAVE_HULL
#define CLEAVE_HULL

#include "base/base.h"

/* Node of a tree over the faces first .. first + count - 1, divided between the nodes `left` and `left` + 1; left = 0:
 * leaf. */
struct hull_node {
    real low[DIM_MAX], high[DIM_MAX]; /* box round its faces [m] */
    real centre[DIM_MAX];             /* centroid of its faces, weighted by area [m] */
    real moment[DIM_MAX];             /* sum of area vectors [m^2]; of segments [m] */
    /* first face and number of faces; first of the two child nodes, 0: a leaf */
    int32_t first, count, left;
};

/* A surface of triangles (3D) or segments (2D) with a search tree over them. All arrays are owned. */
struct hull {
    int dim;
    int64_t corners, faces;   /* lengths of `corner`, `face` */
    real (*corner)[DIM_MAX];  /* [m] */
    int32_t (*face)[DIM_MAX]; /* corners of a face, the first `dim` are used */
    int32_t nodes;
    struct hull_node *node; /* node[0] contains all faces */
    bool open;              /* has no inside: distances are positive */
    /* findings of hull_make */
    int64_t open_edges;    /* edges of faces that no other face continues; in 2D: end points */
    real open_at[DIM_MAX]; /* the middle of one of them [m] */
    int64_t shells;        /* connected components */
    int64_t dropped;       /* faces without area, and duplicates */
    bool reversed;         /* the normals pointed inwards and were reversed */
    real volume;           /* by the divergence theorem [m^3]; in 2D area [m^2] */
};

enum { HULL_CORNERS_MAX = INT32_MAX / 4 };

/* Creates a closed surface from `faces` faces of `dim` corners; takes ownership of both arrays (memory_new). Faces
 * shared by two elements cancel, faces without area are removed, a surface with inward normals is reversed. Release
 * with hull_free. */
void hull_make(struct hull *s, int dim, int64_t corners, real (*corner)[DIM_MAX], int64_t faces,
               int32_t (*face)[DIM_MAX]);

/* Creates an open surface from faces as they are; with equal corners a face is a line or a point. Ownership as
 * hull_make. */
void hull_make_open(struct hull *s, int dim, int64_t corners, real (*corner)[DIM_MAX], int64_t faces,
                    int32_t (*face)[DIM_MAX]);

/* Releases all arrays. */
void hull_free(struct hull *s);

/* Returns the winding number of the surface around X [1]. */
real hull_winding_number(const struct hull *s, const real *X);

/* Returns the signed distance of X, negative inside [m]. normal: NULL, or the unit vector away from the surface,
 * outwards. */
real hull_distance(const struct hull *s, const real *X, real *normal);

/* Returns hull_distance(s, X, NULL) <= most, without searching faces farther away than that. */
bool hull_is_within(const struct hull *s, const real *X, real most);

/* Returns the maximum of the scalar product X . along over the corners X of the hull [m] (support function). along:
 * unit vector. */
real hull_support(const struct hull *s, const real *along);

/* Returns the share of about 4000 sample points of its box at which the winding number is ambiguous [1]. */
real hull_ambiguous_share(const struct hull *s);

/* Builds the tree and sorts the faces; part of hull_make (hull_tree.c). */
void hull_build_face_tree(struct hull *s);

/* Computes the area vector of face k [m^2]; of a segment its length times its normal [m]. */
void hull_face_area(const struct hull *s, int64_t k, real area[DIM_MAX]);

#endif
