/* A flat cloud as pixels.
 *
 * A picture made of point symbols has gaps or overlaps at every size but one. Here each pixel takes the colour of the
 * nearest particle, so that a body is a closed surface and a crack an open line. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "plot/plot.h"

/* A square a little larger than the spacing closes the seams of a strained lattice; a disc that reaches the
 * diagonal and more closes those of a turned or irregular one. */
static const double SQUARE = 0.55, DISC = 0.9; /* half width, radius over spacing */

struct canvas {
    struct colour *pixel;
    float *rank; /* of the particle painted there; the smaller rank wins */
    int width, height;
    double per_metre[2]; /* pixels */
};

/* Paints particle i on the pixels that it covers and where its rank is the smallest. */
static void paint_particle(struct canvas *v, const struct view *view, const struct cloud *c, int64_t i, enum map map)
{
    double at[2], reach[2];
    int from[2], to[2], size[2] = {v->width, v->height};
    const double wide = c->size ? c->size[i] - c->spacing : 0; /* of a coarse cell's point beyond a particle */
    const double half = c->aligned ? SQUARE * c->spacing + 0.5 * wide : DISC * (c->spacing + wide);
    bool fine = c->spacing * v->per_metre[0] < 1.5; /* several particles a pixel: show the most damaged */
    for (int k = 0; k < 2; k++) {
        at[k] = (c->place[k][i] - view->from[k]) * v->per_metre[k];
        reach[k] = fmax(half * v->per_metre[k], 0.5);
        if (!(at[k] > -reach[k] && at[k] < size[k] + reach[k])) return; /* outside, or not a number */
        from[k] = (int)fmax(ceil(at[k] - reach[k] - 0.5), 0);
        to[k] = (int)fmin(floor(at[k] + reach[k] - 0.5), size[k] - 1);
    }
    const struct colour colour = particle_colour(view, c, i, map);
    for (int row = from[1]; row <= to[1]; row++) {
        for (int column = from[0]; column <= to[0]; column++) {
            double r2 = square(column + 0.5 - at[0]) + square(row + 0.5 - at[1]);
            if (!c->aligned && r2 > square(reach[0]) && !fine) continue;
            float rank = fine ? (float)-(c->damage[i] + c->kind[i]) : (float)r2;
            int64_t q = (int64_t)row * v->width + column;
            if (rank >= v->rank[q]) continue;
            v->rank[q] = rank;
            v->pixel[q] = colour;
        }
    }
}

void raster_paint(struct colour *pixel, int width, int height, const struct view *view, const struct cloud *c,
                  enum map map)
{
    int64_t pixels = (int64_t)width * height;
    if (c->place[2] || c->tall > 0) {
        boxes_paint(pixel, width, height, view, c, map);
        return;
    }
    struct canvas v = {.pixel = pixel, .rank = NEW("plot.rank", pixels, float), .width = width, .height = height};
    v.per_metre[0] = width / (view->to[0] - view->from[0]);
    v.per_metre[1] = height / (view->to[1] - view->from[1]);
    for (int64_t q = 0; q < pixels; q++) {
        v.rank[q] = INFINITY;
        pixel[q] = (struct colour){255, 255, 255, 0};
    }
    for (int64_t i = 0; i < c->n; i++) paint_particle(&v, view, c, i, map);
    memory_free(v.rank);
}
