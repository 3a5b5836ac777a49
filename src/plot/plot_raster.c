/* Paints a flat cloud into pixels.
 *
 * Point symbols would leave gaps or overlap at every scale but one. Here each pixel takes the colour of the nearest
 * particle, so that a body appears as a closed surface and a crack as an open line. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "plot/plot.h"

/* Half width of a square and radius of a disc over the spacing. A square slightly wider than the spacing closes the
 * gaps of a strained lattice; a disc that reaches beyond the diagonal those of a rotated or irregular one. */
static const double SQUARE = 0.55, DISC = 0.9;

struct canvas {
    struct colour *pixel;
    float *rank; /* [height][width] rank of the painted particle; the smallest wins */
    int width, height;
    double per_metre[2]; /* pixels per metre */
};

/* Paints particle i on all pixels that it covers and that no better particle has: nearer to the centre of the pixel,
 * or, if several particles are on one pixel, more damaged. */
static void paint_particle(struct canvas *v, const struct view *view, const struct plotted_particles *c, int64_t i,
                           enum map map)
{
    double at[2], reach[2];
    int from[2], to[2], size[2] = {v->width, v->height};
    const double wide = c->size ? c->size[i] - c->spacing : 0; /* additional width of a coarse cell's point */
    const double half = c->aligned ? SQUARE * c->spacing + 0.5 * wide : DISC * (c->spacing + wide);
    bool fine = c->spacing * v->per_metre[0] < 1.5; /* several particles per pixel: show the most damaged one */
    for (int k = 0; k < 2; k++) {
        at[k] = (c->position[k][i] - view->from[k]) * v->per_metre[k];
        reach[k] = fmax(half * v->per_metre[k], 0.5);
        if (!(at[k] > -reach[k] && at[k] < size[k] + reach[k])) return; /* outside the picture, or NaN */
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

void raster_paint_particles(struct colour *pixel, int width, int height, const struct view *view,
                            const struct plotted_particles *c, enum map map)
{
    int64_t pixels = (int64_t)width * height;
    if (c->position[2] || c->tall > 0) {
        cubes_paint_particles(pixel, width, height, view, c, map);
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
