/* Distances from regions, and the direction of their surfaces. */
#include <math.h>

#include "data/region.h"

/* Of a point `at` from a box about the origin, `half` its half edges. */
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

static real box_from(const struct solid *s, const real *X, int dim, real *normal)
{
    real at[DIM_MAX], half[DIM_MAX];
    for (int d = 0; d < dim; d++) {
        half[d] = 0.5 * (s->to[d] - s->from[d]);
        at[d] = X[d] - 0.5 * (s->from[d] + s->to[d]);
    }
    return box_surface(at, half, dim, normal);
}

static real ball_from(const struct solid *s, const real *X, int dim, real *normal)
{
    real r2 = 0;
    for (int d = 0; d < dim; d++) normal[d] = X[d] - s->centre[d], r2 += square(normal[d]);
    const real r = sqrt(r2);
    for (int d = 0; d < dim; d++) normal[d] = r > 0 ? normal[d] / r : d == 0;
    return r - s->radius;
}

/* A box in the half plane of the axis and the radius through the point. */
static real cylinder_from(const struct solid *s, const real *X, real *normal)
{
    real axis[DIM_MAX], across[DIM_MAX], length = 0, along = 0, r = 0, in_plane[DIM_MAX];
    for (int d = 0; d < DIM_MAX; d++) length += square(s->to[d] - s->from[d]);
    length = sqrt(length);
    for (int d = 0; d < DIM_MAX; d++) {
        axis[d] = (s->to[d] - s->from[d]) / length;
        along += (X[d] - 0.5 * (s->from[d] + s->to[d])) * axis[d];
    }
    for (int d = 0; d < DIM_MAX; d++) {
        across[d] = X[d] - 0.5 * (s->from[d] + s->to[d]) - along * axis[d];
        r += square(across[d]);
    }
    r = sqrt(r);
    const real at[] = {along, r}, half[] = {0.5 * length, s->radius};
    const real distance = box_surface(at, half, 2, in_plane);
    for (int d = 0; d < DIM_MAX; d++)
        normal[d] = in_plane[0] * axis[d] + (r > 0 ? in_plane[1] * across[d] / r : 0);
    return distance;
}

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

static real solid_from(const struct solid *s, const real *X, int dim, real *normal)
{
    switch (s->kind) {
    case SOLID_BOX: return box_from(s, X, dim, normal);
    case SOLID_BALL: return ball_from(s, X, dim, normal);
    case SOLID_CYLINDER: return cylinder_from(s, X, normal);
    case SOLID_HALF_SPACE: return half_space_from(s, X, dim, normal);
    default: for (int d = 0; d < dim; d++) normal[d] = d == 0; return -INFINITY;
    }
}

real region_distance(const struct region *r, const real *X, int dim, real *normal)
{
    real nearest = INFINITY, own[DIM_MAX];
    for (int d = 0; d < dim; d++) normal[d] = d == 0;
    for (int k = 0; k < r->n; k++) {
        const bool hole = r->solid[k].subtract;
        const real distance = solid_from(&r->solid[k], X, dim, own) * (hole ? -1 : 1);
        if (hole ? distance <= nearest : distance >= nearest) continue;
        nearest = distance;
        for (int d = 0; d < dim; d++) normal[d] = hole ? -own[d] : own[d];
    }
    return nearest;
}
