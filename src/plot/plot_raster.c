/* Paints the particles of a plane body or of a slice into the pixels of an image. Each pixel gets the colour of the
 * nearest particle, so that a body appears as a closed surface and a crack as an open line. Point symbols would leave
 * gaps or overlap at most scales. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "plot/plot.h"

/* SQUARE: half width of a square particle, divided by the spacing; slightly more than 0.5 to close the gaps of a
 * strained lattice. DISC: radius of a disc-shaped particle, divided by the spacing; more than half the diagonal of a
 * lattice cell to close the gaps of rotated or irregular particles. */
static const double SQUARE = 0.55, DISC = 0.9;

/* Image of a 2D body or of a slice while it is painted. pixel: [height][width] colours; width, height: size [pixel]. */
struct canvas {
    struct colour *pixel;
    float *rank; /* [height][width] rank of the painted particle; the smallest wins */
    int width, height;
    double per_metre[2]; /* pixels per metre */
};

/* Shape of one particle in a map: a square or a disc, deformed by the gradient F along the axes of the map (`inverse`:
 * of F). Lengths are those before the deformation [m]. half: radius of a disc, or the largest entry of `side`;
 * side[k][b]: distance from the centre of the side of a square along axis k, towards larger (b = 0) or smaller
 * coordinates (1). */
struct outline {
    double F[2][2], inverse[2][2], half, side[2][2];
    bool square;
};

/* Returns true if a crack or another body begins beside particle i of `plotted`, on side b of the axis `axis` of the
 * map (0: towards larger coordinates, 1: smaller ones). */
static bool is_apart(const struct plotted_particles *plotted, int64_t i, const double *axis, int b)
{
    for (int m = 0; m < 3 && plotted->apart; m++)
        if (fabs(axis[m]) > 0.9) return plotted->apart[i] >> (2 * m + (axis[m] < 0 ? !b : b)) & 1;
    return false;
}

/* Returns the shape of particle i of c. On a side where a crack or another body begins, a square ends half a spacing
 * plus half a pixel from its centre, so that a gap is drawn in its true width. The half pixel prevents that a gap
 * narrower than a pixel is drawn as a dotted line. pixel: edge of a pixel [m]. */
static struct outline outline_of(const struct plotted_particles *plotted, int64_t i, double pixel)
{
    const double wide =
        plotted->size ? plotted->size[i] - plotted->spacing : 0; /* additional width of a coarse cell's point */
    const double *axis[2] = {plotted->camera.right, plotted->camera.up};
    struct outline s = {.F = {{1, 0}, {0, 1}}, .square = plotted->aligned};
    s.half = plotted->aligned ? SQUARE * plotted->spacing + 0.5 * wide : DISC * (plotted->spacing + wide);
    for (int k = 0; k < 4; k++) {
        const bool apart = s.square && is_apart(plotted, i, axis[k / 2], k % 2);
        s.side[k / 2][k % 2] = apart ? 0.5 * (plotted->spacing + wide + pixel) : SQUARE * plotted->spacing + 0.5 * wide;
    }
    for (int k = 0; k < 4 && s.square; k++) s.half = fmax(s.half, s.side[k / 2][k % 2]);
    for (int k = 0; k < 4 && plotted->gradient; k++) {
        double sum = 0;
        for (int m = 0; m < 9; m++)
            sum += axis[k / 2][m / 3] * (double)plotted->gradient[9 * i + m] * axis[k % 2][m % 3];
        s.F[k / 2][k % 2] = sum;
    }
    const double determinant = s.F[0][0] * s.F[1][1] - s.F[0][1] * s.F[1][0];
    for (int k = 0; k < 4; k++)
        s.inverse[k / 2][k % 2] = (k % 3 ? -s.F[k / 2][k % 2] : s.F[1 - k / 2][1 - k % 2]) / determinant;
    return s;
}

/* Returns half of the extent of the deformed particle with the shape s along axis k of the map [m]. */
static double outline_reach(const struct outline *s, int k)
{
    return s->half * (s->square ? fabs(s->F[k][0]) + fabs(s->F[k][1]) : hypot(s->F[k][0], s->F[k][1]));
}

/* Returns the distance [m] from the centre of the particle with the outline s, measured before the deformation, of a
 * point of the particle; its reference position follows by the inverse of the deformation gradient. off[2]: position of
 * the point relative to the centre after the deformation [m]. Returns INFINITY if the point is more than `beside` [m]
 * outside the particle. */
