/* Room `geometry` (folder of include/ and src/): reads shapes from external files: surfaces (STL), finite-element
 * meshes (Gmsh, Abaqus, Exodus II), images and image stacks (PNG, TIFF). It uses the structures of the room `data` that
 * classify points as inside or outside a shape; the reader of input files calls it.
 *
 * Files are not trusted: counts are checked against the file size, numbers must be finite, and errors are reported in
 * one line with the file name and line. */
#ifndef CLEAVE_GEOMETRY
#define CLEAVE_GEOMETRY

#include "data/hull.h"
#include "data/region.h"

/* A part of a mesh with the name `name` and the surface `hull`: a closed surface for elements that fill the body, an
 * open surface for faces, lines or nodes. own: number of characters before the name of the set itself, which are the
 * name of an instance of an Abaqus assembly and a dot; fault: why the set cannot be used, NULL if it can. */
struct geometry_set {
    char name[LONG_NAME_LENGTH];
    int own;
    const char *fault;
    struct hull hull;
};

/* Returns true if `name`, ignoring case, is the name of `set` without the prefix INSTANCE. (instance of an Abaqus
 * assembly); false also if the name of the set has no such prefix. */
bool geometry_set_name_matches_after_instance_prefix(const struct geometry_set *set, const char *name);

/* The surface of a body and its named parts set[sets], all coordinates in metres. */
struct geometry {
    struct hull whole; /* surface of the body; of a list of particles, which has sets alone, dim is 0 */
    int sets;          /* length of `set` */
    struct geometry_set *set;
};

/* Reads a body and its named parts from a .stl, .msh, .inp or Exodus II file into g. The extension of the name `path`
 * selects the format. A file with point elements only (list of particles) has no surface; its sets are read. dim:
 * dimensions of the space; if it is 2, the elements must be triangles and quadrilaterals of equal z. scale: length of
 * the unit of the file [m]. chord_tolerance: largest distance between a curved edge of a second-order element and the
 * chords that approximate it [m]; NAN for 1/256 of the largest sagitta. Returns REFUSED, with a message and nothing to
 * release, for a wrong format, a file without a body, or a surface so open that inside and outside cannot be
 * distinguished. Release g with geometry_free. */
status geometry_read(struct geometry *g, const char *path, int dim, real scale, real chord_tolerance);

/* Returns the named part of g called `name`, ignoring case. The name of the instance to which a part of an Abaqus
 * assembly belongs may be left out where one instance alone has a part of this name. Returns NULL if there is none. */
const struct geometry_set *geometry_find_set_by_name(const struct geometry *g, const char *name);

/* Releases all arrays of g, the surfaces of a body and its parts, and sets all members of g to 0. */
void geometry_free(struct geometry *g);

/* Finds slits in the finite-element mesh from which the closed surface h was made: pairs of faces that coincide because
 * their nodes are doubled. Appends each slit as a pre-crack to the array *crack and increases *crack_count, the length
 * of this array. In 3D adjacent coplanar faces become one crack if they form a convex polygon. The caller releases the
 * array and the `corner` of each crack with memory_free. */
void geometry_append_mesh_slits_as_precracks(const struct hull *h, struct crack **crack, int *crack_count);

#endif
