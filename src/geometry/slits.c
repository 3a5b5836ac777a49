/* Finds free surfaces inside an element mesh: coincident faces, whose nodes are doubled. They become cracks: in 2D
 * straight segments, in 3D planar polygons; coplanar faces that form a convex polygon become one. */
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "geometry/geometry.h"

#define SAME 1e-6 /* distance of corners that coincide, divided by the size of their face [1] */

/* One face of an element mesh (in 2D a segment, in 3D a triangle): positions of its corners and centre, and the longest
 * distance `size` from its first corner to another [m]. */
struct sheet {
    real corner[DIM_MAX][DIM_MAX], centre[DIM_MAX], size;
};

/* List of n faces of an element mesh that coincide with another face, i.e. free surfaces (slits) inside the body. dim:
 * number of dimensions. The caller releases `at` with memory_free. */
struct sheets {
    int dim;
    int64_t n;
    struct sheet *at;
};

/* Returns the distance between the points a[dim] and b[dim] [m]. */
static real corner_distance(const real *a, const real *b, int dim)
{
    real r2 = 0;
    for (int d = 0; d < dim; d++) r2 += square(a[d] - b[d]);
    return sqrt(r2);
}

/* Returns face number `face` of the surface h as a struct sheet: copies its corners, computes its centre and size. */
static struct sheet sheet_of(const struct hull *h, int64_t face)
{
    struct sheet s = {.size = 0};
    for (int c = 0; c < h->dim; c++)
        for (int d = 0; d < h->dim; d++) {
            s.corner[c][d] = h->corner[h->face[face][c]][d];
            s.centre[d] += s.corner[c][d] / h->dim;
        }
    for (int c = 1; c < h->dim; c++) s.size = real_max(s.size, corner_distance(s.corner[0], s.corner[c], h->dim));
    return s;
}

/* Compares two faces a and b (struct sheet) by the x coordinate of their centres, for array_sort: returns -1, 0 or
 * 1. */
static int by_centre(const void *a, const void *b)
{
    const struct sheet *p = a, *q = b;
    return (p->centre[0] > q->centre[0]) - (p->centre[0] < q->centre[0]);
}

/* Returns true if the faces p and q have the same corners, in any order, to within SAME times their size. dim:
 * dimensions, also the number of corners of a face. */
static bool sheets_coincide(const struct sheet *p, const struct sheet *q, int dim)
{
    for (int c = 0; c < dim; c++) {
        bool met = false;
        for (int k = 0; k < dim; k++) met |= corner_distance(p->corner[c], q->corner[k], dim) < SAME * p->size;
        if (!met) return false;
    }
    return true;
}

/* Returns those faces of the surface h that coincide with another face of h, one of each such pair. The caller releases
 * the array `at` of the returned structure with memory_free. */
static struct sheets sheets_doubled(const struct hull *h)
{
    struct sheets s = {.dim = h->dim};
    struct sheet *all = NEW("slits.face", h->faces, struct sheet);
    for (int64_t k = 0; k < h->faces; k++) all[k] = sheet_of(h, k);
    array_sort(all, h->faces, sizeof *all, by_centre);
    s.at = BARE("slits.doubled", h->faces, struct sheet);
    for (int64_t k = 0; k < h->faces; k++)
        for (int64_t j = k + 1; j < h->faces && all[j].centre[0] - all[k].centre[0] < SAME * all[k].size; j++)
            if (sheets_coincide(&all[k], &all[j], s.dim)) {
                s.at[s.n++] = all[k];
                break;
            }
    memory_free(all);
    return s;
}

/* ---- in the plane ------------------------------------------------------------------------------------------------ */

/* Joins the segment `by` to the segment `to` if they have a common end and are collinear: `to` then extends over both.
 * Returns true if they were joined. */
static bool segments_join(struct sheet *to, const struct sheet *by)
{
    const real near = SAME * fmin(to->size, by->size);
    for (int e = 0; e < 4; e++) {
        const real *end = to->corner[e / 2], *other = to->corner[1 - e / 2], *far = by->corner[1 - e % 2];
        const real along[2] = {end[0] - other[0], end[1] - other[1]}, on[2] = {far[0] - end[0], far[1] - end[1]};
        if (corner_distance(end, by->corner[e % 2], 2) > near || along[0] * on[0] + along[1] * on[1] <= 0 ||
            fabs(along[0] * on[1] - along[1] * on[0]) > near * to->size)
            continue;
        for (int d = 0; d < 2; d++) to->corner[e / 2][d] = far[d];
        to->size += by->size;
        return true;
    }
    return false;
}

