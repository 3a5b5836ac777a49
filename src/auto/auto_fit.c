/* floor 4: a spacing that fits the geometry: a lattice hangs on the first solid of each body and cuts its edges into whole
 * numbers of spacings (fill.c); gaps and tips of cracks along the axes are where the scene says only if they, too, lie
 * between particles. */
#include <math.h>

#include "auto.h"

enum { LENGTHS_MOST = 64 };
struct lengths { int n; real of[LENGTHS_MOST]; };

static void add(struct lengths *l, real length)
{
    if (fabs(length) > 0 && l->n < LENGTHS_MOST) l->of[l->n++] = fabs(length);
}

/* Distances from a body's corner that lie inside it. */
static void add_place(struct lengths *l, const struct solid *box, int axis, real X)
{
    if (X > box->from[axis] && X < box->to[axis]) add(l, X - box->from[axis]);
}

static void add_cracks(struct lengths *l, const struct scene *s, const struct solid *box)
{
    for (int k = 0; k < s->cracks && s->dim == 2; k++) {
        const real *a = s->crack[k].corner[0], *b = s->crack[k].corner[1];
        if (a[0] != b[0] && a[1] != b[1]) continue;      /* oblique: it meets no lattice */
        for (int d = 0; d < 2; d++) add_place(l, box, d, a[d]), add_place(l, box, d, b[d]);
    }
}

static void collect(struct lengths *l, const struct scene *s)
{
    l->n = 0;
    for (int b = 0; b < s->bodies; b++) {
        const struct solid *box = &s->body[b].shape.solid[0];
        for (int d = 0; d < s->dim; d++) add(l, auto_extent(s, b, d));
        for (int k = 1; k < s->body[b].shape.n; k++) {
            const struct solid *gap = &s->body[b].shape.solid[k];
            for (int d = 0; d < s->dim && gap->subtract && gap->kind == SOLID_BOX; d++)
                add_place(l, box, d, gap->from[d]), add_place(l, box, d, gap->to[d]);
        }
        add_cracks(l, s, box);
    }
}

/* Lengths of scenes have few digits: what is asked for may be missed by this share. */
#define DIGITS 1e-6

/* Least whole number of spacings <= h in a length. */
static real count_of(real length, real h) { return real_max(1, ceil(length / h * (1 - DIGITS))); }

static bool divides(real unit, real length)
{
    const real count = length / unit;
    return fabs(count - round(count)) < 1e-6 * count;
}

/* The even part holds for the edges alone, cells of two spacings end with the body. */
static bool fits(const struct lengths *l, const struct scene *s, real h, bool even)
{
    for (int k = 0; k < l->n; k++)
        if (!divides(h, l->of[k])) return false;
    for (int d = 0; d < s->dim && even; d++)
        if (!divides(2 * h, auto_extent(s, 0, d))) return false;
    return true;
}

/* Wave carriers may be cut to 3/4 of the spacing for it; then edges alone count. */
real auto_spacing_fit(const struct scene *s, real h, bool even)
{
    struct lengths l;
    real least = INFINITY;
    collect(&l, s);
    for (int k = 0; k < l.n; k++) least = real_min(least, l.of[k]);
    if (!isfinite(least)) return h;
    for (int strict = even; strict >= 0; strict--)
        for (real n = count_of(least, h); least / n > 0.75 * h; n++)
            if (fits(&l, s, least / n, strict)) return least / n;
    const real edge = auto_extent(s, 0, 0), cells = count_of(edge, h);
    return edge / (even ? 2 * ceil(cells / 2) : cells);
}
