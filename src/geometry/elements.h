/* Finite-element meshes as read from a file of any format: nodes, elements, and sets of both. */
#ifndef CLEAVE_ELEMENTS
#define CLEAVE_ELEMENTS

#include "geometry/geometry.h"
#include "source.h"

/* Shape of an element, without its middle nodes: point, line, triangle, quadrilateral, and the four kinds of solid
 * elements. */
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

/* For each kind of element: number of corners, dimension (0 to 3), and number of middle nodes. A second-order element
 * has first the middle nodes of its edges, ordered as in element_edges, then those of its sides, ordered as in
 * element_sides; the last one of a triangle or quadrilateral belongs to the element itself. */
extern const int element_corners[ELEMENT_KINDS], element_dim[ELEMENT_KINDS], element_middles[ELEMENT_KINDS];

/* Largest numbers of corners, sides, edges and middle nodes of an element. */
enum { ELEMENT_CORNERS_MAX = 8, ELEMENT_SIDES_MAX = 6, ELEMENT_EDGES_MAX = 12, ELEMENT_MIDDLES_MAX = 18 };

/* An element of a finite-element mesh, and its nodes. */
struct element {
    enum element_kind kind;
    int32_t node[ELEMENT_CORNERS_MAX]; /* indices of its corners in the mesh's `node` */
    int64_t middle; /* index of its first middle node in the mesh's `middle`; -1: all edges are straight */
};

/* The n sides of an element kind. corner: corners of each side, counter-clockwise seen from outside; the fourth corner
 * of a triangle is -1. Corners are numbered as in Gmsh and Abaqus, which agree. In 2D, sides are edges with two
 * corners. */
struct element_sides {
    int n;
    signed char corner[ELEMENT_SIDES_MAX][4];
};
extern const struct element_sides element_sides[ELEMENT_KINDS];

/* Edges of an element kind: the numbers of the two corners of each of the n edges. element_edges is indexed by enum
 * element_kind. */
struct element_edges {
    int n;
    signed char corner[ELEMENT_EDGES_MAX][2];
};
extern const struct element_edges element_edges[ELEMENT_KINDS];

/* Returns the index (in element_edges) of the edge between the corners number `corner` and `other_corner` of an element
 * of the kind `kind`; -1 if there is no such edge. */
int element_edge_index_between_corners(enum element_kind kind, int corner, int other_corner);

/* A named set of nodes or elements of a finite-element mesh. name: in a part of an Abaqus assembly preceded by the name
 * of the instance and a dot. */
struct element_set {
    char name[LONG_NAME_LENGTH];
    int own;       /* number of characters before the name of the set itself: of the instance and the dot */
    bool of_nodes; /* true: members are nodes; false: elements */
    bool mixed;    /* of Gmsh: two groups of different dimension have this name */
    /* number of members; number of members that are already indices */
    int64_t n, resolved;
    int32_t *member; /* indices; from `resolved` on still labels of the file (abaqus.c) */
};

/* A finite-element mesh under construction, to which the reader of a file appends nodes, elements, middle nodes and
 * sets in the order of the file. The members nodes, elements, middles and sets count the entries of the arrays after
 * them. */
struct element_mesh {
    int64_t nodes;
    real (*node)[DIM_MAX]; /* coordinates [unit of the file] */
    int64_t *node_label;   /* number of each node in the file, -1: the node is not from the file */
    int64_t elements;
    struct element *element;
    int64_t *element_label; /* number of each element in the file */
    int64_t middles;
    int32_t *middle; /* node indices of the middle nodes of all elements that have middle nodes; -1: missing */
    int sets;
    struct element_set *set;
    char skipped[NAME_MAX_LENGTH]; /* name of an element type that was left out; "": none */
};

/* Largest number of sets of a mesh. */
enum { ELEMENT_SETS_MAX = 1000 };

/* Appends a node with the three coordinates `coordinates` [unit of the file] to the mesh m. label: its number in the
 * file; file: for the message. Returns REFUSED, with a message, if there are too many nodes for 32-bit indices. */
