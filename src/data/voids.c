/* Finds pairs of particles of a body whose connecting segment leaves its shape. */
#include "data/voids.h"

#include <math.h>

#include "base/memory.h"

#define SEAM 1e-5        /* half of the widest gap that counts as closed [spacings]; empirical */
#define STEP_FINE 1e-6   /* smallest step along a segment, as a share of its length, in the first FINE_STEPS steps */
#define STEP_COARSE 1e-3 /* and in later ones, for segments along faces inside the shape */
enum { FINE_STEPS = 400 };

bool region_has_image(const struct region *r)
{
    bool image = false;
    for (int k = 0; k < r->n; k++) image |= r->solid[k].kind == SOLID_VOXELS || region_has_image(&r->solid[k].region);
    return image;
}

/* Returns true if a solid is known to be convex. */
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

bool region_has_voids(const struct region *r)
{
    const bool convex = r->n == 0 || (r->n == 1 && solid_convex(&r->solid[0]));
    return !convex && !region_has_image(r);
}

/* ---- along a line ------------------------------------------------------------------------------------------------ */

/* Returns a lower bound of the signed distance of X from the surface of a body, negative inside [m]; -INFINITY if the
 * body has no shape, so that it hides nothing. */
static real void_level(const struct voids *v, int body, const real *X)
{
    real at[DIM_MAX] = {0}, level = INFINITY;
    for (int d = 0; d < v->dim; d++) at[d] = X[d];
    for (int m = 0; m < v->mirrors; m++) {
        const struct mirror_plane *plane = &v->mirror[m];
        if ((at[plane->axis] - plane->at) * plane->outside > 0) at[plane->axis] = 2 * plane->at - at[plane->axis];
    }
    for (int k = 0; k < v->shapes; k++)
        if (v->body[k] == body) level = real_min(level, region_level(v->shape[k], at, v->dim));
    return level < INFINITY ? level : -INFINITY;
}

/* A segment: from a point of a body, `length` long [m], along the unit vector `along`. */
struct void_line {
    const real *from;
    real along[DIM_MAX], length;
};

/* Computes the point at distance `at` from the start of a segment. */
static void line_place(const struct voids *v, const struct void_line *l, real at, real *X)
{
    for (int d = 0; d < v->dim; d++) X[d] = l->from[d] + at * l->along[d];
}

/* Returns the length of the first part of a segment that is inside the body [m], l->length if it ends inside. Steps
 * have the length of the level, a lower bound of the distance, so that no surface is skipped (sphere tracing). */
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

/* Computes the direction in which the level increases fastest at a point of a segment, by differences. */
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

bool void_separates_points(const struct voids *v, int body, const real *a, const real *b, bool *across)
{
    const int dim = v->dim;
    struct void_line there = {.from = a}, back = {.from = b};
    int first = 0;
    while (first < dim && a[first] == b[first]) first++;
    if (first == dim) return false;
    if (a[first] > b[first]) return void_separates_points(v, body, b, a, across); /* equal bits in both directions */
    for (int d = 0; d < dim; d++) there.length += square(b[d] - a[d]);
    there.length = back.length = sqrt(there.length);
    for (int d = 0; d < dim; d++) there.along[d] = (b[d] - a[d]) / there.length, back.along[d] = -there.along[d];
    const real out = line_inside(v, body, &there);
    if (out >= there.length) return false;
    if (!across) return true;
    real normal[DIM_MAX], other[DIM_MAX];
    line_normal(v, body, &there, out, normal);
    line_normal(v, body, &back, line_inside(v, body, &back), other);
    *across = dot(normal, other, dim) < 0;
    return true;
}

/* ---- all particles ----------------------------------------------------------------------------------------------- */

/* Returns true if a void is between particles i and j of a body. v NULL: false. */
bool void_separates_particles(const struct voids *v, const struct particles *p, int64_t i, int64_t j)
{
    real a[DIM_MAX] = {0}, b[DIM_MAX] = {0};
    if (!voids_near(v, i) || !voids_near(v, j)) return false;
    particle_place(p, i, a);
    particle_place(p, j, b);
    return void_separates_points(v, p->body[i], a, b, NULL);
}

real voids_particle_depth(const struct voids *v, const struct particles *p, int64_t i)
{
    real X[DIM_MAX] = {0};
    particle_place(p, i, X);
    return real_max(0, -void_level(v, p->body[i], X));
}

/* Returns VOID_NEAR if a segment from particle i to a particle of its body in `near` leaves the body, with VOID_ACROSS
 * if both surfaces that it crosses face each other; else 0. depth: [p->n_all] lower bounds of the particles' distances
 * from the surface [m]: a segment covered by the balls of these radii around its ends is inside. */
static uint8_t void_search(const struct voids *v, const struct particles *p, const real *depth, int64_t i,
                           const struct near *near)
{
    real a[DIM_MAX] = {0};
    uint8_t bits = 0;
    particle_place(p, i, a);
    for (int k = 0; k < near->n; k++) {
        const int32_t j = near->at[k];
        real b[DIM_MAX] = {0}, length2 = 0;
        bool across = false;
        if (p->body[j] != p->body[i]) continue;
        particle_place(p, j, b);
        for (int d = 0; d < p->dim; d++) length2 += square(b[d] - a[d]);
        if (square(depth[i] + depth[j]) >= length2 || !void_separates_points(v, p->body[i], a, b, &across)) continue;
        bits |= VOID_NEAR | (across ? VOID_ACROSS : 0);
    }
    return bits;
}

void voids_find(struct voids *v, const struct particles *p, const struct cells *cells, const struct image *image,
                real reach)
{
    real *depth = NEW("voids.depth", p->n_all, real);
    v->near = NEW("voids.near", p->n_all, uint8_t);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) depth[i] = voids_particle_depth(v, p, i);
    for (int64_t k = p->n; k < p->n_all; k++) depth[k] = depth[image_root(p, image, k)];
#pragma omp parallel
    {
        struct near near = {0};
#pragma omp for schedule(dynamic, 256)
        for (int64_t i = 0; i < p->n; i++) {
            if (depth[i] >= reach) continue;
            particles_find_near(&near, cells, p, i, reach, false);
            v->near[i] = void_search(v, p, depth, i, &near);
        }
        memory_free(near.at);
    }
    for (int64_t k = p->n; k < p->n_all; k++) v->near[k] = v->near[image_root(p, image, k)];
    memory_free(depth);
}

void voids_free(struct voids *v)
{
    memory_free(v->shape);
    memory_free(v->body);
    memory_free(v->near);
    *v = (struct voids){0};
}
