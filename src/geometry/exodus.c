/* Reads meshes from Exodus II files: blocks of elements, sides and nodes become sets with the names of the file, or
 * block_1, surface_1, nodelist_1 and so on by their numbers where there are none (as in the library IOSS). */
#include <stdio.h>
#include <strings.h>

#include "base/memory.h"
#include "elements.h"
#include "geometry/exodus_file.h"

/* Beginnings of the names of element types without area or volume. Blocks of such elements are skipped, so that their
 * sets are empty. */
static const char *const skipped[] = {"CIRCLE", "BAR",   "BEAM",   "TRUSS", "EDGE", "ROD",
                                      "LINE",   "POINT", "SPRING", "JOINT", "NODE", "RBE"};

/* Beginnings of the names of element types, with their shapes; the first one that fits counts. */
static const struct family {
    const char *name;
    enum element_kind kind;
} families[] = {{"SPHERE", ELEMENT_POINT}, {"TRI", ELEMENT_TRIANGLE}, {"SHELL3", ELEMENT_TRIANGLE},
                {"SHELL", ELEMENT_QUAD},   {"QUAD", ELEMENT_QUAD},    {"TET", ELEMENT_TETRAHEDRON},
                {"PYR", ELEMENT_PYRAMID},  {"WEDGE", ELEMENT_PRISM},  {"HEX", ELEMENT_HEXAHEDRON}};

/* Numbers of nodes with which elements of each shape are read: first order, second order, second order with nodes at
 * the middles of sides. */
static const int sizes[ELEMENT_KINDS][3] = {[ELEMENT_POINT] = {1},
                                            [ELEMENT_TRIANGLE] = {3, 6, 7},
                                            [ELEMENT_QUAD] = {4, 8, 9},
                                            [ELEMENT_TETRAHEDRON] = {4, 10, 11},
                                            [ELEMENT_PYRAMID] = {5, 13, 14},
                                            [ELEMENT_PRISM] = {6, 15, 16},
                                            [ELEMENT_HEXAHEDRON] = {8, 20, 27}};

/* For each node of an Exodus element after its corners: its position among the middle nodes as elements.h orders
 * them; -1: interior node, ignored. */
static const signed char middle_at[ELEMENT_KINDS][1 + ELEMENT_MIDDLES_MAX] = {
    [ELEMENT_TRIANGLE] = {0, 1, 2, 3},
    [ELEMENT_QUAD] = {0, 1, 2, 3, 4},
    [ELEMENT_TETRAHEDRON] = {0, 1, 2, 3, 4, 5, -1},
    [ELEMENT_PYRAMID] = {0, 1, 2, 3, 4, 5, 6, 7, 8},
    [ELEMENT_PRISM] = {0, 1, 2, 6, 7, 8, 3, 4, 5, -1},
    [ELEMENT_HEXAHEDRON] = {0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7, -1, 12, 13, 17, 15, 14, 16}};

/* For each side of an Exodus solid element: its position in the table element_sides, which orders sides differently. */
static const signed char side_at[ELEMENT_KINDS][ELEMENT_SIDES_MAX] = {[ELEMENT_TETRAHEDRON] = {1, 2, 3, 0},
                                                                      [ELEMENT_PYRAMID] = {1, 2, 3, 4, 0},
                                                                      [ELEMENT_PRISM] = {2, 3, 4, 0, 1},
                                                                      [ELEMENT_HEXAHEDRON] = {2, 3, 4, 5, 0, 1}};

/* An Exodus II file and the mesh into which it is read; exists only while the file is read. */
struct exodus {
    struct exodus_file file;
    struct geometry_file *s;
    struct element_mesh *m;
    int64_t elements; /* of the file, in the blocks read so far */
    int32_t *element; /* [elements] index in the mesh of each element of the file; -1: left out */
};

/* ---- nodes and blocks -------------------------------------------------------------------------------------------- */

