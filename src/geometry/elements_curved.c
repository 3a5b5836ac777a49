/* Subdivides the curved sides of second-order elements into straight edges and triangles that stay within a given
 * distance of the curves. Neighbours share the nodes on common edges. */
#include <math.h>

#include "base/memory.h"
#include "elements.h"

enum { PIECES_MOST_SPACE = 64, PIECES_MOST_PLANE = 4096 }; /* largest number of pieces of an edge in 3D, in 2D */
#define COARSE_MOST 10.0 /* coarse curves are accepted up to this multiple of the wanted distance */
/* Default of the largest distance of chords from curved edges, relative to the largest sagitta (distance of an
 * edge's middle node from its chord) [1]. */
#define SAGITTA_SHARE (1.0 / 256)
/* An edge is straight if its middle node is closer to its chord than this share of the length of the chord [1]. */
#define STRAIGHT 1e-6
#define FARTHEST 1e30 /* largest coordinate, so that squares and triple products stay finite [m] */

/* ---- edges ------------------------------------------------------------------------------------------------------- */

/* Returns the distance of the middle node `middle` of an edge from its chord [unit of the file]. m: mesh; from, to:
 * nodes at the ends of the edge. Returns 0 if the edge has no middle node (-1), or if it is straight, i.e. the distance
 * is below STRAIGHT times the length of the chord. */
static real sagitta_of(const struct element_mesh *m, int32_t from, int32_t to, int32_t middle)
{
    if (middle < 0) return 0;
    const real *a = m->node[from], *b = m->node[to], *c = m->node[middle];
    real along2 = 0, arm2 = 0, both = 0;
    for (int d = 0; d < DIM_MAX; d++)
        along2 += square(b[d] - a[d]), arm2 += square(c[d] - a[d]), both += (b[d] - a[d]) * (c[d] - a[d]);
    const real off2 = along2 > 0 ? arm2 - square(both) / along2 : 0;
    return off2 > square(STRAIGHT) * along2 ? sqrt(off2) : 0;
}

/* Returns the number of chords, from 1 to `most`, into which a curved edge must be divided so that its distance from
 * every chord is at most `wanted`. The distance decreases with the square of the number of chords. sagitta: distance of
 * a single chord, in the same unit. */
static int pieces_for(real sagitta, real wanted, int most)
{
    const real pieces = ceil(sqrt(sagitta / wanted));
    return pieces > most ? most : pieces > 1 ? (int)pieces : 1;
}

status surface_builder_set_chord_tolerance(struct surface_builder *b, const char *path, real max_chord_error)
{
    const struct element_mesh *m = b->m;
    const int most = b->dim == 3 ? PIECES_MOST_SPACE : PIECES_MOST_PLANE;
    real sagitta = 0;
    for (int64_t k = 0; k < m->elements; k++) {
        const struct element *e = &m->element[k];
        const struct element_edges *edges = &element_edges[e->kind];
        for (int c = 0; c < edges->n && e->middle >= 0; c++)
            sagitta = real_max(sagitta, sagitta_of(m, e->node[edges->corner[c][0]], e->node[edges->corner[c][1]],
                                                   m->middle[e->middle + c]));
    }
    b->sagitta = isnan(max_chord_error) ? SAGITTA_SHARE * sagitta : max_chord_error / b->scale;
    b->pieces = sagitta > 0 ? pieces_for(sagitta, b->sagitta, most) : 1;
    if (sagitta <= COARSE_MOST * b->sagitta * most * most && sagitta * b->scale < FARTHEST) return OK;
    return status_set(REFUSED,
                      "%s: second-order elements have edges curved by up to %.3g m, each of which needs more than %d "
                      "straight parts at this spacing; use a finer mesh, or a larger particles.spacing",
                      path, sagitta * b->scale, most);
}

/* Adds a node to the mesh of b at X[DIM_MAX], which was interpolated between nodes, and returns its index.
 * parent[parents]: indices of these nodes, corners of elements, at most four. They are recorded for the new node. */
static int32_t node_between(struct surface_builder *b, const real *X, const int32_t *parent, int parents)
{
    const int32_t node = element_mesh_add_node_unchecked(b->m, X, -1);
    const int64_t at = node - b->file_nodes;
    GROW("mesh.parent", b->parent, at + 1);
    for (int k = 0; k < 4; k++) b->parent[at][k] = k < parents ? parent[k] : -1;
    return node;
}

