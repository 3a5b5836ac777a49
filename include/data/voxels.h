/* Grey values on a grid of pixels or voxels, and the solid made of certain grey values. */
#ifndef CLEAVE_VOXELS
#define CLEAVE_VOXELS

#include "base/base.h"

/* An image: a grid of pixels (dim = 2) or voxels (dim = 3) with a grey value each. The array `grey` is owned. */
struct voxels {
    int dim;
    int64_t n[DIM_MAX]; /* voxels along x, y, z; 1 in absent directions */
    real size[DIM_MAX]; /* edges of a voxel [m] */
    real from[DIM_MAX]; /* lower corner of the first voxel [m] */
    uint16_t *grey;     /* [n[2]][n[1]][n[0]] */
};

enum { GREY_MAX = UINT16_MAX, VOXELS_MAX = INT32_MAX };

/* Releases the grey values of the image v. */
void voxels_free(struct voxels *v);

/* Returns the grey value (0 .. GREY_MAX) of the voxel of image v that contains the point X (v->dim components [m]), or
 * -1 if X is outside the image. A point on the border of two voxels belongs to the upper one. */
int voxels_grey_value(const struct voxels *v, const real *X);

/* Range of grey values low .. high, inclusive. */
struct grey_range {
    int low, high;
};
enum { GREY_RANGES_MAX = 64 };

/* A solid that consists of the voxels of the image `of` whose grey values are in one of range[0] .. range[ranges - 1].
 * The array `level` has one more voxel on each side than the image; these voxels are outside the solid. */
struct voxel_solid {
    const struct voxels *of;
    int ranges;
    struct grey_range range[GREY_RANGES_MAX];
    int64_t voxels; /* number of voxels of the solid */
    float *level;   /* signed distance of voxel centres from the surface, negative inside [m] */
};

/* Finds the voxels of the image voxels->of whose grey values are in the ranges voxels->range: sets voxels->voxels to
 * their number and voxels->level to the signed distance [m] of each voxel centre from the surface of the solid that
 * these voxels form. voxels->of and the ranges must be set before. Release with voxel_solid_free. */
void voxel_solid_make_from_grey_value_ranges(struct voxel_solid *voxels);

/* Releases the array of distances voxels->level of the solid p. */
void voxel_solid_free(struct voxel_solid *voxels);

/* Returns the signed distance [m] of the point X (dim components [m]) from the surface of the solid `voxels`, negative
 * inside. The sign is exact; the value is the distance of the centre of the voxel that contains X (outside the image:
 * of the nearest voxel, plus the distance of X from the image). normal: NULL, or receives the unit vector that points
 * out of the solid. */
real voxel_solid_signed_distance(const struct voxel_solid *voxels, const real *X, real *normal);

#endif
