/* Tips of cracks that are led in load steps: where they are, what loads them, where they go.
 *
 * A tip goes in the direction of the largest hoop stress of its stress-intensity factors (crack_direction). They are
 * fitted in a frame that follows the heading over a smoothing length: a tip that turns at once, and is measured in its
 * new frame round a ring that its kink has not crossed, would swing (fracture/growth.h). Where a pre-crack kinks, the
 * crack goes straight on until the ring sees no more than the kink. */
#include <math.h>
#include <string.h>

#include "led.h"
#include "toughness.h"

#include "base/memory.h"
#include "fracture/tip_fit.h"

#define INNER 1.0     /* of the ring of the fit [horizons] */
#define WIDTH 7.0     /* of the ring [spacings] */
#define SMOOTHING 2.0 /* of the frame [spacings] */
#define KINK 0.17     /* turn at the end of a pre-crack that is no curve [rad] */
#define HOLD 8.0      /* straight on after it [spacings] */
#define LEAST 6.0     /* outer radius [spacings] */
#define AHEAD 1e-3    /* [spacings] */
#define PARALLEL 1e-6 /* sine of an angle that is none */
#define REST 0.1      /* way to another crack that is none [spacings] */
#define REACH 1.2     /* of the search for a body ahead [spacings] */

enum { ADVANCE_SPACINGS = 2 };

bool led_along_mirror(const struct led_plane *plane, const struct led_tip *tip)
{
    real ahead[2];
    led_ahead(tip->place, plane->spacing, tip->last, ahead);
    return led_on_mirror(plane, tip->place, ahead);
}

/* ---- factors ----------------------------------------------------------------------------------------------------- */

static const struct material *material_at(const struct led *l, const struct particles *p, const struct led_tip *tip)
{
    int64_t nearest = 0;
    real least = INFINITY, X[2];
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] != tip->body) continue;
        led_project_particle(&l->plane, p, i, X);
        if (led_distance(X, tip->place) < least) least = led_distance(X, tip->place), nearest = i;
    }
    return &l->scene->material[p->material[nearest]];
}

/* Pre-cracks, and what tips have cut, in the plane of the tips; cracks_now_free frees the list. */
static struct crack *cracks_now(const struct led *l, int *n)
{
    const int given = l->source->cracks;
    struct crack *crack = NEW("led.cracks", given + l->stretches + 1, struct crack);
    real(*corner)[DIM_MAX] = memory_new("led.corners", 2 * (given + 1), sizeof *corner);
    for (int k = 0; k < given; k++) {
        led_segment(&l->plane, &l->source->crack[k], corner + 2 * k);
        crack[k] = (struct crack){.n = 2, .corner = corner + 2 * k};
    }
    for (int64_t k = 0; k < l->stretches; k++) crack[given + k] = (struct crack){.n = 2, .corner = l->path[k].at};
    *n = given + (int)l->stretches;
    crack[*n].corner = corner;
    return crack;
}

static void cracks_now_free(struct crack *crack, int n)
{
    memory_free(crack[n].corner);
    memory_free(crack);
}

/* The medium round a tip. In space, at a radius of half of the thickness and more, sides have let the stress along the
 * front go (Nakamura & Parks 1988), which a ring's mean radius decides. */
static struct crack_medium medium_at(const struct led *l, const struct particles *p, const struct led_tip *tip,
                                     real radius)
{
    enum space space = l->scene->space;
    if (p->dim == 3) {
        real ahead[2];
        led_ahead(tip->place, l->plane.spacing, tip->last, ahead);
        const bool thin = led_width(&l->plane, p, tip->place, ahead) < 2 * radius;
        space = thin ? SPACE_PLANE_STRESS : SPACE_PLANE_STRAIN;
    }
    return crack_medium_of(material_at(l, p, tip), space);
}