/* Computes X, the position of the middle node `middle` of an edge of the mesh m, or the midpoint of the ends of the
 * edge if it has no middle node (-1). from, to: nodes at the ends. */
static void middle_point(const struct element_mesh *m, int32_t from, int32_t to, int32_t middle, real X[DIM_MAX])
{
    for (int d = 0; d < DIM_MAX; d++)
        X[d] = middle >= 0 ? m->node[middle][d] : 0.5 * (m->node[from][d] + m->node[to][d]);
}

/* Adds pieces - 1 nodes to the mesh of b that divide an edge, by quadratic interpolation through its middle node
 * `middle`. from, to: nodes at the ends of the edge. Returns the index of the first new node; the others follow in
 * order from `from` to `to`. */
static int32_t edge_divide(struct surface_builder *b, int32_t from, int32_t to, int32_t middle, int pieces)
{
    const int32_t first = (int32_t)b->m->nodes, ends[] = {from, to};
    for (int k = 1; k < pieces; k++) {
        const real t = (real)k / pieces;
        real X[DIM_MAX], M[DIM_MAX];
        middle_point(b->m, from, to, middle, M);
        for (int d = 0; d < DIM_MAX; d++)
            X[d] = (1 - t) * (1 - 2 * t) * b->m->node[from][d] + 4 * t * (1 - t) * M[d] +
                   t * (2 * t - 1) * b->m->node[to][d];
        node_between(b, X, ends, 2);
    }
    return first;
}

/* Adds the patch p, an edge in 2D, or a line or point in 3D, to the faces of b. A curved edge is divided into straight
 * pieces. */
static void line_add(struct surface_builder *b, const struct patch *p)
{
    const int32_t from = p->corner[0], to = p->corner[p->n - 1];
    const real sagitta = p->n > 1 ? sagitta_of(b->m, from, to, p->middle[0]) : 0;
    const int pieces = pieces_for(sagitta, b->sagitta, b->dim == 3 ? PIECES_MOST_SPACE : PIECES_MOST_PLANE);
    const int32_t first = edge_divide(b, from, to, p->middle[0], pieces);
    for (int k = 0; k < pieces; k++) {
        const int32_t next = k + 1 < pieces ? first + k : to;
        surface_builder_add_face(b, k == 0 ? from : first + k - 1, next, next);
    }
}

/* ---- sides that two elements share ------------------------------------------------------------------------------- */

/* Appends a copy of *side, a side of an element with middle nodes, to the surface of b. The copy is divided into faces
 * later, by surface_builder_divide_sides_into_faces. */
void surface_builder_add_side_with_middle_nodes(struct surface_builder *b, const struct patch *side)
{
    GROW("mesh.patch", b->patch, b->patches + 1);
    b->patch[b->patches++] = *side;
}

/* Key by which patches (sides of elements) that coincide are found: their corners in ascending order. */
struct patch_key {
    int32_t corner[4];
    int turn;   /* orientation: +1 or -1 */
    int64_t of; /* index of the patch */
};

/* Returns the key by which patches are compared: the corners of p in ascending order, and its orientation. of: index of
 * the patch p, which is stored in the key. */
static struct patch_key patch_key_of(const struct patch *p, int64_t of)
{
    struct patch_key key = {.of = of};
    int low = 0;
    for (int k = 0; k < 4; k++) key.corner[k] = p->corner[k];
    for (int k = 1; k < p->n; k++)
        if (p->corner[k] < p->corner[low]) low = k;
    const int32_t next = p->corner[(low + 1) % p->n], before = p->corner[(low + p->n - 1) % p->n];
    key.turn = p->n == 2 ? (low == 0 ? 1 : -1) : next < before ? 1 : -1;
    for (int round = 1; round < p->n; round++)
        for (int k = 0; k + 1 < p->n; k++) {
            const int32_t lower = key.corner[k + 1];
            if (key.corner[k] <= lower) continue;
            key.corner[k + 1] = key.corner[k], key.corner[k] = lower;
        }
    return key;
}

/* Compares the keys a and b of two patches (sides of elements) for array_sort: by their sorted corners, then by
 * index. */
