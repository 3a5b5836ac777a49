/* Declares the readers of solids from files that scene_shapes.c and scene_images.c share. */
#ifndef CLEAVE_SCENE_SHAPES
#define CLEAVE_SCENE_SHAPES

#include "scene/shape_file.h"
#include "scene_internal.h"

/* Settings, other than the name, of a file from which a solid is read. set: named set of a mesh; contents: hash of the
 * file, as text; scale: length that the number 1 in the file stands for; within: distance up to which points belong to
 * a set of nodes or faces. For images, pixel: edge of a pixel; slice: distance of slices; origin: lower corner. */
struct shape_words {
    char set[LONG_NAME_LENGTH], contents[NAME_MAX_LENGTH];
    real scale, within;                 /* [m] */
    real pixel, slice, origin[DIM_MAX]; /* [m] */
};

/* Reads the unit of length of a file from the key `unit` of the mapping `file_node`, and stores in *scale how long the
 * number 1 in the file is [m]. Leaves *scale unchanged if the mapping has no such key. r: reader of the input file.
 * Returns REFUSED, with a message, if the value is no unit of length, if the mapping also has the key `scale`, or if
 * `is_required` is true and the mapping has neither key. */
status read_length_unit_of_file(struct reader *r, const struct yaml_node *file_node, bool is_required, real *scale);

/* Reads the value of the key `values`, the node `values_node`, into the ranges of grey values of `part`: a grey value,
 * a range, or a list of these. r: reader of the input file. Returns REFUSED, with a message, for an invalid value. */
status read_grey_value_ranges_of_voxel_solid(struct reader *r, const struct yaml_node *values_node,
                                             struct voxel_solid *part);

/* Reads the mapping `materials` of an image, the node `materials_node`, which assigns ranges of grey values to
 * materials or to void. Stores all ranges that are not void in `part`. voxels: voxels of the image. r: reader of the
 * input file. Returns REFUSED, with a message, if the solid is not the shape of a body, or if a grey value of the image
 * is in no range. */
status read_materials_by_grey_value(struct reader *r, const struct yaml_node *materials_node,
                                    const struct voxels *voxels, struct voxel_solid *part);

/* Compares two file names, char * at a and b, for array_sort; numbers in the names are compared by value, so that
 * slice_2 precedes slice_10. */
int compare_file_names_numerically(const void *a, const void *b);

#endif
