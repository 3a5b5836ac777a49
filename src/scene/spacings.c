/* Chooses spacings from the lengths of a scene. */
#include "scene/spacings.h"

#include <math.h>

/* ---- a spacing that fits -------------------------------------------------------------------------------------------
 *
 * The lattice of a body is placed by its first solid and divides its edges into whole numbers of spacings (fill.c);
 * gaps and crack tips along the axes keep their positions only if they, too, are between particles. */

enum { LENGTHS_MOST = 64 }; /* largest number of lengths that are considered */

/* A list of n lengths [m]. */
struct lengths {
    int n;
    real of[LENGTHS_MOST];
};

/* Returns the extent [m] along an axis of the box that is the first solid of a body; 0 if the first solid is no box or
 * has motions. body: index in the scene s; axis: 0 to 2. */
static real box_extent(const struct scene *s, int body, int axis)
{
    const struct region *shape = &s->body[body].shape;
    if (shape->n == 0 || !solid_is_untransformed_and_of_kind(&shape->solid[0], SOLID_BOX)) return 0;
    return shape->solid[0].to[axis] - shape->solid[0].from[axis];
}

static void length_add(struct lengths *l, real length)
{
    if (fabs(length) > 0 && l->n < LENGTHS_MOST) l->of[l->n++] = fabs(length);
}

/* Appends the distance of the coordinate X along an axis [m] from the lower face of a box to the list l, if X is inside
 * the box. axis: 0 to 2. */
static void length_add_inside(struct lengths *l, const struct solid *box, int axis, real X)
{
    if (X > box->from[axis] && X < box->to[axis]) length_add(l, X - box->from[axis]);
}

static void lengths_add_cracks(struct lengths *l, const struct scene *s, const struct solid *box)
{
    for (int k = 0; k < s->cracks && s->dim == 2; k++) {
        const real *a = s->crack[k].corner[0], *b = s->crack[k].corner[1];
        if (a[0] != b[0] && a[1] != b[1]) continue; /* oblique: fits no lattice */
        for (int d = 0; d < 2; d++) length_add_inside(l, box, d, a[d]), length_add_inside(l, box, d, b[d]);
    }
}

/* Collects in l the lengths of the scene s that the spacing should divide: edges of bodies, and positions of gaps and
 * cracks in them. */
static void lengths_collect(struct lengths *l, const struct scene *s)
{
    l->n = 0;
    for (int b = 0; b < s->bodies; b++) {
        if (s->body[b].shape.n == 0) continue; /* particles from a list */
        const struct solid *box = &s->body[b].shape.solid[0];
        for (int d = 0; d < s->dim; d++) length_add(l, box_extent(s, b, d));
        for (int k = 1; k < s->body[b].shape.n; k++) {
            const struct solid *gap = &s->body[b].shape.solid[k];
            for (int d = 0; d < s->dim && gap->subtract && solid_is_untransformed_and_of_kind(gap, SOLID_BOX); d++)
                length_add_inside(l, box, d, gap->from[d]), length_add_inside(l, box, d, gap->to[d]);
        }
        lengths_add_cracks(l, s, box);
    }
}

/* Relative tolerance for the equality of lengths [1], because scenes give lengths with few digits. */
#define DIGITS 1e-6

/* Returns the smallest number of equal parts into which `length` [m] can be divided such that no part is longer than h
 * [m]; at least 1. */
static real spacings_in(real length, real h) { return real_max(1, ceil(length / h * (1 - DIGITS))); }

/* Returns true if `length` is a whole multiple of `unit`, to a relative tolerance of 1e-6; both in one unit. */
static bool length_divides(real unit, real length)
{
    const real count = length / unit;
    return fabs(count - round(count)) < 1e-6 * count;
}

/* Returns true if the spacing h [m] divides all lengths in l. With `even`, 2 h must also divide the edges of the first
 * body of the scene s, so that grid cells of two spacings end at its faces. */
static bool spacing_fits(const struct lengths *l, const struct scene *s, real h, bool even)
{
    for (int k = 0; k < l->n; k++)
        if (!length_divides(h, l->of[k])) return false;
    for (int d = 0; d < s->dim && even; d++)
        if (!length_divides(2 * h, box_extent(s, 0, d))) return false;
    return true;
}

real spacing_that_fits_box_edges(const struct scene *s, real h, bool prefer_even_edge_counts)
{
    struct lengths l;
    real least = INFINITY;
    lengths_collect(&l, s);
    for (int k = 0; k < l.n; k++) least = real_min(least, l.of[k]);
    if (!isfinite(least)) return h;
    for (int strict = prefer_even_edge_counts; strict >= 0; strict--)
        for (real n = spacings_in(least, h); least / n > 0.75 * h; n++)
            if (spacing_fits(&l, s, least / n, strict)) return least / n;
    const real edge = box_extent(s, 0, 0), cells = spacings_in(edge, h);
    return edge > 0 ? edge / (prefer_even_edge_counts ? 2 * ceil(cells / 2) : cells) : h;
}

/* ---- a coarse spacing ----------------------------------------------------------------------------------------------
 *
 * Each length that a solution has to resolve gets as many spacings as show its convergence; two coarser levels still
 * have half as many. */

