/* Meshes of finite elements as files hold them, whatever their format: nodes, elements, sets of both. */
#ifndef CLEAVE_ELEMENTS
#define CLEAVE_ELEMENTS

#include "geometry/geometry.h"
#include "source.h"

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

/* Number of corners, dimension, and number of middle nodes of a kind of element. Middle nodes of second-order elements
 * are those of the edges, in the order of element_edge, then those of the sides, in the order of element_sides; of a
 * triangle and a quadrilateral the last is that of the whole element. */
extern const int element_corners[ELEMENT_KINDS], element_dim[ELEMENT_KINDS], element_middles[ELEMENT_KINDS];

enum { ELEMENT_CORNERS_MAX = 8, ELEMENT_SIDES_MAX = 6, ELEMENT_EDGES_MAX = 12, ELEMENT_MIDDLES_MAX = 18 };
struct element {
    enum element_kind kind;
    int32_t node[ELEMENT_CORNERS_MAX]; /* indices of nodes */
    int64_t middle;                    /* index of its first middle node in `middle` of the mesh; -1: all straight */
};

/* Sides of elements, seen from outside counter-clockwise; of triangles 3 corners, the fourth is -1. Corners are
 * numbered as in Gmsh and Abaqus, which agree in this. In the plane sides are edges. */
struct element_sides {
    int n;
    signed char corner[ELEMENT_SIDES_MAX][4];
};
extern const struct element_sides element_sides[ELEMENT_KINDS];
struct element_edges {
    int n;
    signed char corner[ELEMENT_EDGES_MAX][2];
};
extern const struct element_edges element_edges[ELEMENT_KINDS];

struct element_set {
    char name[NAME_MAX_LENGTH];
    bool of_nodes; /* members are nodes, else elements */
    int64_t n, resolved;
    int32_t *member; /* indices; from `resolved` on still labels (abaqus.c) */
};

struct element_mesh {
    int64_t nodes;
    real (*node)[DIM_MAX]; /* as in the file */
    int64_t *node_label;   /* its number there */
    int64_t elements;
    struct element *element;
    int64_t *element_label;
    int64_t middles;
    int32_t *middle; /* indices of middle nodes of the elements that have some; -1: that side or edge has none */
    int sets;
    struct element_set *set;
    char skipped[NAME_MAX_LENGTH]; /* a kind of element that was left out; "": none */
};

enum { ELEMENT_SETS_MAX = 1000 };

status mesh_node_add(struct element_mesh *m, const struct source *s, const real *X, int64_t label);
/* Appends a node that the file does not have, at X as in the file, and returns its index. */
int32_t mesh_node_append(struct element_mesh *m, const real *X, int64_t label);
/* Appends an element whose nodes are indices. */
status mesh_element_add(struct element_mesh *m, const struct source *s, enum element_kind kind, const int32_t *node,
                        int64_t label);
/* Gives the last element its middle nodes, element_middles of its kind. */
void mesh_middles_add(struct element_mesh *m, const int32_t *middle);
/* The number of the set of this name, in any case of its letters, made if there is none; -1: too many. */
int mesh_set(struct element_mesh *m, const char *name, bool of_nodes);
void mesh_set_add(struct element_mesh *m, int set, int64_t member);
void element_mesh_free(struct element_mesh *m);

/* Numbers of a file to indices: `n` labels from `label` on, whose first has the index `first`. */
struct label_map {
    int64_t n;
    struct label_entry *entry;
};
struct label_entry {
    int64_t label, index;
};
void label_map_make(struct label_map *map, const int64_t *label, int64_t first, int64_t n);
void label_map_free(struct label_map *map);
/* -1: there is none; *twice: the first label that is given twice, if any. */
int64_t label_find(const struct label_map *map, int64_t label);
bool label_twice(const struct label_map *map, int64_t *label);

/* The formats. The mesh is empty before; what has been read is the caller's to free also after a refusal. */
status gmsh_read(struct element_mesh *m, struct source *s);
status abaqus_read(struct element_mesh *m, struct source *s);
/* Triangles as they stand in a file of either form. */
status stl_read(struct element_mesh *m, struct source *s);

/* Makes the body that the elements fill and its sets, in metres: coordinates times `scale`. fine: largest distance
 * between a curved edge and the chords that stand for it [m]; NAN: 1/256 of the largest sagitta. */
status geometry_from_elements(struct geometry *g, struct element_mesh *m, const char *path, int dim, real scale,
                              real fine);

/* ---- faces of a surface (elements_curved.c) ---- */

/* A side of an element: 1 to 4 corners, the middle nodes of its edges (edge k from corner k on) and its own. */
struct patch {
    int n;
    int32_t corner[4], middle[4], centre; /* -1: none */
};

/* Faces of a surface while they are collected. */
struct builder {
    struct element_mesh *m;
    int dim, body_dim; /* of the space; of the elements that make the body */
    real scale;
    real sagitta; /* an edge is straight whose middle node is nearer to its chord [unit of the file] */
    int pieces;   /* of a curved edge in space */
    int64_t n;    /* faces so far, by indices of nodes */
    int32_t (*face)[DIM_MAX];
    int64_t patches; /* of meshes with middle nodes; they become faces by builder_curve */
    struct patch *patch;
    int64_t file_nodes;   /* nodes of the file; later ones lie on curved sides between the corners `parent` */
    int32_t (*parent)[4]; /* [node - file_nodes], -1: fewer */
};

void builder_add(struct builder *b, int32_t i, int32_t j, int32_t k);
/* Adds a side of 3 or 4 corners as triangles. */
void builder_add_side(struct builder *b, const int32_t *node, int n);
void builder_add_patch(struct builder *b, const struct patch *p);
/* Sets sagitta and pieces. REFUSED where the curves of the mesh `path` are too coarse to be resolved to `fine` [m]. */
status builder_fineness(struct builder *b, const char *path, real fine);
/* Turns all patches into faces; curved ones are subdivided, with new nodes of the mesh. closed: patches that two
 * elements share cancel first. */
void builder_curve(struct builder *b, bool closed);

#endif
