/* Makes the surface of the body that elements fill, in which inner faces cancel, and the surfaces of its sets. */
#include <math.h>

#include "base/memory.h"
#include "elements.h"

void surface_builder_add_face(struct surface_builder *b, int32_t first_node, int32_t second_node, int32_t third_node)
{
    GROW("mesh.face", b->face, b->n + 1);
    const int32_t face[DIM_MAX] = {first_node, second_node, third_node};
    memcpy(b->face[b->n++], face, sizeof face);
}

/* Returns true if the point X[DIM_MAX] comes before Y in the order by x, y, z: by the first coordinate in which they
 * differ by more than 1e-9 times `size`. */
static bool point_before(const real *X, const real *Y, real size)
{
    for (int d = 0; d < DIM_MAX; d++)
        if (fabs(X[d] - Y[d]) > 1e-9 * size) return X[d] < Y[d];
    return false;
}

/* Returns a number that identifies the edge between the nodes i and j. It does not depend on their order and differs
 * between edges. */
static int64_t edge_label(int32_t i, int32_t j) { return ((int64_t)(i < j ? i : j) << 32) + (i < j ? j : i); }

/* Lists in b->edges the edges of all volume elements but hexahedra. Does nothing if all volume elements are tetrahedra
 * or all are hexahedra, because sides with different diagonals then cannot meet. */
static void builder_list_edges(struct surface_builder *b)
{
    const struct element_mesh *m = b->m;
    int64_t n = 0, kinds[ELEMENT_KINDS] = {0}, solids = 0;
    for (int64_t k = 0; k < m->elements; k++)
        kinds[m->element[k].kind]++, solids += element_dim[m->element[k].kind] == 3;
    if (b->body_dim < 3 || kinds[ELEMENT_TETRAHEDRON] == solids || kinds[ELEMENT_HEXAHEDRON] == solids) return;
    int64_t *label = NEW("mesh.edges", ELEMENT_EDGES_MAX * solids, int64_t);
    for (int64_t k = 0; k < m->elements; k++) {
        const struct element *e = &m->element[k];
        const struct element_edges *edges = &element_edges[e->kind];
        if (element_dim[e->kind] < 3 || e->kind == ELEMENT_HEXAHEDRON) continue;
        for (int c = 0; c < edges->n; c++)
            label[n++] = edge_label(e->node[edges->corner[c][0]], e->node[edges->corner[c][1]]);
    }
    label_map_make(&b->edges, label, 0, n);
    memory_free(label);
}

/* Adds a side of an element to the faces of b. corner_node[corner_count]: its corners, 3 or 4 node indices. A
 * quadrilateral is divided into two triangles by the diagonal from the corner that is first by position: two elements
 * that share the side but not its nodes then have the same diagonal. The other diagonal is used if it alone is an edge
 * of an element, as where two tetrahedra adjoin the side; otherwise there would be a gap between the tetrahedra and a
 * side that is not plane. */
void surface_builder_add_side(struct surface_builder *b, const int32_t *corner_node, int corner_count)
{
    int low = 0;
    real size = 0;
    for (int d = 0; d < DIM_MAX; d++)
        size += fabs(b->m->node[corner_node[0]][d] - b->m->node[corner_node[corner_count / 2]][d]);
    for (int k = 1; k < corner_count; k++)
        if (point_before(b->m->node[corner_node[k]], b->m->node[corner_node[low]], size)) low = k;
    if (corner_count == 4 && b->edges.n > 0 &&
        label_map_find(&b->edges, edge_label(corner_node[low], corner_node[(low + 2) % 4])) < 0 &&
        label_map_find(&b->edges, edge_label(corner_node[(low + 1) % 4], corner_node[(low + 3) % 4])) >= 0)
        low = (low + 1) % 4;
    surface_builder_add_face(b, corner_node[low], corner_node[(low + 1) % corner_count],
                             corner_node[(low + 2) % corner_count]);
    if (corner_count == 4)
        surface_builder_add_face(b, corner_node[low], corner_node[(low + 2) % corner_count],
                                 corner_node[(low + 3) % corner_count]);
}

/* Adds the sides of element e to the faces of b. If the dimension of the element is lower than that of the body, adds
 * the element itself as a face. */
