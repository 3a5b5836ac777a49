/* Makes surfaces of bodies from faces: cancels inner faces, finds open edges and components, orients normals
 * outwards. */
#include "data/hull.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"

/* ---- faces and their sides ------------------------------------------------------------------------------------- */

/* A face of a surface, or an edge of a face, with its corners in ascending order. of: number of the face; turn: 1,
 * or -1 if sorting the corners reversed its orientation. */
struct piece {
    int32_t corner[DIM_MAX], of;
    int turn;
};

/* Compares two pieces a and b (faces or edges) for array_sort: by their sorted corners, then by the face from which
 * they originate. */
static int piece_order(const void *a, const void *b)
{
    const struct piece *p = a, *q = b;
    for (int k = 0; k < DIM_MAX; k++)
        if (p->corner[k] != q->corner[k]) return p->corner[k] < q->corner[k] ? -1 : 1;
    return (p->of > q->of) - (p->of < q->of);
}

/* Returns true if the pieces p and q (faces or edges) have the same corners, in whatever orientation. */
static bool piece_same(const struct piece *p, const struct piece *q)
{
    return memcmp(p->corner, q->corner, sizeof p->corner) == 0;
}

/* Sorts the first n corners of the piece p (a face or edge) in ascending order. Each exchange of two corners reverses
 * the orientation p->turn. */
static void piece_sort(struct piece *p, int n)
{
    for (int round = 1; round < n; round++)
        for (int k = 0; k + 1 < n; k++) {
            const int32_t low = p->corner[k + 1];
            if (p->corner[k] <= low) continue;
            p->corner[k + 1] = p->corner[k], p->corner[k] = low, p->turn = -p->turn;
        }
}

/* Returns true if a face of the surface has two equal corners and thus no area. face[dim]: indices of its corners. */
static bool face_degenerate(const struct hull *hull, const int32_t *face)
{
    return face[0] == face[1] || (hull->dim == 3 && (face[1] == face[2] || face[2] == face[0]));
}

/* Cancels faces of the surface that coincide. Of several faces with the same corners one remains, in the orientation
 * that is more frequent; none remains if both orientations are equally frequent, as where two elements meet. Removes
 * faces with two equal corners. Counts in hull->dropped the removed faces, except pairs of opposite orientation. */
static void faces_cancel(struct hull *hull)
{
    struct piece *piece = NEW("hull.pieces", hull->faces, struct piece);
    int64_t n = 0, kept = 0;
    for (int64_t k = 0; k < hull->faces; k++) {
        if (face_degenerate(hull, hull->face[k])) continue;
        struct piece *p = &piece[n++];
        *p = (struct piece){.of = (int32_t)k, .turn = 1};
        for (int c = 0; c < hull->dim; c++) p->corner[c] = hull->face[k][c];
        piece_sort(p, hull->dim);
    }
    array_sort(piece, n, sizeof *piece, piece_order);
    hull->dropped = hull->faces - n;
    for (int64_t k = 0, end; k < n; k = end) {
        int sum = 0;
        for (end = k; end < n && piece_same(&piece[k], &piece[end]); end++) sum += piece[end].turn;
        if (sum != 0) hull->dropped += end - k - 1;
        for (int c = 0; c < DIM_MAX && sum != 0; c++) hull->face[kept][c] = piece[k].corner[c];
        if (sum < 0) hull->face[kept][0] = piece[k].corner[1], hull->face[kept][1] = piece[k].corner[0];
        kept += sum != 0;
    }
    hull->faces = kept;
    memory_free(piece);
}

/* ---- open edges and components ----------------------------------------------------------------------------------- */

/* Lists the edges of all faces of the surface (in 2D the end points of the segments) in side[faces dim], sorted by
 * their corners. Returns their number. */
static int64_t sides_make(const struct hull *hull, struct piece *side)
{
    int64_t n = 0;
    for (int64_t k = 0; k < hull->faces; k++)
        for (int c = 0; c < hull->dim; c++) {
            struct piece *p = &side[n++];
            *p = (struct piece){.of = (int32_t)k, .turn = hull->dim == 2 && c == 0 ? -1 : 1};
            p->corner[0] = hull->face[k][c];
            if (hull->dim == 3) p->corner[1] = hull->face[k][(c + 1) % 3];
            piece_sort(p, hull->dim - 1);
        }
    array_sort(side, n, sizeof *side, piece_order);
    return n;
}

/* Finds holes of the surface hull: counts in hull->open_edges the edges (in 2D end points) that adjacent faces do not
 * traverse equally often in both directions, and stores the middle of the first such edge in hull->open_at [m]. */
static void find_open(struct hull *hull)
{
    struct piece *side = NEW("hull.pieces", hull->faces * hull->dim, struct piece);
    const int64_t n = sides_make(hull, side);
    for (int64_t k = 0, end; k < n; k = end) {
        int sum = 0;
        for (end = k; end < n && piece_same(&side[k], &side[end]); end++) sum += side[end].turn;
        if (sum == 0) continue;
        const real *a = hull->corner[side[k].corner[0]], *b = hull->dim == 3 ? hull->corner[side[k].corner[1]] : a;
        for (int d = 0; d < hull->dim && hull->open_edges == 0; d++) hull->open_at[d] = 0.5 * (a[d] + b[d]);
        hull->open_edges += abs(sum);
    }
    memory_free(side);
}

