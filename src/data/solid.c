/* Computes signed distances, level-set values (<= 0 inside) and support functions of each kind of solid. */
#include <math.h>

#include "base/memory.h"
#include "data/region.h"
#include "solid_kinds.h"

/* ---- boxes, balls, half-spaces ----------------------------------------------------------------------------------- */

/* Returns the signed distance of the point at[dim] from a box about the origin with half edges half[dim], negative
 * inside [m]. normal[dim]: receives the outward normal of the nearest point of the surface. */
static real box_surface(const real *at, const real *half, int dim, real *normal)
{
    real out2 = 0, nearest = -INFINITY, beyond[DIM_MAX];
    int face = 0;
    for (int d = 0; d < dim; d++) {
        const real off = fabs(at[d]) - half[d];
        beyond[d] = real_max(off, 0);
        out2 += square(beyond[d]);
        if (off > nearest) nearest = off, face = d;
    }
    const real out = sqrt(out2);
    for (int d = 0; d < dim; d++) normal[d] = copysign(out > 0 ? beyond[d] / out : d == face, at[d]);
    return out > 0 ? out : nearest;
}

/* Returns the signed distance of X[dim] from the box s (s->from to s->to, parallel to the axes), negative inside [m].
 * normal[dim]: receives the outward normal. */
static real box_from(const struct solid *s, const real *X, int dim, real *normal)
{
    real at[DIM_MAX], half[DIM_MAX];
    for (int d = 0; d < dim; d++) {
        half[d] = 0.5 * (s->to[d] - s->from[d]);
        at[d] = X[d] - 0.5 * (s->from[d] + s->to[d]);
    }
    return box_surface(at, half, dim, normal);
}

/* Returns the level of the box s at X[dim], <= 0 inside: the largest of the signed distances of X from the planes of
 * its faces [m]. */
static real box_level(const struct solid *s, const real *X, int dim)
{
    real far = -INFINITY;
    for (int d = 0; d < dim; d++) far = real_max(far, real_max(s->from[d] - X[d], X[d] - s->to[d]));
    return far;
}

/* Returns the support of the box s in the direction along[dim]: the maximum of X . along over the points X of the box
 * [m times the unit of `along`]. */
static real box_support(const struct solid *s, const real *along, int dim)
{
    real sum = 0;
    for (int d = 0; d < dim; d++)
        if (along[d] != 0) sum += along[d] * (along[d] > 0 ? s->to[d] : s->from[d]); /* avoids 0 times infinity */
    return sum;
}

/* Returns the distance of X[dim] from s->centre [m]. normal[dim]: receives the unit vector from the centre to X; the x
 * axis if X is the centre. */
static real centre_from(const struct solid *s, const real *X, int dim, real *normal)
{
    real r2 = 0;
    for (int d = 0; d < dim; d++) normal[d] = X[d] - s->centre[d], r2 += square(normal[d]);
    const real r = sqrt(r2);
    for (int d = 0; d < dim; d++) normal[d] = r > 0 ? normal[d] / r : d == 0;
    return r;
}

/* Returns the signed distance of X[dim] from the ball s, negative inside [m]. normal[dim]: receives the outward
 * normal. */
static real ball_from(const struct solid *s, const real *X, int dim, real *normal)
{
    return centre_from(s, X, dim, normal) - s->radius;
}

/* Returns the support of the ball s in the direction along[dim]: the maximum of X . along over the points X of the
 * ball. */
static real ball_support(const struct solid *s, const real *along, int dim)
{
    return dot(s->centre, along, dim) + s->radius * sqrt(dot(along, along, dim));
}

/* Returns the signed distance of X[dim] from the ring or shell between the radii s->inner and s->radius about
 * s->centre, negative inside [m]. normal[dim]: receives the outward normal of the solid. */
static real ring_from(const struct solid *s, const real *X, int dim, real *normal)
{
    const real r = centre_from(s, X, dim, normal), out = r - s->radius, in = s->inner - r;
    for (int d = 0; d < dim && in > out; d++) normal[d] = -normal[d];
    return real_max(out, in);
}

/* Returns the signed distance of X[dim] from the half-space s, negative inside [m]. normal[dim]: receives the outward
 * normal. s->normal must have a length. */
static real half_space_from(const struct solid *s, const real *X, int dim, real *normal)
{
    const real length = sqrt(dot(s->normal, s->normal, dim));
    real above = 0;
    for (int d = 0; d < dim; d++) {
        normal[d] = s->normal[d] / length;
        above += (X[d] - s->point[d]) * normal[d];
    }
    return above;
}