/* Appends all nodes of the file x to the mesh. Returns REFUSED, with a message, if they cannot be read. */
static status nodes_add(struct exodus *x)
{
    real *axis[DIM_MAX] = {NULL};
    status s = exodus_read_coordinates(&x->file, axis);
    for (int64_t k = 0; k < x->file.nodes && s == OK; k++) {
        real X[DIM_MAX] = {0};
        for (int d = 0; d < x->file.dim; d++) X[d] = axis[d][k];
        s = element_mesh_add_node(x->m, x->s, X, k + 1);
    }
    for (int d = 0; d < DIM_MAX; d++) memory_free(axis[d]);
    return s;
}

/* Finds the shape *kind of elements from the name `type` of their type and the number of their nodes. Sets *skip to
 * true if they have no area or volume, so that they are skipped, else to false. x: file, for the message. Returns
 * REFUSED, with a message, for unknown types. */
static status kind_of(const struct exodus *x, const char *type, int64_t nodes, enum element_kind *kind, bool *skip)
{
    *skip = false;
    if (strcmp(type, "NSIDED") == 0 || strcmp(type, "NFACED") == 0)
        return exodus_set_message_and_return_refused(
            &x->file,
            "elements of type %s (polygons and polyhedra) are not read; write the mesh with "
            "triangles, quadrilaterals, tetrahedra or hexahedra",
            type);
    for (size_t k = 0; k < COUNT_OF(skipped); k++) *skip = *skip || strncmp(type, skipped[k], strlen(skipped[k])) == 0;
    if (*skip) return OK;
    for (size_t k = 0; k < COUNT_OF(families); k++) {
        if (strncmp(type, families[k].name, strlen(families[k].name)) != 0) continue;
        *kind = families[k].kind;
        if (*kind == ELEMENT_QUAD && type[0] == 'S' && (nodes == 3 || nodes == 6)) *kind = ELEMENT_TRIANGLE;
        for (int order = 0; order < 3; order++)
            if (nodes == sizes[*kind][order]) return OK;
        break;
    }
    return exodus_set_message_and_return_refused(
        &x->file,
        "elements of type %s with %lld nodes cannot be read; use triangles, quadrilaterals, "
        "tetrahedra, pyramids, wedges or hexahedra of first or second order",
        type, (long long)nodes);
}

/* Appends an element of shape `kind` to the mesh of x. label[nodes]: its nodes, as numbers in the file, which count
 * from 1. Returns REFUSED, with a message, if a node does not exist. */
static status element_add(struct exodus *x, enum element_kind kind, const int64_t *label, int nodes)
{
    const int corners = element_corners[kind];
    int32_t node[ELEMENT_CORNERS_MAX], middle[ELEMENT_MIDDLES_MAX];
    for (int k = 0; k < ELEMENT_MIDDLES_MAX; k++) middle[k] = -1;
    for (int k = 0; k < nodes; k++) {
        if (label[k] < 1 || label[k] > x->m->nodes)
            return exodus_set_message_and_return_refused(
                &x->file, "element %lld has node %lld; give its nodes numbers from 1 to %lld",
                (long long)x->elements + 1, (long long)label[k], (long long)x->m->nodes);
        const int slot = k < corners ? -1 : middle_at[kind][k - corners];
        if (k < corners) node[k] = (int32_t)(label[k] - 1);
        if (slot >= 0) middle[slot] = (int32_t)(label[k] - 1);
    }
    TRY(element_mesh_add_element(x->m, x->s, kind, node, x->elements + 1));
    if (nodes > corners) element_mesh_set_middle_nodes_of_last_element(x->m, middle);
    return OK;
}

/* Creates a set for one of n items of the file x, such as a block, and stores the index of the set in *set. row:
 * position of the item in the file, from 0. The name of the set is that in the file's array `names`. If it is missing
 * or another set has it, the name is `word` followed by the item's number in the file's array `numbers`, such as
 * block_1. of_nodes: true for a set of nodes, false for one of elements. Returns REFUSED if the mesh already has
 * ELEMENT_SETS_MAX sets. */
