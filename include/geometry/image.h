/* Images and image stacks as grids of grey values: PNG, and TIFF with one or several pages. Colours and palettes become
 * luminance; transparency is ignored; grey values keep the values of the file, except that 1, 2 and 4 bits are scaled
 * to 0..255. 16 bits give 0..65535. Signed values, fractions and other bit depths are refused. */
#ifndef CLEAVE_IMAGE
#define CLEAVE_IMAGE

#include "data/voxels.h"

/* Reads grey values from the image files file_paths[file_count] (PNG, TIFF) into v. dim: 2 for one image, 3 for slices
 * from low to high z, in several files or as pages of one file. The last row of an image has the lowest y.
 * voxel_size[dim]: edges of a voxel [m]; lower_corner[dim]: lower corner of the first voxel [m]. Returns REFUSED, with
 * a message, for a wrong format, slices of different sizes, or more voxels than memory allows; FAILED if the PNG
 * library cannot start. After a failure nothing has to be released. Release v with voxels_free. */
status image_read_voxels(struct voxels *v, int file_count, char *const *file_paths, int dim, const real *voxel_size,
                         const real *lower_corner);

#endif
