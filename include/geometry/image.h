/* Images and stacks of images as grids of grey values: PNG, and TIFF of one or several pages. Colours and palettes
 * become their luminance; transparency is not looked at; grey values stay as the file has them, those of 1, 2 and 4
 * bits scaled to 0..255, of 16 bits 0..65535. Values with a sign, with fractions or of other numbers of bits are
 * refused.
 */
#ifndef CLEAVE_IMAGE
#define CLEAVE_IMAGE

#include "data/voxels.h"

/* Reads one image in the plane; in space the slices from below, of several files or of the pages of one. The last row
 * of an image is the lowest. size [m], from [m]: as in struct voxels. REFUSED: what is no such file, slices of
 * different sizes, more voxels than memory allows; nothing is left to free then. */
status image_read(struct voxels *v, int files, char *const *path, int dim, const real *size, const real *from);

#endif