static status set_begin(struct exodus *x, const char *names, const char *numbers, const char *word, int64_t row,
                        int64_t n, bool of_nodes, int *set)
{
    char name[LONG_NAME_LENGTH];
    int64_t *number = NULL;
    exodus_read_text_row(&x->file, names, 0, row, n, name);
    bool taken = name[0] == '\0';
    for (int k = 0; k < x->m->sets; k++) taken = taken || strcasecmp(x->m->set[k].name, name) == 0;
    if (taken) {
        if (exodus_has_array(&x->file, numbers, 0)) TRY(exodus_read_integers(&x->file, numbers, 0, n, &number));
        snprintf(name, sizeof name, "%s_%lld", word, (long long)(number ? number[row] : row + 1));
        memory_free(number);
    }
    *set = element_mesh_find_or_create_set(x->m, name, of_nodes);
    return *set >= 0 ? OK
                     : exodus_set_message_and_return_refused(
                           &x->file, "the mesh has more than %d blocks and sets; join some", ELEMENT_SETS_MAX);
}

/* Appends the elements of block `number` (from 1) of the file x to the mesh, and makes a set of them. Returns REFUSED,
 * with a message, for elements of unknown types or with unknown nodes. */
static status element_block_add(struct exodus *x, int64_t number)
{
    char type[NAME_MAX_LENGTH];
    int64_t elements, nodes, *label = NULL;
    enum element_kind kind = ELEMENT_POINT;
    bool skip;
    int set = -1;
    if (!exodus_has_array(&x->file, "connect", number) &&
        exodus_read_dimension_length(&x->file, "num_el_in_blk", number) == 0)
        return set_begin(x, "eb_names", "eb_prop1", "block", number - 1, x->file.blocks, false, &set);
    if (exodus_has_array(&x->file, "facconn", number)) return kind_of(x, "NFACED", 0, &kind, &skip);
    TRY(exodus_read_block_header(&x->file, number, type, &elements, &nodes));
    TRY(kind_of(x, type, nodes, &kind, &skip));
    TRY(exodus_read_integers(&x->file, "connect", number, elements * nodes, &label));
    GROW("exodus.elements", x->element, x->elements + elements);
    status s = set_begin(x, "eb_names", "eb_prop1", "block", number - 1, x->file.blocks, false, &set);
    if (skip) snprintf(x->m->skipped, sizeof x->m->skipped, "%.20s", type);
    for (int64_t k = 0; k < elements && s == OK; k++) {
        x->element[x->elements] = skip ? -1 : (int32_t)x->m->elements;
        if (!skip) s = element_add(x, kind, label + k * nodes, (int)nodes);
        if (!skip && s == OK) element_mesh_add_to_set(x->m, set, x->m->elements - 1);
        x->elements++;
    }
    memory_free(label);
    return s;
}

/* ---- sets -------------------------------------------------------------------------------------------------------- */

/* Appends edge number `edge` (from 0) of element e, with its middle node, to the mesh of x as a line element. Returns
 * REFUSED, with a message, if the mesh has too many elements. */
static status side_edge_add(struct exodus *x, const struct element *e, int edge)
{
    const signed char *corner = element_edges[e->kind].corner[edge];
    const int32_t node[2] = {e->node[corner[0]], e->node[corner[1]]};
    const int64_t middle = e->middle;
    TRY(element_mesh_add_element(x->m, x->s, ELEMENT_LINE, node, -1));
    if (middle >= 0)
        element_mesh_set_middle_nodes_of_last_element(x->m, (const int32_t[]){x->m->middle[middle + edge]});
    return OK;
}

/* Appends side number `side` (from 0) of the solid element e, with its middle nodes, to the mesh of x as a triangle or
 * quadrilateral. Returns REFUSED, with a message, if the mesh has too many elements. */