/* Returns the level of the half-space s at X[dim], <= 0 inside: the signed distance of X from its face [m]; INFINITY if
 * the normal of the half-space has no length. */
static real half_space_level(const struct solid *s, const real *X, int dim)
{
    real length = sqrt(dot(s->normal, s->normal, dim)), above = 0;
    for (int d = 0; d < dim; d++) above += (X[d] - s->point[d]) * s->normal[d];
    return length > 0 ? above / length : INFINITY;
}

/* Returns the support of the half-space s in the direction along[dim]: the maximum of X . along over the points X of s;
 * INFINITY if `along` does not have the direction of the outward normal, up to round-off. */
static real half_space_support(const struct solid *s, const real *along, int dim)
{
    const real length = sqrt(dot(s->normal, s->normal, dim)), size = sqrt(dot(along, along, dim));
    real off2 = 0;
    for (int d = 0; d < dim; d++) off2 += square(along[d] / size - s->normal[d] / length);
    return off2 < 1e-28 ? dot(s->point, along, dim) : INFINITY;
}

/* ---- bodies of revolution ---------------------------------------------------------------------------------------- */

/* Returns the position of X[3] [m] relative to the axis s->from .. s->to of a body of revolution: its coordinate along
 * the axis, from the middle, and its distance from the axis [m], the unit vectors along the axis and from the axis to
 * X, and the length of the axis [m]. If X is on the axis, the second vector is an arbitrary one normal to the axis. */
static struct axis_place axis_place_of(const struct solid *s, const real *X)
{
    struct axis_place p = {0};
    real r2 = 0;
    for (int d = 0; d < DIM_MAX; d++) p.length += square(s->to[d] - s->from[d]);
    p.length = sqrt(p.length);
    for (int d = 0; d < DIM_MAX; d++) {
        p.axis[d] = (s->to[d] - s->from[d]) / p.length;
        p.along += (X[d] - 0.5 * (s->from[d] + s->to[d])) * p.axis[d];
    }
    for (int d = 0; d < DIM_MAX; d++) {
        p.out[d] = X[d] - 0.5 * (s->from[d] + s->to[d]) - p.along * p.axis[d];
        r2 += square(p.out[d]);
    }
    p.across = sqrt(r2);
    for (int d = 0; d < DIM_MAX && p.across > 0; d++) p.out[d] /= p.across;
    if (p.across > 0) return p;
    int least = 0; /* on the axis: any direction normal to it */
    for (int d = 1; d < DIM_MAX; d++)
        if (fabs(p.axis[d]) < fabs(p.axis[least])) least = d;
    for (int d = 0; d < DIM_MAX; d++) p.out[d] = (d == least) - p.axis[least] * p.axis[d];
    const real size = sqrt(dot(p.out, p.out, DIM_MAX));
    for (int d = 0; d < DIM_MAX; d++) p.out[d] /= size;
    return p;
}

/* Computes normal[3] in the axes of space from in_plane[2], its components along the axis of a solid and away from that
 * axis. p: cylindrical coordinates of the point, with the unit vectors of both directions. */
static void axis_normal(const struct axis_place *p, const real in_plane[2], real *normal)
{
    for (int d = 0; d < DIM_MAX; d++) normal[d] = in_plane[0] * p->axis[d] + in_plane[1] * p->out[d];
}

/* Returns the signed distance of X[3] from a cylinder or tube s, negative inside [m]. normal[3]: receives the outward
 * normal. In the half-plane through axis and X the solid is a box from the radius `inner` to s->radius; for a cylinder,
 * `inner` is -s->radius. */
static real pipe_from(const struct solid *s, const real *X, real inner, real *normal)
{
    const struct axis_place p = axis_place_of(s, X);
    const real at[] = {p.along, p.across - 0.5 * (s->radius + inner)};
    const real half[] = {0.5 * p.length, 0.5 * (s->radius - inner)};
    real in_plane[2];
    const real distance = box_surface(at, half, 2, in_plane);
    axis_normal(&p, in_plane, normal);
    return distance;
}

/* Returns the signed distance of X[3] from the cylinder s, negative inside [m]. normal[3]: receives the outward
 * normal. */
static real cylinder_from(const struct solid *s, const real *X, int dim, real *normal)
{
    (void)dim;
    return pipe_from(s, X, -s->radius, normal);
}

