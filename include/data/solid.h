/* Solids, the elements of regions: their kinds, motions and copies, and the region itself. To add a kind, add a row to
 * the table of kinds (src/data/solid_kinds.h): its distance and support function. */
#ifndef CLEAVE_SOLID
#define CLEAVE_SOLID

#include "base/base.h"
#include "data/box_tree.h"
#include "data/hull.h"
#include "data/voxels.h"

/* Kinds of solids; SOLID_KINDS is their number. */
enum solid_kind {
    SOLID_ALL,
    SOLID_BOX,
    SOLID_BALL,
    SOLID_CYLINDER,
    SOLID_HALF_SPACE,
    SOLID_ELLIPSOID,
    SOLID_RING,
    SOLID_POLYGON,
    SOLID_TUBE,
    SOLID_CONE,
    SOLID_TORUS,
    SOLID_HULL,      /* a surface from a file: its inside, or the points near it */
    SOLID_VOXELS,    /* an image: where it has certain grey values */
    SOLID_EXTRUSION, /* a plane region, extruded */
    SOLID_GROUP,     /* a region as a solid */
    SOLID_KINDS
};

/* Kinds of motions by which copies of a solid are placed. */
enum motion_kind { MOTION_MOVE, MOTION_ROTATE, MOTION_MIRROR, MOTION_GRID, MOTION_RING };

/* A motion by which copies of a solid are placed; it acts on all copies made by previous motions. */
struct solid_motion {
    enum motion_kind kind;               /* capitals below: kinds that use a member */
    real step[DIM_MAX];                  /* MOVE: displacement; GRID: distance of copies in each direction [m] */
    real about[DIM_MAX];                 /* ROTATE, RING: a point of the axis; MIRROR: a point of the plane [m] */
    real axis[DIM_MAX];                  /* ROTATE, RING: axis of any length, unused in 2D; MIRROR: normal */
    real angle;                          /* ROTATE: angle, in 2D from x to y; RING: angle between copies [rad] */
    real count[DIM_MAX];                 /* GRID: copies in each direction; RING: count[0] [1] */
    bool keep;                           /* MIRROR: the solid itself is kept beside its image */
    bool has_about, has_axis, has_angle; /* given in the scene */
};

/* Placement of a copy of a solid: X = turn X' + shift for points X' of the solid as described. det turn = -1: a mirror
 * image. */
struct placement {
    real turn[DIM_MAX][DIM_MAX], shift[DIM_MAX]; /* [1], [m] */
};
#define IMAGES_MOST 4096

/* A set of points, made from the solids solid[n] in the order of the list by union, difference and intersection. It
 * begins with no points, or with all points if the first solid is to be intersected. An empty list means all points. A
 * run is a sequence of consecutive solids of the list that are all added or all subtracted
 * (region_build_search_trees). */
struct region {
    int n;
    struct solid *solid;
    int runs;               /* number of runs; 0: no index (region_build_search_trees) */
    struct region_run *run; /* [runs] */
};

/* A sequence (run) of consecutive solids of a region, number first .. first + count - 1, which are all added or all
 * subtracted. tree: search tree over their bounding boxes; empty for a single solid. */
struct region_run {
    int first, count;
    struct box_tree tree;
};

/* A round corner of a polygon: an arc around `centre` from the end of one edge to the beginning of the next [m]. */
struct bend {
    real centre[2], from[2], to[2];
};

/* A polygon in the plane with n corners, whose edges do not cross and whose corners may be rounded. */
struct polygon {
    int n;
    real (*corner)[2]; /* as given in the scene [m] */
    real round;        /* corner radius [m] */
    struct bend *bend; /* [n]; NULL: sharp corners */
    real sense;        /* sense of the corners: 1 counter-clockwise (x to y), -1 clockwise */
};

/* A solid. `kind` determines which of the members describe it; in 2D a disc is a BALL. Sides of a box may be infinite.
 * A solid can have copies, which follow from its motions (translations, rotations, reflections, grids, rings). */
struct solid {
    enum solid_kind kind;
    bool subtract;                   /* subtracted from the union so far */
    bool intersect;                  /* intersected with the union so far */
    real from[DIM_MAX], to[DIM_MAX]; /* corners of a box; ends of the axis of a cylinder, tube or cone [m] */
    real centre[DIM_MAX], radius;    /* of ball, ring, torus; radius also of cylinder, tube and cone (at `from`) [m] */
    real point[DIM_MAX], normal[DIM_MAX]; /* half-space: (X - point) . normal <= 0; normal: also axis of a torus */
    real radii[DIM_MAX];                  /* ellipsoid: half axes along x, y, z [m] */
    real inner; /* inner radius of a tube or ring; radius of a cone at `to`; radius of the section of a torus [m] */
    int axis;   /* extrusion: axis along which the section is extruded */
    real begin, end;         /* extrusion: lower and upper coordinate along the axis [m] */
    struct region region;    /* section of an extrusion (in the other two axes, in order), or solids of a group */
    struct polygon *polygon; /* polygon: its corners; owned */
    const struct hull *hull; /* surface of a file: its triangles; borrowed. Open: all points within `radius` */
    const struct voxel_solid *voxels; /* image: range of grey values; borrowed from the scene */
    int motions, images;              /* numbers; images 0: one copy, where the members above place it */
    struct solid_motion *motion;      /* [motions] rules for copies, as given in the scene; owned */
    struct placement *image;          /* [images] position and orientation of each copy; owned */
    struct box_tree tree;             /* search tree over the bounding boxes of the copies */
};

