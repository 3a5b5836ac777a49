/* Declares the computation of volume, centre and second moments of the shapes of rigid bodies. */
#ifndef CLEAVE_RIGID_MOMENTS
#define CLEAVE_RIGID_MOMENTS

#include "data/region.h"

/* Volume, centre and second moments of one region of uniform density, such as the shape of a rigid body. */
struct region_moments {
    real volume;                   /* [m^dim] */
    real centre[DIM_MAX];          /* centre of the volume [m] */
    real second[DIM_MAX][DIM_MAX]; /* mean of (X - centre)(X - centre)^T [m^2] */
    real change; /* relative change of the moments in the last refinement of the sampling, an estimate of their error
                    [1] */
};

/* Largest relative error of the moments with a uniform grid of sampling points [1]; if it is exceeded, cells at the
 * surface are divided instead. */
#define MOMENTS_ACCURATE 0.005

/* Computes into *m the moments of the region `shape` within its bounding box `box_low` .. `box_high` (dim components
 * each [m]): with a uniform grid of sampling points, or, where this is less accurate than MOMENTS_ACCURATE (0.5 %),
 * with cells that are divided at the surface until the moments no longer change. The volume is 0 if the region is empty
 * or the box has no volume. */
void region_compute_moments(const struct region *shape, int dim, const real *box_low, const real *box_high,
                            struct region_moments *m);

#endif