status element_mesh_add_node(struct element_mesh *m, const struct geometry_file *file, const real *coordinates,
                             int64_t label);

/* Appends a node with the three coordinates `coordinates` [unit of the file] to the mesh m and returns its index.
 * label: its number in the file, -1 for nodes that are not in the file. The number of nodes is not checked. */
int32_t element_mesh_add_node_unchecked(struct element_mesh *m, const real *coordinates, int64_t label);

/* Appends an element of the kind `kind` to the mesh m. corner_node: its corners, as indices of nodes or, in Abaqus
 * files, as node numbers of the file that are replaced later; label: number of the element in the file; file: for the
 * message. Returns REFUSED, with a message, if there are too many elements. */
status element_mesh_add_element(struct element_mesh *m, const struct geometry_file *file, enum element_kind kind,
                                const int32_t *corner_node, int64_t label);

/* Sets the middle nodes (on edges and sides) of the last element of the mesh m. middle_node: as many indices, or node
 * numbers of the file, as element_middles has for the kind of the element. */
void element_mesh_set_middle_nodes_of_last_element(struct element_mesh *m, const int32_t *middle_node);

/* Returns the index in m->set of the set of nodes (of_nodes true) or elements (false) called `name`, ignoring case;
 * creates an empty set if there is none. Returns -1 if there would be more than ELEMENT_SETS_MAX sets. */
int element_mesh_find_or_create_set(struct element_mesh *m, const char *name, bool of_nodes);

/* Appends a node or element to the set number `set` (from 0) of the mesh m. member: index of the node or element, or
 * its number in the file if indices are not known yet. */
void element_mesh_add_to_set(struct element_mesh *m, int set, int64_t member);

/* Rotates a node of the mesh m by `angle` [rad] about the axis from the point a to the point b (Rodrigues' formula). a
 * and b must differ. node: index of the node; axis_start, axis_end: three coordinates each [unit of the file]. */
void element_mesh_rotate_node(struct element_mesh *m, int64_t node, const real *axis_start, const real *axis_end,
                              real angle);

/* Releases all arrays of the mesh m and sets all its members to 0. */
void element_mesh_free(struct element_mesh *m);

/* Map from labels (numbers of nodes or elements in a file) to n consecutive indices. entry: sorted by label. */
struct label_map {
    int64_t n;
    struct label_entry *entry;
};

/* An entry of a label map: a label (number of a node or element in a file) and the index to which it is mapped. */
struct label_entry {
    int64_t label, index;
};

/* Creates *map, which maps the numbers that nodes or elements have in a file (labels) to indices: label[k] is mapped to
 * first_index + k, k = 0 .. label_count - 1. Release it with label_map_free. */
void label_map_make(struct label_map *map, const int64_t *label, int64_t first_index, int64_t label_count);

/* Releases the entries of `map`, a map from numbers of a file to indices. */
void label_map_free(struct label_map *map);

/* Returns the index to which `map` maps `label`, a number of a node or element in the file; the lowest index if the
 * number occurs twice, -1 if it does not occur. */
int64_t label_map_find(const struct label_map *map, int64_t label);

/* Returns true if a number of a node or element occurs twice in `map`, and then stores the smallest such number in
 * *label. */
bool label_map_find_duplicate(const struct label_map *map, int64_t *label);

/* Reads the Gmsh file `file` into the empty mesh m. Returns REFUSED, with a message that contains the line, if the file
 * is malformed or contains elements of an unsupported kind. The caller releases m with element_mesh_free, also after a
 * failure. */
status gmsh_read(struct element_mesh *m, struct geometry_file *file);

/* Reads the Abaqus input deck `file` into the empty mesh m. Returns REFUSED, with a message that contains the line, if
 * the file is malformed. The caller releases m with element_mesh_free, also after a failure. */
status abaqus_read(struct element_mesh *m, struct geometry_file *file);

/* Reads the Exodus II file `file` into the empty mesh m. Returns REFUSED, with a message, if the file is malformed or
 * contains elements of an unsupported kind. The caller releases m with element_mesh_free, also after a failure. */