static void builder_add_element(struct surface_builder *b, const struct element *e)
{
    const struct element_sides *sides = &element_sides[e->kind];
    const int corners = element_corners[e->kind];
    if (element_dim[e->kind] < b->dim) {
        if (corners > 2)
            surface_builder_add_side(b, e->node, corners);
        else
            surface_builder_add_face(b, e->node[0], e->node[corners - 1], e->node[corners - 1]);
        return;
    }
    for (int k = 0; k < sides->n; k++) {
        int32_t node[4];
        const int n = b->dim == 2 ? 2 : sides->corner[k][3] < 0 ? 3 : 4;
        for (int c = 0; c < n; c++) node[c] = e->node[sides->corner[k][c]];
        if (b->dim == 2)
            surface_builder_add_face(b, node[0], node[1], 0);
        else
            surface_builder_add_side(b, node, n);
    }
}

/* Returns six times the volume enclosed by the faces of b from number `first` on; in 2D twice the area, in the unit of
 * the file to the power dim. Positive if the faces are oriented outwards. */
static real builder_volume(const struct surface_builder *b, int64_t first)
{
    const real *O = b->m->node[b->face[first][0]];
    real sum = 0;
    for (int64_t k = first; k < b->n; k++) {
        real arm[DIM_MAX][DIM_MAX];
        for (int c = 0; c < b->dim; c++)
            for (int d = 0; d < DIM_MAX; d++) arm[c][d] = b->m->node[b->face[k][c]][d] - O[d];
        const real *p = arm[0], *q = arm[1], *r = arm[2];
        sum += b->dim == 2 ? p[0] * q[1] - p[1] * q[0]
                           : p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                                 p[2] * (q[0] * r[1] - q[1] * r[0]);
    }
    return sum;
}

/* Returns one side of the element e of the mesh of b as a patch (face with middle nodes): its n corners, the middle
 * nodes of its edges, and the node at its centre. corner[n]: numbers of the corners within the element; centre: number
 * of the central node of the side among the middle nodes of the element, or -1 for none; turned: true to reverse the
 * orientation of the side. */
static struct patch patch_of(const struct surface_builder *b, const struct element *e, const signed char *corner, int n,
                             int centre, bool turned)
{
    struct patch p = {.n = n, .corner = {-1, -1, -1, -1}, .middle = {-1, -1, -1, -1}, .centre = -1};
    const int32_t *middle = e->middle < 0 ? NULL : b->m->middle + e->middle;
    for (int c = 0; c < n; c++) {
        const int from = turned ? corner[n - 1 - c] : corner[c],
                  to = turned ? corner[(2 * n - 2 - c) % n] : corner[(c + 1) % n];
        const int edge = n > 1 ? element_edge_index_between_corners(e->kind, from, to) : -1;
        p.corner[c] = e->node[from];
        if (middle && edge >= 0) p.middle[c] = middle[edge];
    }
    if (middle && centre >= 0) p.centre = middle[centre];
    return p;
}

/* Adds the sides of element e to the patches (faces with middle nodes) of b. If the dimension of the element is lower
 * than that of the body, adds the element itself as a patch. turned: true to reverse the orientation of the sides. */
static void builder_add_patches(struct surface_builder *b, const struct element *e, bool turned)
{
    static const signed char all[] = {0, 1, 2, 3};
    const struct element_sides *sides = &element_sides[e->kind];
    const int edges = element_edges[e->kind].n;
    struct patch p;
    if (element_dim[e->kind] < b->dim) {
        p = patch_of(b, e, all, element_corners[e->kind], element_dim[e->kind] == 2 ? edges : -1, turned);
        surface_builder_add_side_with_middle_nodes(b, &p);
        return;
    }
    for (int k = 0; k < sides->n; k++) {
        const int n = b->dim == 2 ? 2 : sides->corner[k][3] < 0 ? 3 : 4;
        p = patch_of(b, e, sides->corner[k], n, b->dim == 2 ? -1 : edges + k, turned);
        surface_builder_add_side_with_middle_nodes(b, &p);
    }
}

/* Adds the sides of element e, oriented outwards, to the faces of b, or to the patches (faces with middle nodes) if the
 * mesh has middle nodes. If the corners of the element are numbered in the opposite orientation, its sides are
 * reversed. */
