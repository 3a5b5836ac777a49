/* The plane in which cracks are led: that of a plane body, or in space the one across their fronts.
 *
 * In space a front is led as a whole: straight, through the body, with the factors of its mean. That is what specimens
 * of constant section and cracks through plates are; mode III, and what sides do to a front, are left out. Everything
 * then happens in the plane across the front, onto which particles are projected; what cuts a bond there cuts it in
 * space, and lengths become areas by the width of the body along the front. */
#include <math.h>

#include "led.h"

#include "base/memory.h"

#define STRAIGHT 1e-6  /* sine of an angle that is none */
#define NUDGE 1e-6     /* by which places between particles belong to one of them [spacings] */
#define ON_MIRROR 1e-3 /* [spacings] */
#define RAGGED 1e-3    /* ends of a pre-crack that are no line along its front [spacings] */
enum { SAMPLES = 16 }; /* of the width along a stretch */

/* ---- axes -------------------------------------------------------------------------------------------------------- */

static void make_unit(real *a)
{
    const real length = sqrt(dot(a, a, 3));
    for (int d = 0; d < 3; d++) a[d] /= length;
}

/* Axes of space where they lie across the front, so that planes of symmetry do. */
static void axes_make(struct led_plane *plane)
{
    real *f = plane->front;
    int most = 0, least = 0;
    for (int d = 1; d < 3; d++) {
        if (fabs(f[d]) > fabs(f[most])) most = d;
        if (fabs(f[d]) < fabs(f[least])) least = d;
    }
    const bool along_axis = fabs(f[(most + 1) % 3]) < STRAIGHT && fabs(f[(most + 2) % 3]) < STRAIGHT;
    for (int d = 0; d < 3 && along_axis; d++) f[d] = d == most;
    if (along_axis) least = (most + 1) % 3;
    if (!along_axis && fabs(f[least]) < STRAIGHT) f[least] = 0, make_unit(f);
    for (int d = 0; d < 3; d++) plane->axis[0][d] = (d == least) - f[least] * f[d];
    make_unit(plane->axis[0]);
    vector_product(f, plane->axis[0], plane->axis[1]);
}

void led_project(const struct led_plane *plane, const real *X, real to[2])
{
    for (int a = 0; a < 2; a++) to[a] = dot(plane->axis[a], X, plane->dim);
}

void led_project_particle(const struct led_plane *plane, const struct particles *p, int64_t i, real to[2])
{
    real X[DIM_MAX] = {0};
    particle_place(p, i, X);
    led_project(plane, X, to);
}

/* ---- what has to be so in space ---------------------------------------------------------------------------------- */

static const char *front_find(const struct tips *t, struct led_plane *plane)
{
    bool found = false;
    for (int k = 0; k < t->n; k++) {
        real along[DIM_MAX], turn[DIM_MAX];
        if (!t->tip[k].from_crack) continue;
        memcpy(along, t->tip[k].edge, sizeof along);
        make_unit(along);
        if (!found) memcpy(plane->front, along, sizeof along);
        vector_product(along, plane->front, turn);
        if (dot(turn, turn, 3) > square(STRAIGHT)) return "fronts are not parallel";
        found = true;
    }
    return found ? NULL : "no pre-crack ends in the body";
}

static void front_middle(const struct tips *t, struct led_plane *plane)
{
    for (int k = t->n - 1; k >= 0; k--)
        if (t->tip[k].from_crack) plane->middle = dot(plane->front, t->tip[k].origin, 3);
}

/* A plane of symmetry lies along the fronts, or across them. */
static const char *mirrors_find(struct led_plane *plane)
{
    for (int k = 0; k < plane->body_mirrors; k++) {
        struct mirror_plane m = plane->body_mirror[k];
        const int axis = m.axis;
        if (plane->dim == 3 && fabs(plane->front[axis]) > 1 - STRAIGHT) continue;
        for (m.axis = 0; m.axis < 2 && fabs(plane->axis[m.axis][axis]) < 1 - STRAIGHT;) m.axis++;
        if (m.axis == 2 || plane->mirrors == 2 * DIM_MAX) return "a plane of symmetry is oblique to them";
        if (plane->axis[m.axis][axis] < 0) m.at = -m.at, m.outside = -m.outside;
        plane->mirror[plane->mirrors++] = m;
    }
    return NULL;
}

/* In space the segment has its normal on the side of the polygon's. */
bool led_segment(const struct led_plane *plane, const struct crack *c, real at[2][DIM_MAX])
{
    real area[DIM_MAX], across[2], least = INFINITY, most = -INFINITY;
    if (plane->dim == 2) return memcpy(at, c->corner, 2 * sizeof *at), true;
    crack_area_vector(c, area);
    led_project(plane, area, across);
    const real size = hypot(across[0], across[1]), along[2] = {across[1] / size, -across[0] / size};
    for (int k = 0; k < c->n; k++) {
        real P[2];
        led_project(plane, c->corner[k], P);
        const real s = dot(along, P, 2);
        for (int d = 0; d < 2 && s < least; d++) at[0][d] = P[d];
        for (int d = 0; d < 2 && s > most; d++) at[1][d] = P[d];
        least = real_min(least, s), most = real_max(most, s);
    }
    at[0][2] = at[1][2] = 0;
    return fabs(dot(area, plane->front, 3)) <= STRAIGHT * size;
}