bool led_measure(const struct led *l, const struct particles *p, const struct led_tip *tip, bool closed, real K[MODES])
{
    const real h = l->plane.spacing, inner = real_max(3 * h, INNER * l->source->family.horizon);
    struct tip_view view = {.inner = inner, .outer = inner + WIDTH * h, .body = tip->body};
    for (int d = 0; d < 2; d++)
        view.place[d] = tip->place[d], view.along[d] = tip->along[d], view.last[d] = tip->last[d];
    memcpy(view.axis, l->plane.axis, sizeof view.axis);
    view.outer = real_min(view.outer, real_max(tip->sees, LEAST * h));
    view.medium = medium_at(l, p, tip, 0.5 * (view.inner + view.outer));
    struct crack *crack = cracks_now(l, &view.cracks);
    view.crack = crack;
    const bool seen = tip_fit(&view, p, K);
    cracks_now_free(crack, view.cracks);
    if (led_along_mirror(&l->plane, tip)) K[MODE_II] = 0;
    if (closed) K[MODE_I] = real_max(K[MODE_I], 0); /* the forces between its faces show */
    return seen;
}

void led_turn(const struct led *l, const struct particles *p, bool closed, struct led_tip *tip)
{
    if (tip->hold > AHEAD * l->plane.spacing || !led_measure(l, p, tip, closed, tip->K)) {
        for (int d = 0; d < 2; d++) tip->heading[d] = tip->last[d];
        return;
    }
    const real angle = crack_direction(tip->K), c = cos(angle), s = sin(angle), *a = tip->along;
    tip->heading[0] = c * a[0] - s * a[1], tip->heading[1] = s * a[0] + c * a[1];
}

/* The tip that has gone farthest, among those that go on if `on`; NULL: there is none. */
static const struct led_tip *tip_farthest(const struct led *l, bool on)
{
    const struct led_tip *first = NULL;
    for (int k = 0; k < l->n; k++) {
        const struct led_tip *tip = &l->tip[k];
        if (!(on && tip->ended) && (!first || tip->grown > first->grown * (1 + ON_SURFACE))) first = tip;
    }
    return first;
}

void led_factors(const struct led *l, const struct particles *p, bool closed, real K[MODES])
{
    const struct led_tip *first = tip_farthest(l, true);
    K[MODE_I] = K[MODE_II] = NAN;
    if (first) led_measure(l, p, first, closed, K);
}

void led_place(const struct led *l, real place[DIM_MAX])
{
    const struct led_plane *plane = &l->plane;
    const struct led_tip *first = tip_farthest(l, false);
    for (int d = 0; d < DIM_MAX; d++)
        place[d] = first ? first->place[0] * plane->axis[0][d] + first->place[1] * plane->axis[1][d] +
                               plane->middle * plane->front[d]
                         : NAN;
}

/* ---- the way ahead ----------------------------------------------------------------------------------------------- */

/* Share of the way from a to b at which it meets a crack; 1: it meets none. */
static real meeting_share(const struct crack *c, const real *a, const real *b)
{
    const real *p = c->corner[0], *q = c->corner[1];
    const real way[2] = {b[0] - a[0], b[1] - a[1]}, wall[2] = {q[0] - p[0], q[1] - p[1]};
    const real across = way[0] * wall[1] - way[1] * wall[0], gap[2] = {p[0] - a[0], p[1] - a[1]};
    const bool parallel = fabs(across) <= PARALLEL * hypot(way[0], way[1]) * hypot(wall[0], wall[1]);
    const real share = (gap[0] * wall[1] - gap[1] * wall[0]) / across,
               at = (gap[0] * way[1] - gap[1] * way[0]) / across;
    return !parallel && share >= 0 && share < 1 && at >= 0 && at <= 1 ? share : 1;
}

/* Does a crack end at the tip, as its own last stretch does? */
static bool ends_here(const struct crack *c, const struct led_tip *tip, real within)
{
    return led_distance(c->corner[0], tip->place) <= within || led_distance(c->corner[1], tip->place) <= within;
}