static void builder_add_oriented(struct surface_builder *b, const struct element *e)
{
    const int64_t first = b->n;
    builder_add_element(b, e);
    const bool turned = element_dim[e->kind] == b->dim && builder_volume(b, first) < 0;
    if (b->m->middles > 0) {
        b->n = first;
        builder_add_patches(b, e, turned);
        return;
    }
    for (int64_t k = first; k < b->n && turned; k++) {
        const int32_t node = b->face[k][0];
        b->face[k][0] = b->face[k][1], b->face[k][1] = node;
    }
}

/* Makes the surface *hull of the collected faces of b and their nodes, in metres, and removes the faces from b. closed:
 * true if the surface encloses a volume. node_of: if it is not NULL, *node_of receives an allocated array with the mesh
 * node at each corner of the surface, which the caller releases with memory_free. If it is NULL, nodes that the
 * division of curved faces has added are removed from the mesh. */
static void builder_close(struct surface_builder *b, struct hull *hull, bool closed, int32_t **node_of)
{
    struct element_mesh *m = b->m;
    const int64_t nodes = m->nodes;
    surface_builder_divide_sides_into_faces(b, closed);
    int32_t *corner_of = NEW("mesh.corners", m->nodes, int32_t), *node = NEW("mesh.corners", m->nodes, int32_t), n = 0;
    for (int64_t k = 0; k < b->n; k++)
        for (int c = 0; c < b->dim; c++) corner_of[b->face[k][c]] = 1;
    for (int64_t k = 0; k < m->nodes; k++)
        if (corner_of[k]) node[n] = (int32_t)k, corner_of[k] = n++;
    real(*corner)[DIM_MAX] = memory_new("hull.corner", n, sizeof *corner);
    for (int32_t k = 0; k < n; k++)
        for (int d = 0; d < b->dim; d++) corner[k][d] = b->scale * m->node[node[k]][d];
    for (int64_t k = 0; k < b->n; k++)
        for (int c = 0; c < b->dim; c++) b->face[k][c] = corner_of[b->face[k][c]];
    (closed ? hull_make_closed_surface : hull_make_open_surface)(hull, b->dim, n, corner, b->n, b->face);
    b->face = NULL, b->n = 0;
    memory_free(corner_of);
    if (node_of) {
        *node_of = node;
        return;
    }
    memory_free(node);
    m->nodes = nodes;
}

/* ---- sets ----------------------------------------------------------------------------------------------------- */

/* Makes the surface *hull of a set of elements of the mesh of b. If some of them fill a part of the body, it is the
 * closed surface of that part. Else it is open and consists of the faces, lines and points of the set. */
static void set_of_elements(struct surface_builder *b, const struct element_set *set, struct hull *hull)
{
    const struct element *e = b->m->element;
    bool fills = false;
    for (int64_t k = 0; k < set->n; k++) fills = fills || element_dim[e[set->member[k]].kind] == b->dim;
    for (int64_t k = 0; k < set->n; k++)
        if (!fills || element_dim[e[set->member[k]].kind] == b->dim) builder_add_oriented(b, &e[set->member[k]]);
    builder_close(b, hull, fills, NULL);
}

/* Makes the surface *hull of a set of nodes of the mesh of b. It is open and consists of the nodes of the set and of
 * those faces of the body whose nodes are all in the set. A node that was added between nodes of the file, to divide a
 * curved face, counts as in the set if all of those nodes are. whole: surface of the body; node_of: mesh node at each
 * corner of `whole`. */
static void set_of_nodes(struct surface_builder *b, const struct element_set *set, const struct hull *whole,
                         const int32_t *node_of, struct hull *hull)
{
    bool *in = NEW("mesh.set", b->m->nodes, bool);
    for (int64_t k = 0; k < set->n; k++) in[set->member[k]] = true;
    for (int64_t k = b->file_nodes; k < b->m->nodes; k++) {
        const int32_t *parent = b->parent[k - b->file_nodes];
        in[k] = true;
        for (int c = 0; c < 4; c++) in[k] = in[k] && (parent[c] < 0 || in[parent[c]]);
    }
    for (int64_t k = 0; k < b->file_nodes; k++)
        if (in[k]) surface_builder_add_face(b, (int32_t)k, (int32_t)k, (int32_t)k);
    for (int64_t k = 0; k < whole->faces; k++) {
        int32_t node[DIM_MAX] = {0};
        bool all = true;
        for (int c = 0; c < b->dim; c++) node[c] = node_of[whole->face[k][c]], all = all && in[node[c]];
        if (all) surface_builder_add_face(b, node[0], node[1], node[2]);
    }
    memory_free(in);
    builder_close(b, hull, false, NULL);
}

