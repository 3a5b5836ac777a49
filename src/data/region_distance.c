/* Distances from regions, and the direction of their surfaces. */
#include <math.h>

#include "data/region.h"

bool region_has_endless_box(const struct region *r, int dim)
{
    bool endless = false;
    for (int k = 0; k < r->n; k++) {
        const struct solid *s = &r->solid[k];
        for (int d = 0; d < dim && s->kind == SOLID_BOX; d++) endless |= !isfinite(s->from[d]) || !isfinite(s->to[d]);
        endless |= region_has_endless_box(&s->region, dim);
    }
    return endless;
}

real region_distance(const struct region *r, const real *X, int dim, real *normal)
{
    real nearest = r->n > 0 && r->solid[0].intersect ? -INFINITY : INFINITY, own[DIM_MAX];
    for (int d = 0; d < dim; d++) normal[d] = d == 0;
    for (int k = 0; k < r->n; k++) {
        const struct solid *s = &r->solid[k];
        const real distance = solid_distance(s, X, dim, own) * (s->subtract ? -1 : 1);
        if (s->subtract || s->intersect ? distance <= nearest : distance >= nearest) continue;
        nearest = distance;
        for (int d = 0; d < dim; d++) normal[d] = s->subtract ? -own[d] : own[d];
    }
    return nearest;
}
