/* Reads Gmsh .msh files, formats 2.2 and 4.1, text or binary (Gmsh reference manual, "File formats"). Physical groups
 * become sets with the group's name, or its number if it has none. */
#include <ctype.h>
#include <stdio.h>
#include <strings.h>

#include "base/memory.h"
#include "elements.h"

/* Gmsh's element types: shape, number of nodes (the corners come first) and polynomial order. */
static const struct gmsh_type {
    int type;
    enum element_kind kind;
    int nodes, order;
} types[] = {{15, ELEMENT_POINT, 1, 1},        {1, ELEMENT_LINE, 2, 1},          {8, ELEMENT_LINE, 3, 2},
             {26, ELEMENT_LINE, 4, 3},         {27, ELEMENT_LINE, 5, 4},         {28, ELEMENT_LINE, 6, 5},
             {2, ELEMENT_TRIANGLE, 3, 1},      {9, ELEMENT_TRIANGLE, 6, 2},      {20, ELEMENT_TRIANGLE, 9, 3},
             {21, ELEMENT_TRIANGLE, 10, 3},    {22, ELEMENT_TRIANGLE, 12, 4},    {23, ELEMENT_TRIANGLE, 15, 4},
             {24, ELEMENT_TRIANGLE, 15, 5},    {25, ELEMENT_TRIANGLE, 21, 5},    {3, ELEMENT_QUAD, 4, 1},
             {10, ELEMENT_QUAD, 9, 2},         {16, ELEMENT_QUAD, 8, 2},         {4, ELEMENT_TETRAHEDRON, 4, 1},
             {11, ELEMENT_TETRAHEDRON, 10, 2}, {29, ELEMENT_TETRAHEDRON, 20, 3}, {30, ELEMENT_TETRAHEDRON, 35, 4},
             {31, ELEMENT_TETRAHEDRON, 56, 5}, {5, ELEMENT_HEXAHEDRON, 8, 1},    {12, ELEMENT_HEXAHEDRON, 27, 2},
             {17, ELEMENT_HEXAHEDRON, 20, 2},  {92, ELEMENT_HEXAHEDRON, 64, 3},  {93, ELEMENT_HEXAHEDRON, 125, 4},
             {6, ELEMENT_PRISM, 6, 1},         {13, ELEMENT_PRISM, 18, 2},       {18, ELEMENT_PRISM, 15, 2},
             {7, ELEMENT_PYRAMID, 5, 1},       {14, ELEMENT_PYRAMID, 14, 2},     {19, ELEMENT_PYRAMID, 13, 2}};

/* For each node of a Gmsh element after its corners: its position among the middle nodes as elements.h orders them;
 * -1: interior node, ignored. Nodes of edges come first, also in elements of higher order, whose edges have the same
 * order. */
static const signed char middle_at[ELEMENT_KINDS][1 + ELEMENT_MIDDLES_MAX] = {
    [ELEMENT_LINE] = {0},
    [ELEMENT_TRIANGLE] = {0, 1, 2, 3},
    [ELEMENT_QUAD] = {0, 1, 2, 3, 4},
    [ELEMENT_TETRAHEDRON] = {0, 1, 2, 3, 5, 4},
    [ELEMENT_PYRAMID] = {0, 3, 4, 1, 5, 2, 6, 7, 8},
    [ELEMENT_PRISM] = {0, 2, 6, 1, 7, 8, 3, 5, 4, 11, 13, 12},
    [ELEMENT_HEXAHEDRON] = {0, 3, 8, 1, 9, 2, 10, 11, 4, 7, 5, 6, 12, 14, 17, 15, 16, 13, -1}};
#define STRAIGHT 1e-6 /* an edge is straight up to this distance of its nodes from the chord [length of the edge] */

enum { GROUPS_MAX = 16 }; /* largest number of groups of an entity */

