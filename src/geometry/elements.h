/* Finite-element meshes as read from a file of any format: nodes, elements, and sets of both. */
#ifndef CLEAVE_ELEMENTS
#define CLEAVE_ELEMENTS

#include "geometry/geometry.h"
#include "source.h"

/* Shape of an element, without its middle nodes. */
enum element_kind {
    ELEMENT_POINT,
    ELEMENT_LINE,
    ELEMENT_TRIANGLE,
    ELEMENT_QUAD,
    ELEMENT_TETRAHEDRON,
    ELEMENT_PYRAMID,
    ELEMENT_PRISM,
    ELEMENT_HEXAHEDRON,
    ELEMENT_KINDS
};

/* By kind: number of corners, dimension, and number of middle nodes. A second-order element has first the middle nodes
 * of its edges, ordered as in element_edges, then those of its sides, ordered as in element_sides; the last one of a
 * triangle or quadrilateral belongs to the element itself. */
extern const int element_corners[ELEMENT_KINDS], element_dim[ELEMENT_KINDS], element_middles[ELEMENT_KINDS];

enum { ELEMENT_CORNERS_MAX = 8, ELEMENT_SIDES_MAX = 6, ELEMENT_EDGES_MAX = 12, ELEMENT_MIDDLES_MAX = 18 };

/* An element and its nodes. */
struct element {
    enum element_kind kind;
    int32_t node[ELEMENT_CORNERS_MAX]; /* indices of its corners in the mesh's `node` */
    int64_t middle; /* index of its first middle node in the mesh's `middle`; -1: all edges are straight */
};

/* Sides of an element kind: corners counter-clockwise seen from outside; the fourth corner of a triangle is -1. Corners
 * are numbered as in Gmsh and Abaqus, which agree. In 2D, sides are edges with two corners. */
struct element_sides {
    int n;
    signed char corner[ELEMENT_SIDES_MAX][4];
};
extern const struct element_sides element_sides[ELEMENT_KINDS];

/* Edges of an element kind, by their two corners. */
struct element_edges {
    int n;
    signed char corner[ELEMENT_EDGES_MAX][2];
};
extern const struct element_edges element_edges[ELEMENT_KINDS];

/* A named set of nodes or elements. */
struct element_set {
    char name[NAME_MAX_LENGTH];
    bool of_nodes; /* true: members are nodes; false: elements */
    /* number of members; number of members that are already indices */
    int64_t n, resolved;
    int32_t *member; /* indices; from `resolved` on still labels of the file (abaqus.c) */
};

/* A mesh under construction. Its reader appends nodes and elements in file order. */
struct element_mesh {
    int64_t nodes;
    real (*node)[DIM_MAX]; /* coordinates [unit of the file] */
    int64_t *node_label;   /* its number in the file, -1: not from the file */
    int64_t elements;
    struct element *element;
    /* number of each element in the file */
    int64_t *element_label;
    int64_t middles;
    int32_t *middle; /* node indices of the middle nodes of all elements that have them; -1: missing */
    int sets;
    struct element_set *set;
    char skipped[NAME_MAX_LENGTH]; /* name of an element type that was left out; "": none */
};

enum { ELEMENT_SETS_MAX = 1000 };

/* Appends a node at X [unit of the file]. REFUSED: too many nodes. */
status mesh_node_add(struct element_mesh *m, const struct source *s, const real *X, int64_t label);

/* Appends a node that is not in the file at X [unit of the file] and returns its index. */
int32_t mesh_node_append(struct element_mesh *m, const real *X, int64_t label);

/* Appends an element with corners `node` (indices or, in Abaqus files, still labels). REFUSED: too many elements. */
status mesh_element_add(struct element_mesh *m, const struct source *s, enum element_kind kind, const int32_t *node,
                        int64_t label);

/* Sets the middle nodes (indices or labels) of the last element; their number is that of its kind (element_middles). */
void mesh_middles_add(struct element_mesh *m, const int32_t *middle);

