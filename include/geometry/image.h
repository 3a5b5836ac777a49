/* Images and image stacks as grids of grey values: PNG, and TIFF with one or several pages. Colours and palettes become
 * luminance; transparency is ignored; grey values keep the values of the file, except that 1, 2 and 4 bits are scaled
 * to 0..255. 16 bits give 0..65535. Signed values, fractions and other bit depths are refused. */
#ifndef CLEAVE_IMAGE
#define CLEAVE_IMAGE

#include "data/voxels.h"

/* Reads `files` images into v. 2D: one image. 3D: slices from low to high z, in several files or in the pages of one.
 * The last row of an image has the lowest y. size [m], from [m]: as in struct voxels. REFUSED: wrong format, slices of
 * different sizes, more voxels than memory allows. After a failure there is nothing to free. */
status image_read(struct voxels *v, int files, char *const *path, int dim, const real *size, const real *from);

#endif
