/* Checks rigid bodies: overlaps with particles and planes of symmetry at the start, motion that is too large for one
 * step, and overlaps with each other. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "rigid/rigid_part.h"
#include "run/say.h"

#define DEEP_MOST 0.6      /* allowed depth of the centre of a particle in a rigid body at the start [spacings] */
#define INCREMENT_MOST 0.5 /* allowed motion in a step [spacings]: contact acts over a distance of one spacing */

/* Returns REFUSED, with a message, if at the start the centre of a particle of p is deeper than DEEP_MOST spacings
 * inside rigid body r, else OK. s: scene, with spacing and names. */
static status check_room(const struct rigid_body *r, const struct scene *s, const struct particles *p)
{
    real deepest = 0, normal[DIM_MAX], x[DIM_MAX] = {0};
    int64_t at = -1;
    for (int64_t i = 0; i < p->n; i++) {
        for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i];
        const real distance = rigid_signed_distance(r, x, normal);
        if (distance < deepest) deepest = distance, at = i;
    }
    if (!(deepest < -DEEP_MOST * s->spacing)) return OK;
    return status_set(REFUSED,
                      "rigid body %s overlaps body %s: its particle at (%.6g, %.6g, %.6g) m is %.3g m inside the rigid "
                      "body; move one of the two",
                      r->name, s->body[p->body[at]].name, p->x[0][at], p->dim > 1 ? p->x[1][at] : 0,
                      p->dim > 2 ? p->x[2][at] : 0, -deepest);
}

/* Returns REFUSED, with a message, if r is a free body and the bounding box of its shape is at most a spacing from a
 * mirror (plane of symmetry) of scene s: its mirror image would be another body. Returns OK otherwise. */
static status check_mirrors(const struct rigid_body *r, const struct scene *s)
{
    real from[DIM_MAX], to[DIM_MAX];
    if (r->motion != RIGID_FREE || !region_compute_bounding_box_if_finite(r->shape, s->dim, from, to)) return OK;
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *mirror = &s->boundary[b];
        const real at = mirror->at, gap = s->spacing;
        if (mirror->kind != BOUNDARY_MIRROR || from[mirror->axis] > at + gap || to[mirror->axis] < at - gap) continue;
        return status_set(REFUSED,
                          "rigid body %s moves freely (it has a mass), but mirrors do not act on such bodies, so it "
                          "must not touch the mirror of boundary %s; remove the mirror or the mass",
                          r->name, mirror->name);
    }
    return OK;
}

status rigids_check_no_overlap_at_start(const struct rigid_set *rigid, const struct scene *s, const struct particles *p)
{
    for (int k = 0; k < rigid->n; k++) {
        const char *place = s->body[s->bodies + k].place;
        TRY(status_message_prepend_location(place, check_room(&rigid->body[k], s, p)));
        TRY(status_message_prepend_location(place, check_mirrors(&rigid->body[k], s)));
    }
    return OK;
}

status rigids_check_motion_per_step_is_small(const struct rigid_set *rigid, const struct scene *s,
                                             const struct run_clock *clock)
{
    for (int k = 0; k < rigid->n; k++) {
        const struct rigid_body *r = &rigid->body[k];
        const real turning = sqrt(dot(r->spin, r->spin, DIM_MAX)) * r->radius;
        const real increment = (sqrt(dot(r->v, r->v, DIM_MAX)) + turning) * clock->dt / s->spacing;
        if (increment <= INCREMENT_MOST) continue;
        return status_set(
            FAILED,
            "rigid body %s at step %lld, t = %.3g s: it moves %.3g spacings per step, so particles would be inside it "
            "before contact acts: check its speed and mass, or use a smaller time.safety (now %.2g)",
            r->name, (long long)clock->step, clock->t, increment, s->safety);
    }
    return OK;
}

/* Returns true if two rigid bodies overlap: a sampling point inside r is more than half a spacing deep inside `other`.
 * spacing: spacing of the lattice of particles [m]. */
static bool have_met(const struct rigid_body *r, const struct rigid_body *other, real spacing)
{
    real from[DIM_MAX], to[DIM_MAX], x[DIM_MAX] = {0}, normal[DIM_MAX];
    const int dim = r->dim;
    int64_t n[DIM_MAX] = {1, 1, 1};
    memcpy(x, r->x, sizeof x);
    if (!region_compute_bounding_box_if_finite(r->shape, dim, from, to) ||
        rigid_signed_distance(other, x, normal) > r->radius)
        return false;
    real step = spacing;
    for (int d = 0; d < dim; d++) step = real_max(step, (to[d] - from[d]) / 40);
    for (int d = 0; d < dim; d++) n[d] = (int64_t)((to[d] - from[d]) / step) + 1;
    for (int64_t k = 0; k < n[0] * n[1] * n[2]; k++) {
        const int64_t at[] = {k % n[0], k / n[0] % n[1], k / n[0] / n[1]};
        real X[DIM_MAX] = {0};
        for (int d = 0; d < dim; d++)
            X[d] = from[d] + 0.5 * (to[d] - from[d] - (real)(n[d] - 1) * step) + (real)at[d] * step;
        if (!region_contains(r->shape, X, dim, 0)) continue;
        rigid_compute_current_position_of_point(r, X, x);
        if (rigid_signed_distance(other, x, normal) < -0.5 * spacing) return true;
    }
    return false;
}

void rigids_warn_of_overlap(struct rigid_set *rigid, real spacing, real t, struct warnings *warning_list)
{
    for (int a = 0; a < rigid->n && !rigid->met; a++)
        for (int b = 0; b < rigid->n && !rigid->met; b++) {
            const struct rigid_body *one = &rigid->body[a], *other = &rigid->body[b];
            char text[320];
            if (a == b || one->motion != RIGID_FREE || !have_met(one, other, spacing)) continue;
            snprintf(text, sizeof text,
                     "rigid bodies %.60s and %.60s overlap at t = %.3g s, because they push particles but not each "
                     "other: change their motion, or make one of them a body of particles",
                     one->name, other->name, t);
            warnings_add_and_print(warning_list, text);
            rigid->met = true;
        }
}
