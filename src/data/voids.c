/* Finds pairs of particles of one body between which there is a void: the segment that connects them leaves the shape
 * of the body. */
#include "data/voids.h"

#include <math.h>

#include "base/memory.h"
#include "data/hull.h"

#define SEAM 1e-5        /* half of the widest gap that counts as closed [spacings]; empirical */
#define STEP_FINE 1e-6   /* smallest step along a segment, as a share of its length, in the first FINE_STEPS steps */
#define STEP_COARSE 1e-3 /* and in later ones, for segments along faces inside the shape */
enum { FINE_STEPS = 400 };
enum { SOLIDS_MOST = 31 }; /* in bodies of more solids all pairs are tested */
/* Result of solids_around for a particle inside a convex part of one solid, with no other solid nearby. */
#define ALONE UINT32_MAX

bool region_has_voxel_image(const struct region *r)
{
    bool image = false;
    for (int k = 0; k < r->n; k++)
        image |= r->solid[k].kind == SOLID_VOXELS || region_has_voxel_image(&r->solid[k].region);
    return image;
}

/* Returns true if the solid s is known to be convex: its kind is convex, and it does not have several copies. */
static bool solid_convex(const struct solid *s)
{
    switch (s->kind) {
    case SOLID_ALL:
    case SOLID_BOX:
    case SOLID_BALL:
    case SOLID_CYLINDER:
    case SOLID_HALF_SPACE:
    case SOLID_ELLIPSOID:
    case SOLID_CONE:
        return s->images <= 1;
    default:
        return false;
    }
}

/* Returns true if the part of the solid s at most `reach` [m] from the point X inside it is known to be convex. */
static bool solid_convex_near(const struct solid *s, const real *X, real reach)
{
    if (s->kind == SOLID_HULL && s->images == 0 && s->radius == 0) return hull_is_convex_near_point(s->hull, X, reach);
    return solid_convex(s);
}

/* Extends the box from[] .. to[] [m] by the box s if the union of both is a box, and returns true. Else returns false
 * and changes nothing. */
static bool box_joins(real *from, real *to, const struct solid *s)
{
    int axis = -1;
    for (int d = 0; d < DIM_MAX; d++) {
        if (s->from[d] == from[d] && s->to[d] == to[d]) continue;
        if (axis >= 0 || s->from[d] > to[d] || s->to[d] < from[d]) return false;
        axis = d;
    }
    if (axis < 0) return true;
    from[axis] = real_min(from[axis], s->from[axis]), to[axis] = real_max(to[axis], s->to[axis]);
    return true;
}

/* Returns true if the solids of the region r are boxes that together make one box, each extending those before it. */
static bool region_is_box(const struct region *r)
{
    real from[DIM_MAX], to[DIM_MAX];
    for (int k = 0; k < r->n; k++) {
        const struct solid *s = &r->solid[k];
        if (!solid_is_untransformed_and_of_kind(s, SOLID_BOX) || s->subtract || s->intersect) return false;
        if (k == 0) array_copy(from, s->from, DIM_MAX, sizeof *from), array_copy(to, s->to, DIM_MAX, sizeof *to);
        if (k > 0 && !box_joins(from, to, s)) return false;
    }
    return true;
}

/* Returns true if the solid s is known to contain the projection of each of its points onto the plane of symmetry
 * `plane`. If s is also convex, s and its mirror image together are convex. tolerance: distance up to which a position
 * counts as on the plane [m]. */
static bool solid_contains_projections(const struct solid *s, const struct mirror_plane *plane, real tolerance)
{
    const int axis = plane->axis;
    const real from = s->from[axis] - plane->at, to = s->to[axis] - plane->at;
    bool parallel = true;
    if (s->images > 0) return false;
    for (int d = 0; d < DIM_MAX; d++) parallel &= d == axis || s->from[d] == s->to[d];
    switch (s->kind) {
    case SOLID_ALL:
        return true;
    case SOLID_BOX:
        return from <= tolerance && to >= -tolerance;
    case SOLID_BALL:
        return fabs(s->centre[axis] - plane->at) <= tolerance;
    case SOLID_CYLINDER: /* its axis is in the plane, or normal to the plane and crosses it */
        return (fabs(from) <= tolerance && fabs(to) <= tolerance) ||
               (parallel && real_min(from, to) <= tolerance && real_max(from, to) >= -tolerance);
    case SOLID_HALF_SPACE:
        return s->normal[axis] == 0;
    default:
        return false;
    }
}