/* Returns true if the set `set` of the mesh m consists of nodes and a set of elements that is not empty has the same
 * name, as Abaqus/CAE writes the sets of a geometry: the name then stands for the elements. */
static bool named_by_elements(const struct element_mesh *m, const struct element_set *set)
{
    for (int k = 0; k < m->sets && set->of_nodes; k++)
        if (!m->set[k].of_nodes && m->set[k].n > 0 && strcasecmp(m->set[k].name, set->name) == 0) return true;
    return false;
}

/* Returns why the set `set` of a mesh cannot be used, as the end of a sentence, or NULL if it can. */
static const char *set_fault(const struct element_set *set)
{
    if (set->n == 0)
        return "is empty, or has only elements that are not read, such as beams or springs; use another set";
    return set->mixed ? "is the name of two physical groups of different dimension; give each its own name" : NULL;
}

/* Makes the surface of each set of nodes or elements of the mesh of b, and stores it in g->set. Sets of nodes that have
 * the name of a set of elements are left out.
 * node_of: mesh node at each corner of the surface g->whole of the body. */
static void take_sets(struct surface_builder *b, const int32_t *node_of, struct geometry *g)
{
    g->set = NEW("geometry.sets", b->m->sets, struct geometry_set);
    for (int k = 0; k < b->m->sets; k++) {
        const struct element_set *set = &b->m->set[k];
        if (named_by_elements(b->m, set)) continue;
        struct geometry_set *to = &g->set[g->sets++];
        memcpy(to->name, set->name, sizeof to->name);
        to->own = set->own, to->fault = set_fault(set);
        if (to->fault) continue;
        if (set->of_nodes)
            set_of_nodes(b, set, &g->whole, node_of, &to->hull);
        else
            set_of_elements(b, set, &to->hull);
    }
}

/* ---- the body ------------------------------------------------------------------------------------------------- */

/* Finds *body_dim, the dimension of the elements of m that make up the body in a space of `dim` dimensions: dim, or 2
 * in 3D if the mesh has surface elements only, or 0 if all elements are points, as in a list of particles, which has
 * sets but fills no body. path: file of the mesh, for messages. Returns REFUSED, with a message, if the mesh has
 * elements, but none of these kinds, or has solid elements in 2D. */
static status body_dim_of(const struct element_mesh *m, const char *path, int dim, int *body_dim)
{
    int64_t n[1 + DIM_MAX] = {0};
    for (int64_t k = 0; k < m->elements; k++) n[element_dim[m->element[k].kind]]++;
    *body_dim = n[0] > 0 && n[0] == m->elements ? 0 : dim == 3 && n[3] == 0 ? 2 : dim;
    if (dim == 2 && n[3] > 0)
        return status_set(
            REFUSED,
            "%s: the mesh has volume elements; set space: solid, or give a plane mesh of triangles or quadrilaterals",
            path);
    if (n[*body_dim] > 0) return OK;
    return status_set(REFUSED, "%s: the mesh has %lld nodes but no elements that can fill a body%s%s; give it %s", path,
                      (long long)m->nodes, m->skipped[0] ? ", but others such as " : "", m->skipped,
                      dim == 2 ? "triangles or quadrilaterals"
                               : "tetrahedra, hexahedra, prisms, pyramids or a closed surface of triangles");
}

/* Returns REFUSED, with a message, unless all corners of the 2D elements of the mesh m have the same z, to 1e-6 of the
 * largest extent of these elements. path: file of the mesh, for the message. */
