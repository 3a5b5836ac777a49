/* The spacing at which pilot runs begin: each length of the scene that a solution has to resolve gets as many spacings
 * as show its convergence; two coarser levels still have half as many. */
#include <math.h>

#include "auto/scene_read.h"
#include "study/pilot.h"

#define ACROSS_BODY 10.0 /* spacings across a body ... */
#define IN_HOLE 4.0      /* ... in the radius of a hole, a cylinder, a ball */
#define IN_CRACK 8.0     /* ... in a crack, or from its end to a face */
#define IN_PULSE 10.0    /* ... in a pulse or a wavelength */
#define IN_RING 12.5     /* ... in the radius of a ring of a sif probe, which wants 6 */
#define PARTICLES_MOST 5e4
static const double particles_usual[] = {0, 200, 3000, 8000}; /* in 1, 2, 3 dimensions, or more where lengths ask */

/* ---- lengths ----------------------------------------------------------------------------------------------------- */

static double body_spacing(const struct scene *s, const struct region *shape)
{
    real from[DIM_MAX], to[DIM_MAX];
    double least = INFINITY;
    if (!region_bounds(shape, s->dim, from, to)) return least;
    for (int d = 0; d < s->dim; d++) least = fmin(least, (to[d] - from[d]) / ACROSS_BODY);
    for (int k = 0; k < shape->n; k++) {
        const struct solid *a = &shape->solid[k];
        least = fmin(least, solid_radius(a, s->dim) / IN_HOLE);
    }
    return least;
}

/* From a place to the nearest face of the box round the first body that it is not on [m]. */
static double way_to_face(const struct scene *s, const real *X)
{
    real from[DIM_MAX], to[DIM_MAX];
    double least = INFINITY;
    if (!region_bounds(&s->body[0].shape, s->dim, from, to)) return least;
    for (int d = 0; d < s->dim; d++) {
        if (X[d] > from[d]) least = fmin(least, X[d] - from[d]);
        if (X[d] < to[d]) least = fmin(least, to[d] - X[d]);
    }
    return least;
}

static double crack_spacing(const struct scene *s, const struct crack *c)
{
    double squares = 0, least = INFINITY;
    if (s->dim == 1) return least;
    for (int d = 0; d < s->dim; d++) squares += square(c->corner[1][d] - c->corner[0][d]);
    least = sqrt(squares) / IN_CRACK;
    for (int k = 0; k < c->n; k++) {
        const double way = way_to_face(s, c->corner[k]);
        if (way > 1e-3 * sqrt(squares)) least = fmin(least, way / IN_CRACK);
    }
    return least;
}

static double load_spacing(const struct scene *s)
{
    double least = INFINITY;
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_pulse) least = fmin(least, s->initial[k].pulse.width / IN_PULSE);
    for (int k = 0; k < s->boundaries; k++) {
        const struct boundary *b = &s->boundary[k];
        if (b->kind == BOUNDARY_BODY_FORCE && b->profile.kind == PROFILE_SINE)
            least = fmin(least, b->profile.wavelength / IN_PULSE);
        if (scene_moves(s) && b->time.kind == TIME_PULSE)
            least = fmin(least, s->material[0].wave_speed * (b->time.until - b->time.from) / IN_PULSE);
    }
    return least;
}

static double probe_spacing(const struct probe_request *p)
{
    double least = INFINITY;
    if (p->kind != PROBE_SIF) return least;
    if (p->outer > 0) least = p->outer / IN_RING;
    for (int k = 0; k < p->contours.n; k++) least = fmin(least, p->contours.value[k] / IN_RING);
    return least;
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* At which the boxes round all bodies have so many particles. */
static double spacing_for(const struct scene *s, double particles)
{
    real from[DIM_MAX], to[DIM_MAX];
    double volume = 0;
    for (int b = 0; b < s->bodies; b++) {
        double box = 1;
        if (!region_bounds(&s->body[b].shape, s->dim, from, to)) continue;
        for (int d = 0; d < s->dim; d++) box *= to[d] - from[d];
        volume += box;
    }
    return pow(volume / particles, 1.0 / s->dim);
}

double pilot_spacing(const struct scene *s)
{
    double h = load_spacing(s);
    for (int b = 0; b < s->bodies; b++) h = fmin(h, body_spacing(s, &s->body[b].shape));
    for (int k = 0; k < s->cracks; k++) h = fmin(h, crack_spacing(s, &s->crack[k]));
    for (int k = 0; k < s->probes; k++) h = fmin(h, probe_spacing(&s->probe[k]));
    h = fmin(h, spacing_for(s, particles_usual[s->dim]));
    return isfinite(h) ? auto_spacing_fit(s, fmax(h, spacing_for(s, PARTICLES_MOST)), true) : 0;
}