/* A Gmsh file while it is read. */
struct gmsh {
    struct source *s;
    struct element_mesh *m;
    bool bytes, old;       /* numbers are binary; format 2.2 */
    const char *items;     /* what the current section counts, such as "nodes" or "blocks"; NULL: nothing */
    int64_t announced;     /* number of these items according to the file */
    struct label_map node; /* index of each node label, once the nodes are read */
    int64_t names;         /* number of physical groups that have a name: name[names] */
    struct group_name {
        int64_t dim, tag;
        char text[LONG_NAME_LENGTH];
    } * name;
    int64_t links;              /* number of pairs of an entity and a physical group to which it belongs */
    int64_t *entity, *group;    /* [links] key of the entity (entity_key); tag of the group */
    struct label_map of_entity; /* pairs of each entity */
    int64_t last_dim, last_tag; /* dimension and tag of the group of the last element added; last_set: its set */
    int last_set;
};

/* Returns a number that identifies an entity of a Gmsh file (point, curve, surface or volume) by its dimension dim (0
 * to 3) and its number `tag` in the file. */
static int64_t entity_key(int64_t dim, int64_t tag) { return tag * 4 + dim; }

/* Sets *type to the row of the table `types` for Gmsh's element type `number`. Returns REFUSED for an unsupported
 * type. */
static status type_of(const struct source *s, int64_t number, const struct gmsh_type **type)
{
    for (size_t k = 0; k < COUNT_OF(types); k++)
        if (types[k].type == number) {
            *type = &types[k];
            return OK;
        }
    return source_report_fault(s,
                               "Gmsh's element type %lld is not supported; use lines, triangles, quadrilaterals, "
                               "tetrahedra, hexahedra, prisms or pyramids",
                               (long long)number);
}

/* Adds an element to the set that the mesh of g has of a physical group, which is created if it is new. dim, tag:
 * dimension and number of the group; element: index of the element in the mesh. Returns REFUSED if there are too many
 * groups. */
static status group_add(struct gmsh *g, int64_t dim, int64_t tag, int64_t element)
{
    if (g->last_set < 0 || dim != g->last_dim || tag != g->last_tag) {
        char name[LONG_NAME_LENGTH];
        snprintf(name, sizeof name, "%lld", (long long)tag);
        for (int64_t k = 0; k < g->names; k++)
            if (g->name[k].dim == dim && g->name[k].tag == tag) memcpy(name, g->name[k].text, sizeof name);
        g->last_dim = dim, g->last_tag = tag, g->last_set = element_mesh_find_or_create_set(g->m, name, false);
    }
    if (g->last_set < 0)
        return source_report_fault(g->s, "the mesh has more than %d physical groups; remove some", ELEMENT_SETS_MAX);
    element_mesh_add_to_set(g->m, g->last_set, element);
    struct element_set *set = &g->m->set[g->last_set];
    set->mixed = set->mixed || element_dim[g->m->element[set->member[0]].kind] != dim;
    return OK;
}

/* Reads the number (label) of a node of an element from the file g, and stores the node's index in *index. Returns
 * REFUSED for an unknown node. */
static status node_next(struct gmsh *g, int32_t *index)
{
    int64_t label;
    TRY((g->old ? source_read_int32 : source_read_int64)(g->s, "node of an element", &label));
    const int64_t found = label_map_find(&g->node, label);
    if (found < 0)
        return source_report_fault(g->s, "an element has node %lld, but $Nodes does not define it; save the mesh again",
                                   (long long)label);
    *index = (int32_t)found;
    return OK;
}

/* Checks a node on an edge of an element of g of order 3 or more: returns REFUSED unless it is on the straight line
 * between the ends of the edge. type: type of the element; node: corners of the element; edge: number of the edge in
 * Gmsh's order; between: index of the node on the edge. */
static status check_straight(const struct gmsh *g, const struct gmsh_type *type, const int32_t *node, int edge,
                             int32_t between)
{
    const signed char *corner = element_edges[type->kind].corner[middle_at[type->kind][edge]];
    const real *a = g->m->node[node[corner[0]]], *b = g->m->node[node[corner[1]]], *c = g->m->node[between];
    real along2 = 0, arm2 = 0, both = 0;
    for (int d = 0; d < DIM_MAX; d++)
        along2 += square(b[d] - a[d]), arm2 += square(c[d] - a[d]), both += (b[d] - a[d]) * (c[d] - a[d]);
    if (arm2 * along2 - square(both) <= square(STRAIGHT * along2)) return OK;
    return source_report_fault(
        g->s, "curved elements of order %d are not supported; save them with order 2 (gmsh -order 2)", type->order);
}

