/* Room `geometry`: reads shapes from external files: surfaces (STL), finite-element meshes (Gmsh, Abaqus), and images
 * and image stacks (PNG, TIFF). It uses the structures of `data` that classify points as inside or outside a shape;
 * scenes call it.
 *
 * Input is not trusted: counts are checked against the file size, numbers must be finite, and errors are reported in
 * one line with the file name and line. */
#ifndef CLEAVE_GEOMETRY
#define CLEAVE_GEOMETRY

#include "data/hull.h"
#include "data/region.h"

/* A named part of a mesh. Elements that fill the body form a closed surface; faces, lines or nodes form an open one. */
struct geometry_set {
    char name[NAME_MAX_LENGTH];
    struct hull hull;
};

/* A body and its named parts, all in metres. */
struct geometry {
    struct hull whole; /* surface of the body */
    int sets;          /* length of `set` */
    struct geometry_set *set;
};

/* Reads a .stl, .msh or .inp file into g; the extension selects the format. Coordinates times `scale` are metres. In
 * 2D, elements are triangles and quadrilaterals of equal z. Curved edges of second-order elements become chords at most
 * `fine` [m] away from the curve; NAN: 1/256 of the largest sagitta. REFUSED: wrong format, no body in the file, or a
 * surface so open that inside and outside cannot be told apart. After a failure there is nothing to free. */
status geometry_read(struct geometry *g, const char *path, int dim, real scale, real fine);

/* Returns the set called `name`, ignoring case; NULL if there is none. */
const struct geometry_set *geometry_find(const struct geometry *g, const char *name);

/* Frees all arrays of g and zeroes it. */
void geometry_free(struct geometry *g);

/* Finds pairs of coincident faces of the closed surface h, as at slits with doubled nodes, and appends them as cracks
 * to a list of *n cracks. In 3D, adjoining coplanar faces become one crack if they form a convex polygon. The caller
 * frees the list and its corners (memory_free). */
void geometry_slits(const struct hull *h, struct crack **crack, int *n);

#endif
