/* Makes copies of solids (moved, rotated, mirrored, repeated), and computes distances over all copies. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "data/region.h"
#include "solid_kinds.h"

/* ---- motions ----------------------------------------------------------------------------------------------------- */

/* Computes sine and cosine of an angle [rad]. Both are exact if the angle is a whole number of quarter turns up to
 * round-off. */
static void sine_cosine(real angle, real *sine, real *cosine)
{
    const real quarter = 1.57079632679489661923, turns = nearbyint(angle / quarter);
    real rest = fma(-turns, quarter, angle);
    if (fabs(rest) < 4e-16 * fabs(angle)) rest = 0;
    const real s = sin(rest), c = cos(rest);
    const real sines[] = {s, c, -s, -c}, cosines[] = {c, -s, -c, s};
    const int at = (int)(turns - 4 * floor(turns / 4));
    *sine = sines[at], *cosine = cosines[at];
}

/* Computes the rotation matrix R about the axis of motion m by `angle` [rad] (Rodrigues' formula); in 2D (dim = 2)
 * about z. */
static void solid_rotation(const struct solid_motion *m, real angle, int dim, real R[DIM_MAX][DIM_MAX])
{
    real k[DIM_MAX] = {0, 0, 1}, s, c;
    const real length = sqrt(dot(m->axis, m->axis, DIM_MAX));
    for (int d = 0; d < DIM_MAX && dim == 3; d++) k[d] = m->axis[d] / length;
    sine_cosine(angle, &s, &c);
    const real cross[DIM_MAX][DIM_MAX] = {{0, -k[2], k[1]}, {k[2], 0, -k[0]}, {-k[1], k[0], 0}};
    for (int a = 0; a < DIM_MAX; a++)
        for (int b = 0; b < DIM_MAX; b++) R[a][b] = (a == b) * c + s * cross[a][b] + (1 - c) * k[a] * k[b];
}

/* Computes the matrix R of the reflection at a plane normal to the axis of motion m: R = I - 2 a a^T/|a|^2. */
static void solid_reflection(const struct solid_motion *m, int dim, real R[DIM_MAX][DIM_MAX])
{
    const real length2 = dot(m->axis, m->axis, dim);
    for (int a = 0; a < DIM_MAX; a++)
        for (int b = 0; b < DIM_MAX; b++)
            R[a][b] = (a == b) - (a < dim && b < dim ? 2 * m->axis[a] * m->axis[b] / length2 : 0);
}

/* Returns the placement of a copy of a solid that results from the placement `from` by rotation or reflection with the
 * matrix R about the point about[dim] [m]. A placement has a rotation and a shift. */
static struct placement image_turned(const struct placement *from, real R[DIM_MAX][DIM_MAX], const real *about, int dim)
{
    struct placement to = {0};
    for (int a = 0; a < DIM_MAX; a++) {
        for (int b = 0; b < DIM_MAX; b++)
            for (int c = 0; c < DIM_MAX; c++) to.turn[a][b] += R[a][c] * from->turn[c][b];
        to.shift[a] = about[a];
        for (int c = 0; c < dim; c++) to.shift[a] += R[a][c] * (from->shift[c] - about[c]);
    }
    return to;
}

/* Returns the placement (rotation and shift) of copy number k, from 0, of a solid that the motion m makes from the
 * placement `from`. dim: number of dimensions. */
static struct placement image_made(const struct placement *from, const struct solid_motion *m, int k, int dim)
{
    struct placement to = *from;
    real R[DIM_MAX][DIM_MAX];
    if (m->kind == MOTION_MOVE || m->kind == MOTION_GRID) {
        for (int d = 0, rest = k; d < dim; d++) {
            const int count = m->kind == MOTION_GRID ? (int)m->count[d] : 1;
            to.shift[d] += (m->kind == MOTION_GRID ? rest % count : 1) * m->step[d];
            rest /= count;
        }
        return to;
    }
    if (m->kind == MOTION_MIRROR)
        solid_reflection(m, dim, R);
    else
        solid_rotation(m, m->kind == MOTION_RING ? k * m->angle : m->angle, dim, R);
    const bool stays = (m->kind == MOTION_MIRROR && m->keep && k == 0) || (m->kind == MOTION_RING && k == 0);
    return stays ? to : image_turned(from, R, m->about, dim);
}

/* Returns the number of copies that the motion m makes of one solid, the original included if it is kept. The number is
 * real, as a scene may request more copies than an integer can count. dim: number of dimensions. */
