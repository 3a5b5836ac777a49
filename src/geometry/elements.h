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

/* What an element is by its corners; nodes in the middle of sides are left out when it is read. */
extern const int element_corners[ELEMENT_KINDS], element_dim[ELEMENT_KINDS];

enum { ELEMENT_CORNERS_MAX = 8 };
struct element {
    enum element_kind kind;
    int32_t node[ELEMENT_CORNERS_MAX]; /* indices of nodes */
};

struct element_set {
    char name[NAME_MAX_LENGTH];
    bool of_nodes; /* members are nodes, else elements */
    int64_t n, room, resolved;
    int32_t *member; /* indices; from `resolved` on still labels (abaqus.c) */
};

struct element_mesh {
    int64_t nodes, node_room;
    real (*node)[DIM_MAX]; /* as in the file */
    int64_t *node_label;   /* its number there */
    int64_t elements, element_room;
    struct element *element;
    int64_t *element_label;
    int sets;
    struct element_set *set;
    char skipped[NAME_MAX_LENGTH]; /* a kind of element that was left out; "": none */
};

enum { ELEMENT_SETS_MAX = 1000 };

status mesh_node_add(struct element_mesh *m, const struct source *s, const real *X, int64_t label);
/* Appends an element whose nodes are indices. */
status mesh_element_add(struct element_mesh *m, const struct source *s, enum element_kind kind, const int32_t *node,
                        int64_t label);
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

/* The body that the elements fill and its sets, in metres: coordinates times `scale`. */
status geometry_from_elements(struct geometry *g, struct element_mesh *m, const char *path, int dim, real scale);

#endif
