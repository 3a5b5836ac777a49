/* Builds a tree of boxes over the faces of a surface, and computes winding numbers and distances by it. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "data/hull.h"

/* Largest numbers: of faces in a leaf; of nodes that wait on the stack of a search; of faces that are tested for
 * convexity. */
enum { LEAF = 8, DEEPEST = 64, NEAR_MOST = 100 };
#define FAR 3.0 /* distance, in radii of a node, from which its dipole replaces its faces */

static const real pi = 3.14159265358979323846;

/* ---- making --------------------------------------------------------------------------------------------------- */

/* A face during the construction of the tree: its number, and its middle, by which nodes of the tree are halved. */
struct leaflet {
    real middle[DIM_MAX];
    int32_t face;
};

/* Compares two faces a and b: by the coordinate of their middles along `axis`, then by number. Returns a negative
 * number, 0 or a positive number. */
static int leaflet_order(const struct leaflet *a, const struct leaflet *b, int axis)
{
    const real x = a->middle[axis], y = b->middle[axis];
    return x != y ? (x > y) - (x < y) : (a->face > b->face) - (a->face < b->face);
}
static int order_x(const void *a, const void *b) { return leaflet_order(a, b, 0); }
static int order_y(const void *a, const void *b) { return leaflet_order(a, b, 1); }
static int order_z(const void *a, const void *b) { return leaflet_order(a, b, 2); }

/* Computes the box, the dipole moment (sum of the area vectors) and the area-weighted centre of node n of the tree of
 * surface from the faces of the node. leaf[]: faces of the whole surface in the order of the tree; those of the node
 * are leaf[n->first] and the following n->count - 1. */
static void node_measure(const struct hull *hull, struct hull_node *n, const struct leaflet *leaf)
{
    real weight = 0;
    for (int d = 0; d < DIM_MAX; d++) n->low[d] = INFINITY, n->high[d] = -INFINITY;
    for (int32_t k = n->first; k < n->first + n->count; k++) {
        real area[DIM_MAX];
        hull_compute_face_area_vector(hull, leaf[k].face, area);
        const real size = sqrt(dot(area, area, hull->dim));
        weight += size;
        for (int d = 0; d < hull->dim; d++) {
            n->moment[d] += area[d];
            n->centre[d] += size * leaf[k].middle[d];
            for (int c = 0; c < hull->dim; c++) {
                const real x = hull->corner[hull->face[leaf[k].face][c]][d];
                n->low[d] = real_min(n->low[d], x), n->high[d] = real_max(n->high[d], x);
            }
        }
    }
    for (int d = 0; d < hull->dim; d++)
        n->centre[d] = weight > 0 ? n->centre[d] / weight : 0.5 * (n->low[d] + n->high[d]);
}

/* Divides node number `at` of the tree of surface into two at the median face along the longest edge of its box, and
 * its children in the same way, down to nodes of at most LEAF faces. leaf[]: faces of the whole surface, which are
 * sorted into the order of the tree. */
static void node_split(struct hull *hull, int32_t at, struct leaflet *leaf)
{
    static int (*const order[])(const void *, const void *) = {order_x, order_y, order_z};
    struct hull_node *n = &hull->node[at];
    int axis = 0;
    node_measure(hull, n, leaf);
    if (n->count <= LEAF) return;
    for (int d = 1; d < hull->dim; d++)
        if (n->high[d] - n->low[d] > n->high[axis] - n->low[axis]) axis = d;
    array_sort(leaf + n->first, n->count, sizeof *leaf, order[axis]);
    const int32_t half = n->count / 2, left = hull->nodes;
    n->left = left;
    hull->nodes += 2;
    hull->node[left] = (struct hull_node){.first = n->first, .count = half};
    hull->node[left + 1] = (struct hull_node){.first = n->first + half, .count = n->count - half};
    node_split(hull, left, leaf);
    node_split(hull, left + 1, leaf);
}

/* Number of trees built so far. Together with its address it identifies a tree, since a new tree may have the address
 * of one that was released. */
static int trees_built;