/* Reads the nodes of an element of type `type` from the file g and appends it to the mesh. Stores middle nodes of
 * second-order elements only; edges of higher order must be straight. label: number of the element in the file. Returns
 * REFUSED for unknown nodes. */
static status element_next(struct gmsh *g, const struct gmsh_type *type, int64_t label)
{
    const int corners = element_corners[type->kind], edges = element_edges[type->kind].n;
    int32_t node[ELEMENT_CORNERS_MAX], middle[ELEMENT_MIDDLES_MAX], other;
    for (int k = 0; k < ELEMENT_MIDDLES_MAX; k++) middle[k] = -1;
    for (int k = 0; k < type->nodes; k++) {
        const int between = k - corners;
        TRY(node_next(g, between < 0 ? &node[k] : &other));
        if (between >= 0 && type->order == 2 && middle_at[type->kind][between] >= 0)
            middle[middle_at[type->kind][between]] = other;
        if (between >= 0 && type->order > 2 && between < edges * (type->order - 1))
            TRY(check_straight(g, type, node, between / (type->order - 1), other));
    }
    TRY(element_mesh_add_element(g->m, g->s, type->kind, node, label));
    if (type->order == 2) element_mesh_set_middle_nodes_of_last_element(g->m, middle);
    return OK;
}

/* Creates g->node, the map from labels of nodes to their indices. Returns REFUSED if a label occurs twice. */
static status nodes_known(struct gmsh *g)
{
    int64_t twice;
    label_map_make(&g->node, g->m->node_label, 0, g->m->nodes);
    if (!label_map_find_duplicate(&g->node, &twice)) return OK;
    return source_report_fault(g->s, "node %lld is given twice; remove one of the two", (long long)twice);
}

/* ---- physical names and entities ------------------------------------------------------------------------------- */

/* Reads a text in double quotes from the file s into text[capacity]; longer texts are cut off. Returns REFUSED if the
 * text does not begin with a quote, or does not end with one on the same line. */
static status quoted_next(struct source *s, char *text, size_t capacity)
{
    size_t n = 0;
    if (!source_skip_blanks(s) || s->text[s->at] != '"')
        return source_report_fault(s, "the name of this group is not in quotes; write it in quotes");
    for (s->at++; s->at < s->length && s->text[s->at] != '"' && s->text[s->at] != '\n'; s->at++)
        if (n + 1 < capacity) text[n++] = s->text[s->at];
    text[n] = '\0';
    if (s->at >= s->length || s->text[s->at] != '"') return source_report_fault(s, "a name has no closing quote");
    s->at++;
    return OK;
}

/* Reads the section of the names of physical groups into g->name. Returns REFUSED if it is malformed, or there are too
 * many. */
static status names_read(struct gmsh *g)
{
    int64_t n;
    TRY(source_read_integer(g->s, "number of names", &n));
    TRY(source_check_count_fits_file(g->s, "names", n, 4));
    g->announced = n, g->items = "names";
    if (n > ELEMENT_SETS_MAX)
        return source_report_fault(g->s, "the mesh has more than %d physical groups; remove some", ELEMENT_SETS_MAX);
    GROW("gmsh.names", g->name, n);
    for (g->names = 0; g->names < n; g->names++) {
        struct group_name *name = &g->name[g->names];
        TRY(source_read_integer(g->s, "dimension of a group", &name->dim));
        TRY(source_read_integer(g->s, "tag of a group", &name->tag));
        TRY(quoted_next(g->s, name->text, sizeof name->text));
    }
    return OK;
}

/* Records in g that an entity of the file belongs to the physical group with the tag `group`. entity: number of the
 * entity, as returned by entity_key. */
static void entity_group_add(struct gmsh *g, int64_t entity, int64_t group)
{
    GROW("gmsh.entities", g->entity, g->links + 1);
    GROW("gmsh.entities", g->group, g->links + 1);
    g->entity[g->links] = entity, g->group[g->links++] = group;
}