/* Returns the number of the set called `name`, ignoring case, and creates it if needed; -1: too many sets. */
int mesh_set(struct element_mesh *m, const char *name, bool of_nodes);

/* Appends a member (index or label) to a set. */
void mesh_set_add(struct element_mesh *m, int set, int64_t member);

/* Frees all arrays of m and zeroes it. */
void element_mesh_free(struct element_mesh *m);

/* Translates labels of a file to indices: n consecutive indices from `first` on, sorted by label. */
struct label_map {
    int64_t n;
    struct label_entry *entry;
};

/* A label and its index. */
struct label_entry {
    int64_t label, index;
};

/* Makes a map in which label[k] has the index first + k. Free it with label_map_free. */
void label_map_make(struct label_map *map, const int64_t *label, int64_t first, int64_t n);

/* Frees the map's entries. */
void label_map_free(struct label_map *map);

/* Returns the index of a label, the lowest one if it occurs twice; -1 if it is absent. */
int64_t label_find(const struct label_map *map, int64_t label);

/* Returns true if a label occurs twice, and sets *label to the smallest such label. */
bool label_twice(const struct label_map *map, int64_t *label);

/* Reads a Gmsh file into an empty mesh. REFUSED: malformed, or a kind of element that is not supported. The caller
 * frees the mesh, also after a failure. */
status gmsh_read(struct element_mesh *m, struct source *s);

/* Reads an Abaqus deck into an empty mesh; failures and ownership as for gmsh_read. */
status abaqus_read(struct element_mesh *m, struct source *s);

/* Reads text or binary STL into an empty mesh; corners closer than a millionth of the extent become one node. Failures
 * and ownership as for gmsh_read. */
status stl_read(struct element_mesh *m, struct source *s);

/* Makes from a mesh the surface of the body that its elements fill, and the surfaces of its sets. Coordinates times
 * `scale` are metres. fine: largest distance between a curved edge and its chords [m]; NAN: 1/256 of the largest
 * sagitta. REFUSED: no elements of the right dimension, not planar in 2D, or curves too coarse. */
status geometry_from_elements(struct geometry *g, struct element_mesh *m, const char *path, int dim, real scale,
                              real fine);

/* ---- faces of a surface (elements_curved.c) ---- */

/* A side of an element: n = 1 to 4 corners, middle nodes of its edges (edge k starts at corner k) and its own middle
 * node. */
struct patch {
    int n;
    int32_t corner[4], middle[4], centre; /* node indices; -1: none */
};

/* Collects the faces of a surface. */
struct builder {
    struct element_mesh *m;
    int dim, body_dim; /* dimension of space; dimension of the elements that make up the body */
    real scale;
    real sagitta; /* an edge is straight if its middle node is closer than this to its chord [unit of the file] */
    int pieces;   /* pieces per curved edge in 3D */
    int64_t n;    /* number of faces; each face has `dim` node indices */
    int32_t (*face)[DIM_MAX];
    int64_t patches; /* sides with middle nodes, until builder_curve turns them into faces */
    struct patch *patch;
    int64_t file_nodes;   /* nodes from the file; later ones are on curved sides between the corners `parent` */
    int32_t (*parent)[4]; /* [node - file_nodes] corner nodes of the side, -1: unused */
};

/* Adds a face between nodes i, j and, in 3D, k. */
void builder_add(struct builder *b, int32_t i, int32_t j, int32_t k);

/* Adds a side with n = 3 or 4 corners as triangles. */
void builder_add_side(struct builder *b, const int32_t *node, int n);

/* Adds a side with middle nodes, to be subdivided by builder_curve. */
void builder_add_patch(struct builder *b, const struct patch *p);

/* Chooses sagitta and pieces. REFUSED if the curves of the mesh need too many pieces to be resolved to `fine` [m]. */
status builder_fineness(struct builder *b, const char *path, real fine);

/* Turns all patches into faces; curved ones are subdivided, which adds nodes to the mesh. closed: removes patches
 * shared by two elements first. */
void builder_curve(struct builder *b, bool closed);

#endif