static real motion_count(const struct solid_motion *m, int dim)
{
    real count = 1;
    if (m->kind == MOTION_MIRROR) return m->keep ? 2 : 1;
    for (int d = 0; d < dim && m->kind == MOTION_GRID; d++) count *= m->count[d];
    return m->kind == MOTION_RING ? m->count[0] : count;
}

/* ---- one copy ---------------------------------------------------------------------------------------------------- */

/* Rotates the vector b[dim] back to the coordinates in which a solid was described: to[dim] = turn^T b, with the
 * rotation `turn` of the placement i of a copy of the solid. */
static void turn_back(const struct placement *i, const real *b, int dim, real *to)
{
    for (int c = 0; c < dim; c++) {
        to[c] = 0;
        for (int a = 0; a < dim; a++) to[c] += i->turn[a][c] * b[a];
    }
}

/* Returns the support in the direction along[dim] of the copy of solid s with placement i (rotation and shift): the
 * maximum of X . along over the points X of the copy. */
static real image_support(const struct solid *s, const struct placement *i, const real *along, int dim)
{
    real own[DIM_MAX] = {0};
    turn_back(i, along, dim, own);
    return solid_types[s->kind].support(s, own, dim) + dot(i->shift, along, dim);
}

/* Computes to[dim], the position X[dim] in the coordinates in which a solid was described [m]: to = turn^T (X - shift)
 * with the placement i (rotation `turn` and shift) of a copy of the solid. */
static void place_back(const struct placement *i, const real *X, int dim, real *to)
{
    real off[DIM_MAX];
    for (int d = 0; d < dim; d++) off[d] = X[d] - i->shift[d];
    turn_back(i, off, dim, to);
}

/* Returns the largest amount by which the level of solid s at a point can be below the distance of the point from the
 * bounding box of s [m]. (The level of a solid is <= 0 inside, see solid_level_set_value.) It is 0 for most solids. It
 * is the size of a voxel for voxel images, because their levels refer to voxel centres. It is INFINITY for a surface
 * with holes, because points far from such a surface can count as inside. */
static real box_slack(const struct solid *s, int dim)
{
    real slack = 0;
    if (s->kind == SOLID_HULL && s->hull->open_edges > 0) return INFINITY;
    for (int d = 0; d < dim && s->kind == SOLID_VOXELS; d++) slack = real_max(slack, s->voxels->of->size[d]);
    for (int k = 0; k < s->region.n; k++) slack = real_max(slack, box_slack(&s->region.solid[k], dim));
    return slack;
}

/* Computes *box, the bounding box of the copy of solid s with placement i (rotation and shift), or of all its copies if
 * i is NULL. The box is enlarged by more than round-off and by box_slack, so that no point with a level <= 0 is
 * outside. dim: number of dimensions. */
static void placement_box(const struct solid *s, const struct placement *i, int dim, struct bounds *box)
{
    const real slack = box_slack(s, s->kind == SOLID_EXTRUSION ? 2 : dim);
    for (int d = 0; d < dim; d++) {
        real along[DIM_MAX] = {0}, end[2];
        for (int side = 0; side < 2; side++) {
            along[d] = side == 0 ? -1 : 1;
            end[side] = i ? image_support(s, i, along, dim) : solid_support_function(s, along, dim);
        }
        const real more = slack + 1e-9 * (fabs(end[0]) + fabs(end[1]));
        box->low[d] = isfinite(end[0]) ? -end[0] - more : -INFINITY;
        box->high[d] = isfinite(end[1]) ? end[1] + more : INFINITY;
    }
}

void solid_bounding_box(const struct solid *s, int dim, struct bounds *box) { placement_box(s, NULL, dim, box); }

/* Rebuilds the tree over the bounding boxes of all copies of the solid s. dim: number of dimensions. */
static void images_index(struct solid *s, int dim)
{
    struct bounds *box = NEW("solids.box", s->images, struct bounds);
    for (int k = 0; k < s->images; k++) placement_box(s, &s->image[k], dim, &box[k]);
    box_tree_free(&s->tree);
    box_tree_make(&s->tree, box, s->images, dim);
    memory_free(box);
}