/* Reads an entity of dimension dim from the file g: its tag, bounding box (for a point its position), physical groups
 * and, except for points, bounding entities. Stores only the groups. Returns REFUSED if it is malformed. */
static status entity_read(struct gmsh *g, int64_t dim)
{
    int64_t tag, groups, group, bounds;
    real box;
    TRY(source_read_int32(g->s, "tag of an entity", &tag));
    for (int k = 0; k < (dim == 0 ? 3 : 6); k++) TRY(source_read_real(g->s, "coordinate", &box));
    TRY(source_read_int64(g->s, "number of groups", &groups));
    TRY(source_check_count_fits_file(g->s, "groups", groups, 2));
    for (int64_t k = 0; k < groups; k++) {
        TRY(source_read_int32(g->s, "tag of a group", &group));
        entity_group_add(g, entity_key(dim, tag), group < 0 ? -group : group);
    }
    if (dim == 0) return OK;
    TRY(source_read_int64(g->s, "number of bounding entities", &bounds));
    TRY(source_check_count_fits_file(g->s, "bounding entities", bounds, 2));
    for (int64_t k = 0; k < bounds; k++) TRY(source_read_int32(g->s, "tag of an entity", &tag));
    return OK;
}

/* Reads the section of entities (format 4.1), and creates g->of_entity, the map to their physical groups. Returns
 * REFUSED if it is malformed. */
static status entities_read(struct gmsh *g)
{
    int64_t n[1 + DIM_MAX];
    g->announced = 0, g->items = "entities";
    for (int d = 0; d <= DIM_MAX; d++) TRY(source_read_int64(g->s, "number of entities", &n[d]));
    for (int d = 0; d <= DIM_MAX; d++) {
        TRY(source_check_count_fits_file(g->s, "entities", n[d], 8));
        g->announced += n[d];
        for (int64_t k = 0; k < n[d]; k++) TRY(entity_read(g, d));
    }
    label_map_free(&g->of_entity);
    label_map_make(&g->of_entity, g->entity, 0, g->links);
    return OK;
}

/* ---- format 2.2 ----------------------------------------------------------------------------------------------- */

/* Reads a count from the file g into *n and advances to the next line. In format 2.2 counts are text even in binary
 * files. what: what is counted, for messages; bytes: least size of one counted item. Returns REFUSED if the file is too
 * short for so many items. */
static status old_count(struct gmsh *g, const char *what, int64_t bytes, int64_t *n)
{
    g->s->binary = false;
    TRY(source_read_integer(g->s, what, n));
    source_skip_to_next_line(g->s);
    g->s->binary = g->bytes;
    g->announced = *n, g->items = what;
    return source_check_count_fits_file(g->s, what, *n, bytes);
}

/* Reads the section of nodes of the file g in format 2.2 into the mesh. Returns REFUSED if it is malformed or a label
 * occurs twice. */
static status old_nodes(struct gmsh *g)
{
    int64_t n, label;
    TRY(old_count(g, "nodes", 8, &n));
    for (int64_t k = 0; k < n; k++) {
        real X[DIM_MAX];
        TRY(source_read_int32(g->s, "number of a node", &label));
        for (int d = 0; d < DIM_MAX; d++) TRY(source_read_real(g->s, "coordinate", &X[d]));
        TRY(element_mesh_add_node(g->m, g->s, X, label));
    }
    return nodes_known(g);
}

/* Removes the last element of the mesh of g if it equals the element before it: format 2.2 lists an element of several
 * physical groups once for each of them. group: physical group of the last element; the caller then adds the remaining
 * element to it. */
static void old_element_merge(struct gmsh *g, int64_t group)
{
    const struct element *last = &g->m->element[g->m->elements - 1];
    if (g->m->elements < 2 || group == g->last_tag || last->kind != last[-1].kind ||
        !arrays_equal(last->node, last[-1].node, element_corners[last->kind], sizeof *last->node))
        return;
    if (last->middle >= 0) g->m->middles = last->middle;
    g->m->elements--;
}

