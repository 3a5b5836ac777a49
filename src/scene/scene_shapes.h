/* What the files scene_shapes.c and scene_images.c share. */
#ifndef CLEAVE_SCENE_SHAPES
#define CLEAVE_SCENE_SHAPES

#include "scene/shape_file.h"
#include "scene_internal.h"

/* What a scene says of a file beside its name. */
struct shape_words {
    char set[NAME_MAX_LENGTH], contents[NAME_MAX_LENGTH];
    real scale, within;                 /* [m] */
    real pixel, slice, origin[DIM_MAX]; /* [m] */
};

/* Ranges from `values`: a grey value, a range, or a list of these. */
status read_grey_values(struct reader *r, const struct node *n, struct voxel_part *p);
/* All ranges of `materials` that are not void. REFUSED outside of the shape of a body, and if a grey value of the image
 * is in none. */
status read_grey_materials(struct reader *r, const struct node *n, const struct voxels *v, struct voxel_part *p);
/* Order of names of files: numbers in them by their value. */
int path_order(const void *a, const void *b);

#endif