static status side_face_add(struct exodus *x, const struct element *e, int side)
{
    const signed char *corner = element_sides[e->kind].corner[side];
    const int n = corner[3] < 0 ? 3 : 4, edges = element_edges[e->kind].n;
    int32_t node[4], middle[5];
    for (int c = 0; c < n; c++) {
        const int edge = element_edge_index_between_corners(e->kind, corner[c], corner[(c + 1) % n]);
        node[c] = e->node[corner[c]];
        middle[c] = e->middle < 0 ? -1 : x->m->middle[e->middle + edge];
    }
    middle[n] = e->middle < 0 ? -1 : x->m->middle[e->middle + edges + side];
    const bool curved = e->middle >= 0;
    TRY(element_mesh_add_element(x->m, x->s, n == 3 ? ELEMENT_TRIANGLE : ELEMENT_QUAD, node, -1));
    if (curved) element_mesh_set_middle_nodes_of_last_element(x->m, middle);
    return OK;
}

/* Adds a side of an element to the set number `set` of x. element: index of the element in the mesh; side: number of
 * the side, from 1. Sides 1 and 2 of a surface element in 3D are its two faces; its edges follow. Returns REFUSED, with
 * a message, if the element has no such side. */
static status side_add(struct exodus *x, int set, int64_t element, int64_t side)
{
    const struct element e = x->m->element[element];
    const bool solid = element_dim[e.kind] == 3, shell = !solid && x->file.dim == 3;
    if (e.kind == ELEMENT_POINT) {
        element_mesh_add_to_set(x->m, set, element);
        return OK;
    }
    const int sides = solid ? element_sides[e.kind].n : element_edges[e.kind].n + (shell ? 2 : 0);
    if (side < 1 || side > sides)
        return exodus_set_message_and_return_refused(
            &x->file, "set %s has side %lld of an element that has only %d sides; correct the set", x->m->set[set].name,
            (long long)side, sides);
    if (shell && side <= 2) {
        element_mesh_add_to_set(x->m, set, element);
        return OK;
    }
    TRY(solid ? side_face_add(x, &e, side_at[e.kind][side - 1]) : side_edge_add(x, &e, (int)side - (shell ? 3 : 1)));
    element_mesh_add_to_set(x->m, set, x->m->elements - 1);
    return OK;
}

/* Finds the element with the number `label` (from 1) in the file x and stores its index in the mesh in *element, or -1
 * if the element was skipped. set: index of the set that contains it, for the message. Returns REFUSED, with a message,
 * if there is no such element. */
static status element_of(const struct exodus *x, int set, int64_t label, int64_t *element)
{
    if (label < 1 || label > x->elements)
        return exodus_set_message_and_return_refused(&x->file, "set %s has element %lld; give a number from 1 to %lld",
                                                     x->m->set[set].name, (long long)label, (long long)x->elements);
    *element = x->element[label - 1];
    return OK;
}

/* Reads side set `number` (from 1) of the file of x and adds it to the mesh x->m, as a set of elements: for each side
 * of an element (a face or edge) a new element is added to the mesh. The file has no arrays for an empty set. Returns
 * REFUSED, with a message, if the set has an element or a side of an element that does not exist. */
static status side_set_add(struct exodus *x, int64_t number)
{
    const int64_t n = exodus_read_dimension_length(&x->file, "num_side_ss", number);
    int64_t *element = NULL, *side = NULL, index;
    int set;
    TRY(set_begin(x, "ss_names", "ss_prop1", "surface", number - 1, x->file.side_sets, false, &set));
    if (n == 0) return OK;
    status s = exodus_read_integers(&x->file, "elem_ss", number, n, &element);
    if (s == OK) s = exodus_read_integers(&x->file, "side_ss", number, n, &side);
    for (int64_t k = 0; k < n && s == OK; k++) {
        s = element_of(x, set, element[k], &index);
        if (s == OK && index >= 0) s = side_add(x, set, index, side[k]);
    }
    memory_free(element);
    memory_free(side);
    return s;
}

