/* Tips of cracks that are led in load steps: where they are, what loads them, where they go.
 *
 * A tip goes in the direction of the largest hoop stress of its stress-intensity factors (crack_direction). They are
 * fitted in a frame that follows the heading over a smoothing length: a tip that turns at once, and is measured in its
 * new frame round a ring that its kink has not crossed, would swing (fracture/growth.h). Where a pre-crack kinks, the
 * crack goes straight on until the ring sees no more than the kink. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "engine_statics.h"
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

/* ---- tips -------------------------------------------------------------------------------------------------------- */

static real led_distance(const real *a, const real *b) { return hypot(a[0] - b[0], a[1] - b[1]); }

/* Does a pre-crack begin here? */
static bool crack_begins(const struct scene *s, const real *X)
{
    for (int k = 0; k < s->cracks; k++)
        if (led_distance(s->crack[k].corner[0], X) <= ON_SURFACE * s->spacing) return true;
    return false;
}

/* Length of the longest pre-crack that ends here [m]. */
static real length_behind(const struct scene *s, const real *X)
{
    real length = 0;
    for (int k = 0; k < s->cracks; k++)
        for (int end = 0; end < 2; end++)
            if (led_distance(s->crack[k].corner[end], X) <= ON_SURFACE * s->spacing)
                length = real_max(length, led_distance(s->crack[k].corner[0], s->crack[k].corner[1]));
    return length;
}

static void led_start(struct engine *e)
{
    struct led *l = &e->statics.led;
    const struct tips *t = &e->fracture.tips;
    l->known = true;
    for (int k = 0; k < t->n; k++) {
        const struct tip *from = &t->tip[k];
        if (!from->from_crack) continue;
        struct led_tip *tip = &l->tip[l->n++];
        *tip = (struct led_tip){.sees = length_behind(e->scene, from->origin), .body = from->body};
        for (int d = 0; d < 2; d++) {
            tip->start[d] = tip->place[d] = from->origin[d];
            tip->along[d] = tip->heading[d] = tip->last[d] = from->along[d];
        }
        tip->reversed = crack_begins(e->scene, from->origin);
    }
}

bool led_leads(struct engine *e)
{
    struct led *l = &e->statics.led;
    const struct scene *s = e->scene;
    const bool one = s->bodies == 1 && s->materials == 1;    /* hoop stress knows no toughness */
    if (s->steps.path == PATH_BONDS || s->dim != 2 || (s->steps.path == PATH_AUTO && !one)) return false;
    if (!l->known) led_start(e);
    for (int k = 0; k < l->n; k++)
        if (!l->tip[k].ended) return true;
    return false;
}

/* ---- factors ----------------------------------------------------------------------------------------------------- */

static const struct material *material_at(const struct engine *e, const struct led_tip *tip)
{
    const struct particles *p = &e->part;
    int64_t nearest = 0;
    real least = INFINITY;
    for (int64_t i = 0; i < p->n; i++) {
        const real r =
            p->body[i] == tip->body ? hypot(p->X[0][i] - tip->place[0], p->X[1][i] - tip->place[1]) : INFINITY;
        if (r < least) least = r, nearest = i;
    }
    return &e->scene->material[p->material[nearest]];
}

/* Is the tip on a plane of symmetry, and goes along it? */
static bool on_mirror(const struct engine *e, const struct led_tip *tip)
{
    for (int k = 0; k < e->source.mirrors; k++) {
        const struct mirror_plane *m = &e->source.mirror[k];
        if (fabs(tip->place[m->axis] - m->at) <= AHEAD * e->scene->spacing && fabs(tip->last[m->axis]) <= AHEAD)
            return true;
    }
    return false;
}

/* Pre-cracks, and what tips have cut; the caller frees the list. */
static struct crack *cracks_now(const struct engine *e, int *n)
{
    const struct led *l = &e->statics.led;
    const struct crack_list *before = &e->tables.cracks;
    struct crack *crack = NEW("led.cracks", before->n + l->stretches, struct crack);
    for (int k = 0; k < before->n; k++) crack[k] = before->crack[k];
    for (int64_t k = 0; k < l->stretches; k++) crack[before->n + k] = (struct crack){.n = 2, .corner = l->path[k].at};
    *n = before->n + (int)l->stretches;
    return crack;
}

bool led_measure(const struct engine *e, const struct led_tip *tip, real K[MODES])
{
    const real h = e->scene->spacing, inner = real_max(3 * h, INNER * e->source.family.horizon);
    struct tip_view view = {.medium = crack_medium_of(material_at(e, tip), e->scene->space),
                            .inner = inner,
                            .outer = inner + WIDTH * h,
                            .body = tip->body};
    for (int d = 0; d < 2; d++)
        view.place[d] = tip->place[d], view.along[d] = tip->along[d], view.last[d] = tip->last[d];
    view.outer = real_min(view.outer, real_max(tip->sees, LEAST * h));
    struct crack *crack = cracks_now(e, &view.cracks);
    view.crack = crack;
    const bool seen = tip_fit(&view, &e->part, K);
    memory_free(crack);
    if (on_mirror(e, tip)) K[MODE_II] = 0;
    return seen;
}