void hull_build_face_search_tree(struct hull *hull)
{
#pragma omp atomic
    trees_built++;
    struct leaflet *leaf = NEW("hull.tree", hull->faces, struct leaflet);
    int32_t(*sorted)[DIM_MAX] = memory_new("hull.faces", hull->faces, sizeof *sorted);
    hull->node = NEW("hull.tree", 1 + hull->faces,
                     struct hull_node); /* nodes of 9 and more are halved: leaves have 4 and more */
    for (int64_t k = 0; k < hull->faces; k++) {
        leaf[k].face = (int32_t)k;
        for (int c = 0; c < hull->dim; c++)
            for (int d = 0; d < hull->dim; d++) leaf[k].middle[d] += hull->corner[hull->face[k][c]][d] / hull->dim;
    }
    hull->nodes = 1;
    hull->node[0] = (struct hull_node){.count = (int32_t)hull->faces};
    node_split(hull, 0, leaf);
    for (int64_t k = 0; k < hull->faces; k++) memcpy(sorted[k], hull->face[leaf[k].face], sizeof *sorted);
    memory_free(hull->face);
    memory_free(leaf);
    hull->face = sorted;
}

/* ---- winding number ------------------------------------------------------------------------------------------- */

/* A sum of angles of at most half a turn each, as a product of complex numbers, which needs one arc tangent in all:
 * 2 pi turns + arg(x + i y). */
struct angle_sum {
    real x, y;
    int turns;
};

/* Adds the angle arg(x + i y) of a complex number of any magnitude to *sum: multiplies the product sum->x + i sum->y of
 * the numbers so far by it, and adds 1 to sum->turns if the angle of the product passes half a turn forwards, -1 if
 * backwards. Adds nothing if x and y are 0. Products that become very large or small are scaled. Signs are compared
 * without branches, which would be slow where they alternate. */
static inline void angle_sum_add(struct angle_sum *sum, real x, real y)
{
    const real a = sum->x, b = sum->y, u = a * x - b * y, v = a * y + b * x, size = fabs(u) + fabs(v);
    if (!(size > 0)) return;
    const int forward = (b >= 0) & (y >= 0) & ((v < 0) | ((b == 0) & (y == 0) & (a < 0) & (x < 0))),
              backward = (b < 0) & (y < 0) & ((v > 0) | ((v == 0) & (u < 0)));
    const bool scaled = size > 1e-99 && size < 1e99;
    sum->x = scaled ? u : u / size, sum->y = scaled ? v : v / size;
    sum->turns += forward - backward;
}

/* Adds the contribution of a face of surface to the winding number at X[dim], times 2 pi, to *sum: in 3D half the solid
 * angle of the triangle (van Oosterom & Strackee 1983, eq. 8); in 2D the angle of the segment. face[dim]: indices of
 * the corners of the face. */
static void face_winding(const struct hull *hull, const int32_t *face, const real *X, struct angle_sum *sum)
{
    real arm[DIM_MAX][DIM_MAX], length[DIM_MAX];
    for (int c = 0; c < hull->dim; c++)
        for (int d = 0; d < hull->dim; d++) arm[c][d] = hull->corner[face[c]][d] - X[d];
    const real *a = arm[0], *b = arm[1], *c = arm[2];
    if (hull->dim == 2) {
        angle_sum_add(sum, dot(a, b, 2), a[0] * b[1] - a[1] * b[0]);
        return;
    }
    for (int k = 0; k < 3; k++) length[k] = sqrt(dot(arm[k], arm[k], 3));
    const real triple =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    const real below = length[0] * length[1] * length[2] + dot(a, b, 3) * length[2] + dot(b, c, 3) * length[0] +
                       dot(c, a, 3) * length[1];
    angle_sum_add(sum, below, triple);
}

/* Adds to *sum the winding number at X[dim] of the faces of node n (a set of faces of surface), replaced by their
 * dipole (Barill et al. 2018, first order), and returns true. Only if X is farther from the centre of the node than FAR
 * times its radius; otherwise adds nothing and returns false. */
