/* What rigid bodies cannot do: stand in other bodies, cross a mirror, outrun their contact, meet each other. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "rigid/rigid_part.h"
#include "run/say.h"

#define DEEP_MOST 0.6 /* of a particle's centre in a rigid body at the start [spacings] */
#define WAY_MOST 0.5  /* in a step [spacings]: contact pushes over one */

/* REFUSED where a rigid body holds particles. */
static status check_room(const struct run *e, int k)
{
    const struct rigid_body *r = &e->rigid->body[k];
    const struct particles *p = &e->part;
    real deepest = 0, normal[DIM_MAX], x[DIM_MAX] = {0};
    int64_t at = -1;
    for (int64_t i = 0; i < p->n; i++) {
        for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i];
        const real distance = rigid_distance(r, x, normal);
        if (distance < deepest) deepest = distance, at = i;
    }
    if (!(deepest < -DEEP_MOST * e->scene->spacing)) return OK;
    return status_set(REFUSED, "rigid body %s overlaps body %s: a particle at (%.6g, %.6g, %.6g) m is %.3g m inside it",
                      r->name, e->scene->body[p->body[at]].name, p->x[0][at], p->dim > 1 ? p->x[1][at] : 0,
                      p->dim > 2 ? p->x[2][at] : 0, -deepest);
}

/* REFUSED where the image of a body that flies would be another one. */
static status check_mirrors(const struct rigid_set *rigid, const struct scene *s, int k)
{
    const struct rigid_body *r = &rigid->body[k];
    real from[DIM_MAX], to[DIM_MAX];
    if (r->motion != RIGID_FREE || !region_bounds(r->shape, s->dim, from, to)) return OK;
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *mirror = &s->boundary[b];
        const real at = mirror->at, gap = s->spacing;
        if (mirror->kind != BOUNDARY_MIRROR || from[mirror->axis] > at + gap || to[mirror->axis] < at - gap) continue;
        return status_set(REFUSED,
                          "rigid body %s flies (it has a mass), and mirrors do not act on it: it may not touch that of "
                          "boundary %s; the scene without the mirror is expected",
                          r->name, mirror->name);
    }
    return OK;
}

status rigids_check(const struct run *e)
{
    for (int k = 0; k < e->scene->rigids; k++) {
        const char *place = e->scene->body[e->scene->bodies + k].place;
        TRY(status_at(place, check_room(e, k)));
        TRY(status_at(place, check_mirrors(e->rigid, e->scene, k)));
    }
    return OK;
}

/* FAILED for a body that would pass through particles between two steps. */
status rigids_speed_check(const struct run *e)
{
    for (int k = 0; k < e->scene->rigids; k++) {
        const struct rigid_body *r = &e->rigid->body[k];
        const real turning = sqrt(dot(r->spin, r->spin, DIM_MAX)) * r->radius;
        const real way = (sqrt(dot(r->v, r->v, DIM_MAX)) + turning) * e->clock.dt / e->scene->spacing;
        if (way <= WAY_MOST) continue;
        return status_set(FAILED,
                          "rigid body %s at step %lld, t = %.3g s: it moves %.3g spacings a step, and particles would "
                          "be inside it before they feel it; see whether its speed and mass are meant, or choose a "
                          "smaller time.safety (now %.2g)",
                          r->name, (long long)e->clock.step, e->clock.t, way, e->scene->safety);
    }
    return OK;
}

/* Is a point of a lattice in r, a spacing inside it, also inside the other? */
static bool have_met(const struct scene *scene, const struct particles *part, const struct rigid_body *r,
                     const struct rigid_body *other)
{
    real from[DIM_MAX], to[DIM_MAX], x[DIM_MAX] = {0}, normal[DIM_MAX];
    const real spacing = scene->spacing;
    const int dim = part->dim;
    int64_t n[DIM_MAX] = {1, 1, 1};
    memcpy(x, r->x, sizeof x);
    if (!region_bounds(r->shape, dim, from, to) || rigid_distance(other, x, normal) > r->radius) return false;
    real step = spacing;
    for (int d = 0; d < dim; d++) step = real_max(step, (to[d] - from[d]) / 40);
    for (int d = 0; d < dim; d++) n[d] = (int64_t)((to[d] - from[d]) / step) + 1;
    for (int64_t k = 0; k < n[0] * n[1] * n[2]; k++) {
        const int64_t at[] = {k % n[0], k / n[0] % n[1], k / n[0] / n[1]};
        real X[DIM_MAX] = {0};
        for (int d = 0; d < dim; d++)
            X[d] = from[d] + 0.5 * (to[d] - from[d] - (real)(n[d] - 1) * step) + (real)at[d] * step;
        if (!region_contains(r->shape, X, dim, 0)) continue;
        rigid_place(r, X, x);
        if (rigid_distance(other, x, normal) < -0.5 * spacing) return true;
    }
    return false;
}

/* Says once that two of them, one of which flies, are inside each other. */
void rigids_meet(struct run *e)
{
    for (int a = 0; a < e->scene->rigids && !e->rigid->met; a++)
        for (int b = 0; b < e->scene->rigids && !e->rigid->met; b++) {
            char text[320];
            if (a == b || e->rigid->body[a].motion != RIGID_FREE ||
                !have_met(e->scene, &e->part, &e->rigid->body[a], &e->rigid->body[b]))
                continue;
            snprintf(text, sizeof text,
                     "rigid bodies %.60s and %.60s are inside each other at t = %.3g s: they meet particles, not each "
                     "other",
                     e->rigid->body[a].name, e->rigid->body[b].name, e->clock.t);
            warnings_say(&e->warnings, text);
            e->rigid->met = true;
        }
}