status exodus_read(struct element_mesh *m, struct geometry_file *file);

/* Reads the text or binary STL file `file` into the empty mesh m. Corners of triangles that are nearer to each other
 * than a millionth of the extent of the mesh become one node. Returns REFUSED, with a message, if the file is
 * malformed. The caller releases m with element_mesh_free, also after a failure. */
status stl_read(struct element_mesh *m, struct geometry_file *file);

/* Creates g: the surface of the body that the elements of m fill, in metres, and the surfaces of the named sets of m.
 * Release g with geometry_free. path: file, for messages; dim: dimensions of the space; unit_length: length of the unit
 * of the file [m]; max_chord_error: largest distance between a curved edge and the chords that approximate it [m], NAN
 * for 1/256 of the largest sagitta. Middle nodes may be added to m. Returns REFUSED, with a message, if no element has
 * the dimension of the body, a 2D mesh is not plane, or curved edges need too many chords. */
status geometry_create_from_element_mesh(struct geometry *g, struct element_mesh *m, const char *path, int dim,
                                         real unit_length, real max_chord_error);

/* ---- faces of a surface (elements_curved.c) ---- */

/* A side of an element with n = 1 to 4 corners. middle[k]: middle node of its edge that starts at corner k; centre:
 * middle node of the side itself. */
struct patch {
    int n;
    int32_t corner[4], middle[4], centre; /* node indices; -1: none */
};

/* The surface of the mesh m under construction, to which faces are appended. scale: length of the unit of the file
 * [m]. */
struct surface_builder {
    struct element_mesh *m;
    int dim, body_dim; /* dimension of space; dimension of the elements that make up the body */
    real scale;
    real sagitta; /* an edge is straight if its middle node is closer than this to its chord [unit of the file] */
    int pieces;   /* number of straight pieces into which a curved edge is divided in 3D */
    int64_t n;    /* number of faces; each face has `dim` node indices */
    int32_t (*face)[DIM_MAX]; /* [n] */
    int64_t patches; /* sides with middle nodes, until surface_builder_divide_sides_into_faces turns them into faces */
    struct patch *patch;
    int64_t file_nodes;     /* nodes from the file; later ones are on curved sides between the corners `parent` */
    int32_t (*parent)[4];   /* [node - file_nodes] corner nodes of the side, -1: unused */
    struct label_map edges; /* edges of elements with triangular sides, which may be diagonals of quadrilateral ones */
};

/* Appends to the faces of surface b a face with the nodes `first_node`, `second_node` and, in 3D, `third_node`
 * (indices); in 2D the face is a segment and `third_node` is ignored. */
void surface_builder_add_face(struct surface_builder *b, int32_t first_node, int32_t second_node, int32_t third_node);

/* Appends the side of an element to the faces of the surface b, as one or two triangles. corner_node[corner_count]:
 * corners of the side, 3 or 4 node indices. A quadrilateral is divided along the same diagonal as by the elements on
 * its other side, if these have triangular sides there. */
void surface_builder_add_side(struct surface_builder *b, const int32_t *corner_node, int corner_count);

/* Appends a copy of *side, a side of an element with middle nodes, to the surface b.
 * surface_builder_divide_sides_into_faces later divides this side into faces. */
void surface_builder_add_side_with_middle_nodes(struct surface_builder *b, const struct patch *side);

/* Computes for the surface b the sagitta b->sagitta below which edges count as straight, and b->pieces, the number of
 * pieces into which a curved edge is divided in 3D. max_chord_error: largest distance between chords and curve [m], NAN
 * for 1/256 of the largest sagitta; path: file, for the message. Returns REFUSED, with a message, if too many pieces
 * were needed. */
status surface_builder_set_chord_tolerance(struct surface_builder *b, const char *path, real max_chord_error);

/* Divides all sides with middle nodes that b has stored into faces, curved ones into several, for which nodes are added
 * to the mesh. remove_shared_sides: true to remove first the sides that two elements share, since they are inside the
 * body. */
void surface_builder_divide_sides_into_faces(struct surface_builder *b, bool remove_shared_sides);

#endif
