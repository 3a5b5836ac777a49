/* Solids, of which regions are built: their kinds, what they are moved, turned and repeated by, and the region itself.
 * A further kind is a row in the table of kinds (src/data/solid_kinds.h): its distance and how far it reaches. */
#ifndef CLEAVE_SOLID
#define CLEAVE_SOLID

#include "base/base.h"
#include "data/box_tree.h"
#include "data/hull.h"
#include "data/voxels.h"

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
    SOLID_HULL,      /* a surface from a file: what it encloses, or what is near it */
    SOLID_VOXELS,    /* an image: where it has certain grey values */
    SOLID_EXTRUSION, /* a region of the plane, drawn out */
    SOLID_GROUP,     /* a region */
    SOLID_KINDS
};

/* What a solid of n copies is made to; each acts on all that the ones before it have made. */
enum motion_kind { MOTION_MOVE, MOTION_ROTATE, MOTION_MIRROR, MOTION_GRID, MOTION_RING };
struct solid_motion {
    enum motion_kind kind;
    real step[DIM_MAX];                  /* MOVE: by this; GRID: from one copy to the next in each direction [m] */
    real about[DIM_MAX];                 /* ROTATE, RING: a point of the axis; MIRROR: of the plane [m] */
    real axis[DIM_MAX];                  /* ROTATE, RING: of any length, unused in the plane; MIRROR: normal */
    real angle;                          /* ROTATE: about the axis, in the plane from x to y; RING: between copies */
    real count[DIM_MAX];                 /* GRID: copies in each direction; RING: count[0] [1] */
    bool keep;                           /* MIRROR: the solid itself stays beside its image */
    bool has_about, has_axis, has_angle; /* the scene gives them */
};

/* Where a copy of a solid is: X = turn X' + shift of the X' of the solid as described. */
struct placement {
    real turn[DIM_MAX][DIM_MAX], shift[DIM_MAX]; /* [1], [m]; det turn = -1 of a mirror image */
};
#define IMAGES_MOST 4096

/* Union, difference and intersection in the order of the list, which begins with nothing, or where its first solid is
 * to be intersected with everything. An empty list means everywhere. */
struct region {
    int n;
    struct solid *solid;
    int runs;               /* 0: without an index (region_index) */
    struct region_run *run; /* [runs] */
};

/* Solids of a list one after another that are all added or all taken away, and a tree over their boxes; or a single
 * solid, without a tree. */
struct region_run {
    int first, count;
    struct box_tree tree;
};

/* A round corner of a polygon: from the end of one edge to the beginning of the next about a centre. */
struct bend {
    real centre[2], from[2], to[2];
};

/* A polygon whose edges do not cross. */
struct polygon {
    int n;
    real (*corner)[2]; /* as the scene gives them [m] */
    real round;        /* radius of its corners [m] */
    struct bend *bend; /* [n]; NULL: corners are sharp */
    real sense;        /* 1: corners go round from x to y; -1 */
};

/* A disc of the plane is a BALL. Bounds of a box may be infinite. */
struct solid {
    enum solid_kind kind;
    bool subtract;                   /* taken away from what the list has built so far */
    bool intersect;                  /* only what lies in it stays of that */
    real from[DIM_MAX], to[DIM_MAX]; /* box corners; ends of the axis of a cylinder, tube, cone [m] */
    real centre[DIM_MAX], radius;    /* ball, ring, torus; radius also of cylinder, tube and cone (at `from`) [m] */
    real point[DIM_MAX], normal[DIM_MAX]; /* half-space: (X - point) . normal <= 0; normal: also axis of a torus */
    real radii[DIM_MAX];                  /* ellipsoid: half axes along x, y, z [m] */
    real inner;                           /* of the hole of a tube, ring; of a cone at `to`; of a torus' section [m] */
    int axis;                             /* extrusion: along it, */
    real begin, end;                      /* ... from, to [m] */
    struct region region;                 /* of an extrusion (its plane has the other two axes in order) or a group */
    struct polygon *polygon;              /* owned */
    const struct hull *hull;              /* of the scene; an open one as far as `radius` from it */
    const struct voxel_part *voxels;      /* of the scene */
    int motions, images;                  /* images 0: the solid is where it is described */
    struct solid_motion *motion;          /* [motions] */
    struct placement *image;              /* [images] */
    struct box_tree tree;                 /* over the boxes round images */
};

/* Is it a box, ball, .. of this kind as described, without copies? Only then from, to, radius .. say where it is. */
static inline bool solid_is(const struct solid *s, enum solid_kind kind) { return s->kind == kind && s->images == 0; }

/* Signed distance of X from the surface, negative inside [m], and the unit normal that leads away: exact outside. */
real solid_distance(const struct solid *s, const real *X, int dim, real *normal);
/* What tells inside (<= 0) from outside: the distance beside flat faces; of boxes and cylinders the largest of the
 * distances from their faces, so that they grow with their edges [m]. */
real solid_level(const struct solid *s, const real *X, int dim);
/* solid_level(s, X, dim) <= most, and quicker. */
bool solid_within(const struct solid *s, const real *X, int dim, real most);
/* Box round it, a little larger, for a box_tree; infinite where none is known that its levels keep to. */
void solid_box(const struct solid *s, int dim, struct bounds *box);
/* max over its points of X . along [m], for lengths 1 of `along`. */
real solid_support(const struct solid *s, const real *along, int dim);
/* Radius of a ball, cylinder, tube or ring, the least half axis of an ellipsoid, wherever it is; INFINITY: it has none.
 * Least thickness: the diameter, or the wall, of these and of cones and tori; INFINITY: not known without a measurement
 * [m]. */
real solid_radius(const struct solid *s, int dim);
real solid_width(const struct solid *s, int dim);
/* Appends a motion and makes its images. False: there would be more than IMAGES_MOST. */
bool solid_move(struct solid *s, const struct solid_motion *m, int dim);
/* How far X is at the most from the box of a solid whose level there is no more than this, in any direction [m]: levels
 * outside are 1/sqrt(3) of the distance at the least, beside the corner of a box. */
static inline real level_reach(real level) { return level > 0 ? 1.75 * level : level; }
/* Number of primitive solids that one query looks at. */
real solid_effort(const struct solid *s);
void solid_free(struct solid *s);

/* Makes bends and sense of a polygon from its corners and radius. On failure says what is wrong, with the number of the
 * corner: */
enum polygon_fault { POLYGON_FINE, POLYGON_SHORT, POLYGON_FLAT, POLYGON_CROSSED, POLYGON_TIGHT };
enum polygon_fault polygon_make(struct polygon *p, int *corner);

#endif
