/* The table of kinds of solids, each without copies. */
#ifndef CLEAVE_SOLID_KINDS
#define CLEAVE_SOLID_KINDS

#include "data/solid.h"

/* Functions of a kind of solid. */
struct solid_type {
    real (*distance)(const struct solid *s, const real *X, int dim, real *normal); /* as solid_distance */
    real (*level)(const struct solid *s, const real *X, int dim); /* as solid_level; NULL: the distance */
    real (*support)(const struct solid *s, const real *along,
                    int dim); /* as solid_support, for `along` of any length */
    bool (*within)(const struct solid *s, const real *X, int dim, real most); /* as solid_is_within; NULL: by level */
};
extern const struct solid_type solid_types[SOLID_KINDS];

/* A point relative to an axis from .. to: length of the axis, coordinates along it from its middle and across it [m],
 * and unit vectors of both directions. */
struct axis_place {
    real length, along, across, axis[DIM_MAX], out[DIM_MAX];
};

/* Returns the signed distance of X from a polygon and its normal, as solid_distance. */
real polygon_distance(const struct polygon *p, const real *X, real *normal);

/* Returns the support of a polygon, as solid_support. */
real polygon_support(const struct polygon *p, const real *along);

/* Returns the signed distance of X from an ellipsoid and its normal, as solid_distance. */
real ellipsoid_distance(const struct solid *s, const real *X, int dim, real *normal);

#endif