static int key_order(const void *a, const void *b)
{
    const struct patch_key *p = a, *q = b;
    for (int k = 0; k < 4; k++)
        if (p->corner[k] != q->corner[k]) return p->corner[k] < q->corner[k] ? -1 : 1;
    return (p->of > q->of) - (p->of < q->of);
}

/* Removes pairs of patches of b (sides of elements) with the same corners and opposite orientation. Two elements add
 * such a pair at the side that they share. If several patches with the same corners remain, only one of them is
 * retained. */
static void patches_cancel(struct surface_builder *b)
{
    struct patch_key *key = NEW("mesh.keys", b->patches, struct patch_key);
    bool *stays = NEW("mesh.keys", b->patches, bool);
    int64_t kept = 0;
    for (int64_t k = 0; k < b->patches; k++) key[k] = patch_key_of(&b->patch[k], k);
    array_sort(key, b->patches, sizeof *key, key_order);
    for (int64_t k = 0, end; k < b->patches; k = end) {
        int sum = 0;
        for (end = k; end < b->patches && arrays_equal(key[k].corner, key[end].corner, 4, sizeof *key->corner); end++)
            sum += key[end].turn;
        for (int64_t i = k; i < end && sum != 0; i++) {
            if (key[i].turn * sum < 0) continue;
            stays[key[i].of] = true;
            break;
        }
    }
    for (int64_t k = 0; k < b->patches; k++)
        if (stays[k]) b->patch[kept++] = b->patch[k];
    b->patches = kept;
    memory_free(key);
    memory_free(stays);
}

/* ---- faces in space ---------------------------------------------------------------------------------------------- */

/* An edge that patches (sides of elements) share: its end nodes low < high and its middle node, or -1. If divided,
 * its interior nodes have consecutive indices from `first` on, in the order from `low` to `high`. */
struct curve {
    int32_t low, high, middle, first;
    bool divided;
};

/* All edges, sorted by curve_order. */
struct curves {
    int64_t n;
    struct curve *curve;
};

/* Compares two edges a and b (struct curve) for sorting: by the nodes at their ends, then by middle node. */
static int curve_order(const void *a, const void *b)
{
    const struct curve *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    return (p->middle > q->middle) - (p->middle < q->middle);
}

/* Returns edge k (from 0) of a patch p, from its corner k to the next one: the nodes at its ends and its middle node.
 * The edge is marked as not divided. */
static struct curve curve_of(const struct patch *p, int k)
{
    const int32_t from = p->corner[k], to = p->corner[(k + 1) % p->n];
    return (struct curve){.low = from < to ? from : to, .high = from < to ? to : from, .middle = p->middle[k]};
}

/* Finds edge k (from 0) of a patch p (a side of an element) in the sorted list c of all edges, which must contain it,
 * by bisection. Returns a pointer to its entry in c. */
