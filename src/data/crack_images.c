/* Clips cracks at planes of symmetry to the modelled part of the body, and lists them with their mirror images. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "data/region.h"

/* Returns the distance of X[dim] [m] from the plane of symmetry m [m], positive on the side of the body. */
static real inner_height(const struct mirror_plane *m, const real *X)
{
    return (real)-m->outside * (X[m->axis] - m->at);
}

bool crack_end_is_continued_by_mirrors(const struct mirror_plane *mirror_planes, int mirror_count,
                                       const struct crack *c, const real *end, real tolerance)
{
    for (int k = 0; k < mirror_count; k++)
        for (int a = 0; a < c->n && inner_height(&mirror_planes[k], end) <= tolerance; a++)
            if (inner_height(&mirror_planes[k], c->corner[a]) > tolerance) return true;
    return false;
}

/* Computes X[DIM_MAX], the intersection of the segment from a to b with the plane of symmetry m [m]. The coordinate of
 * X normal to the plane is exact. The ends must be on different sides. */
static void plane_intersection(const struct mirror_plane *m, const real *a, const real *b, real *X)
{
    const real share = inner_height(m, a) / (inner_height(m, a) - inner_height(m, b));
    for (int d = 0; d < DIM_MAX; d++) X[d] = a[d] + share * (b[d] - a[d]);
    X[m->axis] = m->at;
}

/* Clips the crack c to the body's side of the plane of symmetry m. A polygon may gain one corner, for which c->corner
 * must have capacity; a crack beyond the plane keeps no corner (c->n is 0). tolerance: distance up to which a corner
 * beyond the plane counts as inside [m]. */
static void crack_clip(struct crack *c, const struct mirror_plane *m, real tolerance)
{
    real(*corner)[DIM_MAX] = memory_new("crack.clip", c->n + 1, sizeof *corner);
    int n = 0;
    for (int k = 0; k < c->n; k++) {
        const real *a = c->corner[k], *b = c->corner[(k + 1) % c->n];
        const bool inside = inner_height(m, a) >= -tolerance, next = inner_height(m, b) >= -tolerance;
        if (inside) memcpy(corner[n++], a, sizeof *corner);
        if (inside != next && (c->n > 2 || k == 0)) plane_intersection(m, a, b, corner[n++]);
    }
    array_copy(c->corner, corner, n, sizeof *corner);
    c->n = n;
    memory_free(corner);
}

/* Appends a copy of crack c to the list `to`, with capacity for `more` further corners, and returns the copy, which the
 * list owns. of: index of the scene's crack from which c originates. */
static struct crack *crack_add(struct crack_list *to, const struct crack *c, int of, int more)
{
    GROW("crack.images", to->crack, to->n + 1);
    GROW("crack.images", to->of, to->n + 1);
    struct crack *new = &to->crack[to->n];
    *new = *c;
    new->corner = memory_new("crack.corners", c->n + more, sizeof *new->corner);
    array_copy(new->corner, c->corner, c->n, sizeof *c->corner);
    to->of[to->n++] = of;
    return new;
}

/* Appends the mirror image, at the plane of symmetry m, of crack number k of the list to the list. Appends nothing if
 * the crack is in this plane, up to `tolerance` [m], or farther from it than `reach`, the length of the longest bonds
 * [m]. The order of the corners is reversed, which reverses the normal of the image: a crack and its image that are in
 * one plane thus have the same normal. */
static void image_add(struct crack_list *to, int k, const struct mirror_plane *m, real reach, real tolerance)
{
    const struct crack c = to->crack[k];
    real least = INFINITY, most = -INFINITY;
    for (int a = 0; a < c.n; a++) {
        const real height = inner_height(m, c.corner[a]);
        least = real_min(least, height), most = real_max(most, height);
    }
    if (least > reach || most <= tolerance) return;
    struct crack *image = crack_add(to, &c, to->of[k], 0);
    for (int a = 0; a < c.n; a++) {
        memcpy(image->corner[a], c.corner[c.n - 1 - a], sizeof *image->corner);
        image->corner[a][m->axis] = 2 * m->at - image->corner[a][m->axis];
    }
}

void cracks_make_mirror_images(struct crack_list *list, const struct crack *crack, int crack_count,
                               const struct mirror_plane *mirror, int mirror_count, real image_reach, real tolerance)
{
    *list = (struct crack_list){0};
    for (int k = 0; k < crack_count; k++) {
        struct crack *c = crack_add(list, &crack[k], k, mirror_count);
        for (int b = 0; b < mirror_count && c->n > 0; b++) crack_clip(c, &mirror[b], tolerance);
        if (c->n == 0) memory_free(list->crack[--list->n].corner);
    }
    for (int b = 0; b < mirror_count; b++) /* including images of images, at corners */
        for (int k = 0, n = list->n; k < n; k++) image_add(list, k, &mirror[b], image_reach, tolerance);
}

void crack_list_free(struct crack_list *l)
{
    for (int k = 0; k < l->n; k++) memory_free(l->crack[k].corner);
    memory_free(l->crack);
    memory_free(l->of);
    *l = (struct crack_list){0};
}
