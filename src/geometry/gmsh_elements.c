/* Reads the nodes, elements and physical groups that both formats of Gmsh files contain (Gmsh reference manual, "File
 * formats"). */
#include <stdio.h>
#include <string.h>

#include "gmsh_parts.h"

/* Gmsh's element types. */
static const struct gmsh_type types[] = {
    {15, ELEMENT_POINT, 1, 1},        {1, ELEMENT_LINE, 2, 1},          {8, ELEMENT_LINE, 3, 2},
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

status gmsh_find_element_type(const struct geometry_file *file, int64_t number, const struct gmsh_type **type)
{
    for (size_t k = 0; k < COUNT_OF(types); k++)
        if (types[k].type == number) {
            *type = &types[k];
            return OK;
        }
    return geometry_file_report_fault(
        file,
        "Gmsh's element type %lld is not supported; use lines, triangles, quadrilaterals, "
        "tetrahedra, hexahedra, prisms or pyramids",
        (long long)number);
}

status gmsh_add_element_to_physical_group(struct gmsh *g, int64_t dim, int64_t tag, int64_t element)
{
    if (g->last_set < 0 || dim != g->last_dim || tag != g->last_tag) {
        char name[LONG_NAME_LENGTH];
        snprintf(name, sizeof name, "%lld", (long long)tag);
        for (int64_t k = 0; k < g->names; k++)
            if (g->name[k].dim == dim && g->name[k].tag == tag) memcpy(name, g->name[k].text, sizeof name);
        g->last_dim = dim, g->last_tag = tag, g->last_set = element_mesh_find_or_create_set(g->m, name, false);
    }
    if (g->last_set < 0)
        return geometry_file_report_fault(g->s, "the mesh has more than %d physical groups; remove some",
                                          ELEMENT_SETS_MAX);
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
    TRY((g->old ? geometry_file_read_int32 : geometry_file_read_int64)(g->s, "node of an element", &label));
    const int64_t found = label_map_find(&g->node, label);
    if (found < 0)
        return geometry_file_report_fault(
            g->s, "an element has node %lld, but $Nodes does not define it; save the mesh again", (long long)label);
    *index = (int32_t)found;
    return OK;
}

/* Checks a node on an edge of an element of g of order 3 or more: returns REFUSED, with a message, unless its distance
 * from the straight line between the ends of the edge is at most STRAIGHT times the length of the edge. type: type of
 * the element; node: corners of the element; edge: number of the edge in Gmsh's order; between: index of the node on
 * the edge. */
static status check_straight(const struct gmsh *g, const struct gmsh_type *type, const int32_t *node, int edge,
                             int32_t between)
{
    const signed char *corner = element_edges[type->kind].corner[middle_at[type->kind][edge]];
    const real *a = g->m->node[node[corner[0]]], *b = g->m->node[node[corner[1]]], *c = g->m->node[between];
    real along2 = 0, arm2 = 0, both = 0;
    for (int d = 0; d < DIM_MAX; d++)
        along2 += square(b[d] - a[d]), arm2 += square(c[d] - a[d]), both += (b[d] - a[d]) * (c[d] - a[d]);
    if (arm2 * along2 - square(both) <= square(STRAIGHT * along2)) return OK;
    return geometry_file_report_fault(
        g->s, "curved elements of order %d are not supported; save them with order 2 (gmsh -order 2)", type->order);
}

status gmsh_read_element(struct gmsh *g, const struct gmsh_type *type, int64_t label)
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

status gmsh_create_map_from_node_labels_to_indices(struct gmsh *g)
{
    int64_t twice;
    label_map_make(&g->node, g->m->node_label, 0, g->m->nodes);
    if (!label_map_find_duplicate(&g->node, &twice)) return OK;
    return geometry_file_report_fault(g->s, "node %lld is given twice; remove one of the two", (long long)twice);
}
