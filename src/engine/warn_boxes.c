/* Computes boxes of bodies and cracks, and particle counts along their edges, for warnings. */
#include <math.h>

#include "engine_internal.h"

bool crack_overlaps_box(const struct crack *c, const real *box_low, const real *box_high, int dim, real margin)
{
    bool meets = true;
    for (int d = 0; d < dim; d++) {
        real from = INFINITY, to = -INFINITY;
        for (int k = 0; k < c->n; k++) from = real_min(from, c->corner[k][d]), to = real_max(to, c->corner[k][d]);
        meets = meets && from <= box_high[d] + margin && to >= box_low[d] - margin;
    }
    return meets;
}

real scene_particle_count_along_axis_with_mirrors(const struct scene *s, real low, real high, int axis)
{
    real n = round((high - low) / s->spacing) + 1;
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].kind == BOUNDARY_MIRROR && s->boundary[b].axis == axis) n *= 2;
    return n;
}

bool joined_bodies_compute_bounding_box(const struct scene *s, const struct particles *p, int body_number,
                                        real *box_low, real *box_high)
{
    for (int d = 0; d < s->dim; d++) {
        box_low[d] = INFINITY, box_high[d] = -INFINITY;
        for (int64_t i = 0; i < p->n; i++) {
            if (s->body[p->body[i]].joined != body_number) continue;
            box_low[d] = real_min(box_low[d], p->X[d][i]), box_high[d] = real_max(box_high[d], p->X[d][i]);
        }
    }
    return box_high[0] >= box_low[0];
}