static struct curve *curve_find(const struct curves *c, const struct patch *p, int k)
{
    const struct curve wanted = curve_of(p, k);
    int64_t low = 0, high = c->n;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (curve_order(&c->curve[middle], &wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return &c->curve[low];
}

/* Returns true if a patch p (a side of an element) is curved: the middle node of an edge is more than b->sagitta away
 * from the chord of the edge, or the node at its centre is as far from the mean of its corners. */
static bool patch_curved(const struct surface_builder *b, const struct patch *p)
{
    const struct element_mesh *m = b->m;
    bool curved = false;
    real off2 = 0;
    for (int k = 0; k < p->n; k++)
        curved |= sagitta_of(m, p->corner[k], p->corner[(k + 1) % p->n], p->middle[k]) > b->sagitta;
    for (int d = 0; d < DIM_MAX && p->centre >= 0; d++) {
        real mean = 0;
        for (int k = 0; k < p->n; k++) mean += m->node[p->corner[k]][d] / p->n;
        off2 += square(m->node[p->centre][d] - mean);
    }
    return curved || off2 > square(b->sagitta);
}

/* Lists the edges of all patches of b (sides of elements) in *c, sorted by curve_order. Divides the edges of curved
 * patches by new nodes. The caller releases c->curve with memory_free. */
static void curves_make(struct curves *c, struct surface_builder *b)
{
    int64_t kept = 0;
    c->curve = NEW("mesh.curves", 4 * b->patches, struct curve);
    for (int64_t k = 0; k < b->patches; k++)
        for (int e = 0; e < b->patch[k].n; e++) c->curve[c->n++] = curve_of(&b->patch[k], e);
    array_sort(c->curve, c->n, sizeof *c->curve, curve_order);
    for (int64_t k = 0; k < c->n; k++)
        if (k == 0 || curve_order(&c->curve[kept - 1], &c->curve[k]) != 0) c->curve[kept++] = c->curve[k];
    c->n = kept;
    for (int64_t k = 0; k < b->patches; k++) {
        const struct patch *p = &b->patch[k];
        const bool curved = patch_curved(b, p);
        for (int e = 0; e < p->n && curved; e++) curve_find(c, p, e)->divided = true;
    }
    for (int64_t k = 0; k < c->n; k++) {
        struct curve *e = &c->curve[k];
        e->divided = e->divided && e->low != e->high;
        if (e->divided) e->first = edge_divide(b, e->low, e->high, e->middle, b->pieces);
    }
}

/* Returns the index of node number `at`, 0 .. b->pieces, along edge k of a patch p (a side of an element), counted from
 * its corner k. An edge that is not divided has only its ends. c: edges of all patches. */
static int32_t curve_node(const struct surface_builder *b, const struct curves *c, const struct patch *p, int k, int at)
{
    const struct curve *e = curve_find(c, p, k);
    if (at == 0) return p->corner[k];
    if (at == b->pieces || !e->divided) return p->corner[(k + 1) % p->n];
    return e->first + (p->corner[k] == e->low ? at : b->pieces - at) - 1;
}

/* Computes the point X of the patch p, a triangle with six nodes of the mesh m, at the area coordinates u, v of its
 * corners 1 and 2. */
static void triangle_point(const struct element_mesh *m, const struct patch *p, real u, real v, real X[DIM_MAX])
{
    const real L[3] = {1 - u - v, u, v};
    real M[DIM_MAX];
    for (int d = 0; d < DIM_MAX; d++) X[d] = 0;
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3;
        middle_point(m, p->corner[k], p->corner[next], p->middle[k], M);
        for (int d = 0; d < DIM_MAX; d++)
            X[d] += L[k] * (2 * L[k] - 1) * m->node[p->corner[k]][d] + 4 * L[k] * L[next] * M[d];
    }
}

/* Computes the point X of the patch p, a quadrilateral with eight nodes of the mesh m, at the reference coordinates x,
 * y in [-1, 1]. */
static void quad_point(const struct element_mesh *m, const struct patch *p, real x, real y, real X[DIM_MAX])
{
    static const int at[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, side[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    real M[DIM_MAX];
    for (int d = 0; d < DIM_MAX; d++) X[d] = 0;
    for (int k = 0; k < 4; k++) {
        const real a = x * at[k][0], b = y * at[k][1], along = side[k][0] == 0 ? x : y;
        const real corner = 0.25 * (1 + a) * (1 + b) * (a + b - 1);
        const real middle = 0.5 * (1 - along * along) * (1 + x * side[k][0] + y * side[k][1]);
        middle_point(m, p->corner[k], p->corner[(k + 1) % 4], p->middle[k], M);
        for (int d = 0; d < DIM_MAX; d++) X[d] += corner * m->node[p->corner[k]][d] + middle * M[d];
    }
}

/* Computes the point X of the quadrilateral patch p at the reference coordinates x, y in [-1, 1]. It is interpolated
 * from the eight nodes of the patch in the mesh m and, if the patch has one, the node at its centre. */
static void quad_point_whole(const struct element_mesh *m, const struct patch *p, real x, real y, real X[DIM_MAX])
{
    real middle[DIM_MAX];
    quad_point(m, p, x, y, X);
    if (p->centre < 0) return;
    quad_point(m, p, 0, 0, middle);
    for (int d = 0; d < DIM_MAX; d++) X[d] += (1 - x * x) * (1 - y * y) * (m->node[p->centre][d] - middle[d]);
}

/* Returns the index of the node at position (i, j), each 0 .. b->pieces, of the grid by which a curved patch p (a side
 * of an element) is divided. On an edge it is the node that neighbouring patches share. Inside the patch a new node is
 * added. c: edges of all patches. */
static int32_t grid_node(struct surface_builder *b, const struct curves *c, const struct patch *p, int i, int j)
{
    const int n = b->pieces;
    real X[DIM_MAX];
    if (j == 0) return curve_node(b, c, p, 0, i);
    if (i == 0) return curve_node(b, c, p, p->n - 1, n - j);
    if (p->n == 3 && i + j == n) return curve_node(b, c, p, 1, j);
    if (p->n == 4 && i == n) return curve_node(b, c, p, 1, j);
    if (p->n == 4 && j == n) return curve_node(b, c, p, 2, n - i);
    if (p->n == 3)
        triangle_point(b->m, p, (real)i / n, (real)j / n, X);
    else
        quad_point_whole(b->m, p, 2.0 * i / n - 1, 2.0 * j / n - 1, X);
    return node_between(b, X, p->corner, p->n);
}

/* Divides a curved patch p (a side of an element) into triangles and adds them to the faces of b. c: edges of all
 * patches; row: working memory for two rows of b->pieces + 1 nodes. */
static void patch_divide(struct surface_builder *b, const struct curves *c, const struct patch *p, int32_t *row)
{
    const int n = b->pieces;
    int32_t *low = row, *high = row + n + 1;
    for (int i = 0; i <= n; i++) low[i] = grid_node(b, c, p, i, 0);
    for (int j = 0; j < n; j++) {
        const int end = p->n == 3 ? n - j : n;
        for (int i = 0; i <= (p->n == 3 ? end - 1 : n); i++) high[i] = grid_node(b, c, p, i, j + 1);
        for (int i = 0; i < end; i++) {
            surface_builder_add_face(b, low[i], low[i + 1], high[i]);
            if (p->n == 4 || i + 1 < end) surface_builder_add_face(b, low[i + 1], high[i + 1], high[i]);
        }
        int32_t *other = low;
        low = high, high = other;
    }
}

/* Divides a flat patch p (a side of an element), some edges of which are divided, into triangles around a new node at
 * its centre, and adds them to the faces of b. c: edges of all patches. */
static void patch_star(struct surface_builder *b, const struct curves *c, const struct patch *p)
{
    real X[DIM_MAX] = {0};
    for (int k = 0; k < p->n; k++)
        for (int d = 0; d < DIM_MAX; d++) X[d] += b->m->node[p->corner[k]][d] / p->n;
    const int32_t middle = node_between(b, X, p->corner, p->n);
    for (int k = 0; k < p->n; k++) {
        const int pieces = curve_find(c, p, k)->divided ? b->pieces : 1;
        for (int at = 0; at < pieces; at++)
            surface_builder_add_face(b, middle, curve_node(b, c, p, k, at),
                                     pieces == 1 ? p->corner[(k + 1) % p->n] : curve_node(b, c, p, k, at + 1));
    }
}

/* Adds a patch p (a side of an element) to the faces of b as triangles. It is subdivided if it is curved, and divided
 * into triangles around its centre if only its edges are divided. c: edges of all patches; row: working memory for two
 * rows of b->pieces + 1 nodes. */
static void patch_add(struct surface_builder *b, const struct curves *c, const struct patch *p, int32_t *row)
{
    bool divided = false;
    for (int k = 0; k < p->n; k++) divided |= curve_find(c, p, k)->divided;
    if (!divided)
        surface_builder_add_side(b, p->corner, p->n);
    else if (patch_curved(b, p))
        patch_divide(b, c, p, row);
    else
        patch_star(b, c, p);
}

void surface_builder_divide_sides_into_faces(struct surface_builder *b, bool remove_shared_sides)
{
    struct curves c = {0};
    if (b->patches == 0) return;
    if (remove_shared_sides) patches_cancel(b);
    const bool faces = b->dim == 3 && b->patches > 0;
    int32_t *row = NEW("mesh.rows", 2 * (b->pieces + 1), int32_t);
    if (faces) curves_make(&c, b);
    for (int64_t k = 0; k < b->patches; k++) {
        if (b->patch[k].n < 3)
            line_add(b, &b->patch[k]);
        else
            patch_add(b, &c, &b->patch[k], row);
    }
    b->patches = 0;
    memory_free(row);
    memory_free(c.curve);
}