void led_next_place(const struct led *l, const struct particles *p, const struct led_tip *tip, real place[2])
{
    const real h = l->plane.spacing, energy = l->scene->steps.energy;
    real from[2], to[2], way = ADVANCE_SPACINGS * h, share = 1;
    int cracks;
    led_ahead(tip->place, AHEAD * h, tip->heading, from);
    led_ahead(tip->place, h, tip->heading, to);
    if (energy > 0) way = energy / (led_toughness(l, p, tip) * real_max(h, led_width(&l->plane, p, tip->place, to)));
    struct crack *crack = cracks_now(l, &cracks);
    led_ahead(tip->place, way, tip->heading, to);
    for (int k = 0; k < cracks; k++)
        if (!ends_here(&crack[k], tip, AHEAD * h)) share = real_min(share, meeting_share(&crack[k], from, to));
    for (int d = 0; d < 2; d++) place[d] = share < 1 ? from[d] + share * (to[d] - from[d]) : to[d];
    cracks_now_free(crack, cracks);
}

real led_toughness(const struct led *l, const struct particles *p, const struct led_tip *tip)
{
    return toughness_of(&l->source->family, l->scene->model, material_at(l, p, tip));
}

/* Can the crack go on? */
static bool body_is_ahead(const struct led *l, const struct particles *p, const struct led_tip *tip)
{
    const real h = l->plane.spacing;
    real ahead[2];
    led_ahead(tip->place, h, tip->heading, ahead);
    const real wide = p->dim == 2 ? 1 : led_width(&l->plane, p, tip->place, ahead) / h;
    int free_ones = 0;
    for (int64_t i = 0; i < p->n_all; i++) {
        real X[2];
        led_project_particle(&l->plane, p, i, X);
        free_ones += p->body[i] == tip->body && !(p->flag[i] & FLAG_DRIVEN) && led_distance(X, ahead) <= REACH * h;
    }
    return wide > 0 && free_ones >= 2 * floor(wide);
}

static void led_path_add(struct led *l, int k, const real *to)
{
    GROW("led.path", l->path, l->stretches + 1);
    struct led_stretch *s = &l->path[l->stretches++];
    const struct led_tip *tip = &l->tip[k];
    *s = (struct led_stretch){.tip = k};
    for (int d = 0; d < 2; d++) s->at[tip->reversed][d] = tip->place[d], s->at[!tip->reversed][d] = to[d];
}

/* The frame follows the heading; at a kink it is the heading. */
static void turned_frame(struct led_tip *tip, real way, real h)
{
    const real *a = tip->last, *b = tip->heading, share = -expm1(-way / (SMOOTHING * h));
    const bool kink = tip->grown == 0 && fabs(atan2(a[0] * b[1] - a[1] * b[0], dot(a, b, 2))) > KINK;
    if (kink) tip->hold = HOLD * h, tip->sees = 0;
    const bool straight = tip->hold > 0;
    for (int d = 0; d < 2; d++) tip->along[d] += (straight ? 1 : share) * (b[d] - tip->along[d]);
    const real length = hypot(tip->along[0], tip->along[1]);
    for (int d = 0; d < 2; d++) tip->along[d] /= length;
    tip->hold = real_max(0, tip->hold - way);
}

void led_move(struct led *l, const struct particles *p, int k)
{
    struct led_tip *tip = &l->tip[k];
    const real h = l->plane.spacing;
    real to[2];
    led_next_place(l, p, tip, to);
    const real way = led_distance(to, tip->place);
    led_path_add(l, k, to);
    turned_frame(tip, way, h);
    for (int d = 0; d < 2; d++) tip->last[d] = tip->heading[d], tip->place[d] = to[d];
    tip->grown += way, tip->sees += way;
    led_next_place(l, p, tip, to);
    tip->ended = !body_is_ahead(l, p, tip) || led_distance(to, tip->place) < REST * h;
}

void led_lose(struct led *l)
{
    for (int k = 0; k < l->n; k++) l->tip[k].ended = true;
}

void led_free(struct led *l)
{
    memory_free(l->path);
    memset(l, 0, sizeof *l);
}
