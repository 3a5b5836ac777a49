/* Declarations shared by the files gmsh*.c, which read Gmsh .msh files: the file while it is read, and what its formats
 * 2.2 and 4.1 have in common. */
#ifndef CLEAVE_GMSH_PARTS
#define CLEAVE_GMSH_PARTS

#include "elements.h"

/* Largest number of physical groups of one entity (point, curve, surface or volume) of a Gmsh file; further ones are
 * not read. */
enum { GROUPS_MAX = 16 };

/* An element type of Gmsh: its number in files, its shape, its number of nodes (the corners come first) and its
 * polynomial order. */
struct gmsh_type {
    int type;
    enum element_kind kind;
    int nodes, order;
};

/* State of the reader of a Gmsh file, while it is read: the file, the mesh that is made from it, and the physical
 * groups of the file with the entities (points, curves, surfaces, volumes) that belong to them. */
struct gmsh {
    struct geometry_file *s; /* the text of the file, and where it is read */
    struct element_mesh *m;  /* the mesh that is made from the file */
    bool bytes, old;         /* numbers are binary; format 2.2 */
    const char *items;       /* what the current section counts, such as "nodes" or "blocks"; NULL: nothing */
    int64_t announced;       /* number of these items according to the file */
    struct label_map node;   /* index of each node label, once the nodes are read */
    int64_t names;           /* number of physical groups that have a name: name[names] */
    struct group_name {
        int64_t dim, tag;
        char text[LONG_NAME_LENGTH];
    } * name;
    int64_t links;           /* number of pairs of an entity and a physical group to which it belongs */
    int64_t *entity, *group; /* [links] key of the entity (gmsh_entity_key_from_dimension_and_tag); tag of the group */
    struct label_map of_entity; /* pairs of each entity */
    int64_t last_dim, last_tag; /* dimension and tag of the group of the last element added; last_set: its set */
    int last_set;
};

/* Returns a number that identifies an entity of a Gmsh file (point, curve, surface or volume) by its dimension dim (0
 * to 3) and its number `tag` in the file. */
static inline int64_t gmsh_entity_key_from_dimension_and_tag(int64_t dim, int64_t tag) { return tag * 4 + dim; }

/* Sets *type to the element type with Gmsh's number `number`. Returns REFUSED, with a message, for an unsupported type.
 */
status gmsh_find_element_type(const struct geometry_file *file, int64_t number, const struct gmsh_type **type);

/* Adds an element to the set that the mesh of g has of a physical group, which is created if it is new. dim, tag:
 * dimension and number of the group; element: index of the element in the mesh. Returns REFUSED, with a message, if
 * there are too many groups. */
status gmsh_add_element_to_physical_group(struct gmsh *g, int64_t dim, int64_t tag, int64_t element);

/* Reads the nodes of an element of type `type` from the file g and appends it to the mesh. Stores middle nodes of
 * second-order elements only; edges of higher order must be straight. label: number of the element in the file. Returns
 * REFUSED, with a message, for unknown nodes. */
status gmsh_read_element(struct gmsh *g, const struct gmsh_type *type, int64_t label);

/* Creates g->node, the map from labels of nodes to their indices. Returns REFUSED, with a message, if a label occurs
 * twice. */
status gmsh_create_map_from_node_labels_to_indices(struct gmsh *g);

/* Reads the section of nodes of the file g in format 2.2 into the mesh. Returns REFUSED, with a message, if it is
 * malformed or a label occurs twice. */
status gmsh22_read_nodes(struct gmsh *g);

/* Reads the section of elements of the file g in format 2.2 into the mesh. In binary files, elements of one type are in
 * blocks with a header; in text files each element has its type. Returns REFUSED, with a message, if it is malformed.
 */
status gmsh22_read_elements(struct gmsh *g);

/* Reads the section of nodes of the file g in format 4.1 into the mesh, block by block. Returns REFUSED, with a
 * message, if it is malformed or a label occurs twice. */
status gmsh41_read_nodes(struct gmsh *g);

/* Reads the section of elements of the file g in format 4.1 into the mesh, block by block. Returns REFUSED, with a
 * message, if it is malformed. */
status gmsh41_read_elements(struct gmsh *g);

#endif