/* Returns true if the convex solid s is known to stay convex when its mirror images at the planes of symmetry of v are
 * added. Only planes within `reach` of the point X[v->dim] matter; all planes if X is NULL. */
static bool mirrors_keep_convex(const struct voids *v, const struct solid *s, const real *X, real reach)
{
    for (int m = 0; m < v->mirrors; m++) {
        const struct mirror_plane *plane = &v->mirror[m];
        if (X && fabs(X[plane->axis] - plane->at) > reach) continue;
        if (!solid_contains_projections(s, plane, SEAM * v->spacing)) return false;
    }
    return true;
}

/* Returns true if the region r is known to be convex together with its mirror images at the planes of symmetry of v:
 * the intersection of convex solids that stay convex with their images. */
static bool region_is_convex_intersection(const struct region *r, const struct voids *v)
{
    bool convex = r->n > 0 && !r->solid[0].intersect;
    for (int k = 0; k < r->n; k++) {
        const struct solid *s = &r->solid[k];
        convex =
            convex && !s->subtract && s->intersect == (k > 0) && solid_convex(s) && mirrors_keep_convex(v, s, NULL, 0);
    }
    return convex;
}

bool region_may_have_voids(const struct region *r, const struct voids *v)
{
    const bool convex =
        region_is_box(r) || (r->n == 1 && solid_convex(&r->solid[0])) || region_is_convex_intersection(r, v);
    return !convex && !region_has_voxel_image(r);
}

/* ---- along a line ------------------------------------------------------------------------------------------------ */

/* Returns a lower bound of the signed distance of X[dim] from the surface of body number `body`, negative inside [m];
 * -INFINITY if the body has no shape, since then nothing is outside it. v: shapes of the bodies. A position beyond a
 * plane of symmetry counts as its mirror image. */
static real void_level(const struct voids *v, int body, const real *X)
{
    real at[DIM_MAX] = {0}, level = INFINITY;
    for (int d = 0; d < v->dim; d++) at[d] = X[d];
    for (int m = 0; m < v->mirrors; m++) {
        const struct mirror_plane *plane = &v->mirror[m];
        if ((at[plane->axis] - plane->at) * plane->outside > 0) at[plane->axis] = 2 * plane->at - at[plane->axis];
    }
    for (int k = 0; k < v->shapes; k++)
        if (v->body[k] == body) level = real_min(level, region_level_set_value(v->shape[k], at, v->dim));
    return level < INFINITY ? level : -INFINITY;
}

/* A segment: from a point of a body, `length` long [m], along the unit vector `along`. */
struct void_line {
    const real *from;
    real along[DIM_MAX], length;
};

/* Computes X[v->dim], the point of the segment l at the distance `at` from its start [m]. */
static void line_place(const struct voids *v, const struct void_line *l, real at, real *X)
{
    for (int d = 0; d < v->dim; d++) X[d] = l->from[d] + at * l->along[d];
}

/* Returns the length of the first part of the segment l that is inside body number `body` [m]; l->length if all of it
 * is. v: shapes of the bodies. Steps along the segment by the lower bound of the distance from the surface, so that no
 * surface is skipped (sphere tracing). */
static real line_inside(const struct voids *v, int body, const struct void_line *l)
{
    real at = 0;
    for (int k = 0; at < l->length; k++) {
        real X[DIM_MAX];
        line_place(v, l, at, X);
        const real level = void_level(v, body, X);
        if (level > SEAM * v->spacing) return at;
        at += real_max(-level, (k < FINE_STEPS ? STEP_FINE : STEP_COARSE) * l->length);
    }
    return l->length;
}

/* Computes normal[v->dim], the direction in which the distance from body number `body` increases fastest, at the
 * distance `at` [m] from the start of the segment l, by central differences. It is not normalised. */