/* Reads node set `number` (from 1) of the file of x and adds it to the mesh x->m, as a set of node indices with the
 * name in the file. The file has no array of nodes for an empty set. Returns REFUSED, with a message, if the set has a
 * node that is not in the mesh. */
static status node_set_add(struct exodus *x, int64_t number)
{
    const int64_t n = exodus_read_dimension_length(&x->file, "num_nod_ns", number);
    int64_t *node = NULL;
    int set;
    TRY(set_begin(x, "ns_names", "ns_prop1", "nodelist", number - 1, x->file.node_sets, true, &set));
    if (n == 0) return OK;
    TRY(exodus_read_integers(&x->file, "node_ns", number, n, &node));
    status s = OK;
    for (int64_t k = 0; k < n && s == OK; k++)
        if (node[k] < 1 || node[k] > x->m->nodes)
            s = exodus_set_message_and_return_refused(&x->file, "set %s has node %lld; give a number from 1 to %lld",
                                                      x->m->set[set].name, (long long)node[k], (long long)x->m->nodes);
        else
            element_mesh_add_to_set(x->m, set, node[k] - 1);
    memory_free(node);
    return s;
}

/* Reads element set `number` (from 1) of the file of x and adds it to the mesh x->m, as a set of element indices with
 * the name in the file; elements that were skipped are left out. The file has no array of elements for an empty set.
 * Returns REFUSED, with a message, if the set has an element that is not in the file. */
static status element_set_add(struct exodus *x, int64_t number)
{
    const int64_t n = exodus_read_dimension_length(&x->file, "num_ele_els", number);
    int64_t *element = NULL, index;
    int set;
    TRY(set_begin(x, "els_names", "els_prop1", "elementset", number - 1, x->file.element_sets, false, &set));
    if (n == 0) return OK;
    TRY(exodus_read_integers(&x->file, "elem_els", number, n, &element));
    status s = OK;
    for (int64_t k = 0; k < n && s == OK; k++) {
        s = element_of(x, set, element[k], &index);
        if (s == OK && index >= 0) element_mesh_add_to_set(x->m, set, index);
    }
    memory_free(element);
    return s;
}

/* Reads nodes, blocks and sets of the file x into the mesh. Side sets are read before node sets: if a side set and a
 * node set have the same name, the side set keeps it, since it contains more information. Returns REFUSED for an
 * invalid file. */
static status mesh_read(struct exodus *x)
{
    const struct exodus_file *f = &x->file;
    if (f->blocks > ELEMENT_SETS_MAX || f->side_sets > ELEMENT_SETS_MAX || f->node_sets > ELEMENT_SETS_MAX ||
        f->element_sets > ELEMENT_SETS_MAX)
        return exodus_set_message_and_return_refused(f, "the mesh has more than %d blocks and sets; join some",
                                                     ELEMENT_SETS_MAX);
    TRY(nodes_add(x));
    for (int64_t k = 1; k <= f->blocks; k++) TRY(element_block_add(x, k));
    for (int64_t k = 1; k <= f->side_sets; k++) TRY(side_set_add(x, k));
    for (int64_t k = 1; k <= f->element_sets; k++) TRY(element_set_add(x, k));
    for (int64_t k = 1; k <= f->node_sets; k++) TRY(node_set_add(x, k));
    return OK;
}

status exodus_read(struct element_mesh *m, struct geometry_file *file)
{
    struct exodus x = {.s = file, .m = m};
    file->binary = true;
    TRY(exodus_open_from_memory(&x.file, file->path, file->text, file->length));
    const status result = mesh_read(&x);
    exodus_close(&x.file);
    memory_free(x.element);
    return result;
}
