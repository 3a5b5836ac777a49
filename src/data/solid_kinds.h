/* Table of the kinds of solids with the functions of each kind. The functions treat one solid, without the copies of a
 * pattern. */
#ifndef CLEAVE_SOLID_KINDS
#define CLEAVE_SOLID_KINDS

#include "data/solid.h"

/* Functions of one kind of solid, which treat a single solid as described, without its copies. Each member does for the
 * single solid what the function named beside the member does for the solid with all copies. solid_types is indexed by
 * enum solid_kind. */
struct solid_type {
    real (*distance)(const struct solid *s, const real *X, int dim, real *normal); /* as solid_signed_distance */
    real (*level)(const struct solid *s, const real *X, int dim); /* as solid_level_set_value; NULL: the distance */
    real (*support)(const struct solid *s, const real *along,
                    int dim); /* as solid_support_function, for `along` of any length */
    bool (*within)(const struct solid *s, const real *X, int dim,
                   real most); /* as solid_level_set_is_at_most; NULL: by level */
};
extern const struct solid_type solid_types[SOLID_KINDS];

/* Position of a point relative to the axis of a cylinder. length: length of the axis [m]; along: coordinate of the
 * point along the axis, from its middle [m]; across: distance from the axis [m]; axis: unit vector along the axis; out:
 * unit vector from the axis to the point. */
struct axis_place {
    real length, along, across, axis[DIM_MAX], out[DIM_MAX];
};

/* Returns the signed distance [m] of the point X (two components [m]) from the boundary of the polygon p, negative
 * inside. normal: receives the outward unit normal at the nearest point, two components. */
real polygon_signed_distance(const struct polygon *p, const real *X, real *normal);

/* Returns how far the polygon p extends in a direction (support function): the largest scalar product X . direction
 * over its points X. direction: two components, of any length. */
real polygon_support_function(const struct polygon *p, const real *direction);

/* Returns the signed distance [m] of the point X (dim components [m]) from the surface of the ellipsoid s, negative
 * inside. dim: 2 for an ellipse, 3; normal: receives the outward unit normal at the nearest point. */
real ellipsoid_signed_distance(const struct solid *s, const real *X, int dim, real *normal);

#endif