/* Reads an element of the file g in format 2.2: its tags, of which the first is its physical group (0 for none), and
 * then its nodes. type: type of the element; label: its number in the file; tags: number of tags. Returns REFUSED if it
 * is malformed. */
static status old_element(struct gmsh *g, const struct gmsh_type *type, int64_t label, int64_t tags)
{
    int64_t tag, group = 0;
    TRY(source_check_count_fits_file(g->s, "tags", tags, 2));
    for (int64_t k = 0; k < tags; k++) TRY(source_read_int32(g->s, "tag", k == 0 ? &group : &tag));
    TRY(element_next(g, type, label));
    old_element_merge(g, group);
    return group == 0 ? OK : group_add(g, element_dim[type->kind], group, g->m->elements - 1);
}

/* Reads the section of elements of the file g in format 2.2 into the mesh. In binary files, elements of one type are in
 * blocks with a header; in text files each element has its type. Returns REFUSED if it is malformed. */
static status old_elements(struct gmsh *g)
{
    int64_t n, label = 0, number, tags, block = 1;
    const struct gmsh_type *type = NULL;
    TRY(old_count(g, "elements", 8, &n));
    for (int64_t k = 0; k < n; k += block) {
        if (!g->bytes) TRY(source_read_int32(g->s, "number of an element", &label));
        TRY(source_read_int32(g->s, "type of an element", &number));
        if (g->bytes) TRY(source_read_int32(g->s, "number of elements", &block));
        TRY(source_read_int32(g->s, "number of tags", &tags));
        TRY(type_of(g->s, number, &type));
        if (block < 1) return source_report_fault(g->s, "a block of %lld elements", (long long)block);
        TRY(source_check_count_fits_file(g->s, "elements", block, g->bytes ? 8 : 2));
        for (int64_t e = 0; e < block; e++) {
            if (g->bytes) TRY(source_read_int32(g->s, "number of an element", &label));
            TRY(old_element(g, type, label, tags));
        }
    }
    return OK;
}

/* ---- format 4.1 ----------------------------------------------------------------------------------------------- */

/* Reads the first line of a section of the file g in format 4.1: the number of blocks into *blocks, the number of nodes
 * or elements in all blocks into *total, and the smallest and largest label, which are not stored. what: nodes or
 * elements, for messages. Returns REFUSED if the line is malformed. */
static status new_head(struct gmsh *g, const char *what, int64_t *blocks, int64_t *total)
{
    int64_t skipped;
    TRY(source_read_int64(g->s, "number of blocks", blocks));
    TRY(source_read_int64(g->s, what, total));
    for (int k = 0; k < 2; k++) TRY(source_read_int64(g->s, what, &skipped));
    g->announced = *blocks, g->items = "blocks";
    return source_check_count_fits_file(g->s, "blocks", *blocks, 8);
}

/* Checks a section of the file g in format 4.1: returns REFUSED, with a message, unless `found`, the number of rows in
 * all of its blocks, equals `announced`, the number in its first line. what: nodes or elements, for the message. */
static status new_total(const struct gmsh *g, const char *what, int64_t announced, int64_t found)
{
    if (found == announced) return OK;
    return source_report_fault(
        g->s, "the section gives %lld %s, but its blocks contain %lld, so the file is damaged; save it again",
        (long long)announced, what, (long long)found);
}

/* Reads a block of nodes of the file g in format 4.1: their labels, then their coordinates. Each node may have
 * parameters on its entity after its coordinates, which are ignored. Returns REFUSED if the block is malformed. */
static status new_node_block(struct gmsh *g)
{
    int64_t dim, tag, parametric, n, label;
    TRY(source_read_int32(g->s, "dimension", &dim));
    TRY(source_read_int32(g->s, "tag of an entity", &tag));
    TRY(source_read_int32(g->s, "parametric", &parametric));
    TRY(source_read_int64(g->s, "number of nodes", &n));
    TRY(source_check_count_fits_file(g->s, "nodes", n, 8));
    if (dim < 0 || dim > 3)
        return source_report_fault(g->s, "a block of $Nodes has the dimension %lld; give 0 to 3", (long long)dim);
    const int64_t first = g->m->nodes;
    for (int64_t k = 0; k < n; k++) {
        TRY(source_read_int64(g->s, "number of a node", &label));
        TRY(element_mesh_add_node(g->m, g->s, (const real[DIM_MAX]){0}, label));
    }
    for (int64_t k = first; k < first + n; k++) {
        real own;
        for (int d = 0; d < DIM_MAX; d++) TRY(source_read_real(g->s, "coordinate", &g->m->node[k][d]));
        for (int d = 0; d < dim && parametric != 0; d++) TRY(source_read_real(g->s, "coordinate", &own));
    }
    return OK;
}

