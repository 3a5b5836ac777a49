/* Declares the readers of solids from files that scene_shapes.c and scene_images.c share. */
#ifndef CLEAVE_SCENE_SHAPES
#define CLEAVE_SCENE_SHAPES

#include "scene/shape_file.h"
#include "scene_internal.h"

/* Settings of a file other than its name. */
struct shape_words {
    char set[NAME_MAX_LENGTH], contents[NAME_MAX_LENGTH];
    real scale, within;                 /* [m] */
    real pixel, slice, origin[DIM_MAX]; /* [m] */
};

/* Reads the length that the number 1 of a file is from the key `unit` of the mapping n into *scale [m], if n has it.
 * REFUSED if it is no unit of length, if n has the key `scale`, too, or, if `required`, neither. */
status read_file_unit(struct reader *r, const struct yaml_node *n, bool required, real *scale);

/* Reads the key `values` into ranges of grey values: a value, a range, or a list of these. */
status read_grey_values(struct reader *r, const struct yaml_node *n, struct voxel_part *part);

/* Reads all ranges of grey values of `materials` that are not void into `part`. REFUSED if the solid is not the shape
 * of a body, and if a grey value of the image is in no range. */
status read_grey_materials(struct reader *r, const struct yaml_node *n, const struct voxels *v,
                           struct voxel_part *part);

/* Compares two file names for sorting; numbers in them are compared by value. */
int compare_paths(const void *a, const void *b);

#endif