/* Returns the signed distance of X[3] from the tube s with the radii s->inner and s->radius, negative inside [m].
 * normal[3]: receives the outward normal. */
static real tube_from(const struct solid *s, const real *X, int dim, real *normal)
{
    (void)dim;
    return pipe_from(s, X, s->inner, normal);
}

/* Computes the unit vector `unit` from a[dim] to b[dim] [m] and returns the distance between both [m]. A distance of 0
 * gives the vector 0. */
static real solid_direction(const real *a, const real *b, int dim, real unit[DIM_MAX])
{
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += square(a[d] - b[d]);
    const real length = sqrt(sum), divisor = length > 0 ? length : INFINITY;
    for (int d = 0; d < dim; d++) unit[d] = (b[d] - a[d]) / divisor;
    return length;
}

/* Returns the level of the cylinder s at X[dim], <= 0 inside: the larger of the signed distances of X from its mantle
 * and from the planes of its ends [m]. */
static real cylinder_level(const struct solid *s, const real *X, int dim)
{
    real axis[DIM_MAX], arm[DIM_MAX], length = solid_direction(s->from, s->to, dim, axis);
    for (int d = 0; d < dim; d++) arm[d] = X[d] - s->from[d];
    real along = dot(arm, axis, dim), across = 0;
    for (int d = 0; d < dim; d++) across += square(arm[d] - along * axis[d]);
    return real_max(sqrt(across) - s->radius, real_max(-along, along - length));
}

/* Returns the support of a disc in the direction along[3]: the maximum of X . along over its points X. The disc has its
 * middle at centre[3] [m], has `radius` [m] and is normal to the axis of the solid s. */
static real end_support(const struct solid *s, const real *centre, real radius, const real *along)
{
    real axis[DIM_MAX];
    solid_direction(s->from, s->to, DIM_MAX, axis);
    const real size2 = dot(along, along, DIM_MAX), lengthwise = dot(along, axis, DIM_MAX);
    return dot(centre, along, DIM_MAX) + radius * sqrt(real_max(0, size2 - square(lengthwise)));
}

static real cylinder_support(const struct solid *s, const real *along, int dim)
{
    (void)dim;
    return real_max(end_support(s, s->from, s->radius, along), end_support(s, s->to, s->radius, along));
}

/* Returns the signed distance of X[3] from the cone s, negative inside [m]. normal[3]: receives the outward normal.
 * Both follow from the section of the cone in the plane through axis and X: a trapezoid, or a triangle if the cone ends
 * in a point. */
static real cone_from(const struct solid *s, const real *X, int dim, real *normal)
{
    (void)dim;
    const struct axis_place p = axis_place_of(s, X);
    const real half = 0.5 * p.length, at[] = {p.along, p.across};
    real corner[4][2], in_plane[2];
    struct polygon section = {.corner = corner, .sense = 1};
    const real ends[4][2] = {{-half, -s->radius}, {half, -s->inner}, {half, s->inner}, {-half, s->radius}};
    for (int k = 0; k < 4; k++) {
        if ((k == 2 && s->inner == 0) || (k == 3 && s->radius == 0)) continue;
        corner[section.n][0] = ends[k][0], corner[section.n++][1] = ends[k][1];
    }
    const real distance = polygon_signed_distance(&section, at, in_plane);
    axis_normal(&p, in_plane, normal);
    return distance;
}

static real cone_support(const struct solid *s, const real *along, int dim)
{
    (void)dim;
    return real_max(end_support(s, s->from, s->radius, along), end_support(s, s->to, s->inner, along));
}

/* Returns the signed distance of X[3] from the torus s, negative inside [m]. normal[3]: receives the outward normal.
 * The torus has a round section of radius s->inner along the circle of radius s->radius about the axis s->normal. */
static real torus_from(const struct solid *s, const real *X, int dim, real *normal)
{
    struct solid line = {0};
    const real length = sqrt(dot(s->normal, s->normal, dim));
    for (int d = 0; d < DIM_MAX; d++) {
        line.from[d] = s->centre[d] - 0.5 * s->normal[d] / length;
        line.to[d] = s->centre[d] + 0.5 * s->normal[d] / length;
    }
    const struct axis_place p = axis_place_of(&line, X);
    const real in_plane[] = {p.along, p.across - s->radius}, r = hypot(in_plane[0], in_plane[1]);
    const real unit[] = {r > 0 ? in_plane[0] / r : 1, r > 0 ? in_plane[1] / r : 0};
    axis_normal(&p, unit, normal);
    return r - s->inner;
}