static bool node_winding(const struct hull *hull, const struct hull_node *n, const real *X, real *sum)
{
    real r2 = 0, radius2 = 0, along = 0;
    for (int d = 0; d < hull->dim; d++) {
        const real arm = n->centre[d] - X[d];
        r2 += square(arm);
        radius2 += square(real_max(n->high[d] - n->centre[d], n->centre[d] - n->low[d]));
        along += arm * n->moment[d];
    }
    if (!(r2 > square(FAR) * radius2)) return false;
    *sum += hull->dim == 2 ? along / (2 * pi * r2) : along / (4 * pi * r2 * sqrt(r2));
    return true;
}

real hull_winding_number(const struct hull *hull, const real *X)
{
    int32_t wait[DEEPEST];
    int waiting = 1;
    real far = 0;
    struct angle_sum near = {.x = 1};
    wait[0] = 0;
    while (waiting > 0) {
        const struct hull_node *n = &hull->node[wait[--waiting]];
        if (node_winding(hull, n, X, &far)) continue;
        for (int32_t k = n->first; n->left == 0 && k < n->first + n->count; k++)
            face_winding(hull, hull->face[k], X, &near);
        if (n->left > 0) wait[waiting++] = n->left + 1, wait[waiting++] = n->left;
    }
    return far + near.turns + atan2(near.y, near.x) / (2 * pi);
}

struct hull_samples hull_sample_winding_number_statistics(const struct hull *hull)
{
    const int places = hull->dim == 2 ? 64 : 16;
    const struct hull_node *all = &hull->node[0];
    int64_t unclear = 0, again = 0, n = hull->dim == 2 ? places * places : places * places * places;
    real box = 1;
    for (int d = 0; d < hull->dim; d++) box *= all->high[d] - all->low[d];
    for (int64_t k = 0; k < n; k++) {
        const int64_t at[DIM_MAX] = {k % places, k / places % places, k / places / places};
        real X[DIM_MAX];
        for (int d = 0; d < hull->dim; d++)
            X[d] = all->low[d] + ((real)at[d] + 0.5) / places * (all->high[d] - all->low[d]);
        const real w = hull_winding_number(hull, X);
        unclear += w < -0.3 || fabs(w - nearbyint(w)) > 0.3;
        if (w > 1.5) again += (int64_t)nearbyint(w) - 1;
    }
    return (struct hull_samples){(real)unclear / (real)n, box * (real)again / (real)n};
}

/* ---- distance ------------------------------------------------------------------------------------------------- */

/* Computes nearest[dim], the point of the segment from a[dim] to b[dim] that is nearest to X[dim] [m]. */
static void segment_nearest(const real *a, const real *b, const real *X, int dim, real *nearest)
{
    real along = 0, length2 = 0;
    for (int d = 0; d < dim; d++) along += (X[d] - a[d]) * (b[d] - a[d]), length2 += square(b[d] - a[d]);
    const real share = length2 > 0 ? real_min(1, real_max(0, along / length2)) : 0;
    for (int d = 0; d < dim; d++) nearest[d] = a[d] + share * (b[d] - a[d]);
}

/* Returns the squared distance between the points a[dim] and b[dim] [m^2]. */
static real apart2(const real *a, const real *b, int dim)
{
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += square(a[d] - b[d]);
    return sum;
}

/* Computes nearest[3], the point of a triangle that is nearest to X[3] [m]: the foot of X on the triangle's plane if it
 * is inside the triangle, else the nearest point of the edges. corner[3]: pointers to the corners; area[3]: area vector
 * of the triangle [m^2]. */
static void triangle_nearest(const real *corner[DIM_MAX], const real *area, const real *X, real *nearest)
{
    const real area2 = dot(area, area, 3);
    real foot[DIM_MAX], best = INFINITY, above = 0;
    bool inside = area2 > 0;
    for (int d = 0; d < 3; d++) above += (X[d] - corner[0][d]) * area[d];
    for (int d = 0; d < 3; d++) foot[d] = X[d] - (area2 > 0 ? above / area2 : 0) * area[d];
    for (int c = 0; c < 3 && inside; c++) {
        const real *a = corner[c], *b = corner[(c + 1) % 3];
        real turn = 0;
        for (int d = 0; d < 3; d++) {
            const int e = (d + 1) % 3, f = (d + 2) % 3;
            turn += area[d] * ((b[e] - a[e]) * (foot[f] - a[f]) - (b[f] - a[f]) * (foot[e] - a[e]));
        }
        inside = turn >= 0;
    }
    if (inside) memcpy(nearest, foot, sizeof foot);
    for (int c = 0; c < 3 && !inside; c++) {
        real point[DIM_MAX];
        segment_nearest(corner[c], corner[(c + 1) % 3], X, 3, point);
        const real r2 = apart2(point, X, 3);
        if (r2 < best) best = r2, memcpy(nearest, point, sizeof point);
    }
}