static double distance_within(const struct outline *s, const double *off, double beside)
{
    double xi[2];
    for (int k = 0; k < 2; k++) xi[k] = s->inverse[k][0] * off[0] + s->inverse[k][1] * off[1];
    const double far = hypot(xi[0], xi[1]);
    double outside = s->square ? -INFINITY : far - s->half; /* distance from the nearest side, negative inside */
    for (int k = 0; k < 2 && s->square; k++)
        outside = fmax(outside, fmax(xi[k] - s->side[k][0], -xi[k] - s->side[k][1]));
    return outside <= beside ? far : INFINITY;
}

/* Limits the range *low .. *high [m] along axis k of the map that particle i of `plotted` covers to the side of each
 * plane of symmetry on which its centre is. Planes that are not perpendicular to axis k are skipped. */
static void clip_at_mirrors(const struct plotted_particles *plotted, int64_t i, int k, double *low, double *high)
{
    const double *axis = k == 0 ? plotted->camera.right : plotted->camera.up;
    for (int m = 0; m < plotted->mirrors; m++) {
        const double along = axis[plotted->mirror[m].axis], plane = along * plotted->mirror[m].at;
        if (fabs(along) < 0.999) continue;
        if (plotted->position[k][i] > plane)
            *low = fmax(*low, plane);
        else
            *high = fmin(*high, plane);
    }
}

/* Paints particle i of `plotted` on all pixels of the canvas v that it covers, except those with a particle of better
 * rank. The rank is better the nearer the centre of the particle is to the pixel or, if pixels are larger than
 * particles, the more damaged the particle is. view: rectangle that is shown; map: what the colours show. */
static void paint_particle(struct canvas *v, const struct view *view, const struct plotted_particles *plotted,
                           int64_t i, enum map map)
{
    double at[2], reach[2], off[2];
    int from[2], to[2], size[2] = {v->width, v->height};
    const struct outline outline = outline_of(plotted, i, 1 / v->per_metre[0]);
    const bool fine =
        plotted->spacing * v->per_metre[0] < 1.5; /* several particles per pixel: show the most damaged one */
    const double beside = fine ? INFINITY : 1e-3 * plotted->spacing;
    for (int k = 0; k < 2; k++) {
        at[k] = (plotted->position[k][i] - view->from[k]) * v->per_metre[k];
        reach[k] = fmax(outline_reach(&outline, k) * v->per_metre[k], 0.5);
        if (!(at[k] > -reach[k] && at[k] < size[k] + reach[k])) return; /* outside the picture, or NaN */
        double low = -INFINITY, high = INFINITY;
        clip_at_mirrors(plotted, i, k, &low, &high);
        low = fmax((low - view->from[k]) * v->per_metre[k], at[k] - reach[k]);
        high = fmin((high - view->from[k]) * v->per_metre[k], at[k] + reach[k]);
        from[k] = (int)fmax(ceil(low - 0.5), 0), to[k] = (int)fmin(floor(high - 0.5), size[k] - 1);
    }
    const struct colour colour = plotted_particle_colour(view, plotted, i, map);
    for (int row = from[1]; row <= to[1]; row++) {
        off[1] = (row + 0.5 - at[1]) / v->per_metre[1];
        for (int column = from[0]; column <= to[0]; column++) {
            off[0] = (column + 0.5 - at[0]) / v->per_metre[0];
            const double far = distance_within(&outline, off, beside);
            const float rank = fine ? (float)-(plotted->damage[i] + plotted->kind[i]) : (float)(far / plotted->spacing);
            const int64_t q = (int64_t)row * v->width + column;
            if (!isfinite(far) || rank >= v->rank[q]) continue;
            v->rank[q] = rank;
            v->pixel[q] = colour;
        }
    }
}

void image_paint_particles_in_plane(struct colour *pixel, int width, int height, const struct view *view,
                                    const struct plotted_particles *plotted, enum map map)
{
    int64_t pixels = (int64_t)width * height;
    if (plotted->position[2] || plotted->tall > 0) {
        image_paint_particles_as_cubes(pixel, width, height, view, plotted, map);
        return;
    }
    struct canvas v = {.pixel = pixel, .rank = NEW("plot.rank", pixels, float), .width = width, .height = height};
    v.per_metre[0] = width / (view->to[0] - view->from[0]);
    v.per_metre[1] = height / (view->to[1] - view->from[1]);
    for (int64_t q = 0; q < pixels; q++) {
        v.rank[q] = INFINITY;
        pixel[q] = (struct colour){255, 255, 255, 0};
    }
    for (int64_t i = 0; i < plotted->n; i++) paint_particle(&v, view, plotted, i, map);
    image_paint_precrack_faces(pixel, width, height, view, plotted, map);
    image_paint_rigid_bodies_in_plane(pixel, width, height, view, plotted);
    memory_free(v.rank);
}