/* Joins collinear segments with a common end in the list s until there are no more such pairs. */
static void segments_merge(struct sheets *s)
{
    for (int64_t k = 0; k < s->n; k++)
        for (int64_t j = k + 1; j < s->n; j++)
            if (segments_join(&s->at[k], &s->at[j])) s->at[j] = s->at[--s->n], j = k;
}

/* ---- in space ---------------------------------------------------------------------------------------------------- */

/* Plane of a 3D face with n points in it. The plane has the origin `from` [m] and orthogonal unit vectors u and v;
 * at[n]: coordinates of the points along u and v [m]. The function that declares the struct frees `at`. */
struct flat {
    real from[3], u[3], v[3];
    int n;
    real (*at)[2];
};

/* Sets the plane f to that of the face s: its origin and two orthogonal unit vectors in the plane, from the corners of
 * s. */
static void flat_axes(struct flat *f, const struct sheet *s)
{
    real w[3], normal[3];
    for (int d = 0; d < 3; d++) f->from[d] = s->corner[0][d], f->u[d] = s->corner[1][d] - f->from[d];
    for (int d = 0; d < 3; d++) w[d] = s->corner[2][d] - f->from[d];
    vector_product(f->u, w, normal);
    vector_product(normal, f->u, f->v);
    const real u = sqrt(dot(f->u, f->u, 3)), v = sqrt(dot(f->v, f->v, 3));
    for (int d = 0; d < 3; d++) f->u[d] /= u, f->v[d] /= v;
}

/* Computes the coordinates at[2] [m] of the point X in the plane f. */
static void flat_place(const struct flat *f, const real *X, real at[2])
{
    real arm[3];
    for (int d = 0; d < 3; d++) arm[d] = X[d] - f->from[d];
    at[0] = dot(arm, f->u, 3), at[1] = dot(arm, f->v, 3);
}