/* Computes nearest[dim], the point of face k, from 0, of the surface that is nearest to X[dim] [m]. */
static void face_nearest(const struct hull *hull, int64_t k, const real *X, real *nearest)
{
    const real *corner[DIM_MAX];
    real area[DIM_MAX];
    for (int c = 0; c < hull->dim; c++) corner[c] = hull->corner[hull->face[k][c]];
    if (hull->dim == 2) {
        segment_nearest(corner[0], corner[1], X, 2, nearest);
        return;
    }
    hull_compute_face_area_vector(hull, k, area);
    triangle_nearest(corner, area, X, nearest);
}

/* Returns the squared distance of X[dim] from the bounding box of node n of a tree of faces [m^2]; 0 inside the box. */
static real box_apart2(const struct hull_node *n, const real *X, int dim)
{
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += square(real_max(0, real_max(n->low[d] - X[d], X[d] - n->high[d])));
    return sum;
}

/* Searches for the face of surface that is nearest to X[dim], among faces whose squared distance is below *r2 [m^2]. If
 * there is one, stores its squared distance in *r2 and its nearest point in nearest[dim], and returns its number; else
 * returns -1 and changes nothing. */
static int32_t nearest_face(const struct hull *hull, const real *X, real *nearest, real *r2)
{
    int32_t wait[DEEPEST], found = -1;
    int waiting = 1;
    wait[0] = 0;
    while (waiting > 0) {
        const struct hull_node *n = &hull->node[wait[--waiting]];
        if (box_apart2(n, X, hull->dim) >= *r2) continue;
        for (int32_t k = n->first; n->left == 0 && k < n->first + n->count; k++) {
            real point[DIM_MAX];
            face_nearest(hull, k, X, point);
            const real here = apart2(point, X, hull->dim);
            if (here < *r2) *r2 = here, found = k, memcpy(nearest, point, sizeof point);
        }
        if (n->left == 0) continue;
        const real left = box_apart2(&hull->node[n->left], X, hull->dim),
                   right = box_apart2(&hull->node[n->left + 1], X, hull->dim);
        wait[waiting++] = n->left + (left <= right), wait[waiting++] = n->left + (left > right);
    }
    return found;
}

/* Lists in face[NEAR_MOST] the numbers of the faces of surface at most `reach` [m] from X[dim]. Returns the number of
 * these faces; -1 if it is more than NEAR_MOST. */
static int faces_within(const struct hull *hull, const real *X, real reach, int32_t *face)
{
    int32_t wait[DEEPEST];
    int waiting = 1, n = 0;
    wait[0] = 0;
    while (waiting > 0) {
        const struct hull_node *node = &hull->node[wait[--waiting]];
        if (box_apart2(node, X, hull->dim) > square(reach)) continue;
        for (int32_t k = node->first; node->left == 0 && k < node->first + node->count; k++) {
            real point[DIM_MAX];
            face_nearest(hull, k, X, point);
            if (apart2(point, X, hull->dim) > square(reach)) continue;
            if (n == NEAR_MOST) return -1;
            face[n++] = k;
        }
        if (node->left > 0) wait[waiting++] = node->left + 1, wait[waiting++] = node->left;
    }
    return n;
}

/* Returns true if all corners of face number `other` of surface are behind the plane of face number `face`, or on it up
 * to round-off. area[dim]: area vector of `face` [m^(dim - 1)]. */