static real torus_support(const struct solid *s, const real *along, int dim)
{
    const real size2 = dot(along, along, dim),
               lengthwise2 = square(dot(along, s->normal, dim)) / dot(s->normal, s->normal, dim);
    return dot(s->centre, along, dim) + s->radius * sqrt(real_max(0, size2 - lengthwise2)) + s->inner * sqrt(size2);
}

/* ---- polygons, ellipsoids, extrusions, groups -------------------------------------------------------------------- */

/* Returns the signed distance of X[2] from the polygon s->polygon, negative inside [m]. normal[2]: receives the outward
 * normal. */
static real polygon_from(const struct solid *s, const real *X, int dim, real *normal)
{
    (void)dim;
    return polygon_signed_distance(s->polygon, X, normal);
}

static real polygon_reach(const struct solid *s, const real *along, int dim)
{
    (void)dim;
    return polygon_support_function(s->polygon, along);
}

static real ellipsoid_support(const struct solid *s, const real *along, int dim)
{
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += square(s->radii[d] * along[d]);
    return dot(s->centre, along, dim) + sqrt(sum);
}

/* Stores in axes[2] the two axes normal to the axis of the extrusion s, in ascending order. */
static void plane_axes(const struct solid *s, int axes[2])
{
    axes[0] = s->axis == 0 ? 1 : 0;
    axes[1] = s->axis == 2 ? 1 : 2;
}

/* Returns the signed distance of X[3] from the extrusion s of the plane region s->region along the axis s->axis,
 * negative inside [m]. normal[3]: receives the outward normal. */
static real extrusion_from(const struct solid *s, const real *X, int dim, real *normal)
{
    int axes[2];
    (void)dim;
    plane_axes(s, axes);
    const real flat[] = {X[axes[0]], X[axes[1]]}, below = s->begin - X[s->axis], above = X[s->axis] - s->end;
    real own[DIM_MAX];
    const real across = region_signed_distance(&s->region, flat, 2, own), along = real_max(below, above);
    const real outside = hypot(real_max(across, 0), real_max(along, 0));
    const real share = outside > 0 ? real_max(across, 0) / outside : across >= along;
    const real rest = outside > 0 ? real_max(along, 0) / outside : across < along;
    normal[axes[0]] = share * own[0], normal[axes[1]] = share * own[1];
    normal[s->axis] = above > below ? rest : -rest;
    return outside > 0 ? outside : real_max(across, along);
}

/* Returns the level of the extrusion s at X[3], <= 0 inside: the larger of the level of its plane region and the signed
 * distance from its ends [m]. */
static real extrusion_level(const struct solid *s, const real *X, int dim)
{
    int axes[2];
    (void)dim;
    plane_axes(s, axes);
    const real flat[] = {X[axes[0]], X[axes[1]]};
    return real_max(region_level_set_value(&s->region, flat, 2), real_max(s->begin - X[s->axis], X[s->axis] - s->end));
}

/* Returns true if the level of the extrusion s at X[3], <= 0 inside, is at most `most` [m]. */
static bool extrusion_within(const struct solid *s, const real *X, int dim, real most)
{
    int axes[2];
    (void)dim;
    plane_axes(s, axes);
    const real flat[] = {X[axes[0]], X[axes[1]]};
    if (!(real_max(s->begin - X[s->axis], X[s->axis] - s->end) <= most)) return false;
    return region_contains(&s->region, flat, 2, most);
}

static real extrusion_support(const struct solid *s, const real *along, int dim)
{
    int axes[2];
    (void)dim;
    plane_axes(s, axes);
    const real flat[] = {along[axes[0]], along[axes[1]]}, up = along[s->axis];
    const real ends = up == 0 ? 0 : up * (up > 0 ? s->end : s->begin);
    return ends + (flat[0] == 0 && flat[1] == 0 ? 0 : region_support_function_bound(&s->region, flat, 2));
}

static real group_from(const struct solid *s, const real *X, int dim, real *normal)
{
    return region_signed_distance(&s->region, X, dim, normal);
}

static real group_level(const struct solid *s, const real *X, int dim)
{
    return region_level_set_value(&s->region, X, dim);
}

static bool group_within(const struct solid *s, const real *X, int dim, real most)
{
    return region_contains(&s->region, X, dim, most);
}

static real group_support(const struct solid *s, const real *along, int dim)
{
    return region_support_function_bound(&s->region, along, dim);
}

