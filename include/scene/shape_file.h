/* Defines struct shape_file, a file from which solids of a scene are read. It is read once: all solids with equal
 * settings use the same contents. */
#ifndef CLEAVE_SHAPE_FILE
#define CLEAVE_SHAPE_FILE

#include "data/voxels.h"
#include "geometry/geometry.h"

/* Contents of a file of solids: a closed surface, a mesh of finite elements, a stack of images with grey values. */
enum shape_kind { SHAPE_STL, SHAPE_MESH, SHAPE_IMAGE };

/* A file, or a stack of image files, from which solids are read, with its contents; an item of a linked list. */
struct shape_file {
    struct shape_file *next;
    enum shape_kind kind;
    int dim; /* dimensions of the contents: 2 also for the section of an extrusion */
    int files;
    char **path;                       /* [files] paths; slices of an image in ascending z */
    uint64_t contents;                 /* hash of the contents of all files */
    real scale;                        /* length unit of the coordinates in the file [m] */
    real size[DIM_MAX], from[DIM_MAX]; /* IMAGE: edges of a voxel; lower corner of the image [m] */
    struct geometry geometry;          /* STL and MESH: surface or mesh */
    struct voxels voxels;              /* IMAGE: grey values */
    int parts;
    struct voxel_solid **part; /* [parts] ranges of grey values that solids use */
};

/* Releases all shape files in the linked list that begins with `first`, with the surfaces or voxels that were read from
 * them. */
void shape_files_free(struct shape_file *first);

#endif