static const char *cracks_check(const struct crack_list *l, const struct led_plane *plane)
{
    for (int k = 0; k < l->n; k++) {
        real at[2][DIM_MAX] = {{0}};
        if (!led_segment(plane, &l->crack[k], at)) return "a pre-crack does not lie along them";
        for (int c = 0; c < l->crack[k].n; c++) {
            real P[2];
            led_project(plane, l->crack[k].corner[c], P);
            const real off = real_min(hypot(P[0] - at[0][0], P[1] - at[0][1]), hypot(P[0] - at[1][0], P[1] - at[1][1]));
            if (off > RAGGED * plane->spacing) return "a pre-crack is no rectangle along them";
        }
    }
    return NULL;
}

/* Fronts end where the body does. */
static const char *fronts_check(const struct tips *t, const struct particles *p, const struct led_plane *plane)
{
    const real h = plane->spacing;
    for (int k = 0; k < t->n; k++) {
        real at[2][2], along[2];
        if (!t->tip[k].from_crack) continue;
        led_project(plane, t->tip[k].origin, at[0]);
        led_project(plane, t->tip[k].along, along);
        led_ahead(at[0], h, along, at[1]);
        const real width = led_width(plane, p, at[0], at[1]);
        if (width > 2 * sqrt(dot(t->tip[k].edge, t->tip[k].edge, 3)) + h) return "a front ends within the body";
    }
    return NULL;
}

const char *led_plane_find(struct led_plane *plane, const struct tips *t, const struct crack_list *cracks,
                           const struct particles *p)
{
    const char *fault = NULL;
    if (plane->dim == 2) {
        plane->axis[0][0] = plane->axis[1][1] = 1;
        return mirrors_find(plane);
    }
    if (plane->dim != 3) return "a line has no crack tips";
    fault = front_find(t, plane);
    if (!fault) axes_make(plane), front_middle(t, plane), fault = mirrors_find(plane);
    if (!fault) fault = cracks_check(cracks, plane);
    return fault ? fault : fronts_check(t, p, plane);
}

/* ---- areas ------------------------------------------------------------------------------------------------------- */

/* Is a particle on a plane of symmetry along the front, so that half of it belongs to the body? */
static real share_beside_mirrors(const struct led_plane *plane, const struct particles *p, int64_t i)
{
    real share = 1;
    for (int k = 0; k < plane->body_mirrors; k++) {
        const struct mirror_plane *m = &plane->body_mirror[k];
        const bool across = fabs(plane->front[m->axis]) > 1 - STRAIGHT;
        if (across && fabs(p->X[m->axis][i] - m->at) <= ON_SURFACE * plane->spacing) share *= 0.5;
    }
    return share;
}

/* Length within the box of a particle of the line along the front through P [m]. */
static real chord(const struct led_plane *plane, const struct particles *p, int64_t i, const real *P)
{
    const real half = 0.5 * cbrt(p->volume0[i]);
    real low = -INFINITY, high = INFINITY;
    for (int d = 0; d < 3; d++) {
        const real place = P[0] * plane->axis[0][d] + P[1] * plane->axis[1][d] + NUDGE * plane->spacing;
        const real from = p->X[d][i] - half - place, to = p->X[d][i] + half - place, f = plane->front[d];
        if (fabs(f) < STRAIGHT) {
            if (from > 0 || to <= 0) return 0;
        } else {
            low = real_max(low, real_min(from / f, to / f)), high = real_min(high, real_max(from / f, to / f));
        }
    }
    return real_max(0, high - low);
}

real led_width(const struct led_plane *plane, const struct particles *p, const real *from, const real *to)
{
    const real a[DIM_MAX] = {from[0], from[1]}, b[DIM_MAX] = {to[0], to[1]};
    real sum = 0;
    if (plane->dim == 2) return plane->section;
    for (int64_t i = 0; i < p->n; i++) {
        const real place[DIM_MAX] = {p->X[0][i], p->X[1][i], p->X[2][i]};
        real X[2];
        led_project(plane, place, X);
        if (segment_distance(a, b, X, 2) > cbrt(p->volume0[i])) continue;
        const real share = share_beside_mirrors(plane, p, i);
        for (int k = 0; k < SAMPLES; k++) {
            const real at = (k + 0.5) / SAMPLES, P[2] = {a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1])};
            sum += share * chord(plane, p, i, P);
        }
    }
    return sum / SAMPLES;
}

bool led_on_mirror(const struct led_plane *plane, const real *from, const real *to)
{
    bool on = false;
    for (int k = 0; k < plane->mirrors; k++) {
        const struct mirror_plane *m = &plane->mirror[k];
        const real tolerance = ON_MIRROR * plane->spacing;
        on |= fabs(from[m->axis] - m->at) <= tolerance && fabs(to[m->axis] - m->at) <= tolerance;
    }
    return on;
}

real led_face_area(const struct led_plane *plane, const struct particles *p, const real *from, const real *to)
{
    const real length = hypot(to[0] - from[0], to[1] - from[1]);
    return length * led_width(plane, p, from, to) * (led_on_mirror(plane, from, to) ? 0.5 : 1);
}
