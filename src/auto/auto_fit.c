/* A spacing that fits the geometry: the lattice of a body is placed by its first solid and divides its edges into whole
 * numbers of spacings (fill.c); gaps and crack tips along the axes keep their places only if they, too, lie between
 * particles. */
#include <math.h>

#include "auto.h"
#include "auto/scene_read.h"

enum { LENGTHS_MOST = 64 };
#define RING_SPACINGS 3.001 /* width of a ring that a sif probe takes [spacings] */
struct lengths { int n; real of[LENGTHS_MOST]; };

static void add(struct lengths *l, real length)
{
    if (fabs(length) > 0 && l->n < LENGTHS_MOST) l->of[l->n++] = fabs(length);
}

/* Adds the distance of a place X from the lower corner of a body, if X lies inside the body. */
static void add_place(struct lengths *l, const struct solid *box, int axis, real X)
{
    if (X > box->from[axis] && X < box->to[axis]) add(l, X - box->from[axis]);
}

static void add_cracks(struct lengths *l, const struct scene *s, const struct solid *box)
{
    for (int k = 0; k < s->cracks && s->dim == 2; k++) {
        const real *a = s->crack[k].corner[0], *b = s->crack[k].corner[1];
        if (a[0] != b[0] && a[1] != b[1]) continue;      /* oblique: fits no lattice */
        for (int d = 0; d < 2; d++) add_place(l, box, d, a[d]), add_place(l, box, d, b[d]);
    }
}

/* Collects the lengths that the spacing should divide: edges of bodies, and places of gaps and cracks in them. */
static void collect(struct lengths *l, const struct scene *s)
{
    l->n = 0;
    for (int b = 0; b < s->bodies; b++) {
        const struct solid *box = &s->body[b].shape.solid[0];
        for (int d = 0; d < s->dim; d++) add(l, auto_extent(s, b, d));
        for (int k = 1; k < s->body[b].shape.n; k++) {
            const struct solid *gap = &s->body[b].shape.solid[k];
            for (int d = 0; d < s->dim && gap->subtract && solid_is(gap, SOLID_BOX); d++)
                add_place(l, box, d, gap->from[d]), add_place(l, box, d, gap->to[d]);
        }
        add_cracks(l, s, box);
    }
}

/* Relative tolerance of lengths, which have few digits in scenes. */
#define DIGITS 1e-6

/* Least whole number of spacings <= h in a length. */
static real auto_fit_count_of(real length, real h) { return real_max(1, ceil(length / h * (1 - DIGITS))); }

static bool divides(real unit, real length)
{
    const real count = length / unit;
    return fabs(count - round(count)) < 1e-6 * count;
}

/* True if h divides all lengths and, with `even`, 2 h the edges of the body: cells of two spacings end with the
 * body. */
static bool fits(const struct lengths *l, const struct scene *s, real h, bool even)
{
    for (int k = 0; k < l->n; k++)
        if (!divides(h, l->of[k])) return false;
    for (int d = 0; d < s->dim && even; d++)
        if (!divides(2 * h, auto_extent(s, 0, d))) return false;
    return true;
}

real auto_spacing_rings(const struct scene *s)
{
    real least = INFINITY;
    for (int k = 0; k < s->probes; k++) {
        const struct probe_request *p = &s->probe[k];
        if (p->kind != PROBE_SIF) continue;
        const int rings = p->contours.n > 0 ? p->contours.n : 1;
        for (int c = 0; c < rings; c++) {
            const real outer = p->contours.n > 0 ? p->contours.value[c] : p->outer;
            if (outer > 0) least = real_min(least, (outer - (p->inner > 0 ? p->inner : 0.5 * outer)) / RING_SPACINGS);
        }
    }
    return least;
}

/* Spacings down to 3/4 h are tried; without a fit the edge along x alone counts. */
real auto_spacing_fit(const struct scene *s, real h, bool even)
{
    struct lengths l;
    real least = INFINITY;
    collect(&l, s);
    for (int k = 0; k < l.n; k++) least = real_min(least, l.of[k]);
    if (!isfinite(least)) return h;
    for (int strict = even; strict >= 0; strict--)
        for (real n = auto_fit_count_of(least, h); least / n > 0.75 * h; n++)
            if (fits(&l, s, least / n, strict)) return least / n;
    const real edge = auto_extent(s, 0, 0), cells = auto_fit_count_of(edge, h);
    return edge / (even ? 2 * ceil(cells / 2) : cells);
}