/* Returns true if the solid s is of the kind `kind` and has not been moved or copied, so that its members (from, to,
 * radius, ...) describe its actual position. */
static inline bool solid_is_untransformed_and_of_kind(const struct solid *s, enum solid_kind kind)
{
    return s->kind == kind && s->images == 0;
}

/* Returns the signed distance [m] of the point X (dim components [m]) from the surface of the solid s, negative inside;
 * exact outside. normal: receives the outward unit normal of the nearest surface point. */
real solid_signed_distance(const struct solid *s, const real *X, int dim, real *normal);

/* Returns the level [m] of the solid s at the point X (dim components [m]): negative inside the solid, 0 on its surface
 * and positive outside. Beside a flat face it is the signed distance. For boxes and cylinders it is the largest of the
 * signed distances from the planes and the mantle that bound them. The points whose level is below a tolerance thus
 * form a larger box or cylinder with sharp edges. */
real solid_level_set_value(const struct solid *s, const real *X, int dim);

/* Returns true if the level of the solid s at the point X (dim components [m]) is at most `max_distance` [m]. The level
 * is negative inside the solid, 0 on its surface and positive outside (solid_level_set_value). This function is faster
 * than computing the level. */
bool solid_level_set_is_at_most(const struct solid *s, const real *X, int dim, real max_distance);

/* Computes into *box a box, slightly enlarged, that contains the solid s with all its copies, for use in a
 * search tree (box_tree_make). Sides on which the solid is unbounded are infinite. dim: dimension of the body. */
void solid_bounding_box(const struct solid *s, int dim, struct bounds *box);

/* Returns how far the solid s extends in a direction (support function): the maximum [m] of the scalar product X .
 * direction over its points X. direction: unit vector, dim components. */
real solid_support_function(const struct solid *s, const real *direction, int dim);

/* Returns the radius [m] of the solid s if it is a ball, cylinder, tube or ring, or the smallest half axis of an
 * ellipsoid; INFINITY for all other kinds. dim: dimension of the body. */
real solid_radius_if_round(const struct solid *s, int dim);

/* Returns the smallest thickness [m] of the solid s, where it follows directly from the members of s: the diameter of a
 * ball or cylinder, the smallest axis of an ellipsoid, the wall of a tube or ring, the diameter of the section of a
 * torus; INFINITY for all other kinds. */
real solid_least_thickness(const struct solid *s, int dim);

/* Applies the motion `motion` to all present copies of the solid s: moves, rotates or reflects them, or multiplies them
 * on a grid or a ring. Appends `motion` to s->motion. dim: dimension of the body. Returns true, or false without any
 * change if there would be more than IMAGES_MOST copies. */
bool solid_apply_motion_unless_too_many_copies(struct solid *s, const struct solid_motion *motion, int dim);

/* Returns an upper bound [m] of the distance, along any axis, between the bounding box of a solid and a point at which
 * the level (solid_level_set_value) is `level_set_value` [m]: 1.75 `level_set_value`, because outside the solid a level
 * is at least 1/sqrt(3) of the distance (beside the corner of a box); a negative level is returned as it is. */
static inline real solid_distance_upper_bound_from_level_set(real level_set_value)
{
    return level_set_value > 0 ? 1.75 * level_set_value : level_set_value;
}

/* Returns an estimate of the cost of one query of the solid s, divided by that of a simple solid such as a ball: adds
 * up all copies, the solids of a group, and the edges of a polygon. */
real solid_query_cost_relative_to_ball(const struct solid *s);

/* Releases the arrays, the polygon and the region that the solid s owns. */
void solid_free(struct solid *s);

/* Faults of a polygon: none (FINE), an edge without length (SHORT), no area (FLAT), crossing edges (CROSSED), an edge
 * too short for the corner radius (TIGHT). */
enum polygon_fault { POLYGON_FINE, POLYGON_SHORT, POLYGON_FLAT, POLYGON_CROSSED, POLYGON_TIGHT };

/* Checks the polygon p and computes its orientation (p->sense) and the arcs of its rounded corners (p->bend) from its
 * corners and corner radius. Returns POLYGON_FINE or the fault that was found. *faulty_corner receives the number of
 * the corner at which the fault is, if it is at a corner. */
enum polygon_fault polygon_check_and_compute_rounded_corners(struct polygon *p, int *faulty_corner);

#endif
