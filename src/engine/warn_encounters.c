/* Warns of bodies that fly from the start, and that meet no other body before the end of the run. */
#include <math.h>

#include "base/memory.h"
#include "engine_internal.h"

#define TOUCHING 0.01      /* largest overlap of bodies that touch [spacings] */
enum { FLYING_MOST = 64 }; /* largest number of bodies that are compared in pairs */

/* Bounding box of a body, and range of its velocities at the start. */
struct flight {
    real low[DIM_MAX], high[DIM_MAX];        /* lower and upper corner of the box [m] */
    real slowest[DIM_MAX], fastest[DIM_MAX]; /* least and largest velocity along each axis [m/s] */
    bool known;                              /* the box is finite, and no force acts before the body meets another */
};

/* Computes the bounding box and the range of initial velocities of each deformable body b of scene s from its particles
 * p, and stores both in f[b]. Bodies that are joined count as the body with the lowest number. f: one entry for each
 * body and rigid body; entries of rigid bodies are not set. */
static void flights_of_particles(const struct scene *s, const struct particles *p, struct flight *f)
{
    for (int b = 0; b < s->bodies; b++)
        for (int d = 0; d < s->dim; d++)
            f[b].low[d] = f[b].slowest[d] = INFINITY, f[b].high[d] = f[b].fastest[d] = -INFINITY;
    for (int64_t i = 0; i < p->n; i++) {
        struct flight *own = &f[s->body[p->body[i]].joined];
        own->known = true;
        for (int d = 0; d < s->dim; d++) {
            own->low[d] = real_min(own->low[d], p->X[d][i] - 0.5 * s->spacing);
            own->high[d] = real_max(own->high[d], p->X[d][i] + 0.5 * s->spacing);
            own->slowest[d] = real_min(own->slowest[d], p->v[d][i]);
            own->fastest[d] = real_max(own->fastest[d], p->v[d][i]);
        }
    }
}

/* Computes the bounding box and velocity of each rigid body b, s->bodies <= b < s->bodies + s->rigids, and stores them
 * in f[b]. f[b].known is false for unbounded shapes. */
static void flights_of_rigids(const struct scene *s, struct flight *f)
{
    for (int b = s->bodies; b < s->bodies + s->rigids; b++) {
        const struct scene_body *body = &s->body[b];
        f[b].known = region_compute_bounding_box_if_finite(&body->shape, s->dim, f[b].low, f[b].high);
        for (int d = 0; d < s->dim; d++) f[b].slowest[d] = f[b].fastest[d] = body->velocity[d];
    }
}

/* Returns true if the body that f describes (range of its velocities) moves in one direction as a whole: along one axis
 * all particles move in the same direction, each with more than half of the largest speed. dim: number of
 * dimensions. */
static bool flies(const struct flight *f, int dim)
{
    bool any = false;
    for (int d = 0; d < dim; d++)
        any |= f->slowest[d] * f->fastest[d] > 0 && 2 * real_min(fabs(f->slowest[d]), fabs(f->fastest[d])) >
                                                        real_max(fabs(f->slowest[d]), fabs(f->fastest[d]));
    return any;
}

/* Returns the time after which the bodies a and b can meet [s]: when their boxes, extended by `reach` [m] and moved
 * with the extreme velocities, overlap along every axis. Returns INFINITY if they never do, also if they touch or are
 * closer than `reach` at the start, and fly apart. */
static real time_to_meet(const struct flight *a, const struct flight *b, int dim, real reach)
{
    real after = 0;
    for (int d = 0; d < dim; d++) {
        const real ahead = b->low[d] - a->high[d] - reach, behind = a->low[d] - b->high[d] - reach;
        const real closing = ahead > behind ? a->fastest[d] - b->slowest[d] : b->fastest[d] - a->slowest[d];
        const real gap = real_max(ahead, behind);
        if (gap > 0)
            after = real_max(after, closing > 0 ? gap / closing : INFINITY);
        else if (gap > -(1 + TOUCHING) * reach && closing < 0)
            after = INFINITY;
    }
    return after;
}

/* Returns true if nothing but contact changes the flight of bodies: the scene has no force, weight or prescribed
 * motion, and no plane of symmetry, at which a body may meet its own image. */
static bool fly_freely(const struct scene *s)
{
    bool freely = scene_is_dynamic(s) && dot(s->gravity, s->gravity, s->dim) == 0;
    for (int k = 0; k < s->boundaries; k++) {
        const struct boundary *b = &s->boundary[k];
        freely = freely && (boundary_is_support_at_rest(b, s->dim) || b->kind == BOUNDARY_ABSORBING);
    }
    for (int b = s->bodies; b < s->bodies + s->rigids; b++)
        freely = freely && dot(s->body[b].force, s->body[b].force, s->dim) == 0;
    return freely;
}

/* Adds a warning to *to if body number a, which moves in one direction as a whole, meets no other body within the
 * duration of scene s. f[b]: bounding box and range of velocities of each body b, rigid bodies included. No warning is
 * added if the box of another body is not known. */
static void warn_of_flight(const struct scene *s, const struct flight *f, int a, struct warnings *to)
{
    real soonest = INFINITY;
    int other = -1;
    for (int b = 0; b < s->bodies + s->rigids; b++) {
        if (b == a || (b < s->bodies && s->body[b].joined != b)) continue;
        if (!f[b].known) return;
        const real after = time_to_meet(&f[a], &f[b], s->dim, s->spacing);
        if (other < 0 || after < soonest) other = b, soonest = after;
    }
    if (other < 0 || soonest <= s->duration) return;
    if (isfinite(soonest))
        warnings_add_if_new(to,
                            "body %s would reach %s after %.3g s, but the duration is %.3g s; check its position (m if "
                            "no unit is written) and velocity, or the duration",
                            s->body[a].name, s->body[other].name, soonest, s->duration);
    else
        warnings_add_if_new(to,
                            "body %s never reaches another body, because its velocity leads past %s or away from it; "
                            "check its position and the sign of its velocity",
                            s->body[a].name, s->body[other].name);
}

void run_warn_of_bodies_that_never_meet(const struct scene *s, const struct particles *p, struct warnings *warnings)
{
    const int bodies = s->bodies + s->rigids;
    if (!fly_freely(s) || bodies < 2 || bodies > FLYING_MOST || p->n < p->n_body) return;
    struct flight *f = NEW("warn.flights", bodies, struct flight);
    flights_of_particles(s, p, f);
    flights_of_rigids(s, f);
    for (int b = 0; b < bodies; b++)
        if (f[b].known && flies(&f[b], s->dim)) warn_of_flight(s, f, b, warnings);
    memory_free(f);
}
