/* Hulls: surfaces of triangles in space and of segments in the plane: is a point inside, how far from it, which way
 * out.
 *
 * Outward normals: corners of a triangle run counter-clockwise as seen from outside; the body is on the left of a
 * segment. The winding number (a sum of solid angles, over 4 pi; of angles, over 2 pi in the plane) is 1 inside and 0
 * outside a closed surface, and in between where a hole is near: a body with small holes still fills as one would
 * expect (Jacobson, Kavan, Sorkine-Hornung 2013). Far faces are summed by their dipoles (Barill et al. 2018). */
#ifndef CLEAVE_HULL
#define CLEAVE_HULL

#include "base/base.h"

/* Part of the tree: faces first .. first + count - 1, halved into the nodes `left` and `left` + 1; leaf: left = 0. */
struct hull_node {
    real low[DIM_MAX], high[DIM_MAX]; /* box round its faces [m] */
    real centre[DIM_MAX];             /* of their areas [m] */
    real moment[DIM_MAX];             /* sum of area vectors [m^2]; of segments [m] */
    int32_t first, count, left;
};

struct hull {
    int dim;
    int64_t corners, faces;
    real (*corner)[DIM_MAX];  /* [m] */
    int32_t (*face)[DIM_MAX]; /* its corners, `dim` of them */
    int32_t nodes;
    struct hull_node *node; /* node[0]: all */
    bool open;              /* has no inside: distances from it are positive */
    /* what was found in a closed one */
    int64_t open_edges;    /* sides of faces that no other face continues; in the plane: ends */
    real open_at[DIM_MAX]; /* the middle of one of them [m] */
    int64_t shells;        /* connected parts */
    int64_t dropped;       /* faces without area, and given twice */
    bool reversed;         /* its normals pointed inwards */
    real volume;           /* by the divergence theorem [m^3]; in the plane area [m^2] */
};

enum { HULL_CORNERS_MAX = INT32_MAX / 4 };

/* A closed surface from `faces` faces of `dim` corners each, which it takes over (memory_new). Faces that two elements
 * share cancel, those without area go; one that is inside out is turned. */
void hull_make(struct hull *s, int dim, int64_t corners, real (*corner)[DIM_MAX], int64_t faces,
               int32_t (*face)[DIM_MAX]);
/* Faces as they are, without an inside; with equal corners one is a line or a point. */
void hull_make_open(struct hull *s, int dim, int64_t corners, real (*corner)[DIM_MAX], int64_t faces,
                    int32_t (*face)[DIM_MAX]);
void hull_free(struct hull *s);

real hull_winding(const struct hull *s, const real *X);
/* Signed distance of X, negative inside [m]. normal (may be NULL): away from the surface, outwards. */
real hull_distance(const struct hull *s, const real *X, real *normal);
/* hull_distance(s, X, NULL) <= most, without a search for faces farther away than that. */
bool hull_within(const struct hull *s, const real *X, real most);
/* max over its corners of X . along [m]. */
real hull_support(const struct hull *s, const real *along);
/* Share of places in its box at which the winding number does not say whether they are inside; about 4000 are asked. */
real hull_doubt(const struct hull *s);

/* Parts of it: the tree (hull_tree.c). Orders the faces. */
void hull_tree_make(struct hull *s);
/* Area vector of face k [m^2]; of a segment its length times its normal [m]. */
void hull_area(const struct hull *s, int64_t k, real area[DIM_MAX]);

#endif
