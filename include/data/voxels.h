/* Grey values on a grid of pixels or voxels, and the places whose grey values are of a kind. */
#ifndef CLEAVE_VOXELS
#define CLEAVE_VOXELS

#include "base/base.h"

struct voxels {
    int dim;
    int64_t n[DIM_MAX]; /* voxels along x, y, z; 1 where there is no such direction */
    real size[DIM_MAX]; /* of a voxel [m] */
    real from[DIM_MAX]; /* lower corner of the first [m] */
    uint16_t *grey;     /* x fastest */
};

enum { GREY_MAX = UINT16_MAX, VOXELS_MAX = INT32_MAX };

void voxels_free(struct voxels *v);
/* Grey value at X; -1 outside. A place between voxels belongs to the upper one, also where round-off moved it. */
int voxels_grey(const struct voxels *v, const real *X);

/* Grey values low..high, ends included. */
struct grey_range {
    int low, high;
};
enum { GREY_RANGES_MAX = 64 };

/* The voxels with certain grey values, as a solid. `level` has one more voxel on each side, which is outside. */
struct voxel_part {
    const struct voxels *of;
    int ranges;
    struct grey_range range[GREY_RANGES_MAX];
    int64_t voxels; /* how many there are */
    float *level;   /* signed distance of their centres from the surface, negative inside [m] */
};

/* Finds its voxels and their distances; of and the ranges are given. */
void voxel_part_make(struct voxel_part *p);
void voxel_part_free(struct voxel_part *p);
/* Signed distance, negative inside [m]: its sign is exact, its value that of the centre of the voxel. normal (may be
 * NULL): away from the surface. */
real voxel_part_distance(const struct voxel_part *p, const real *X, real *normal);

#endif
