/* Room `geometry`: shapes from files of others: surfaces (STL), meshes of finite elements (Gmsh, Abaqus), images and
 * stacks of images (PNG, TIFF). It knows the structures of `data` that answer where a place lies; scenes call it.
 *
 * A file is not trusted: counts are compared with its size, numbers must be finite, and what is wrong is said in one
 * line that names file and line. */
#ifndef CLEAVE_GEOMETRY
#define CLEAVE_GEOMETRY

#include "data/hull.h"
#include "data/region.h"

/* A named part of a mesh: of elements that fill it a closed surface, of faces, lines or nodes an open one. */
struct geometry_set {
    char name[NAME_MAX_LENGTH];
    struct hull hull;
};

struct geometry {
    struct hull whole;
    int sets;
    struct geometry_set *set;
};

/* Reads a file by its ending, .stl, .msh or .inp; coordinates times `scale` are metres. In the plane elements are
 * triangles and quadrilaterals of one z. Curved edges of second-order elements become chords at most `fine` [m] beside
 * them; NAN: 1/256 of the largest sagitta. REFUSED: what is no such file, has no body, or is so open that inside and
 * outside cannot be told; nothing is left to free then. */
status geometry_read(struct geometry *g, const char *path, int dim, real scale, real fine);
/* NULL: no set has this name, in any case of its letters. */
const struct geometry_set *geometry_find(const struct geometry *g, const char *name);
void geometry_free(struct geometry *g);

/* Appends to a list of *n cracks the free surfaces inside a closed surface: faces of it in one place, such as elements
 * beside a slit have, whose nodes are doubled there. List and corners are the caller's (memory_free). */
void geometry_slits(const struct hull *h, struct crack **crack, int *n);

#endif
