/* The table of kinds of solids, each as described, without copies. */
#ifndef CLEAVE_SOLID_KINDS
#define CLEAVE_SOLID_KINDS

#include "data/solid.h"

struct solid_type {
    real (*distance)(const struct solid *s, const real *X, int dim, real *normal); /* as solid_distance */
    real (*level)(const struct solid *s, const real *X, int dim);       /* as solid_level; NULL: the distance */
    real (*support)(const struct solid *s, const real *along, int dim); /* as solid_support, for any length of along */
    bool (*within)(const struct solid *s, const real *X, int dim, real most); /* as solid_within; NULL: by level */
};
extern const struct solid_type solid_types[SOLID_KINDS];

/* A point in the half plane of an axis from..to: coordinates along it from its middle and across it; directions. */
struct axis_place {
    real length, along, across, axis[DIM_MAX], out[DIM_MAX];
};

real polygon_distance(const struct polygon *p, const real *X, real *normal);
real polygon_support(const struct polygon *p, const real *along);
real ellipsoid_distance(const struct solid *s, const real *X, int dim, real *normal);

#endif