/* Numbers of spacings in a length of the scene, which determine the suggested spacing. */
#define ACROSS_BODY 10.0 /* across a body */
#define IN_HOLE 4.0      /* in the radius of a hole, a cylinder, a ball */
#define IN_CRACK 8.0     /* in a crack, or from its end to a face */
#define IN_PULSE 10.0    /* in a pulse or a wavelength */
#define IN_RING 12.5     /* in the radius of a ring of a sif probe, which requires at least 6 */
#define PARTICLES_MOST 5e4
static const double particles_usual[] = {0, 200, 3000,
                                         8000}; /* number of particles in 1D, 2D, 3D; lengths can require more */

/* Returns the largest spacing [m] with at least ACROSS_BODY spacings along each edge of the bounding box of `shape`,
 * the shape of a body of the scene s, and IN_HOLE in each radius of its round solids; INFINITY if the shape is
 * infinite. */
static double body_spacing(const struct scene *s, const struct region *shape)
{
    real from[DIM_MAX], to[DIM_MAX];
    double least = INFINITY;
    if (!region_compute_bounding_box_if_finite(shape, s->dim, from, to)) return least;
    for (int d = 0; d < s->dim; d++) least = fmin(least, (to[d] - from[d]) / ACROSS_BODY);
    for (int k = 0; k < shape->n; k++) {
        const struct solid *a = &shape->solid[k];
        least = fmin(least, solid_radius_if_round(a, s->dim) / IN_HOLE);
    }
    return least;
}

/* Returns the distance of X[dim] from the nearest face of the bounding box of the first body of s [m]. Faces on which X
 * is are not considered. Returns INFINITY if the box is infinite. */
static double distance_to_face(const struct scene *s, const real *X)
{
    real from[DIM_MAX], to[DIM_MAX];
    double least = INFINITY;
    if (!region_compute_bounding_box_if_finite(&s->body[0].shape, s->dim, from, to)) return least;
    for (int d = 0; d < s->dim; d++) {
        if (X[d] > from[d]) least = fmin(least, X[d] - from[d]);
        if (X[d] < to[d]) least = fmin(least, to[d] - X[d]);
    }
    return least;
}

/* Returns the largest spacing [m] with at least IN_CRACK spacings in the length of crack c and in the distance of each
 * of its ends from the nearest face of the first body of s; INFINITY in 1D. */
static double crack_spacing(const struct scene *s, const struct crack *c)
{
    double squares = 0, least = INFINITY;
    if (s->dim == 1) return least;
    for (int d = 0; d < s->dim; d++) squares += square(c->corner[1][d] - c->corner[0][d]);
    least = sqrt(squares) / IN_CRACK;
    for (int k = 0; k < c->n; k++) {
        const double ligament = distance_to_face(s, c->corner[k]);
        if (ligament > 1e-3 * sqrt(squares)) least = fmin(least, ligament / IN_CRACK);
    }
    return least;
}

/* Returns the largest spacing [m] with at least IN_PULSE spacings in the width of each initial pulse, the wavelength of
 * each sinusoidal body force and, in dynamic runs, the length of the wave of each load pulse of the scene s; INFINITY
 * if there are none. */
static double load_spacing(const struct scene *s)
{
    double least = INFINITY;
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_pulse) least = fmin(least, s->initial[k].pulse.width / IN_PULSE);
    for (int k = 0; k < s->boundaries; k++) {
        const struct boundary *b = &s->boundary[k];
        if (b->kind == BOUNDARY_BODY_FORCE && b->profile.kind == PROFILE_SINE)
            least = fmin(least, b->profile.wavelength / IN_PULSE);
        if (scene_is_dynamic(s) && b->time.kind == TIME_PULSE)
            least = fmin(least, s->material[0].wave_speed * (b->time.until - b->time.from) / IN_PULSE);
    }
    return least;
}

/* Returns the largest spacing [m] with at least IN_RING spacings in each given radius of the contours of a probe p of
 * stress-intensity factors; INFINITY for other probes. */
static double probe_spacing(const struct probe_request *p)
{
    double least = INFINITY;
    if (p->kind != PROBE_SIF) return least;
    if (p->outer > 0) least = p->outer / IN_RING;
    for (int k = 0; k < p->contours.n; k++) least = fmin(least, p->contours.value[k] / IN_RING);
    return least;
}

/* Returns the spacing [m] at which the bounding boxes of all bodies of the scene s together contain `particles`
 * particles. */
static double spacing_for(const struct scene *s, double particles)
{
    real from[DIM_MAX], to[DIM_MAX];
    double volume = 0;
    for (int b = 0; b < s->bodies; b++) {
        double box = 1;
        if (!region_compute_bounding_box_if_finite(&s->body[b].shape, s->dim, from, to)) continue;
        for (int d = 0; d < s->dim; d++) box *= to[d] - from[d];
        volume += box;
    }
    return pow(volume / particles, 1.0 / s->dim);
}

real spacing_that_resolves_all_lengths(const struct scene *s)
{
    double h = load_spacing(s);
    for (int b = 0; b < s->bodies; b++) h = fmin(h, body_spacing(s, &s->body[b].shape));
    for (int k = 0; k < s->cracks; k++) h = fmin(h, crack_spacing(s, &s->crack[k]));
    for (int k = 0; k < s->probes; k++) h = fmin(h, probe_spacing(&s->probe[k]));
    h = fmin(h, spacing_for(s, particles_usual[s->dim]));
    return h > 0 && isfinite(h) ? spacing_that_fits_box_edges(s, fmax(h, spacing_for(s, PARTICLES_MOST)), true) : 0;
}