static bool face_is_behind(const struct hull *hull, int32_t other, int32_t face, const real *area)
{
    real above = -INFINITY, size2 = 0;
    const real *a = hull->corner[hull->face[face][0]];
    for (int c = 0; c < hull->dim; c++) {
        const real *b = hull->corner[hull->face[other][c]];
        real along = 0;
        for (int d = 0; d < hull->dim; d++) along += area[d] * (b[d] - a[d]);
        above = real_max(above, along), size2 = real_max(size2, apart2(a, b, hull->dim));
    }
    return above <= 1e-9 * sqrt(size2 * dot(area, area, hull->dim));
}

bool hull_is_convex_near_point(const struct hull *hull, const real *X, real reach)
{
    int32_t face[NEAR_MOST];
    const int n = hull->open || hull->open_edges > 0 || hull->faces == 0 ? -1 : faces_within(hull, X, reach, face);
    bool convex = n >= 0;
    for (int k = 0; k < n && convex; k++) {
        real area[DIM_MAX] = {0};
        hull_compute_face_area_vector(hull, face[k], area);
        for (int l = 0; l < n && convex; l++) convex = k == l || face_is_behind(hull, face[l], face[k], area);
    }
    return convex;
}

/* Returns true if X[dim] is outside the closed surface hull: its winding number is below 1/2. Returns true for every
 * point if the surface is open. */
static bool hull_outside(const struct hull *hull, const real *X)
{
    return hull->open || box_apart2(&hull->node[0], X, hull->dim) > 0 || hull_winding_number(hull, X) < 0.5;
}

/* Returns true if the signed distance of X[dim] from the surface, negative inside, is at most max_distance [m]. Faces
 * that are farther than |max_distance| are not searched, since then only the side of X matters. A surface without faces
 * is at the distance INFINITY. */
bool hull_point_is_within_distance(const struct hull *hull, const real *X, real max_distance)
{
    real size = 0, point[DIM_MAX];
    if (hull->faces == 0) return max_distance == INFINITY;
    for (int d = 0; d < hull->dim; d++) size += hull->node[0].high[d] - hull->node[0].low[d] + fabs(X[d]);
    const real limit2 =
        square(fabs(max_distance) + 1e-9 * (fabs(max_distance) + size)); /* by far more than round-off */
    real r2 = limit2;
    nearest_face(hull, X, point, &r2);
    const real distance = r2 < limit2 ? sqrt(r2) : INFINITY;
    return (hull_outside(hull, X) ? distance : -distance) <= max_distance;
}

/* Returns true if X[dim] is outside the closed surface, as hull_outside does, but faster for points that follow each
 * other along a line. distance: distance of X from the surface, > 0 [m]. If the balls without faces around X and around
 * the last point of this thread overlap, both points are on the same side, and the last result is used again. */
static bool hull_outside_by_last_point(const struct hull *hull, const real *X, real distance)
{
    static _Thread_local struct {
        const struct hull_node *node;
        int built;
        real X[DIM_MAX], distance;
        bool outside;
    } last;
    const bool known = !hull->open && hull->open_edges == 0 && last.node == hull->node && last.built == trees_built &&
                       apart2(X, last.X, hull->dim) < square((1 - 1e-6) * (distance + last.distance));
    if (!known) last.outside = hull_outside(hull, X);
    last.node = hull->node, last.built = trees_built, last.distance = distance;
    array_copy(last.X, X, hull->dim, sizeof *X);
    return last.outside;
}

real hull_signed_distance(const struct hull *hull, const real *X, real *normal)
{
    real point[DIM_MAX] = {0}, r2 = INFINITY, area[DIM_MAX] = {0};
    if (hull->faces == 0) return INFINITY;
    const int32_t face = nearest_face(hull, X, point, &r2);
    const real distance = sqrt(r2), side = hull_outside_by_last_point(hull, X, distance) ? 1 : -1;
    if (normal && face >= 0) hull_compute_face_area_vector(hull, face, area); /* none if X is not finite */
    const real size = sqrt(dot(area, area, hull->dim));
    for (int d = 0; normal && d < hull->dim; d++)
        normal[d] = distance > 1e-12 * size ? side * (X[d] - point[d]) / distance : size > 0 ? area[d] / size : 0;
    return side * distance;
}