/* Reads the section of nodes of the file g in format 4.1 into the mesh, block by block. Returns REFUSED if it is
 * malformed or a label occurs twice. */
static status new_nodes(struct gmsh *g)
{
    const int64_t first = g->m->nodes;
    int64_t blocks, total;
    TRY(new_head(g, "number of nodes", &blocks, &total));
    for (int64_t k = 0; k < blocks; k++) TRY(new_node_block(g));
    TRY(new_total(g, "nodes", total, g->m->nodes - first));
    return nodes_known(g);
}

/* Reads a block of elements of the file g in format 4.1, which have one type and belong to one entity, and adds them to
 * the physical groups of the entity. Returns REFUSED if it is malformed. */
static status new_element_block(struct gmsh *g)
{
    int64_t dim, tag, number, n, label;
    const struct gmsh_type *type = NULL;
    TRY(source_read_int32(g->s, "dimension", &dim));
    TRY(source_read_int32(g->s, "tag of an entity", &tag));
    TRY(source_read_int32(g->s, "type of an element", &number));
    TRY(source_read_int64(g->s, "number of elements", &n));
    TRY(type_of(g->s, number, &type));
    TRY(source_check_count_fits_file(g->s, "elements", n, 4));
    const int64_t key = entity_key(dim, tag), link = label_map_find(&g->of_entity, key), first = g->m->elements;
    for (int64_t k = 0; k < n; k++) {
        TRY(source_read_int64(g->s, "number of an element", &label));
        TRY(element_next(g, type, label));
    }
    for (int64_t l = link; l >= 0 && l < g->links && l < link + GROUPS_MAX && g->entity[l] == key; l++)
        for (int64_t k = first; k < first + n; k++) TRY(group_add(g, element_dim[type->kind], g->group[l], k));
    return OK;
}

/* Reads the section of elements of the file g in format 4.1 into the mesh, block by block. Returns REFUSED if it is
 * malformed. */
static status new_elements(struct gmsh *g)
{
    const int64_t first = g->m->elements;
    int64_t blocks, total;
    TRY(new_head(g, "number of elements", &blocks, &total));
    for (int64_t k = 0; k < blocks; k++) TRY(new_element_block(g));
    return new_total(g, "elements", total, g->m->elements - first);
}

/* ---- sections ------------------------------------------------------------------------------------------------- */

/* Reports that the file has the format `version` of Gmsh, which is not read. Returns REFUSED. */
static status format_refuse(const struct gmsh *g, const char *version)
{
    return source_report_fault(
        g->s, "Gmsh's file format %s is not supported; save it as 4.1 (gmsh -save -format msh41) or 2.2", version);
}

/* Reads the header of the file. Returns REFUSED unless the version is 2.2 or 4.1, and numbers are as here. */
static status format_read(struct gmsh *g)
{
    char version[16];
    int64_t bytes, size, one;
    source_read_word(g->s, version, sizeof version);
    g->old = strcmp(version, "2.2") == 0 || strcmp(version, "2") == 0;
    if (!g->old && strcmp(version, "4.1") != 0) return format_refuse(g, version);
    TRY(source_read_integer(g->s, "kind of file", &bytes));
    TRY(source_read_integer(g->s, "size of numbers", &size));
    if (size != 8)
        return source_report_fault(g->s, "numbers have %lld bytes each; save the mesh with 8", (long long)size);
    g->bytes = bytes != 0;
    if (!g->bytes) return OK;
    source_skip_to_next_line(g->s);
    g->s->binary = true;
    TRY(source_read_int32(g->s, "the number 1", &one));
    g->s->binary = false;
    if (one == 1) return OK;
    return source_report_fault(g->s,
                               "the file has the byte order of another kind of processor; save it as text (ASCII)");
}