static status check_plane(const struct element_mesh *m, const char *path)
{
    real low[DIM_MAX] = {INFINITY, INFINITY, INFINITY}, high[DIM_MAX] = {-INFINITY, -INFINITY, -INFINITY};
    for (int64_t k = 0; k < m->elements; k++) {
        const struct element *e = &m->element[k];
        for (int c = 0; c < element_corners[e->kind] && element_dim[e->kind] == 2; c++)
            for (int d = 0; d < DIM_MAX; d++) {
                low[d] = real_min(low[d], m->node[e->node[c]][d]), high[d] = real_max(high[d], m->node[e->node[c]][d]);
            }
    }
    const real extent = real_max(high[0] - low[0], high[1] - low[1]);
    if (high[2] - low[2] <= 1e-6 * extent) return OK;
    return status_set(REFUSED,
                      "%s: the elements are not in one plane z = const: z varies from %.6g to %.6g; give a plane mesh, "
                      "or set space: solid",
                      path, low[2], high[2]);
}

/* Corners of an element in ascending order, unused ones -1, and its index in the mesh. */
struct corner_list {
    int32_t node[ELEMENT_CORNERS_MAX], element;
};

/* Compares two lists of corners a and b (struct corner_list) for array_sort: by their nodes, then by element. */
static int corner_list_order(const void *a, const void *b)
{
    const struct corner_list *p = a, *q = b;
    for (int k = 0; k < ELEMENT_CORNERS_MAX; k++)
        if (p->node[k] != q->node[k]) return p->node[k] < q->node[k] ? -1 : 1;
    return (p->element > q->element) - (p->element < q->element);
}

/* Returns the corners of element k of the mesh m in ascending order of their nodes, with the index k. */
static struct corner_list corner_list_of(const struct element_mesh *m, int64_t k)
{
    struct corner_list list = {.element = (int32_t)k};
    const int n = element_corners[m->element[k].kind];
    for (int c = 0; c < ELEMENT_CORNERS_MAX; c++) {
        int at = c;
        const int32_t node = c < n ? m->element[k].node[c] : -1;
        for (; at > 0 && list.node[at - 1] > node; at--) list.node[at] = list.node[at - 1];
        list.node[at] = node;
    }
    return list;
}

/* Returns REFUSED, with a message, if two elements of the mesh m that fill the space, of dimension `dim`, have the same
 * corners. path: file of the mesh, for the message. */
static status check_elements_differ(const struct element_mesh *m, const char *path, int dim)
{
    int64_t n = 0, doubles = 0, pair[2] = {0};
    struct corner_list *list = NEW("mesh.corners", m->elements, struct corner_list);
    for (int64_t k = 0; k < m->elements; k++)
        if (element_dim[m->element[k].kind] == dim) list[n++] = corner_list_of(m, k);
    array_sort(list, n, sizeof *list, corner_list_order);
    for (int64_t k = 1; k < n; k++) {
        if (memcmp(list[k].node, list[k - 1].node, sizeof list[k].node) != 0) continue;
        if (doubles++ == 0) pair[0] = list[k - 1].element, pair[1] = list[k].element;
    }
    memory_free(list);
    if (doubles == 0) return OK;
    const long long first = m->element_label[pair[0]], other = m->element_label[pair[1]];
    if (first == other)
        return status_set(REFUSED, "%s: element %lld is given twice; remove one of the two", path, first);
    return status_set(REFUSED,
                      "%s: %lld element%s the corners of another one (element %lld has those of element %lld); keep "
                      "each element once",
                      path, (long long)doubles, doubles == 1 ? " has" : "s have", other, first);
}

status geometry_create_from_element_mesh(struct geometry *g, struct element_mesh *m, const char *path, int dim,
                                         real unit_length, real max_chord_error)
{
    struct surface_builder b = {.m = m, .dim = dim, .scale = unit_length, .file_nodes = m->nodes};
    int32_t *node_of = NULL;
    TRY(body_dim_of(m, path, dim, &b.body_dim));
    if (dim == 2) TRY(check_plane(m, path));
    TRY(check_elements_differ(m, path, dim));
    TRY(surface_builder_set_chord_tolerance(&b, path, max_chord_error));
    builder_list_edges(&b);
    for (int64_t k = 0; k < m->elements; k++)
        if (b.body_dim > 0 && element_dim[m->element[k].kind] == b.body_dim) builder_add_oriented(&b, &m->element[k]);
    if (b.body_dim > 0) builder_close(&b, &g->whole, true, &node_of);
    take_sets(&b, node_of, g);
    memory_free(node_of);
    label_map_free(&b.edges);
    memory_free(b.parent);
    memory_free(b.patch);
    return OK;
}