void led_turn(const struct engine *e, struct led_tip *tip)
{
    if (tip->hold > AHEAD * e->scene->spacing || !led_measure(e, tip, tip->K)) {
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

void led_factors(struct engine *e, real K[MODES])
{
    const struct led_tip *first = led_leads(e) ? tip_farthest(&e->statics.led, true) : NULL;
    K[MODE_I] = K[MODE_II] = NAN;
    if (first) led_measure(e, first, K);
}

void led_place(const struct engine *e, real place[2])
{
    const struct led_tip *first = tip_farthest(&e->statics.led, false);
    for (int d = 0; d < 2; d++) place[d] = first ? first->place[d] : NAN;
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

void led_next_place(const struct engine *e, const struct led_tip *tip, real place[2])
{
    const struct scene *s = e->scene;
    const real h = s->spacing, width = scene_section(s);
    const real way =
        s->steps.energy > 0 ? s->steps.energy / (toughness_of(e, material_at(e, tip)) * width) : ADVANCE_SPACINGS * h;
    real from[2], to[2], share = 1;
    int cracks;
    struct crack *crack = cracks_now(e, &cracks);
    for (int d = 0; d < 2; d++) {
        from[d] = tip->place[d] + AHEAD * h * tip->heading[d], to[d] = tip->place[d] + way * tip->heading[d];
    }
    for (int k = 0; k < cracks; k++)
        if (!ends_here(&crack[k], tip, AHEAD * h)) share = real_min(share, meeting_share(&crack[k], from, to));
    for (int d = 0; d < 2; d++) place[d] = share < 1 ? from[d] + share * (to[d] - from[d]) : to[d];
    memory_free(crack);
}

/* Area of the next stretch: half of it belongs to a body that ends at a plane of symmetry there [m^2]. */
real led_area(const struct engine *e, const struct led_tip *tip)
{
    real to[2];
    led_next_place(e, tip, to);
    return led_distance(to, tip->place) * scene_section(e->scene) * (on_mirror(e, tip) ? 0.5 : 1);
}

real led_toughness(const struct engine *e, const struct led_tip *tip) { return toughness_of(e, material_at(e, tip)); }

/* Can the crack go on? */
static bool body_is_ahead(const struct engine *e, const struct led_tip *tip)
{
    const struct particles *p = &e->part;
    const real h = e->scene->spacing,
               ahead[2] = {tip->place[0] + h * tip->heading[0], tip->place[1] + h * tip->heading[1]};
    int free_ones = 0;
    for (int64_t i = 0; i < p->n_all; i++) {
        const real X[2] = {p->X[0][i], p->X[1][i]};
        free_ones += p->body[i] == tip->body && !(p->flag[i] & FLAG_DRIVEN) && led_distance(X, ahead) <= REACH * h;
    }
    return free_ones >= 2;
}

static void led_path_add(struct led *l, int k, const real *to)
{
    if (l->stretches == l->room) {
        const int64_t larger = l->room ? 2 * l->room : 64;
        l->path = memory_resize("led.path", l->path, l->room, larger, sizeof *l->path);
        l->room = larger;
    }
    struct led_stretch *s = &l->path[l->stretches++];
    const struct led_tip *tip = &l->tip[k];
    *s = (struct led_stretch){.tip = k};
    for (int d = 0; d < 2; d++) s->at[tip->reversed][d] = tip->place[d], s->at[!tip->reversed][d] = to[d];
}

/* The frame follows the heading; at a kink it is the heading. */
static void frame_follow(struct led_tip *tip, real way, real h)
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

void led_move(struct engine *e, int k)
{
    struct led_tip *tip = &e->statics.led.tip[k];
    const real h = e->scene->spacing;
    real to[2];
    led_next_place(e, tip, to);
    const real way = led_distance(to, tip->place);
    led_path_add(&e->statics.led, k, to);
    frame_follow(tip, way, h);
    for (int d = 0; d < 2; d++) tip->last[d] = tip->heading[d], tip->place[d] = to[d];
    tip->grown += way, tip->sees += way;
    led_next_place(e, tip, to);
    tip->ended = !body_is_ahead(e, tip) || led_distance(to, tip->place) < REST * h;
}

void led_lose(struct engine *e)
{
    for (int k = 0; k < e->statics.led.n; k++) e->statics.led.tip[k].ended = true;
}

/* ---- state ------------------------------------------------------------------------------------------------------- */

void led_free(struct led *l)
{
    memory_free(l->path);
    memset(l, 0, sizeof *l);
}

status led_archive(struct engine *e, struct archive *a)
{
    struct led *l = &e->statics.led;
    ARCHIVE_VALUE(a, "statics/led", l->known);
    ARCHIVE_VALUE(a, "statics/led_n", l->n);
    ARCHIVE_VALUE(a, "statics/led_tips", l->tip);
    ARCHIVE_VALUE(a, "statics/led_tried", l->tried);
    ARCHIVE_VALUE(a, "statics/led_stretches", l->stretches);
    if (!a->saving && l->stretches > 0) {
        memory_free(l->path);
        l->room = l->stretches;
        l->path = NEW("led.path", l->room, struct led_stretch);
    }
    return l->stretches > 0 ? a->exchange(a, "statics/led_path", l->path, (size_t)l->stretches * sizeof *l->path) : OK;
}