static void line_normal(const struct voids *v, int body, const struct void_line *l, real at, real *normal)
{
    const real step = 1e-4 * v->spacing;
    real X[DIM_MAX];
    line_place(v, l, at, X);
    for (int d = 0; d < v->dim; d++) {
        const real x = X[d];
        X[d] = x + step, normal[d] = void_level(v, body, X);
        X[d] = x - step, normal[d] -= void_level(v, body, X);
        X[d] = x;
    }
}

bool void_separates_points(const struct voids *v, int body_number, const real *point, const real *other_point,
                           bool *surfaces_face_each_other)
{
    const int dim = v->dim;
    struct void_line there = {.from = point}, back = {.from = other_point};
    int first = 0;
    while (first < dim && point[first] == other_point[first]) first++;
    if (first == dim) return false;
    if (point[first] > other_point[first])
        return void_separates_points(v, body_number, other_point, point,
                                     surfaces_face_each_other); /* equal bits in both directions */
    for (int d = 0; d < dim; d++) there.length += square(other_point[d] - point[d]);
    there.length = back.length = sqrt(there.length);
    for (int d = 0; d < dim; d++)
        there.along[d] = (other_point[d] - point[d]) / there.length, back.along[d] = -there.along[d];
    const real out = line_inside(v, body_number, &there);
    if (out >= there.length) return false;
    if (!surfaces_face_each_other) return true;
    real normal[DIM_MAX], other[DIM_MAX];
    line_normal(v, body_number, &there, out, normal);
    line_normal(v, body_number, &back, line_inside(v, body_number, &back), other);
    *surfaces_face_each_other = dot(normal, other, dim) < 0;
    return true;
}

/* ---- all particles ----------------------------------------------------------------------------------------------- */

/* Returns true if a void (space without particles) is between the particles of p with the indices `particle` and
 * `other_particle`, both of one body: the segment that connects them leaves the shape of the body. Returns false if v
 * is NULL, or if one of them is not beside a void. */
bool void_separates_particles(const struct voids *v, const struct particles *p, int64_t particle,
                              int64_t other_particle)
{
    real a[DIM_MAX] = {0}, b[DIM_MAX] = {0};
    if (!particle_is_beside_void(v, particle) || !particle_is_beside_void(v, other_particle)) return false;
    particle_reference_position(p, particle, a);
    particle_reference_position(p, other_particle, b);
    return void_separates_points(v, p->body[particle], a, b, NULL);
}

real voids_particle_surface_distance_lower_bound(const struct voids *v, const struct particles *p, int64_t particle)
{
    real X[DIM_MAX] = {0};
    particle_reference_position(p, particle, X);
    return real_max(0, -void_level(v, p->body[particle], X));
}

/* Solids of a body near one of its particles. solids: number of solids examined so far, also the bit of the next one;
 * within: number of added solids within the search distance; inside: one bit for each convex solid that contains the
 * particle, so that segments from the particle to points of the solid are inside the body. */
struct solids_seen {
    int solids, within;
    uint32_t inside;
};

/* Adds the solids of the region r of a body to *seen, for the point X of this body. Sets the bit in seen->inside of
 * each added solid that contains X (up to SEAM spacings) and is convex within `reach` [m] of X, also with its mirror
 * images. Sets no bit for r if X is outside a solid that is intersected. Returns false if a solid within `reach` is
 * subtracted, or is intersected and not known to be convex. */
static bool region_add_solids_around_point(struct solids_seen *seen, const struct voids *v, const struct region *r,
                                           const real *X, real reach)
{
    const uint32_t before = seen->inside;
    bool outside = false;
    for (int l = 0; l < r->n; l++, seen->solids++) {
        const struct solid *s = &r->solid[l];
        const real level = solid_level_set_value(s, X, v->dim);
        const bool near = s->intersect ? level >= -reach : level <= reach;
        if (near && s->subtract) return false;
        if (s->subtract) continue;
        const bool convex = near && solid_convex_near(s, X, reach) && mirrors_keep_convex(v, s, X, reach);
        if (s->intersect && near && !convex) return false;
        outside |= s->intersect && level > SEAM * v->spacing;
        seen->within += near && !s->intersect;
        if (convex && !s->intersect && level <= SEAM * v->spacing) seen->inside |= 1u << seen->solids;
    }
    if (outside) seen->inside = before;
    return true;
}