/* Returns the lowest corner that is known to be connected with `corner`, the root of its tree in a union-find forest.
 * up[corners]: for each corner a lower connected one, or the corner itself; paths to the lowest corner are
 * shortened. */
static int32_t shell_root(int32_t *up, int32_t corner)
{
    while (up[corner] != corner) corner = up[corner] = up[up[corner]];
    return corner;
}

/* Returns the number of connected components of the surface; corners of no face are not counted. */
static int64_t count_shells(const struct hull *hull)
{
    int32_t *up = NEW("hull.shells", hull->corners, int32_t);
    int64_t shells = 0;
    for (int64_t k = 0; k < hull->corners; k++) up[k] = (int32_t)k;
    for (int64_t k = 0; k < hull->faces; k++)
        for (int c = 1; c < hull->dim; c++) {
            const int32_t a = shell_root(up, hull->face[k][0]), b = shell_root(up, hull->face[k][c]);
            up[a > b ? a : b] = a > b ? b : a;
        }
    /* a component is counted at its lowest corner; corners of no face are not counted */
    bool *met = NEW("hull.shells", hull->corners, bool);
    for (int64_t k = 0; k < hull->faces; k++) met[shell_root(up, hull->face[k][0])] = true;
    for (int64_t k = 0; k < hull->corners; k++) shells += met[k];
    memory_free(met);
    memory_free(up);
    return shells;
}

/* ---- measures ------------------------------------------------------------------------------------------------- */

/* Computes area_vector, that of face k, from 0, of the surface hull: the normal of the face times its area [m^2]; in
 * 2D, where a face is a segment, the normal times the length [m]. */
void hull_compute_face_area_vector(const struct hull *hull, int64_t k, real area_vector[DIM_MAX])
{
    const real *a = hull->corner[hull->face[k][0]], *b = hull->corner[hull->face[k][1]];
    if (hull->dim == 2) {
        area_vector[0] = b[1] - a[1], area_vector[1] = a[0] - b[0], area_vector[2] = 0;
        return;
    }
    const real *c = hull->corner[hull->face[k][2]];
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        area_vector[d] = 0.5 * ((b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e]));
    }
}

/* Returns the volume of the body inside the surface [m^dim] by Gauss's theorem: the sum of (X - X0) . area/dim over all
 * faces, with a point X of the face and the area vector of the face. X0 is a corner of the surface, which preserves
 * digits far from the origin. Negative if the faces point inwards. */
static real volume_of(const struct hull *hull)
{
    real sum = 0;
    for (int64_t k = 0; k < hull->faces; k++) {
        real area[DIM_MAX], arm[DIM_MAX];
        hull_compute_face_area_vector(hull, k, area);
        for (int d = 0; d < hull->dim; d++)
            arm[d] = hull->corner[hull->face[k][0]][d] - hull->corner[hull->face[0][0]][d];
        sum += dot(arm, area, hull->dim) / hull->dim;
    }
    return sum;
}

real hull_support_function(const struct hull *hull, const real *direction)
{
    real most = -INFINITY;
    for (int64_t k = 0; k < hull->faces; k++)
        for (int c = 0; c < hull->dim; c++)
            most = real_max(most, dot(hull->corner[hull->face[k][c]], direction, hull->dim));
    return most;
}

/* Reverses the orientation of all faces of the surface s. */
static void faces_reverse(struct hull *hull)
{
    for (int64_t k = 0; k < hull->faces; k++) {
        const int32_t first = hull->face[k][0];
        hull->face[k][0] = hull->face[k][1], hull->face[k][1] = first;
    }
}

/* Initialises the surface *hull with its corners and faces; the hull takes ownership of both arrays. dim: number of
 * dimensions; corner[corners]: positions [m]; face[faces]: indices of dim corners each. */
static void hull_take(struct hull *hull, int dim, int64_t corners, real (*corner)[DIM_MAX], int64_t faces,
                      int32_t (*face)[DIM_MAX])
{
    *hull = (struct hull){.dim = dim, .corners = corners, .corner = corner, .faces = faces, .face = face};
}

void hull_make_closed_surface(struct hull *hull, int dim, int64_t corner_count, real (*corner_positions)[DIM_MAX],
                              int64_t face_count, int32_t (*face_corners)[DIM_MAX])
{
    hull_take(hull, dim, corner_count, corner_positions, face_count, face_corners);
    faces_cancel(hull);
    find_open(hull);
    hull->shells = count_shells(hull);
    hull->volume = volume_of(hull);
    hull->reversed = hull->volume < 0;
    if (hull->reversed) faces_reverse(hull);
    hull->volume = fabs(hull->volume);
    hull_build_face_search_tree(hull);
}

void hull_make_open_surface(struct hull *hull, int dim, int64_t corner_count, real (*corner_positions)[DIM_MAX],
                            int64_t face_count, int32_t (*face_corners)[DIM_MAX])
{
    hull_take(hull, dim, corner_count, corner_positions, face_count, face_corners);
    hull->open = true;
    hull_build_face_search_tree(hull);
}

void hull_free(struct hull *hull)
{
    memory_free(hull->corner);
    memory_free(hull->face);
    memory_free(hull->node);
    *hull = (struct hull){0};
}
