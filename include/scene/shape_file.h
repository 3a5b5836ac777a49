/* Files that solids of a scene are made of. A file is read once for all solids with the same words. */
#ifndef CLEAVE_SHAPE_FILE
#define CLEAVE_SHAPE_FILE

#include "data/voxels.h"
#include "geometry/geometry.h"

enum shape_kind { SHAPE_STL, SHAPE_MESH, SHAPE_IMAGE };

struct shape_file {
    struct shape_file *next;
    enum shape_kind kind;
    int dim; /* of what it holds: 2 also in an extrusion */
    int files;
    char **path;                       /* as to be opened; of slices from below */
    uint64_t contents;                 /* hash of all */
    real scale;                        /* what the number 1 in it is [m] */
    real size[DIM_MAX], from[DIM_MAX]; /* of a voxel; lower corner of an image [m] */
    struct geometry geometry;
    struct voxels voxels;
    int parts;
    struct voxel_part **part; /* the grey values that solids have asked for */
};

void shape_files_free(struct shape_file *first);

#endif