/* Returns a set of solids of the body of particle i of p, one bit each: solids of which all segments of at most `reach`
 * [m] from the particle to other points of the solid are inside the body. Two particles at most `reach` apart have no
 * void between them if they have a bit in common. Returns ALONE if there is such a solid and no other solid of the body
 * is within `reach`. Returns 0 if a solid within `reach` is subtracted, or intersected and not known to be convex, or
 * if the body has more than SOLIDS_MOST solids. v: shapes of the bodies. */
static uint32_t solids_around(const struct voids *v, const struct particles *p, int64_t i, real reach)
{
    struct solids_seen seen = {0};
    real X[DIM_MAX] = {0};
    particle_reference_position(p, i, X);
    for (int k = 0; k < v->shapes; k++) {
        const struct region *r = v->shape[k];
        if (v->body[k] != p->body[i]) continue;
        if (seen.solids + r->n > SOLIDS_MOST || r->n == 0 || r->solid[0].intersect) return 0;
        if (!region_add_solids_around_point(&seen, v, r, X, reach)) return 0;
    }
    return seen.within == 1 && seen.inside ? ALONE : seen.inside;
}

/* Tests whether voids (spaces without material) separate particle i of p from its neighbours `near` in the same body.
 * Returns VOID_NEAR if the straight line to one of them leaves the body, else 0; adds VOID_ACROSS if the two surfaces
 * that such a line crosses face each other. v: shapes of the bodies. A line is inside without a test in two cases: the
 * balls around both particles with the radii depth[n_all] (lower bounds of their distances from the surface [m]) cover
 * it, or both have a bit in common in inside[n_all] (solids_around). */
static uint8_t void_search(const struct voids *v, const struct particles *p, const real *depth, const uint32_t *inside,
                           int64_t i, const struct neighbour_list *near)
{
    real a[DIM_MAX] = {0};
    uint8_t bits = 0;
    particle_reference_position(p, i, a);
    for (int k = 0; k < near->n; k++) {
        const int32_t j = near->at[k];
        real b[DIM_MAX] = {0}, length2 = 0;
        bool across = false;
        if (p->body[j] != p->body[i] || inside[i] & inside[j]) continue;
        particle_reference_position(p, j, b);
        for (int d = 0; d < p->dim; d++) length2 += square(b[d] - a[d]);
        if (square(depth[i] + depth[j]) >= length2 || !void_separates_points(v, p->body[i], a, b, &across)) continue;
        bits |= VOID_NEAR | (across ? VOID_ACROSS : 0);
    }
    return bits;
}

void voids_mark_particles_beside_voids(struct voids *v, const struct particles *p, const struct cells *cells,
                                       const struct image *images, real max_distance)
{
    real *depth = NEW("voids.depth", p->n_all, real);
    uint32_t *inside = NEW("voids.inside", p->n_all, uint32_t);
    v->near = NEW("voids.near", p->n_all, uint8_t);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        depth[i] = voids_particle_surface_distance_lower_bound(v, p, i);
        if (depth[i] < max_distance) inside[i] = solids_around(v, p, i, max_distance);
    }
    for (int64_t k = p->n; k < p->n_all; k++) depth[k] = depth[mirror_image_source_particle(p, images, k)];
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(dynamic, 256)
        for (int64_t i = 0; i < p->n; i++) {
            if (depth[i] >= max_distance || inside[i] == ALONE) continue;
            particles_list_neighbours_within_radius(&near, cells, p, i, max_distance, false);
            v->near[i] = void_search(v, p, depth, inside, i, &near);
        }
        memory_free(near.at);
    }
    for (int64_t k = p->n; k < p->n_all; k++) v->near[k] = v->near[mirror_image_source_particle(p, images, k)];
    memory_free(depth);
    memory_free(inside);
}

void voids_free(struct voids *v)
{
    memory_free(v->shape);
    memory_free(v->body);
    memory_free(v->near);
    *v = (struct voids){0};
}