bool solid_apply_motion_unless_too_many_copies(struct solid *s, const struct solid_motion *m, int dim)
{
    const int before = s->images > 0 ? s->images : 1;
    const real count = motion_count(m, dim) * before;
    struct placement itself = {.turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, *image;
    if (!(count <= IMAGES_MOST)) return false;
    image = NEW("solids.image", (int)count, struct placement);
    for (int k = 0; k < (int)count; k++)
        image[k] = image_made(s->images > 0 ? &s->image[k % before] : &itself, m, k / before, dim);
    memory_free(s->image);
    s->image = image, s->images = (int)count;
    images_index(s, dim);
    GROW("solids.motion", s->motion, s->motions + 1);
    s->motion[s->motions++] = *m;
    return true;
}

/* ---- all copies -------------------------------------------------------------------------------------------------- */

/* Returns the signed distance of X[dim] from the nearest copy of the solid s, negative inside [m]. normal[dim]:
 * receives the outward normal of this copy. If several copies are equally near, the first one counts. */
real solid_signed_distance(const struct solid *s, const real *X, int dim, real *normal)
{
    real nearest = INFINITY, own[DIM_MAX], at[DIM_MAX];
    int first = 0;
    struct box_search near;
    if (s->images == 0) return solid_types[s->kind].distance(s, X, dim, normal);
    for (int d = 0; d < dim; d++) normal[d] = d == 0;
    box_search_start(&near, &s->tree, X, dim);
    for (int k;
         (k = box_search_find_next_box_within(&near, solid_distance_upper_bound_from_level_set(nearest))) >= 0;) {
        const struct placement *i = &s->image[k];
        place_back(i, X, dim, at);
        const real distance = solid_types[s->kind].distance(s, at, dim, own);
        if (!(distance < nearest || (distance == nearest && k < first))) continue;
        nearest = distance, first = k;
        for (int a = 0; a < dim; a++) {
            normal[a] = 0;
            for (int b = 0; b < dim; b++) normal[a] += i->turn[a][b] * own[b];
        }
    }
    return nearest;
}

/* Returns the level of the undisplaced solid s at X[dim], <= 0 inside [m]. X is in the coordinates in which the solid
 * was described; motions and copies of the solid do not count. */
static real image_level(const struct solid *s, const real *X, int dim)
{
    const struct solid_type *type = &solid_types[s->kind];
    real normal[DIM_MAX];
    return type->level ? type->level(s, X, dim) : type->distance(s, X, dim, normal);
}

real solid_level_set_value(const struct solid *s, const real *X, int dim)
{
    real nearest = INFINITY, at[DIM_MAX];
    struct box_search near;
    if (s->images == 0) return image_level(s, X, dim);
    box_search_start(&near, &s->tree, X, dim);
    for (int k;
         (k = box_search_find_next_box_within(&near, solid_distance_upper_bound_from_level_set(nearest))) >= 0;) {
        place_back(&s->image[k], X, dim, at);
        nearest = real_min(nearest, image_level(s, at, dim));
    }
    return nearest;
}

/* Returns true if the level of the undisplaced solid s at X[dim], <= 0 inside, is at most `most` [m]. X is in the
 * coordinates in which the solid was described; motions and copies of the solid do not count. */
static bool image_within(const struct solid *s, const real *X, int dim, real most)
{
    const struct solid_type *type = &solid_types[s->kind];
    return type->within ? type->within(s, X, dim, most) : image_level(s, X, dim) <= most;
}

bool solid_level_set_is_at_most(const struct solid *s, const real *X, int dim, real max_distance)
{
    real at[DIM_MAX];
    bool within = false;
    struct box_search near;
    if (s->images == 0) return image_within(s, X, dim, max_distance);
    box_search_start(&near, &s->tree, X, dim);
    for (int k; !within && (k = box_search_find_next_box_within(
                                &near, solid_distance_upper_bound_from_level_set(max_distance))) >= 0;) {
        place_back(&s->image[k], X, dim, at);
        within = image_within(s, at, dim, max_distance);
    }
    return within;
}

real solid_support_function(const struct solid *s, const real *direction, int dim)
{
    real most = -INFINITY;
    if (s->images == 0) return solid_types[s->kind].support(s, direction, dim);
    for (int k = 0; k < s->images; k++) most = real_max(most, image_support(s, &s->image[k], direction, dim));
    return most;
}

real solid_query_cost_relative_to_ball(const struct solid *s)
{
    real effort = s->region.n == 0 ? 1 : 0;
    for (int k = 0; k < s->region.n; k++) effort += solid_query_cost_relative_to_ball(&s->region.solid[k]);
    if (s->polygon) effort = 1 + 0.1 * s->polygon->n;
    return effort * (s->images > 0 ? s->images : 1);
}