/* Returns twice the signed area of the plane triangle a, b, c [m^2], positive if its corners are counter-clockwise. */
static real triangle_twice_area(const real *a, const real *b, const real *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Compares two plane points a and b (real[2]) for array_sort, by their first coordinate, then by the second. Returns
 * -1, 0 or 1. */
static int by_place(const void *a, const void *b)
{
    const real *p = a, *q = b;
    return p[0] != q[0] ? (p[0] > q[0]) - (p[0] < q[0]) : (p[1] > q[1]) - (p[1] < q[1]);
}

/* Computes the convex hull of the points in the plane f (Andrew's monotone chain). Stores its corners in corner[2 *
 * f->n + 2] and its area in *area [m^2]. size: length to which tolerances refer [m]. Returns the number of corners. */
static int flat_convex_hull(struct flat *f, real (*corner)[2], real size, real *area)
{
    int n = 0;
    array_sort(f->at, f->n, sizeof *f->at, by_place);
    for (int pass = 0; pass < 2; pass++) {
        const int first = n;
        for (int k = 0; k < f->n; k++) {
            const real *next = f->at[pass == 0 ? k : f->n - 1 - k];
            while (n >= first + 2 && triangle_twice_area(corner[n - 2], corner[n - 1], next) <= SAME * square(size))
                n--;
            corner[n][0] = next[0], corner[n++][1] = next[1];
        }
        n--; /* the last corner begins the other chain */
    }
    *area = 0;
    for (int k = 1; k + 1 < n; k++) *area += 0.5 * triangle_twice_area(corner[0], corner[k], corner[k + 1]);
    return n;
}

/* Returns the area of the triangular face s in 3D [m^2]. */
static real sheet_area(const struct sheet *s)
{
    real u[3], w[3], twice[3];
    for (int d = 0; d < 3; d++) u[d] = s->corner[1][d] - s->corner[0][d], w[d] = s->corner[2][d] - s->corner[0][d];
    vector_product(u, w, twice);
    return 0.5 * sqrt(dot(twice, twice, 3));
}

/* Returns true if the face `other` is coplanar with s and has two corners in common with it, both to within a tolerance
 * relative to the size of the faces. */
static bool sheets_adjoin(const struct sheet *s, const struct sheet *other)
{
    struct flat f;
    int common = 0;
    flat_axes(&f, s);
    real normal[3];
    vector_product(f.u, f.v, normal);
    for (int c = 0; c < 3; c++) {
        real arm[3];
        for (int d = 0; d < 3; d++) arm[d] = other->corner[c][d] - f.from[d];
        if (fabs(dot(arm, normal, 3)) > SAME * s->size) return false;
        for (int k = 0; k < 3; k++) common += corner_distance(other->corner[c], s->corner[k], 3) < SAME * s->size;
    }
    return common == 2;
}

/* Collects the faces of s that adjoin face number `first` in its plane, directly or through other faces: moves them to
 * the positions after it in the list. Returns their number, `first` included. */
static int64_t group_gather(struct sheets *s, int64_t first)
{
    int64_t n = 1;
    for (int64_t k = 0; k < n; k++)
        for (int64_t j = first + n; j < s->n; j++) {
            if (!sheets_adjoin(&s->at[first + k], &s->at[j])) continue;
            const struct sheet swap = s->at[j];
            s->at[j] = s->at[first + n], s->at[first + n++] = swap;
        }
    return n;
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* Appends a crack with `corners` corners to the list *crack of *n cracks. The caller sets the positions of the
 * corners. */
static void slit_add(struct crack **crack, int *n, int corners)
{
    GROW("cracks", *crack, *n + 1);
    (*crack)[*n] = (struct crack){.n = corners, .corner = memory_new("cracks", corners, sizeof(real[DIM_MAX]))};
    (*n)++;
}

/* Appends the face s as a crack to the list *crack of *n cracks. dim: dimensions of the space. */
static void crack_of_sheet(struct crack **crack, int *n, const struct sheet *s, int dim)
{
    slit_add(crack, n, dim);
    for (int c = 0; c < dim; c++)
        for (int d = 0; d < dim; d++) (*crack)[*n - 1].corner[c][d] = s->corner[c][d];
}

/* Appends the faces s[sheets], which are coplanar and connected, to the list *crack of *n cracks. They become one crack
 * if they form a convex polygon, else one crack per face. */
static void cracks_of_group(struct crack **crack, int *n, const struct sheet *s, int64_t sheets)
{
    struct flat f = {.n = 0};
    real sum = 0, area;
    flat_axes(&f, s);
    f.at = memory_new("slits.flat", 3 * sheets, sizeof *f.at);
    real(*corner)[2] = memory_new("slits.round", 6 * sheets + 2, sizeof *corner);
    for (int64_t k = 0; k < sheets; k++) {
        sum += sheet_area(&s[k]);
        for (int c = 0; c < 3; c++) flat_place(&f, s[k].corner[c], f.at[f.n++]);
    }
    const int corners = flat_convex_hull(&f, corner, s->size, &area);
    if (fabs(area - sum) < SAME * sum) {
        slit_add(crack, n, corners);
        for (int c = 0; c < corners; c++)
            for (int d = 0; d < 3; d++)
                (*crack)[*n - 1].corner[c][d] = f.from[d] + corner[c][0] * f.u[d] + corner[c][1] * f.v[d];
    } else {
        for (int64_t k = 0; k < sheets; k++) crack_of_sheet(crack, n, &s[k], 3);
    }
    memory_free(f.at);
    memory_free(corner);
}

void geometry_append_mesh_slits_as_precracks(const struct hull *h, struct crack **crack, int *crack_count)
{
    if (h->open) return;
    struct sheets s = sheets_doubled(h);
    if (h->dim == 2) segments_merge(&s);
    for (int64_t k = 0; k < s.n; k++) {
        if (h->dim == 2) {
            crack_of_sheet(crack, crack_count, &s.at[k], 2);
            continue;
        }
        const int64_t group = group_gather(&s, k);
        cracks_of_group(crack, crack_count, &s.at[k], group);
        k += group - 1;
    }
    memory_free(s.at);
}