static real hull_from(const struct solid *s, const real *X, int dim, real *normal)
{
    (void)dim;
    return hull_signed_distance(s->hull, X, normal) - s->radius;
}

static real hull_reach(const struct solid *s, const real *along, int dim)
{
    return hull_support_function(s->hull, along) + s->radius * sqrt(dot(along, along, dim));
}

/* Returns true if the signed distance of X[3] from the solid s bounded by the surface s->hull, extended by s->radius
 * [m], is at most `most` [m]. */
static bool hull_holds(const struct solid *s, const real *X, int dim, real most)
{
    (void)dim;
    return s->radius == 0 ? hull_point_is_within_distance(s->hull, X, most)
                          : hull_signed_distance(s->hull, X, NULL) - s->radius <= most;
}

static real voxels_from(const struct solid *s, const real *X, int dim, real *normal)
{
    (void)dim;
    return voxel_solid_signed_distance(s->voxels, X, normal);
}

static real voxels_level(const struct solid *s, const real *X, int dim)
{
    (void)dim;
    return voxel_solid_signed_distance(s->voxels, X, NULL);
}

/* Returns the support in the direction along[dim] of the box of the whole voxel image to which s belongs: the maximum
 * of X . along over the points X of the box. */
static real voxels_reach(const struct solid *s, const real *along, int dim)
{
    const struct voxels *v = s->voxels->of;
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += along[d] * (v->from[d] + (along[d] > 0 ? (real)v->n[d] * v->size[d] : 0));
    return sum;
}

/* Returns the distance of X from s, the solid that fills all of space: -INFINITY, with an arbitrary normal. */
static real all_from(const struct solid *s, const real *X, int dim, real *normal)
{
    (void)s, (void)X;
    for (int d = 0; d < dim; d++) normal[d] = d == 0;
    return -INFINITY;
}

static real all_support(const struct solid *s, const real *along, int dim)
{
    (void)s, (void)along, (void)dim;
    return INFINITY;
}

const struct solid_type solid_types[SOLID_KINDS] = {
    [SOLID_ALL] = {all_from, NULL, all_support, NULL},
    [SOLID_BOX] = {box_from, box_level, box_support, NULL},
    [SOLID_BALL] = {ball_from, NULL, ball_support, NULL},
    [SOLID_CYLINDER] = {cylinder_from, cylinder_level, cylinder_support, NULL},
    [SOLID_HALF_SPACE] = {half_space_from, half_space_level, half_space_support, NULL},
    [SOLID_ELLIPSOID] = {ellipsoid_signed_distance, NULL, ellipsoid_support, NULL},
    [SOLID_RING] = {ring_from, NULL, ball_support, NULL},
    [SOLID_POLYGON] = {polygon_from, NULL, polygon_reach, NULL},
    [SOLID_TUBE] = {tube_from, NULL, cylinder_support, NULL},
    [SOLID_CONE] = {cone_from, NULL, cone_support, NULL},
    [SOLID_TORUS] = {torus_from, NULL, torus_support, NULL},
    [SOLID_HULL] = {hull_from, NULL, hull_reach, hull_holds},
    [SOLID_VOXELS] = {voxels_from, voxels_level, voxels_reach, NULL},
    [SOLID_EXTRUSION] = {extrusion_from, extrusion_level, extrusion_support, extrusion_within},
    [SOLID_GROUP] = {group_from, group_level, group_support, group_within},
};

real solid_radius_if_round(const struct solid *s, int dim)
{
    real least = INFINITY;
    for (int d = 0; d < dim && s->kind == SOLID_ELLIPSOID; d++) least = real_min(least, s->radii[d]);
    const bool is_round =
        s->kind == SOLID_BALL || s->kind == SOLID_CYLINDER || s->kind == SOLID_TUBE || s->kind == SOLID_RING;
    return is_round ? s->radius : least;
}

real solid_least_thickness(const struct solid *s, int dim)
{
    switch (s->kind) {
    case SOLID_TUBE:
    case SOLID_RING:
        return s->radius - s->inner;
    case SOLID_TORUS:
        return 2 * s->inner;
    default:
        return 2 * solid_radius_if_round(s, dim);
    }
}

void solid_free(struct solid *s)
{
    region_free(&s->region);
    if (s->polygon) {
        memory_free(s->polygon->corner);
        memory_free(s->polygon->bend);
    }
    memory_free(s->polygon);
    memory_free(s->motion);
    memory_free(s->image);
    box_tree_free(&s->tree);
}