/* Skips the rest of the section `name` of the file s, such as $Nodes: advances to the line after its last one, such as
 * $EndNodes, or to the end of the file. */
static void section_skip(struct source *s, const char *name)
{
    char end[48];
    const int length = snprintf(end, sizeof end, "$End%s", name + 1);
    const char *found = memmem(s->text + s->at, (size_t)(s->length - s->at), end, (size_t)length);
    s->at = found ? found - s->text + length : s->length;
}

/* Advances over the last line of the section `name` of the file g, such as $EndNodes of $Nodes. Returns REFUSED, with a
 * message, if the next line is another one, because the section has more entries than its first line announces. */
static status section_end(struct gmsh *g, const char *name)
{
    char end[48], word[sizeof end];
    snprintf(end, sizeof end, "$End%s", name + 1);
    source_skip_blanks(g->s);
    source_read_word(g->s, word, sizeof word);
    if (strcmp(word, end) == 0) return OK;
    return source_report_fault(g->s,
                               "%s gives %lld %s, but more follow in place of %s, so the count is wrong or the file "
                               "damaged; save the mesh again",
                               name, (long long)g->announced, g->items, end);
}

/* Reads the section `name` of the file g, such as $Nodes, or skips it if it is not needed. Returns REFUSED if it is
 * malformed. */
static status section_read(struct gmsh *g, const char *name)
{
    static const struct section {
        const char *name;
        status (*old)(struct gmsh *), (*new)(struct gmsh *);
    } sections[] = {{"$PhysicalNames", names_read, names_read},
                    {"$Nodes", old_nodes, new_nodes},
                    {"$Elements", old_elements, new_elements},
                    {"$Entities", NULL, entities_read}};
    if (strcmp(name, "$PartitionedEntities") == 0)
        return source_report_fault(g->s, "the mesh has partitions, which are not supported; save it without them");
    if (strcmp(name, "$Nodes") == 0 && g->node.entry)
        return source_report_fault(g->s, "the mesh has a second section of nodes; remove one of the two");
    for (size_t k = 0; k < COUNT_OF(sections); k++) {
        if (strcmp(name, sections[k].name) != 0 || (g->old && !sections[k].old)) continue;
        if (!g->old && g->bytes && k > 0) source_skip_to_next_line(g->s);
        g->s->binary = !g->old && g->bytes && k > 0; /* names are text also in binary files */
        const status s = (g->old ? sections[k].old : sections[k].new)(g);
        g->s->binary = false;
        return s == OK ? section_end(g, name) : s;
    }
    section_skip(g->s, name);
    return OK;
}

/* Reads all sections of the file g. Returns REFUSED if one is malformed, or if there are no nodes or elements. */
static status sections_read(struct gmsh *g)
{
    char name[40];
    source_read_word(g->s, name, sizeof name);
    if (strcmp(name, "$NOD") == 0) return format_refuse(g, "1");
    if (strcmp(name, "$MeshFormat") != 0)
        return source_report_fault(
            g->s, "the file does not begin with $MeshFormat, so it is not a mesh of Gmsh; save it with Gmsh");
    TRY(format_read(g));
    section_skip(g->s, name);
    while (source_skip_blanks(g->s)) {
        source_read_word(g->s, name, sizeof name);
        if (name[0] != '$')
            return source_report_fault(
                g->s, "%.30s is not the beginning of a section, such as $Nodes; save the mesh again", name);
        TRY(section_read(g, name));
    }
    if (!g->node.entry) return source_report_fault(g->s, "ends without $Nodes");
    return g->m->elements > 0 ? OK : source_report_fault(g->s, "ends without $Elements");
}

status gmsh_read(struct element_mesh *m, struct source *s)
{
    struct gmsh g = {.s = s, .m = m, .last_set = -1};
    const status result = sections_read(&g);
    label_map_free(&g.node);
    label_map_free(&g.of_entity);
    memory_free(g.name);
    memory_free(g.entity);
    memory_free(g.group);
    return result;
}
